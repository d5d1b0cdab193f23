// The page in a real browser, from the disk: does it load without a complaint and without asking for anything, play, seek, pick, color, swing; does it show the
// numbers of the solver? Needs the program in the variable ANCF14.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { ancf14, begin, end, folder, model, open, settle, table } from "./pages.mjs";

const time = (page) => page.evaluate(() => window.ancf14.player.timeline.time);
const seek = async (page, to) => {
  await page.evaluate((to) => window.ancf14.player.timeline.seek(to), to);
  await settle(page);
};

before(async () => {
  await begin();
  ancf14("view", model("cantilever"), "--modes=4", "--set", "simulation.stop=0.5");
  ancf14("run", model("cantilever"), "-o", "out", "--set", "simulation.stop=0.5");
  ancf14("modes", model("cantilever"), "-o", "out", "--count", "4");
});

after(end);

test("plays, pauses, steps and scrubs, by button and by key", async () => {
  const { page, close } = await open("cantilever.html");
  await page.keyboard.press("Home");
  assert.equal(await time(page), 0);
  await page.click("button.play");
  await page.waitForFunction(() => window.ancf14.player.timeline.time > 0.01);
  await page.keyboard.press("Space");
  // The play button has the focus: Space is its own.
  assert.equal(await page.evaluate(() => window.ancf14.player.timeline.playing), false);
  const stopped = await time(page);
  await page.waitForTimeout(150);
  assert.equal(await time(page), stopped);
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press("Home");
  await page.keyboard.press("ArrowRight");
  assert.ok(Math.abs((await time(page)) - 0.005) < 1e-12);
  await page.keyboard.press("End");
  assert.ok(Math.abs((await time(page)) - 0.5) < 1e-12);
  await page.locator("input.scrub").fill("400");
  assert.ok(Math.abs((await time(page)) - 0.2) < 1e-9);
  await settle(page);
  assert.match(await page.textContent(".clock"), /t = 0\.200 s/);
  await close();
});

test("a motion opens where it is deformed most, and plays if its address asks for it", async () => {
  const still = await open("cantilever.html");
  const found = await still.page.evaluate(() => {
    const { values, things } = window.ancf14.data.tracks.get("station.place");
    const { times } = window.ancf14.data;
    return { playing: window.ancf14.player.run.playing, tips: [...times].map((time, instant) => [time, values[3 * (instant * things + things - 1) + 2]]) };
  });
  assert.equal(found.playing, false);
  const lowest = Math.min(...found.tips.map(([, tip]) => tip));
  const opened = await time(still.page);
  const [, tip] = found.tips.find(([at]) => at === opened);
  // The stress has vibrations of the second mode in it: the tip hangs nearly as low as it ever does.
  assert.ok(tip < 0.8 * lowest, `${tip} of ${lowest} m at t = ${opened} s`);
  await still.close();
  for (const reducedMotion of ["no-preference", "reduce"]) {
    const { page, close } = await open("cantilever.html", { hash: "#play", reducedMotion });
    assert.equal(await page.evaluate(() => window.ancf14.player.run.playing), reducedMotion !== "reduce", reducedMotion);
    await close();
  }
});

test("charts of a mechanism at rest are lines at zero", async () => {
  ancf14("view", model("crane"), "-o", "rest.html", "--set", "simulation.stop=0.5");
  ancf14("run", model("crane"), "-o", "rest", "--set", "simulation.stop=0.5");
  // The solver leaves round-off, which the table keeps.
  const size = (values) => Math.max(...values.map(Math.abs));
  const left = size(table("rest/results.csv")("load_motion.velocity[3]"));
  assert.ok(left > 0 && left < 1e-9, `${left} m/s`);
  const { page, close } = await open("rest.html");
  const found = await page.evaluate(() => {
    const { columns } = window.ancf14.data.charts;
    const { values } = window.ancf14.data.tracks.get("speed");
    return { charted: [...columns.find(({ name }) => name === "load_motion.velocity[3]").values], position: columns.find(({ name }) => name === "load_motion.position[1]").values[0], speed: [...values] };
  });
  assert.deepEqual([size(found.charted), size(found.speed)], [0, 0]);
  assert.ok(found.position > 1, "what is not zero is charted as it is");
  await close();
});

