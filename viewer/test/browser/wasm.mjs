// The solver of the page against the program: WebAssembly in node, outside a browser. Does it give the numbers of `ancf14 view` for every model that is shipped,
// does it need nothing from its host, and how much longer does it take? With ANCF14_BLESS=1 it runs
// all models to their ends and writes the tables of docs/viewer/data.md: these figures, and the sizes of the pages. Times are those of the processor, on which other work of the computer has little
// influence; they need Linux and bash.

import assert from "node:assert/strict";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { after, test } from "node:test";
import { deflateSync, inflateSync } from "node:zlib";
import { spawnSync } from "node:child_process";
import { end, folder, model, models, program } from "./pages.mjs";

/**
 * Largest difference of an output, as a share of the largest value of its chart. The solver does the same operations in the same order; only sines, exponentials and powers
 * come from another library, which rounds them differently in the last bit. Newton's iteration ends below `simulation.tolerance`, 1e-8: differences far below it are forgotten, larger ones
 * would be another solution.
 */
const BOUND = 1e-8;
/**
 * A mechanism that buckles or passes a resonance magnifies what is in the last bit. There the program itself is the measure: a stiffness that changes by a few units of the last place may not
 * make a much smaller difference.
 */
const NUDGE = 1e-15;
const MOST = 20;
/** A model with more rows of results runs for a quarter of its time, unless the table is written. */
const LONG = 400;
const isWhole = process.env.ANCF14_BLESS === "1";

const bytes = readFileSync(join(dirname(program), "ancf14.wasm"));
const module = new WebAssembly.Module(bytes);

/** The solver, and how it is asked. */
function solver() {
  const { exports } = new WebAssembly.Instance(module, {});
  const ask = (request) => {
    const text = new TextEncoder().encode(JSON.stringify(request));
    const address = exports.request(text.length);
    new Uint8Array(exports.memory.buffer, address, text.length).set(text);
  };
  const reply = () => JSON.parse(new TextDecoder().decode(new Uint8Array(exports.memory.buffer, exports.reply(), exports.reply_length())));
  return { exports, ask, reply };
}

/** The numbers in a text of docs/viewer/data.md. */
function doubles(text) {
  const planes = inflateSync(Buffer.from(text, "base64"));
  const count = planes.length / 8;
  const words = new BigUint64Array(count);
  let bits = 0n;
  for (let at = 0; at < count; at++) {
    let change = 0n;
    for (let plane = 0; plane < 8; plane++) change = (change << 8n) | BigInt(planes[plane * count + at]);
    words[at] = bits ^= change;
  }
  return new Float64Array(words.buffer);
}

const dataOf = (page) => JSON.parse(/<script type="application\/json" id="data">(.*?)<\/script>/s.exec(page)[1]);

/** Largest difference of two runs, of a chart's largest value. */
function difference(one, other) {
  let largest = 0;
  for (const { columns } of one.charts.groups) {
    const pairs = columns.map((column) => [one, other].map((run) => doubles(run.charts.columns[column].data)));
    const size = Math.max(...pairs.map(([values]) => values.reduce((most, value) => Math.max(most, Math.abs(value)), 0)));
    for (const [values, others] of pairs) {
      assert.equal(values.length, others.length);
      values.forEach((value, row) => (largest = Math.max(largest, Math.abs(value - others[row]) / (size || 1))));
    }
  }
  return largest;
}

after(end);

test("the solver asks its host for nothing", () => {
  assert.deepEqual(WebAssembly.Module.imports(module), []);
  assert.ok(bytes.length < 3.5e6, `${bytes.length} bytes`);
});

/** What `simulate` gives with the shortest of its times, s: of short runs the shortest of three. */
function timed(simulate) {
  let best = simulate();
  for (let round = 1; isWhole && best.took < 1 && round < 3; round++) {
    const { took } = simulate();
    best.took = Math.min(best.took, took);
  }
  return best;
}

/** The data of a page that the program writes, its size, bytes, and the time of the processor, s. */
function native(name, set = []) {
  const words = ["view", model(name), ...set.flatMap((pair) => ["--set", pair.join("=")])];
  const { stdout, status } = spawnSync("bash", ["-c", 'TIMEFORMAT="%U %S"; { time "$0" "$@" > run.txt 2>&1; } 2>&1', program, ...words], { cwd: folder, encoding: "utf8" });
  assert.equal(status, 0);
  const took = stdout.trim().split(" ").reduce((sum, part) => sum + Number(part), 0);
  const page = readFileSync(join(folder, `${name}.html`), "utf8");
  return { data: dataOf(page), size: Buffer.byteLength(page), took };
}

