// Curves to look into: values under the pointer, zoom, curves switched off and on.

const LEFT = 84, RIGHT = 14, TOP = 14, BELOW = 46;

class Plot {
  constructor(figure, data) {
    Object.assign(this, { figure, data });
    this.series = data.series.map((series) => this.readSeries(series));
    this.bands = data.bands.map((band) => ({ ...band, x: decode(band.x), low: decode(band.low), high: decode(band.high) }));
    this.forward = this.series.every((series) => series.forward);
    this.xRange = this.forward || data.x.range ? 0 : 0.06;
    this.live = make("div", { class: "live" });
    figure.prepend(this.live);
    this.addBar();
    this.svg = draw("svg", { tabindex: "0", role: "img", "aria-label": this.spoken() }, this.live);
    this.heard = make("p", { class: "heard", "aria-live": "polite" }, this.live);
    figure.classList.add("scripted");
    this.reset();
    this.watch();
  }

  readSeries(series) {
    const [x, y] = [decode(series.x), decode(series.y)];
    // A gap has a place on the axis, so that samples stay in order.
    x.forEach((value, i) => {
      if (Number.isNaN(value)) {
        x[i] = x[i - 1] ?? x.find(Number.isFinite) ?? 0;
        y[i] = NaN;
      }
    });
    const forward = x.every((value, i) => i === 0 || !(value < x[i - 1]));
    return { ...series, x, y, forward, visible: true };
  }

  spoken() {
    const keys = "Arrow keys move the cursor, plus and minus zoom, Escape shows all.";
    return `${this.figure.dataset.name}. ${this.data.description} ${keys}`;
  }

  addBar() {
    const bar = make("div", { class: "bar" }, this.live);
    if (this.data.title.length) addLabel(make("span", { class: "title" }, bar), this.data.title);
    this.bands.forEach((band) => this.addBandKey(band, bar));
    this.series.forEach((series) => this.addKey(series, bar));
    this.at = make("span", { class: "at" }, bar);
    this.all = make("button", { type: "button", hidden: "" }, bar);
    this.all.textContent = "Show all";
    this.all.addEventListener("click", () => this.reset());
  }

  addKey(series, bar) {
    const single = this.series.length === 1;
    const key = make(single ? "span" : "button", { class: "key" }, bar);
    series.key = key;
    if (!single) {
      key.type = "button";
      key.setAttribute("aria-pressed", "true");
      key.title = "Show or hide this curve";
      key.addEventListener("click", () => this.toggle(series));
    }
    this.sample(key, "line", { x1: 0, x2: 28, y1: 5, y2: 5, ...this.stroke(series) }, series.label.length ? series.label : this.data.y.name);
    series.value = make("span", { class: "value" }, key);
  }

  addBandKey(band, bar) {
    this.sample(make("span", { class: "key" }, bar), "rect", { width: 28, height: 10, ...this.shade(band) }, band.label);
  }

  /** What a curve or a band looks like, and what it is called. */
  sample(key, shape, looks, label) {
    draw(shape, looks, draw("svg", { viewBox: "0 0 28 10", "aria-hidden": "true" }, key));
    addLabel(make("span", {}, key), label);
  }

  shade(band) {
    return { fill: `var(--c${band.style})`, "fill-opacity": band.strength };
  }

  drawBand(band, parent) {
    const there = Array.from(band.x.keys()).filter((i) => [band.x[i], band.low[i], band.high[i]].every(Number.isFinite));
    const side = (values) => there.map((i) => this.pixel(band.x[i], values[i]).map(drawable).join(" "));
    const [up, down] = [side(band.high), side(band.low).reverse()];
    if (there.length > 1) draw("path", { ...this.shade(band), d: `M${[...up, ...down].join("L")}Z` }, parent);
  }

  stroke(series) {
    const style = { class: "curve", stroke: `var(--c${series.style})` };
    return series.dashes ? { ...style, "stroke-dasharray": series.dashes } : style;
  }

  toggle(series) {
    series.visible = !series.visible;
    series.key.setAttribute("aria-pressed", String(series.visible));
    this.draw();
  }