test("every key of the list does something, and ? shows and hides the list", async () => {
  const { page, close } = await open("cantilever.html");
  await page.keyboard.press("?");
  assert.equal(await page.isVisible("dialog.help"), true);
  const shown = await page.locator("dialog.help kbd").allTextContents();
  for (const key of ["Space", "L", "F", "G", "M", "?"]) assert.ok(shown.includes(key), key);
  // There is one run only.
  assert.ok(!shown.includes("B"));
  await page.keyboard.press("?");
  assert.equal(await page.isVisible("dialog.help"), false);
  await page.keyboard.press("End");
  const state = () => page.evaluate(() => {
    const { player } = window.ancf14;
    const { run, stage, quantity } = player;
    return JSON.stringify([run.time, run.playing, run.speed, run.looping, stage.pose, stage.isParallel, quantity?.word, [...document.querySelectorAll("label.tick input")].map(({ checked }) => checked)]);
  });
  const names = { "←": "ArrowLeft", "→": "ArrowRight", "−": "-" };
  // Space plays, which changes the time for all that follow; the view that is shown, saving, and forgetting nothing change nothing here.
  const quiet = ["Space", "F", "M", "V", "Esc", "?"];
  await page.keyboard.press("4");
  for (const key of shown.filter((key) => !quiet.includes(key))) {
    const before = await state();
    await page.keyboard.press(names[key] ?? key);
    assert.notEqual(await state(), before, `${key} does nothing`);
  }
  await close();
});

test("the mechanism of an instant is saved as glTF", async () => {
  const { page, close } = await open("cantilever.html");
  const [file] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("m")]);
  assert.equal(file.suggestedFilename(), "Cantilever.glb");
  const bytes = readFileSync(await file.path());
  assert.deepEqual([bytes.toString("latin1", 0, 4), bytes.readUInt32LE(4), bytes.readUInt32LE(8)], ["glTF", 2, bytes.length]);
  const { meshes, accessors } = JSON.parse(bytes.toString("utf8", 20, 20 + bytes.readUInt32LE(12)));
  const arm = meshes.find(({ name }) => name === "arm").primitives[0];
  const { min, max } = accessors[arm.attributes.POSITION];
  assert.ok(arm.attributes.COLOR_0 !== undefined && max[0] > 0.98 && min[2] < -0.02, JSON.stringify({ min, max }));
  await close();
});

test("a click into a chart goes to that instant, and the legend reads values", async () => {
  const { page, close } = await open("cantilever.html");
  await page.waitForSelector("[data-chart] .u-over");
  const over = page.locator("[data-chart] .u-over").first();
  const { width, height } = await over.boundingBox();
  await over.click({ position: { x: 0.6 * width, y: height / 2 } });
  assert.ok(Math.abs((await time(page)) - 0.3) < 0.005, String(await time(page)));
  await page.mouse.move(5, 795);
  await settle(page);
  const read = Number((await page.locator("[data-chart]").first().locator(".u-series .u-value").nth(3).textContent()).replace("−", "-"));
  const columns = table("out/results.csv");
  const row = columns("time").reduce((best, at, k, all) => (Math.abs(at - 0.3) < Math.abs(all[best] - 0.3) ? k : best), 0);
  const near = columns("tip.displacement[3]").slice(row - 1, row + 2);
  assert.ok(near.some((value) => Math.abs(Number(value.toPrecision(4)) - read) < 1e-9), `${read}, ${near}`);
  // The pointer comes back and leaves while the time stands still: the legend tells the present instant again, at once.
  const legend = page.locator("[data-chart]").first().locator(".u-series .u-value").nth(3);
  const present = await legend.textContent();
  await over.hover({ position: { x: 0.2 * width, y: height / 2 } });
  await settle(page);
  assert.notEqual(await legend.textContent(), present);
  const left = await page.evaluate(() => {
    document.querySelector("[data-chart] .u-over").dispatchEvent(new MouseEvent("mouseleave"));
    return document.querySelectorAll("[data-chart] .u-series .u-value")[3].textContent;
  });
  assert.equal(left, present);
  await close();
});

