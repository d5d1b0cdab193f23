// The keyboard: every button of the timeline and of the views has a key. The table is both what keys do and what `?` shows.

import { h } from "./dom";
import type { Page } from "./ui";

/** Keys that do one thing, or two opposite things. */
interface Binding {
  /** The keys as the list shows them. */
  shown: string;
  words: string;
  /** What each key does, by its name in events. */
  acts: Record<string, (page: Page) => void>;
  /** Whether the page has what the keys act on; without: always. */
  when?: (page: Page) => boolean;
}

/** Clicks a control of the page. */
const click = (control: string) => () => document.querySelector<HTMLElement>(`[data-control=${control}]`)?.click();
/** Ticks the box with these words, as a click does. */
const flip = (words: string) => () => boxes().find((label) => label.textContent === words)?.querySelector("input")?.click();
const boxes = () => [...document.querySelectorAll<HTMLLabelElement>("label.tick")];
const has = (words: string) => () => boxes().some((label) => label.textContent === words);

export const BINDINGS: Binding[] = [
  { shown: "Space", words: "play, pause", acts: { " ": ({ player }) => player.timeline.toggle() } },
  { shown: "← →", words: "one instant back, on", acts: { ArrowLeft: ({ player }) => player.timeline.step(-1), ArrowRight: ({ player }) => player.timeline.step(1) } },
  { shown: "Home End", words: "to the start, to the end", acts: { Home: ({ player: { timeline } }) => timeline.seek(timeline.start), End: ({ player: { timeline } }) => timeline.seek(timeline.end) } },
  { shown: "− +", words: "slower, faster", acts: { "-": ({ player }) => player.timeline.slower(), "+": ({ player }) => player.timeline.faster(), "=": ({ player }) => player.timeline.faster() } },
  { shown: "L", words: "loop", acts: { l: click("loop") } },
  { shown: "1 2 3 4", words: "views: oblique, front, side, top", acts: { "1": (page) => page.view("iso"), "2": (page) => page.view("front"), "3": (page) => page.view("side"), "4": (page) => page.view("top") } },
  { shown: "F", words: "fit into the picture", acts: { f: (page) => page.view() } },
  { shown: "P", words: "perspective or parallel", acts: { p: flip("Parallel") } },
  { shown: "C", words: "next quantity to color by", acts: { c: nextColor }, when: ({ data }) => data.scene.beams.length > 0 },
  { shown: "G", words: "as drawn, faintly", acts: { g: flip("As drawn") } },
  { shown: "N", words: "names", acts: { n: flip("Names") } },
  { shown: "T", words: "trails", acts: { t: flip("Trails") }, when: has("Trails") },
  { shown: "B", words: "the second run", acts: { b: flip("Second run") }, when: has("Second run") },
  { shown: "V", words: "record a video of the motion; again: end and save it", acts: { v: click("video") }, when: (page) => page.records },
  { shown: "M", words: "save the model of this instant as glTF", acts: { m: click("gltf") } },
  { shown: "Esc", words: "forget the point", acts: { Escape: ({ player }) => player.choose(undefined) } },
  { shown: "?", words: "these keys", acts: { "?": (page) => page.help() } },
];

const ACTS: Record<string, (page: Page) => void> = Object.assign({}, ...BINDINGS.map(({ acts }) => acts));

/** The keys that the page has, as a list. */
export function list(page: Page): HTMLElement {
  const own = BINDINGS.filter(({ when }) => !when || when(page));
  return h("dl", {}, ...own.flatMap(({ shown, words }) => [h("dt", {}, ...shown.split(" ").map((key) => h("kbd", {}, key))), h("dd", {}, words)]));
}

/** Listens until `signal` says stop. */
export function listenToKeys(page: Page, signal: AbortSignal): void {
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    // The list closes with the key that opened it.
    if (document.querySelector("dialog[open]") && event.key !== "?") return;
    const target = event.target as HTMLElement;
    // Whatever is typed into a field is text.
    if (target.matches(".model input:not([type=checkbox]), textarea")) return;
    // Lists and sliders of their own have the keys; a button has Space and Enter.
    if (target.matches("select, input[type=range]:not(.scrub)")) return;
    if (event.key === " " && target.matches("button, input[type=checkbox], summary")) return;
    const act = ACTS[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!act) return;
    event.preventDefault();
    act(page);
  }, { signal });
}

function nextColor(page: Page): void {
  const list = document.querySelector<HTMLSelectElement>("[data-control=color] select");
  if (!list) return;
  // The first one is nothing.
  const words = [...list.options].map(({ value }) => value).slice(1);
  list.value = words[(words.indexOf(page.player.quantity?.word ?? "") + 1) % words.length];
  list.dispatchEvent(new Event("change"));
}
