// Plays with generated reports in headless Chromium, from files, and says what is wrong with them.
//
//     node play.mjs CHROMIUM TUMBLE FOLDER SCENES
//
// Numbers that a page shows must be those of the command `TUMBLE` for the same settings, to the last digit; a mistake has its code
// and its place and leaves the last run; a long run is stopped; nothing is asked of a network; paper has no controls.
// FOLDER is where reports are written. The times are those of a slider until the picture has moved, and until all numbers are there.

import { execFileSync, spawnSync } from "node:child_process";
import { statSync, writeFileSync, mkdirSync } from "node:fs";
import { join } from "node:path";
import process from "node:process";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const [program, tumble, folder, scenes] = process.argv.slice(2);
const NARROW = 400;
/** Scenes, and a value that is moved in each. */
const MOVED = [
  ["01-pendulum-in-the-wind", "T", "1.37 s"],
  ["02-thrown-rod", "c", "0.013 kg/m^2"],
  ["03-bouncing-rod", null, null],
  ["04-kicked-ball", "F", "150 N"],
];
const ENDLESS = `version = 1
title = "Endless"
world.gravity = "9.81 m/s^2"
run.until = "1e6 s"
[parameters]
L = "1 m"
[body.rod]
rod = { from = [0, 0], to = [0, "-L"] }
mass = "1 kg"
start = { angle = "100 deg" }
[pivot.hinge]
body = "rod"
point = [0, 0]
world = [0, 0]
`;

let failed = 0;
let passed = 0;
function check(name, holds, detail = "") {
  if (holds) passed += 1;
  else failed += 1;
  console.log(`${holds ? "ok    " : "FAILED"} ${name}${holds ? "" : `: ${detail}`}`);
}

/** What the command says of its runs, without the heading and the files. */
function told(scene, set) {
  const settings = set.flatMap(([name, text]) => ["--set", `${name}=${text}`]);
  // A claim that does not hold ends the command with 1, and is told like the others.
  const command = ["run", scene, "--no-figures", "--out", join(folder, "told"), ...settings];
  return spawnSync(tumble, command, { encoding: "utf8" }).stdout.split("\n").slice(1).filter((line) => !/^ {2}(figures|results|note):/.test(line)).join("\n").trim();
}

async function opened(browser, name, requests) {
  const page = await browser.newPage();
  page.on("request", (request) => /^(file|data|blob|about):/.test(request.url()) || requests.push(request.url()));
  page.on("pageerror", (error) => check(`${name} throws nothing`, false, error.message));
  await page.goto(pathToFileURL(join(folder, name, "report.html")).href);
  return page;
}

/** Types a value, and waits until the run of it is over. */
async function typed(page, knob, text) {
  await page.evaluate(() => {
    globalThis.settled = new Promise((resolve) => {
      const hear = lab.hear;
      lab.hear = (kind, value) => {
        hear.call(lab, kind, value);
        if (["done", "mistakes", "refused", "broken", "stopped"].includes(kind)) resolve(kind);
      };
    });
  });
  await page.fill(`[id="knob-${knob}"]`, text);
  await page.press(`[id="knob-${knob}"]`, "Enter");
  return page.evaluate(() => globalThis.settled);
}

/** Milliseconds from a slider to the picture and to the end of the run, warm. */
async function timed(page, knob) {
  return page.evaluate(async (name) => {
    const slider = lab.controls.get(name).slider;
    const times = [];
    for (const value of [300, 420, 510]) {
      const start = performance.now();
      const marks = {};
      const over = new Promise((resolve) => {
        const hear = Object.getPrototypeOf(lab).hear;
        lab.hear = (kind, got) => {
          hear.call(lab, kind, got);
          marks[kind] ??= performance.now() - start;
          if (["done", "mistakes", "refused"].includes(kind)) resolve();
        };
      });
      slider.value = value;
      slider.dispatchEvent(new Event("input"));
      await over;
      times.push([marks.motion, marks.done].map(Math.round).join("/"));
    }
    return times.join(" ");
  }, knob);
}

/** Nine tenths of a value, in its unit. */
const nearby = (name) => {
  const { value, unit } = lab.controls.get(name).knob;
  return `${Number((value * 0.9).toPrecision(4))} ${unit}`.trim();
};

async function play(browser, [name, knob, text], requests) {
  const scene = join(scenes, name, "scene.toml");
  execFileSync(tumble, ["run", scene, "--out", folder]);
  const page = await opened(browser, name, requests);
  const wanted = knob ?? (await page.evaluate(() => [...lab.controls.values()].find((one) => one.knob.first).knob.name));
  const value = text ?? (await page.evaluate(nearby, wanted));
  check(`${name}: ${wanted} = ${value} runs`, (await typed(page, wanted, value)) === "done", await page.textContent("#play"));
  const shown = (await page.textContent("#play .told")).trim();
  const expected = told(scene, [[wanted, value]]);
  check(`${name}: numbers are those of the command`, shown === expected, `${shown}\n-- the command:\n${expected}`);
  check(`${name}: the address holds the state`, page.url().includes(`#${wanted}=`), page.url());
  console.log(`       ${name}: ${statSync(join(folder, name, "report.html")).size} bytes; slider to picture/all, ms: ${await timed(page, wanted)}`);
  await page.screenshot({ path: join(folder, `${name}.png`) });
  const kind = await typed(page, wanted, "3 parsecs");
  const said = await page.textContent("#play .said");
  check(`${name}: a mistake has its code and place`, kind === "mistakes" && /E0\d\d\d/.test(said) && said.includes(`--set ${wanted}=3 parsecs:1:`), said);
  check(`${name}: the last run stays`, (await page.textContent("#play .told")).length > 0);
  await page.setViewportSize({ width: NARROW, height: 800 });
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  check(`${name}: fits ${NARROW} pixels`, wide <= NARROW, `${wide} pixels`);
  await page.emulateMedia({ media: "print" });
  check(`${name}: paper has no controls`, !(await page.isVisible("#play")));
  await page.close();
}

async function endless(browser, requests) {
  mkdirSync(join(folder, "source"), { recursive: true });
  const file = join(folder, "source", "endless.toml");
  writeFileSync(file, ENDLESS.replace("1e6 s", "1 s"));
  execFileSync(tumble, ["run", file, "--out", folder]);
  const page = await opened(browser, "endless", requests);
  await page.evaluate((scene) => { lab.scene = scene; lab.ask(); }, ENDLESS);
  await page.waitForSelector("#play button:has-text('Stop')", { state: "visible", timeout: 20_000 });
  await page.click("#play button:has-text('Stop')");
  await page.waitForFunction(() => document.querySelector("#play .status").textContent.startsWith("Stopped"));
  check("an endless scene is stopped", true);
  await page.evaluate((scene) => { lab.scene = scene; }, ENDLESS.replace("1e6 s", "1 s"));
  check("another one runs after it", (await typed(page, "L", "2 m")) === "done");
  await page.close();
}

const browser = await chromium.launch({ executablePath: program, args: ["--no-sandbox", "--disable-gpu"] });
const requests = [];
for (const one of MOVED) await play(browser, one, requests);
await endless(browser, requests);
check("nothing is asked of a network", requests.length === 0, requests.join(" "));
await browser.close();
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
