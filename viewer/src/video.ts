// A video of the motion: the browser records what is drawn while the timeline plays once from its start to its end.

import { h, save } from "./dom";
import type { Timeline } from "./timeline";
import type { Page } from "./ui";

/** Formats in the order of preference, with the endings of their files: some browsers record MP4 only. */
const FORMATS = [["video/webm", "webm"], ["video/mp4", "mp4"]] as const;
/** Bits per second for each pixel: thin lines on a plain background stay sharp. */
const BITS = 8;
/** Milliseconds that a recorder has to compress what was drawn: it drops the rest when it ends. */
const HOLD = 500;

type Format = (typeof FORMATS)[number];

/** What the browser can record; nothing: it cannot. */
function format(): Format | undefined {
  if (typeof MediaRecorder === "undefined" || !("captureStream" in HTMLCanvasElement.prototype)) return undefined;
  return FORMATS.find(([type]) => MediaRecorder.isTypeSupported(type));
}

export class Video {
  readonly button = h("button", { type: "button", "data-control": "video", onclick: () => this.toggle() });
  readonly status = h("p", { class: "recording", role: "status", hidden: true });
  readonly format = format();
  /** What is recorded: the picture on the background of the page, as large as it is at the start. Most players show what is transparent in black. */
  private readonly canvas = h("canvas");
  private readonly paper = this.canvas.getContext("2d", { alpha: false })!;
  /** Asked for; started, and not yet ready; ready, with the motion at its start; in motion; at the last picture. */
  private phase: "off" | "asked" | "started" | "ready" | "moving" | "ending" = "off";
  private timeline?: Timeline;
  private recorder?: MediaRecorder;

  constructor(private readonly page: Page) {
    this.enter("off");
  }

  private toggle(): void {
    if (this.phase !== "off") return this.stop();
    const { timeline } = this.page.player;
    this.timeline = timeline;
    this.enter("asked", "Recording …");
    timeline.once = true;
    timeline.pause();
    timeline.seek(timeline.start);
  }

  /** A picture has been drawn: records it. Whatever pauses the motion, its end or the reader, ends the recording. */
  update(): void {
    const { phase, timeline } = this;
    const { player } = this.page;
    this.button.disabled = phase === "ending" || (phase === "off" && (player.isLive || player.timeline.duration === 0));
    if (phase === "off" || phase === "ending") return;
    this.draw();
    if (phase === "asked") this.start(this.format!);
    else if (phase === "ready") {
      this.phase = "moving";
      timeline!.playing = true;
    } else if (phase === "moving" && (!timeline!.playing || player.timeline !== timeline)) this.stop();
  }

  private draw(): void {
    const { paper, canvas } = this;
    const { canvas: picture } = this.page.player.stage;
    if (this.phase === "asked") {
      // Some formats have sizes of even numbers only.
      canvas.width = picture.width & ~1;
      canvas.height = picture.height & ~1;
    }
    paper.fillStyle = this.page.background;
    paper.fillRect(0, 0, canvas.width, canvas.height);
    paper.drawImage(picture, 0, 0, canvas.width, canvas.height);
  }

  private start([type, ending]: Format): void {
    const { canvas } = this;
    const { player, data } = this.page;
    const parts: Blob[] = [];
    try {
      const recorder = new MediaRecorder(canvas.captureStream(), { mimeType: type, videoBitsPerSecond: BITS * canvas.width * canvas.height });
      recorder.ondataavailable = ({ data: part }) => parts.push(part);
      recorder.onerror = () => this.stop();
      recorder.onstart = () => {
        if (this.phase !== "started") return;
        this.phase = "ready";
        player.look();
      };
      recorder.onstop = () => {
        this.timeline!.once = false;
        recorder.stream.getTracks().forEach((track) => track.stop());
        const film = new Blob(parts, { type });
        if (film.size === 0) return this.enter("off", "The browser has recorded nothing.");
        const url = URL.createObjectURL(film);
        save(url, data.scene.name, ending);
        // A browser may begin to read it only when the reader has said where to put it.
        setTimeout(() => URL.revokeObjectURL(url), 60000);
        this.enter("off");
      };
      recorder.start();
      this.recorder = recorder;
      this.phase = "started";
    } catch (reason) {
      this.timeline!.once = false;
      this.enter("off", `The browser cannot record the picture: ${reason instanceof Error ? reason.message : String(reason)}.`);
    }
  }

  /** Ends the recording, which saves it. */
  stop(): void {
    const { timeline, recorder, phase } = this;
    if (phase === "off" || phase === "ending") return;
    timeline!.once = false;
    timeline!.pause();
    if (phase === "asked") return this.enter("off");
    this.enter("ending", "Saving …");
    // The same picture again: the first one may have come while the recorder was busy.
    setTimeout(() => this.paper.drawImage(this.canvas, 0, 0), HOLD);
    setTimeout(() => recorder!.state !== "inactive" && recorder!.stop(), 2 * HOLD);
  }

  /** Shows what it does, and a message. */
  private enter(phase: typeof this.phase, message = ""): void {
    this.phase = phase;
    const isOn = phase !== "off";
    const label = isOn ? "End the recording and save the video" : "Save a video: play the motion once and record it";
    this.button.textContent = isOn ? "■ Stop" : "Video";
    this.button.setAttribute("aria-label", label);
    this.button.title = `${label} (V)`;
    this.button.setAttribute("aria-pressed", String(isOn));
    this.status.textContent = message;
    this.status.hidden = message === "";
    this.status.classList.toggle("on", isOn);
    // The button is disabled where nothing moves: the next picture looks for it.
    this.page.player?.look();
  }
}