test("a click on a beam tells what its section bears there", async () => {
  const { page, close } = await open("cantilever.html");
  await seek(page, 0.125);
  const at = await page.evaluate(() => {
    const { player } = window.ancf14;
    const places = player.moment.parts["station.place"];
    const station = 16; // of 65: a quarter of the beam
    const point = player.stage.controls.target.clone().fromArray(places, 3 * station);
    const { x, y } = player.stage.project(point);
    const box = player.stage.canvas.getBoundingClientRect();
    return { x: box.left + x, y: box.top + y };
  });
  await page.mouse.click(at.x, at.y);
  await settle(page);
  assert.equal(await page.textContent(".panel strong"), "arm");
  const fraction = Number(await page.inputValue(".panel input[type=number]"));
  assert.ok(Math.abs(fraction - 0.25) < 0.02, String(fraction));
  // At the very fraction of an output the panel must tell its value: the curvature at the root.
  await page.fill(".panel input[type=number]", "0");
  await page.press(".panel input[type=number]", "Enter");
  await settle(page);
  const columns = table("out/results.csv");
  const row = columns("time").indexOf(0.125);
  const told = await page.locator(".panel tr", { hasText: "curvature y" }).locator("td").textContent();
  const expected = columns("root_section.curvature[1]");
  // Four digits are shown.
  const size = Math.max(...expected.map(Math.abs));
  assert.ok(Math.abs(parseFloat(told.replace("−", "-")) - expected[row]) < 4e-4 * size, `${told}, ${expected[row]}`);
  assert.ok(await page.isVisible(".along"), "the range along the beam is not shown");
  await page.keyboard.press("Escape");
  await close();
});

test("stations are where the solver's outputs are, to 1e-4 of the model's size", async () => {
  const { page, close } = await open("cantilever.html");
  const { times, tips, size } = await page.evaluate(() => {
    const { data } = window.ancf14;
    const { values, things } = data.tracks.get("station.place");
    const tip = (instant) => [0, 1, 2].map((axis) => values[3 * (instant * things + things - 1) + axis]);
    return { times: [...data.times], tips: [...data.times].map((_, instant) => tip(instant)), size: data.scene.size };
  });
  const columns = table("out/results.csv");
  const drawn = [1, 0, 0];
  assert.equal(times.length, columns("time").length);
  let largest = 0;
  for (const axis of [0, 1, 2]) {
    columns(`tip.displacement[${axis + 1}]`).forEach((value, row) => {
      largest = Math.max(largest, Math.abs(tips[row][axis] - drawn[axis] - value));
    });
  }
  assert.ok(largest < 1e-4 * size, `${largest} m`);
  // Charts have the very doubles of the table.
  const charted = await page.evaluate(() => [...window.ancf14.data.charts.columns.find(({ name }) => name === "tip.velocity[3]").values]);
  assert.deepEqual(charted, columns("tip.velocity[3]"));
  await close();
});

test("colors follow the quantity and the instant", async () => {
  const { page, close } = await open("cantilever.html");
  const colors = () => page.evaluate(() => [...window.ancf14.player.beams.meshes[0].geometry.attributes.color.array.slice(0, 3)]);
  await seek(page, 0);
  const resting = await colors();
  await seek(page, 0.125);
  const bent = await colors();
  assert.notDeepEqual(bent, resting);
  assert.match(await page.textContent(".legend"), /Stress.*MPa/s);
  await page.selectOption("[data-control=color] select", "speed");
  await settle(page);
  assert.notDeepEqual(await colors(), bent);
  assert.match(await page.textContent(".legend"), /Speed.*m\/s/s);
  const whole = await page.textContent(".legend");
  await seek(page, 0.06);
  await page.selectOption("[data-control=range] select", "instant");
  await settle(page);
  assert.notEqual(await page.textContent(".legend"), whole);
  await page.selectOption("[data-control=color] select", "");
  await settle(page);
  assert.equal(await page.isVisible(".legend"), false);
  await close();
});

test("where the stress is not known, the list and the legend name another quantity", async () => {
  // Its sections have no outline.
  ancf14("view", model("blade"), "-o", "blade.html", "--set", "simulation.stop=0.2");
  const { page, close } = await open("blade.html");
  const list = "[data-control=color] select";
  assert.equal(await page.inputValue(list), "bending_moment");
  assert.match(await page.textContent(".legend"), /^Bending moment/);
  assert.equal(await page.locator(`${list} option[value=stress]`).count(), 0);
  // The key goes through the list.
  await page.keyboard.press("c");
  assert.equal(await page.inputValue(list), await page.evaluate(() => window.ancf14.player.quantity.word));
  await close();
});

