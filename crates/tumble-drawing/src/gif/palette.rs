//! The 256 colours of an animation.

use std::collections::HashMap;

/// Colours that a GIF can hold.
const MOST: usize = 256;

type Colour = [u8; 3];

/// The most frequent colours; others become the nearest of them.
pub(super) struct Palette {
    colours: Vec<Colour>,
    known: HashMap<Colour, u8>,
}

impl Palette {
    /// A palette from colours with how often they occur.
    pub(super) fn new(counts: &HashMap<Colour, usize>) -> Self {
        let mut sorted: Vec<_> = counts.iter().map(|(colour, count)| (*count, *colour)).collect();
        // Equal counts in the order of the colours: equal input gives equal bytes.
        sorted.sort_unstable_by(|a, b| b.cmp(a));
        let colours: Vec<_> = sorted.into_iter().map(|(_, colour)| colour).take(MOST).collect();
        Self { colours, known: HashMap::new() }
    }

    /// Red, green and blue of every colour.
    pub(super) fn bytes(&self) -> Vec<u8> {
        self.colours.concat()
    }

    /// The colours of opaque pixels (four bytes each) by their numbers.
    pub(super) fn indices(&mut self, pixels: &[u8]) -> Vec<u8> {
        pixels.chunks_exact(4).map(|p| self.index([p[0], p[1], p[2]])).collect()
    }

    fn index(&mut self, colour: Colour) -> u8 {
        let nearest = || {
            let distances = self.colours.iter().map(|other| distance(*other, colour)).enumerate();
            distances.min_by_key(|(_, distance)| *distance).map_or(0, |(i, _)| i as u8)
        };
        *self.known.entry(colour).or_insert_with(nearest)
    }
}

fn distance(a: Colour, b: Colour) -> i32 {
    (0..3).map(|k| (i32::from(a[k]) - i32::from(b[k])).pow(2)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frequent_colours_stay_and_rare_ones_become_near_ones() {
        let mut counts: HashMap<Colour, usize> = (0..=255).map(|i| ([i, 0, 0], 10)).collect();
        counts.insert([0, 0, 200], 500);
        counts.insert([3, 1, 0], 1);
        let mut palette = Palette::new(&counts);
        assert_eq!(palette.bytes()[..3], [0, 0, 200]);
        let index = palette.index([3, 1, 0]);
        assert_eq!(palette.colours[usize::from(index)], [3, 0, 0]);
    }
}
