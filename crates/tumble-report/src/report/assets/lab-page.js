// Puts what the engine sends where the page has it: sections, curves, motion.

/** How many curves of runs before are shown beside those of now. */
const BEFORE = "before";

/** The parts of the page that follow a run. */
class Sections {
  constructor() {
    this.shown = [];
    this.plots = DATA.plots;
    this.pins = [];
  }

  /** Shows the sections of a report; what is as before stays untouched. */
  show(parts) {
    const plots = parts.plots.map((plot, i) => this.withOthers(plot, i));
    parts.sections.forEach((html, i) => {
      const section = document.getElementById(["identify", "model", "solve", "analyze"][i]);
      if (this.shown[i] === html && i < 3) return;
      this.shown[i] = html;
      const template = document.createElement("template");
      template.innerHTML = html;
      const fresh = template.content.firstElementChild;
      const place = section.getBoundingClientRect().top;
      section.replaceWith(fresh);
      // What is being looked at stays where it is.
      if (place < 0) scrollBy(0, fresh.getBoundingClientRect().top - place);
      mount(fresh, { plots, motions: parts.motions });
    });
    clock.tidy();
    chosenCase.tidy();
    this.plots = parts.plots;
    this.lead(parts.lead);
  }

  /** What was found, below the title. */
  lead(html) {
    const header = document.querySelector("body > header");
    const line = header.querySelector(".lead") ?? make("p", { class: "lead" });
    line.innerHTML = html;
    if (!line.isConnected) header.querySelector("h1").after(line);
  }

  /** A plot with the curves of the last run and of those that were pinned. */
  withOthers(plot, i) {
    const others = [...this.pins.map((pin) => [pin.label, pin.plots[i]]), [BEFORE, this.plots[i]]];
    const series = others.flatMap(([name, other]) => this.faded(name, other, plot));
    return { ...plot, series: [...plot.series, ...series] };
  }

  faded(name, other, plot) {
    if (!other || plain(other.y.title) !== plain(plot.y.title)) return [];
    const label = (series) => [...(series.label.length ? series.label : other.y.name), [` (${name})`, "", ""]];
    return other.series.map((series) => ({ ...series, label: label(series), dashes: "1.5 3" }));
  }

  pin(label) {
    this.pins.push({ label, plots: this.plots });
  }

  unpin() {
    this.pins = [];
  }
}

/** What is said of a scene, in the words of the command: code, place, message, the line, its cure. */
function showSaid(box, { list }, words = "") {
  box.replaceChildren();
  box.hidden = !(list.length || words);
  if (words) make("p", {}, box).textContent = words;
  for (const one of list) {
    const item = make("div", { class: one.severity }, box);
    const head = make("p", {}, item);
    make("b", {}, head).textContent = one.code;
    head.append(` ${one.message}`);
    if (one.line) make("p", { class: "note" }, item).textContent = `${one.name}:${one.line}:${one.column}`;
    if (one.line) underlined(make("pre", {}, item), one);
    if (one.help) make("p", { class: "help" }, item).textContent = `help: ${one.help}`;
  }
}

/** The line of a mistake, with what is wrong in it underlined and named. */
function underlined(box, { text, column, labels }) {
  const [label] = labels;
  const wide = Math.max(1, Math.min(label.to - label.from, text.length - column + 1));
  box.textContent = `${text}\n${" ".repeat(column - 1)}${"^".repeat(wide)} ${label.text}`;
}
