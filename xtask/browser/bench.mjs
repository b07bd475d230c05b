// How long a page takes: from a slider to the first picture and to all digits, warm; frames a second of the motion; sizes.
//
//     node bench.mjs CHROMIUM GALLERY
//
// The picture is counted until the browser has drawn it. It fails where a page or the engine in it is larger than it may be.

import { statSync } from "node:fs";
import process from "node:process";
import { check, end, launched, opened, report } from "./common.mjs";

const [program, gallery] = process.argv.slice(2);
const SCENES = ["01-pendulum-in-the-wind", "02-thrown-rod", "03-bouncing-rod", "04-kicked-ball"];
/** Bytes of a page, and of the engine in it. */
const MOST = 2 ** 21;
const MOST_ENGINE = 1.3e6;
/** Moves that are counted, and those before them, in which the browser compiles. */
const MOVES = 12;
const COLD = 4;
/** Milliseconds for which a motion plays. */
const PLAYS = 2000;

/** Milliseconds of each move: until the first picture is drawn, until all digits are there, until the report is. */
async function timed(page) {
  return page.evaluate(async (moves) => {
    const { slider } = [...lab.controls.values()][0];
    const times = [];
    for (let i = 0; i < moves; i += 1) {
      const start = performance.now();
      const marks = {};
      const over = new Promise((resolve) => {
        lab.hear = (kind, value) => {
          Object.getPrototypeOf(lab).hear.call(lab, kind, value);
          if (kind === "sketch") requestAnimationFrame(() => setTimeout(() => (marks.picture ??= performance.now() - start)));
          if (kind === "motion") marks.digits = performance.now() - start;
          if (["done", "mistakes", "refused", "broken"].includes(kind)) resolve((marks.report = performance.now() - start));
        };
      });
      slider.value = 300 + 30 * i;
      slider.dispatchEvent(new Event("input"));
      await over;
      times.push(marks);
    }
    return times;
  }, COLD + MOVES);
}

/** Frames a second while the motion plays, and the longest of them, ms. */
const frames = (page) =>
  page.evaluate(async (plays) => {
    lab.player.seek(lab.player.start);
    lab.player.play();
    const gaps = [];
    let last = performance.now();
    for (const begin = last; last - begin < plays && lab.player.playing; ) {
      const now = await new Promise((resolve) => requestAnimationFrame(resolve));
      gaps.push(now - last);
      last = now;
    }
    return { rate: (1000 * gaps.length) / gaps.reduce((a, b) => a + b, 0), longest: Math.max(...gaps) };
  }, PLAYS);

const median = (values) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];
const told = (times, kind) => {
  const values = times.map((marks) => marks[kind]);
  return `${Math.round(median(values))} (${Math.round(Math.min(...values))} to ${Math.round(Math.max(...values))})`;
};

const browser = await launched(program);
console.log("scene: ms from slider to picture, to all digits, to the report: median (least to most); frames a second; bytes");
for (const name of SCENES) {
  const page = await opened(browser, report(gallery, name));
  const times = (await timed(page)).slice(COLD);
  const { rate, longest } = await frames(page);
  const engine = await page.evaluate(() => document.getElementById("lab-engine").textContent.length);
  const bytes = statSync(report(gallery, name)).size;
  console.log(`${name}: ${["picture", "digits", "report"].map((kind) => told(times, kind)).join(", ")}; ${rate.toFixed(0)} (longest ${longest.toFixed(0)} ms); page ${bytes}, engine ${engine}`);
  check(`${name}: a page has at most ${MOST} bytes`, bytes <= MOST, bytes);
  check(`${name}: the engine at most ${MOST_ENGINE}`, engine <= MOST_ENGINE, engine);
  await page.close();
}
await browser.browser.close();
end();
