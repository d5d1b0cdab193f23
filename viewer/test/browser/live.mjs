// The page that brings its solver, in a real browser, from the disk: does a changed parameter give the numbers that the program gives with the same `--set`? Does the page tell what the
// solver says, stop when it is told to, stay awake meanwhile, and ask for nothing? Needs the program in the variable ANCF14, with ancf14.wasm next to it.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { ancf14, begin, end, folder, model, open, settle, table } from "./pages.mjs";

const SET = ["--set", "simulation.stop=0.1"];

/** Where a library of sines, roots and powers rounds differently, results differ by some units of the last place; Newton's tolerance is the bound (wasm.mjs). */
const BOUND = 1e-8;

/** The last value of an output that the page charts. */
const last = (page, name) => page.evaluate((name) => window.ancf14.data.charts.columns.find((column) => column.name === name).values.at(-1), name);

/** Waits until the controls are there. */
const ready = (page) => page.waitForSelector(".control", { state: "attached", timeout: 30000 });

/** Opens the groups of controls and types a value. */
async function type(page, name, value) {
  await page.evaluate(() => document.querySelectorAll(".group").forEach((group) => (group.open = true)));
  const field = page.locator(`.control[data-name="${name}"] input[type=text]`);
  await field.fill(value);
  await field.press("Enter");
}

/** Starts a run and waits for its end. */
async function run(page) {
  await page.evaluate(() => (window.before = window.ancf14));
  await page.click("button.run");
  await page.waitForFunction(() => window.ancf14 !== window.before || document.querySelector(".error"), null, { timeout: 60000 });
  await page.waitForSelector("button.stop", { state: "hidden" });
  await settle(page);
}

/** A solver that tells of a model without numbers and ends as soon as it is to simulate it, with these last words: a module of WebAssembly, byte by byte. */
function broken(mark, words) {
  const reply = [...new TextEncoder().encode(JSON.stringify({ description: { rows: 1, controls: [] }, panic: words }))];
  const count = (number) => (number < 128 ? [number] : [(number & 127) | 128, ...count(number >> 7)]);
  const signed = (number) => (number < 64 ? [number] : [(number & 127) | 128, ...signed(number >> 7)]);
  const text = (word) => [...count(word.length), ...new TextEncoder().encode(word)];
  const list = (items) => [...count(items.length), ...items.flat()];
  const section = (kind, content) => [kind, ...count(content.length), ...content];
  const [i32, constant, unreachable, end] = [0x7f, 0x41, 0x00, 0x0b];
  const types = [[0x60, 0, 0], [0x60, 1, i32, 1, i32], [0x60, 0, 1, i32], [0x60, 1, i32, 0]];
  const functions = { request: [1, constant, ...signed(4096)], reply: [2, constant, 16], reply_length: [2, constant, ...signed(reply.length)], describe: [0], begin: [0, unreachable], advance: [1, constant, 2], finish: [3] };
  const names = Object.keys(functions);
  const body = ([, ...code]) => [...count(code.length + 2), 0, ...code, end];
  return Buffer.from([
    0, ...text("asm").slice(1), 1, 0, 0, 0,
    ...section(0, [...text("mark"), ...new TextEncoder().encode(mark)]),
    ...section(1, list(types)),
    ...section(3, list(Object.values(functions).map(([type]) => [type]))),
    ...section(5, list([[0, 2]])),
    ...section(7, list([...names.map((name, k) => [...text(name), 0, k]), [...text("memory"), 2, 0]])),
    ...section(10, list(Object.values(functions).map(body))),
    ...section(11, list([[0, constant, 16, end, ...count(reply.length), ...reply]])),
  ]);
}

before(async () => {
  await begin();
  ancf14("view", model("cantilever"), "--live", "-o", "live.html", ...SET);
});

after(end);

