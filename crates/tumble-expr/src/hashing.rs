//! Hash maps for keys that nobody chooses: addresses of formulas, nodes and operations.
//!
//! Equations are built by looking up every part of every formula, so the default hasher, which resists keys chosen to
//! collide, takes a good part of the time. These keys are addresses and indices given out in order, which need no such
//! care. Nothing may depend on the order of iteration.

use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

/// A map with a fast hasher.
pub type FastMap<Key, Value> = HashMap<Key, Value, BuildHasherDefault<Mixer>>;

/// An odd number with no pattern in its bits: the golden ratio's fraction.
const FACTOR: u64 = 0x9e37_79b9_7f4a_7c15;

/// Mixes words by multiplication; the high half, folded down, makes up for the weak low bits of a product.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mixer(u64);

impl Mixer {
    fn mix(&mut self, word: u64) {
        let product = u128::from((self.0.rotate_left(5) ^ word).wrapping_add(FACTOR)) * u128::from(FACTOR);
        self.0 = (product as u64) ^ ((product >> 64) as u64);
    }
}

impl Hasher for Mixer {
    fn write(&mut self, bytes: &[u8]) {
        for chunk in bytes.chunks(8) {
            let mut word = [0; 8];
            word[..chunk.len()].copy_from_slice(chunk);
            self.mix(u64::from_le_bytes(word));
        }
    }

    fn write_u8(&mut self, value: u8) {
        self.mix(value.into());
    }

    fn write_u32(&mut self, value: u32) {
        self.mix(value.into());
    }

    fn write_u64(&mut self, value: u64) {
        self.mix(value);
    }

    fn write_usize(&mut self, value: usize) {
        self.mix(value as u64);
    }

    fn finish(&self) -> u64 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    /// Buckets are chosen by the low bits, and compared by the highest seven first.
    #[test]
    fn addresses_spread_over_buckets() {
        const KEYS: u64 = 1 << 12;
        for step in [1, 8, 16, 64, 4096, 1 << 20] {
            let hash = |index: u64| {
                let mut mixer = Mixer::default();
                mixer.write_u64(0x7f00_0000_0000 + index * step);
                mixer.finish()
            };
            let low: HashSet<u64> = (0..KEYS).map(|index| hash(index) % KEYS).collect();
            let high: HashSet<u64> = (0..KEYS).map(|index| hash(index) >> 57).collect();
            // Keys thrown at random fill 1 - 1/e of as many buckets.
            assert!(low.len() as u64 > KEYS / 2, "step {step}: {} buckets", low.len());
            assert_eq!(high.len(), 128, "step {step}");
        }
    }
}
