// The motion beside the controls: it follows a run, shows the one before as a ghost, and its start can be dragged.

/** Arrows of velocities are as long as what is passed in this part of the motion. */
const ARROW_PART = 0.06;
/** Pixels from the middle of a handle to its edge. */
const HANDLE = 8;
/** Part of a range for a key. */
const KEY_STEP = 0.01;

class LivePlayer extends Player {
  constructor(figure, data, grips) {
    super(figure, data);
    Object.assign(this, { grips, ghosts: [], pins: [], held: this.boxes(), settled: this.cases });
    this.speedsShown = this.check(this.bar, "Velocities", false);
    this.howTo = make("p", { class: "note", hidden: "" }, this.live);
    this.howTo.textContent = "Drag a ring in the picture, or use the arrow keys on it: it sets how the motion starts.";
    this.energyBox = make("div", { class: "energy", role: "img", hidden: "" }, this.live);
    // What can be dragged is in it.
    this.svg.setAttribute("role", "group");
    this.layOut();
  }

  /** Names stand on no handle, and on no arrow to one. */
  kept() {
    return this.handles ?? [];
  }

  boxes() {
    return [...super.boxes(), ...(this.held ?? [])];
  }

  /** While something is dragged the picture keeps its scale: what follows it must not run away from the pointer. */
  fit() {
    super.fit();
    Object.assign(this, this.frozen);
  }

  /** Seconds that an arrow of a velocity is long: those of the starts end in the picture. */
  arrowTime() {
    const rooms = () => this.motion.bodies.map((body) => this.roomFor(body));
    return this.frozen?.arrow ?? Math.min(ARROW_PART * this.duration || 1, ...rooms().filter(Number.isFinite));
  }

  /** Seconds after which a body that goes on as it starts is at the edge of the picture, with the handle at its arrow, and beside its own. */
  roomFor(body) {
    const velocity = ["vx", "vy"].map((key) => this.grips?.of(`${plain(body.name)}.start.${key}`)?.value() ?? 0);
    const rates = [velocity[0] * this.scale, -velocity[1] * this.scale];
    const at = this.pixel(body.x[0], body.y[0]);
    const rooms = rates.map((rate, k) => ((rate > 0 ? this.size[k] - at[k] : at[k]) - 2 * HANDLE) / Math.abs(rate));
    return Math.max(Math.min(...rooms), (3 * HANDLE) / Math.hypot(...rates));
  }

  /** What comes next is of another scene: nothing of this one is compared with it. */
  forget() {
    Object.assign(this, { cases: [], settled: [], pins: [], held: [], energies: null });
  }

  /** Shows one case of a run whose others are not known yet. */
  sketch(data, index) {
    const cases = [...this.cases];
    cases[index] = readMotion(data.cases[0]);
    if (cases.includes(undefined)) return;
    this.cases = cases;
    this.ghosts = this.settled;
    this.choose(index);
  }

  /** Goes on with another motion; the last one stays as a ghost. */
  update(data) {
    this.ghosts = this.settled;
    this.cases = data.cases.map(readMotion);
    this.settled = this.cases;
    this.svg.setAttribute("aria-label", data.description);
    this.offer();
    this.choose(Math.min(this.index, this.cases.length - 1));
  }

  pin(label) {
    this.pins.push({ label, motion: this.motion });
    this.layOut();
  }

  reset() {
    this.ghosts = [];
    this.pins = [];
    this.layOut();
  }

  /** Rows of time, kinetic and potential energy, for each case. */
  setEnergies(energies) {
    this.energies = energies;
    this.drawEnergy();
  }

  build() {
    const held = this.svg.querySelector(".grip:focus")?.getAttribute("aria-label");
    super.build();
    if (!this.grips) return;
    this.ghostLayer = draw("g", { class: "ghosts" });
    this.svg.prepend(this.ghostLayer);
    this.speedLayer = draw("g", {}, this.svg);
    this.gripLayer = draw("g", {}, this.svg);
    this.ghostParts = [...this.pins, ...(this.ghosts.length ? [{ label: "", motion: this.ghosts[Math.min(this.index, this.ghosts.length - 1)] }] : [])].map((one) => this.buildGhost(one));
    this.drawGrips();
    this.draw();
    // Who moves it by keys goes on.
    if (held) this.gripLayer.querySelector(`[aria-label=${JSON.stringify(held)}]`)?.focus({ preventScroll: true });
  }

