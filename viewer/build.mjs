// Makes dist/viewer.js and dist/viewer.css of src/, which the program of ancf14 carries, and licenses/viewer.txt; with --check only compares them with what is
// there.
//
// The first line of viewer.js has a hash of all that it is made of: a test of the Rust side compares it without node.

import { build } from "esbuild";
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";

const here = (path) => fileURLToPath(new URL(path, import.meta.url));
const text = (path) => readFileSync(here(path), "utf8");

/** Everything that the bundle depends on, in a fixed order. */
const sources = ["build.mjs", "package-lock.json", ...readdirSync(here("src")).sort().map((name) => `src/${name}`)];
// FNV-1a, 64 bits: no secret, only a mark that both sides compute alike.
let hash = 0xcbf29ce484222325n;
for (const path of sources) {
  for (const byte of Buffer.concat([Buffer.from(`${path}\n`), readFileSync(here(path))])) {
    hash = BigInt.asUintN(64, (hash ^ BigInt(byte)) * 0x100000001b3n);
  }
}
const digest = hash.toString(16).padStart(16, "0");

const licence = (name) => {
  const { version } = JSON.parse(text(`node_modules/${name}/package.json`));
  return `${name} ${version}\n\n${text(`node_modules/${name}/LICENSE`).trim()}\n`;
};
const licences = `${licence("three")}\n${licence("uplot")}`;

const options = { bundle: true, minify: true, format: "iife", target: "es2022", charset: "utf8", legalComments: "none", write: false };
const worker = await build({ ...options, entryPoints: [here("src/worker.ts")] });
const result = await build({
  ...options,
  entryPoints: [here("src/main.ts")],
  outfile: here("dist/viewer.js"),
  // The page makes its workers of this text: it loads nothing.
  define: { WORKER: JSON.stringify(worker.outputFiles[0].text) },
});
const output = (end) => result.outputFiles.find((file) => file.path.endsWith(end)).text;
const banner = `// sources: ${digest}\n/*! Contains:\n\n${licences}*/\n`;
// Nothing may end the script that the program stands in.
const files = {
  "dist/viewer.js": banner + output(".js").replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--"),
  "dist/viewer.css": output(".css"),
  "../licenses/viewer.txt": `Licences of the software in the page that ancf14 view writes\n\n${licences}`,
};

for (const [name, content] of Object.entries(files)) {
  if (!process.argv.includes("--check")) writeFileSync(here(name), content);
  else if (text(name) !== content) {
    console.error(`viewer/${name} does not belong to the sources: run npm run build in viewer/`);
    process.exit(1);
  }
}
