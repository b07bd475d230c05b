//! The parts of a step that are looked at one by one, each halved until it is settled.

use smallvec::{SmallVec, smallvec};

use super::{Doubt, Unknown};

/// Parts shorter than this part of a step are not halved any more: the step is cut, and its successor has other coefficients.
const SMALLEST: f64 = 1.0 / 128.0;
/// Parts of one step that are looked at, at most.
const MOST_PARTS: usize = 96;
/// Where a part is cut in two: not in the middle, which round numbers have their zeros at.
const CUT: f64 = 0.487_139;

/// How often the last step had to be halved until the first of its parts was settled: the next is begun with such parts.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Halvings {
    needed: u32,
    /// Steps since larger parts were last tried.
    since: u32,
}

impl Halvings {
    /// One step in so many is begun with parts of twice the length, in case they would do again.
    const PATIENCE: u32 = 8;

    fn begin(&mut self) -> u32 {
        self.since = (self.since + 1) % Self::PATIENCE;
        if self.since == 0 { self.needed.saturating_sub(1) } else { self.needed }
    }
}

/// Both parts of a part, the later one first.
pub(super) fn halves([low, high]: [f64; 2]) -> [[f64; 2]; 2] {
    let middle = low + CUT * (high - low);
    [[middle, high], [low, middle]]
}

/// The end of what is settled of a length, from its beginning on; `None` if all of it is. `unsettled` says what is not known of
/// a part.
pub(super) fn first_unsettled(
    length: f64,
    halvings: &mut Halvings,
    mut unsettled: impl FnMut([f64; 2]) -> Option<Doubt>,
) -> Option<Unknown> {
    let begin = halvings.begin();
    let mut pending: SmallVec<[_; 16]> = smallvec![([0.0, length], 0)];
    let (mut looked, mut needed) = (0, u32::MAX);
    while let Some((part, depth)) = pending.pop() {
        if depth < begin {
            pending.extend(halves(part).map(|half| (half, depth + 1)));
            continue;
        }
        looked += 1;
        let Some(of) = unsettled(part) else {
            needed = needed.min(depth);
            continue;
        };
        let [low, high] = part;
        if high - low <= SMALLEST * length || looked >= MOST_PARTS {
            return Some(Unknown { length: if low > 0.0 { low } else { high }, of });
        }
        pending.extend(halves(part).map(|half| (half, depth + 1)));
    }
    halvings.needed = needed;
    None
}
