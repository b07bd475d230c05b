//! How far truncated series are from the functions that they stand for, along a step.
//!
//! Leaves are polynomials in s, so every slot is a function f of s alone, whose series to order m is known: C. For 0 <= s <= h,
//! with `|a|` the sum of `|a_k| h^k`, and `a * b` that of `|a_i| |b_j| h^(i+j)` over i + j > m, the rest R >= |f - C| of
//!
//! ```text
//! a b         a * b + |a| R_b + |b| R_a + R_a R_b
//! a / b = c   (c * b + |c| R_b + R_a) / least |b|
//! sqrt a = c  (c * c + R_a) / least c;     a length likewise, with the squares of its components
//! sin, cos a  sqrt(2) max(d * sin, d * cos) + R_a,  d = s a'
//! exp a = c   E + (|c| + E) (exp(R_a) - 1),  E = d * c exp(A),  A = sum over k > 0 of |a_k| h^k
//! tanh a = c  (d * (1 - c^2) + A (c * c)) exp(A (1 + |c|)) + R_a
//! ```
//!
//! Unknowns of linear systems have a bound of their own ([`system`]).
//!
//! The rest of a quotient or a root follows from what `c b - a` and `c^2 - a` leave over; that of sine and cosine, E, from
//! `E' = a' J E + r` with J a rotation, which keeps lengths; those of exp and tanh from Gronwall's lemma. What has no rule has
//! no bound. Rounding errors of the coefficients are in it, since exp and tanh make them grow: far from where a tanh is steep its
//! slope is rounded to nothing.
//!
//! Source: Moore, Interval Analysis, 1966, chapter 11; Makino and Berz, Taylor models, Int. J. Pure Appl. Math. 4 (2003).
//! Checked by `tests/remainders.rs`: what is computed from polynomials and their series is within the bound.

mod definite;
mod inverse;
mod system;

use crate::arena::Arena;
use crate::ops::{Op, Slot};
use crate::resolved::{By, Kernel, Term};
use crate::{Bernstein, Jets};

/// Bounds of the rests of all slots along a step; kept to be used again for the next one.
#[derive(Clone, Debug, Default)]
pub struct Remainders {
    rests: Vec<f64>,
    /// By row, where they have been asked for: `|a_k| h^k`, and their sums from k on.
    terms: Vec<[f64; 2]>,
    is_known: Vec<bool>,
    /// Powers of h.
    powers: Vec<f64>,
    /// In how many parts of a step the matrix of a linear system was last seen to be regular.
    parts: usize,
    /// By linear system, what large ones leave out.
    left_out: Vec<system::LeftOut>,
}

impl Remainders {
    /// Bound of a slot's rest at the end of the step; infinite or no number where there is none.
    pub fn of(&self, slot: Slot) -> f64 {
        self.rests[slot as usize]
    }

    fn begin(&mut self, rows: usize, orders: usize, length: f64) {
        self.rests.clear();
        self.rests.resize(rows, 0.0);
        self.left_out.clear();
        self.is_known.clear();
        self.is_known.resize(rows, false);
        self.terms.resize(rows * orders, [0.0; 2]);
        self.powers.clear();
        self.powers.extend(std::iter::successors(Some(1.0), |power| Some(power * length)).take(orders));
    }
}

/// Rounding errors of a coefficient, in units of the terms that it is made of.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// A lower bound of the size of a polynomial on [0, h] by its coefficients times powers of h; 0 where it may be zero.
fn least(terms: impl Iterator<Item = f64> + Clone) -> f64 {
    let mut all = terms.clone();
    let first = all.next().unwrap_or(0.0);
    let side = if first < 0.0 { -1.0 } else { 1.0 };
    let least = all.fold(first.abs(), |least, term| least + (side * term).min(0.0));
    if least > 0.0 { least } else { Bernstein::new(terms).least() }
}