  reset() {
    const visible = this.series.filter((series) => series.visible);
    const range = (axis, k, padding) => axis.range ?? opened(bounds([...visible.map((s) => s[k]), ...this.edges(k)]), padding);
    this.window = [range(this.data.x, "x", this.xRange), range(this.data.y, "y", 0.06)];
    this.all.hidden = true;
    this.draw();
  }

  /** Coordinates of the edges of all bands. */
  edges(k) {
    return this.bands.flatMap((band) => (k === "x" ? [band.x] : [band.low, band.high]));
  }

  zoom(window) {
    const wide = window.every(([low, high]) => high - low > 1e-9 * Math.max(Math.abs(low), Math.abs(high), 1e-290));
    if (!wide) return;
    this.window = window;
    this.all.hidden = false;
    this.draw();
  }

  watch() {
    watchWidth(this.live, () => this.draw());
    this.svg.addEventListener("pointermove", (event) => this.move(event));
    this.svg.addEventListener("pointerdown", (event) => this.press(event));
    this.svg.addEventListener("pointerup", (event) => this.release(event));
    this.svg.addEventListener("pointercancel", () => this.drop());
    this.svg.addEventListener("dblclick", () => this.reset());
    this.svg.addEventListener("keydown", (event) => this.type(event));
    if (this.data.time) clock.listen(this, (time) => this.show(time));
  }

  get size() {
    const width = Math.max(this.live.clientWidth, 240);
    return [width, Math.max(clamp(0.52 * width, 230, 380), this.least ?? 0)];
  }

  /** Pixels of a point of the diagram. */
  pixel(x, y) {
    const [width, height] = this.size;
    const [[x0, x1], [y0, y1]] = this.window;
    const part = [(x - x0) / (x1 - x0), (y - y0) / (y1 - y0)];
    return [LEFT + part[0] * (width - LEFT - RIGHT), height - BELOW - part[1] * (height - TOP - BELOW)];
  }

  /** The point of the diagram under some pixels. */
  point(px, py) {
    const [width, height] = this.size;
    const [[x0, x1], [y0, y1]] = this.window;
    const part = [(px - LEFT) / (width - LEFT - RIGHT), (height - BELOW - py) / (height - TOP - BELOW)];
    return [x0 + part[0] * (x1 - x0), y0 + part[1] * (y1 - y0)];
  }

  draw() {
    const [width, height] = this.size;
    this.svg.replaceChildren();
    this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.svg.setAttribute("height", height);
    const least = this.drawTicks(width, height);
    if (least > height) {
      this.least = least;
      return this.draw();
    }
    const box = { x: LEFT, y: TOP, width: width - LEFT - RIGHT, height: height - TOP - BELOW };
    const view = `${box.x} ${box.y} ${box.width} ${box.height}`;
    const inside = draw("svg", { ...box, viewBox: view, style: `width:${box.width}px` }, this.svg);
    for (const { at } of this.data.marks) {
      const [x] = this.pixel(at, 0);
      draw("line", { class: "mark", x1: x, x2: x, y1: TOP, y2: height - BELOW }, inside);
    }
    for (const band of this.bands) this.drawBand(band, inside);
    for (const series of this.series) if (series.visible) this.drawCurve(series, inside);
    this.overlay = draw("g", {}, inside);
    draw("rect", { class: "frame", ...box }, this.svg);
    draw("rect", { class: "hit", ...box }, this.svg);
    if (this.cursor) this.show(this.cursor.x);
  }

