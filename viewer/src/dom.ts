// Elements of the page, written as calls; text is always text, never HTML.

type Attributes = Record<string, string | number | boolean | ((event: any) => void) | undefined>;

/** An element with attributes (functions are listeners: `onclick`) and children. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K, attributes: Attributes = {}, ...children: (Node | string | undefined)[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== undefined && value !== false) element.setAttribute(name, String(value));
  }
  element.append(...children.filter((child) => child !== undefined));
  return element;
}

/** A button with a picture of one letter or sign, and words for whoever does not see it. */
export function button(sign: string, label: string, onclick: () => void, key?: string): HTMLButtonElement {
  const title = key ? `${label} (${key})` : label;
  return h("button", { type: "button", "aria-label": label, title, onclick }, sign);
}

/** A box to tick, with its words. */
export function tick(label: string, checked: boolean, onchange: (on: boolean) => void): HTMLLabelElement {
  const box = h("input", { type: "checkbox", onchange: () => onchange(box.checked) });
  box.checked = checked;
  return h("label", { class: "tick" }, box, label);
}

/** A list to choose from, with its words. */
export function choice(label: string, options: [string, string][], value: string, onchange: (value: string) => void): HTMLLabelElement {
  const list = h("select", { onchange: () => onchange(list.value) }, ...options.map(([key, text]) => h("option", { value: key }, text)));
  list.value = value;
  return h("label", { class: "choice" }, h("span", {}, label), list);
}

/** A slider with its words and the value in words. */
export function slider(
  label: string, [low, high, step]: [number, number, number], value: number, words: (value: number) => string, oninput: (value: number) => void,
): HTMLLabelElement {
  const told = h("output", {}, words(value));
  const input = h("input", {
    type: "range", min: low, max: high, step,
    oninput: () => {
      told.textContent = words(input.valueAsNumber);
      oninput(input.valueAsNumber);
    },
  });
  input.value = String(value);
  return h("label", { class: "slider" }, h("span", {}, label), input, told);
}

/** Hands a file to the reader, named after the model. */
export function save(url: string, model: string, ending: string): void {
  const name = model.replace(/[^\p{L}\p{N}]+/gu, "-").replace(/^-|-$/g, "") || "model";
  h("a", { href: url, download: `${name}.${ending}` }).click();
}

/** Says why the page cannot be shown, and what helps. */
export function unshown(reason: unknown): string {
  const words = reason instanceof Error ? reason.message : String(reason);
  const remedy = /webgl/i.test(words) ? "This browser has no WebGL: switch on hardware acceleration, or open the page in another browser." : "Open it in a browser of 2023 or later.";
  return `The page cannot be shown: ${words}. ${remedy}`;
}
