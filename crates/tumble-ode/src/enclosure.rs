//! What formulas may be anywhere along a stretch of a motion, and not at some places of it only.
//!
//! Along a step the states are polynomials, so all is a function of s alone. With m the middle of a stretch and rho half its
//! length, Taylor's theorem gives for any order r up to [`ORDER`]
//!
//! ```text
//! f(s) = sum over k < r of c_k (s - m)^k + B_r (s - m)^r,   |s - m| <= rho
//! ```
//!
//! with c_k the coefficients at the middle and B_r an interval that holds the coefficient of order r at every place of the
//! stretch: the tape run on intervals. Each r is a bound, and the narrowest counts. Source: Moore, Interval Analysis, chapter
//! 11; Neumaier, Interval Methods for Systems of Equations.

use std::sync::Arc;

use tumble_expr::{Branches, Interval, Jets, Kernels, Row, Scalar, Slot, Tape};

use crate::Coefficients;
use crate::polynomial::{shifted, shifted_up_to};

/// Highest order of the intervals. A remainder shrinks with this power of the stretch; beyond five, intervals of products
/// grow as fast as it shrinks.
pub(crate) const ORDER: usize = 5;
/// Orders that are kept of leaves: a defect is made of slopes.
const ORDERS: usize = ORDER + 2;
/// Rounding errors of coefficients at a point, in units of the last place of their sum.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// A stretch of motion: polynomials in a parameter s that begins at 0.
#[derive(Clone, Copy, Debug)]
pub struct Path<'a> {
    /// Time at s = 0, s.
    pub start: f64,
    /// Coefficients `[state][order]`.
    pub states: &'a Coefficients,
    /// Those of the time, where it is not `start + s`.
    pub time: Option<&'a [f64]>,
}

/// Lengths and quotients that are zero at one end of what is looked at.
#[derive(Clone, Copy, Debug)]
pub struct Vanishing<'a> {
    /// By norm of the tape.
    pub norms: &'a [bool],
    /// Whether it is at the end and not at the beginning.
    pub at_end: bool,
}

/// Runs a tape along stretches, on numbers in the middle and on intervals.
pub struct Enclosure {
    middle: Jets<f64>,
    boxes: Jets<Interval>,
    /// By order, of every state and then of the time: coefficients about the middle, and over the stretch.
    about: [Vec<f64>; ORDERS],
    hulls: [Vec<Interval>; ORDERS],
    signs: Vec<Interval>,
    /// No norm vanishes.
    nothing: Vec<bool>,
    reach: f64,
}

impl Enclosure {
    /// An evaluator of a tape.
    pub fn new(tape: Arc<Tape>, inputs: &[f64]) -> Self {
        let boxes: Vec<Interval> = inputs.iter().map(|value| Interval::point(*value)).collect();
        Self {
            nothing: vec![false; tape.norms()],
            middle: Jets::new(tape.clone(), ORDER, inputs),
            boxes: Jets::new(tape, ORDER, &boxes),
            about: Default::default(),
            hulls: Default::default(),
            signs: vec![],
            reach: 0.0,
        }
    }

    /// Looks at what lies between two values of the parameter, on these branch signs.
    pub fn look(
        &mut self,
        path: Path<'_>,
        [low, high]: [f64; 2],
        signs: &[f64],
        vanishing: Option<Vanishing<'_>>,
    ) {
        self.reach = 0.5 * (high - low);
        self.place(path, 0.5 * (low + high));
        self.expand_middle(signs);
        self.signs.clear();
        self.signs.extend(signs.iter().map(|sign| Interval::point(*sign)));
        self.boxes.set_vanishing(vanishing.map_or(&self.nothing[..], |vanishing| vanishing.norms));
        if let Some(vanishing) = vanishing {
            let way = high - low;
            self.boxes.forget(Interval::ENTIRE);
            self.boxes.set_elapsed(if vanishing.at_end {
                Interval::new(-way, 0.0)
            } else {
                Interval::new(0.0, way)
            });
            self.expand_boxes();
        }
        self.expand_boxes();
    }

