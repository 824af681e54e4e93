// The studio in a real browser: node studio.mjs BINARY DESIGN PICTURES
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { existsSync, readFileSync } from "node:fs";
import http from "node:http";
import { chromium } from "playwright-core";

const [binary, design, pictures] = process.argv.slice(2);
const server = spawn(binary, ["studio", design, "--no-open"], { stdio: ["ignore", "pipe", "inherit"] });
const address = await new Promise((found, failed) => {
  server.stdout.once("data", (line) => found(line.toString().trim()));
  server.once("exit", () => failed(new Error("the studio ended at once")));
});
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM || "/usr/bin/chromium", args: ["--no-sandbox"] });
const context = await browser.newContext({ viewport: { width: 1280, height: 900 } });
const faults = [];
async function open() {
  const page = await context.newPage();
  page.on("pageerror", (error) => faults.push(String(error)));
  page.on("console", (message) => message.type() === "error" && !/422|403|ERR_CONNECTION/.test(message.text()) && faults.push(message.text()));
  await page.goto(address);
  await page.waitForSelector('#margins tr[data-code="hertz-nominal-inner"]');
  return page;
}
const step = (name) => console.log("studio:", name);
const margin = (page, code) => page.textContent(`#margins tr[data-code="${code}"] td:nth-child(2)`);
const answer = (...sets) => {
  const args = ["check", design, "--json", "--quiet", ...sets.flatMap((s) => ["--set", s])];
  let text;
  try { text = execFileSync(binary, args); } catch (error) { text = error.stdout; }
  return JSON.parse(text);
};
const checked = (...sets) => Object.fromEntries(answer(...sets).margins.map((m) => [m.code, m.margin]));
const percent = (text) => Number(text.replace("−", "-").replace(/\s*%.*/s, "")) / 100;
const close = (text, value) => assert.ok(Math.abs(percent(text) - value) <= 6e-3 * Math.abs(value) + 1e-9, `${text} beside ${value}`);
const path = "sprags.inner_arcs[1].radius_mm";
const slider = (page, of = path) => page.locator(`.field[data-path="${of}"] input[type=range]`);
const number = (page, of = path) => page.locator(`.field[data-path="${of}"] input[inputmode=decimal]`);
const set = (locator, value) => locator.evaluate((input, value) => {
  input.focus();
  input.value = value;
  input.dispatchEvent(new Event("input", { bubbles: true }));
  input.dispatchEvent(new Event("change", { bubbles: true }));
}, String(value));

