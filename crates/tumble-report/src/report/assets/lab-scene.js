// The scene in the page: its text, what the engine says of it as one types, and what can be taken away: the scene, tables, the picture.

/** Typing that rests for so long, ms, has the scene run. */
const TYPING = 350;
/** What is told apart in a line: comments, texts, titles of sections, keys. */
const TOKENS = /(#.*)|("(?:[^"\\]|\\.)*"?|'[^']*'?)|(^\s*\[[^\]]*\]?)|(^\s*[\w."-]+(?=\s*=))/g;
const KINDS = ["comment", "text", "title", "key"];

class SceneEditor {
  /** `edited(text)` is told of each text that is to be run. */
  constructor(parent, scene, edited) {
    this.edited = edited;
    this.box = make("details", { class: "scene" }, parent);
    make("summary", {}, this.box).textContent = "The scene";
    const frame = make("div", { class: "editor" }, this.box);
    this.numbers = make("pre", { class: "numbers", "aria-hidden": "true" }, frame);
    const stack = make("div", { class: "stack" }, frame);
    this.back = make("pre", { "aria-hidden": "true" }, stack);
    this.area = make("textarea", { rows: 18, spellcheck: "false", autocapitalize: "off", autocomplete: "off", wrap: "off", "aria-label": "The scene, as text", "aria-describedby": "scene-said" }, stack);
    this.state = make("p", { class: "note", role: "status" }, this.box);
    this.said = make("div", { class: "said", id: "scene-said", hidden: "" }, this.box);
    this.bar = make("div", { class: "bar" }, this.box);
    this.area.addEventListener("input", () => this.type());
    this.area.addEventListener("scroll", () => this.follow());
    this.completion = new Completion(this.area, stack);
    this.marks = [];
    this.show(scene);
  }

  show(scene) {
    this.area.value = scene;
    this.marks = [];
    this.paint();
  }

  type() {
    this.marks = [];
    this.paint();
    this.state.textContent = "";
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.edited(this.area.value), TYPING);
  }

  follow() {
    this.back.scrollTop = this.numbers.scrollTop = this.area.scrollTop;
    this.back.scrollLeft = this.area.scrollLeft;
  }

  /** The text once more behind itself, in colours and with what is wrong underlined. */
  paint() {
    const text = this.area.value;
    this.back.replaceChildren();
    let at = 0;
    for (const line of text.split("\n")) {
      for (const [part, kind] of tokens(line)) {
        this.piece(part, kind, at);
        at += part.length;
      }
      this.back.append("\n");
      at += 1;
    }
    this.numbers.textContent = Array.from({ length: text.split("\n").length }, (_, i) => i + 1).join("\n") + "\n";
    this.follow();
  }

  piece(part, kind, at) {
    const cuts = this.marks.flatMap(({ from, to }) => [from - at, to - at]).filter((cut) => cut > 0 && cut < part.length);
    const ends = [...new Set([0, ...cuts, part.length])].sort((a, b) => a - b);
    for (const [i, end] of ends.entries()) {
      if (i === 0) continue;
      const from = ends[i - 1];
      const mark = this.marks.find((one) => one.from <= at + from && at + end <= one.to);
      const words = `${kind} ${mark ? mark.severity : ""}`.trim();
      const span = make("span", words ? { class: words } : {}, this.back);
      span.textContent = part.slice(from, end);
    }
  }

  /** What the engine says of the text, under it. Offsets are those of the text that was run. */
  tell(said, scene, words = "") {
    const own = said.list.filter(({ source }) => source === 0);
    showSaid(this.said, { list: own }, own.length ? "" : words);
    [...this.said.querySelectorAll(":scope > div")].forEach((item, i) => this.goTo(item, own[i]));
    const isWrong = own.some(({ severity }) => severity === "error");
    this.area.setAttribute("aria-invalid", isWrong);
    if (this.area.value !== scene) return;
    this.marks = own.flatMap(({ labels, severity }) => labels.slice(0, 1).map(({ from, to }) => ({ from, to: Math.max(to, from + 1), severity })));
    this.paint();
  }

  /** A button from a message to its place. */
  goTo(item, { line, column }) {
    if (!line) return;
    const button = make("button", { type: "button" }, item);
    button.textContent = `Go to line ${line}`;
    button.addEventListener("click", () => {
      const before = this.area.value.split("\n").slice(0, line - 1);
      const at = before.reduce((sum, text) => sum + text.length + 1, 0) + column - 1;
      this.area.focus();
      this.area.setSelectionRange(at, at);
    });
  }
}

/** The parts of a line, each with its kind, nothing left out. */
function tokens(line) {
  const parts = [];
  let at = 0;
  for (const match of line.matchAll(TOKENS)) {
    if (match.index > at) parts.push([line.slice(at, match.index), ""]);
    parts.push([match[0], KINDS[match.slice(1).findIndex((group) => group !== undefined)]]);
    at = match.index + match[0].length;
  }
  if (at < line.length) parts.push([line.slice(at), ""]);
  return parts;
}

