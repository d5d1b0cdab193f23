// Runs the component of WebAssembly in Chromium, and compares it with the library for this computer, as scripts/component.py does in wasmtime. Browsers know modules only: jco makes some of the component.
//
//     sh scripts/build-component.sh
//     npm install --prefix target/component-npm --no-save @bytecodealliance/jco-transpile@0.15.0
//     node scripts/component-browser.mjs [FOLDER]
//
// FOLDER has the program and wasm32-wasip2/ancf14.wasm (target/fmu if it is not given).
import { execFileSync, spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const root = fileURLToPath(new URL("..", import.meta.url));
const folder = process.argv[2] ?? join(root, "target/fmu");
const jco = join(root, "target/component-npm/node_modules/@bytecodealliance/jco-transpile/dist/index.js");
const { transpileBytes } = await import(pathToFileURL(jco));
const RUNS = [["pendulum", 1, 0.01], ["crane", 2, 0.02], ["four_bar", 0.5, 0.02], ["lateral_buckling", 0.2, 5e-4], ["rotating_shaft", 0.05, 2e-3]];
const LIMIT = 1e-5;
// A page that has not answered by then has failed, ms. The runs take a fraction of it.
const PATIENCE = 600_000;

// What the page needs of a model: its file, its token, references and names of its outputs, and the rows of `ancf14 run`.
function task([model, stop, step], work) {
    const [program, source, unit] = [join(folder, "ancf14"), join(root, `models/${model}.toml`), join(work, `${model}.fmu`)];
    const quiet = { stdio: ["ignore", "ignore", "ignore"], encoding: "utf8" };
    execFileSync(program, ["pack", source, "--fmi", "3", "-o", unit], quiet);
    execFileSync(program, ["run", source, "--set", `simulation.stop=${stop}`, "--set", `simulation.output_step=${step}`, "--out", join(work, model)], quiet);
    const inside = (name) => execFileSync("unzip", ["-p", unit, name], { encoding: "utf8" });
    const description = inside("modelDescription.xml");
    const [references, names] = [[], []];
    for (const [, attributes, rest] of description.matchAll(/<Float64 ([^>]*?)(?:\/>|>([\s\S]*?)<\/Float64>)/g)) {
        const attribute = (name) => attributes.match(new RegExp(`\\b${name}="([^"]*)"`))?.[1];
        if (attribute("causality") !== "output") continue;
        references.push(Number(attribute("valueReference")));
        let indices = [[]];
        for (const [, extent] of (rest ?? "").matchAll(/<Dimension start="(\d+)"/g)) {
            indices = indices.flatMap((index) => Array.from({ length: Number(extent) }, (_, k) => [...index, k + 1]));
        }
        names.push(...indices.map((index) => attribute("name") + (index.length > 0 ? `[${index}]` : "")));
    }
    const cells = (line) => [...line.matchAll(/"([^"]*)"|([^,]+)/g)].map(([, quoted, plain]) => quoted ?? plain);
    const [header, ...rows] = readFileSync(join(work, model, "results.csv"), "utf8").trim().split("\n").map(cells);
    const columns = names.map((name) => header.indexOf(name));
    const expected = rows.map((row) => columns.map((column) => Number(row[column])));
    return { model, stop, step, text: inside("resources/model.toml"), token: description.match(/instantiationToken="([^"]*)"/)[1], references, expected };
}

// Runs in the page.
async function page() {
    const { instantiate } = await import("./ancf14.js");
    class Descriptor {
        constructor(files, path = "") {
            Object.assign(this, { files, path });
        }
        openAt(_pathFlags, path) {
            if (!(path in this.files)) throw "no-entry";
            return new Descriptor(this.files, path);
        }
        read(length, offset) {
            const [bytes, from] = [this.files[this.path], Number(offset)];
            const end = Math.min(bytes.length, from + Number(length));
            return [bytes.slice(from, end), end === bytes.length];
        }
    }
    const told = [];
    for (const { model, stop, step, text, token, references, expected } of await (await fetch("tasks.json")).json()) {
        const root = new Descriptor({ "model.toml": new TextEncoder().encode(text) });
        const lines = [];
        const nothing = () => {};
        const unit = await instantiate(async (name) => WebAssembly.compile(await (await fetch(name)).arrayBuffer()), {
            "fmi:fmi3/callbacks": { logMessage: (...words) => lines.push(words.join(" ")), clockUpdate: nothing, lockPreemption: nothing, unlockPreemption: nothing },
            "fmi:fmi3/intermediate-update-callbacks": { intermediateUpdate: (time) => [false, time] },
            "wasi:filesystem/preopens": { getDirectories: () => [[root, "/resources"]] },
            "wasi:filesystem/types": { Descriptor },
        });
        const make = unit.coSimulation.CoSimulationInstance.instantiateCoSimulation;
        const instance = make("unit", token, "/resources/", false, false, false, false, new Uint32Array());
        if (!instance) throw new Error(lines.join("\n"));
        instance.enterInitializationMode(undefined, 0, undefined);
        instance.exitInitializationMode();
        const found = [instance.getFloat64(new Uint32Array(references))];
        for (let k = 0; k < Math.round(stop / step); k++) {
            instance.doStep(k * step, step, false);
            found.push(instance.getFloat64(new Uint32Array(references)));
        }
        let largest = found.length === expected.length ? 0 : Infinity;
        for (let column = 0; column < expected[0].length; column++) {
            const scale = Math.max(...expected.map((row) => Math.abs(row[column])));
            const difference = Math.max(...expected.map((row, k) => Math.abs(row[column] - found[k][column])));
            // Infinite where a number is missing or none.
            if (!(difference <= 0)) largest = Math.max(largest, difference / scale || Infinity);
        }
        told.push({ model, stop, outputs: expected[0].length, rows: found.length, largest });
    }
    return told;
}

const work = mkdtempSync(join(tmpdir(), "component-"));
const tasks = JSON.stringify(RUNS.map((run) => task(run, work)));
const { files } = await transpileBytes(readFileSync(join(folder, "wasm32-wasip2/ancf14.wasm")), { name: "ancf14", instantiation: "async" });
const served = new Map(Array.isArray(files) ? files : Object.entries(files));
const script = `${page}\npage().then((told) => ({ told }), (error) => ({ error: String(error?.stack ?? error) })).then((answer) => fetch("done", { method: "POST", body: JSON.stringify(answer) }));`;
served.set("", `<!DOCTYPE html><script type="module">${script}</script>`).set("tasks.json", tasks);
const answer = await new Promise((resolve) => {
    const server = createServer((request, response) => {
        const name = request.url.slice(1);
        if (name === "done") {
            let body = "";
            request.on("data", (piece) => (body += piece)).on("end", () => resolve({ ...JSON.parse(body), server, browser }));
            return response.end();
        }
        const types = { js: "text/javascript", wasm: "application/wasm", json: "application/json" };
        response.writeHead(served.has(name) ? 200 : 404, { "content-type": types[name.split(".").pop()] ?? "text/html" });
        response.end(served.get(name));
    });
    let browser;
    const late = () => resolve({ error: `the page did not answer within ${PATIENCE / 1000} s; open it in a Chromium with a window, and look at its console`, server, browser });
    setTimeout(late, PATIENCE).unref();
    server.listen(0, "127.0.0.1", () => {
        const address = `http://127.0.0.1:${server.address().port}/`;
        browser = spawn("chromium", ["--headless=new", "--no-sandbox", "--disable-gpu", `--user-data-dir=${join(work, "profile")}`, address], { stdio: "ignore" });
    });
});
answer.browser.kill();
answer.server.close();
answer.server.closeAllConnections();
if (answer.error) {
    console.error(answer.error);
} else {
    console.log("| model | outputs | rows | Chromium |\n|---|---|---|---|");
    for (const { model, stop, outputs, rows, largest } of answer.told) {
        console.log(`| \`models/${model}.toml\`, ${stop} s | ${outputs} | ${rows} | ${largest > 0 ? largest.toExponential(0) : "bit-identical"} |`);
    }
}
const passed = !answer.error && answer.told.every(({ largest }) => largest <= LIMIT);
console.log(passed ? "1 passed, 0 failed" : "0 passed, 1 failed");
setTimeout(() => {
    rmSync(work, { recursive: true, force: true });
    process.exit(passed ? 0 : 1);
}, 500);
