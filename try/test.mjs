// The page in a real browser, opened from disk: node test.mjs PAGE BINARY DESIGN PICTURES
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { chromium } from "playwright-core";

const [page_file, binary, design, pictures] = process.argv.slice(2);
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM || "/usr/bin/chromium", args: ["--no-sandbox"] });
const page = await (await browser.newContext({ viewport: { width: 1280, height: 900 } })).newPage();
const faults = [];
page.on("pageerror", (error) => faults.push(String(error)));
page.on("console", (message) => message.type() === "error" && faults.push(message.text()));
page.on("request", (request) => /^(file|blob|data):/.test(request.url()) || faults.push(`asked for ${request.url()}`));
const looked = (set) => page.evaluate(async (value) => {
  let text = state.text;
  if (value !== null) text = (await engine.ask("change", { text, path: "sprags.inner_arcs[1].radius_mm", value, pinned: null })).text;
  const look = await engine.ask("check", { text, pinned: null });
  return Object.fromEntries(look.margins.map((m) => [m.code, m.margin]));
}, set);
const checked = (set) => {
  const args = ["check", design, "--json", "--quiet", ...(set ? ["--set", `sprags.inner_arcs[1].radius_mm=${set}`] : [])];
  let text;
  try { text = execFileSync(binary, args, { stdio: ["ignore", "pipe", "ignore"] }); } catch (error) { text = error.stdout; }
  return Object.fromEntries(JSON.parse(text).margins.map((m) => [m.code, m.margin]));
};
try {
  await page.goto("file://" + page_file);
  await page.waitForSelector('#margins tr[data-code="hertz-nominal-inner"]', { timeout: 60000 });
  for (const set of [null, "4.2", "3.95"]) {
    const [here, there] = [await looked(set), checked(set)];
    let same = 0, worst = 0;
    for (const code of Object.keys(here)) {
      if (here[code] === there[code]) same++;
      worst = Math.max(worst, Math.abs(here[code] - there[code]) / Math.max(1e-3, Math.abs(there[code])));
    }
    console.log(`try: r_i2 ${set ?? "as given"}: ${same} of ${Object.keys(here).length} margins equal to the bit, worst ${worst.toExponential(1)}`);
    assert.ok(worst < 1e-9);
    // What is printed is the same to the last digit.
    const printed = (margins) => Object.fromEntries(Object.keys(here).map((code) => [code, (100 * margins[code]).toPrecision(4)]));
    assert.deepEqual(printed(here), printed(there));
  }
  const slider = page.locator('.field[data-path="sprags.inner_arcs[1].radius_mm"] input[type=range]');
  const times = [];
  for (let i = 0; i < 10; i++) times.push(await slider.evaluate(async (input, i) => {
    const begun = performance.now();
    await new Promise((done) => {
      new MutationObserver((_, watch) => { watch.disconnect(); done(); }).observe(document.getElementById("windup"), { childList: true });
      input.value = 4.1 + 0.01 * i;
      input.dispatchEvent(new Event("input", { bubbles: true }));
    });
    return performance.now() - begun;
  }, i));
  console.log(`try: a slider's move ${times.sort((a, b) => a - b)[5].toFixed(0)} ms`);
  await page.selectOption("#mode", "high-10");
  await page.waitForSelector("#course:not([hidden])", { timeout: 30000 });
  await page.waitForFunction(() => document.querySelectorAll("#scenes tr:not(.stale)").length >= 4, null, { timeout: 60000 });
  await page.screenshot({ path: `${pictures}/try-1280.png` });
  await page.setInputFiles("#load input", { name: "own.toml", mimeType: "application/toml", buffer: Buffer.from("schema = 1\nname = \"<b>x\"\n") });
  await page.waitForFunction(() => /own.toml/.test(document.getElementById("banner").textContent) || document.getElementById("banner").className.includes("broken"));
  assert.deepEqual(faults, []);
  console.log("try: all held");
} finally {
  await browser.close();
}
