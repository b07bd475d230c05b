// The panel: values, presets, ghosts, pins, and what the engine says.

const SETTINGS = JSON.parse(document.getElementById("lab-data").textContent);
/** What a page shows of a run. */
const SHOWN = ["scene", "run", "sketch", "motion", "energy", "report"];

/** Whether the panel stands alone in a frame of another page, which makes it as high as it wants to be. */
const EMBEDDED = location.hash.startsWith("#embed");

/** A quantity as scenes have it, of one from an address, which has no spaces. */
const spaced = (text) => text.replace(/^([-+]?\d[\d.]*(?:e[-+]?\d+)?)(?=[\p{L}%°])/u, "$1 ");

class Lab {
  constructor(box) {
    Object.assign(this, { box, scene: SETTINGS.scene, set: new Map(SETTINGS.set), controls: new Map() });
    this.sections = new Sections();
    this.build();
    this.runs = new Runs((kind, value) => this.hear(kind, value));
    box.hidden = false;
    if (EMBEDDED) this.embed();
    this.fromAddress();
  }

  embed() {
    document.documentElement.classList.add("embedded");
    const tell = () => parent.postMessage({ height: document.body.scrollHeight }, "*");
    new ResizeObserver(tell).observe(document.body);
  }

  build() {
    make("h2", { id: "play-heading" }, this.box).textContent = "Play";
    const sides = make("div", { class: "sides" }, this.box);
    const view = make("div", { class: "view" }, sides);
    this.board = make("div", { class: "board" }, sides);
    const result = make("div", { class: "result" }, sides);
    if (DATA.motions.length) this.buildPlayer(view);
    this.status = make("p", { class: "status note", role: "status" }, view);
    this.progress = make("progress", { max: 1, value: 0, hidden: "", "aria-label": "Progress of the run" }, view);
    this.stop = this.button(view, "Stop", () => this.runs.stop());
    this.stop.hidden = true;
    this.said = make("div", { class: "said", role: "alert", hidden: "" }, view);
    this.aside = make("p", { class: "note" }, result);
    this.told = make("pre", { class: "told", hidden: "" }, result);
    reachable(this.box);
    this.buildBoard();
  }

  buildPlayer(view) {
    const figure = make("figure", { class: "motion" }, view);
    const grips = { of: (name) => this.gripOf(name), set: (pairs) => this.drag(pairs) };
    this.player = new LivePlayer(figure, DATA.motions[0], grips);
    chosenCase.listen(this, () => this.showSwept());
  }

  button(parent, text, act) {
    const button = make("button", { type: "button" }, parent);
    button.textContent = text;
    button.addEventListener("click", act);
    return button;
  }

  buildBoard() {
    this.buildTemplates(SETTINGS.templates);
    this.presets = make("div", {}, this.board);
    this.buildPresets(SETTINGS.play.presets);
    this.knobs = make("div", {}, this.board);
    this.buildKnobs(SETTINGS.play.knobs);
    const bar = make("div", { class: "bar" }, this.board);
    this.button(bar, "Reset", () => this.reset());
    this.button(bar, "Pin this run", () => this.pin());
    const large = this.button(bar, "Large type", () => this.enlarge(large));
    large.setAttribute("aria-pressed", false);
    this.editor = new SceneEditor(this.box, this.scene, (text) => this.edit(text));
    this.editor.box.open = SETTINGS.templates.length > 0 && !EMBEDDED;
    this.buildSaves(this.editor.bar);
  }

  /** For a class that looks at it from afar, and back. */
  enlarge(button) {
    button.setAttribute("aria-pressed", document.documentElement.classList.toggle("projector"));
    this.player?.layOut();
    this.box.scrollIntoView();
  }

  /** Scenes to begin with. */
  buildTemplates(templates) {
    if (!templates.length || EMBEDDED) return;
    const label = make("label", { class: "templates" }, this.board);
    label.append("Begin with ");
    const select = make("select", {}, label);
    for (const [name] of templates) select.append(new Option(name));
    select.addEventListener("change", () => {
      this.set.clear();
      this.isOther = true;
      const scene = templates[select.selectedIndex][1];
      this.editor.box.open = true;
      this.editor.show(scene);
      this.edit(scene);
    });
  }

  /** The presets of a scene, in the place of those before. */
  buildPresets(presets) {
    this.presets.replaceChildren();
    this.presets.hidden = !presets.length;
    this.offered = JSON.stringify(presets);
    const bar = make("div", { class: "bar", role: "group", "aria-label": "Presets" }, this.presets);
    for (const preset of presets) this.button(bar, preset.label, () => this.choose(preset)).title = preset.text;
    this.words = make("p", { class: "note" }, this.presets);
  }

