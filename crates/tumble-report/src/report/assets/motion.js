// A motion that plays: bodies, links, trails, forces on request.

/** Seconds of motion for a second of the reader's: those near a good one are offered. */
const SPEEDS = Array.from({ length: 45 }, (_, i) => Number(`${[1, 2, 5][i % 3]}e${Math.floor(i / 3) - 8}`));
const NEAR_SPEED = 60;
/** How long a motion takes on the screen if nobody says otherwise, in seconds. */
const GOOD_LENGTH = 7;
/** Steps of the slider. */
const SLIDER = 1000;
/** Seconds between pictures for readers who asked for less motion. */
const CALM = 0.5;

const calm = matchMedia("(prefers-reduced-motion: reduce)");

/** Pixels that a picture may be high; before a class it has most of the screen. */
const tallest = () => (document.documentElement.classList.contains("projector") ? Math.max(0.68 * innerHeight, 300) : 460);

/** A case with its columns as numbers. */
function readMotion(data) {
  const bodies = data.bodies.map((body) => ({ ...body, x: decode(body.x), y: decode(body.y), angle: decode(body.angle) }));
  const links = data.links.map((link) => ({ ...link, ends: link.ends.map(decode) }));
  const forces = data.forces.map((force) => {
    const [px, py, fx, fy] = force.samples.map(decode);
    return { ...force, px, py, fx, fy };
  });
  return { ...data, times: decode(data.times), bodies, links, forces };
}

class Player {
  constructor(figure, data) {
    Object.assign(this, { figure, data, time: 0, index: 0, playing: false });
    this.cases = data.cases.map(readMotion);
    this.live = make("div", { class: "live" });
    figure.prepend(this.live);
    this.svg = draw("svg", { role: "img", "aria-label": data.description }, this.live);
    this.speeds = this.goodSpeeds();
    this.addControls();
    figure.classList.add("scripted");
    this.choose(0);
    this.watch();
  }

  /** Speeds to choose from, with the wanted one among them. */
  goodSpeeds() {
    const length = ({ times }) => (times.length ? times[times.length - 1] - times[0] : 0);
    const longest = Math.max(...this.cases.map(length));
    this.wanted = this.data.speed > 0 ? this.data.speed : longest / GOOD_LENGTH || 1;
    const near = SPEEDS.filter((speed) => Math.abs(Math.log(speed / this.wanted)) < Math.log(NEAR_SPEED));
    const speeds = this.data.speed > 0 ? [...near, this.data.speed] : near;
    return speeds.length ? [...new Set(speeds)].sort((a, b) => a - b) : [this.wanted];
  }

  addControls() {
    const bar = make("div", { class: "bar", role: "group", "aria-label": "Motion" }, this.live);
    this.button = make("button", { type: "button", class: "play" }, bar);
    this.slider = make("input", { type: "range", min: 0, max: SLIDER, value: 0, "aria-label": "Time" }, bar);
    this.readout = make("span", { class: "at" }, bar);
    this.speed = this.select(bar, "Speed", this.speeds.map((speed) => `${shown(speed, 3)}\u00a0×`));
    const far = (speed) => Math.abs(Math.log(speed / this.wanted));
    this.speed.selectedIndex = this.speeds.reduce((best, s, i) => (far(s) < far(this.speeds[best]) ? i : best), 0);
    this.bar = bar;
    this.offer();
    this.words = make("p", { class: "note" }, this.live);
  }

  /** What there is to choose of these motions; what was offered and is not there stays out of sight. */
  offer() {
    const hasTrail = (motion) => motion.bodies.some((body) => body.trail);
    const there = {
      chooser: this.cases.length > 1,
      forces: this.cases.some((motion) => motion.forces.length),
      trails: this.cases.some(hasTrail),
    };
    if (there.chooser) this.chooser ??= this.addChooser();
    if (there.forces) this.forces ??= this.check(this.bar, "Forces", false);
    if (there.trails) this.trails ??= this.check(this.bar, "Paths", true);
    for (const [name, is] of Object.entries(there)) if (this[name]) this[name].parentElement.hidden = !is;
    if (!there.chooser) return;
    const name = (motion, i) => plain(motion.name) || `Case ${i + 1}`;
    this.chooser.replaceChildren(...this.cases.map((motion, i) => new Option(name(motion, i), i)));
  }

  addChooser() {
    const chooser = this.select(this.bar, "Case", []);
    chooser.addEventListener("change", () => {
      this.choose(chooser.selectedIndex);
      chosenCase.set(this.index, this);
    });
    return chooser;
  }

