// Two runs in one page, in a real browser: does the second one appear as a ghost at the same instant, at its own place, with its lines in the charts and its values in the panel; does it wait where
// it has ended, and go away when it is not wanted? Needs the program in the variable ANCF14.

import assert from "node:assert/strict";
import { copyFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { ancf14, begin, end, folder, model, open, settle, table } from "./pages.mjs";

const SOFT = ["--set", "steel.young=7e10"];
const seek = async (page, to) => {
  await page.evaluate((to) => window.ancf14.player.timeline.seek(to), to);
  await settle(page);
};

before(async () => {
  await begin();
  // The second run is softer, ends later and has other rows.
  const [short, long] = [["--set", "simulation.stop=0.3"], ["--set", "simulation.stop=0.5", "--set", "simulation.output_step=0.004", ...SOFT]];
  ancf14("run", model("cantilever"), "-o", "stiff", "--view", ...short);
  ancf14("run", model("cantilever"), "-o", "soft", "--view", ...long);
  ancf14("view", "stiff", "soft", "-o", "both.html");
});

after(end);

/** Where the tips of both runs are now, global, m. */
const tips = (page) => page.evaluate(() => {
  const { player } = window.ancf14;
  const { comparison, data } = player;
  const own = [...player.moment.parts["station.place"].slice(-3)].map((part, axis) => part + data.scene.origin[axis]);
  return { first: own, second: comparison.told("arm", 1).place, drawn: comparison.group.visible };
});

/** A column of a run's results at a time, m. */
function at(run, name, time) {
  const columns = table(`${run}/results.csv`);
  const row = columns("time").findIndex((own) => Math.abs(own - time) < 1e-9);
  assert.ok(row >= 0, `${run} has no row at ${time}`);
  return columns(name)[row];
}

/** The accuracy of positions in the page, m: docs/viewer/data.md has 1e-5 of the extent, here 1 m; and those of the first run are single precision. */
const EXACT = 2e-5;

test("the second run is a ghost at the same instant, and stays where it ends", async () => {
  const { page, close } = await open("both.html");
  for (const time of [0, 0.1, 0.2]) {
    await seek(page, time);
    const { first, second, drawn } = await tips(page);
    assert.ok(drawn);
    for (const [run, tip] of [["stiff", first], ["soft", second]]) {
      const expected = [1 + at(run, "tip.displacement[1]", time), 0, at(run, "tip.displacement[3]", time)];
      tip.forEach((value, axis) => assert.ok(Math.abs(value - expected[axis]) < EXACT, `${run} at ${time}: ${tip}, ${expected}`));
    }
  }
  // The time axis is that of both; the first run has ended at 0.3 s.
  const { end } = await page.evaluate(() => ({ end: window.ancf14.player.run.end }));
  assert.ok(Math.abs(end - 0.5) < 1e-12);
  await seek(page, 0.4);
  const { first, second } = await tips(page);
  assert.ok(Math.abs(first[2] - at("stiff", "tip.displacement[3]", 0.3)) < EXACT);
  assert.ok(Math.abs(second[2] - at("soft", "tip.displacement[3]", 0.4)) < EXACT);
  await close();
});

test("the ghost changes the picture, and can be switched off by box and key", async () => {
  const { page, close } = await open("both.html");
  await seek(page, 0.1);
  const tinted = () => page.evaluate(async () => {
    const picture = new Image();
    picture.src = window.ancf14.player.stage.png("#ffffff");
    await picture.decode();
    const canvas = Object.assign(document.createElement("canvas"), { width: picture.width, height: picture.height });
    const paper = canvas.getContext("2d", { willReadFrequently: true });
    paper.drawImage(picture, 0, 0);
    const { data } = paper.getImageData(0, 0, canvas.width, canvas.height);
    let count = 0;
    // Magenta: red and blue above green.
    for (let at = 0; at < data.length; at += 4) if (data[at] - data[at + 1] > 40 && data[at + 2] - data[at + 1] > 25) count++;
    return count;
  });
  const box = page.locator("label.tick", { hasText: "Second run" }).locator("input");
  assert.ok(await box.isChecked());
  const shown = await tinted();
  assert.ok(shown > 200, `${shown} pixels`);
  await box.click();
  await settle(page);
  assert.equal(await tinted(), 0);
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press("b");
  await settle(page);
  assert.ok((await tinted()) > 200);
  await close();
});

test("charts of the same name have both runs, with all their rows", async () => {
  const { page, close } = await open("both.html");
  await page.waitForSelector("[data-chart='tip.displacement'] .u-over");
  await seek(page, 0.1);
  const legend = page.locator("[data-chart='tip.displacement'] .u-series");
  assert.deepEqual(await legend.locator(".u-label").allTextContents(), ["t", "x", "y", "z", "x 2nd", "y 2nd", "z 2nd"]);
  const values = (await legend.locator(".u-value").allTextContents()).map((text) => Number(text.replace("−", "-")));
  // Four digits are shown.
  for (const [run, place] of [["stiff", 3], ["soft", 6]]) {
    const expected = at(run, "tip.displacement[3]", 0.1);
    assert.ok(Math.abs(values[place] - expected) <= 5e-4 * Math.abs(expected), `${run}: ${values}, ${expected}`);
  }
  const charted = await page.evaluate(() => [...window.ancf14.data.second.data.charts.columns.find(({ name }) => name === "tip.displacement[3]").values]);
  assert.deepEqual(charted, table("soft/results.csv")("tip.displacement[3]"));
  await close();
});

test("a click on a beam tells the values of both runs", async () => {
  const { page, close } = await open("both.html");
  await seek(page, 0.1);
  await page.evaluate(() => window.ancf14.player.choose({ beam: 0, station: 0, share: 0 }));
  await settle(page);
  const cells = await page.locator(".panel tr", { hasText: "curvature y" }).locator("td").allTextContents();
  assert.equal(cells.length, 2);
  for (const [place, run] of ["stiff", "soft"].entries()) {
    const expected = at(run, "root_section.curvature[1]", 0.1);
    const most = Math.max(...table(`${run}/results.csv`)("root_section.curvature[1]").map(Math.abs));
    // Four digits, of data in steps of 1.5e-5 of the largest value.
    assert.ok(Math.abs(parseFloat(cells[place].replace("−", "-")) - expected) < 5e-4 * most, `${run}: ${cells}, ${expected}`);
  }
  assert.deepEqual(await page.locator(".runs .name").allTextContents(), ["stiff", "soft"]);
  await close();
});

test("names of runs are text, and a narrow page holds them", async () => {
  copyFileSync(join(folder, "soft/view.html"), join(folder, "<img src=x>.html"));
  ancf14("view", model("cantilever"), "<img src=x>.html", "-o", "named.html", "--set", "simulation.stop=0.02");
  const { page, close } = await open("named.html", { viewport: { width: 390, height: 800 }, colorScheme: "dark" });
  const names = await page.locator(".runs .name").allTextContents();
  assert.ok(names[0].endsWith("cantilever.toml, simulation.stop = 0.02"), names[0]);
  assert.equal(names[1], "<img src=x>.html");
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  await close();
});
