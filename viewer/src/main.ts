// The page: reads its data, puts its parts together, shows what went wrong if something did. Where the page brings the solver, or the program
// watches the model, each run takes the place of the one before.

import "uplot/dist/uPlot.min.css";
import "./style.css";
import { chosen } from "./carry";
import { read, readSecond } from "./data";
import { h, unshown } from "./dom";
import type { PageInfo } from "./format";
import { Live } from "./live";
import { Page } from "./ui";
import { Watch } from "./watch";

const text = (id: string) => document.getElementById(id)?.textContent ?? undefined;

async function main(): Promise<void> {
  const app = document.getElementById("app")!;
  const host = h("div", { class: "page" });
  app.append(host);
  // For tests, and for whoever wants to look at the numbers in the console.
  const global = window as unknown as { ancf14: Page };
  const compared = text("second");
  const show = async (info: PageInfo) => {
    const data = await read(info);
    // Each run takes the place of the first one; the second one stays.
    if (compared) data.second = await readSecond(JSON.parse(compared));
    const choose = global.ancf14 && chosen(global.ancf14);
    global.ancf14?.dispose();
    host.replaceChildren();
    global.ancf14 = new Page(data, host);
    choose?.(global.ancf14);
  };
  try {
    const model = text("live");
    if (model) app.prepend(new Live(JSON.parse(model), text("solver")!, show).element);
    const data = text("data");
    // A page without data is served by a program that has them.
    if (data) await show(JSON.parse(data));
    else app.append(new Watch(show).element);
  } catch (reason) {
    app.append(h("p", { class: "failure", role: "alert" }, unshown(reason)));
  }
}

void main();