test("nothing that moves hides behind the legend", async () => {
  ancf14("view", model("lee_frame"), "-o", "frame.html");
  for (const viewport of [{ width: 1280, height: 800 }, { width: 390, height: 800 }]) {
    const { page, close } = await open("frame.html", { viewport });
    const hidden = await page.evaluate(() => {
      const { stage } = window.ancf14.player;
      const cover = document.querySelector(".legend").getBoundingClientRect();
      const canvas = stage.canvas.getBoundingClientRect();
      const { values } = window.ancf14.data.tracks.get("station.place");
      let count = 0;
      for (let at = 0; at < values.length; at += 3) {
        const { x, y } = stage.project(stage.box.min.clone().fromArray(values, at));
        if (x + canvas.left > cover.left && y + canvas.top < cover.bottom) count++;
      }
      return count;
    });
    assert.equal(hidden, 0, `${viewport.width} pixels wide`);
    await close();
  }
});

test("a mode swings, with its frequency", async () => {
  const { page, close } = await open("cantilever.html");
  const tip = () => page.evaluate(() => window.ancf14.player.moment.parts["station.place"].at(-1));
  const opened = await tip();
  await page.selectOption("[data-control=mode] select", "0");
  await page.waitForTimeout(50);
  const first = await tip();
  await page.waitForFunction((first) => Math.abs(window.ancf14.player.moment.parts["station.place"].at(-1) - first) > 0.005, first);
  const frequency = table("out/modes.csv")("frequency")[0];
  assert.ok(Math.abs(parseFloat(await page.textContent(".clock")) / frequency - 1) < 1e-4);
  await page.selectOption("[data-control=mode] select", "");
  await settle(page);
  assert.equal(await tip(), opened, "the run goes on from its own place");
  await close();
});

test("light and dark, wide and narrow: a picture is there, and nothing sticks out", async () => {
  for (const [width, colorScheme] of [[1280, "dark"], [390, "light"]]) {
    const { page, close } = await open("cantilever.html", { viewport: { width, height: 800 }, colorScheme });
    const found = await page.evaluate(async () => {
      const picture = new Image();
      picture.src = window.ancf14.player.stage.png("#808080");
      await picture.decode();
      const canvas = Object.assign(document.createElement("canvas"), { width: picture.width, height: picture.height });
      const paper = canvas.getContext("2d", { willReadFrequently: true });
      paper.drawImage(picture, 0, 0);
      const pixels = new Uint32Array(paper.getImageData(0, 0, canvas.width, canvas.height).data.buffer);
      return { colors: new Set(pixels).size, overflow: document.documentElement.scrollWidth - innerWidth, back: getComputedStyle(document.body).backgroundColor };
    });
    assert.ok(found.colors > 100, `${found.colors} colors`);
    assert.ok(found.overflow <= 0, `${found.overflow} pixels`);
    assert.equal(found.back === "rgb(17, 21, 27)", colorScheme === "dark");
    await close();
  }
});

test("names with HTML in them are shown as they are", async () => {
  const name = "</script><script>document.title='harm'</script><b>bold</b>";
  const text = readFileSync(model("cantilever"), "utf8").replace('name = "Cantilever"', `name = "${name}"`);
  writeFileSync(join(folder, "named.toml"), text);
  ancf14("view", "named.toml", "--set", "simulation.stop=0.02");
  const { page, close } = await open("named.html");
  assert.equal(await page.textContent("h1"), name);
  assert.equal(await page.title(), name);
  await close();
});

test("every sign of every kind is drawn", async () => {
  ancf14("view", model("crane"), "-o", "crane.html", "--set", "simulation.stop=0.2");
  ancf14("view", model("lateral_buckling"), "-o", "strip.html", "--set", "simulation.stop=0.01");
  for (const name of ["crane.html", "strip.html"]) {
    const { page, close } = await open(name);
    // Software draws large scenes slowly: one of them is enough for all keys.
    for (const key of name !== "crane.html" ? ["f"] : ["2", "3", "4", "1", "p", "p", "g", "n", "t", "f"]) await page.keyboard.press(key);
    await settle(page);
    await close();
  }
});