  select(bar, title, names) {
    const label = make("label", {}, bar);
    label.append(title);
    const select = make("select", {}, label);
    select.append(...names.map((name, i) => new Option(name, i)));
    return select;
  }

  check(bar, title, checked) {
    const label = make("label", {}, bar);
    const box = make("input", { type: "checkbox" }, label);
    box.checked = checked;
    label.append(title);
    box.addEventListener("change", () => this.draw());
    return box;
  }

  watch() {
    this.button.addEventListener("click", () => (this.playing ? this.pause() : this.play()));
    this.slider.addEventListener("input", () => {
      this.pause();
      this.seek(this.start + (this.duration * this.slider.value) / SLIDER);
      this.tell();
    });
    this.svg.addEventListener("click", () => (this.playing ? this.pause() : this.play()));
    watchWidth(this.live, () => this.layOut());
    this.agree();
    document.addEventListener("visibilitychange", () => document.hidden && this.pause());
    this.pause();
  }

  /** Goes with the rest of the page in time and case. */
  agree() {
    clock.listen(this, (time) => {
      if (!this.playing && time !== null) this.seek(time);
    });
    chosenCase.listen(this, (index) => {
      if (index < this.cases.length) this.choose(index);
    });
  }

  /** Has the rest of the page come along. */
  tell() {
    clock.set(this.time, this);
  }

  choose(index) {
    this.index = index;
    this.motion = this.cases[index];
    if (this.chooser) this.chooser.selectedIndex = index;
    const times = this.motion.times;
    this.start = times[0] ?? 0;
    this.duration = (times[times.length - 1] ?? 0) - this.start;
    this.layOut();
    this.seek(this.time);
  }

  /** What has to be in the picture. */
  boxes() {
    return this.cases.map((motion) => motion.box).filter((box) => box);
  }

  layOut() {
    this.fit();
    const [width, height] = this.size;
    this.arrows = new ArrowScale(this.cases, 0.3 * Math.min(width, height));
    this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.svg.setAttribute("height", height);
    this.build();
  }

  /** Scales for the width at hand; the same for all cases. */
  fit() {
    const boxes = this.boxes();
    const bound = (k, pick, otherwise) => (boxes.length ? pick(...boxes.map((box) => box[k])) : otherwise);
    const low = [bound(0, Math.min, 0), bound(1, Math.min, 0)];
    const high = [bound(2, Math.max, 1), bound(3, Math.max, 1)];
    const size = [0, 1].map((k) => high[k] - low[k]);
    const room = 0.09 * Math.max(...size, 1e-9);
    const width = Math.max(this.live.clientWidth, 240);
    const wide = size[0] + 2 * room;
    const tall = size[1] + 2 * room;
    const height = Math.min(Math.max((width * tall) / wide + STRIP, 180), 0.75 * width, tallest());
    this.scale = Math.min(width / wide, (height - STRIP) / tall);
    this.middle = [0, 1].map((k) => (low[k] + high[k]) / 2);
    this.size = [width, height];
  }

  pixel(x, y) {
    const [width, height] = this.size;
    return [width / 2 + (x - this.middle[0]) * this.scale, (height + STRIP) / 2 - (y - this.middle[1]) * this.scale];
  }

  /** Where a pixel is. */
  place(px, py) {
    const [width, height] = this.size;
    return [this.middle[0] + (px - width / 2) / this.scale, this.middle[1] - (py - (height + STRIP) / 2) / this.scale];
  }

  /** What does not change while it plays, and the parts that move. */
  build() {
    this.svg.replaceChildren();
    this.board = new NameBoard(draw("g", {}), this.size);
    new Ground(this, this.motion.surfaces);
    this.parts = this.motion.bodies.map((body, i) => this.buildBody(body, i));
    this.linkLayer = draw("g", {}, this.svg);
    for (const { at: [x, y] } of this.motion.points) {
      const [cx, cy] = this.pixel(x, y);
      draw("circle", { class: "pin", cx, cy, r: 3.5 }, this.svg);
    }
    this.addNames();
    this.arrowLayer = draw("g", {}, this.svg);
    this.draw();
  }

  /** Points and bodies, by their names. */
  addNames() {
    const { points, bodies } = this.motion;
    this.svg.append(this.board.layer);
    const few = bodies.length > MOST_NAMED ? [] : bodies;
    this.names = [...points, ...few].map(({ name }) => this.board.add(name));
  }

  /** Places, in pixels, that names keep clear of beside all that is drawn here. */
  kept() {
    return [];
  }