    /// Looks at values only, between two values of the parameter, whatever signs branches take there.
    pub fn survey(&mut self, path: Path<'_>, [low, high]: [f64; 2]) {
        self.reach = 0.5 * (high - low);
        self.place(path, 0.5 * (low + high));
        self.boxes.set_vanishing(&self.nothing);
        start(&mut self.boxes, &self.hulls, Branches::Free);
    }

    /// All values of an output, by intervals alone.
    pub fn value(&self, output: usize) -> Interval {
        self.boxes.value_of(output)
    }

    /// Branch signs and table segments, if by the last [`Enclosure::survey`] each is the same all along.
    pub fn kept_signs(&self) -> Option<Vec<f64>> {
        let kept = |sign: &Interval| (sign.low == sign.high).then_some(sign.low);
        self.boxes.signs().iter().map(kept).collect()
    }

    /// Branch signs that formulas take in the middle of a stretch, each by its value.
    pub fn signs(&mut self, path: Path<'_>, [low, high]: [f64; 2]) -> Vec<f64> {
        self.place(path, 0.5 * (low + high));
        start(&mut self.middle, &self.about, Branches::Free);
        self.middle.signs().to_vec()
    }

    /// What is known of a slot along the stretch.
    pub fn of(&self, slot: Slot) -> Bounds<'_> {
        Bounds {
            middle: self.middle.slot(slot),
            boxes: self.boxes.slot(slot),
            reach: self.reach,
            offset: 0.0,
        }
    }

    /// What is known of an output along the stretch.
    pub fn output(&self, index: usize) -> Bounds<'_> {
        Bounds {
            middle: self.middle.output(index),
            boxes: self.boxes.output(index),
            reach: self.reach,
            offset: 0.0,
        }
    }

    /// The tape that runs.
    pub fn tape(&self) -> &Arc<Tape> {
        self.middle.tape()
    }

    /// Bound of `p'(s) - f(s)`, with p a leaf, by its index, and f an output that should be its slope.
    pub fn defect(&self, leaf: usize, output: usize) -> f64 {
        let (f, box_of) = (self.middle.output(output), self.boxes.output(output));
        let rest = |k: usize| {
            let slope = Interval::splat((k + 1) as f64) * self.hulls[k + 1][leaf];
            (slope - box_of[k]).magnitude()
        };
        let (mut sum, mut power, mut least) = (0.0, 1.0, rest(0));
        for (k, f) in f.iter().enumerate().take(ORDER) {
            let slope = (k + 1) as f64 * self.about[k + 1][leaf];
            sum += ((slope - f).abs() + ROUNDING * slope.abs()) * power;
            power *= self.reach;
            least = smaller(least, sum + rest(k + 1) * power);
        }
        least
    }

    /// How fast a leaf changes at most, by its index.
    pub fn slope(&self, leaf: usize) -> f64 {
        self.hulls[1][leaf].magnitude()
    }

    fn place(&mut self, path: Path<'_>, middle: f64) {
        let plain = [path.start, 1.0];
        let time = path.time.unwrap_or(&plain);
        self.about.iter_mut().for_each(Vec::clear);
        self.hulls.iter_mut().for_each(Vec::clear);
        for series in path.states.iter().chain([time]) {
            self.place_leaf(series, middle);
        }
    }

    /// A polynomial about a place, and intervals of its coefficients no farther than the reach from there.
    fn place_leaf(&mut self, series: &[f64], place: f64) {
        let about = shifted(series, place);
        let sizes: Row = about.iter().map(|c| c.abs()).collect();
        // Shifted by the reach, the sizes are the sums of all that a coefficient can change by, and it itself.
        let most = shifted_up_to(&sizes, self.reach, sizes.len().min(ORDERS));
        for (k, (all, hulls)) in self.about.iter_mut().zip(&mut self.hulls).enumerate() {
            let (c, hull) = match most.get(k) {
                None => (0.0, Interval::zero()),
                Some(most) => {
                    let change = (most - sizes[k]) + ROUNDING * most;
                    (about[k], Interval::new(about[k] - change, about[k] + change))
                }
            };
            all.push(c);
            hulls.push(hull);
        }
    }

    fn expand_middle(&mut self, signs: &[f64]) {
        start(&mut self.middle, &self.about, Branches::Frozen(signs));
        extend(&mut self.middle, &self.about);
    }

    fn expand_boxes(&mut self) {
        start(&mut self.boxes, &self.hulls, Branches::Frozen(&self.signs));
        extend(&mut self.boxes, &self.hulls);
    }
}

