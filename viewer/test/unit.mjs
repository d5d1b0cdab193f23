// Bundles the unit tests, which are TypeScript, and runs them by node's own test runner.

import { build } from "esbuild";
import { spawnSync } from "node:child_process";
import { readdirSync } from "node:fs";
import { fileURLToPath } from "node:url";

const root = fileURLToPath(new URL("..", import.meta.url));
const names = readdirSync(`${root}/test`).filter((name) => name.endsWith(".test.ts"));
await build({
  entryPoints: names.map((name) => `${root}/test/${name}`),
  outdir: `${root}/node_modules/.tests`,
  outExtension: { ".js": ".mjs" },
  bundle: true,
  platform: "node",
  format: "esm",
  target: "node18",
});
const files = names.map((name) => `${root}/node_modules/.tests/${name.replace(/ts$/, "mjs")}`);
process.exit(spawnSync(process.execPath, ["--test", ...files], { cwd: root, stdio: "inherit" }).status ?? 1);
