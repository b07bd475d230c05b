//! Random numbers that are the same on every machine.

/// A stream of random numbers: SplitMix64 (Steele, Lea and Flood, Fast splittable pseudorandom number generators, 2014).
#[derive(Clone, Debug)]
pub(crate) struct Draw {
    state: u64,
}

/// Spacing of the stream's states, the golden ratio of 2^64.
const GAP: u64 = 0x9e37_79b9_7f4a_7c15;
/// Doubles between 0 and 1 are multiples of this: 2^-53.
const GRAIN: f64 = 1.0 / (1_u64 << 53) as f64;

impl Draw {
    /// The stream of one problem; problems with different numbers have nothing in common.
    pub(crate) fn of(seed: u64, family: u64, index: u64) -> Self {
        let mut draw = Self { state: seed };
        for part in [family, index] {
            draw.state = draw.next() ^ part.wrapping_mul(GAP);
        }
        draw
    }

    fn next(&mut self) -> u64 {
        self.state = self.state.wrapping_add(GAP);
        let mut mixed = self.state;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// Evenly from 0 to 1.
    pub(crate) fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 * GRAIN
    }

    /// Evenly between two numbers.
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Between two positive numbers, evenly in the logarithm.
    pub(crate) fn log_between(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.unit())
    }

    /// A whole number from `low` to `high`, both included.
    pub(crate) fn whole(&mut self, low: usize, high: usize) -> usize {
        low + (self.next() % (high - low + 1) as u64) as usize
    }

    /// True in this share of all draws.
    pub(crate) fn chance(&mut self, share: f64) -> bool {
        self.unit() < share
    }

    /// -1 or 1.
    pub(crate) fn sign(&mut self) -> f64 {
        if self.chance(0.5) { 1.0 } else { -1.0 }
    }

    /// One of several.
    pub(crate) fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.whole(0, from.len() - 1)]
    }

    /// The text of a decimal number near `size`, as people write them: few digits, and sometimes a round one.
    pub(crate) fn decimal(&mut self, size: f64) -> String {
        if size == 0.0 {
            return "0".to_owned();
        }
        let digits = if self.chance(0.2) { 0 } else { self.whole(1, 5) };
        let text = format!("{size:.digits$e}");
        let plain = (1e-3..1e4).contains(&size.abs()) && self.chance(0.7);
        if plain { text.parse::<f64>().map_or(text, |value| value.to_string()) } else { text }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streams_are_fixed_and_apart() {
        let first = |seed, family, index| Draw::of(seed, family, index).next();
        assert_eq!(first(1, 2, 3), first(1, 2, 3));
        let all = [first(1, 2, 3), first(2, 2, 3), first(1, 3, 3), first(1, 2, 4), first(1, 3, 2)];
        assert!((0..5).all(|one| (0..one).all(|other| all[one] != all[other])));
    }

    #[test]
    fn decimals_are_near_what_is_asked() {
        let mut draw = Draw::of(1, 0, 0);
        for size in [1.0, -0.037, 2.5e-9, 7.1e8] {
            for _ in 0..100 {
                let text = draw.decimal(size);
                let value: f64 = text.parse().expect("a number");
                assert!((value / size - 1.0).abs() < 0.5, "{text}");
                assert!(text.len() < 14, "{text}");
            }
        }
    }
}
