// The engine beside the page: an instance, one scene at a time. A newer request ends the scene between two stages.
"use strict";

/** Milliseconds between two words on how far a run is. */
const PAUSE = 80;

/** A slider that rests for so long, ms, has numbers and the report follow; until then the picture does. */
const REST = 50;

let engine = null;
/** The newest request: its stages are done. */
let wanted = null;
let told = 0;

/** A run is at a time of its end. */
function reached(time, until) {
  const now = performance.now();
  if (now - told < PAUSE) return;
  told = now;
  postMessage({ id: wanted?.id, progress: time / until });
}

/** Texts, each behind its length. */
function packed(texts) {
  const encoder = new TextEncoder();
  const parts = texts.map((text) => encoder.encode(text));
  const bytes = new Uint8Array(parts.reduce((sum, part) => sum + 4 + part.length, 0));
  const view = new DataView(bytes.buffer);
  let at = 0;
  for (const part of parts) {
    view.setUint32(at, part.length, true);
    bytes.set(part, at + 4);
    at += 4 + part.length;
  }
  return bytes;
}

/** What the program said when it went wrong. */
let failure = null;

function failed(from, bytes) {
  failure = new TextDecoder().decode(new Uint8Array(engine.memory.buffer, from, bytes));
}

/** Why a run has broken off, in words for whoever asked for it. */
function why(error) {
  const words = String(error?.message ?? error);
  if (failure !== null) return `That is a fault of the program, not of the scene. Please report it with the scene: ${failure}`;
  if (/stack|recursion|out of bounds/i.test(words)) return "The scene is nested more deeply than a page can follow.";
  if (error instanceof WebAssembly.RuntimeError || error instanceof RangeError)
    return "It needs more memory than a page has. A shorter time or fewer runs need less, and the command has all memory of the machine.";
  return words;
}

function begin({ name, scene, set, files, shown, tables }) {
  const settings = set.flatMap(([key, text]) => ["set", key, text]);
  const beside = files.flatMap(([key, text]) => ["file", key, text]);
  const last = tables ? ["tables", ""] : [];
  const bytes = packed([name, scene, ...settings, ...beside, "shown", String(shown), ...last]);
  const room = engine.room(bytes.length);
  new Uint8Array(engine.memory.buffer, room, bytes.length).set(bytes);
  return engine.begin() === 1;
}

function taken() {
  const from = engine.take();
  return JSON.parse(new TextDecoder().decode(new Uint8Array(engine.memory.buffer, from, engine.taken())));
}

/** Does something with the engine. What goes wrong may leave anything behind: this instance is not used again. */
function attempt(request, act) {
  if (request !== wanted) return;
  try {
    act();
  } catch (error) {
    wanted = null;
    postMessage({ id: request.id, broken: why(error) });
    close();
  }
}

/** Does a stage, and leaves room for what somebody wants instead. */
function stage(request) {
  attempt(request, () => {
    told = performance.now();
    const more = engine.advance() === 1;
    const messages = taken();
    for (const message of messages) postMessage({ id: request.id, message });
    const has = (wanted) => messages.some(({ kind }) => kind === wanted);
    // A page that shows no report needs none.
    const isEnough = request.brief && has("energy");
    if (more && has("sketch")) setTimeout(() => stage(request), REST);
    else if (more && !isEnough) next.port2.postMessage(request.id);
    else postMessage({ id: request.id, done: true });
  });
}

/** Between two stages, what somebody wants instead is heard; of several requests that wait, the last one is begun. */
const next = new MessageChannel();
next.port1.onmessage = ({ data }) => data === wanted?.id && (wanted.isBegun ? stage(wanted) : start(wanted));

/** Bytes from text: two signs for 13 bits, the lowest first. */
function fromLetters(text) {
  const places = new Uint8Array(128);
  let count = 0;
  for (let code = 33; code < 127; code += 1) if (!"<&\\".includes(String.fromCharCode(code))) places[code] = count++;
  const bytes = new Uint8Array(Math.floor((text.length * 13) / 16));
  let [at, bits, have] = [0, 0, 0];
  for (let i = 0; i < text.length; i += 2) {
    bits |= (places[text.charCodeAt(i)] + count * places[text.charCodeAt(i + 1)]) << have;
    for (have += 13; have >= 8; have -= 8) {
      bytes[at++] = bits & 255;
      bits >>>= 8;
    }
  }
  return bytes;
}

/** Unpacks the engine for all workers: letters of LZMA. */
async function unpack(packed) {
  try {
    postMessage({ module: await WebAssembly.compile(unlzma(fromLetters(packed))) });
  } catch (error) {
    postMessage({ broken: String(error.message ?? error) });
  }
  close();
}

async function instantiate(module) {
  try {
    engine = (await WebAssembly.instantiate(module, { lab: { reached, failed } })).exports;
  } catch (error) {
    postMessage({ id: wanted?.id, broken: why(error) });
    return close();
  }
  if (wanted) start(wanted);
}

onmessage = async ({ data }) => {
  if (data.packed) return unpack(data.packed);
  if (data.module) {
    await instantiate(data.module);
  } else {
    wanted = data;
    if (engine) next.port2.postMessage(data.id);
  }
};

function start(request) {
  request.isBegun = true;
  postMessage({ id: request.id, begun: true });
  attempt(request, () => {
    if (!begin(request)) throw new Error("the engine does not understand what it is asked");
  });
  stage(request);
}
