// Sliders and number fields for all that can be set in a model.

import { button, h } from "./dom";
import type { ControlInfo } from "./solver";

/** So many controls need a search. */
const MANY = 12;
/** Groups that are open from the start: entries of [parameters] have no group. */
const OPEN = ["", "simulation"];

/** A slider spans the range of a number if that is not wider than so many times its value. */
const WIDE = 20;

/** The range of a slider: that of the number itself where it has one, else from 0 to twice the value, within the limits. */
export function sliderRange({ value, min, max, integer }: ControlInfo): [number, number] {
  if (min !== undefined && max !== undefined && max - min <= WIDE * Math.abs(value)) return [min, max];
  const reach = integer ? Math.max(2 * value, value + 4) : value === 0 ? 1 : 2 * value;
  const low = Math.max(min ?? -Infinity, value === 0 && !integer ? -reach : Math.min(0, reach));
  const high = Math.min(max ?? Infinity, Math.max(0, reach));
  return [low, high];
}

/** A number as it is typed: as short as it can be. */
export function typed(value: number): string {
  const size = Math.abs(value);
  return size !== 0 && (size >= 1e6 || size < 1e-3) ? value.toExponential().replace("e+", "e") : String(value);
}

class Control {
  readonly element: HTMLElement;
  private readonly field: HTMLInputElement;
  private readonly slider: HTMLInputElement;
  private readonly reset: HTMLButtonElement;

  constructor(readonly info: ControlInfo, short: string, private readonly changed: () => void) {
    const { name, unit, meaning, value } = info;
    const words = unit ? `${name}, ${unit}` : name;
    this.field = h("input", { type: "text", inputmode: "decimal", spellcheck: "false", autocomplete: "off", "aria-label": words, onchange: () => this.take(this.field.value), });
    this.slider = h("input", {
      type: "range", "aria-label": `${words}: slider`,
      oninput: () => (this.field.value = typed(Number(this.slider.valueAsNumber.toPrecision(4)))),
      onchange: () => this.take(this.field.value),
    });
    this.reset = button("↺", `Back to ${typed(value)}`, () => this.take(typed(value)));
    this.element = h("div", { class: "control", title: meaning, "data-name": name }, h("span", { class: "name" }, short), this.field, h("span", { class: "unit" }, unit), this.slider, this.reset);
    this.show(typed(value));
  }

  get text(): string {
    return this.field.value.trim();
  }

  get isChanged(): boolean {
    return this.text !== typed(this.info.value) && this.text !== "";
  }

  /** Shows a value that was typed; it may be anything: the solver says what is wrong with it. */
  show(text: string): void {
    this.field.value = text;
    this.mark(false);
    const value = Number(text);
    const [low, high] = sliderRange(this.info);
    const ends = Number.isFinite(value) ? [Math.min(low, value), Math.max(high, value)] : [low, high];
    this.slider.min = String(ends[0]);
    this.slider.max = String(ends[1]);
    this.slider.step = this.info.integer ? "1" : "any";
    this.slider.value = String(Number.isFinite(value) ? value : this.info.value);
    this.element.classList.toggle("changed", this.isChanged);
    this.reset.disabled = !this.isChanged;
  }

  /** Marks it as the one that a message is about. */
  mark(wrong: boolean): void {
    this.field.setAttribute("aria-invalid", String(wrong));
  }

  private take(text: string): void {
    this.show(text.trim() === "" ? typed(this.info.value) : text.trim());
    this.changed();
  }
}

export class Controls {
  readonly element = h("div", { class: "parameters" });
  private controls: Control[] = [];

  constructor(private readonly changed: () => void) {}

  /** Keys and values of all that is changed. */
  get changes(): [string, string][] {
    return this.controls.filter(({ isChanged }) => isChanged).map(({ info, text }) => [info.name, text]);
  }

  /** Keys and values of all numbers. */
  get values(): [string, string][] {
    return this.controls.map(({ info, text }) => [info.name, text]);
  }

  /** Shows the numbers of a model; values that were changed before stay where the model still has them. */
  show(infos: ControlInfo[]): void {
    const before = new Map(this.changes);
    const groups = new Map<string, Control[]>();
    this.controls = infos.map((info) => {
      const at = info.name.lastIndexOf(".");
      const group = at < 0 ? "" : info.name.slice(0, at);
      const control = new Control(info, info.name.slice(at + 1), this.changed);
      const changed = before.get(info.name);
      if (changed !== undefined) control.show(changed);
      groups.set(group, [...(groups.get(group) ?? []), control]);
      return control;
    });
    const closed = groups.size > 1 && (groups.has("") || groups.size > 3);
    const boxes = [...groups].map(([group, controls]) =>
      h("details", { class: "group", open: !closed || OPEN.includes(group) || controls.some(({ isChanged }) => isChanged) },
        h("summary", {}, group === "" ? "Parameters" : group), ...controls.map(({ element }) => element)));
    const search = h("input", {
      type: "search", placeholder: "Find a parameter", "aria-label": "Find a parameter",
      oninput: () => this.find(search.value, boxes),
    });
    this.element.replaceChildren(...(infos.length > MANY ? [search] : []), ...boxes);
  }

  /** Marks what a message is about. */
  mark(message: string): void {
    const names = [...message.matchAll(/`([^`]+)`/g)].map(([, name]) => name);
    for (const control of this.controls) {
      const wrong = names.includes(control.info.name) && control.isChanged;
      control.mark(wrong);
      if (wrong) control.element.closest("details")!.open = true;
    }
  }

  private find(words: string, boxes: HTMLDetailsElement[]): void {
    const wanted = words.trim().toLowerCase();
    for (const { info, element } of this.controls) element.hidden = !`${info.name} ${info.meaning}`.toLowerCase().includes(wanted);
    for (const box of boxes) {
      box.hidden = [...box.querySelectorAll<HTMLElement>(".control")].every(({ hidden }) => hidden);
      if (wanted && !box.hidden) box.open = true;
    }
  }
}
