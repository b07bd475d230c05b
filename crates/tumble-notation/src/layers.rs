//! A product in the places that people write its factors in: above a line, below it, and behind.

use crate::layout::Math;

/// A product sorted by where its factors go.
#[derive(Default)]
pub(crate) struct Layers {
    /// Numbers, parameters and times above the line.
    pub(crate) above: Vec<Math>,
    /// Behind the fraction: bars, variables, functions, sums.
    pub(crate) behind: Vec<Math>,
    pub(crate) below: Vec<Math>,
    /// Behind the fraction there are functions or sums, not only letters.
    pub(crate) long: bool,
    /// Below the line there are only digits.
    pub(crate) digits_below: bool,
    /// The number's numerator, if it is not 1 and stands first above.
    pub(crate) numerator: bool,
}

impl Layers {
    pub(crate) fn joined(mut self) -> Math {
        if self.below.is_empty() {
            self.above.append(&mut self.behind);
            return Math::product(self.above);
        }
        // Two thirds of something stand before it; a third of it is it over three.
        if self.digits_below && self.numerator {
            let number = self.above.remove(0);
            let fraction = number.over(Math::product(self.below));
            let rest = self.above.into_iter().chain(self.behind);
            return Math::product(std::iter::once(fraction).chain(rest).collect());
        }
        let alone = self.above.is_empty();
        if self.below.iter().any(|math| matches!(math, Math::Brackets(_))) {
            self.above.append(&mut self.behind);
        }
        let up = !self.digits_below || !self.long;
        if (alone && up) || (self.digits_below && !self.long) {
            self.above.append(&mut self.behind);
        }
        let above = Math::product(self.above);
        let above = if alone { bare(above) } else { above };
        let fraction = above.over(bare(Math::product(self.below)));
        Math::product(std::iter::once(fraction).chain(self.behind).collect())
    }
}

/// What stands alone above or below a line needs no brackets.
fn bare(math: Math) -> Math {
    if let Math::Brackets(inside) = math { *inside } else { math }
}
