// Pictures of pages and of the studio, in this folder: node pictures.mjs BINARY DESIGN PAGE.html[=HEADING:HEIGHT] ...
// Of a page with a heading the part that begins there, else its first screen. Of the studio a changed number beside the pinned design.
import { spawn } from "node:child_process";
import path from "node:path";
import { chromium } from "playwright-core";

const [binary, design, ...pages] = process.argv.slice(2);
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM || "/usr/bin/chromium", args: ["--no-sandbox"] });
const page = await browser.newPage({ viewport: { width: 1280, height: 860 } });
for (const asked of pages) {
  const [file, part] = asked.split("=");
  await page.goto("file://" + path.resolve(file));
  const to = { path: `${path.basename(file, ".html")}.png` };
  if (part) {
    const [heading, height] = part.split(":");
    const { y } = await page.locator("h2", { hasText: heading }).first().boundingBox();
    Object.assign(to, { fullPage: true, clip: { x: 100, y: y - 10, width: 800, height: Number(height) } });
  }
  await page.screenshot(to);
}

const server = spawn(binary, ["studio", design, "--no-open", "--quiet"], { stdio: ["ignore", "pipe", "inherit"] });
const address = await new Promise((found, failed) => {
  server.stdout.once("data", (line) => found(line.toString().trim()));
  server.once("exit", () => failed(new Error("the studio ended at once")));
});
await page.goto(address);
// The verdict counts the scenes too once they have followed.
const answered = (before) =>
  page.waitForFunction(
    (was) => {
      const now = document.getElementById("banner").textContent;
      return now !== was && /^(NOT )?HELD: .* required limits/.test(now) && !document.querySelector("tr.stale");
    },
    before,
    { timeout: 60000 },
  );
await answered("");
await page.click("#pin");
const before = await page.textContent("#banner");
await page.locator('.field[data-path="sprags.inner_arcs[0].radius_mm"] input[type=number]').fill("3.1");
await page.keyboard.press("Tab");
await answered(before);
await page.evaluate(() => document.activeElement.blur());
await page.waitForTimeout(1000);
await page.screenshot({ path: "studio.png" });
server.kill("SIGINT");
await browser.close();
