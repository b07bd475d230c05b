// What the scripts that play have in common: browsers, pages that are opened from files, what the command says, and what holds.

import { spawnSync } from "node:child_process";
import { existsSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium, firefox } from "playwright-core";

const LOCAL = /^(file|data|blob|about):/;

/** What was found to hold, and what not. */
export const count = { passed: 0, failed: 0 };

export function check(name, holds, detail = "") {
  count[holds ? "passed" : "failed"] += 1;
  if (!holds) console.log(`FAILED ${name}: ${detail}`);
}

/** Says how many hold, and ends. */
export function end() {
  console.log(`${count.passed} passed, ${count.failed} failed`);
  process.exit(count.failed || !count.passed ? 1 : 0);
}

/** Browsers by the files of their programs: Firefox, as Debian has it, is driven by WebDriver BiDi. */
export async function launched(program) {
  const isFirefox = program.includes("firefox");
  const browser = isFirefox
    ? await firefox.launch({ executablePath: program, channel: "moz-firefox" })
    : await chromium.launch({ executablePath: program, args: ["--no-sandbox", "--disable-gpu"] });
  return { name: isFirefox ? "Firefox" : "Chromium", browser, requests: [] };
}

/** How many children elements of formulas have. */
const CHILDREN = { mfrac: 2, mroot: 2, msub: 2, msup: 2, munder: 2, mover: 2, msubsup: 3, munderover: 3 };

/** What Firefox says of a formula that it lays out while the page is still being read. */
const HALF_READ = /^Incorrect number of children for <\w+\/> tag/;

/** A page from a file; what it throws and asks of a network is noted. */
export async function opened({ name, browser, requests }, file, hash = "") {
  const page = await browser.newPage();
  let loaded = false;
  page.on("request", (request) => LOCAL.test(request.url()) || requests.push(request.url()));
  page.on("pageerror", ({ message }) => {
    if (loaded || !HALF_READ.test(message)) check(`${name}, ${file}: nothing is thrown`, false, message);
  });
  await page.goto(pathToFileURL(file).href + hash);
  const wrong = await page.evaluate(malformed, CHILDREN);
  loaded = true;
  check(`${name}, ${file}: formulas are well formed`, !wrong.length, wrong.join("\n"));
  return page;
}

/** Elements of formulas that have more or fewer children than they need. */
const malformed = (children) =>
  Object.entries(children).flatMap(([tag, many]) =>
    [...document.querySelectorAll(tag)].filter((found) => found.childElementCount !== many).map((found) => found.outerHTML),
  );

/** The reports of a gallery, by the names of their scenes. */
export const report = (gallery, name) => join(gallery, name, "report.html");

const told = new Map();

/** What the command says of the runs of a scene, without the heading and the files. */
export function said(tumble, scene, set = [], out = join(process.cwd(), "told")) {
  const settings = set.flatMap(([name, text]) => ["--set", `${name}=${text}`]);
  const command = ["run", scene, "--no-figures", "--report", "none", "--out", out, ...settings];
  const key = command.join("\n");
  // A claim that does not hold ends the command with 1, and is told like the others.
  if (!told.has(key)) told.set(key, spawnSync(tumble, command, { encoding: "utf8" }).stdout);
  // Extremes over a sweep are not located in the page: the reader moves a slider to where they are.
  const isElsewhere = (line) => /^ {2}(figures|results|note):|^ {2}find [^:]*: (greatest|least) at /.test(line);
  return told.get(key).split("\n").slice(1).filter((line) => !isElsewhere(line)).join("\n").trim();
}

/** Forgets what was said of files that have changed. */
export const forget = () => told.clear();

/** Numbers as the page shows them. */
export const numbers = async (page) => (await page.textContent("#play .told")).trim();

/** Milliseconds after which a run that has not ended never does. */
const LONGEST = 120_000;

/** Does something, and waits until the run that comes of it is over: how it ended. */
export async function after(page, act) {
  await page.evaluate((longest) => {
    globalThis.settled = new Promise((resolve) => {
      setTimeout(() => resolve("nothing"), longest);
      lab.hear = (kind, value) => {
        Object.getPrototypeOf(lab).hear.call(lab, kind, value);
        if (["done", "mistakes", "refused", "broken", "stopped"].includes(kind)) resolve(kind);
      };
    });
  }, LONGEST);
  await act();
  return page.evaluate(() => globalThis.settled);
}

/** Types a value into the field of a knob. */
export const typed = (page, knob, text) =>
  after(page, async () => {
    const field = `[id="knob-${knob}"]`;
    await page.fill(field, text);
    await page.press(field, "Enter");
  });

/** As it would be on paper: what style sheets say of print is said of the screen. */
export const onPaper = (page) =>
  page.evaluate(() => {
    for (const sheet of document.styleSheets) {
      for (const rule of sheet.cssRules) if (rule.media?.mediaText === "print") rule.media.mediaText = "all";
    }
  });

/** Scenes of a folder that have a report in the gallery. */
export const both = (names, gallery) => names.filter((name) => existsSync(report(gallery, name)));
