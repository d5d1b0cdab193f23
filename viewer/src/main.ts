// The page: reads its data, puts its parts together, shows what went wrong if something did.

import "uplot/dist/uPlot.min.css";
import "./style.css";
import { read } from "./data";
import { h } from "./dom";
import { Page } from "./ui";

async function main(): Promise<void> {
  const app = document.getElementById("app")!;
  try {
    const text = document.getElementById("data")!.textContent!;
    const page = new Page(await read(JSON.parse(text)), app);
    // For tests, and for whoever wants to look at the numbers in the console.
    (window as unknown as { ancf14: Page }).ancf14 = page;
  } catch (reason) {
    const words = reason instanceof Error ? reason.message : String(reason);
    const remedy = /webgl/i.test(words) ? "This browser has no WebGL: switch on hardware acceleration, or open the page in another browser." : "Open it in a browser of 2023 or later.";
    app.append(h("p", { class: "failure", role: "alert" }, `The page cannot be shown: ${words}. ${remedy}`));
  }
}

void main();
