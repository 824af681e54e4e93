// Pictures of pages and of the studio, in this folder: node pictures.mjs BINARY DESIGN PAGE.html[=HEADING:FIGURES] ...
// Of a page with a heading that and so many figures behind it, whole with their captions, else its first screen. Of the studio a changed
// number beside the pinned design.
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
    const [heading, count] = part.split(":");
    const clip = await page.evaluate(
      ([words, most]) => {
        const all = [...document.querySelectorAll("h2, figure")];
        const from = all.findIndex((one) => one.tagName === "H2" && one.textContent.includes(words));
        const figures = all.slice(from).filter((one) => one.tagName === "FIGURE").slice(0, most);
        // What of a figure is seen: its parts, not its place.
        const parts = figures.flatMap((figure) => [...figure.children]).filter((one) => one.checkVisibility());
        const boxes = [all[from], ...parts].map((one) => one.getBoundingClientRect());
        const [x, y] = [Math.min(...boxes.map((b) => b.left)) - 12, boxes[0].top - 12 + scrollY];
        const right = Math.max(...boxes.slice(1).map((b) => b.right)) + 12;
        return { x, y, width: right - x, height: Math.max(...boxes.map((b) => b.bottom)) + scrollY + 12 - y };
      },
      [heading, Number(count)],
    );
    Object.assign(to, { fullPage: true, clip });
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
await page.locator('.field[data-path="sprags.inner_arcs[0].radius_mm"] input[inputmode=decimal]').fill("3.1");
await page.keyboard.press("Tab");
await answered(before);
await page.evaluate(() => document.activeElement.blur());
await page.waitForTimeout(1000);
await page.screenshot({ path: "studio.png" });
server.kill("SIGINT");
await browser.close();
