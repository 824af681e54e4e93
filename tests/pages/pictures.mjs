// Pictures of pages: node pictures.mjs FOLDER PAGE.html ...
import { chromium } from "playwright-core";
import path from "node:path";

const [folder, ...pages] = process.argv.slice(2);
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM || "/usr/bin/chromium", args: ["--no-sandbox"] });
for (const file of pages) {
  const name = path.basename(file, ".html");
  for (const width of [1280, 390]) {
    const page = await browser.newPage({ viewport: { width, height: 900 } });
    await page.goto("file://" + path.resolve(file));
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    if (wide > width) console.log(`${name}: ${wide} px wide in a window of ${width}`);
    await page.screenshot({ path: `${folder}/${name}-${width}.jpg`, fullPage: true, type: "jpeg", quality: 55 });
    if (width === 1280) await page.pdf({ path: `${folder}/${name}.pdf`, format: "A4", preferCSSPageSize: true });
    await page.close();
  }
}
await browser.close();
