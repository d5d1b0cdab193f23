// The time that is shown: plays, pauses, steps, loops; tells its listeners.

export class Timeline {
  time: number;
  playing = false;
  looping = true;
  /** Whether it stops at the end although it loops. */
  once = false;
  /** Seconds of the run in a second of the clock. */
  speed: number;
  private listeners: (() => void)[] = [];

  constructor(public times: ArrayLike<number>, seconds: number) {
    this.time = times[0] ?? 0;
    this.speed = niceSpeed(this.duration / seconds);
  }

  get start(): number {
    return this.times[0] ?? 0;
  }

  get end(): number {
    return this.times[this.times.length - 1] ?? 0;
  }

  get duration(): number {
    return this.end - this.start;
  }

  onchange(listener: () => void): void {
    this.listeners.push(listener);
  }

  private tell(): void {
    for (const listener of this.listeners) listener();
  }

  seek(time: number): void {
    this.time = Math.min(this.end, Math.max(this.start, time));
    this.tell();
  }

  /** Goes by whole recorded instants. */
  step(count: number): void {
    this.playing = false;
    const here = this.index();
    this.seek(this.times[Math.min(this.times.length - 1, Math.max(0, here + count))]);
  }

  /** The recorded instant nearest to the time. */
  index(): number {
    let best = 0;
    for (let k = 1; k < this.times.length; k++) {
      if (Math.abs(this.times[k] - this.time) < Math.abs(this.times[best] - this.time)) best = k;
    }
    return best;
  }

  toggle(): void {
    this.playing = !this.playing && this.duration > 0;
    if (this.playing && this.time >= this.end) this.time = this.start;
    this.tell();
  }

  /** Plays from the start. */
  play(): void {
    this.time = this.start;
    this.playing = this.duration > 0;
    this.tell();
  }

  /** Stands still at a time. */
  hold(time: number): void {
    this.playing = false;
    this.seek(time);
  }

  pause(): void {
    this.playing = false;
    this.tell();
  }

  /** Lets `seconds` of the clock pass. */
  advance(seconds: number): void {
    if (!this.playing) return;
    let next = this.time + seconds * this.speed;
    if (next >= this.end) {
      if (this.looping && !this.once) next = this.start + ((next - this.start) % (this.duration || 1));
      else {
        next = this.end;
        this.playing = false;
      }
    }
    this.seek(next);
  }

  faster(): void {
    this.speed = SPEEDS.find((speed) => speed > this.speed * 1.001) ?? this.speed;
    this.tell();
  }

  slower(): void {
    this.speed = SPEEDS.findLast((speed) => speed < this.speed * 0.999) ?? this.speed;
    this.tell();
  }
}

/** 1, 2 and 5 times the powers of ten. */
export const SPEEDS = [-5, -4, -3, -2, -1, 0, 1, 2, 3].flatMap((power) => [1, 2, 5].map((digit) => Number(`${digit}e${power}`)));

/** The speed of the list nearest to a wanted one, by ratio; real time where that is near. */
export function niceSpeed(wanted: number): number {
  if (!(wanted > 0)) return 1;
  if (wanted > 0.15 && wanted < 3) return 1;
  const distance = (speed: number) => Math.abs(Math.log(speed / wanted));
  return SPEEDS.reduce((best, speed) => (distance(speed) < distance(best) ? speed : best));
}