  drawTicks(width, height) {
    const [xs, ys] = this.window;
    const [bottom, right] = [height - BELOW, width - RIGHT];
    for (const [value, text] of ticks(xs, (width - LEFT) / 90)) {
      const [x] = this.pixel(value, ys[0]);
      draw("line", { class: "grid", x1: x, x2: x, y1: TOP, y2: bottom }, this.svg);
      draw("text", { x, y: bottom + 17, "text-anchor": "middle" }, this.svg).textContent = text;
    }
    for (const [value, text] of ticks(ys, (height - BELOW) / 50)) {
      const [, y] = this.pixel(xs[0], value);
      draw("line", { class: "grid", x1: LEFT, x2: right, y1: y, y2: y }, this.svg);
      draw("text", { x: LEFT - 6, y: y + 5, "text-anchor": "end" }, this.svg).textContent = text;
    }
    const middle = [(LEFT + right) / 2, (TOP + bottom) / 2];
    drawLabel(this.svg, this.data.x.title, { class: "name", x: middle[0], y: height - 8, "text-anchor": "middle" });
    const name = drawLabel(this.svg, this.data.y.title, { class: "name", "text-anchor": "middle" });
    // Words that are longer than the frame is high stand in the middle of the picture, which is at least as high as they are long.
    const long = name.getComputedTextLength();
    name.setAttribute("transform", `translate(11 ${long > 2 * middle[1] ? height / 2 : middle[1]}) rotate(-90)`);
    return long + 8;
  }

  drawCurve(series, parent) {
    let path = "";
    let pen = false;
    for (let i = 0; i < series.x.length; i += 1) {
      const [x, y] = this.pixel(series.x[i], series.y[i]);
      if (Number.isFinite(x) && Number.isFinite(y)) {
        path += `${pen ? "L" : "M"}${drawable(x)} ${drawable(y)}`;
        pen = true;
      } else {
        pen = false;
      }
    }
    draw("path", { ...this.stroke(series), d: path }, parent);
    if (series.dotted) series.x.forEach((x, i) => this.drawDot(series, x, series.y[i], parent));
  }

  drawDot(series, x, y, parent) {
    const [cx, cy] = this.pixel(x, y);
    if (Number.isFinite(cy)) draw("circle", { cx, cy, r: 2.4, fill: `var(--c${series.style})` }, parent);
  }

  place(event) {
    return pointerIn(this.svg, event, this.size[0]);
  }

  move(event) {
    const at = this.place(event);
    if (this.start) {
      this.drawChoice(this.start, at);
    } else {
      this.hover(at);
    }
  }

  press(event) {
    if (event.button !== 0 || event.pointerType === "touch") return;
    this.start = this.place(event);
    this.svg.setPointerCapture(event.pointerId);
  }

  release(event) {
    if (!this.start) return;
    const [a, b] = [this.point(...this.start), this.point(...this.place(event))];
    const [from, to] = [this.start, this.place(event)];
    this.drop();
    const moved = [0, 1].map((k) => Math.abs(to[k] - from[k]) > 9);
    if (!moved[0] && !moved[1]) return;
    this.zoom([0, 1].map((k) => (moved[k] ? [Math.min(a[k], b[k]), Math.max(a[k], b[k])] : this.window[k])));
  }

  drop() {
    this.start = null;
    this.band?.remove();
  }

  drawChoice([x0, y0], [x1, y1]) {
    this.band?.remove();
    const [width, height] = this.size;
    const [wide, tall] = [Math.abs(x1 - x0) > 9, Math.abs(y1 - y0) > 9];
    const [left, right] = wide ? [Math.min(x0, x1), Math.max(x0, x1)] : [LEFT, width - RIGHT];
    const [top, bottom] = tall ? [Math.min(y0, y1), Math.max(y0, y1)] : [TOP, height - BELOW];
    const box = { x: left, y: top, width: right - left, height: bottom - top };
    this.band = draw("rect", { class: "band", ...box }, this.overlay);
  }

  /** The sample nearest to some pixels: along x where curves run forward. */
  nearest([px, py]) {
    let best = null;
    for (const series of this.series.filter((s) => s.visible))
      for (let i = 0; i < series.x.length; i += 1) {
        const [x, y] = this.pixel(series.x[i], series.y[i]);
        const distance = this.forward ? Math.abs(x - px) : Math.hypot(x - px, y - py);
        if (Number.isFinite(y) && (!best || distance < best.distance)) best = { series, i, distance };
      }
    return best;
  }

