// Whether pages of a gallery can be used by everybody, in headless Chromium, from files.
//
//     node access.mjs CHROMIUM GALLERY
//
// axe finds nothing wrong with them, wide, narrow, light and dark; every control of the panel is reached by the keys, shows that it has the
// focus, and does what it does; colours of curves and of forces stay apart for the colour-blind and stand out from their background; who asks for less
// motion gets it.

import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import process from "node:process";
import { after, check, end, launched, opened, report } from "./common.mjs";

const [program, gallery] = process.argv.slice(2);
const AXE = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const RULES = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"];
const FIRST = "01-pendulum-in-the-wind";
const PAGES = [report(gallery, FIRST), report(gallery, "15-falling-chain"), report(gallery, "start"), join(gallery, "index.html"), join(gallery, "book", "tutorial.html")];
const SCREENS = [
  { width: 1280, height: 800, colorScheme: "light" },
  { width: 1280, height: 800, colorScheme: "dark" },
  { width: 400, height: 800, colorScheme: "light" },
];
/** Contrast of lines with what is behind them, as WCAG 2 asks of graphics. */
const LEAST_CONTRAST = 3;
/** Distances of colours in CIELAB: 2.3 is just seen side by side. Forces differ by their lines as well. */
const LEAST_APART = { curves: 15, forces: 10 };
/** Colours as those see them who lack one kind of cone (Machado, Oliveira and Fernandes 2009, severity 1), in linear RGB. */
const EYES = {
  all: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  protanopia: [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
  deuteranopia: [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.01182, 0.04294, 0.968881]],
  tritanopia: [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.3039]],
};
const COLOURS = {
  curves: ["--c0", "--c1", "--c2", "--c3", "--c4", "--c5", "--c6"],
  forces: ["--weight", "--contact", "--air", "--applied", "--spring", "--reaction"],
};
/** Milliseconds of a motion for those who want less of it, and how many pictures they get at most. */
const CALM = 2200;
const MOST_PICTURES = 6;

async function shown(page, { width, height, colorScheme }) {
  await page.setViewportSize({ width, height });
  await page.emulateMedia({ colorScheme });
  await page.waitForTimeout(300);
}

/** What axe says against a page. */
async function faults(browser, file, screen) {
  const page = await opened(browser, file);
  await shown(page, screen);
  await page.evaluate(() => document.querySelectorAll("details").forEach((box) => { box.open = true; }));
  await page.evaluate(AXE);
  const { violations, passes } = await page.evaluate((runOnly) => axe.run(document, { runOnly }), RULES);
  await page.close();
  check(`${file}: axe has looked`, passes.length > 5, passes.length);
  return violations.flatMap(({ id, nodes }) => nodes.map(({ html }) => `${id}: ${html.slice(0, 120)}`));
}

/** Goes through the panel by the Tab key: what was reached, and what of it does not show that it has the focus. */
async function walked(page) {
  const all = await page.evaluate(() => {
    document.querySelectorAll("#play details").forEach((box) => { box.open = true; });
    const usable = [...document.querySelectorAll("#play :is(button, input, select, textarea, summary, [tabindex='0'])")].filter((one) => one.checkVisibility());
    usable.forEach((one, i) => { one.dataset.walk = i; });
    usable[0].focus();
    return usable.map((one) => one.getAttribute("aria-label") ?? one.textContent.trim().slice(0, 30) ?? one.tagName);
  });
  const [reached, unseen] = [new Set(), []];
  for (let i = 0; i < all.length + 2; i += 1) {
    const at = await page.evaluate(() => {
      const one = document.activeElement;
      const isShown = (box) => box && getComputedStyle(box).outlineStyle !== "none" && parseFloat(getComputedStyle(box).outlineWidth) > 0;
      return { walk: one.dataset.walk, seen: isShown(one) || isShown(one.closest(".editor")), name: one.outerHTML.slice(0, 80) };
    });
    if (at.walk !== undefined) reached.add(Number(at.walk));
    // The first one was given the focus by a script.
    if (i > 0 && at.walk !== undefined && !at.seen) unseen.push(at.name);
    await page.keyboard.press("Tab");
  }
  return { missed: all.filter((_, i) => !reached.has(i)), unseen };
}