/** A file for the reader. */
function save(name, type, content) {
  const address = URL.createObjectURL(new Blob([content], { type }));
  make("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}

/** Where a start value stands in `start = { .. }`: its key, and its place in a list. */
const STARTS = { x: ["at", 0], y: ["at", 1], vx: ["velocity", 0], vy: ["velocity", 1], angle: ["angle"], omega: ["omega"] };

/** The scene with values in the place of its own; those whose place is not plain come back as `left`. */
function written(scene, set) {
  const lines = scene.split("\n");
  const left = [];
  for (const [name, text] of set) if (!write(lines, name, text)) left.push([name, text]);
  return { scene: lines.join("\n"), left };
}

function write(lines, name, text) {
  const start = /^(.+)\.start\.(\w+)$/.exec(name);
  const title = start ? `[body.${start[1]}]` : "[parameters]";
  const key = start ? "start" : name;
  const head = lines.findIndex((line) => line.split("#")[0].trim() === title);
  if (head < 0) return false;
  const length = lines.slice(head + 1).findIndex((line) => /^\s*\[/.test(line));
  const last = length < 0 ? lines.length : head + 1 + length;
  const is = (line) => new RegExp(`^\\s*${key}\\s*=`).test(line);
  const at = lines.findIndex((line, i) => i > head && i < last && is(line));
  if (at < 0) return false;
  const value = JSON.stringify(text);
  const fresh = start ? inStart(lines[at], STARTS[start[2]], value) : inLine(lines[at], value);
  if (fresh === null) return false;
  lines[at] = fresh;
  return true;
}

const VALUE = `"(?:[^"\\\\]|\\\\.)*"|[-+\\w.]+`;

function inLine(line, value) {
  const match = new RegExp(`^(\\s*[\\w-]+\\s*=\\s*)(?:${VALUE})(\\s*(?:#.*)?)$`).exec(line);
  return match && `${match[1]}${value}${match[2]}`;
}

function inStart(line, place, value) {
  if (!place) return null;
  const [key, index] = place;
  const before = index === undefined ? "" : `\\[\\s*${index ? `(?:${VALUE})\\s*,\\s*` : ""}`;
  const match = new RegExp(`^(.*[{,]\\s*${key}\\s*=\\s*${before})(?:${VALUE})(.*)$`).exec(line);
  return match && `${match[1]}${value}${match[2]}`;
}

/** The tables of the page, one after the other, as they are shown. */
function tablesAsText() {
  const cell = (one) => {
    const text = one.textContent.trim().replace(/\s+/g, " ");
    return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  };
  const table = (one) => [one.caption ? `# ${one.caption.textContent.trim()}` : null, ...[...one.rows].map((row) => [...row.cells].map(cell).join(","))];
  const all = [...document.querySelectorAll("#analyze table, #solve table")].map((one) => table(one).filter((line) => line !== null).join("\n"));
  return `${all.join("\n\n")}\n`;
}

/** The look of a picture, which stands in the style sheet of the page and has to go with it. */
const LOOKS = ["fill", "fill-opacity", "stroke", "stroke-width", "stroke-dasharray", "stroke-linejoin", "stroke-linecap", "opacity", "font-size", "font-family", "font-style", "font-weight", "text-anchor", "paint-order"];

/** A picture of its own. */
function pictureOf(svg) {
  const { width, height } = svg.getBoundingClientRect();
  const copy = svg.cloneNode(true);
  const [from, to] = [svg, copy].map((one) => [one, ...one.querySelectorAll("*")]);
  from.forEach((one, i) => {
    const looks = getComputedStyle(one);
    for (const look of LOOKS) to[i].style.setProperty(look, looks.getPropertyValue(look));
    if (looks.display === "none") to[i].style.display = "none";
  });
  copy.querySelectorAll(".grip").forEach((one) => one.remove());
  const paper = getComputedStyle(document.body).backgroundColor;
  for (const [key, value] of Object.entries({ xmlns: SVG, width, height })) copy.setAttribute(key, value);
  copy.prepend(draw("rect", { width: "100%", height: "100%", fill: paper }));
  return { text: new XMLSerializer().serializeToString(copy), width, height };
}

/** The same as dots, two to a pixel. */
async function dotsOf({ text, width, height }) {
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(text)}`;
  await image.decode();
  const canvas = make("canvas", { width: 2 * width, height: 2 * height });
  canvas.getContext("2d").drawImage(image, 0, 0, 2 * width, 2 * height);
  return new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
}

/** A text, packed for an address, and back. */
async function packedText(text) {
  const bytes = await through(new CompressionStream("deflate-raw"), new TextEncoder().encode(text));
  return btoa(String.fromCharCode(...bytes)).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

async function unpackedText(packed) {
  const bytes = Uint8Array.from(atob(packed.replaceAll("-", "+").replaceAll("_", "/")), (c) => c.charCodeAt(0));
  return new TextDecoder().decode(await through(new DecompressionStream("deflate-raw"), bytes));
}

async function through(stream, bytes) {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}