test("a number that is typed and a slider that is moved give what the program gives", async () => {
  const { page, close } = await open("live.html");
  await ready(page);
  await type(page, "steel.young", "7e10");
  const slider = page.locator('.control[data-name="steel.density"] input[type=range]');
  await slider.evaluate((input) => {
    input.value = "5000";
    input.dispatchEvent(new Event("input"));
    input.dispatchEvent(new Event("change"));
  });
  const before = await last(page, "tip.displacement[3]");
  await run(page);
  const words = ["--set", "steel.young=7e10", "--set", "steel.density=5000"];
  ancf14("run", model("cantilever"), "-o", "changed", ...SET, ...words);
  const wanted = table("changed/results.csv")("tip.displacement[3]").at(-1);
  const found = await last(page, "tip.displacement[3]");
  assert.ok(Math.abs(found - wanted) <= BOUND * Math.abs(wanted), `${found}, ${wanted}`);
  assert.ok(Math.abs(found - before) > 0.01 * Math.abs(before), "nothing has changed");
  // The command that the page shows is the one that was just tried.
  assert.match(await page.textContent(".command code"), /--set simulation\.stop=0\.1 --set steel\.young=7e10 --set steel\.density=5000$/);
  await page.click('.control[data-name="steel.young"] button');
  assert.equal(await page.inputValue('.control[data-name="steel.young"] input[type=text]'), "2.1e11");
  await close();
});

test("the next run keeps what the reader has chosen", async () => {
  const { page, close } = await open("live.html");
  await ready(page);
  await page.evaluate(() => (document.querySelector(".controls").open = true));
  await settle(page);
  await page.selectOption("[data-control=color] select", "speed");
  await page.keyboard.press("2");
  await page.evaluate(() => window.ancf14.player.timeline.seek(0.05));
  await settle(page);
  const chosen = () => page.evaluate(() => ({ ...window.ancf14.player.stage.pose, time: window.ancf14.player.timeline.time, color: window.ancf14.player.quantity.word }));
  const before = await chosen();
  await type(page, "steel.density", "7000");
  await run(page);
  const after = await chosen();
  // The camera turns its place into angles and back.
  const far = ["position", "target"].flatMap((name) => before[name].map((part, axis) => Math.abs(part - after[name][axis])));
  assert.ok(Math.max(...far) < 1e-9, JSON.stringify([before, after]));
  assert.deepEqual([after.time, after.color, after.zoom], [0.05, "speed", before.zoom]);
  await close();
});

test("mistakes are told with their control, and with their line", async () => {
  const { page, close } = await open("live.html");
  await ready(page);
  await type(page, "steel.young", "-1");
  await run(page);
  assert.match(await page.textContent(".error"), /`steel\.young` must be greater than 0[^]*in the changes to the model file[^]*steel\.young=-1/);
  assert.equal(await page.getAttribute('.control[data-name="steel.young"] input[type=text]', "aria-invalid"), "true");
  await page.click('.control[data-name="steel.young"] button');
  // The text of the model can be edited too.
  const text = readFileSync(model("cantilever"), "utf8").replace("poisson", "poison");
  await page.evaluate(() => (document.querySelector(".source").open = true));
  await page.fill(".source textarea", text);
  await run(page);
  const line = text.split("\n").findIndex((words) => words.includes("poison")) + 1;
  const told = await page.textContent(".error");
  assert.ok(told.includes(`cantilever.toml:${line}:`), told);
  await page.click(".told button");
  const selected = await page.evaluate(() => {
    const { value, selectionStart, selectionEnd } = document.querySelector(".source textarea");
    return value.slice(selectionStart, selectionEnd);
  });
  assert.ok(selected.includes("poison"), selected);
  // After all that the page still simulates.
  await page.fill(".source textarea", text.replace("poison", "poisson").replace('name = "Cantilever"', 'name = "Second"'));
  await run(page);
  assert.equal(await page.textContent("h1"), "Second");
  await close();
});

