// What was clicked on: beam, fraction of its length, place, and all that its section bears at the present instant.

import { quantityText } from "./color";
import { button, h } from "./dom";
import { fraction, placeAt, spotAt, told } from "./pick";
import type { Player } from "./player";

const LABELS: Record<string, string> = {
  stress: "stress", axial_force: "axial force", shear_y: "shear y", shear_z: "shear z", torque: "torque", moment_y: "moment y", moment_z: "moment z", axial_strain: "axial strain",
  curvature_y: "curvature y", curvature_z: "curvature z", torsion: "twist rate", speed: "speed",
};

export class PickPanel {
  readonly element = h("div", { class: "panel", role: "status", hidden: true });
  private readonly title = h("strong");
  private readonly rows = h("table");
  private readonly place: HTMLInputElement;
  private shown?: object;

  constructor(private readonly player: Player) {
    this.place = h("input", {
      type: "number", min: 0, max: 1, step: 0.01, "aria-label": "Fraction of the beam's length",
      onchange: () => this.move(),
    });
    const follow = h("input", { type: "checkbox", onchange: () => {
      player.following = follow.checked;
      player.refresh();
    } });
    this.element.append(
      h("div", { class: "head" }, this.title, button("×", "Forget the point", () => player.choose(undefined), "Esc")),
      h("label", {}, "at the fraction ", this.place), this.rows,
      h("label", { class: "tick" }, follow, "Camera follows"),
    );
  }

  private move(): void {
    const { spot, data } = this.player;
    const wanted = this.place.valueAsNumber;
    if (!spot || Number.isNaN(wanted)) return;
    this.player.choose(spotAt(data.scene.beams[spot.beam], spot.beam, Math.min(1, Math.max(0, wanted))));
  }

  update(): void {
    const { spot, data, moment, mode } = this.player;
    this.element.hidden = !spot;
    if (!spot) return;
    const beam = data.scene.beams[spot.beam];
    if (spot !== this.shown) {
      this.shown = spot;
      this.title.textContent = beam.name;
      this.place.value = String(Number(fraction(beam, spot).toFixed(4)));
    }
    const origin = data.scene.origin;
    const position = (place: number[]) => place.map((part) => quantityText(part, "m")).join(", ");
    const where = placeAt(moment.parts["station.place"], spot).toArray().map((part, axis) => part + origin[axis]);
    const rows = [["position", position(where)]];
    // The second run at the same place, beside the first one.
    const { comparison } = this.player;
    const other = comparison?.group.visible ? comparison.told(beam.name, fraction(beam, spot)) : undefined;
    if (other) rows[0].push(position(other.place));
    if (mode === undefined) {
      for (const { word, value, unit } of told(this.player.seen, spot, this.player.at())) {
        rows.push([LABELS[word] ?? word, quantityText(value, unit)]);
        if (other) rows.at(-1)!.push(quantityText(other.results.get(word) ?? NaN, unit));
      }
    }
    const row = ([name, ...values]: string[]) => h("tr", {}, h("th", { scope: "row" }, name), ...values.map((value, run) => h("td", { class: run === 1 ? "second" : undefined }, value)));
    this.rows.replaceChildren(...rows.map(row));
  }
}
