// The mechanism is dragged by the mouse or by a finger, while the solver in the page simulates, in a real browser from the disk: does the point follow the pointer, and leave it when it is
// released? Does the page show the messages of the solver, and the recorded run again at the end? Needs the program in the variable ANCF14, with ancf14.wasm next to it.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { ancf14, begin, end, folder, model, open, settle } from "./pages.mjs";

const SET = ["--set", "simulation.stop=0.1"];

before(async () => {
  await begin();
  ancf14("view", model("pendulum"), "--live", "-o", "pendulum.html");
  ancf14("view", model("crane"), "--live", "-o", "crane.html", ...SET);
});

after(end);

/** Starts to interact, and waits for the first picture. */
async function interact(page) {
  await page.waitForSelector(".control", { state: "attached", timeout: 30000 });
  await page.click("button.interact");
  await page.waitForFunction(() => window.ancf14.player.isLive, null, { timeout: 30000 });
}

/** Where the last thing of a track is on the screen, pixels. */
const last = (page, track) => page.evaluate((track) => {
  const { stage, moment } = window.ancf14.player;
  const places = moment.parts[track];
  const box = stage.canvas.getBoundingClientRect();
  const { x, y } = stage.project(stage.box.min.clone().fromArray(places, places.length - 3));
  return { x: x + box.left, y: y + box.top, time: window.ancf14.player.time };
}, track);
/** The free end of the last beam. */
const tip = (page) => last(page, "station.place");

/** Where the point that is held is on the screen, pixels: the knob at the end of the spring. */
const held = (page) => page.evaluate(() => {
  const { stage } = window.ancf14.player;
  const knob = stage.scene.children.find(({ isMesh, visible, material }) => isMesh && visible && material.color?.getHex() === 0xff2d78);
  if (!knob) return undefined;
  const box = stage.canvas.getBoundingClientRect();
  const { x, y } = stage.project(knob.position);
  return { x: x + box.left, y: y + box.top };
});

/** Waits until the run has gone on by a time, s. */
const goesOn = (page, since, time) => page.waitForFunction((until) => window.ancf14.player.time > until, since + time, { timeout: 60000 });
const apart = (one, other) => Math.hypot(one.x - other.x, one.y - other.y);
const camera = (page) => page.evaluate(() => JSON.stringify(window.ancf14.player.stage.pose));

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
  const pose = await camera(page);
  const from = await tip(page);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  // Up, where gravity would not bring it, in steps as a hand does.
  const target = { x: from.x - 60, y: from.y - 40 };
  await page.mouse.move(target.x, target.y, { steps: 8 });
  // Twenty times the time constant of the spring, from when the pointer has come to rest: a slow page hears late of its way.
  const arrived = await tip(page);
  await goesOn(page, arrived.time, 0.04);
  const pulled = await tip(page);
  const left = apart(pulled, target);
  const moved = apart(from, target);
  const status = await page.textContent(".interacting");
  assert.match(status, /^t = [\d.]+ s, [\d.e-]+ × real time.*Escape ends\.$/);
  // Slow motion has a stiff spring, which the weight does not stretch by a pixel; the point may still swing by some pixels.
  assert.ok(left < 0.2 * moved, `${left} pixels apart, ${moved} at first`);
  assert.equal(await camera(page), pose, "the drag has turned the camera");
  await page.mouse.up();
  await goesOn(page, pulled.time, 0.2);
  // Bent beams and the weight take it away from where the pointer held it.
  const free = await tip(page);
  const away = apart(free, target);
  assert.ok(away > 0.2 * moved && away > 2 * left, `${away} pixels away, ${left} when it was held`);
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

test("a body is dragged by the point of it that is pressed", async () => {
  const { page, close } = await open("crane.html");
  await page.evaluate(() => (window.ancf14.player.run.speed = 0.02));
  await interact(page);
  await settle(page);
  const pose = await camera(page);
  const from = await last(page, "body.place");
  // Its lower half is held by a point of the body, not by the end of the rope above.
  const low = { x: from.x, y: from.y + 25 };
  await page.mouse.move(low.x, low.y);
  await page.mouse.down();
  await settle(page);
  const [point, rope] = [await held(page), await tip(page)];
  assert.ok(apart(point, low) < 0.5 * apart(rope, low), `${apart(point, low)} pixels from the point that is held, ${apart(rope, low)} from the rope`);
  await page.mouse.up();
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  const target = { x: from.x + 50, y: from.y - 30 };
  await page.mouse.move(target.x, target.y, { steps: 8 });
  const arrived = await last(page, "body.place");
  await goesOn(page, arrived.time, 0.04);
  const moved = apart(from, target);
  const left = apart(await held(page), target);
  assert.ok(left < 0.2 * moved, `${left} pixels apart, ${moved} at first`);
  // The body comes along; it may turn about the point.
  const went = apart(await last(page, "body.place"), from);
  assert.ok(went > 0.5 * moved, `the body has moved by ${went} pixels, the pointer by ${moved}`);
  assert.equal(await camera(page), pose, "the drag has turned the camera");
  await page.mouse.up();
  await settle(page);
  assert.equal(await held(page), undefined, "the body is still held");
  await page.keyboard.press("Escape");
  await page.waitForFunction(() => !window.ancf14.player.isLive, null, { timeout: 10000 });
  await close();
});

test("a finger drags a point and does not turn the camera; beside the mechanism it does", async () => {
  const { page, close } = await open("pendulum.html", { hasTouch: true, isMobile: true, viewport: { width: 390, height: 800 } });
  await page.evaluate(() => {
    window.ancf14.player.run.speed = 0.02;
    document.querySelector(".live").open = true;
  });
  await interact(page);
  await settle(page);
  // The picture has come into sight.
  const scrolled = await page.evaluate(() => window.scrollY);
  assert.ok(scrolled > 0);
  const hand = await page.context().newCDPSession(page);
  const touch = (type, ...points) => hand.send("Input.dispatchTouchEvent", { type, touchPoints: points });
  const slide = async (from, to) => {
    await touch("touchStart", from);
    for (let k = 1; k <= 8; k++) await touch("touchMove", { x: from.x + ((to.x - from.x) * k) / 8, y: from.y + ((to.y - from.y) * k) / 8 });
  };
  const pose = await camera(page);
  const { x, y } = await tip(page);
  const target = { x: x - 40, y: y - 40 };
  await slide({ x, y }, target);
  const arrived = await tip(page);
  await goesOn(page, arrived.time, 0.04);
  const moved = apart({ x, y }, target);
  const left = apart(await held(page), target);
  assert.ok(left < 0.2 * moved, `${left} pixels apart, ${moved} at first`);
  assert.equal(await camera(page), pose, "the drag has turned the camera");
  assert.equal(await page.evaluate(() => window.scrollY), scrolled, "the drag has scrolled the page");
  await touch("touchEnd");
  await settle(page);
  assert.equal(await held(page), undefined, "the point is still held");
  // A corner of the picture has nothing to take hold of.
  const box = await page.locator("canvas").first().boundingBox();
  const corner = { x: box.x + 0.5 * box.width, y: box.y + box.height - 12 };
  await slide(corner, { x: corner.x - 60, y: corner.y });
  await touch("touchEnd");
  await settle(page);
  assert.notEqual(await camera(page), pose, "a finger beside the mechanism does not turn the camera");
  await page.keyboard.press("Escape");
  await page.waitForFunction(() => !window.ancf14.player.isLive, null, { timeout: 10000 });
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
