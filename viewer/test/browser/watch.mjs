// The page of `ancf14 view --watch` in a real browser: does it show the numbers of the file that was saved last, and a mistake above the last good picture? Does it ask nobody but the
// program, does the program answer nobody else, and does Ctrl-C end it? Needs the program in the variable ANCF14.

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { connect } from "node:net";
import { get } from "node:http";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { ancf14, begin, end, folder, model, program, settle, table, visit } from "./pages.mjs";

const TABLE = "time,push\n0,0\n0.1,-1\n";
const text = `${readFileSync(model("cantilever"), "utf8").replace("stop = 1.0", "stop = 0.1")}
[include.of]
file = "load.toml"

[load.push]
at = "arm.end"
force = [0, 0, "of_push(t)"]
`;
const load = 'format = 1\n\n[function.push]\nfile = "push.csv"\n';
const save = (name, content) => writeFileSync(join(folder, name), content);

/** Starts the program on the model and gives it with the address that it prints. */
async function watch() {
  const child = spawn(program, ["view", "m.toml", "--watch"], { cwd: folder, stdio: ["ignore", "pipe", "ignore"] });
  const ended = new Promise((done) => child.on("exit", (code, signal) => done(code ?? signal)));
  child.stdout.setEncoding("utf8");
  let told = "";
  const address = await new Promise((found, failed) => {
    child.stdout.on("data", (part) => {
      told += part;
      const address = /http:\S+/.exec(told)?.[0];
      if (address) found(address);
    });
    void ended.then((code) => failed(new Error(`it has ended with ${code}`)));
  });
  return { child, ended, address };
}

/** The status of a request. */
const status = (address, headers = {}, method = "GET") => new Promise((done, failed) => {
  get(address, { headers, method }, (answer) => {
    answer.resume();
    done(answer.statusCode);
  }).on("error", failed);
});

/** The last value of an output that the page charts. */
const last = (page) => page.evaluate(() => window.ancf14.data.charts.columns.find(({ name }) => name === "tip.displacement[3]").values.at(-1));

before(begin);
after(end);