  /** The sliders of a scene, in the place of those before. */
  buildKnobs(knobs) {
    this.controls.clear();
    this.knobs.replaceChildren();
    const first = make("div", { class: "knobs" }, this.knobs);
    const rest = make("details", {}, this.knobs);
    make("summary", {}, rest).textContent = "More values";
    const changed = (control, text) => this.change(control.knob.name, text);
    for (const knob of knobs) this.controls.set(knob.name, new Control(knob, knob.first ? first : rest, changed));
    rest.hidden = knobs.every((knob) => knob.first);
    this.take(knobs);
    this.showSwept();
  }

  /** Values as the scene and what is set have them. */
  take(knobs) {
    this.given = new Map(knobs.map((knob) => [knob.name, knob]));
    for (const knob of knobs) this.controls.get(knob.name)?.take(knob);
  }

  buildSaves(bar) {
    this.button(bar, "The scene as it was", () => {
      this.editor.show(SETTINGS.scene);
      this.edit(SETTINGS.scene);
    });
    this.button(bar, "Save scene.toml", () => this.saveScene());
    this.button(bar, "Save tables (CSV)", () => this.askTables());
    if (!this.player) return;
    this.button(bar, "Save picture (SVG)", () => save("picture.svg", "image/svg+xml", pictureOf(this.player.svg).text));
    this.button(bar, "Save picture (PNG)", async () => save("picture.png", "image/png", await dotsOf(pictureOf(this.player.svg))));
  }

  /** The scene as it is written, with the values of the sliders; what has no plain place in it is told. */
  saveScene() {
    const { scene, left } = written(this.scene, this.set);
    const settings = left.map(([name, text]) => `--set "${name}=${text}"`).join(" ");
    this.editor.state.textContent = left.length ? `Not in the text, because its place there is no plain value: run it with ${settings}.` : "";
    save("scene.toml", "application/toml", scene);
  }

  /** The tables that the command writes, of the run that is shown: it is made once more. */
  askTables() {
    this.runs.ask({ ...(this.shown ?? this.request()), brief: false, tables: true });
    this.status.textContent = "The tables are being made.";
  }

  async saveTables(files) {
    save(`${SETTINGS.name}.zip`, "application/zip", await zipped(files));
    this.status.textContent = `Saved ${SETTINGS.name}.zip: ${files.length} tables.`;
  }

  /** Another scene: it runs, and what it does not have is no longer set. */
  edit(scene) {
    this.scene = scene;
    this.edited = true;
    this.ask();
  }

  /** What a start is dragged by: itself, or the parameter that it is. */
  gripOf(name) {
    const control = this.controls.get(name);
    if (!control) return null;
    const parameter = this.set.has(name) ? null : this.controls.get(control.field.value);
    return new Grip(parameter ?? control);
  }

  drag(pairs) {
    for (const [grip, value] of pairs) grip.put(value);
  }

  change(name, text) {
    this.set.delete(name);
    this.set.set(name, text);
    this.ask();
  }

  choose(preset) {
    this.set = new Map([...SETTINGS.set, ...preset.set]);
    this.words.textContent = preset.text;
    this.ask();
  }

  reset() {
    this.set = new Map(SETTINGS.set);
    this.player?.reset();
    this.sections.unpin();
    this.words.textContent = "";
    this.ask();
  }

  pin() {
    const label = this.label();
    this.player?.pin(label);
    this.sections.pin(label);
  }

  /** What is different now: `T = 2 s, m = 3 kg`. */
  label() {
    const called = (name) => plain(this.controls.get(name)?.knob.label ?? [[name]]);
    return [...this.set].map(([name, text]) => `${called(name)} = ${text}`).join(", ") || "as given";
  }

  request() {
    const { name, files } = SETTINGS;
    return { name, scene: this.scene, set: [...this.set], files, shown: this.player?.index ?? 0, brief: EMBEDDED };
  }

  ask() {
    const request = this.request();
    this.asked = request.set;
    this.runs.ask(request);
    clearTimeout(this.linking);
    this.linking = setTimeout(() => this.link(), 400);
  }

  /** The address holds what is set: `#T=2s&w1=15m/s`. */
  link() {
    const own = [...this.set].filter(([name, text]) => new Map(SETTINGS.set).get(name) !== text);
    const words = own.map(([name, text]) => `${name}=${encodeURIComponent(text.replaceAll(" ", ""))}`);
    this.linkTo(words);
  }

  /** An edited scene is in the address too. */
  async linkTo(words) {
    const { scene } = this;
    if (scene !== SETTINGS.scene) words.push(`scene=${await packedText(scene)}`);
    if (scene !== this.scene) return;
    history.replaceState(null, "", words.length ? `#${words.join("&")}` : location.pathname + location.search);
  }

  /** Takes what the address holds, and runs it. */
  async fromAddress() {
    const given = location.hash.slice(1).split("&").filter((part) => part.includes("="));
    for (const part of given) {
      const [name, text] = [part.slice(0, part.indexOf("=")), part.slice(part.indexOf("=") + 1)].map(decodeURIComponent);
      if (name === "scene") await this.takePacked(text);
      else this.set.set(name, spaced(text));
    }
    if (given.length) this.ask();
  }

