// Unpacks LZMA (the format of `.lzma` files), which is a quarter smaller than what browsers unpack themselves.

/** The bytes that are packed; the length has to stand in the header. */
function unlzma(input) {
  const [lc, lp, pb] = [input[0] % 9, Math.floor(input[0] / 9) % 5, Math.floor(input[0] / 45)];
  const out = new Uint8Array(new DataView(input.buffer, input.byteOffset).getUint32(5, true));
  let [range, code, from, at] = [0xffffffff, 0, 14, 0];
  for (let i = 0; i < 4; i += 1) code = ((code << 8) | input[from++]) >>> 0;

  const chances = (count) => new Uint16Array(count).fill(1024);
  const bit = (of, i) => {
    const bound = (range >>> 11) * of[i];
    let is = 0;
    if (code < bound) {
      range = bound;
      of[i] += (2048 - of[i]) >> 5;
    } else {
      range -= bound;
      code -= bound;
      of[i] -= of[i] >> 5;
      is = 1;
    }
    if (range < 0x1000000) {
      range = (range << 8) >>> 0;
      code = ((code << 8) | input[from++]) >>> 0;
    }
    return is;
  };
  /** So many bits without a model. */
  const direct = (count) => {
    let value = 0;
    for (let i = 0; i < count; i += 1) {
      range >>>= 1;
      const is = code >= range ? 1 : 0;
      if (is) code -= range;
      if (range < 0x1000000) {
        range = (range << 8) >>> 0;
        code = ((code << 8) | input[from++]) >>> 0;
      }
      value = value * 2 + is;
    }
    return value;
  };
  /** A number of so many bits, the highest first; its chances begin at `base`. */
  const tree = (of, base, bits) => {
    let m = 1;
    for (let i = 0; i < bits; i += 1) m = (m << 1) | bit(of, base + m);
    return m - (1 << bits);
  };
  const reversed = (of, base, bits) => {
    let [m, value] = [1, 0];
    for (let i = 0; i < bits; i += 1) {
      const is = bit(of, base + m);
      m = (m << 1) | is;
      value |= is << i;
    }
    return value;
  };

  const lengths = () => ({ choice: chances(2), low: chances(16 << 3), middle: chances(16 << 3), high: chances(256) });
  const length = ({ choice, low, middle, high }, position) => {
    if (!bit(choice, 0)) return tree(low, position << 3, 3);
    if (!bit(choice, 1)) return 8 + tree(middle, position << 3, 3);
    return 16 + tree(high, 0, 8);
  };
  const literals = chances(0x300 << (lc + lp));
  const [isMatch, isRep, isRep0, isRep1, isRep2, isLong] = [192, 12, 12, 12, 12, 192].map(chances);
  const [slots, near, aligned] = [256, 128, 16].map(chances);
  const [matches, repeats] = [lengths(), lengths()];

  const literal = (state, back) => {
    const before = at > 0 ? out[at - 1] : 0;
    const base = 0x300 * (((at & ((1 << lp) - 1)) << lc) + (before >> (8 - lc)));
    let symbol = 1;
    if (state >= 7) {
      for (let match = out[at - back - 1]; symbol < 0x100; ) {
        const guess = (match >> 7) & 1;
        match <<= 1;
        const is = bit(literals, base + ((1 + guess) << 8) + symbol);
        symbol = (symbol << 1) | is;
        if (guess !== is) break;
      }
    }
    while (symbol < 0x100) symbol = (symbol << 1) | bit(literals, base + symbol);
    out[at++] = symbol;
  };
  const distance = (size) => {
    const slot = tree(slots, Math.min(size, 3) << 6, 6);
    if (slot < 4) return slot;
    const bits = (slot >> 1) - 1;
    const base = (2 | (slot & 1)) * 2 ** bits;
    if (slot < 14) return base + reversed(near, base - slot, bits);
    return base + direct(bits - 4) * 16 + reversed(aligned, 0, 4);
  };

  let [state, back, back1, back2, back3] = [0, 0, 0, 0, 0];
  while (at < out.length) {
    const position = at & ((1 << pb) - 1);
    if (!bit(isMatch, (state << 4) + position)) {
      literal(state, back);
      state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
      continue;
    }
    let size;
    if (bit(isRep, state)) {
      if (!bit(isRep0, state)) {
        if (!bit(isLong, (state << 4) + position)) {
          state = state < 7 ? 9 : 11;
          out[at] = out[at - back - 1];
          at += 1;
          continue;
        }
      } else if (!bit(isRep1, state)) {
        [back, back1] = [back1, back];
      } else if (!bit(isRep2, state)) {
        [back, back1, back2] = [back2, back, back1];
      } else {
        [back, back1, back2, back3] = [back3, back, back1, back2];
      }
      size = length(repeats, position);
      state = state < 7 ? 8 : 11;
    } else {
      [back1, back2, back3] = [back, back1, back2];
      size = length(matches, position);
      state = state < 7 ? 7 : 10;
      back = distance(size);
    }
    for (const end = Math.min(at + size + 2, out.length); at < end; at += 1) out[at] = out[at - back - 1];
  }
  return out;
}