  hover(at) {
    const best = this.nearest(at);
    if (!best) return;
    const x = best.series.x[best.i];
    if (this.forward) {
      this.show(x);
    } else {
      this.showSample(best);
    }
    if (this.data.time) clock.set(x, this);
  }

  /** The value of a curve at x: a sample, or between two samples. */
  valueAt(series, x) {
    const last = series.x.length - 1;
    if (last < 0 || x < series.x[0] || x > series.x[last]) return null;
    const [low, high, part] = around(series.x, x);
    const near = Math.abs(series.x[high] - x) < Math.abs(series.x[low] - x) ? high : low;
    const tiny = 1e-6 * (series.x[last] - series.x[0]);
    if (Math.abs(series.x[near] - x) <= tiny) return { value: series.y[near], exact: true };
    return { value: series.y[low] + part * (series.y[high] - series.y[low]), exact: false };
  }

  /** Puts the cursor at x with the values of all curves. */
  show(x) {
    if (!this.forward || x === null) return;
    this.cursor = { x };
    this.overlay.replaceChildren();
    const height = this.size[1];
    const [px] = this.pixel(x, 0);
    draw("line", { class: "cursor", x1: px, x2: px, y1: TOP, y2: height - BELOW }, this.overlay);
    for (const series of this.series) {
      const found = series.visible ? this.valueAt(series, x) : null;
      this.showValue(series, found);
      if (found && Number.isFinite(found.value)) this.dot(series, x, found.value);
    }
    this.showAt(x);
  }

  showSample({ series, i }) {
    this.overlay.replaceChildren();
    for (const other of this.series) this.showValue(other, null);
    this.showValue(series, { value: series.y[i], exact: true });
    this.dot(series, series.x[i], series.y[i]);
    this.showAt(series.x[i]);
  }

  dot(series, x, y) {
    const [cx, cy] = this.pixel(x, y);
    draw("circle", { cx, cy, r: 3.5, fill: `var(--c${series.style})` }, this.overlay);
  }

  showValue(series, found) {
    const [low, high] = bounds([series.y]);
    const text = found ? (found.exact ? "" : "≈ ") + inRange(found.value, high - low, found.exact ? 6 : 4) : "";
    series.value.textContent = text;
    if (found) {
      series.value.append("\u00a0");
      addLabel(series.value, this.data.y.unit);
    }
  }

  showAt(x) {
    const [low, high] = bounds(this.series.map((series) => series.x));
    this.at.replaceChildren();
    addLabel(this.at, this.data.x.name);
    this.at.append(` = ${inRange(x, high - low)}\u00a0`);
    addLabel(this.at, this.data.x.unit);
  }

  type(event) {
    const act = {
      ArrowLeft: () => this.step(event.shiftKey ? -10 : -1),
      ArrowRight: () => this.step(event.shiftKey ? 10 : 1),
      Home: () => this.step(-Infinity),
      End: () => this.step(Infinity),
      "+": () => this.magnify(0.5),
      "-": () => this.magnify(2),
      Escape: () => this.reset(),
    }[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }

  /** Moves the cursor by samples of the first curve that is shown. */
  step(by) {
    const series = this.series.find((s) => s.visible && s.x.length);
    if (!series) return;
    const at = this.index ?? (this.cursor ? this.nearest(this.pixel(this.cursor.x, 0))?.i ?? 0 : 0);
    this.index = clamp(at + by, 0, series.x.length - 1);
    if (this.forward) this.show(series.x[this.index]);
    else this.showSample({ series, i: this.index });
    if (this.data.time) clock.set(series.x[this.index], this);
    this.heard.textContent = `${this.at.textContent}; ` + this.series.filter((s) => s.value.textContent)
      .map((s) => `${plain(s.label)} ${s.value.textContent}`).join("; ");
  }

  magnify(factor) {
    const [[x0, x1], ys] = this.window;
    const middle = this.cursor?.x ?? (x0 + x1) / 2;
    if (factor > 1 && this.all.hidden) return;
    this.zoom([[middle + (x0 - middle) * factor, middle + (x1 - middle) * factor], ys]);
  }
}
