// The scene in the page: its text, and what the engine says of it as one types.

/** Typing that rests for so long, ms, has the scene run. */
const TYPING = 350;
/** What is told apart: comments, texts of several lines and of one, titles of sections, keys. */
const TOKENS = /(#.*)|("""(?:[^\\]|\\[^])*?(?:"""|$(?![^]))|'''[^]*?(?:'''|$(?![^]))|"(?:[^"\\\n]|\\.)*"?|'[^'\n]*'?)|(^[ \t]*\[[^\]\n]*\]?)|(^[ \t]*[\w."-]+(?=[ \t]*=))/gm;
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
    for (const [part, kind] of tokens(text)) {
      this.piece(part, kind, at);
      at += part.length;
    }
    this.back.append("\n");
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

/** The parts of a text, each with its kind, nothing left out. */
function tokens(text) {
  const parts = [];
  let at = 0;
  for (const match of text.matchAll(TOKENS)) {
    if (match.index > at) parts.push([text.slice(at, match.index), ""]);
    parts.push([match[0], KINDS[match.slice(1).findIndex((group) => group !== undefined)]]);
    at = match.index + match[0].length;
  }
  if (at < text.length) parts.push([text.slice(at), ""]);
  return parts;
}
