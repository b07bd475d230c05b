// What plots and motions share: data, text, and the clock and case they agree on.
"use strict";

const SVG = "http://www.w3.org/2000/svg";
const DATA = JSON.parse(document.getElementById("report-data").textContent);

/** A new element, in SVG where `svg` says so, with attributes, at the end of a parent. */
function make(name, attributes = {}, parent = null, svg = false) {
  const element = svg ? document.createElementNS(SVG, name) : document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (parent) parent.append(element);
  return element;
}

const draw = (name, attributes, parent) => make(name, attributes, parent, true);

/** Numbers from multiples of a step; `[count, difference]` stands for several equal ones; gaps are NaN. */
function decode([origin, step, differences]) {
  const values = [];
  let sum = 0;
  for (const entry of differences) {
    const [count, difference] = Array.isArray(entry) ? entry : [1, entry];
    for (let i = 0; i < count; i++) {
      sum += difference ?? 0;
      values.push(difference === null ? NaN : origin + step * sum);
    }
  }
  return Float64Array.from(values);
}

/** Appends a label `[[text, face, level], ...]` to an element of the page. */
function addLabel(parent, runs) {
  for (const [text, face, level] of runs) {
    const outer = level ? make(level, {}, parent) : parent;
    const inner = face ? make(face, {}, outer) : outer;
    inner.append(text);
  }
}

/** A label as a text of a drawing. */
function drawLabel(parent, runs, attributes) {
  const text = draw("text", attributes, parent);
  let drop = 0;
  for (const [words, face, level] of runs) {
    const wanted = level === "sub" ? 3 : level === "sup" ? -5 : 0;
    const span = draw("tspan", wanted === drop ? {} : { dy: wanted - drop }, text);
    drop = wanted;
    if (face === "i") span.setAttribute("font-style", "italic");
    if (face === "b") span.setAttribute("font-weight", "bold");
    if (level) span.setAttribute("style", "font-size:max(.72em, 11.5px)");
    span.textContent = words;
  }
  return text;
}

/** An arrow from one place to another (pixels): its shaft has these attributes, its tip is so long. */
function drawTip(parent, from, to, shaft, longest) {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const length = Math.hypot(dx, dy);
  const [ux, uy] = [dx / length, dy / length];
  const head = Math.min(longest, length);
  const back = [to[0] - head * ux, to[1] - head * uy];
  draw("line", { x1: from[0], y1: from[1], x2: back[0], y2: back[1], ...shaft }, parent);
  const corners = [to, ...[0.42, -0.42].map((side) => [back[0] + side * head * uy, back[1] - side * head * ux])];
  draw("polygon", { points: corners.join(" "), fill: shaft.stroke }, parent);
}

/** Calls `act` whenever an element has another width, and soon for its first. */
function watchWidth(element, act) {
  let width = 0;
  new ResizeObserver(() => {
    const now = element.clientWidth;
    if (!now || now === width) return;
    width = now;
    act();
  }).observe(element);
}

/** Where a pointer is in a drawing that is `width` wide in pixels of its own. */
function pointerIn(svg, { clientX, clientY }, width) {
  const box = svg.getBoundingClientRect();
  return [clientX - box.left, clientY - box.top].map((pixels) => (pixels * width) / box.width);
}

const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

/** The places of the values before and behind `at` in a list that is in order, and how far on the way it is from one to the other. */
function around(values, at) {
  let [low, high] = [0, Math.max(values.length - 1, 0)];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (values[middle] <= at) low = middle;
    else high = middle;
  }
  const span = values[high] - values[low];
  return [low, high, span > 0 ? (at - values[low]) / span : 0];
}

const plain = (runs) => runs.map(([text]) => text).join("");

const RAISED = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };

/** A number with `digits` significant digits, as print shows it. */
function shown(value, digits) {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const rounded = Number(value.toPrecision(clamp(digits, 1, 15)));
  const size = Math.abs(rounded);
  if (size >= 1e-4 && size < 1e7) return String(rounded).replace("-", "−");
  const [mantissa, exponent] = rounded.toExponential().split("e");
  const raised = [...String(Number(exponent))].map((c) => RAISED[c]).join("");
  return `${mantissa.replace("-", "−")}×10${raised}`;
}

/** A number to six digits of the range it comes from. */
function inRange(value, range, digits = 6) {
  // What varies by rounding errors alone is a constant.
  const constant = !(range > 1e-9 * Math.abs(value));
  if (!Number.isFinite(value) || value === 0 || constant) return shown(value, digits);
  const smallest = Math.floor(Math.log10(range)) - digits + 1;
  const places = Math.floor(Math.log10(Math.abs(value))) - smallest + 1;
  return places < 1 ? "0" : shown(value, places);
}

/** A value that several parts of the page agree on. */
class Shared {
  constructor(value) {
    this.value = value;
    this.listeners = [];
  }

  /** Calls `listener(value)` whenever somebody else sets it. */
  listen(owner, listener) {
    this.listeners.push([owner, listener]);
  }

  /** Forgets those whose place in the page is gone. */
  tidy() {
    this.listeners = this.listeners.filter(([owner]) => (owner.figure ?? owner.panels?.[0])?.isConnected ?? true);
  }

  set(value, source) {
    this.value = value;
    for (const [owner, listener] of this.listeners) if (owner !== source) listener(value);
  }
}

const clock = new Shared(null);
const chosenCase = new Shared(0);