  buildGhost({ label, motion }) {
    const layer = draw("g", { class: label ? "pinned" : "ghost" }, this.ghostLayer);
    const parts = motion.bodies.map((body, i) => {
      const style = `color:var(--c${i % 7})`;
      const path = body.trail ? this.trailPoints(body).filter((point) => !point.includes("NaN")) : [];
      if (path.length) draw("path", { class: "trail", style, d: `M${path.join("L")}` }, layer);
      const group = drawShape(body, this.scale, style, layer);
      const name = label && i === 0 ? drawLabel(this.ghostLayer, [[label, "", ""]], { class: "halo" }) : null;
      return { body, group, name };
    });
    return { motion, parts };
  }

  draw() {
    super.draw();
    if (!this.ghostParts) return;
    for (const { motion, parts } of this.ghostParts) for (const part of parts) this.drawGhost(motion, part);
    this.drawSpeeds();
    this.drawEnergy();
  }

  drawGhost({ times }, { body, group, name }) {
    const at = Math.min(times.findIndex((time) => time >= this.time), times.length - 1);
    const i = at < 0 ? times.length - 1 : at;
    const [x, y] = this.pixel(body.x[i], body.y[i]);
    if (!Number.isFinite(x + y)) return;
    pose(group, [x, y], body.angle[i]);
    // Beside the body, and within the picture.
    const left = x < this.size[0] / 2 ? 14 : -14;
    name?.setAttribute("text-anchor", left > 0 ? "start" : "end");
    name?.setAttribute("transform", `translate(${(x + left).toFixed(2)} ${(y + 22).toFixed(2)})`);
  }

  drawSpeeds() {
    this.speedLayer.replaceChildren();
    if (!this.speedsShown?.checked) return;
    const [low, high] = this.frame();
    const times = this.motion.times;
    const span = times[high] - times[low];
    if (!(span > 0)) return;
    for (const [i, body] of this.motion.bodies.entries()) {
      const from = this.pixel(body.x[low], body.y[low]);
      const by = [body.x, body.y].map((values) => ((values[high] - values[low]) / span) * this.arrowTime() * this.scale);
      const to = [from[0] + by[0], from[1] - by[1]];
      if (![...from, ...to].every(Number.isFinite)) continue;
      drawSpeed(this.speedLayer, from, to, i);
    }
  }

  /** Kinetic and potential energy now, as parts of a bar. */
  drawEnergy() {
    if (!this.energyBox) return;
    const rows = this.energies?.[this.index] ?? [];
    this.energyBox.hidden = !rows.length;
    if (!rows.length) return;
    const row = rows.find(([time]) => time >= this.time) ?? rows[rows.length - 1];
    const low = Math.min(0, ...rows.map((one) => one[2]));
    const most = Math.max(...rows.map((one) => one[1] + one[2] - low)) || 1;
    const part = (value) => `${((100 * value) / most).toFixed(2)}%`;
    const [kinetic, potential] = [row[1], row[2] - low];
    const bars = [["kinetic", kinetic, row[1]], ["potential", potential, row[2]]];
    this.energyBox.replaceChildren();
    for (const [name, size] of bars) make("span", { class: `part ${name}`, style: `width:${part(size)}` }, this.energyBox);
    const words = make("span", { class: "words" }, this.energyBox);
    for (const [name, , value] of bars) make("span", { class: name }, words).textContent = `${name} ${shown(value, 3)}\u00a0J`;
    this.energyBox.setAttribute("aria-label", bars.map(([name, , value]) => `${name} energy ${shown(value, 3)} J`).join(", "));
  }

  /** What can be dragged of the bodies' starts. */
  drawGrips() {
    this.gripLayer.replaceChildren();
    this.handles = [];
    for (const [index, body] of this.motion.bodies.entries()) {
      const name = plain(body.name);
      const centre = [body.x[0], body.y[0]];
      if (!centre.every(Number.isFinite)) continue;
      const [x, y, angle, vx, vy] = ["x", "y", "angle", "vx", "vy"].map((key) => this.grips.of(`${name}.start.${key}`));
      if (x && y) this.grip(centre, `Start of ${name}`, [x, y], (at) => [[x, at[0]], [y, at[1]]]);
      if (angle) this.turnGrip(body, name, centre, angle, !(x && y));
      if (vx && vy) this.speedGrip(centre, name, [vx, vy], index);
    }
    this.howTo.hidden = !this.handles.length;
  }

