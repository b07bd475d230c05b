// Runs requests in the engine, in Node, and holds what comes of them against the native program: every number of a run, all bits of its
// motion included, has to be the same. What is drawn may differ in last digits, because drawings take elementary functions of the
// system; where it does is told.
//
//     node engine.mjs ENGINE FOLDER UNPACK
//
// ENGINE is the file, packed or not, UNPACK the script of pages that unpacks it; FOLDER has NAME.request and NAME.json for each scene.
import { readFileSync, readdirSync } from "node:fs";
import process from "node:process";

const [engine, folder, script] = process.argv.slice(2);
const unlzma = new Function(`${readFileSync(script, "utf8")}; return unlzma;`)();
const bytes = new Uint8Array(readFileSync(engine));
const module = await WebAssembly.compile(engine.endsWith(".lzma") ? unlzma(bytes) : bytes);
/** Messages with results, and those that draw them. */
const isDrawn = (line) => /^\[\{"kind":"(sketch|motion|report)"/.test(line);
const parts = (text) => {
  const lines = text.split("\n");
  return { drawn: lines.filter(isDrawn), found: lines.filter((line) => !isDrawn(line)) };
};

/** The messages of a request, stage by stage, and milliseconds of each stage. */
async function run(request) {
  const instance = await WebAssembly.instantiate(module, { lab: { reached() {}, failed() {} } });
  const { memory, room, begin, advance, take, taken } = instance.exports;
  const at = room(request.length);
  new Uint8Array(memory.buffer, at, request.length).set(request);
  if (begin() !== 1) throw new Error("the request is none");
  const [lines, times] = [[], []];
  for (let more = 1; more; ) {
    const start = performance.now();
    more = advance();
    const from = take();
    lines.push(new TextDecoder().decode(new Uint8Array(memory.buffer, from, taken())));
    times.push(performance.now() - start);
  }
  return { text: lines.join("\n"), times };
}

let failed = 0;
const names = readdirSync(folder).filter((name) => name.endsWith(".request"));
for (const file of names) {
  const name = file.replace(/\.request$/, "");
  const native = readFileSync(`${folder}/${name}.json`, "utf8");
  const { text, times } = await run(readFileSync(`${folder}/${file}`));
  const [ours, theirs] = [parts(text), parts(native)];
  const same = (part) => ours[part]?.join("\n") === theirs[part]?.join("\n");
  failed += same("found") ? 0 : 1;
  const words = `${same("found") ? "equal" : "DIFFERS"}${same("drawn") ? "" : ", drawn differently"}`;
  console.log(`${name}: ${words}; ms a stage: ${times.map((time) => time.toFixed(0)).join(" ")}`);
}
console.log(`${names.length - failed} passed, ${failed} failed`);
process.exit(failed || !names.length ? 1 : 0);
