// Completion in the text of a scene: titles, keys, names of the scene, units and functions, chosen with the keys.

/** No more than these are offered. */
const MOST_OFFERED = 8;
/** So many letters open the list by themselves. */
const LETTERS = 2;

class Completion {
  constructor(area, parent) {
    Object.assign(this, { area, offers: [], chosen: 0 });
    this.list = make("ul", { id: "scene-offers", class: "offers", role: "listbox", "aria-label": "Completions", hidden: "" }, parent);
    area.setAttribute("aria-controls", "scene-offers");
    area.addEventListener("input", () => this.look(LETTERS));
    area.addEventListener("keydown", (event) => this.key(event));
    area.addEventListener("blur", () => this.close());
    area.addEventListener("scroll", () => this.close());
  }

  /** Offers what begins like the word before the cursor. */
  look(letters) {
    const at = this.area.selectionStart;
    const before = this.area.value.slice(0, at);
    this.word = /[\p{L}_][\p{L}\w.]*$/u.exec(before)?.[0] ?? "";
    if (this.word.length < letters) return this.close();
    const all = offered(this.area.value, before.slice(0, at - this.word.length));
    const begin = this.word.toLowerCase();
    this.offers = [...new Set(all)].filter((one) => one !== this.word && one.toLowerCase().startsWith(begin)).sort().slice(0, MOST_OFFERED);
    this.chosen = 0;
    this.show(before);
  }

  show(before) {
    this.list.hidden = !this.offers.length;
    if (this.list.hidden) return this.area.removeAttribute("aria-activedescendant");
    this.list.replaceChildren();
    for (const [i, offer] of this.offers.entries()) {
      const item = make("li", { id: `scene-offer-${i}`, role: "option", "aria-selected": i === this.chosen }, this.list);
      item.textContent = offer;
      item.addEventListener("mousedown", (event) => {
        event.preventDefault();
        this.take(offer);
      });
    }
    this.area.setAttribute("aria-activedescendant", `scene-offer-${this.chosen}`);
    const lines = before.split("\n");
    const style = getComputedStyle(this.area);
    const column = lines[lines.length - 1].length - this.word.length;
    this.list.style.left = `calc(${column}ch + ${style.paddingLeft} - ${this.area.scrollLeft}px)`;
    this.list.style.top = `${lines.length * parseFloat(style.lineHeight) + parseFloat(style.paddingTop) - this.area.scrollTop}px`;
  }

  key(event) {
    if (event.ctrlKey && event.key === " ") {
      event.preventDefault();
      return this.look(0);
    }
    if (this.list.hidden) return;
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (step) {
      this.chosen = (this.chosen + step + this.offers.length) % this.offers.length;
      this.moved = true;
      [...this.list.children].forEach((item, i) => item.setAttribute("aria-selected", i === this.chosen));
      this.area.setAttribute("aria-activedescendant", `scene-offer-${this.chosen}`);
    } else if (event.key === "Tab" || (event.key === "Enter" && this.moved)) {
      this.take(this.offers[this.chosen]);
    } else if (event.key === "Escape") {
      this.close();
    } else {
      return;
    }
    event.preventDefault();
  }

  take(offer) {
    const at = this.area.selectionStart;
    this.area.focus();
    this.area.setSelectionRange(at - this.word.length, at);
    // The one way of writing that the reader can undo.
    document.execCommand("insertText", false, offer);
    this.close();
  }

  close() {
    this.list.hidden = true;
    this.moved = false;
    this.area.removeAttribute("aria-activedescendant");
  }
}

/** What may stand at the end of this text, in this scene. */
function offered(scene, before) {
  const line = before.slice(before.lastIndexOf("\n") + 1);
  const { sections, units, functions } = SETTINGS.words;
  if (/^\s*\[[^\]]*$/.test(line)) return sections;
  const isText = (line.match(/(?<!\\)"/g) ?? []).length % 2 === 1;
  if (!isText) return keys(before);
  const named = [...scene.matchAll(/^\s*\[\w+\.([\w.]+)\]/gm)].map((match) => match[1]);
  const parameters = /^\[parameters\][^\n]*\n([^[]*)/m.exec(scene)?.[1] ?? "";
  const names = [...parameters.matchAll(/^\s*([\p{L}_]\w*)\s*=/gmu)].map((match) => match[1]);
  return /[\d.]\s+$|[*/]$/.test(line) ? [...units, ...names] : [...names, ...named, ...functions, ...units];
}

/** The keys of the table that this text ends in: of the braces that are still open, else of the section. */
function keys(before) {
  const header = [...before.matchAll(/^\s*\[([\w.]+)\]/gm)].at(-1);
  const text = before.slice(header ? header.index : 0).replace(/"(?:[^"\\\n]|\\.)*"|#.*/g, "");
  const open = [];
  for (const [, key, brace] of text.matchAll(/([\p{L}_][\w.]*)\s*=[\s[]*(?=\{)|([{}])/gu)) {
    if (key) open.next = key.split(".").at(-1);
    else if (brace === "{") open.push(open.next);
    else open.next = open.pop();
  }
  if (!open.length && !header) return SETTINGS.words.sections;
  const of = (behind) => SETTINGS.words.keys.filter(([name]) => name === behind).flatMap(([, all]) => all);
  if (open.length) return of(open.at(-1));
  const [kind, , ...inner] = header[1].split(".");
  const within = /^play\.presets/.test(header[1]) ? "[play.presets" : inner.length ? inner.at(-1) : `[${kind}`;
  return of(within);
}