/** Sliders and handles by the keys, again and again, without losing the focus. */
async function pressed(page) {
  const values = async (name) => page.evaluate((one) => lab.controls.get(one).number, name);
  const first = await page.evaluate(() => [...lab.controls.keys()][0]);
  const before = await values(first);
  await page.focus(`#play .knob input[type=range]`);
  const how = await after(page, () => page.keyboard.press("ArrowRight"));
  check("a slider is moved by the keys", how === "done" && (await values(first)) !== before, how);
  const label = await page.locator("#play .grip").first().getAttribute("aria-label");
  await page.locator("#play .grip").first().focus();
  const texts = [];
  for (let i = 0; i < 3; i += 1) {
    check("a handle is moved by the keys", (await after(page, () => page.keyboard.press("ArrowRight"))) === "done");
    const now = await page.evaluate(() => [document.activeElement.getAttribute("aria-label"), document.activeElement.getAttribute("aria-valuetext")]);
    check("and keeps the focus", now[0] === label, now.join());
    if (now[0] !== label) break;
    texts.push(now[1]);
  }
  check("each time by a step", new Set(texts).size === texts.length, texts.join(", "));
  await page.focus("#play .bar button.play");
  await page.keyboard.press("Space");
  check("the motion is played by the keys", await page.evaluate(() => lab.player.playing));
  await page.keyboard.press("Space");
  await page.click("#play button:has-text('Pin this run')");
  check("what is told when it cannot be seen", (await page.getAttribute("#play .live svg", "aria-label")).includes(" moves from "));
}

const linear = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255).map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
const light = ([r, g, b]) => 0.2126 * r + 0.7152 * g + 0.0722 * b;
const contrast = (a, b) => (Math.max(light(a), light(b)) + 0.05) / (Math.min(light(a), light(b)) + 0.05);
const seenBy = (rgb, eyes) => eyes.map((row) => Math.min(Math.max(row.reduce((sum, part, i) => sum + part * rgb[i], 0), 0), 1));

/** CIELAB of linear RGB, white D65. */
function lab([r, g, b]) {
  const part = (t) => (t > 216 / 24389 ? Math.cbrt(t) : ((24389 / 27) * t + 16) / 116);
  const x = part((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505);
  const y = part(light([r, g, b]));
  const z = part((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089);
  return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
}

/** Colours of one kind: whether they stand out and stay apart. */
async function coloured(page, scheme, kind) {
  const read = (names) => page.evaluate((all) => {
    const style = getComputedStyle(document.documentElement);
    return all.map((name) => style.getPropertyValue(name).trim().replace(/^#(.)(.)(.)$/, "#$1$1$2$2$3$3"));
  }, names);
  const colours = (await read(COLOURS[kind])).map(linear);
  const [paper] = (await read(["--wash"])).map(linear);
  colours.forEach((one, i) => check(`${scheme}: ${COLOURS[kind][i]} stands out`, contrast(one, paper) >= LEAST_CONTRAST, contrast(one, paper)));
  for (const [eyes, matrix] of Object.entries(EYES)) {
    const labs = colours.map((one) => lab(seenBy(one, matrix)));
    const apart = labs.flatMap((a, i) => labs.slice(0, i).map((b) => Math.hypot(...a.map((v, k) => v - b[k]))));
    check(`${scheme}, ${eyes}: ${kind} are told apart`, Math.min(...apart) >= LEAST_APART[kind], Math.min(...apart));
  }
}

/** Pictures of a motion for those who want less of it. */
async function calmed(browser) {
  const page = await opened(browser, report(gallery, FIRST));
  await page.emulateMedia({ reducedMotion: "reduce" });
  const pictures = await page.evaluate(async (time) => {
    const body = document.querySelector("#play .body");
    let count = 0;
    new MutationObserver(() => (count += 1)).observe(body, { attributes: true, attributeFilter: ["transform"] });
    lab.player.play();
    await new Promise((resolve) => setTimeout(resolve, time));
    lab.player.pause();
    return count;
  }, CALM);
  check("less motion is some, not none", pictures > 0 && pictures <= MOST_PICTURES, pictures);
  await page.close();
  const index = await browser.browser.newPage({ reducedMotion: "reduce" });
  await index.goto(`file://${join(gallery, "index.html")}`);
  await index.waitForTimeout(500);
  check("pictures of the index stand still then", await index.evaluate(() => living.every((one) => !one.playing)));
  await index.close();
}

const browser = await launched(program);
for (const file of PAGES) {
  for (const screen of SCREENS) {
    const found = await faults(browser, file, screen);
    check(`${file}, ${screen.width} pixels, ${screen.colorScheme}`, found.length === 0, `\n    ${found.slice(0, 5).join("\n    ")}`);
  }
}
const page = await opened(browser, report(gallery, FIRST));
const { missed, unseen } = await walked(page);
check("every control is reached by the keys", missed.length === 0, missed.join(", "));
check("and shows that it has the focus", unseen.length === 0, unseen.join("\n"));
await pressed(page);
for (const scheme of ["light", "dark"]) {
  await page.emulateMedia({ colorScheme: scheme });
  for (const kind of Object.keys(COLOURS)) await coloured(page, scheme, kind);
}
await calmed(browser);
await browser.browser.close();
end();
