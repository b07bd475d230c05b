// Opens pages in headless Chromium and says what is wrong with them.
//
//     node check.mjs <chromium> <folder for screenshots> <page>...
//
// A page is at fault if it writes an error to the console, throws, or asks for anything that is not a file of this
// machine or part of the page. Requests to a network are stopped, so a run never leaves the machine.
// A page with a motion must play it, one with curves must answer a pointer, and none may be wider than a narrow window
// or fail to print, or cut a figure or lose rows of a table in print; a report has few pages there. In a narrow window no
// text may be too small to read and no equation wider than its box; light and dark, text must stand out from what is behind it.
// Status: 0 all pages are good, 1 a page is at fault, 2 the checker itself failed.

import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { basename, dirname, join } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const FLAGS = [
  "--no-sandbox",
  "--disable-gpu",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
];
const NARROW = 400;
// Size of the smallest text that is read without effort, in pixels.
const LEAST_TEXT = 11;
// Contrast of text with what is behind it, as WCAG 2 counts it for level AA.
const LEAST_CONTRAST = 4.5;
// Faults of one kind that are listed for a page.
const LISTED = 4;
// What the margins of a report leave of A4, in pixels of 1/96 inch: 182 mm by 273 mm.
const PAPER = { width: 688, height: 1031 };
// Pages of a printed report.
const MOST_PAGES = 6;
const LOCAL = /^(file|data|blob|about):/;

function watch(page, faults) {
  page.on("console", (message) => {
    if (message.type() === "error") faults.push(`console error: ${message.text()}`);
  });
  page.on("pageerror", (error) => faults.push(`uncaught: ${error.message}`));
  page.on("request", (request) => {
    if (!LOCAL.test(request.url())) faults.push(`network request: ${request.url()}`);
  });
  page.on("requestfailed", (request) => {
    if (LOCAL.test(request.url())) faults.push(`cannot load: ${request.url()}`);
  });
}

async function open(browser, path, screenshot) {
  const faults = [];
  const page = await browser.newPage();
  watch(page, faults);
  await page.goto(pathToFileURL(path).href, { waitUntil: "load", timeout: 60_000 });
  await page.waitForTimeout(300);
  await page.screenshot({ path: screenshot, fullPage: true });
  faults.push(...(await played(page)), ...(await pointed(page)), ...(await narrowed(page)), ...(await contrasted(page)));
  faults.push(...(await printed(page)));
  await page.close();
  return faults;
}

// The motion advances when its button is pressed, and the time that is shown with it.
async function played(page) {
  const button = page.locator("figure[data-motion] button.play").first();
  if ((await button.count()) === 0) return [];
  const slider = page.locator("figure[data-motion] input[type=range]").first();
  const before = Number(await slider.inputValue());
  await button.click();
  await page.waitForTimeout(700);
  const after = Number(await slider.inputValue());
  await button.click();
  return after > before ? [] : [`the motion does not play: its slider stays at ${before}`];
}

// Curves tell their values under the pointer.
async function pointed(page) {
  const hit = page.locator("figure[data-plot] .hit").first();
  if ((await hit.count()) === 0) return [];
  await hit.scrollIntoViewIfNeeded();
  const box = await hit.boundingBox();
  await page.mouse.move(box.x + box.width * 0.4, box.y + box.height * 0.5);
  await page.mouse.move(box.x + box.width * 0.5, box.y + box.height * 0.5);
  await page.waitForTimeout(200);
  const cursors = await page.locator("figure[data-plot] .cursor").count();
  return cursors > 0 ? [] : ["curves do not answer the pointer"];
}

async function narrowed(page) {
  const size = page.viewportSize();
  await page.setViewportSize({ width: NARROW, height: 800 });
  await page.waitForTimeout(200);
  const width = await page.evaluate(() => document.documentElement.scrollWidth);
  const faults = await page.evaluate(illegible, LEAST_TEXT);
  await page.setViewportSize(size);
  if (width > NARROW) faults.push(`in a window of ${NARROW} pixels the page is ${width} wide`);
  return first(faults);
}

// The first of many faults, and how many there are.
function first(faults) {
  const more = faults.length - LISTED;
  return more > 0 ? [...faults.slice(0, LISTED), `and ${more} more of that kind`] : faults;
}

