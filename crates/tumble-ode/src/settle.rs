//! Whether it is known where a watched function is zero on a stretch.
//!
//! It is where its range leaves out zero; where the function is monotone, or bends to one side only, and its signs at the
//! ends, and at its turn, decide; or where it ends in a triple zero and its third derivative has one sign. What is zero at the beginning, with some of its derivatives, is looked at divided by that
//! power of s: `w = s^z v`, and the coefficients of v are enclosed by those of w, z orders up.

use tumble_expr::Interval;

use crate::enclosure::{Bounds, ORDER};

/// A function that stays this small a part of what it is computed from, all along a stretch, is zero but for rounding.
const FLAT: f64 = 1e-10;

/// What is known of a function before it is looked at.
#[derive(Clone, Copy)]
pub(crate) struct Known<'a> {
    /// How many of its first coefficients are zero at the beginning.
    pub(crate) zeros: usize,
    /// Its sign after that.
    pub(crate) sign: f64,
    /// Whether it is zero at the end.
    pub(crate) ends_at_zero: bool,
    /// How many zeros its series has in between; asked for only where it matters.
    pub(crate) roots: &'a dyn Fn() -> usize,
    /// What its rounding error is a unit in the last place of.
    pub(crate) size: f64,
    /// What is not larger than this has no effect.
    pub(crate) nothing: f64,
}

/// Whether all zeros on the stretch are known.
pub(crate) fn is_settled(bounds: &Bounds<'_>, known: Known<'_>) -> bool {
    let divided = Divided { bounds, zeros: known.zeros };
    if known.zeros >= ORDER || divided.range(0).definite_sign() != 0.0 {
        return true;
    }
    let flat = if known.zeros == 0 && known.size.is_finite() { FLAT * known.size } else { 0.0 };
    if bounds.range(0).magnitude() <= flat.max(known.nothing) {
        return true;
    }
    let ends = Ends {
        low: if known.zeros > 0 { known.sign } else { bounds.at(-1.0).definite_sign() },
        high: if known.ends_at_zero { 0.0 } else { bounds.at(1.0).definite_sign() },
    };
    let slope = divided.range(1).definite_sign();
    if slope != 0.0 {
        return ends.of_monotone(known);
    }
    let bend = divided.range(2).definite_sign();
    if bend != 0.0 {
        return ends.of_bent(bend, bounds, known);
    }
    known.ends_at_zero && ends.flatten_out(divided.range(3).definite_sign(), known)
}

/// A function divided by the power of s that it begins with.
struct Divided<'a> {
    bounds: &'a Bounds<'a>,
    zeros: usize,
}

impl Divided<'_> {
    fn range(&self, derivative: usize) -> Interval {
        match (self.zeros, self.zeros + derivative) {
            (0, _) => self.bounds.range(derivative),
            (_, order) if order <= ORDER => self.bounds.range(order),
            _ => Interval::ENTIRE,
        }
    }
}

/// Signs at both ends; 0 where it is not known, or zero.
struct Ends {
    low: f64,
    high: f64,
}

impl Ends {
    fn of_monotone(&self, known: Known<'_>) -> bool {
        if known.ends_at_zero {
            return true;
        }
        match self.low * self.high {
            same if same > 0.0 => true,
            opposite if opposite < 0.0 => (known.roots)() == 1,
            _ => false,
        }
    }

    fn of_bent(&self, bend: f64, bounds: &Bounds<'_>, known: Known<'_>) -> bool {
        if known.ends_at_zero {
            // On the side that it bends away from, it comes to zero once.
            return self.low * bend < 0.0
                || (self.low * bend > 0.0 && (known.roots)() == 0 && falls_to_end(bounds, bend));
        }
        match self.low * self.high {
            0.0 => false,
            opposite if opposite < 0.0 => (known.roots)() == 1,
            _ if self.low * bend < 0.0 => true,
            _ => {
                let turn = bounds.at(bounds.turn());
                let beyond = turn.definite_sign() * self.low < 0.0;
                // A turn whose sign is not known touches zero, as far as anyone can tell.
                if beyond { (known.roots)() == 2 } else { true }
            }
        }
    }

    /// Of what comes to zero at the end with its slope and its bend, as a cube does, and is zero nowhere before.
    fn flatten_out(&self, twist: f64, known: Known<'_>) -> bool {
        self.low * twist < 0.0 && (known.roots)() == 0
    }
}

/// Whether what bends away from zero still comes down to it at the end: its turn is not on the stretch.
fn falls_to_end(bounds: &Bounds<'_>, bend: f64) -> bool {
    let slope = bounds.range(1);
    let turn = bounds.turn();
    turn >= 1.0 - TURN_MARGIN || slope.definite_sign() * bend < 0.0
}

/// A turn this close to the end of a stretch is at its end.
const TURN_MARGIN: f64 = 1e-9;
