// The solver in the page, from outside: it runs in a worker, so that the page never waits for it.

import { unpack } from "./data";
import type { PageInfo } from "./format";

/** The text of the worker: viewer/build.mjs puts it in. */
declare const WORKER: string;

/** A stop that the solver does not heed after so many milliseconds ends its worker. */
const PATIENCE = 1500;

/** A model and its settings: crates/live/src/request.rs. */
export interface Request {
  file: string;
  text: string;
  /** Keys and values of `--set`. */
  overrides: [string, string][];
  modes: number | null;
}

/** A number that can be set. */
export interface ControlInfo {
  name: string;
  unit: string;
  meaning: string;
  value: number;
  min?: number;
  max?: number;
  integer: boolean;
}

export interface Description {
  rows: number;
  controls: ControlInfo[];
}

/** A point that can be dragged: on a beam or a body of the scene. */
export interface GripInfo {
  beam?: number;
  body?: number;
  at: string;
}

/** What a run for a reader who drags the mechanism consists of (crates/live/src/session.rs). */
export interface SessionInfo {
  grips: GripInfo[];
  /** Name, components and things of each track of a frame. */
  tracks: [string, number, number][];
  /** Length of a communication step, s. */
  step: number;
}

/** What the page does with the news of such a run. */
export interface Audience {
  begun(info: SessionInfo): void;
  /** The numbers of a frame, and how many seconds of the run pass in one of the clock. */
  frame(numbers: Float32Array, rate: number): void;
  paused(error: string): void;
}

/** How a run has ended. */
export interface Outcome {
  /** Without where there is nothing to show. */
  data?: PageInfo;
  description?: Description;
  warnings?: string[];
  error?: string | null;
  /** The worker was ended before it had anything to show. */
  ended?: boolean;
}

interface Job {
  progress?: (share: number) => void;
  audience?: Audience;
  settle: (reply: any) => void;
}

export class Solver {
  private worker?: Worker;
  private job?: Job;
  private readonly module: Promise<WebAssembly.Module>;
  private readonly address = URL.createObjectURL(new Blob([WORKER], { type: "text/javascript" }));

  constructor(packed: string) {
    this.module = unpack(packed).then((bytes) => WebAssembly.compile(bytes as BufferSource));
  }

  /** What can be set in a model. */
  async describe(request: Request): Promise<{ description?: Description; error?: string }> {
    return this.post({ kind: "describe", request });
  }

  /** Simulates. */
  async run(request: Request, progress: (share: number) => void): Promise<Outcome> {
    return this.post({ kind: "run", request }, progress);
  }

  /** Simulates while a reader drags the mechanism, until it is stopped. */
  async interact(request: Request, pace: number, audience: Audience): Promise<{ error?: string }> {
    return this.post({ kind: "interact", request, pace }, undefined, audience);
  }

  /** Tells the worker something about the run that goes on. */
  send(message: object): void {
    this.worker?.postMessage(message);
  }

  /** Ends the run as soon as possible: what it has is shown. */
  stop(): void {
    const { job, worker } = this;
    if (!job || !worker) return;
    worker.postMessage({ kind: "stop" });
    setTimeout(() => {
      if (this.job === job) this.break({ ended: true });
    }, PATIENCE);
  }

  /** Jobs come one after another. */
  private post(message: object, progress?: (share: number) => void, audience?: Audience): Promise<any> {
    const next = this.last.then(() => this.begin(message, progress, audience));
    this.last = next.catch(() => undefined);
    return next;
  }

  private last: Promise<unknown> = Promise.resolve();

  private async begin(message: object, progress?: (share: number) => void, audience?: Audience): Promise<any> {
    const worker = await this.ready();
    return new Promise((settle) => {
      this.job = { progress, audience, settle };
      worker.postMessage(message);
    });
  }

  private async ready(): Promise<Worker> {
    if (this.worker) return this.worker;
    const module = await this.module;
    const worker = (this.worker = new Worker(this.address));
    worker.onmessage = ({ data: { kind, ...reply } }) => {
      const audience = this.job?.audience;
      if (kind === "progress") this.job?.progress?.(reply.share);
      else if (kind === "frame") audience?.frame(reply.numbers, reply.rate);
      else if (kind === "session") audience?.begun(reply.session);
      else if (kind === "paused") audience?.paused(reply.error);
      else if (kind === "broken") this.break(reply);
      else if (kind !== "begun") this.settle(reply);
    };
    worker.onerror = (event) => {
      event.preventDefault();
      this.break({ error: `the solver stopped on an internal error: ${event.message}` });
    };
    worker.postMessage({ kind: "module", module });
    return worker;
  }

  private settle(reply: any): void {
    const { job } = this;
    this.job = undefined;
    job?.settle(reply);
  }

  /** Ends the worker, whose module may be in any state; the next job has a new one. */
  private break(reply: object): void {
    this.worker?.terminate();
    this.worker = undefined;
    this.settle(reply);
  }
}