test("a saved file is shown, a mistake is told, and the rest of the world is left alone", async () => {
  save("m.toml", text);
  save("load.toml", load);
  save("push.csv", TABLE);
  const { child, ended, address } = await watch();
  try {
    const { page, close } = await visit(address, (url) => url.startsWith(address));
    /** Saves a file, waits for the run, and compares the last row with that of `ancf14 run`. */
    const shows = async (name, content) => {
      await page.evaluate(() => (window.before = window.ancf14));
      save(name, content);
      await page.waitForFunction(() => window.ancf14 !== window.before, null, { timeout: 30000 });
      ancf14("run", "m.toml", "-o", "out");
      // Charts have the very doubles of the table.
      const found = await last(page);
      assert.equal(found, table("out/results.csv")("tip.displacement[3]").at(-1));
      return found;
    };
    const first = await last(page);
    await page.evaluate(() => window.ancf14.player.timeline.seek(0.05));
    const softer = await shows("m.toml", text.replace("young = 2.1e11", "young = 7e10"));
    assert.ok(Math.abs(softer - first) > 0.01 * Math.abs(first), `${softer}, ${first}`);
    // The instant stays.
    assert.ok(Math.abs((await page.evaluate(() => window.ancf14.player.timeline.time)) - 0.05) < 1e-9);
    // Included files and tables are watched as well.
    const pushed = await shows("push.csv", TABLE.replace("-1", "-5"));
    assert.ok(Math.abs(pushed - softer) > 0.01 * Math.abs(softer), `${pushed}, ${softer}`);
    await shows("load.toml", load.replace('file = "push.csv"', "table = [[0, 0], [0.1, 3]]"));

    // A mistake, with its line underlined; the picture stays.
    await page.evaluate(() => (window.before = window.ancf14));
    save("load.toml", load.replace("file", "fiel"));
    const alert = await page.waitForSelector(".watch .error", { timeout: 10000 });
    const words = await alert.textContent();
    const lines = words.split("\n");
    const wrong = lines.findIndex((line) => line.includes('fiel = "push.csv"'));
    assert.ok(wrong > 0 && lines[wrong + 1].indexOf("^^^^") === lines[wrong].indexOf("fiel"), words);
    assert.ok(await page.isVisible(".watch .error"));
    assert.ok(await page.evaluate(() => window.ancf14 === window.before), "the picture has changed");
    if (process.env.ANCF14_SHOTS) await page.screenshot({ path: join(process.env.ANCF14_SHOTS, "watch.png") });
    await shows("load.toml", load);
    assert.equal(await page.locator(".watch .error").count(), 0);

    // Nobody else is answered.
    const { port } = new URL(address);
    const other = address.replace(/\/(.)([^/]*)\/$/, (_, first, rest) => `/${first === "0" ? "1" : "0"}${rest}/`);
    assert.equal(await status(address), 200);
    for (const name of ["", "news", "data"]) {
      assert.equal(await status(`${other}${name}`), 403);
      assert.equal(await status(`${address}${name}`, { host: `evil.example:${port}` }), 403);
    }
    assert.equal(await status(new URL("/", address)), 403);
    assert.equal(await status(address, {}, "POST"), 405);
    await assert.rejects(status(address.replace("127.0.0.1", "127.0.0.2")), "it listens on other addresses, too");

    // Clients that say nothing, or half of something, or do not read, keep nobody waiting.
    const lazy = Array.from({ length: 50 }, (_, k) => {
      const client = connect(Number(port), "127.0.0.1");
      client.on("error", () => {});
      if (k % 2) client.write(k % 4 === 1 ? "GET /" : `GET ${new URL(address).pathname}data HTTP/1.1\r\nHost: 127.0.0.1:${port}\r\n\r\n`);
      client.pause();
      return client;
    });
    await new Promise((go) => setTimeout(go, 200));
    const begun = Date.now();
    assert.equal(await status(`${address}news`), 200);
    assert.ok(Date.now() - begun < 2000, `${Date.now() - begun} ms`);
    await shows("m.toml", text);
    lazy.forEach((client) => client.destroy());

    child.kill("SIGINT");
    assert.equal(await ended, 0);
    await page.waitForFunction(() => document.querySelector(".watch .error")?.textContent.includes("does not answer"), null, { timeout: 10000 });
    await settle(page);
    // That nobody answers any more, the browser complains of as well; a question that was on its way is reset.
    await close((complaint) => /ERR_CONNECTION_(REFUSED|RESET)/.test(complaint));
  } finally {
    child.kill("SIGKILL");
  }
});

test("a model that is wrong from the start is shown once it is right, and no run is waited for that is out of date", async () => {
  save("m.toml", text.replace("young", "yuong"));
  save("load.toml", load);
  save("push.csv", TABLE);
  const { child, ended, address } = await watch();
  try {
    const { page, close } = await visit(address, (url) => url.startsWith(address), ".watch .error");
    assert.match(await page.textContent(".watch .error"), /yuong/);
    assert.equal(await page.evaluate(() => window.ancf14), undefined);
    // A run that would take hours is given up when the file is saved again.
    save("m.toml", text.replace("stop = 0.1", "stop = 1e4"));
    await page.waitForFunction(() => document.querySelector(".watch progress:not([hidden])")?.value > 0, null, { timeout: 30000 });
    save("m.toml", text);
    await page.waitForFunction(() => window.ancf14, null, { timeout: 30000 });
    assert.equal(await page.locator(".watch .error").count(), 0);
    // What the run warns of can be put away.
    const warning = await page.waitForSelector(".watch .warning", { timeout: 10000 });
    assert.match(await warning.textContent(), /^Warning: tip\.velocity is off by about/);
    if (process.env.ANCF14_SHOTS) await page.screenshot({ path: join(process.env.ANCF14_SHOTS, "warned.png") });
    await page.click(".watch button");
    assert.equal(await page.locator(".watch .warning").count(), 0);
    await close();
    child.kill("SIGINT");
    assert.equal(await ended, 0);
  } finally {
    child.kill("SIGKILL");
  }
});