// Runs in the page: text that is too small, and equations that are cut off or have to be scrolled.
function illegible(least) {
  const faults = [];
  const named = (node) => `"${node.textContent.trim().slice(0, 40)}"`;
  const isSeen = (node) => node.checkVisibility({ checkVisibilityCSS: true }) && [...node.getClientRects()].some((rect) => rect.width > 0);
  const hasText = (node) => [...node.childNodes].some((child) => child.nodeType === 3 && child.data.trim() !== "");
  for (const node of document.querySelectorAll("body *")) {
    if (!isSeen(node) || node.closest(".heard, script")) continue;
    const isDrawn = node.namespaceURI.endsWith("svg");
    if (isDrawn ? node.localName !== "text" && node.localName !== "tspan" : !hasText(node)) continue;
    const turned = isDrawn ? node.getScreenCTM() : { a: 1, b: 0 };
    const scale = Math.hypot(turned.a, turned.b);
    const size = parseFloat(getComputedStyle(node).fontSize) * scale;
    if (size < least - 0.05) faults.push(`text of ${size.toFixed(1)} pixels: ${named(node)}`);
  }
  for (const box of document.querySelectorAll(".line, td, th, p, li, dd")) {
    if (!isSeen(box) || box.querySelector("math") === null) continue;
    const right = box.getBoundingClientRect().right + 1;
    const wide = [...box.querySelectorAll("math")].find((math) => math.getBoundingClientRect().right > right);
    if (wide || box.scrollWidth > box.clientWidth + 1) faults.push(`an equation is wider than its box: ${named(wide ?? box)}`);
  }
  return faults;
}

// Text stands out from its background, light and dark.
async function contrasted(page) {
  const faults = [];
  for (const colorScheme of ["light", "dark"]) {
    await page.emulateMedia({ colorScheme });
    faults.push(...first((await page.evaluate(faint, LEAST_CONTRAST)).map((fault) => `${colorScheme}: ${fault}`)));
  }
  await page.emulateMedia({ colorScheme: null });
  return faults;
}

// Runs in the page. Drawings are turned about as a whole in the dark: they are looked at in the light.
function faint(least) {
  const canvas = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
  const rgba = (colour) => {
    canvas.clearRect(0, 0, 1, 1);
    canvas.fillStyle = colour;
    canvas.fillRect(0, 0, 1, 1);
    return [...canvas.getImageData(0, 0, 1, 1).data];
  };
  const light = (colour) => {
    const part = (v) => (v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4);
    return 0.2126 * part(colour[0]) + 0.7152 * part(colour[1]) + 0.0722 * part(colour[2]);
  };
  const behind = (node) => {
    if (node === null) return rgba("#fff");
    const own = node.namespaceURI.endsWith("svg") && node.localName === "svg" && node.closest(".sheet") ? "#fff" : getComputedStyle(node).backgroundColor;
    const colour = rgba(own);
    return colour[3] === 255 ? colour : behind(node.parentElement);
  };
  const isDark = matchMedia("(prefers-color-scheme: dark)").matches;
  const faults = new Set();
  for (const node of document.querySelectorAll("body *")) {
    const isDrawn = node.namespaceURI.endsWith("svg");
    const hasText = [...node.childNodes].some((child) => child.nodeType === 3 && child.data.trim() !== "");
    if (!hasText || !node.checkVisibility({ checkVisibilityCSS: true }) || node.closest("script, style, [aria-pressed=false], title, desc")) continue;
    if (isDark && node.closest(".sheet")) continue;
    const style = getComputedStyle(node);
    const [a, b] = [light(rgba(isDrawn ? style.fill : style.color)), light(behind(node))];
    const contrast = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    if (contrast < least) faults.add(`contrast of ${contrast.toFixed(2)}: "${node.textContent.trim().slice(0, 40)}"`);
  }
  return [...faults];
}

