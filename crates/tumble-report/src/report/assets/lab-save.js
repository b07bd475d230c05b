// What can be taken away: the scene with the values of its sliders, tables, the picture, an address.

/** A file for the reader. */
function save(name, type, content) {
  const address = URL.createObjectURL(new Blob([content], { type }));
  make("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}

/** Where a start value stands in `start = { .. }`: its key, and its place in a list. */
const STARTS = { x: ["at", 0], y: ["at", 1], vx: ["velocity", 0], vy: ["velocity", 1], angle: ["angle"], omega: ["omega"] };

/** The scene with values in the place of its own; those whose place is not plain come back as `left`. */
function written(scene, set) {
  const lines = scene.split("\n");
  const left = [];
  for (const [name, text] of set) if (!write(lines, name, text)) left.push([name, text]);
  return { scene: lines.join("\n"), left };
}

function write(lines, name, text) {
  const start = /^(.+)\.start\.(\w+)$/.exec(name);
  const title = start ? `[body.${start[1]}]` : "[parameters]";
  const key = start ? "start" : name;
  const head = lines.findIndex((line) => line.split("#")[0].trim() === title);
  if (head < 0) return false;
  const length = lines.slice(head + 1).findIndex((line) => /^\s*\[/.test(line));
  const last = length < 0 ? lines.length : head + 1 + length;
  const is = (line) => new RegExp(`^\\s*${key}\\s*=`).test(line);
  const at = lines.findIndex((line, i) => i > head && i < last && is(line));
  if (at < 0) return false;
  const value = JSON.stringify(text);
  const fresh = start ? inStart(lines[at], STARTS[start[2]], value) : inLine(lines[at], value);
  if (fresh === null) return false;
  lines[at] = fresh;
  return true;
}

const VALUE = `"(?:[^"\\\\]|\\\\.)*"|[-+\\w.]+`;

function inLine(line, value) {
  const match = new RegExp(`^(\\s*[\\w-]+\\s*=\\s*)(?:${VALUE})(\\s*(?:#.*)?)$`).exec(line);
  return match && `${match[1]}${value}${match[2]}`;
}

function inStart(line, place, value) {
  if (!place) return null;
  const [key, index] = place;
  const before = index === undefined ? "" : `\\[\\s*${index ? `(?:${VALUE})\\s*,\\s*` : ""}`;
  const match = new RegExp(`^(.*[{,]\\s*${key}\\s*=\\s*${before})(?:${VALUE})(.*)$`).exec(line);
  return match && `${match[1]}${value}${match[2]}`;
}

/** The look of a picture, which stands in the style sheet of the page and has to go with it. */
const LOOKS = ["fill", "fill-opacity", "stroke", "stroke-width", "stroke-dasharray", "stroke-linejoin", "stroke-linecap", "opacity", "font-size", "font-family", "font-style", "font-weight", "text-anchor", "paint-order"];

/** A picture of its own. */
function pictureOf(svg) {
  const { width, height } = svg.getBoundingClientRect();
  const copy = svg.cloneNode(true);
  const [from, to] = [svg, copy].map((one) => [one, ...one.querySelectorAll("*")]);
  from.forEach((one, i) => {
    const looks = getComputedStyle(one);
    for (const look of LOOKS) to[i].style.setProperty(look, looks.getPropertyValue(look));
    if (looks.display === "none") to[i].style.display = "none";
  });
  copy.querySelectorAll(".grip").forEach((one) => one.remove());
  const paper = getComputedStyle(document.body).backgroundColor;
  for (const [key, value] of Object.entries({ xmlns: SVG, width, height })) copy.setAttribute(key, value);
  copy.prepend(draw("rect", { width: "100%", height: "100%", fill: paper }));
  return { text: new XMLSerializer().serializeToString(copy), width, height };
}

/** The same as dots, two to a pixel. */
async function dotsOf({ text, width, height }) {
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(text)}`;
  await image.decode();
  const canvas = make("canvas", { width: 2 * width, height: 2 * height });
  canvas.getContext("2d").drawImage(image, 0, 0, 2 * width, 2 * height);
  return new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
}

/** Signatures of a ZIP archive: a file in it, its entry in the list, the end of the list. */
const [ZIP_FILE, ZIP_ENTRY, ZIP_END] = [0x04034b50, 0x02014b50, 0x06054b50];
/** Its version 2.0, names in UTF-8, deflated, no time of day, and the first of January 1980. */
const ZIP_WAY = [20, 0x800, 8, 0, 0x21];

/** Files, as names and texts, in one archive. */
async function zipped(files) {
  const [parts, list, encoder] = [[], [], new TextEncoder()];
  let at = 0;
  for (const [path, text] of files) {
    const [name, bytes] = [encoder.encode(path), encoder.encode(text)];
    const packed = await through(new CompressionStream("deflate-raw"), bytes);
    const about = [...ZIP_WAY.map((n) => [2, n]), [4, checksum(bytes)], [4, packed.length], [4, bytes.length], [2, name.length], [2, 0]];
    list.push(numbered([[4, ZIP_ENTRY], [2, 20], ...about, [2, 0], [2, 0], [2, 0], [4, 0], [4, at]]), name);
    const head = numbered([[4, ZIP_FILE], ...about]);
    parts.push(head, name, packed);
    at += head.length + name.length + packed.length;
  }
  const length = list.reduce((sum, part) => sum + part.length, 0);
  const end = numbered([[4, ZIP_END], [2, 0], [2, 0], [2, files.length], [2, files.length], [4, length], [4, at], [2, 0]]);
  return new Blob([...parts, ...list, end]);
}

/** Numbers of so many bytes each, the lowest first. */
const numbered = (fields) => Uint8Array.from(fields.flatMap(([size, n]) => Array.from({ length: size }, (_, i) => (n >>> (8 * i)) & 255)));

/** CRC-32, which archives are checked by. */
function checksum(bytes) {
  const table = Uint32Array.from({ length: 256 }, (_, n) => {
    for (let i = 0; i < 8; i += 1) n = n & 1 ? (n >>> 1) ^ 0xedb88320 : n >>> 1;
    return n;
  });
  return (bytes.reduce((crc, byte) => (crc >>> 8) ^ table[(crc ^ byte) & 255], 0xffffffff) ^ 0xffffffff) >>> 0;
}
