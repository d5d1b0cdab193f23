// Takes what a reader has chosen from a page to the one that shows the next run: camera, instant, colors, boxes that are ticked.

import { fraction, spotAt } from "./pick";
import type { Page } from "./ui";

type Field = HTMLInputElement | HTMLSelectElement;

/** The settings of the box "Display", by their words. */
function fields(page: Page): Map<string, Field> {
  const labels = [...page.app.querySelectorAll<HTMLLabelElement>(".controls label")];
  return new Map(labels.map((label) => [label.querySelector("span")?.textContent ?? label.textContent!, label.querySelector<Field>("input, select")!]));
}

const value = (field: Field) => (field.type === "checkbox" ? String((field as HTMLInputElement).checked) : field.value);

/** What was chosen in `page`, to be chosen in the next one. */
export function chosen(page: Page): (next: Page) => void {
  const { player, side } = page;
  const { run, spot, mode, following } = player;
  const pose = player.stage.pose;
  const settings = new Map([...fields(page)].map(([words, field]) => [words, value(field)]));
  const open = page.app.querySelector<HTMLDetailsElement>(".controls")!.open;
  const { scrollTop } = side;
  const place = spot && { name: page.data.scene.beams[spot.beam].name, at: fraction(page.data.scene.beams[spot.beam], spot) };
  return (next) => {
    const { player: other, data } = next;
    next.app.querySelector<HTMLDetailsElement>(".controls")!.open = open;
    for (const [words, field] of fields(next)) {
      const wanted = settings.get(words);
      if (wanted === undefined || wanted === value(field)) continue;
      if (field instanceof HTMLSelectElement && ![...field.options].some((option) => option.value === wanted)) continue;
      if (field.type === "checkbox") (field as HTMLInputElement).checked = wanted === "true";
      else field.value = wanted;
      field.dispatchEvent(new Event(field.type === "range" ? "input" : "change"));
    }
    const aim = () => {
      other.stage.pose = pose;
      other.refresh();
    };
    // The box gives room to the picture when it opens, a moment later, which fits it once more.
    aim();
    requestAnimationFrame(() => setTimeout(aim));
    other.run.speed = run.speed;
    other.run.looping = run.looping;
    other.run.playing = run.playing && mode === undefined;
    other.run.seek(run.time);
    const beam = place ? data.scene.beams.findIndex(({ name }) => name === place.name) : -1;
    if (place && beam >= 0) {
      other.choose(spotAt(data.scene.beams[beam], beam, place.at));
      other.following = following;
    }
    next.side.scrollTop = scrollTop;
  };
}
