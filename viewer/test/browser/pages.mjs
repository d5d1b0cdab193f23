// What the tests of whole pages share: the program, its pages in a real browser from the disk, its tables.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { launch } from "./chromium.mjs";

const root = fileURLToPath(new URL("../../..", import.meta.url));
export const program = resolve(root, process.env.ANCF14 ?? "target/fmu/ancf14");
export const models = join(root, "models");
export const folder = mkdtempSync(join(tmpdir(), "ancf14-view-"));
export const ancf14 = (...words) => execFileSync(program, words, { cwd: folder, stdio: ["ignore", "pipe", "ignore"], encoding: "utf8" });
export const model = (name) => join(models, `${name}.toml`);

/** The columns of results.csv. */
export function table(path) {
  const [head, ...rows] = readFileSync(join(folder, path), "utf8").trim().split("\n");
  const names = head.split(",");
  const numbers = rows.map((row) => row.split(",").map(Number));
  return (name) => numbers.map((row) => row[names.indexOf(name)]);
}

let browser;

export async function begin() {
  browser = await launch();
}

export async function end() {
  await browser?.close();
  rmSync(folder, { recursive: true });
}

/** Opens a page from the disk, which may ask for nothing; `hash` is the end of its address. */
export const open = (name, { hash = "", ...options } = {}) => visit(pathToFileURL(join(folder, name)).href + hash, () => false, undefined, options);

/**
 * Opens the page of an address and keeps what it complains of and asks for; `may` says which addresses it may ask for in addition to its own. Waits for what is shown, or for an element.
 */
export async function visit(address, may, selector, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options });
  const page = await context.newPage();
  const complaints = [];
  const requests = [];
  page.on("console", (message) => ["error", "warning"].includes(message.type()) && complaints.push(message.text()));
  page.on("pageerror", (error) => complaints.push(error.message));
  page.on("request", (request) => requests.push(request.url()));
  await page.goto(address);
  if (selector) await page.waitForSelector(selector, { timeout: 30000 });
  else await page.waitForFunction(() => window.ancf14, null, { timeout: 30000 });
  await settle(page);
  const close = async (expected = () => false) => {
    // A software renderer tells how slowly it reads pixels back; the blob is the page's own, made to unpack its data.
    assert.deepEqual(complaints.filter((text) => !text.includes("GPU stall") && !expected(text)), [], "the page complains");
    assert.deepEqual(requests.filter((url) => url !== address.split("#")[0] && url !== address && !may(url) && !url.startsWith("data:") && !url.startsWith("blob:")), [], "the page asks for something");
    await context.close();
  };
  return { page, close };
}

/** Waits until what has changed is drawn. */
export const settle = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done)))));
