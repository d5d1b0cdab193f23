// The documentation inside an FMU, from the disk: does it show the mechanism as drawn, as one small file that asks for nothing? Needs the program in the variable ANCF14, and Python to unpack
// the FMU.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { ancf14, begin, end, folder, model, program, visit } from "./pages.mjs";

before(begin);
after(end);

test("the documentation of an FMU shows the mechanism as drawn", async () => {
  // A program is as good as a library: no host loads it here.
  ancf14("pack", model("crane"), "-o", "crane.fmu", "--library", program);
  execFileSync("python3", ["-m", "zipfile", "-e", "crane.fmu", "crane"], { cwd: folder });
  const file = join(folder, "crane/documentation/index.html");
  assert.ok(readFileSync(file).length < 1.2e6);
  const { page, close } = await visit(pathToFileURL(file).href, (address) => address === "about:srcdoc", "iframe");
  const frame = page.frames()[1];
  await frame.waitForFunction(() => window.ancf14, null, { timeout: 30000 });
  const found = await frame.evaluate(() => {
    const { data, player } = window.ancf14;
    return { name: data.scene.name, instants: data.times.length, beams: data.scene.beams.length, colored: Boolean(player.quantity) };
  });
  assert.deepEqual(found, { name: "Crane", instants: 1, beams: 2, colored: false });
  assert.equal(await frame.locator("input.scrub").count(), 0, "what stands still has a time line");
  await frame.locator("canvas").first().hover();
  await page.mouse.wheel(0, -200);
  await close();
});
