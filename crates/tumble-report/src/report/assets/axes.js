// Ranges of numbers and the ticks on them.

/** Places and texts of ticks over a range `[low, high]` for about `wanted` of them, at round steps; one alone would be no scale. */
function ticks(range, wanted) {
  const found = ticksAbout(range, wanted);
  return found.length > 1 || wanted > 8 ? found : ticks(range, wanted + 1);
}

function ticksAbout([low, high], wanted) {
  const least = (high - low) / Math.max(wanted, 1);
  const power = 10 ** Math.floor(Math.log10(least));
  const step = power * ([1, 2, 5].find((m) => m * power >= least * 0.999) ?? 10);
  const result = [];
  for (let n = Math.ceil(low / step - 1e-9); n * step <= high + 1e-9 * step && result.length < 60; n += 1) {
    const size = Math.max(Math.abs(low), Math.abs(high));
    const digits = Math.max(1, Math.floor(Math.log10(size)) - Math.floor(Math.log10(step) + 1e-9) + 2);
    result.push([n * step, shown(n === 0 ? 0 : n * step, digits)]);
  }
  return result;
}

/** Bounds of numbers; gaps do not count. */
function bounds(lists) {
  let [low, high] = [Infinity, -Infinity];
  for (const list of lists)
    for (const value of list) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
  return low <= high ? [low, high] : [0, 1];
}

/** A range with something in it. */
function opened([low, high], padding) {
  const size = Math.max(Math.abs(low), Math.abs(high));
  if (high - low <= 1e-12 * size || high === low) {
    const by = size > 0 ? 0.1 * size : 1;
    return [low - by, high + by];
  }
  return [low - padding * (high - low), high + padding * (high - low)];
}

/** A coordinate as paths have it; what is far outside stays there. */
const drawable = (pixels) => clamp(pixels, -1e5, 1e5).toFixed(1);
