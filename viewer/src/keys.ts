// The keyboard: every button of the timeline and of the views has a key.

import type { Page } from "./ui";

/** Ticks the box with these words, as a click does. */
function flip(words: string): void {
  const label = [...document.querySelectorAll<HTMLLabelElement>("label.tick")].find((label) => label.textContent === words);
  label?.querySelector("input")?.click();
}

/** Listens until `signal` says stop. */
export function listenToKeys(page: Page, signal: AbortSignal): void {
  const { player } = page;
  const actions: Record<string, () => void> = {
    " ": () => player.timeline.toggle(),
    ArrowLeft: () => player.timeline.step(-1),
    ArrowRight: () => player.timeline.step(1),
    Home: () => player.timeline.seek(player.timeline.start),
    End: () => player.timeline.seek(player.timeline.end),
    "+": () => player.timeline.faster(),
    "=": () => player.timeline.faster(),
    "-": () => player.timeline.slower(),
    l: () => document.querySelector<HTMLButtonElement>("[data-control=loop]")?.click(),
    "1": () => page.view("iso"),
    "2": () => page.view("front"),
    "3": () => page.view("side"),
    "4": () => page.view("top"),
    f: () => page.view(),
    p: () => flip("Parallel"),
    g: () => flip("As drawn"),
    n: () => flip("Names"),
    t: () => flip("Trails"),
    b: () => flip("Second run"),
    c: () => nextColor(page),
    v: () => document.querySelector<HTMLButtonElement>("[data-control=video]")?.click(),
    Escape: () => player.choose(undefined),
  };
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || document.querySelector("dialog[open]")) return;
    const target = event.target as HTMLElement;
    // Whatever is typed into a field is text.
    if (target.matches(".model input:not([type=checkbox]), textarea")) return;
    // Lists and sliders of their own have the keys; a button has Space and Enter.
    if (target.matches("select, input[type=range]:not(.scrub)")) return;
    if (event.key === " " && target.matches("button, input[type=checkbox], summary")) return;
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    action();
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