/// Evaluates a tape at the coefficients of order 0 of all leaves.
fn start<S: Kernels>(jets: &mut Jets<S>, leaves: &[Vec<S>; ORDERS], branches: Branches<'_, S>) {
    let (time, states) = leaves[0].split_last().expect("the time is a leaf");
    jets.start(*time, states, branches);
}

/// Its orders above.
fn extend<S: Kernels>(jets: &mut Jets<S>, leaves: &[Vec<S>; ORDERS]) {
    for (k, order) in leaves.iter().enumerate().take(ORDER + 1).skip(1) {
        for (leaf, c) in order.iter().enumerate() {
            jets.set(leaf, k, *c);
        }
        jets.extend(k);
    }
}

/// What is known of one function along a stretch.
#[derive(Clone, Copy, Debug)]
pub struct Bounds<'a> {
    /// Coefficients in the middle.
    middle: &'a [f64],
    /// Intervals of the coefficients over the stretch.
    boxes: &'a [Interval],
    reach: f64,
    /// What is taken from the function.
    offset: f64,
}

impl<'a> Bounds<'a> {
    /// The same function less a number.
    pub fn less(self, offset: f64) -> Self {
        Self { offset: self.offset + offset, ..self }
    }

    /// All values of the function, or of its derivative of that order over the factorial.
    pub fn range(&self, derivative: usize) -> Interval {
        let natural = self.boxed(derivative);
        let (mut sum, mut power, mut narrowest) = (0.0, 1.0, f64::INFINITY);
        for order in derivative + 1..=ORDER {
            power *= self.reach;
            let many = choose(order, derivative);
            narrowest = smaller(narrowest, sum + many * self.boxes[order].magnitude() * power);
            sum += many * self.middle[order].abs() * power;
        }
        let middle = self.middle[derivative] - if derivative == 0 { self.offset } else { 0.0 };
        let width = narrowest + ROUNDING * (middle.abs() + sum);
        Interval::new(middle - width, middle + width).both(natural)
    }

    /// What intervals alone say of a coefficient.
    pub fn boxed(&self, order: usize) -> Interval {
        if order == 0 { self.boxes[0] - Interval::point(self.offset) } else { self.boxes[order] }
    }

    /// The value at -1 (the beginning) to 1 (the end).
    pub fn at(&self, part: f64) -> Interval {
        let s = part * self.reach;
        let (mut sum, mut size, mut power) = (-self.offset, self.offset.abs(), 1.0);
        let mut narrowest = Interval::ENTIRE;
        for order in 0..=ORDER {
            if order > 0 {
                let rest = Interval::splat(power) * self.boxes[order];
                let wide = ROUNDING * size;
                narrowest = (Interval::new(sum - wide, sum + wide) + rest).both(narrowest);
            }
            sum += self.middle[order] * power;
            size += (self.middle[order] * power).abs();
            power *= s;
        }
        narrowest
    }

