// The worker that runs the solver: it has the module of WebAssembly from the page, simulates a few rows of results at a time, and tells how far it is.
//
// viewer/build.mjs bundles it as text, of which the page makes its workers.

/** What crates/live/src/solver.rs solver. */
interface Exports {
  memory: WebAssembly.Memory;
  request(length: number): number;
  reply(): number;
  reply_length(): number;
  describe(): void;
  begin(): void;
  advance(count: number): number;
  finish(stopped: number): void;
}

const ENDED = 1;
const FAILED = 2;
/** Milliseconds between two looks at messages from the page. */
const SLICE = 60;

let solver: Exports;
let stopped = false;

function reply(): any {
  const bytes = new Uint8Array(solver.memory.buffer, solver.reply(), solver.reply_length());
  return JSON.parse(new TextDecoder().decode(bytes));
}

function ask(request: unknown): void {
  const bytes = new TextEncoder().encode(JSON.stringify(request));
  const address = solver.request(bytes.length);
  new Uint8Array(solver.memory.buffer, address, bytes.length).set(bytes);
}

/** Lets messages of the page in. */
const pause = () => new Promise((done) => setTimeout(done));

async function run(request: unknown): Promise<void> {
  ask(request);
  solver.begin();
  const begun = reply();
  if (begun.error !== undefined) return postMessage({ kind: "done", error: begun.error });
  const { rows } = begun.description;
  postMessage({ kind: "begun", description: begun.description });
  let row = 0;
  let count = 1;
  let outcome = 0;
  while (!stopped && outcome !== ENDED && outcome !== FAILED) {
    const begin = performance.now();
    outcome = solver.advance(count);
    row += count;
    const took = performance.now() - begin;
    count = Math.max(1, Math.min(1000, Math.floor((count * SLICE) / Math.max(took, 0.1))));
    postMessage({ kind: "progress", share: Math.min(1, row / rows) });
    await pause();
  }
  solver.finish(outcome === ENDED || outcome === FAILED ? 0 : 1);
  postMessage({ kind: "done", description: begun.description, ...reply() });
}

/** What a module that has ended says: its last words, or those of the browser. */
function lastWords(reason: unknown): string {
  try {
    const { panic } = reply();
    if (typeof panic === "string") return panic;
  } catch {
    // There is no reply.
  }
  return `the solver stopped on an internal error: ${reason instanceof Error ? reason.message : String(reason)}`;
}

onmessage = async ({ data }: MessageEvent) => {
  try {
    if (data.kind === "module") {
      const module: WebAssembly.Module = data.module;
      solver = (await WebAssembly.instantiate(module, {})).exports as unknown as Exports;
    } else if (data.kind === "stop") {
      stopped = true;
    } else if (data.kind === "describe") {
      ask(data.request);
      solver.describe();
      postMessage({ kind: "described", ...reply() });
    } else {
      stopped = false;
      await run(data.request);
    }
  } catch (reason) {
    postMessage({ kind: "broken", error: lastWords(reason) });
  }
};

export {};
