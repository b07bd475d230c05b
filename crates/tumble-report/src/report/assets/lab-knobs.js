// A slider and an exact field for each value that may be changed.

/** Steps of a slider. */
const KNOB_STEPS = 1000;
/** Digits of a value that a slider or a drag sets. */
const KNOB_DIGITS = 4;

/** One value that may be changed: its slider, its field, and where it is. */
class Control {
  constructor(knob, parent, changed) {
    Object.assign(this, { knob, changed, number: knob.value });
    const row = make("div", { class: "knob" }, parent);
    const id = `knob-${knob.name}`;
    addLabel(make("label", { for: id, title: knob.name }, row), knob.label);
    this.slider = make("input", { type: "range", min: 0, max: KNOB_STEPS, step: "any", "aria-label": plain(knob.label) }, row);
    this.field = make("input", { type: "text", id, size: 10, spellcheck: "false", autocomplete: "off" }, row);
    this.slider.addEventListener("input", () => this.slide());
    this.field.addEventListener("change", () => this.changed(this, this.field.value.trim()));
    this.take(knob);
  }

  /** Shows a value that the engine has read. */
  take({ text, value, size }) {
    this.number = (value * size) / this.knob.size;
    this.write(text);
    this.field.removeAttribute("aria-invalid");
    this.place();
  }

  /** Where the field is too narrow for all of a text, a pointer on it shows the rest. */
  write(text) {
    this.field.value = this.field.title = text;
    this.slider.setAttribute("aria-valuetext", text);
  }

  /** Shows a number of its unit. */
  writeNumber(number) {
    this.number = number;
    const rounded = Number(number.toPrecision(12));
    this.write(this.knob.unit ? `${rounded} ${this.knob.unit}` : String(rounded));
  }

  /** Shows the value of one run, in its unit: of what is swept. */
  show(number) {
    this.writeNumber(number);
    this.place();
  }

  place() {
    if (document.activeElement !== this.slider) this.slider.value = KNOB_STEPS * this.part(this.number);
  }

  part(number) {
    const [low, high] = this.knob.range;
    const part = this.knob.log ? Math.log(number / low) / Math.log(high / low) : (number - low) / (high - low);
    return clamp(part, 0, 1) || 0;
  }

  slide() {
    const [low, high] = this.knob.range;
    const part = this.slider.value / KNOB_STEPS;
    this.put(this.knob.log ? low * (high / low) ** part : low + (high - low) * part);
  }

  /** Sets a number of its unit, as few digits of it as its range needs. */
  put(number) {
    const step = this.span() / 10 ** KNOB_DIGITS;
    const places = Math.max(0, Math.ceil(-Math.log10(step)));
    const rounded = this.knob.log ? number.toPrecision(KNOB_DIGITS) : number.toFixed(Math.min(places, 20));
    this.writeNumber(Number(rounded));
    this.changed(this, this.field.value);
  }

  span() {
    return Math.abs(this.knob.range[1] - this.knob.range[0]);
  }
}

/** A control as something that is dragged: in SI units. */
class Grip {
  constructor(control) {
    this.control = control;
  }

  value() {
    return this.control.number * this.control.knob.size;
  }

  span() {
    return this.control.span() * this.control.knob.size;
  }

  text() {
    return this.control.field.value;
  }

  put(value) {
    this.control.put(value / this.control.knob.size);
  }
}
