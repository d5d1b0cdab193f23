// The page records a video, in a real browser from the disk: does a file come out that plays as long as the motion, shows it from its start to its end, and is not transparent? Does a reader end
// the recording early? Is there no button where the browser cannot record? Needs the program in the variable ANCF14.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { ancf14, begin, end, folder, model, open, settle } from "./pages.mjs";

/** Seconds of the run. */
const STOP = 0.5;
const button = "[data-control=video]";

before(async () => {
  await begin();
  ancf14("view", model("cantilever"), "--set", `simulation.stop=${STOP}`);
});

after(end);

const state = (page) => page.evaluate(() => {
  const { timeline } = window.ancf14.player;
  return { time: timeline.time, playing: timeline.playing, looping: timeline.looping };
});

/** Records at a speed, with the motion shown at some instant before, until it ends or `meanwhile` ends it; gives the file and the seconds that it took. */
async function record(page, speed, begin, meanwhile) {
  await page.evaluate((speed) => {
    const { run } = window.ancf14.player;
    run.speed = speed;
    run.seek(run.start + 0.4 * run.duration);
  }, speed);
  await settle(page);
  const saved = page.waitForEvent("download", { timeout: 60000 });
  const began = performance.now();
  await begin();
  await meanwhile();
  const download = await saved;
  const took = (performance.now() - began) / 1000;
  await settle(page);
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()), took };
}

/** The pictures that the page saves at its start and at its end. */
const pictures = (page) => page.evaluate(() => {
  const { player } = window.ancf14;
  return [player.run.start, player.run.end].map((time) => {
    player.run.seek(time);
    player.update();
    return player.stage.png("#ffffff");
  });
});

/** Plays the file in a page of its own: its size and duration, s, and how many of its pixels differ, at its start and its end, from the pictures of the page; also, in how many these two differ. */
async function watch(page, bytes, pictures) {
  const other = await page.context().newPage();
  const film = await other.evaluate(async ([text, pictures]) => {
    const video = Object.assign(document.createElement("video"), { muted: true });
    const heard = (name, act) => new Promise((done, failed) => {
      video.addEventListener(name, done, { once: true });
      video.addEventListener("error", () => failed(new Error(video.error.message)), { once: true });
      act();
    });
    const pixels = (source) => {
      const canvas = Object.assign(document.createElement("canvas"), { width: video.videoWidth, height: video.videoHeight });
      const paper = canvas.getContext("2d", { willReadFrequently: true });
      paper.drawImage(source, 0, 0);
      return paper.getImageData(0, 0, canvas.width, canvas.height).data;
    };
    // More than what compression changes.
    const differ = (one, other) => {
      let count = 0;
      for (let at = 0; at < one.length; at += 4) if (Math.abs(one[at] - other[at]) + Math.abs(one[at + 1] - other[at + 1]) + Math.abs(one[at + 2] - other[at + 2]) + Math.abs(one[at + 3] - other[at + 3]) > 200) count++;
      return count;
    };
    const [first, last] = await Promise.all(pictures.map(async (url) => {
      const image = new Image();
      image.src = url;
      await image.decode();
      return image;
    }));
    await heard("loadeddata", () => (video.src = URL.createObjectURL(new Blob([Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0))]))));
    await heard("seeked", () => (video.currentTime = 0));
    const begin = pixels(video);
    // Where the file does not tell its duration, it is known when the end has been looked for.
    await heard("seeked", () => (video.currentTime = 1e6));
    const end = pixels(video);
    const { duration, videoWidth: width, videoHeight: height } = video;
    return { duration, width, height, first: differ(begin, pixels(first)), last: differ(end, pixels(last)), moved: differ(pixels(first), pixels(last)) };
  }, [bytes.toString("base64"), pictures]);
  await other.close();
  return film;
}

test("the motion is recorded once, from its start to its end", { timeout: 120000 }, async () => {
  const { page, close } = await open("cantilever.html", { colorScheme: "light" });
  const before = await page.textContent(button);
  const speed = 0.25;
  const { name, bytes, took } = await record(page, speed, () => page.click(button), async () => {
    assert.equal(await page.textContent(button), "■ Stop");
    assert.equal(await page.getAttribute(button, "aria-pressed"), "true");
    assert.equal(await page.textContent(".recording"), "Recording …");
    assert.ok(await page.isVisible(".recording"));
  });
  assert.equal(name, "Cantilever.webm");
  assert.deepEqual(await state(page), { time: STOP, playing: false, looping: true });
  assert.equal(await page.textContent(button), before);
  assert.ok(!(await page.isVisible(".recording")));
  const film = await watch(page, bytes, await pictures(page));
  assert.deepEqual([film.width, film.height], await page.evaluate(() => [window.ancf14.player.stage.canvas.width & ~1, window.ancf14.player.stage.canvas.height & ~1]));
  // The first and the last picture stand for a while, in addition to the motion.
  assert.ok(film.duration > STOP / speed && film.duration < took, `${film.duration} s of a motion of ${STOP / speed} s, recorded in ${took} s`);
  assert.ok(film.first < 0.1 * film.moved && film.last < 0.1 * film.moved, `pixels that differ: ${JSON.stringify(film)}`);
  await close();
});

test("the key ends a recording early, and so does a pause", { timeout: 120000 }, async () => {
  const { page, close } = await open("cantilever.html", { colorScheme: "light" });
  const speed = 0.05;
  for (const key of ["v", " "]) {
    const { bytes, took } = await record(page, speed, () => page.keyboard.press("v"), async () => {
      await page.waitForFunction(() => window.ancf14.player.run.playing && window.ancf14.player.run.time > 0.05);
      await page.keyboard.press(key);
    });
    const { time, playing } = await state(page);
    assert.ok(time > 0.05 && time < STOP && !playing, `ended at ${time} s`);
    const { duration } = await watch(page, bytes, await pictures(page));
    assert.ok(duration > time / speed && duration < Math.min(took, STOP / speed), `${duration} s of a motion of ${time / speed} s, recorded in ${took} s`);
  }
  await close();
});

test("a browser that cannot record has no button", async () => {
  const text = readFileSync(join(folder, "cantilever.html"), "utf8");
  for (const without of ["delete window.MediaRecorder", "delete HTMLCanvasElement.prototype.captureStream", "MediaRecorder.isTypeSupported = () => false"]) {
    writeFileSync(join(folder, "without.html"), text.replace("<script type=", () => `<script>${without}</script><script type=`));
    const { page, close } = await open("without.html");
    assert.equal(await page.locator(button).count(), 0, without);
    assert.equal(await page.locator(".help dt", { hasText: /^V$/ }).count(), 0, without);
    // The key does nothing then.
    await page.keyboard.press("v");
    await settle(page);
    assert.equal((await state(page)).playing, false);
    await close();
  }
});
