// Large models in a real browser, from the disk: do their pages open, do they stay small, and does the page say what it leaves out? Prints how long JavaScript takes for a picture, which is not
// bounded here: it depends on what else the computer does. With ANCF14_BLESS=1 it writes these figures into docs/viewer/data.md. Needs the program in the variable ANCF14.

import assert from "node:assert/strict";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { after, before, test } from "node:test";
import { deflateSync } from "node:zlib";
import { ancf14, begin, end, folder, model, models, open, program, settle } from "./pages.mjs";

/** Clamped beams in a row, which fall; each has another length and direction, so that no data repeat. */
const beams = (count, elements, stop, rows) => `
format = 1
model = { name = "Beams", gravity = [0, 0, -9.81] }
material.steel = { young = 2.1e11, poisson = 0.3, density = 7850, damping = 2e-4 }
section.strip = { shape = "rectangle", width = 0.02, height = 0.004 }
simulation = { stop = ${stop}, output_step = ${stop / (rows - 1)} }
[copy.row]
count = ${count}
move = [0, "0.1*(k - 1)", 0]
[copy.row.beam.arm]
material = "steel"
section = "strip"
from = [0, 0, 0]
to = ["cos(0.1*k) + 0.01*k", "0.1*sin(k)", "sin(0.1*k)"]
y_axis = [0, 1, 0]
elements = ${elements}
[copy.row.joint.root]
type = "weld"
a = "ground"
b = "arm.start"
[output.tip]
at = "arm[1].end"
quantities = ["displacement"]
`;

/** What a page may have, bytes, and a sentence at its top, of each model. */
const cases = {
  "20 beams of 21 stations": { text: beams(20, 10, 0.998, 500), most: 4e6 },
  "50 beams of 20 elements": { text: beams(50, 20, 0.2, 21), most: 4e6 },
  "a beam of 2 elements, 10,002 rows": { words: ["arm.elements=2", "simulation.stop=3.0003", "simulation.output_step=3e-4", "simulation.step=3e-4"], most: 4e6, note: /one row of results in 6/ },
  "a beam of 5,000 elements": { words: ["arm.elements=5000", "simulation.stop=0.02"], most: 4e6 },
};

before(begin);
after(end);

/** Milliseconds of JavaScript for a picture, the median of a hundred: everything is placed and colored anew, and handed to WebGL. */
const milliseconds = (page) => page.evaluate(() => {
  const { player } = window.ancf14;
  const times = Array.from({ length: 100 }, (_, k) => {
    player.run.seek(player.run.start + (k / 99) * player.run.duration);
    const begin = performance.now();
    player.update();
    return performance.now() - begin;
  });
  return times.sort((a, b) => a - b)[50];
});

const count = (number) => number.toLocaleString("en");
const megabytes = (bytes) => (bytes / 1e6).toFixed(2);

test("large models have small pages that open", { timeout: 600000 }, async () => {
  const rows = [];
  const took = {};
  const look = async (name, file) => {
    const { page, close } = await open(file);
    took[name] = (await milliseconds(page)).toFixed(1);
    await page.keyboard.press("f");
    await settle(page);
    const found = await page.evaluate(() => {
      const { times, scene, tracks } = window.ancf14.data;
      return { instants: times.length, elements: scene.beams.reduce((sum, { nodes }) => sum + nodes.length - 1, 0), stations: tracks.get("station.place").things, note: document.querySelector(".note")?.textContent };
    });
    await close();
    return found;
  };
  ancf14("view", model("pendulum"));
  await look("pendulum", "pendulum.html");
  for (const [name, { text, words = [], most, note }] of Object.entries(cases)) {
    if (text) writeFileSync(join(folder, "large.toml"), text);
    ancf14("view", text ? "large.toml" : model("cantilever"), "-o", "large.html", ...words.flatMap((word) => ["--set", word]));
    const size = readFileSync(join(folder, "large.html")).length;
    assert.ok(size < most, `${name}: ${size} bytes`);
    const found = await look(name, "large.html");
    if (note) assert.match(found.note ?? "", note);
    rows.push(`| ${name} | ${count(found.instants)} | ${count(found.stations)} | ${megabytes(size)} |`);
  }
  const [shell, style] = ["viewer.js", "viewer.css"].map((file) => readFileSync(new URL(`../../dist/${file}`, import.meta.url)).length);
  assert.ok(shell + style < 1e6);
  const solver = join(dirname(program), "ancf14.wasm");
  const size = existsSync(solver) ? (4 / 3) * deflateSync(readFileSync(solver)).length : 0;
  const words = `To place and color everything for one picture, JavaScript takes ${took.pendulum} ms for the pendulum and ${took["50 beams of 20 elements"]} ms for 50 beams of 1,000 elements`;
  console.log([`page without data: ${megabytes(shell + style)} MB, solver: ${megabytes(size)} MB`, ...rows, words, JSON.stringify(took)].join("\n"));
  if (process.env.ANCF14_BLESS === "1" && size > 0) {
    const path = join(models, "../docs/viewer/data.md");
    const text = readFileSync(path, "utf8");
    const written = text
      .replace(/\| 20 beams of 21 stations[^]*?(?=\n\n)/, rows.join("\n"))
      .replace(/To place and color everything[^(]*?(?= \()/, words)
      .replace(/The program is [\d.]+ MB; the solver of `--live` adds [\d.]+ MB\./, `The program is ${megabytes(shell + style)} MB; the solver of \`--live\` adds ${megabytes(size)} MB.`);
    for (const line of [rows[0], words]) assert.ok(written.includes(line), `docs/viewer/data.md has no place for ${line}`);
    writeFileSync(path, written);
  }
});