  /** Names are where there is nothing else: outlines, links and surfaces. */
  placeNames(between) {
    const { points, bodies } = this.motion;
    const centres = bodies.map((body) => this.pixel(between(body.x), between(body.y)));
    const dots = bodies.flatMap((body, i) => {
      const [cos, sin] = [Math.cos(between(body.angle)), Math.sin(between(body.angle))];
      return this.parts[i].rim.map(([x, y]) => [centres[i][0] + cos * x - sin * y, centres[i][1] - sin * x - cos * y]);
    });
    const at = [...points.map((point) => this.pixel(...point.at)), ...centres];
    this.board.put(this.names.map((name, i) => ({ name, at: at[i] })), [...dots, ...at, ...this.kept()]);
  }

  buildBody(body, index) {
    const style = `color:var(--c${index % 7})`;
    const trail = draw("path", { class: "trail", style }, this.svg);
    const group = drawShape(body, this.scale, style, this.svg);
    const centre = draw("circle", { class: "pin", r: 2.4 }, this.svg);
    const points = body.outlines.flatMap((outline) => rim(outline, this.scale));
    return { trail, group, centre, rim: points, path: body.trail ? this.trailPoints(body) : [] };
  }

  trailPoints(body) {
    return Array.from(body.x, (x, i) => this.pixel(x, body.y[i]).map((v) => v.toFixed(1)).join(" "));
  }

  /** The frame before a time, and how far the time is on the way to the next. */
  frame() {
    const [low, high, part] = around(this.motion.times, this.time);
    return [low, high, clamp(part, 0, 1)];
  }

  draw() {
    if (!this.parts || !this.motion.times.length) return;
    const [low, high, part] = this.frame();
    const between = (values) => values[low] + part * (values[high] - values[low]);
    this.motion.bodies.forEach((body, i) => this.drawBody(body, this.parts[i], between, low));
    this.placeNames(between);
    this.linkLayer.replaceChildren();
    for (const { kind, ends } of this.motion.links) {
      const [x0, y0, x1, y1] = ends.map(between);
      drawLink(this.linkLayer, kind, this.pixel(x0, y0), this.pixel(x1, y1));
    }
    this.arrowLayer.replaceChildren();
    if (this.forces?.checked) {
      for (const force of this.motion.forces) {
        const [px, py, fx, fy] = [force.px, force.py, force.fx, force.fy].map((values) => values[low]);
        if (Number.isFinite(px + py + fx + fy)) drawArrow(this.arrowLayer, force, this.pixel(px, py), [fx, fy], this.arrows);
      }
    }
    this.words.textContent = this.forces?.checked ? this.arrows.words() : "";
    this.showTime();
  }

  drawBody(body, { trail, group, centre, path }, between, low) {
    const [x, y] = this.pixel(between(body.x), between(body.y));
    const there = Number.isFinite(x + y);
    group.style.display = centre.style.display = there ? "" : "none";
    if (!there) return;
    pose(group, [x, y], between(body.angle));
    centre.setAttribute("cx", x);
    centre.setAttribute("cy", y);
    const shownPath = this.trails?.checked && path.length ? path.slice(0, low + 1) : [];
    const points = shownPath.filter((point) => !point.includes("NaN"));
    trail.setAttribute("d", points.length ? `M${points.join("L")}L${x} ${y}` : "");
  }

  showTime() {
    this.slider.value = this.duration > 0 ? ((this.time - this.start) / this.duration) * SLIDER : 0;
    const decimals = Math.max(0, 3 - Math.floor(Math.log10(this.duration || 1)));
    const text = `${this.time.toFixed(Math.min(decimals, 9)).replace("-", "−")}\u00a0s`;
    this.slider.setAttribute("aria-valuetext", text);
    this.readout.replaceChildren();
    make("i", {}, this.readout).textContent = "t";
    this.readout.append(` = ${text}`);
  }

  seek(time) {
    this.time = clamp(time, this.start, this.start + this.duration);
    this.draw();
  }

  get isOver() {
    return this.time >= this.start + this.duration - 1e-12;
  }

  play() {
    if (this.isOver) this.seek(this.start);
    this.playing = true;
    this.button.textContent = "Pause";
    this.last = null;
    requestAnimationFrame((now) => this.tick(now));
  }

  pause() {
    this.playing = false;
    this.button.textContent = "Play";
  }

  tick(now) {
    if (!this.playing) return;
    const passed = this.last === null ? 0 : (now - this.last) / 1000;
    if (this.last === null || !calm.matches || passed >= CALM) {
      this.last = now;
      this.seek(this.time + passed * this.speeds[this.speed.selectedIndex]);
      this.tell();
    }
    if (this.isOver) this.pause();
    else requestAnimationFrame((next) => this.tick(next));
  }
}
