// The mechanism is dragged by the mouse, while the solver in the page simulates, in a real browser from the disk: does the point follow the pointer, and leave it when it is released?
// Does the page show the messages of the solver, and the recorded run again at the end? Needs the program in the variable ANCF14, with ancf14.wasm next to it.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { ancf14, begin, end, folder, model, open, settle } from "./pages.mjs";

const SET = ["--set", "simulation.stop=0.1"];

before(async () => {
  await begin();
  ancf14("view", model("pendulum"), "--live", "-o", "pendulum.html");
});

after(end);

/** Starts to interact, and waits for the first picture. */
async function interact(page) {
  await page.waitForSelector(".control", { state: "attached", timeout: 30000 });
  await page.click("button.interact");
  await page.waitForFunction(() => window.ancf14.player.isLive, null, { timeout: 30000 });
}

/** Where the last station of the last beam is on the screen, pixels, and in space, m. */
const tip = (page) => page.evaluate(() => {
  const { stage, moment } = window.ancf14.player;
  const places = moment.parts["station.place"];
  const point = stage.box.min.clone().fromArray(places, places.length - 3);
  const box = stage.canvas.getBoundingClientRect();
  const { x, y } = stage.project(point);
  return { x: x + box.left, y: y + box.top, z: point.z, time: window.ancf14.player.time };
});

test("a point that is dragged follows the pointer and swings away when it is released", async () => {
  const { page, close } = await open("pendulum.html");
  // Slow motion: at real time the point would have fallen away before the mouse is pressed.
  await page.evaluate(() => (window.ancf14.player.run.speed = 0.02));
  await interact(page);
  await settle(page);
  await page.evaluate(() => {
    window.longest = 0;
    new PerformanceObserver((list) => list.getEntries().forEach(({ duration }) => (window.longest = Math.max(window.longest, duration)))).observe({ entryTypes: ["longtask"] });
  });
  const camera = () => page.evaluate(() => JSON.stringify(window.ancf14.player.stage.pose));
  const pose = await camera();
  const from = await tip(page);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  // Up, where gravity would not bring it, in steps as a hand does.
  const target = { x: from.x - 60, y: from.y - 40 };
  await page.mouse.move(target.x, target.y, { steps: 8 });
  // Twenty times the time constant of the spring, from when the pointer has come to rest: a slow page hears late of its way.
  const arrived = await tip(page);
  await page.waitForFunction((since) => window.ancf14.player.time > since + 0.04, arrived.time, { timeout: 60000 });
  const held = await tip(page);
  const apart = Math.hypot(held.x - target.x, held.y - target.y);
  const moved = Math.hypot(from.x - target.x, from.y - target.y);
  const status = await page.textContent(".interacting");
  assert.match(status, /^t = [\d.]+ s, [\d.e-]+ × real time.*Escape ends\.$/);
  // Slow motion has a stiff spring, which the weight does not stretch by a pixel; the point may still swing by some pixels.
  assert.ok(apart < 0.2 * moved, `${apart} pixels apart, ${moved} at first`);
  assert.equal(await camera(), pose, "the drag has turned the camera");
  await page.mouse.up();
  await page.waitForFunction((since) => window.ancf14.player.time > since + 0.2, held.time, { timeout: 60000 });
  // Bent beams and the weight take it away from where the pointer held it.
  const free = await tip(page);
  const away = Math.hypot(free.x - target.x, free.y - target.y);
  assert.ok(away > 0.2 * moved && away > 2 * apart, `${away} pixels away, ${apart} when it was held`);
  const longest = await page.evaluate(() => window.longest);
  // Printed, not bounded: it includes the scripts of this test, and depends on what else the computer does.
  console.log(`${status}\nlongest task of the page while it is dragged: ${longest ? `${longest.toFixed(0)} ms` : "below 50 ms"}`);
  // The keyboard ends it; the recorded run is back.
  await page.keyboard.press("Escape");
  await page.waitForFunction(() => !window.ancf14.player.isLive, null, { timeout: 10000 });
  assert.equal(await page.textContent("button.interact"), "Interact");
  assert.equal(await page.evaluate(() => window.ancf14.player.time), 0);
  await close();
});

test("a run that cannot go on pauses and says why", async () => {
  const text = readFileSync(model("pendulum"), "utf8");
  writeFileSync(join(folder, "late.toml"), `${text}\n[load.late]\nat = "lower.end"\nforce = [0, 0, "sqrt(0.2 - t)"]\n`);
  ancf14("view", "late.toml", "--live", "-o", "late.html", ...SET);
  const { page, close } = await open("late.html");
  // A short run is slow motion.
  await page.evaluate(() => (window.ancf14.player.run.speed = 1));
  await interact(page);
  await page.waitForSelector(".told .error", { timeout: 30000 });
  assert.equal(await page.textContent("button.interact"), "Continue");
  assert.match(await page.textContent(".interacting"), /^Paused: /);
  assert.match(await page.textContent(".told .error"), /late/);
  // It fails again at the same instant, and ends when it is told to.
  await page.click("button.interact");
  await page.waitForSelector(".told .error", { timeout: 30000 });
  await page.keyboard.press("Escape");
  await page.waitForFunction(() => !window.ancf14.player.isLive, null, { timeout: 10000 });
  await close();
});

test("of a static analysis the page says that there is nothing to drag", async () => {
  ancf14("view", model("elastica"), "--live", "-o", "static.html");
  const { page, close } = await open("static.html");
  await page.waitForSelector(".control", { state: "attached", timeout: 30000 });
  await page.click("button.interact");
  assert.match(await page.textContent(".told"), /^There is nothing to drag: a static analysis has no motion\./);
  await close();
});
