// Shapes of bodies, and the springs and dampers between them.

/** Draws an outline about the centre of its body, in pixels. */
function drawOutline(group, kind, n) {
  if (kind === "rod") {
    const width = clamp(0.025 * Math.hypot(n[2] - n[0], n[3] - n[1]), 3, 9);
    draw("line", { class: "rod", x1: n[0], y1: -n[1], x2: n[2], y2: -n[3], "stroke-width": width }, group);
  } else if (kind === "cord") {
    draw("line", { x1: n[0], y1: -n[1], x2: n[2], y2: -n[3], "stroke-width": 1 }, group);
  } else if (kind === "circle" || kind === "ring") {
    draw("circle", { class: kind === "ring" ? "ring" : "face", cx: n[0], cy: -n[1], r: n[2] }, group);
    draw("line", { x1: n[0], y1: -n[1], x2: n[0] + n[2], y2: -n[1], "stroke-width": 1.6 }, group);
  } else if (kind === "polygon") {
    const points = n.map((v, i) => (i % 2 ? -v : v)).join(" ");
    draw("polygon", { class: "face", points, "stroke-linejoin": "round" }, group);
  } else {
    draw("circle", { cx: n[0], cy: -n[1], r: 4 }, group);
  }
}

/** A group with the outlines of a body, as it lies at angle zero about the origin. */
function drawShape(body, scale, style, parent) {
  const group = draw("g", { class: "body", style }, parent);
  for (const [kind, ...n] of body.outlines) drawOutline(group, kind, n.map((v) => v * scale));
  return group;
}

/** Puts a shape where its body is. */
function pose(group, [x, y], angle) {
  group.setAttribute("transform", `translate(${x.toFixed(2)} ${y.toFixed(2)}) rotate(${((-angle * 180) / Math.PI).toFixed(2)})`);
}

/** A spring or a damper between two places. */
function drawLink(parent, kind, a, b) {
  if (![...a, ...b].every(Number.isFinite)) return;
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const length = Math.hypot(dx, dy) || 1;
  const at = (s, side) => [a[0] + dx * s - (dy / length) * side, a[1] + dy * s + (dx / length) * side];
  const zigzag = [0.1, ...Array.from({ length: 10 }, (_, i) => 0.14 + 0.08 * i), 0.9];
  const points = {
    spring: [a, ...zigzag.map((s, i) => at(s, i === 0 || i === 11 ? 0 : i % 2 ? 6 : -6)), b],
    damper: [a, at(0.35, 0), at(0.35, 6), at(0.65, 6), at(0.35, 6), at(0.35, -6), at(0.65, -6), at(0.35, -6), at(0.35, 0),
      at(0.55, 0), at(0.55, 5), at(0.55, -5), at(0.55, 0), b],
  }[kind];
  draw("polyline", { class: "link", points: points.join(" ") }, parent);
}
