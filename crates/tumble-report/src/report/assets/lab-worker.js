// The engine beside the page: an instance, one scene at a time. A newer request ends the scene between two stages.
"use strict";

/** Milliseconds between two words on how far a run is. */
const PAUSE = 80;

/** A slider that rests for so long, ms, has the whole report follow; until then motion and numbers do. */
const REST = 120;

let engine = null;
/** Whose stages are done, and what came before there was an engine. */
let wanted = null;
let early = null;
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

function begin({ name, scene, set, files }) {
  const settings = set.flatMap(([key, text]) => ["set", key, text]);
  const bytes = packed([name, scene, ...settings, ...files.flatMap(([key, text]) => ["file", key, text])]);
  const room = engine.room(bytes.length);
  new Uint8Array(engine.memory.buffer, room, bytes.length).set(bytes);
  return engine.begin() === 1;
}

function taken() {
  const from = engine.take();
  return JSON.parse(new TextDecoder().decode(new Uint8Array(engine.memory.buffer, from, engine.taken())));
}

/** Does a stage, and leaves room for what somebody wants instead. */
function stage(request) {
  if (request !== wanted) return;
  try {
    told = performance.now();
    const more = engine.advance() === 1;
    const messages = taken();
    for (const message of messages) postMessage({ id: request.id, message });
    const moves = messages.some(({ kind }) => kind === "motion");
    if (more && moves) return void setTimeout(() => stage(request), REST);
    if (more) return void next.port2.postMessage(request.id);
    postMessage({ id: request.id, done: true });
  } catch (error) {
    // What went wrong may have left anything behind: this instance is not used again.
    postMessage({ id: request.id, broken: String(error.message ?? error) });
    close();
  }
}

const next = new MessageChannel();
next.port1.onmessage = ({ data }) => data === wanted?.id && stage(wanted);

/** Unpacks the engine for all workers: base64 of LZMA. */
async function unpack(packed) {
  try {
    const bytes = Uint8Array.from(atob(packed), (c) => c.charCodeAt(0));
    postMessage({ module: await WebAssembly.compile(unlzma(bytes)) });
  } catch (error) {
    postMessage({ broken: String(error.message ?? error) });
  }
  close();
}

onmessage = async ({ data }) => {
  if (data.packed) return unpack(data.packed);
  if (data.module) {
    const instance = await WebAssembly.instantiate(data.module, { lab: { reached } });
    engine = instance.exports;
    if (early) start(early);
  } else if (engine) {
    start(data);
  } else {
    early = data;
  }
};

function start(request) {
  wanted = request;
  begin(request);
  stage(request);
}
