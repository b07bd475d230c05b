//! The order in which people write factors: mass before gravity before length, numbers first, functions late.

use tumble_expr::{Dimension, Exponent};

/// What kind of factor: the order of products.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Class {
    /// Roots of numbers and pi.
    Constant,
    Parameter,
    Time,
    /// Absolute values and lengths: `D |u| u`.
    Bars,
    /// What changes with time.
    Variable,
    Function,
    Sum,
}

/// Where a symbol of that dimension stands among others: `m g L`, `k x`, `y F`, `F t`.
pub(crate) fn rank(dimension: Dimension) -> u8 {
    let zero = Exponent::from_integer(0);
    let heavy = dimension.mass != zero;
    let known = [
        (Dimension::NONE, 0),
        (Dimension::ACCELERATION, 2),
        (Dimension::FORCE, 4),
        (Dimension::TORQUE, 4),
        (Dimension::TIME, 6),
    ];
    match known.iter().find(|(known, _)| *known == dimension) {
        Some((_, rank)) => *rank,
        None if heavy => 1,
        None if dimension.time == zero => 3,
        None => 5,
    }
}

/// The order of names of one rank: that of the alphabet, small letters first where the letter is one.
pub(crate) fn alphabetical(name: &str) -> (String, String) {
    let swapped =
        name.chars().map(|c| if c.is_lowercase() { c.to_ascii_uppercase() } else { c.to_ascii_lowercase() });
    (name.to_lowercase(), swapped.collect())
}