  async takePacked(text) {
    try {
      this.scene = await unpackedText(text);
      this.isOther = SETTINGS.templates.length > 0;
      this.editor.show(this.scene);
    } catch {
      this.status.textContent = "The scene in the address cannot be read: the link is not whole. The scene of this page is shown.";
    }
  }

  busy(is) {
    this.stop.hidden = this.progress.hidden = true;
    clearTimeout(this.patience);
    if (is) this.patience = setTimeout(() => (this.stop.hidden = this.progress.hidden = false), 300);
  }

  /** What becomes of the newest request; one for tables shows nothing else. */
  hear(kind, value) {
    if (this.runs?.wanted?.tables && SHOWN.includes(kind)) return;
    const act = {
      began: () => {
        this.lines = [];
        this.fails = false;
        this.progress.removeAttribute("value");
        this.busy(true);
      },
      scene: () => this.takeScene(value),
      progress: () => (this.progress.value = value),
      run: () => this.takeRun(value),
      sketch: () => this.takeSketch(value),
      motion: () => this.takeMotion(value.motion),
      energy: () => this.takeEnergy(value.cases),
      report: () => this.sections.show(value.parts),
      tables: () => this.saveTables(value.files),
      mistakes: () => this.refuse(value),
      refused: () => this.refuse(value),
      stopped: () => this.end("Stopped. The last run that ended is shown."),
      broken: () => this.end(`The run has broken off. ${value} The last run that ended is shown.`),
      done: () => this.busy(false),
    }[kind];
    act?.();
  }

  takeScene({ title, said, play }) {
    this.warnings = said.list;
    document.title = document.querySelector("h1").textContent = title;
    const isOther = play.knobs.map((knob) => knob.name).join() !== [...this.controls.keys()].join();
    if (isOther) this.buildKnobs(play.knobs);
    if (JSON.stringify(play.presets) !== this.offered) this.buildPresets(play.presets);
    this.take(play.knobs);
  }

  /** Sliders of what is swept stand where they are in the run that is chosen. */
  showSwept() {
    const cases = this.player?.cases ?? [];
    const own = new Map(cases[this.player?.index]?.values);
    for (const name of new Set(cases.flatMap(({ values }) => values.map(([name]) => name)))) {
      const [control, knob] = [this.controls.get(name), this.given.get(name)];
      if (knob) control?.take(knob);
      if (own.has(name)) control?.show(own.get(name));
    }
  }

  takeRun({ told, said, fails }) {
    this.lines.push(told);
    this.fails ||= fails;
    this.warnings.push(...said.list);
  }

  takeMotion(motion) {
    this.shown = this.runs.wanted;
    showSaid(this.said, { list: this.warnings });
    this.editor.tell({ list: this.warnings }, this.scene);
    if (this.edited) this.editor.state.textContent = "The scene is right: what is shown is its run.";
    this.edited = false;
    this.told.hidden = false;
    this.told.textContent = this.lines.join("\n");
    const isOther = this.set.size > 0 && this.fails;
    this.aside.textContent = isOther ? "What a check expects was stated for the scene’s own values." : "";
    this.status.textContent = this.label();
    this.player?.update(motion);
    this.showSwept();
    this.box.dataset.runs = Number(this.box.dataset.runs ?? 0) + 1;
  }

  takeSketch(sketch) {
    if (this.isOther) this.player?.forget();
    this.isOther = false;
    this.player?.sketch(sketch.motion, sketch.case);
  }

  takeEnergy(cases) {
    this.player?.setEnergies(cases);
  }

  /** What is wrong, at its field; the last good run stays. */
  refuse({ said, words }) {
    const gone = said.list.length && this.edited && said.list.every(({ source }) => source > 0);
    if (gone) return this.forget(said.list.map(({ source }) => this.asked[source - 1]?.[0]));
    // What is wrong with a text that was typed is told once, under it.
    const isTyped = this.edited && said.list.length > 0 && said.list.every(({ source }) => source === 0);
    showSaid(this.said, isTyped ? { list: [] } : said, isTyped ? "" : words);
    if (isTyped) this.editor.box.open = true;
    this.editor.tell(said, this.scene, words);
    for (const { source } of said.list) {
      const name = this.asked[source - 1]?.[0];
      this.controls.get(name)?.field.setAttribute("aria-invalid", "true");
    }
    this.status.textContent = "The last run that ended is shown.";
    this.busy(false);
  }

  /** An edited scene may not have what was set before: it runs without it. */
  forget(names) {
    this.edited = false;
    for (const name of names) this.set.delete(name);
    this.ask();
  }

  end(words) {
    this.busy(false);
    this.status.textContent = words;
  }
}

globalThis.lab = new Lab(document.getElementById("play"));