/** Time of the processor of this thread, s: not that of the threads that compile the module. */
const clock = () => Number(readFileSync("/proc/thread-self/schedstat", "utf8").split(" ")[0]) / 1e9;

/** The same of the solver of pages. */
function own(name, set) {
  const begun = clock();
  const { exports, ask, reply } = solver();
  ask(request(name, set));
  exports.begin();
  assert.equal(reply().error, undefined);
  while (exports.advance(1000) === 0);
  exports.finish(0);
  const { data } = reply();
  return { data, took: clock() - begun };
}

const request = (name, overrides) => ({ file: `${name}.toml`, text: readFileSync(model(name), "utf8"), overrides: overrides.map(([key, value]) => [key, String(value)]), modes: null });

/** What can be set in a model, and how many rows of results it has. */
function described(name) {
  const { exports, ask, reply } = solver();
  ask(request(name, []));
  exports.describe();
  const { rows, controls } = reply().description;
  return { rows, value: (key) => controls.find((control) => control.name.endsWith(key)) };
}

test("every model gives the numbers of the program", { timeout: 900000 }, () => {
  const names = readdirSync(models).filter((name) => name.endsWith(".toml")).map((name) => name.slice(0, -5));
  assert.ok(names.length > 10);
  const lines = ["| example | rows | time, s | simulated seconds per second of processor time | time, of the program's | largest difference | of the program, with a stiffness changed by 1e-15 |", "|---|---|---|---|---|---|---|"];
  const sizes = ["| example | instants | stations | page, MB |", "|---|---|---|---|"];
  const wrong = [];
  const share = (number) => (number === undefined ? "" : number === 0 ? "0" : number.toExponential(0));
  for (const name of names) {
    const { rows, value } = described(name);
    const set = rows > LONG && !isWhole ? [["simulation.stop", value("simulation.stop").value / 4]] : [];
    const program = timed(() => native(name, set));
    const page = timed(() => own(name, set));
    assert.deepEqual(page.data.notes, program.data.notes);
    assert.deepEqual(page.data.charts.columns.map((column) => column.name), program.data.charts.columns.map((column) => column.name));
    const found = difference(program.data, page.data);
    // How much the program's results change with the last digits of the first stiffness.
    const stiffness = value(".young");
    const nudged = found > BOUND ? difference(program.data, native(name, [...set, [stiffness.name, stiffness.value * (1 + NUDGE)]]).data) : undefined;
    const { data: { scene, instants }, size } = program;
    const end = set.length > 0 ? set[0][1] : value("simulation.stop").value;
    // The time of a static analysis is not that of a clock.
    const pace = scene.dynamic ? Number((end / page.took).toPrecision(2)) : "";
    const stations = scene.beams.reduce((most, beam) => Math.max(most, beam.stations[1]), 0);
    sizes.push(`| ${name} | ${instants.toLocaleString("en")} | ${stations.toLocaleString("en")} | ${(size / 1e6).toFixed(2)} |`);
    lines.push(`| ${name} | ${rows.toLocaleString("en")} | ${Number(page.took.toPrecision(2))} | ${pace} | ${(page.took / program.took).toFixed(1)} | ${share(found)} | ${share(nudged)} |`);
    if (!(found <= Math.max(BOUND, MOST * (nudged ?? 0)))) wrong.push(name);
  }
  console.log([`ancf14.wasm: ${(bytes.length / 1e6).toFixed(2)} MB, in a page ${((4 / 3) * deflateSync(bytes).length / 1e6).toFixed(2)} MB`, ...lines].join("\n"));
  assert.deepEqual(wrong, [], "these differ by more than their bound");
  if (isWhole) {
    const path = join(models, "../docs/viewer/data.md");
    const text = readFileSync(path, "utf8").replace(/\| example \| rows \| time[^]*?(?=\n\n)/, lines.join("\n"));
    // The rows of pages that are not examples stay.
    const written = text.replace(/\| example \| instants [^]*?(?=\n\| 20 beams)/, sizes.join("\n"));
    for (const line of [lines.at(-1), sizes.at(-1)]) assert.ok(written.includes(line), `docs/viewer/data.md has no table for ${line}`);
    writeFileSync(path, written);
  }
});
