// Takes pictures of pages: node shots.mjs [--dark] [--narrow] [--keys=nt] [--at=0.35] [--instant] [--page] FOLDER PAGE.html...; prints what it finds in the console.
//
// --page makes the one of README.md, --gallery the small ones of docs/gallery, without charts and controls.

import { basename } from "node:path";
import { pathToFileURL } from "node:url";
import { launch } from "./chromium.mjs";

const words = process.argv.slice(2);
const [folder, ...pages] = words.filter((word) => !word.startsWith("--"));
const has = (word) => words.includes(`--${word}`);
const share = Number(words.find((word) => word.startsWith("--at="))?.slice(5) ?? 0.35);
const browser = await launch();
const viewport = has("narrow") ? { width: 390, height: 800 } : has("page") ? { width: 920, height: 520 } : has("gallery") ? { width: 620, height: 430 } : { width: 1280, height: 800 };
const context = await browser.newContext({ viewport, colorScheme: has("dark") ? "dark" : "light" });
for (const path of pages) {
  const page = await context.newPage();
  page.on("console", (message) => ["error", "warning"].includes(message.type()) && !message.text().includes("GPU stall") && console.log(path, message.text()));
  page.on("pageerror", (error) => console.log(path, error.message));
  await page.goto(pathToFileURL(path).href);
  await page.waitForFunction(() => window.ancf14, null, { timeout: 20000 });
  await page.evaluate((share) => {
    const { player } = window.ancf14;
    player.timeline.seek(player.timeline.start + share * player.timeline.duration);
  }, share);
  // As on a wide screen, with the picture alone.
  if (has("gallery")) await page.addStyleTag({ content: ".side, .controls, .tools, .timeline { display: none !important } .stage { height: calc(100vh - 55px) !important }" });
  if (has("gallery")) await page.waitForTimeout(200);
  if (has("gallery")) await page.evaluate(() => window.ancf14.view("iso"));
  for (const key of words.find((word) => word.startsWith("--keys="))?.slice(7) ?? "") await page.keyboard.press(key);
  if (has("instant")) await page.evaluate(() => (window.ancf14.player.ranging = "instant", window.ancf14.player.refresh()));
  await page.waitForTimeout(500);
  // A slow machine may still be at the first picture.
  await page.evaluate(() => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn))));
  const kind = ["dark", "narrow"].filter(has).map((word) => `-${word}`).join("");
  await page.screenshot({ path: `${folder}/${basename(path, ".html")}${kind}.png`, fullPage: has("narrow") });
  await page.close();
}
await browser.close();