impl Jets<f64> {
    /// Finds how far series to that order are from their functions on a step of that length.
    pub fn remainders(&self, found: &mut Remainders, order: usize, length: f64) {
        found.begin(self.tape().resolved().rows, self.arena().stride(), length);
        // Of a large system what is left out is told apart from rounding: the one is bounded, the other added up.
        if self.tape().matrices.iter().any(|matrix| matrix.symmetric.is_some()) {
            Along { jets: self, found, order, rounding: 0.0 }.run();
        }
        Along { jets: self, found, order, rounding: ROUNDING }.run();
    }
}

struct Along<'a> {
    jets: &'a Jets<f64>,
    found: &'a mut Remainders,
    order: usize,
    /// Rounding errors of a coefficient, in units of the terms that it is made of.
    rounding: f64,
}

impl Along<'_> {
    fn run(&mut self) {
        let tape = self.jets.tape();
        for leaf in 0..=tape.states() {
            self.found.rests[leaf] = self.beyond(leaf as Slot);
        }
        for (slot, kernel) in &tape.resolved().kernels {
            self.find(*slot, kernel);
        }
    }

    fn arena(&self) -> &Arena<f64> {
        self.jets.arena()
    }

    fn rest(&self, slot: Slot) -> f64 {
        self.found.rests[slot as usize]
    }

    /// `|a_k| h^k`, and their sums from k on, up to the order.
    fn terms(&self, slot: Slot) -> &[[f64; 2]] {
        &self.found.terms[slot as usize * self.arena().stride()..][..=self.order]
    }

    fn know(&mut self, slot: Slot) {
        if std::mem::replace(&mut self.found.is_known[slot as usize], true) {
            return;
        }
        let arena = self.jets.arena();
        let Remainders { terms, powers, .. } = &mut *self.found;
        let terms = &mut terms[slot as usize * arena.stride()..][..=self.order];
        let mut sum = 0.0;
        for ((term, c), power) in
            terms.iter_mut().zip(&arena.row(slot)[..=self.order]).zip(&powers[..=self.order]).rev()
        {
            let size = c.abs() * power;
            sum += size;
            *term = [size, sum];
        }
    }

    /// `|a|`
    fn size(&mut self, slot: Slot) -> f64 {
        self.know(slot);
        self.terms(slot)[0][1]
    }

    /// Terms of a leaf beyond the order.
    fn beyond(&self, leaf: Slot) -> f64 {
        let row = self.arena().row(leaf).iter().zip(&self.found.powers);
        row.skip(self.order + 1).map(|(c, power)| c.abs() * power).sum()
    }

    /// Lower bound of the size of a slot; not positive where it may be zero.
    fn least(&self, slot: Slot) -> f64 {
        let row = self.arena().row(slot)[..=self.order].iter().zip(&self.found.powers);
        least(row.map(|(c, power)| c * power))
    }

    /// `a * b`: the terms of a product beyond the order.
    fn left_out(&mut self, a: Slot, b: Slot) -> f64 {
        self.know(a);
        self.know(b);
        let (a, b) = (&self.terms(a)[1..], &self.terms(b)[1..]);
        a.iter().zip(b.iter().rev()).map(|([a, _], [_, b])| a * b).sum()
    }

    fn product(&mut self, a: Slot, b: Slot) -> f64 {
        let (size_a, size_b, rest_a, rest_b) = (self.size(a), self.size(b), self.rest(a), self.rest(b));
        let own = self.left_out(a, b) + self.rounding * size_a * size_b;
        own + size_a * rest_b + size_b * rest_a + rest_a * rest_b
    }

    fn find(&mut self, slot: Slot, kernel: &Kernel) {
        let rest = match *kernel {
            Kernel::Sum(ref sum) => {
                let terms =
                    &self.jets.tape().resolved().terms[sum.value.start as usize..sum.value.end as usize];
                self.scaled(terms.iter().map(|term| self.multiple(term)).sum(), sum.then)
            }
            Kernel::Product(a, b) => self.product(a, b),
            Kernel::Square(a) | Kernel::Directed { of: a, .. } => self.product(a, a),
            // A row of slopes is read by its coefficients alone.
            Kernel::Slope(_) => 0.0,
            Kernel::Wave { of, slope, cos, .. } => {
                let turned =
                    self.left_out(slope, slot).max(self.left_out(slope, cos)) * std::f64::consts::SQRT_2;
                let rest = turned + self.rest(of) + self.rounding;
                self.found.rests[cos as usize] = rest;
                rest
            }
            Kernel::Along { op: Op::Exp(_), of, slope, .. } => self.exponential(slot, of, slope),
            Kernel::Along { op: Op::Tanh { .. }, of, slope, factor } => {
                self.tangent(slot, of, (slope, factor))
            }
            Kernel::Along { .. } => f64::INFINITY,
            Kernel::Quotient(a, b) => {
                let left = self.rest(a);
                self.quotient(left, b, slot)
            }
            Kernel::Root(a) => self.root(self.rest(a), slot),
            Kernel::Norm { parts, square } => {
                let parts = &self.jets.tape().norms[parts as usize];
                let squares = parts.iter().map(|part| self.product(*part, *part)).sum();
                self.found.rests[square as usize] = squares;
                self.root(squares, slot)
            }
            Kernel::Abs { of, .. } => self.rest(of),
            Kernel::System(system) => {
                self.unknowns(system);
                0.0
            }
            Kernel::Other(op) => self.other(slot, op),
        };
        self.found.rests[slot as usize] = rest;
    }

    fn multiple(&self, term: &Term) -> f64 {
        self.scaled(self.rest(term.of) + self.rounding * self.arena().at(term.of, 0).abs(), term.by)
    }

    fn scaled(&self, rest: f64, by: By) -> f64 {
        match by {
            By::One => rest,
            By::Times(by) => rest * self.arena().at(by, 0).abs(),
            By::Over(by) => rest / self.arena().at(by, 0).abs(),
        }
    }

    /// `left` is the rest of the numerator.
    fn quotient(&mut self, left: f64, b: Slot, c: Slot) -> f64 {
        let least = self.least(b) - self.rest(b);
        if least.is_nan() || least <= 0.0 {
            return f64::INFINITY;
        }
        let rounding = self.rounding * self.size(c) * self.size(b);
        (self.left_out(c, b) + self.size(c) * self.rest(b) + left + rounding) / least
    }

    fn root(&mut self, left: f64, c: Slot) -> f64 {
        let least = self.least(c);
        if least.is_nan() || least <= 0.0 || self.arena().at(c, 0) < 0.0 {
            return f64::INFINITY;
        }
        (self.left_out(c, c) + left + self.rounding * self.size(c) * self.size(c)) / least
    }

    fn exponential(&mut self, slot: Slot, of: Slot, slope: Slot) -> f64 {
        let changes = self.size(of) - self.arena().at(of, 0).abs();
        let first = self.rounding * self.size(slot) + f64::MIN_POSITIVE;
        let own = (self.left_out(slope, slot) + first) * libm::exp(changes);
        own + (self.size(slot) + own) * libm::expm1(self.rest(of))
    }

    /// Of tanh, with `1 - tanh^2` as the factor.
    fn tangent(&mut self, slot: Slot, of: Slot, (slope, factor): (Slot, Slot)) -> f64 {
        let changes = self.size(of) - self.arena().at(of, 0).abs();
        let first = self.rounding * (1.0 + changes);
        let own = self.left_out(slope, factor) + changes * self.left_out(slot, slot) + first;
        own * libm::exp(changes * (1.0 + self.size(slot))) + self.rest(of)
    }

    fn other(&mut self, slot: Slot, op: Op) -> f64 {
        match op {
            Op::Choose { branch, positive, negative } => {
                let side = self.jets.signs()[branch as usize];
                self.rest(if side >= 0.0 { positive } else { negative })
            }
            Op::Sign { .. } | Op::Step { .. } | Op::Knot { .. } | Op::Coefficient { .. } => 0.0,
            Op::SquareOver { of, by, .. } => {
                let left = self.product(of, of);
                self.quotient(left, by, slot)
            }
            _ => f64::INFINITY,
        }
    }
}
