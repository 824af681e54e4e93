// The studio as one page: node compose.mjs ENGINE.wasm DESIGN.toml PAGE.html
import { readFileSync, renameSync, writeFileSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

const [engine, design, page] = process.argv.slice(2);
const wasm = readFileSync(engine);
const beside = (name) => readFileSync(join(dirname(fileURLToPath(import.meta.url)), name), "utf8");
const instance = new Function(`${beside("instance.js")}\nreturn instance;`)();
const exports = await instance(wasm);
const bytes = exports.page();
const html = new TextDecoder().decode(new Uint8Array(exports.memory.buffer, exports.answered(), bytes));
const first = { text: readFileSync(design, "utf8"), file: basename(design), save_as: basename(design) };
const parts = [
  `<script type="application/json" id="first">${JSON.stringify(first).replaceAll("<", "\\u003c")}</script>`,
  `<script type="text/plain" id="engine">${gzipSync(wasm, { level: 9 }).toString("base64")}</script>`,
  `<script type="text/plain" id="instance">${beside("instance.js")}</script>`,
  `<script>\n${beside("engine.js")}</script>`,
];
const mark = "<!--engine-->";
if (!html.includes(mark)) throw new Error(`the page has no mark ${mark}`);
writeFileSync(page + ".tmp", html.replace(mark, () => parts.join("\n")));
renameSync(page + ".tmp", page);
console.log(`${page}: ${(Buffer.byteLength(readFileSync(page)) / 1e6).toFixed(2)} MB`);
