// Names of points and bodies in a motion: beside what they name, on nothing else that is there.

/** More bodies than this are not named in the picture. */
const MOST_NAMED = 8;
/** How far names stand from what they name, nearest first, and in which directions, in pixels. */
const AWAY = [10, 18, 28, 40];
const AROUND = [[1, -1], [-1, -1], [1, 0], [-1, 0], [0, -1], [1, 1], [-1, 1], [0, 1]];
/** Distance between points of outlines that names keep clear of. */
const APART = 6;
/** About how wide a letter of a name is, in pixels, and how high a line is. */
const [LETTER, LINE] = [7, 15];

/** Points along a closed line. */
function along(corners) {
  return corners.flatMap(([x, y], i) => {
    const [u, v] = corners[(i + 1) % corners.length];
    const steps = Math.max(1, Math.ceil(Math.hypot(u - x, v - y) / APART));
    return Array.from({ length: steps }, (_, k) => [x + ((u - x) * k) / steps, y + ((v - y) * k) / steps]);
  });
}

/** Points of an outline, in pixels from the centre of its body. */
function rim([kind, ...n], scale) {
  const turns = Array.from({ length: 12 }, (_, i) => (i * Math.PI) / 6);
  const corners = kind === "circle" ? turns.map((turn) => [n[0] + n[2] * Math.cos(turn), n[1] + n[2] * Math.sin(turn)])
    : Array.from({ length: n.length / 2 }, (_, i) => [n[2 * i], n[2 * i + 1]]);
  return along(corners.map(([x, y]) => [x * scale, y * scale]));
}

const widthOf = (name) => LETTER * plain(name).length;

/** Names of one picture, `width` by `height` pixels. Some of it is taken, and has dots on it that names keep clear of. */
class NameBoard {
  constructor(layer, [width, height]) {
    Object.assign(this, { layer, width, height, taken: [], dots: [] });
  }

  /** Has names keep clear of these points. */
  keep(...points) {
    this.dots.push(...points.filter(([x, y]) => x > 0 && y > 0 && x < this.width && y < this.height));
  }

  /** Takes the first of some places where nothing is, else the first of those within the picture. */
  take(places) {
    const isIn = ({ left, at, wide }) => left >= 0 && left + wide <= this.width && at <= this.height - 3;
    const found = places.find((place) => this.isEmpty(place, this.dots)) ?? places.find(isIn) ?? places[0];
    this.taken.push(found);
    return found;
  }

  /** A name that stays where it is, at the best of some places. */
  write(parent, name, places) {
    const { left, at, wide } = this.take(places);
    drawLabel(parent, name, { x: left + wide / 2, y: at, "text-anchor": "middle", class: "halo" });
  }

  /** A name that has no place yet. */
  add(name) {
    return { wide: widthOf(name), text: drawLabel(this.layer, name, { class: "halo" }), place: 0 };
  }

  /** The places about a point, each as the left end and the height of the line that letters stand on. */
  places([x, y], wide) {
    return AWAY.flatMap((away) => AROUND.map(([dx, dy]) => ({
      left: x + dx * away + (wide * (dx - 1)) / 2,
      at: y + dy * away + (LINE * (dy + 1)) / 2 - (dy ? 0 : 3),
      wide,
    })));
  }

  /** Whether a name is alone there, and nearer to what it names than to anything else that has a name. */
  isFree(place, dots, own, others) {
    const away = ([x, y]) => Math.hypot(place.left + place.wide / 2 - x, place.at - LINE / 3 - y);
    return !others.some((other) => away(other) < away(own)) && this.isEmpty(place, dots);
  }

  /** Whether nothing is there. */
  isEmpty({ left, at, wide }, dots) {
    const isIn = left > 2 && left + wide < this.width - 2 && at > LINE && at < this.height - 4;
    const isBeside = (other) => Math.abs(other.at - at) >= LINE || left >= other.left + other.wide || other.left >= left + wide;
    const isClear = ([x, y]) => x < left - 2 || x > left + wide + 2 || y < at - LINE || y > at + 4;
    return isIn && this.taken.every(isBeside) && dots.every(isClear);
  }

  /** Puts names beside their points. One stays on its side while it can; where there is no room it is left out. */
  put(names, moving) {
    const [taken, dots] = [this.taken, [...this.dots, ...moving]];
    const others = names.map(({ at }) => at);
    this.taken = [...taken];
    for (const { name, at } of names) {
      const places = this.places(at, name.wide);
      const isFree = (i) => at.every(Number.isFinite) && this.isFree(places[i], dots, at, others);
      const found = [name.place, ...places.keys()].find(isFree);
      name.text.style.display = found === undefined ? "none" : "";
      if (found === undefined) continue;
      name.place = found;
      this.taken.push(places[found]);
      name.text.setAttribute("x", places[found].left.toFixed(1));
      name.text.setAttribute("y", places[found].at.toFixed(1));
    }
    this.taken = taken;
  }
}
