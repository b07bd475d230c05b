//! The numbers of an island's contacts along their surfaces at an instant.

use std::collections::HashMap;

use nalgebra::DVector;

use crate::link::{Measured, Slipping};

/// While a contact slips, friction may take this part of what a push at it would move, and no more: where it comes to take all, no
/// force holds the body up. Closer to that the force has grown a million times.
pub(crate) const WEDGED: f64 = 1e-6;

/// Contacts with friction, by their order among an island's own.
pub(crate) struct Slips {
    /// Position of each among the island's pairs.
    pub(crate) of: Vec<usize>,
    /// Index of each among all pairs: of the pair, or of what stands for its rolling resistance.
    pub(crate) pairs: Vec<usize>,
    /// Whether it is that.
    pub(crate) rolls: Vec<bool>,
    /// m/s
    pub(crate) rate: DVector<f64>,
    /// Rounding in a rate is relative to this, m/s.
    pub(crate) speed: DVector<f64>,
    /// Accelerations without lasting contacts of the island, m/s^2.
    pub(crate) free: DVector<f64>,
    /// Static and kinetic coefficient.
    pub(crate) friction: Vec<[f64; 2]>,
}

impl Slips {
    /// Those of a tape, by its numbers.
    pub(crate) fn read(of: &[Slipping], owner: &HashMap<usize, usize>, value: impl Fn(usize) -> f64) -> Self {
        let column = |output: &dyn Fn(&Measured) -> usize| {
            DVector::from_iterator(of.len(), of.iter().map(|slip| value(output(&slip.row))))
        };
        let friction = of.iter().map(|slip| [1, 2].map(|which| value(slip.row.end() + which)));
        Self {
            of: of.iter().map(|slip| slip.position).collect(),
            pairs: of.iter().map(|slip| slip.pair).collect(),
            rolls: of.iter().map(|slip| owner.contains_key(&slip.pair)).collect(),
            rate: column(&Measured::rate),
            speed: DVector::zeros(of.len()),
            free: column(&Measured::end),
            friction: friction.collect(),
        }
    }

    /// Index of the friction of a position among them.
    pub(crate) fn at(&self, position: usize) -> Option<usize> {
        self.of.iter().zip(&self.rolls).position(|(known, rolls)| *known == position && !rolls)
    }

    /// Indices of all that a position has among them.
    pub(crate) fn all_at(&self, position: usize) -> impl Iterator<Item = usize> {
        (0..self.of.len()).filter(move |slip| self.of[*slip] == position)
    }
}
