// What a motion stands on: surfaces with their hatching and their names, and the scale.

const HATCH = 8;
/** Pixels above the motion that are kept for the scale. */
const STRIP = 30;
/** Where along a surface its name may stand, best first, in parts of the picture from its middle: below the hatching, and above the
 *  surface, where it covers least at the side. */
const BELOW_GROUND = [0, 0.25, -0.25, 0.4, -0.4];
const ABOVE_GROUND = [0.45, -0.45, 0.25, -0.25, 0];

/** Draws what does not move of a player's picture. Names stand on no other surface, and the scale on none where there is room. */
class Ground {
  constructor(player, surfaces) {
    const { svg, board, size, scale } = player;
    Object.assign(this, { svg, board, size, scale, pixel: (x, y) => player.pixel(x, y) });
    const places = surfaces.map((surface) => (surface.round ? this.drawCircle(surface) : this.drawLine(surface)));
    this.drawScaleBar();
    surfaces.forEach(({ name }, i) => places[i].length && this.board.write(this.svg, name, places[i]));
  }

  /** A circle of material, or a hollow in it: where its name may stand. */
  drawCircle({ at: [x, y], name, round: [radius, hollow] }) {
    const [px, py] = this.pixel(x, y);
    const size = radius * this.scale;
    const [depth, count] = [hollow ? HATCH : -HATCH, Math.max(12, Math.round((2 * Math.PI * size) / HATCH))];
    const at = (turn, r) => [px + r * Math.cos(turn), py + r * Math.sin(turn)];
    const step = (2 * Math.PI) / count;
    let strokes = "";
    for (let i = 0; i < count; i += 1) {
      const ends = [at(i * step, size), at((i - 1) * step, size + depth)];
      strokes += `M${ends[0]}L${ends[1]}`;
      this.board.keep(...ends);
    }
    draw("path", { class: "hatch", d: strokes }, this.svg);
    draw("circle", { class: "ground", cx: px, cy: py, r: size }, this.svg);
    const wide = widthOf(name);
    // In the material, below a hollow and below the top of what is full; else on the other side of the line.
    const lines = hollow ? [size + 26, size - 10] : [26 - size, 5, -10 - size];
    return lines.map((line) => ({ left: px - wide / 2, at: py + line, wide }));
  }

  /** A straight surface: where its name may stand. With a reach it ends there to both sides, as the edge of a polygon does. */
  drawLine({ at: [x, y, nx, ny, ends], name }) {
    const size = Math.hypot(nx, ny);
    const [ux, uy] = [nx / size, -ny / size];
    const [px, py] = this.pixel(x, y);
    const middle = [this.size[0] / 2 - px, this.size[1] / 2 - py];
    const along = ends === undefined ? -uy * middle[0] + ux * middle[1] : 0;
    const foot = [px - uy * along, py + ux * along];
    const reach = ends === undefined ? Math.hypot(...this.size) : ends * this.scale;
    const at = (s, depth) => [foot[0] - uy * s - ux * depth, foot[1] + ux * s - uy * depth];
    let strokes = "";
    for (let s = -reach; s < reach; s += HATCH) strokes += `M${at(s, 0)}L${at(s - HATCH, HATCH)}`;
    draw("path", { class: "hatch", d: strokes }, this.svg);
    draw("path", { class: "ground", d: `M${at(-reach, 0)}L${at(reach, 0)}` }, this.svg);
    for (let s = -reach; s < reach; s += APART) this.board.keep(at(s, 0), at(s, HATCH));
    const isSeen = foot.every((value, k) => value >= 0 && value <= this.size[k]);
    return isSeen ? this.placesAlong(at, [ux, uy], widthOf(name), reach) : [];
  }

  /** Places for a name beside a wall, else below the hatching of a surface or above it; `at(s, depth)` is a point by it. */
  placesAlong(at, [ux, uy], wide, reach) {
    const isWall = Math.abs(ux) > Math.abs(uy);
    const extent = Math.min(this.size[isWall ? 1 : 0], 2 * reach);
    const place = (part, depth) => {
      const [x, y] = at(part * extent, depth);
      if (isWall) return { left: ux * depth < 0 ? x : x - wide, at: y + 5, wide };
      const left = x - wide / 2;
      // Along level ground it may as well stand at the side of the picture.
      return { left: Math.abs(ux) < 0.1 ? clamp(left, 8, this.size[0] - 8 - wide) : left, at: y + 5, wide };
    };
    const [below, above] = isWall ? [[HATCH + 6], [-6]] : [[22, 30], [-12, -20]];
    const places = (parts, depths) => parts.flatMap((part) => depths.map((depth) => place(part, depth)));
    return [...places(BELOW_GROUND, below), ...places(isWall ? BELOW_GROUND : ABOVE_GROUND, above)];
  }

  drawScaleBar() {
    const most = 0.25 * this.size[0] / this.scale;
    const power = 10 ** Math.floor(Math.log10(most));
    const metres = [5, 2, 1].find((m) => m * power <= most) * power;
    const [length, wide] = [metres * this.scale, metres * this.scale + 16];
    const sides = [4, this.size[0] - 4 - wide, (this.size[0] - wide) / 2];
    const { left } = this.board.take(sides.map((side) => ({ left: side, at: STRIP, wide })));
    const [x, y] = [left + 8, 28];
    draw("rect", { class: "behind", x: left, y: 4, width: wide, height: STRIP }, this.svg);
    draw("path", { class: "link", d: `M${x} ${y - 4}v8m0 -4h${length}m0 -4v8` }, this.svg);
    draw("text", { x: x + length / 2, y: y - 6, "text-anchor": "middle", class: "halo" }, this.svg).textContent =
      `${shown(metres, 3)}\u00a0m`;
  }
}
