// Plays with the reports of a gallery in headless browsers, from files, and says what is wrong with them.
//
//     node play.mjs TUMBLE GALLERY SCENES BROWSER...
//
// Of every scene a slider is moved: its picture changes, and its numbers are those of the command TUMBLE for the same value, to the last
// digit, its tables those of the command, sign by sign. A mistake has its code, its place and its cure and leaves the last run; a link holds the state; a long run is stopped, and what
// is broken costs the run alone; nothing is asked of a network; a page fits a phone, and paper has no controls.

import { existsSync, mkdtempSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { join } from "node:path";
import process from "node:process";
import { after, both, check, end, launched, numbers, onPaper, opened, report, said, typed } from "./common.mjs";

const [tumble, gallery, scenes, ...programs] = process.argv.slice(2);
const NARROW = 400;
/** Where on a slider it is moved to: neither end nor middle. */
const PLACE = 430;
/** Sliders that are moved until the picture changes. */
const MOST_MOVED = 4;
/** Moves of a pointer that drags. */
const DRAG_STEPS = 8;
/** The scene in which everything is looked at beside numbers. */
const FIRST = "01-pendulum-in-the-wind";
/** A scene with a sweep, and what is swept. */
const [SWEEP, SWEPT] = ["28-painleve-rod", "mu"];
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

/** Moves a slider; which one, its value as the field has it, and how the run ended. */
async function moved(page, index = 0) {
  const knob = await page.evaluate((index) => [...lab.controls.keys()][index], index);
  const how = await after(page, () =>
    page.evaluate(([name, place]) => {
      const { slider } = lab.controls.get(name);
      slider.value = place;
      slider.dispatchEvent(new Event("input"));
    }, [knob, PLACE]),
  );
  return { knob, value: await page.inputValue(`[id="knob-${knob}"]`), how };
}

/** The places of all bodies, as the page has them. */
const picture = (page) => page.evaluate(() => lab.player.motion.bodies.flatMap(({ x, y, angle }) => [...x, ...y, ...angle]).join());

/** The names in the picture that stand on a handle. */
const covered = (page) => page.evaluate(() => {
  const all = (what) => [...document.querySelectorAll(`#play svg ${what}`)];
  // Letters, from their line up and a little down: the box of a text has room above and below that differs by browser.
  const letters = (one) => {
    const { left, right } = one.getBoundingClientRect();
    const at = one.getStartPositionOfChar(0).matrixTransform(one.getScreenCTM()).y;
    const size = parseFloat(getComputedStyle(one).fontSize) * one.getScreenCTM().d;
    return { left, right, top: at - 0.75 * size, bottom: at + 0.25 * size };
  };
  // The corners of a circle's box are none of its own.
  const meet = (a, b) => a.left < b.right - 3 && b.left + 3 < a.right && a.top < b.bottom - 3 && b.top + 3 < a.bottom;
  const handles = all(".grip").map((one) => one.getBoundingClientRect());
  const names = all("text.halo").filter((one) => one.getBoundingClientRect().width > 0);
  return names.filter((one) => handles.some((handle) => meet(letters(one), handle))).map((one) => one.textContent).join();
});

/** Handles in the picture, and what the page says can be dragged. */
const draggable = (page) => page.evaluate(() => {
  const notes = [...document.querySelectorAll("#play .note")].filter((one) => one.checkVisibility());
  return { handles: document.querySelectorAll("#play .grip").length, said: notes.map((one) => one.textContent).join(" ").trim() };
});

async function play(browser, name) {
  const page = await opened(browser, report(gallery, name));
  const where = `${browser.name}, ${name}`;
  const before = await picture(page);
  const set = [];
  // A mass alone often changes no motion.
  for (let index = 0; index < MOST_MOVED && (index === 0 || (await picture(page)) === before); index += 1) {
    const { knob, value, how } = await moved(page, index);
    set.push([knob, value]);
    check(`${where}: ${knob} = ${value} runs`, how === "done", how);
  }
  const [[knob, value]] = set;
  const [shown, expected] = [await numbers(page), said(tumble, join(scenes, name, "scene.toml"), set)];
  check(`${where}: numbers are those of the command`, shown === expected && shown !== "", `${shown}\n-- the command:\n${expected}`);
  check(`${where}: the picture has changed`, (await picture(page)) !== before);
  const { handles, said: howTo } = await draggable(page);
  check(`${where}: it says that rings can be dragged where there are any`, /^Drag a ring .*arrow keys/.test(howTo) === handles > 0, `${handles} handles: ${howTo}`);
  check(`${where}: no name stands on a handle`, (await covered(page)) === "", await covered(page));
  await tables(page, name, where);
  if (name === FIRST) await look(browser, page, { knob, value, shown });
  await page.close();
}

/** The tables of the page, against those that the command has written for the same values. */
async function tables(page, name, where) {
  const files = await page.evaluate(() => new Promise((resolve) => {
    lab.saveTables = resolve;
    lab.askTables();
  }));
  await page.evaluate(() => { delete lab.saveTables; });
  const folder = join(process.cwd(), "told", name);
  const native = readdirSync(folder, { recursive: true }).filter((file) => file.endsWith(".csv"));
  const other = native.filter((file) => new Map(files).get(file) !== readFileSync(join(folder, file), "utf8"));
  check(`${where}: tables are those of the command`, native.length > 1 && other.length === 0, other.join(", "));
}

async function look(browser, page, { knob, value, shown }) {
  const is = (what) => `${browser.name}: ${what}`;
  await page.waitForFunction(() => location.hash.length > 1);
  const link = await opened(browser, report(gallery, FIRST), new URL(page.url()).hash);
  await link.waitForFunction(() => document.querySelector("#play .told")?.textContent.length > 0);
  const field = await link.inputValue(`[id="knob-${knob}"]`);
  check(is("a link holds the state"), (await numbers(link)) === shown && field === value, `${field} for ${value}`);
  await link.close();
  const kind = await typed(page, knob, "3 parsecs");
  const words = await page.textContent("#play .said");
  check(is("a mistake has its code and place"), kind === "mistakes" && /E0\d\d\d/.test(words) && words.includes(`--set ${knob}=3 parsecs:1:`), words);
  check(is("the last run stays"), (await numbers(page)) === shown);
  await page.setViewportSize({ width: NARROW, height: 800 });
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  check(is(`fits ${NARROW} pixels`), wide <= NARROW, `${wide} pixels`);
  await onPaper(page);
  check(is("paper has no controls"), !(await page.isVisible("#play")) && (await page.isVisible("main")));
}

async function edited(browser) {
  const page = await opened(browser, report(gallery, FIRST));
  const is = (what) => `${browser.name}: ${what}`;
  await page.evaluate(() => { document.querySelector("#play .scene").open = true; });
  const text = await page.inputValue("#play textarea");
  const wrong = text.replace(/^until\s*=/m, "untill =");
  check(is("an edited mistake is told"), (await after(page, () => page.fill("#play textarea", wrong))) === "mistakes");
  const words = await page.textContent("#scene-said");
  const line = wrong.split("\n").findIndex((one) => one.startsWith("untill")) + 1;
  check(is("with code, place and cure"), /E0\d\d\d/.test(words) && words.includes(`:${line}:1`) && /help: .*`until`/.test(words), words);
  await page.close();
}

/** The slider of what is swept stands where it is in the run that is chosen, before anything is run in the page and after it. */
async function swept(browser) {
  const page = await opened(browser, report(gallery, SWEEP));
  const wrong = async () => {
    const chooser = page.locator("#play label", { hasText: "Case" }).locator("select");
    const labels = await chooser.locator("option").allTextContents();
    const found = [];
    for (const label of labels) {
      await chooser.selectOption({ label });
      const field = await page.inputValue(`[id="knob-${SWEPT}"]`);
      if (!label.endsWith(` = ${field}`)) found.push(`${field} of ${label}`);
    }
    return labels.length > 1 ? found.join() : "no runs";
  };
  check(`${browser.name}: sliders are those of the run that is chosen`, (await wrong()) === "", await wrong());
  await typed(page, "m", "2 kg");
  check(`${browser.name}: and after a run`, (await wrong()) === "", await wrong());
  await page.close();
}

async function endless(browser) {
  const page = await opened(browser, report(gallery, FIRST));
  const is = (what) => `${browser.name}: ${what}`;
  const stop = "#play button:has-text('Stop')";
  await page.evaluate((scene) => { lab.scene = scene; lab.set.clear(); lab.ask(); }, ENDLESS);
  await page.waitForSelector(stop, { state: "visible", timeout: 20_000 });
  await page.waitForFunction(() => document.querySelector("#play progress").value > 0);
  check(is("a long run shows how far it is"), true);
  await page.click(stop);
  await page.waitForFunction(() => document.querySelector("#play .status").textContent.startsWith("Stopped"));
  await page.evaluate((scene) => { lab.scene = scene; }, ENDLESS.replace("1e6 s", "1 s"));
  check(is("another one runs after it"), (await after(page, () => page.evaluate(() => lab.ask()))) === "done");
  await page.evaluate((scene) => { lab.scene = scene; lab.ask(); }, ENDLESS);
  await page.waitForSelector(stop, { state: "visible" });
  await page.evaluate((scene) => { lab.scene = scene; }, ENDLESS.replace("1e6 s", "2 s"));
  check(is("a newer one takes its place"), (await after(page, () => page.evaluate(() => lab.ask()))) === "done");
  await page.close();
}

/** What breaks an instance costs the run, not the page: it is told, the last run stays, and the next one runs. */
async function broken(browser, { what, words, file = report(gallery, FIRST), act }) {
  const page = await opened(browser, file);
  const is = (then) => `${browser.name}, ${what}: ${then}`;
  const { how: first } = await moved(page);
  check(is("a run before it"), first === "done", first);
  const before = await numbers(page);
  const how = await after(page, () => page.evaluate(act[0], act[1]));
  const status = await page.textContent("#play .status");
  check(is("it is told in words"), how === "broken" && words.test(status), `${how}: ${status}`);
  check(is("the last run stays"), (await numbers(page)) === before);
  await page.evaluate((scene) => { lab.scene = scene; lab.set.clear(); lab.ask(); }, ENDLESS.replace("1e6 s", "1 s"));
  await page.waitForFunction((old) => !document.querySelector("#play .told").textContent.includes(old), before);
  check(is("and the next one runs"), (await numbers(page)).startsWith("1 s in"), await numbers(page));
  await page.close();
}

const NO_MEMORY = /more memory than a page has/;
const asked = (scene) => { lab.scene = scene; lab.set.clear(); lab.ask(); };
const askedTables = (scene) => { lab.shown = null; lab.scene = scene; lab.set.clear(); lab.askTables(); };

/** The same page with an engine that is given 25 MiB at most: enough for its own runs, and not for an endless one. */
function withLittle() {
  const file = join(mkdtempSync(join(tmpdir(), "tumble-play-")), "report.html");
  const less = `((bytes) => {
    // Sections follow each other behind eight bytes: a number, a length, and what is in it. That of the memory ends in its upper bound, 16384 pages.
    let at = 8;
    const number = () => { for (let [value, shift] = [0, 0]; ; shift += 7) { value |= (bytes[at] & 127) << shift; if (bytes[at++] < 128) return value; } };
    for (;;) {
      const section = bytes[at++];
      if (section === undefined) throw new Error("where is the memory?");
      const length = number();
      at += length;
      if (section === 5) break;
    }
    if (bytes[at - 3] !== 0x80 || bytes[at - 2] !== 0x80 || bytes[at - 1] !== 1) throw new Error("what bounds the memory?");
    bytes.set([0x90, 0x83, 0], at - 3);
    return bytes;
  })`;
  const page = readFileSync(report(gallery, FIRST), "utf8");
  const changed = page.replace("WebAssembly.compile(unlzma(", () => `WebAssembly.compile(${less}(unlzma(`).replace("fromLetters(packed)))", "fromLetters(packed))))");
  check("the engine has less memory", changed !== page);
  writeFileSync(file, changed);
  return file;
}

/** A start velocity is dragged: while the motion follows, its handle stays with the pointer. */
async function dragged(browser) {
  const page = await opened(browser, report(gallery, "start"));
  await after(page, () => page.selectOption(".templates select", { index: 1 }));
  const before = await numbers(page);
  const handle = page.locator("#play .grip").last();
  await handle.scrollIntoViewIfNeeded();
  // Measured within the page: between two questions from outside it is drawn anew.
  const middle = () =>
    page.evaluate(() => {
      const { x, y, width, height } = [...document.querySelectorAll("#play .grip")].at(-1).getBoundingClientRect();
      return [x + width / 2, y + height / 2];
    });
  const [x, y] = await middle();
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (let step = 1; step <= DRAG_STEPS; step += 1) {
    await page.mouse.move(x + 5 * step, y - 4 * step);
    await page.waitForTimeout(150);
  }
  await page.waitForFunction((old) => document.querySelector("#play .told").textContent.trim() !== old, before);
  const distance = async () => {
    const [nx, ny] = await middle();
    return Math.hypot(nx - x - 5 * DRAG_STEPS, ny - y + 4 * DRAG_STEPS);
  };
  // The last move of the pointer may be dealt with after the numbers have changed.
  let off = await distance();
  for (let look = 0; off >= 3 && look < 20; look += 1) {
    await page.waitForTimeout(100);
    off = await distance();
  }
  check(`${browser.name}: a handle stays with the pointer`, off < 3, `${off} pixels off`);
  await page.mouse.up();
  await page.close();
}

/** All ways in which a run can break. */
async function breaks(browser) {
  const fine = ENDLESS.replace("1e6 s", "1 s").replace("[parameters]", 'output.every = "1e-6 s"\n[parameters]');
  const ways = [
    { what: "a run that needs too much memory", words: NO_MEMORY, file: withLittle(), act: [asked, ENDLESS] },
    { what: "tables that need too much memory", words: NO_MEMORY, act: [askedTables, fine] },
    { what: "a request that is none", words: /broken off/, act: [() => lab.runs.ask({ name: "none", scene: "", set: [], files: [], shown: "none" })] },
  ];
  for (const way of ways) await broken(browser, way);
}

/** The numbers of the command for a scene that is given as text. */
function saidOf(name, text) {
  const file = join(mkdtempSync(join(tmpdir(), "tumble-play-")), `${name}.toml`);
  writeFileSync(file, text);
  return said(tumble, file);
}

/** The pages around the reports: pictures of the index move, examples of the book play where they stand, templates are begun with. */
async function site(browser) {
  const is = (what) => `${browser.name}: ${what}`;
  const index = await opened(browser, join(gallery, "index.html"));
  const pose = () => index.locator(".living .body").first().getAttribute("transform");
  const before = await pose();
  await index.waitForTimeout(600);
  check(is("pictures of the index move"), (await pose()) !== before);
  await index.click("#pause-all");
  const still = await pose();
  await index.waitForTimeout(300);
  check(is("until they are paused"), (await pose()) === still);
  await index.close();

  const chapter = await opened(browser, join(gallery, "book", "tutorial.html"));
  const example = chapter.locator("[data-scene]").first();
  await example.locator("button").click();
  const frame = chapter.frameLocator("iframe");
  await frame.locator("#play .told:not(:empty)").waitFor({ timeout: 20_000 });
  const expected = saidOf("example", await example.getAttribute("data-scene"));
  check(is("an example of the book plays where it stands"), (await frame.locator("#play .told").textContent()).trim() === expected, expected);
  await chapter.close();

  const start = await opened(browser, report(gallery, "start"));
  const how = await after(start, () => start.selectOption(".templates select", { index: 2 }));
  check(is("a template is begun with"), how === "done" && (await numbers(start)) === saidOf("template", await start.inputValue("#play textarea")), how);
  await start.close();
}

/** What stands by a button: the scene as it was, a preset, and the same from a host by address, which is asked for nothing else. */
async function buttons(browser) {
  const is = (what) => `${browser.name}: ${what}`;
  const host = createServer((request, answer) => {
    const file = join(gallery, decodeURIComponent(new URL(request.url, "http://host").pathname));
    answer.writeHead(existsSync(file) ? 200 : 404, { "Content-Type": "text/html" });
    answer.end(existsSync(file) ? readFileSync(file) : "");
  });
  await new Promise((resolve) => host.listen(0, "127.0.0.1", resolve));
  const address = `http://127.0.0.1:${host.address().port}/`;
  const page = await browser.browser.newPage();
  const asked = [];
  page.on("request", (request) => /^https?:/.test(request.url()) && asked.push(request.url()));
  await page.goto(`${address}${FIRST}/report.html`);
  // What is told goes elsewhere: the tables of the run before are still read.
  const elsewhere = join(process.cwd(), "told by buttons");
  const told = (set = []) => said(tumble, join(scenes, FIRST, "scene.toml"), set, elsewhere);
  const { knob, value } = await moved(page);
  check(is("a page from a host plays"), (await numbers(page)) === told([[knob, value]]));
  check(is("a host is asked for the page alone"), asked.every((url) => url === `${address}${FIRST}/report.html` || url.endsWith("/favicon.ico")), asked.join());
  const press = (label) => after(page, () => page.getByRole("button", { name: label, exact: true }).click());
  check(is("it is reset"), (await press("Reset")) === "done" && (await numbers(page)) === told());
  await page.evaluate(() => { document.querySelector("#play .scene").open = true; });
  const text = `${await page.inputValue("#play textarea")}\n[play.presets.other]\nlabel = "Another"\ntext = "In words."\nset = { ${knob} = "${value}" }\n`;
  check(is("a preset is written"), (await after(page, () => page.fill("#play textarea", text))) === "done");
  check(is("a preset is chosen"), (await press("Another")) === "done" && (await numbers(page)) === told([[knob, value]]));
  await page.close();
  host.close();
}

/** That requests would be seen, if there were any. */
async function sees(browser) {
  const page = await opened(browser, report(gallery, FIRST));
  await page.evaluate(() => new Promise((resolve) => {
    const image = new Image();
    image.onerror = resolve;
    image.src = "http://127.0.0.1:45991/none.png";
  }));
  check(`${browser.name}: requests to a network would be seen`, browser.requests.length > 0);
  browser.requests.length = 0;
  await page.close();
}

const names = both(readdirSync(scenes), gallery);
for (const program of programs) {
  const browser = await launched(program);
  await sees(browser);
  for (const name of names) await play(browser, name);
  for (const one of [edited, swept, buttons, dragged, endless, breaks, site]) await one(browser);
  check(`${browser.name}: nothing is asked of a network`, browser.requests.length === 0, browser.requests.join(" "));
  await browser.browser.close();
  console.log(`${browser.name}: ${names.length} scenes`);
}
end();