test("a long run shows how far it is, leaves the page awake, and stops", async () => {
  const { page, close } = await open("live.html");
  await ready(page);
  await type(page, "arm.elements", "64");
  await type(page, "simulation.stop", "30");
  await page.evaluate(() => {
    window.before = window.ancf14;
    window.longest = 0;
    new PerformanceObserver((list) => list.getEntries().forEach(({ duration }) => (window.longest = Math.max(window.longest, duration)))).observe({ entryTypes: ["longtask"] });
  });
  await page.click("button.run");
  await page.waitForFunction(() => document.querySelector("progress").value > 0.001, null, { timeout: 60000 });
  const shares = [];
  for (let k = 0; k < 10; k++) {
    shares.push(await page.evaluate(() => document.querySelector("progress").value));
    await page.waitForTimeout(100);
  }
  assert.ok(shares.at(-1) > shares[0], String(shares));
  const longest = await page.evaluate(() => window.longest);
  console.log(`longest task of the page during a run: ${longest ? `${longest.toFixed(0)} ms` : "below 50 ms"}`);
  // A task of 200 ms is what a reader notices.
  assert.ok(longest < 200, `${longest} ms`);
  await page.click("button.stop");
  await page.waitForFunction(() => window.ancf14 !== window.before, null, { timeout: 10000 });
  await settle(page);
  assert.match(await page.textContent(".note"), /^The run was stopped at t = /);
  assert.ok((await page.evaluate(() => window.ancf14.data.times.at(-1))) < 30);
  await close();
});

test("a solver that ends on an error of its own is told, and the page goes on", async () => {
  const version = ancf14("--version").trim();
  const words = `the solver of ${version} for the page stopped on an internal error: index out of bounds`;
  writeFileSync(join(folder, "broken.wasm"), broken(`the solver of ${version} for the page`, words));
  ancf14("view", model("cantilever"), "--live=broken.wasm", "-o", "broken.html", ...SET);
  const { page, close } = await open("broken.html");
  for (let round = 0; round < 2; round++) {
    await page.click("button.run");
    await page.waitForSelector(".error", { timeout: 10000 });
    assert.equal(await page.textContent(".error"), words);
  }
  const opened = await page.evaluate(() => window.ancf14.player.timeline.time);
  await page.click("button.play");
  await page.waitForFunction((opened) => window.ancf14.player.timeline.time !== opened, opened);
  await close();
});

test("a run that fails is shown as far as it came, with what the solver says", async () => {
  try {
    ancf14("view", model("ring"), "--live", "-o", "ring.html", "--set", "rod.element=ancf24");
  } catch (reason) {
    assert.equal(reason.status, 1);
  }
  const { page, close } = await open("ring.html");
  await ready(page);
  const instants = await page.evaluate(() => window.ancf14.data.times.length);
  const note = await page.textContent(".note");
  await page.evaluate(() => (window.before = window.ancf14));
  await page.click("button.run");
  await page.waitForFunction(() => window.ancf14 !== window.before, null, { timeout: 60000 });
  await settle(page);
  assert.equal(await page.evaluate(() => window.ancf14.data.times.length), instants);
  // The size of the last correction is noise: all up to it is the same.
  const reason = (text) => text.slice(0, text.indexOf("the last correction"));
  assert.ok(reason(note).startsWith("The run ended early, at t = "), note);
  assert.equal(reason(await page.textContent(".note")), reason(note));
  assert.match(await page.textContent(".error"), /^error: /);
  await close();
});

test("names with HTML in them are text, in the model too", async () => {
  const name = "</script><script>document.title='harm'</script><b>bold</b>";
  const text = readFileSync(model("cantilever"), "utf8").replace('name = "Cantilever"', `name = "${name}"`);
  writeFileSync(join(folder, "named.toml"), text);
  ancf14("view", "named.toml", "--live", "--set", "simulation.stop=0.02");
  const { page, close } = await open("named.html");
  await ready(page);
  await run(page);
  assert.equal(await page.textContent("h1"), name);
  assert.equal(await page.title(), name);
  assert.equal(await page.inputValue(".source textarea"), text);
  await close();
});

test("light and dark, wide and narrow: nothing sticks out", async () => {
  for (const [width, colorScheme] of [[1280, "dark"], [390, "light"]]) {
    const { page, close } = await open("live.html", { viewport: { width, height: 800 }, colorScheme });
    await ready(page);
    await page.evaluate(() => document.querySelectorAll(".live, .group, .source").forEach((box) => (box.open = true)));
    await settle(page);
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)) <= 0);
    await close();
  }
});