// On paper no figure is cut: each is kept together and fits on a page. Chromium then moves it to the next one.
async function printed(page) {
  const pdf = await page.pdf({ format: "A4", preferCSSPageSize: true, tagged: true, outline: true });
  if (pdf.length < 1000) return ["the page does not print"];
  const size = page.viewportSize();
  await page.emulateMedia({ media: "print" });
  await page.setViewportSize(PAPER);
  const faults = await page.evaluate(cutFigures, PAPER);
  const pages = (pdf.toString("latin1").match(/\/Type \/Page\b/g) ?? []).length;
  if (pages > MOST_PAGES && (await page.locator("#identify").count()) > 0) faults.push(`the report has ${pages} pages in print`);
  faults.push(...(await page.evaluate(lostRows)));
  faults.push(...untagged(pdf.toString("latin1"), await page.evaluate(readAloud)));
  await page.emulateMedia({ media: null });
  await page.setViewportSize(size);
  return faults;
}

// What the printed file says to those who listen to it: its headings, and the alternative texts of its pictures.
function untagged(pdf, said) {
  const tags = { h1: /\/S \/H1\b/g, h2: /\/S \/H2\b/g, h3: /\/S \/H3\b/g, pictures: /\/Alt\b/g };
  const faults = Object.entries(tags).map(([what, tag]) => {
    const tagged = (pdf.match(tag) ?? []).length;
    return tagged < said[what] ? `of ${said[what]} ${what} ${tagged} are tagged in print` : null;
  });
  return faults.filter((fault) => fault !== null);
}

// Runs in the page.
function readAloud() {
  const count = (selector) => [...document.querySelectorAll(selector)].filter((node) => node.getClientRects().length > 0).length;
  return { h1: count("h1"), h2: count("h2"), h3: count("h3"), pictures: count("svg[role=img]") };
}

// Runs in the page.
function cutFigures(paper) {
  const isKept = (node) => node !== null && (getComputedStyle(node).breakInside === "avoid" || isKept(node.parentElement));
  const faults = [];
  for (const figure of document.querySelectorAll("figure")) {
    const { width, height } = figure.getBoundingClientRect();
    const name = `the figure "${figure.textContent.trim().slice(0, 40)}"`;
    if (height === 0) continue;
    if (!isKept(figure)) faults.push(`${name} may be cut at the end of a page`);
    if (height > paper.height) faults.push(`${name} is ${Math.round(height)} pixels high, a page ${paper.height}`);
    if (width > paper.width) faults.push(`${name} is ${Math.round(width)} pixels wide, a page ${paper.width}`);
  }
  return faults;
}

// Runs in the page. Paper shows every row of a table, or says in which file they are.
function lostRows() {
  const isLost = (row) => row.getClientRects().length === 0 && !row.closest(".filed")?.querySelector(".paper")?.getClientRects().length;
  return [...document.querySelectorAll("table")].flatMap((table) => {
    const lost = [...table.rows].filter((row) => !row.closest("thead") && isLost(row)).length;
    return lost > 0 ? [`paper loses ${lost} rows of the table "${table.textContent.trim().slice(0, 40)}"`] : [];
  });
}

function screenshotName(path) {
  return `${basename(dirname(path))}-${basename(path, ".html")}.png`;
}

async function checkAll(browser, screenshots, pages) {
  await browser.route(/.*/, (route) => (LOCAL.test(route.request().url()) ? route.continue() : route.abort()));
  let bad = 0;
  for (const path of pages) {
    const name = screenshotName(path);
    const faults = await open(browser, path, join(screenshots, name));
    console.log(`${faults.length === 0 ? "good " : "FAULT"} ${name}`);
    for (const fault of faults) console.log(`      ${fault}`);
    if (faults.length > 0) bad += 1;
  }
  return bad;
}

async function main([executablePath, screenshots, ...pages]) {
  if (pages.length === 0) throw new Error("usage: node check.mjs <chromium> <folder for screenshots> <page>...");
  const profile = await mkdtemp(join(tmpdir(), "tumble-pages-"));
  const options = { executablePath, args: FLAGS, headless: true, viewport: { width: 1280, height: 900 } };
  try {
    const browser = await chromium.launchPersistentContext(profile, options);
    const bad = await checkAll(browser, screenshots, pages);
    await browser.close();
    return bad === 0 ? 0 : 1;
  } finally {
    await rm(profile, { recursive: true, force: true, maxRetries: 5, retryDelay: 200 });
  }
}

main(process.argv.slice(2)).then(
  (status) => process.exit(status),
  (error) => {
    console.error(error);
    process.exit(2);
  },
);
