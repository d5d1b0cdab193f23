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
  interact(pace: number): void;
  grab(grip: number): number;
  pull(x: number, y: number, z: number): void;
  release(): void;
  step(): number;
  frame(): void;
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

/** Milliseconds between two pictures of a run that a reader plays with. */
const PICTURE = 1000 / 60;
/** The rate of such a run is that of so many milliseconds. */
const MEMORY = 500;

/** What the reader does, to be done between two steps. */
let wishes: (() => number | void)[] = [];
let paused = false;

function picture(rate: number): void {
  solver.frame();
  const begin = solver.reply();
  const numbers = new Float32Array(solver.memory.buffer.slice(begin, begin + solver.reply_length()));
  postMessage({ kind: "frame", numbers, rate }, { transfer: [numbers.buffer] });
}

/** Simulates in the time of the clock, `pace` seconds of the run in each second, or as fast as it can. */
async function interact(request: unknown, pace: number): Promise<void> {
  wishes = [];
  paused = false;
  ask(request);
  solver.interact(pace);
  const begun = reply();
  if (begun.error !== undefined) return postMessage({ kind: "done", error: begun.error });
  postMessage({ kind: "session", session: begun.session });
  const { step } = begun.session;
  /** Seconds of the run that are due. */
  let due = 0;
  let last = performance.now();
  /** The clock and the run, ms and s, at the instants that the rate is taken of. */
  let marks: [number, number][] = [];
  let time = 0;
  picture(pace);
  while (!stopped) {
    const now = performance.now();
    // What could not be simulated in time is not made up for.
    due = Math.min(due + ((now - last) / 1000) * pace, (pace * 2 * PICTURE) / 1000 + step);
    last = now;
    let failed = wishes.splice(0).some((wish) => wish() === FAILED);
    while (!failed && !paused && due >= step && performance.now() - now < PICTURE) {
      failed = solver.step() === FAILED;
      if (!failed) [due, time] = [due - step, time + step];
    }
    if (failed) {
      const { error } = reply();
      solver.release();
      paused = true;
      postMessage({ kind: "paused", error });
    }
    if (paused) [due, marks] = [0, []];
    marks = [...marks.filter(([at]) => at > now - MEMORY), [now, time]];
    const [[clock, run]] = marks;
    // The steps of a slow solver may take longer than the memory.
    picture(now > clock ? (1000 * (time - run)) / (now - clock) : pace);
    await new Promise((done) => setTimeout(done, Math.max(0, PICTURE - (performance.now() - now))));
  }
  solver.release();
  postMessage({ kind: "done" });
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
    } else if (data.kind === "grab") {
      wishes.push(() => solver.grab(data.grip), () => solver.pull(...(data.place as [number, number, number])));
    } else if (data.kind === "pull") {
      wishes.push(() => solver.pull(...(data.place as [number, number, number])));
    } else if (data.kind === "release") {
      wishes.push(() => solver.release());
    } else if (data.kind === "resume") {
      paused = false;
    } else if (data.kind === "interact") {
      stopped = false;
      await interact(data.request, data.pace);
    } else {
      stopped = false;
      await run(data.request);
    }
  } catch (reason) {
    postMessage({ kind: "broken", error: lastWords(reason) });
  }
};

export {};
