// Edits scenes in generated reports in headless Chromium, from files, and takes away what can be saved.
//
//     node scene.mjs CHROMIUM TUMBLE FOLDER SCENES
//
// A scene that is right runs as it is typed, and its numbers are those of the command for the same text; one that is wrong has its
// code, its place and its cure under the text, and the last run stays; a link holds an edited scene; a saved scene has the values of
// the sliders; completion is chosen with the keys; reports stay below 2 MiB.

import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, readdirSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import process from "node:process";
import { crc32, inflateRawSync } from "node:zlib";
import { after, check, end, forget, launched, numbers, opened as openedFile, report, said } from "./common.mjs";

const [program, tumble, folder, scenes] = process.argv.slice(2);
const NAME = "01-pendulum-in-the-wind";
/** Bytes of a page. */
const MOST = 2 ** 21;
const scene = join(scenes, NAME, "scene.toml");
const text = readFileSync(scene, "utf8");

/** What the command says of the runs of a text. */
function told(content) {
  mkdirSync(join(folder, "edited"), { recursive: true });
  const file = join(folder, "edited", "scene.toml");
  writeFileSync(file, content);
  forget();
  return said(tumble, file, [], join(folder, "told"));
}

async function saved(page, button) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.click(`#play button:has-text("${button}")`)]);
  return readFileSync(await download.path());
}

async function opened(browser, hash = "") {
  const page = await openedFile(browser, report(folder, NAME), hash);
  await page.evaluate(() => { document.querySelector("#play .scene").open = true; });
  return page;
}

async function edits(page) {
  const [name, value] = await page.evaluate(() => {
    const { knob } = [...lab.controls.values()].find((one) => !one.knob.name.includes("."));
    return [knob.name, `${Number((knob.value * 0.9).toPrecision(4))} ${knob.unit}`.trim()];
  });
  const edited = text.replace(new RegExp(`^(${name}\\s*=\\s*)"[^"]*"`, "m"), `$1"${value}"`);
  check("the text has the value", edited !== text, name);
  check("an edited scene runs as it is typed", (await after(page, () => page.fill("#play textarea", edited))) === "done");
  const [shown, expected] = [await numbers(page), told(edited)];
  check("its numbers are those of the command", shown === expected, `${shown}\n-- the command:\n${expected}`);
  const wrong = edited.replace(/^until\s*=/m, "untill =");
  check("a mistake is told", (await after(page, () => page.fill("#play textarea", wrong))) === "mistakes");
  const said = await page.textContent("#scene-said");
  const line = wrong.split("\n").findIndex((one) => one.startsWith("untill")) + 1;
  check("with code, place and cure under the text", /E0\d\d\d/.test(said) && said.includes(`:${line}:1`) && /help: .*`until`/.test(said), said);
  const under = await page.locator("#play .stack .error").allTextContents();
  check("and the words underlined in it", under.includes("untill"), under.join(" "));
  check("the last good run stays", (await numbers(page)) === shown);
  await page.screenshot({ path: join(folder, "scene.png"), fullPage: false });
  await after(page, () => page.fill("#play textarea", edited));
  check("nothing is said of it once it is mended", await page.isHidden("#scene-said"));
  return { edited, shown, name };
}

async function links(browser, page, { edited, shown }) {
  await page.waitForFunction(() => location.hash.includes("scene="));
  const other = await opened(browser, new URL(page.url()).hash);
  await other.waitForFunction(() => document.querySelector("#play .told").textContent.length > 0);
  check("a link holds the edited scene", (await other.inputValue("#play textarea")) === edited);
  check("and its numbers", (await numbers(other)) === shown, await numbers(other));
  await other.close();
  const cut = await opened(browser, "#scene=AAAA");
  await cut.waitForFunction(() => document.querySelector("#play .told").textContent.length > 0);
  check("a link that is cut has the scene of the page", (await cut.inputValue("#play textarea")) === text);
  await cut.close();
}

async function saves(page, name) {
  const value = await page.evaluate((one) => lab.controls.get(one).knob.unit, name);
  await after(page, () => page.evaluate(([one, unit]) => lab.change(one, `1.25 ${unit}`.trim()), [name, value]));
  const file = String(await saved(page, "Save scene.toml"));
  check("a saved scene has the values of the sliders", told(file) === (await numbers(page)) && file.includes("1.25"), file);
  await tables(page, file);
  const svg = String(await saved(page, "(SVG)"));
  check("the picture is saved", /^<svg[^>]*xmlns/.test(svg) && svg.includes("<path"), svg.slice(0, 200));
  const png = await saved(page, "(PNG)");
  check("and its dots", png.subarray(1, 4).toString() === "PNG" && png.length > 1000, png.length);
}

/** The saved archive, against the files that the command writes for the same scene, figures and all. */
async function tables(page, content) {
  const held = unzipped(await saved(page, "Save tables"));
  const file = join(folder, "edited", "scene.toml");
  writeFileSync(file, content);
  execFileSync(tumble, ["run", file, "--report", "none", "--out", join(folder, "tables")]);
  const native = join(folder, "tables", "edited");
  const names = readdirSync(native, { recursive: true }).filter((name) => name.endsWith(".csv"));
  check("all tables are saved", [...held.keys()].sort().join() === names.sort().join(), [...held.keys()].join());
  for (const name of names) check(`${name} is that of the command`, held.get(name) === readFileSync(join(native, name), "utf8"));
}

/** The files of an archive, by their names. */
function unzipped(bytes) {
  const files = new Map();
  for (let at = bytes.readUInt32LE(bytes.length - 6); bytes.readUInt32LE(at) === 0x02014b50; ) {
    const [sum, packed, , named, place] = [16, 20, 24, 28, 42].map((k) => bytes.readUInt32LE(at + k));
    const [name, begin] = [bytes.toString("utf8", at + 46, at + 46 + (named & 0xffff)), place + 30 + (named & 0xffff)];
    const content = inflateRawSync(bytes.subarray(begin, begin + packed));
    check(`${name} is whole`, crc32(content) === sum);
    files.set(name, content.toString("utf8"));
    at += 46 + (named & 0xffff);
  }
  return files;
}

async function completes(page) {
  await page.fill("#play textarea", "");
  await page.focus("#play textarea");
  await page.keyboard.type("[para");
  check("titles are offered", (await page.textContent("#scene-offers")).includes("parameters"));
  await page.keyboard.press("Tab");
  check("and taken with the keys", (await page.inputValue("#play textarea")) === "[parameters");
  await page.keyboard.type(']\nlength = "2 mm"\nx = "len');
  check("names of the scene are offered", (await page.textContent("#scene-offers")).includes("length"));
  await page.keyboard.press("Escape");
  check("the list is closed with the keys", await page.isHidden("#scene-offers"));
}

execFileSync(tumble, ["run", scene, "--out", folder]);
const size = statSync(report(folder, NAME)).size;
check(`a page is below ${MOST} bytes`, size < MOST, size);
const browser = await launched(program);
const page = await opened(browser);
const state = await edits(page);
await links(browser, page, state);
await saves(page, state.name);
await completes(page);
check("nothing is asked of a network", browser.requests.length === 0, browser.requests.join(" "));
await browser.browser.close();
end();
