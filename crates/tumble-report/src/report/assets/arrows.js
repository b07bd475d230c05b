// Arrows of forces in a motion.

const HEAD = 10;
/** Peaks that differ more than this are drawn by the roots of their sizes. */
const UNLIKE = 15;

/** How long arrows are: `longest` pixels for the largest force of all cases. */
class ArrowScale {
  constructor(cases, longest) {
    const size = (force) => Math.max(0, ...force.fx.map((x, i) => Math.hypot(x, force.fy[i])).filter(Number.isFinite));
    const peaks = cases.flatMap((motion) => motion.forces.map(size)).filter((peak) => peak > 0);
    this.largest = Math.max(0, ...peaks);
    this.root = peaks.length > 0 && this.largest > UNLIKE * Math.min(...peaks);
    this.longest = longest;
  }

  length(force) {
    const part = force / this.largest;
    return this.longest * (this.root ? Math.sqrt(part) : part);
  }

  /** What the lengths mean, in words. */
  words() {
    const how = this.root ? "lengths go with the square root of the force" : "lengths are to scale";
    return `Longest arrow ${shown(this.largest, 3)} N; ${how}.`;
  }
}

/** Draws an arrow of a force from its point of action (pixels). */
function drawArrow(parent, force, [x, y], [fx, fy], scale) {
  const size = Math.hypot(fx, fy);
  const length = scale.length(size);
  if (!(length > 1)) return;
  const [ux, uy] = [fx / size, -fy / size];
  const tip = [x + length * ux, y + length * uy];
  const colour = `var(--${force.kind})`;
  const shaft = { stroke: colour, "stroke-width": force.thickness };
  if (force.dashes) shaft["stroke-dasharray"] = force.dashes;
  drawTip(parent, [x, y], tip, shaft, HEAD);
  const place = { x: tip[0] + 12 * ux, y: tip[1] + 12 * uy + 5, "text-anchor": "middle", class: "halo" };
  drawLabel(parent, force.symbol, place).style.fill = colour;
}
