// Pages and the studio as they are seen, each printed into FOLDER: node pictures.mjs FOLDER BINARY DESIGN PAGE.html ... Ends with 1 where a page is wider than its
// window, a table is scrolled at 1280 px, a figure is wider than a phone or has letters below 11 px there, or where neither its answer nor the drawing is in the first screen. STUDIES: names of pages that show no one clutch.
// PICTURES: the folder of pictures, where there are to be any.
import { spawn } from "node:child_process";
import path from "node:path";
import { chromium } from "playwright-core";

const HEIGHT = { 1280: 900, 390: 844 };
const [folder, binary, design, ...files] = process.argv.slice(2);
const pictures = process.env.PICTURES;
const studies = (process.env.STUDIES || "").split(" ");
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM || "/usr/bin/chromium", args: ["--no-sandbox"] });
let found = 0;
const say = (words) => {
  console.log(words);
  found = 1;
};

// Figures that are wider than the window, and the smallest text of one.
function unfit() {
  const seen = [...document.querySelectorAll("figure svg")].filter((svg) => svg.parentElement.tagName === "FIGURE" && svg.checkVisibility());
  const name = (svg) => svg.querySelector("title")?.textContent ?? "a figure";
  const wide = seen.filter((svg) => svg.getBoundingClientRect().right > innerWidth).map((svg) => `${name(svg)} does not fit`);
  const px = (svg) => (12 * svg.getBoundingClientRect().width) / svg.viewBox.baseVal.width;
  const small = seen.filter((svg) => px(svg) < 11).map((svg) => `${name(svg)} has letters of ${px(svg).toFixed(1)} px`);
  return [...wide, ...small];
}

// Tables that are scrolled, by their first heading.
function cut() {
  const seen = [...document.querySelectorAll(".table")].filter((t) => t.checkVisibility());
  return seen.filter((t) => t.scrollWidth > t.clientWidth).map((t) => t.querySelector("th")?.textContent ?? "");
}

async function look(name, address, ready) {
  for (const width of [1280, 390]) {
    const page = await browser.newPage({ viewport: { width, height: HEIGHT[width] } });
    await page.goto(address);
    await ready?.(page);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    if (wide > width) say(`${name}: ${wide} px wide in a window of ${width}`);
    if (width === 390 && name !== "studio") for (const what of await page.evaluate(unfit)) say(`${name}: on a phone ${what}`);
    if (width === 1280 && name !== "studio") {
      for (const what of await page.evaluate(cut)) say(`${name}: the table ${what} is cut`);
      const top = (pick) => page.evaluate((p) => document.querySelector(p)?.getBoundingClientRect().top ?? Infinity, pick);
      if ((await top(".verdict")) > 300) say(`${name}: no answer at the top`);
      // Half of the drawing at least.
      if (!studies.includes(name) && (await top("figure.true")) > HEIGHT[width] - 230) say(`${name}: no drawing in the first screen`);
    }
    // Of the many pages of `check` the sheets do.
    if (pictures && !name.startsWith("check-")) await page.screenshot({ path: `${pictures}/${name}-${width}.png`, fullPage: true });
    if (width === 1280) await page.pdf({ path: `${folder}/${name}.pdf`, format: "A4", preferCSSPageSize: true });
    await page.close();
  }
}

for (const file of files) await look(path.basename(file, ".html"), "file://" + path.resolve(file));

const server = spawn(binary, ["studio", design, "--no-open", "--quiet"], { stdio: ["ignore", "pipe", "inherit"] });
const address = await new Promise((answer, failed) => {
  server.stdout.once("data", (line) => answer(line.toString().trim()));
  server.once("exit", () => failed(new Error("the studio ended at once")));
});
await look("studio", address, (page) =>
  page.waitForFunction(() => /^(NOT )?HELD: /.test(document.getElementById("banner").textContent), null, { timeout: 60000 }),
);
server.kill("SIGINT");
await browser.close();
process.exit(found);