  /** A place that is dragged with a pointer or moved by keys; `set` makes values of where it is. */
  grip(at, label, knobs, set) {
    const [cx, cy] = this.pixel(...at);
    this.handles.push(...rim(["circle", cx, cy, HANDLE + 3], 1));
    const handle = draw("circle", { class: "grip", cx, cy, r: HANDLE, tabindex: 0, role: "slider", "aria-label": label }, this.gripLayer);
    handle.setAttribute("aria-valuetext", knobs.map((knob) => knob.text()).join(", "));
    handle.setAttribute("aria-valuenow", knobs[0].value());
    handle.addEventListener("pointerdown", (event) => this.drag(event, set));
    handle.addEventListener("click", (event) => event.stopPropagation());
    handle.addEventListener("keydown", (event) => this.nudge(event, knobs));
  }

  drag(event, set) {
    event.preventDefault();
    event.stopPropagation();
    this.pause();
    this.seek(this.start);
    const { scale, middle, size } = this;
    this.frozen = { scale, middle, size, arrow: this.arrowTime() };
    const move = (moved) => {
      this.grips.set(set(this.place(...pointerIn(this.svg, moved, this.size[0]))));
    };
    const end = () => {
      removeEventListener("pointermove", move);
      removeEventListener("pointerup", end);
      removeEventListener("pointercancel", end);
      this.frozen = null;
      this.layOut();
    };
    addEventListener("pointermove", move);
    addEventListener("pointerup", end);
    addEventListener("pointercancel", end);
  }

  nudge(event, knobs) {
    const by = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (!by) return;
    event.preventDefault();
    const [first, second = first] = knobs;
    const [knob, sign] = by[0] ? [first, by[0]] : [second, by[1]];
    this.grips.set([[knob, knob.value() + sign * KEY_STEP * knob.span()]]);
  }

  /** Turns a body about its pivot, or about its centre. */
  turnGrip(body, name, centre, angle, isHeld) {
    const far = this.farthest(body);
    const pivot = isHeld && this.motion.points.length ? this.motion.points[0].at : centre;
    const before = Math.atan2(far[1] - pivot[1], far[0] - pivot[0]);
    const start = angle.value();
    this.grip(far, `Start angle of ${name}`, [angle], (at) => {
      const turned = Math.atan2(at[1] - pivot[1], at[0] - pivot[0]) - before;
      return [[angle, start + Math.atan2(Math.sin(turned), Math.cos(turned))]];
    });
  }

  /** The point of a body at its start that is farthest from its centre. */
  farthest(body) {
    const points = body.outlines.flatMap(([kind, ...n]) => {
      if (kind === "circle") return [[n[0] + n[2], n[1]]];
      return Array.from({ length: n.length / 2 }, (_, i) => [n[2 * i], n[2 * i + 1]]);
    });
    const pivot = this.motion.points[0]?.at;
    const place = ([px, py]) => {
      const [c, s] = [Math.cos(body.angle[0]), Math.sin(body.angle[0])];
      return [body.x[0] + c * px - s * py, body.y[0] + s * px + c * py];
    };
    const from = pivot ?? [body.x[0], body.y[0]];
    const far = (point) => Math.hypot(point[0] - from[0], point[1] - from[1]);
    return points.map(place).reduce((best, point) => (far(point) > far(best) ? point : best), [body.x[0], body.y[0]]);
  }

  speedGrip(centre, name, knobs, index) {
    const long = this.arrowTime();
    const tip = centre.map((at, k) => at + knobs[k].value() * long);
    const ends = [this.pixel(...centre), this.pixel(...tip)];
    this.handles.push(...along(ends));
    drawSpeed(this.gripLayer, ...ends, index);
    this.grip(tip, `Start velocity of ${name}`, knobs, (at) => knobs.map((knob, k) => [knob, (at[k] - centre[k]) / long]));
  }
}

/** A thin arrow between two places on the screen, of a body by its place among all. */
function drawSpeed(parent, from, to, index) {
  const shaft = { stroke: `var(--c${index % 7})`, "stroke-width": 1.6 };
  if (Math.hypot(to[0] - from[0], to[1] - from[1]) >= 2) drawTip(parent, from, to, shaft, 9);
}