    /// Where, from -1 to 1, its slope is zero, if it bends to one side only.
    pub fn turn(&self) -> f64 {
        let slope = |s: f64| (1..=ORDER).rev().fold(0.0, |sum, k| sum * s + k as f64 * self.middle[k]);
        let bend =
            |s: f64| (2..=ORDER).rev().fold(0.0, |sum, k| sum * s + (k * (k - 1)) as f64 * self.middle[k]);
        let mut at = 0.0_f64;
        for _ in 0..TURN_STEPS {
            let next = at - slope(at) / bend(at);
            at = if next.is_finite() { next.clamp(-self.reach, self.reach) } else { return 0.0 };
        }
        if self.reach > 0.0 { at / self.reach } else { 0.0 }
    }
}

/// Newton's steps towards a turn of a function that bends to one side: from within, each squares the error.
const TURN_STEPS: usize = 8;

fn choose(n: usize, k: usize) -> f64 {
    (0..k).fold(1.0, |product, i| product * (n - i) as f64 / (i + 1) as f64)
}

/// Of two bounds the lesser; one that is not a number is none.
fn smaller(a: f64, b: f64) -> f64 {
    if b < a || a.is_nan() { b } else { a }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tumble_expr::{Dimension, Expr, Layout, Symbol, Unary};

    fn enclosure(formula: Expr) -> Enclosure {
        let symbol = |name: &str| Symbol::new(name, Dimension::NONE);
        let layout = Layout::new(vec![symbol("x")], symbol("t"), vec![]);
        Enclosure::new(Arc::new(Tape::compile(&layout, &[formula]).expect("typed")), &[])
    }

    fn line() -> Coefficients {
        Coefficients::of([&[0.0, 1.0][..]].into_iter())
    }

    fn x() -> Expr {
        Expr::symbol("x", Dimension::NONE)
    }

    /// A step far ahead is seen, and none where there is none.
    #[test]
    fn a_steep_formula_ahead_is_seen() {
        let mut steep = enclosure(Expr::unary(Unary::Tanh, (x() - 3) * 30) - 0.5);
        let states = line();
        let path = Path { start: 0.0, states: &states, time: None };
        steep.look(path, [0.0, 2.0], &[], None);
        assert_eq!(steep.output(0).range(0).definite_sign(), -1.0);
        steep.look(path, [2.0, 4.0], &[], None);
        assert_eq!(steep.output(0).range(0).definite_sign(), 0.0);
        steep.look(path, [3.01, 3.03], &[], None);
        assert_eq!(steep.output(0).range(1).definite_sign(), 1.0);
        assert!(steep.output(0).at(-1.0).high < 0.0 && steep.output(0).at(1.0).low > 0.0);
    }

    /// The exponential is its own slope: the defect of its series is the first term left out.
    #[test]
    fn the_defect_is_bounded() {
        let series: Vec<f64> = (0..12)
            .scan(1.0, |c, k| {
                if k > 0 {
                    *c /= f64::from(k)
                };
                Some(*c)
            })
            .collect();
        let mut own = enclosure(x());
        let states = Coefficients::of([&series[..]].into_iter());
        own.look(Path { start: 0.0, states: &states, time: None }, [0.0, 0.1], &[], None);
        let truth = series[11] * 0.1_f64.powi(11);
        let defect = own.defect(0, 0);
        assert!(truth <= defect && defect < 1e-8, "{defect:e}");
        let wrong = Coefficients::of([&[1.0, 1.0][..]].into_iter());
        own.look(Path { start: 0.0, states: &wrong, time: None }, [0.0, 0.1], &[], None);
        assert!((0.1..0.2).contains(&own.defect(0, 0)));
    }

    #[test]
    fn a_turn_is_where_the_slope_is_zero() {
        let mut bowl = enclosure((x() - 0.3).powi(2) + 1);
        let states = line();
        bowl.look(Path { start: 0.0, states: &states, time: None }, [0.0, 1.0], &[], None);
        let bounds = bowl.output(0);
        assert!((bounds.turn() + 0.4).abs() < 1e-12);
        let least = bounds.at(bounds.turn());
        assert!(least.contains(1.0) && least.high - least.low < 1e-12, "{least:?}");
    }
}