try {
  const page = await open();
  step("opens with the margins that check prints");
  close(await margin(page, "hertz-nominal-inner"), checked()["hertz-nominal-inner"]);
  await page.waitForFunction(() => document.querySelectorAll("#scenes tr:not(.stale)").length >= 4, null, { timeout: 60000 });
  await page.waitForFunction(() => /^HELD: all [0-9]+ required limits/.test(document.getElementById("banner").textContent), null, { timeout: 60000 });
  assert.match(await page.textContent("#figures"), /outside ⌀52.46 mm.*mass/);
  const carries = await page.textContent("#figures");
  for (const kind of ["nominal", "peak"]) {
    const { code, torque_capacity_nm: nm } = answer()[`${kind}_torque_capacity`];
    assert.ok(carries.includes(`carries, ${kind}${Number(nm.toPrecision(4))} Nm (${code})`), carries);
  }
  assert.match(await page.textContent('#margins tr[data-code="hertz-nominal-inner"]'), /at [0-9.]+ Nm/);
  await page.screenshot({ path: `${pictures}/studio-1280.png`, fullPage: true });

  step("a slider's move is answered by the number that check prints");
  await page.click("#pin");
  const before = await margin(page, "hertz-nominal-inner");
  await set(slider(page), 4.2);
  await page.waitForFunction((was) => document.querySelector('#margins tr[data-code="hertz-nominal-inner"] td:nth-child(2)').textContent !== was, before);
  const value = await number(page).inputValue();
  await page.waitForFunction(() => document.querySelector('#margins tr[data-code="hertz-nominal-inner"] .was'));
  close(await margin(page, "hertz-nominal-inner"), checked(`${path}=${value}`)["hertz-nominal-inner"]);
  assert.ok(await page.locator("#live .ghost").count(), "the pinned design is drawn");
  assert.match(await page.innerHTML("#windup"), /pinned/);

  step("an answer that comes late does not undo a move");
  await page.click("#unpin");
  await page.route("**/ask/check", async (route) => { await new Promise((done) => setTimeout(done, 400)); await route.continue(); });
  await page.click("#pin");
  await set(number(page), 4.25);
  await page.waitForFunction((path) => Number(document.querySelector(`.field[data-path="${CSS.escape(path)}"] input[inputmode=decimal]`).value) === 4.25, path);
  await page.waitForTimeout(900);
  close(await margin(page, "hertz-nominal-inner"), checked(`${path}=4.25`)["hertz-nominal-inner"]);
  await page.unroute("**/ask/check");
  await page.click("#unpin");
  await set(number(page), 4.2);
  await page.waitForFunction((path) => Number(document.querySelector(`.field[data-path="${CSS.escape(path)}"] input[inputmode=decimal]`).value) === 4.2, path);

  step("moves are answered in time");
  for (const pinned of [false, true]) {
    if (pinned) { await page.click("#pin"); await page.waitForFunction(() => !document.getElementById("unpin").disabled); }
    const times = await page.evaluate(async (path) => {
      const out = [];
      const input = document.querySelector(`.field[data-path="${CSS.escape(path)}"] input[type=range]`);
      for (let i = 0; i < 20; i++) {
        const begun = performance.now();
        await new Promise((done) => {
          const watch = new MutationObserver(() => { watch.disconnect(); done(); });
          watch.observe(document.getElementById("windup"), { childList: true });
          input.value = 4.1 + 0.005 * i;
          input.dispatchEvent(new Event("input"));
        });
        out.push(performance.now() - begun);
      }
      return out.sort((a, b) => a - b);
    }, path);
    console.log(`  20 moves${pinned ? ", with a pinned design" : ""}: median ${times[10].toFixed(0)} ms, slowest ${times[19].toFixed(0)} ms`);
  }
  await page.click("#unpin");

  step("undo");
  // Asked and clicked in one turn of the page, so that the button cannot go grey between the two.
  const undone = () => page.evaluate(() => { const button = document.getElementById("undo"); button.click(); return button.disabled; });
  for (let i = 0; i < 100 && !await undone(); i++) await page.waitForTimeout(50);
  await page.waitForFunction((was) => document.querySelector('#margins tr[data-code="hertz-nominal-inner"] td:nth-child(2)').textContent.startsWith(was), before.trim());

  step("a bad value is refused beside its field and nothing is lost");
  await set(number(page), -4);
  await page.waitForSelector(`.field[data-path="${path}"] .error:not(:empty)`);
  assert.match(await page.textContent(`.field[data-path="${path}"] .error`), /line \d+.*-4/s);
  close(await margin(page, "hertz-nominal-inner"), checked()["hertz-nominal-inner"]);
  assert.match(await page.textContent("#banner"), /^sprags\.inner_arcs\[1\]\.radius_mm refused; without it: /);
  const peak = "limits.peak_torque_nm", fault = (of) => page.textContent(`.field[data-path="${of}"] .error`);
  await set(number(page, peak), "105,5");
  assert.match(await fault(peak), /decimals stand behind a point/);
  await set(number(page, peak), "105.5");
  await page.waitForFunction(() => [...document.querySelectorAll(".field .error")].every((e) => e.textContent === ""));
  assert.ok(!(await page.textContent("#banner")).includes("refused"));
  await set(number(page), 4.08);
  await page.waitForFunction(() => document.getElementById("work").textContent === "");

  await set(number(page), 4.11);
  await page.waitForFunction(() => !document.getElementById("undo").disabled);
  await page.click("#undo");
  await page.waitForFunction((path) => Number(document.querySelector(`.field[data-path="${CSS.escape(path)}"] input[inputmode=decimal]`).value) === 4.08, path);

  step("a scene is played");
  await page.selectOption("#mode", "high-10");
  await page.waitForSelector("#course:not([hidden])");
  const pose = () => page.getAttribute("#live .sprag", "transform");
  const first = await pose();
  await page.selectOption("#pace", "4");
  await page.click("#play");
  await page.waitForFunction((was) => document.querySelector("#live .sprag").getAttribute("transform") !== was, first);
  assert.match(await page.textContent("#verdict"), /high-10: (sticks|slips)/);
  await page.click("#play");
  await page.screenshot({ path: `${pictures}/studio-scene-1280.png`, fullPage: true });

  step("saved with its comments, and never over a file unasked");
  await set(slider(page), 4.15);
  await page.waitForTimeout(500);
  const save = async (name, replace) => {
    if (!(await page.evaluate(() => document.getElementById("saving").open))) await page.click("#save");
    await page.fill("#filename", name);
    await page.setChecked("#replace", replace);
    await page.evaluate(() => { document.getElementById("work").textContent = ""; });
    await page.click('#saving button[value="save"]');
    await page.waitForFunction(() => document.getElementById("work").textContent !== "");
    return page.textContent("#work");
  };
  assert.match(await save("new.toml", false), /written/);
  const comments = (file) => readFileSync(file, "utf8").split("\n").filter((l) => l.includes("#")).length;
  assert.ok(comments("new.toml") >= comments(design));
  assert.match(await save("new.toml", false), /exists; tick the box/);
  assert.match(await save(design, false), /exists; tick the box/);
  assert.match(await save("../evil.toml", false), /plain file name/);
  assert.ok(!existsSync("../evil.toml"));
  assert.equal(await page.inputValue("#filename"), "../evil.toml");
  assert.match(await page.textContent("#unsaved"), /plain file name/);
  await page.click('#saving button[value="cancel"]');

  step("two pages do not disturb each other");
  const other = await open();
  await set(slider(other), 4.3);
  await other.waitForTimeout(300);
  assert.notEqual(await number(other).inputValue(), await number(page).inputValue());
  await other.setViewportSize({ width: 390, height: 844 });
  await other.waitForTimeout(300);
  const wide = await other.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(wide <= 390, `the page is ${wide} px wide on a phone`);
  await other.screenshot({ path: `${pictures}/studio-390.png`, fullPage: true });

  step("a search is begun and stopped");
  // A search may take less than a second: what the page says of it is kept as it comes.
  await page.evaluate(() => {
    const work = document.getElementById("work");
    window.told = [];
    new MutationObserver(() => window.told.push(work.textContent)).observe(work, { childList: true, characterData: true, subtree: true });
  });
  await page.click("#optimise");
  await page.waitForFunction(() => window.told.some((text) => /searching: [0-9]/.test(text)), null, { timeout: 60000, polling: 20 });
  if (await page.textContent("#optimise") === "Stop") await page.click("#optimise");
  await page.waitForFunction(() => document.getElementById("optimise").textContent === "Optimise", null, { timeout: 60000 });

  step("strangers are refused");
  const ask = (headers, path, method = "GET") => new Promise((done) => {
    const { port } = new URL(address);
    http.request({ host: "127.0.0.1", port, path, method, headers }, (answer) => { answer.resume(); done(answer.statusCode); }).end();
  });
  const home = new URL(address).pathname;
  assert.equal(await ask({}, home), 200);
  assert.equal(await ask({ Host: "evil.example" }, home), 403);
  assert.equal(await ask({}, "/"), 403);
  assert.equal(await ask({ Origin: "http://evil.example" }, home + "ask/open", "POST"), 403);
  assert.equal(await ask({}, home + "../../etc/passwd"), 404);
  const port = new URL(address).port;
  try { execFileSync(binary, ["studio", design, "--no-open", "--port", port], { stdio: "pipe", timeout: 20000 }); assert.fail("a busy port was taken"); }
  catch (error) { assert.equal(error.status, 3); assert.match(error.stderr.toString(), new RegExp(port)); }

  step("a server that has gone is told, and nothing is lost");
  server.kill("SIGINT");
  const code = await new Promise((done) => server.once("exit", done));
  assert.equal(code, 0);
  const kept = await number(page).inputValue();
  await set(slider(page), 4.22);
  await page.waitForFunction((path) => document.querySelector(`.field[data-path="${CSS.escape(path)}"] .error`).textContent.includes("does not answer"), path);
  assert.ok(kept);
  assert.deepEqual(faults, []);
  console.log("studio: all held; pictures in", pictures);
} catch (error) {
  console.error(error);
  process.exitCode = 1;
} finally {
  server.kill("SIGKILL");
  await browser.close();
}
