//! The lines of one mode: every term of its equations, split into what a potential stands for and the rest, as numbers.

use tumble_expr::{Branches, Expr, Jets, LEFT_OUT, Rounded, Rounding, Vector};
use tumble_ode::{Piece, Reason};

use crate::anchor::rate;
use crate::balance::contribution::ContributionKind;
use crate::balance::quadrature::{Amounts, Sample};
use crate::contact::{Grip, Pair};
use crate::equations::Equations;
use crate::link::TermOf;
use crate::mode::Mode;
use crate::parameters::time_symbol;
use crate::potential::Potential;
use crate::term::{Law, Term};

/// To which contribution a line belongs.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Key {
    pub(super) load: String,
    pub(super) law: Option<Law>,
    pub(super) body: Option<usize>,
    pub(super) kind: ContributionKind,
}

/// A term with the velocity of its point, in symbols of the motion.
struct Line {
    key: Key,
    term: Term,
    velocity: Vector,
}

/// All lines of a mode, ready to be evaluated.
pub(super) struct Lines {
    /// Terms, then the rates of potentials that are driven.
    pub(super) keys: Vec<Key>,
    /// How many of them are terms.
    terms: usize,
    jets: Jets<f64>,
    /// The same with rounding errors.
    rounded: Jets<Rounded>,
    /// By term, the size of what its force is a difference of.
    operands: Vec<f64>,
    rounding: Rounding,
}

/// Outputs a term: velocity of its point, force, couple, angular rate, place of its point from the balance's, and the body's
/// reach.
const OUTPUTS: usize = 9;

impl Lines {
    pub(super) fn new(
        equations: &Equations,
        potentials: &[Potential],
        mode: &Mode,
        inputs: &[f64],
        about: &Vector,
    ) -> Result<Self, Reason> {
        let lines = lines(equations, potentials, mode);
        let mut outputs: Vec<Expr> = lines.iter().flat_map(|line| outputs(equations, line, about)).collect();
        let mut keys: Vec<Key> = lines.into_iter().map(|line| line.key).collect();
        let terms = keys.len();
        for potential in potentials.iter().filter(|potential| potential.is_in(mode)) {
            if !potential.driven.is_zero() {
                keys.push(potential.key(None, ContributionKind::Driven));
                outputs.push(potential.driven.clone());
            }
        }
        let jets = equations.evaluator(mode, &outputs, inputs)?;
        let numbers: Vec<Rounded> = inputs.iter().map(|value| Rounded::leaf(*value)).collect();
        let rounded = Jets::new(jets.tape().clone(), 0, &numbers);
        Ok(Self { keys, terms, jets, rounded, operands: vec![0.0; terms], rounding: equations.rounding() })
    }

    /// Power, force and torque of every line along a piece, by the piece's parameter and per unit of it.
    pub(super) fn along<'a>(&'a mut self, piece: &'a Piece) -> impl FnMut(f64) -> Sample + 'a {
        self.measure(piece);
        |s| self.sample(piece, s)
    }

    /// Finds what the forces are differences of: far from the origin, a small force of a spring is a difference of large places, and
    /// no more nodes make the sum of its rounding errors better.
    fn measure(&mut self, piece: &Piece) {
        let middle = 0.5 * piece.length;
        let leaf = |value: &f64| Rounded::computed(*value);
        let states: Vec<Rounded> = piece.states_at_parameter(middle).iter().map(leaf).collect();
        self.rounded.start(Rounded::computed(piece.time_at(middle)), &states, Branches::Free);
        for (line, operand) in self.operands.iter_mut().enumerate() {
            let [x, y] = [2, 3].map(|which| self.rounded.value_of(line * OUTPUTS + which).error);
            let size = x.max(y);
            *operand = if size.is_finite() { size } else { 0.0 };
        }
    }

    fn sample(&mut self, piece: &Piece, s: f64) -> Sample {
        self.jets.start(piece.time_at(s), &self.states(piece, s), Branches::Free);
        let (pace, mut sample) = (piece.time_rate(s), Sample::default());
        for line in 0..self.keys.len() {
            let rates = if line < self.terms {
                self.term(line, &mut sample.sizes)
            } else {
                self.driven(line, &mut sample.sizes)
            };
            sample.rates.push(rates.map(|rate| rate * pace));
        }
        sample.sizes = sample.sizes.map(|size| size * pace);
        sample
    }

    /// States, in a check run off by what the rounding of each leaves out of it: far from the origin that is what forces, and so
    /// works, are off by, and both runs would leave out the same.
    fn states(&self, piece: &Piece, s: f64) -> Vec<f64> {
        let mut states = piece.states_at_parameter(s);
        for (index, state) in states.iter_mut().enumerate() {
            *state = self.rounding.off(*state, LEFT_OUT * f64::EPSILON * state.abs(), index as u64);
        }
        states
    }

    fn term(&self, line: usize, sizes: &mut Amounts) -> Amounts {
        let [vx, vy, fx, fy, couple, omega, rx, ry, reach] =
            std::array::from_fn(|which| self.jets.value_of(line * OUTPUTS + which));
        let raise = |size: &mut f64, parts: &[f64]| {
            *size = parts.iter().fold(*size, |size, part| size.max(part.abs()))
        };
        // What is a sum along the body has parts that may balance each other: its couple tells of its forces, and they of it.
        let force = [fx, fy, if reach > 0.0 { couple / reach } else { 0.0 }].map(f64::abs);
        let force = force.into_iter().fold(self.operands[line], f64::max);
        let torque_here = couple.abs().max(force * reach);
        let [power, x, y, torque] = sizes;
        raise(power, &[force * vx, force * vy, torque_here * omega]);
        raise(torque, &[rx * force, ry * force, torque_here]);
        raise(x, &[force]);
        raise(y, &[force]);
        [fx * vx + fy * vy + couple * omega, fx, fy, rx * fy - ry * fx + couple]
    }

    fn driven(&self, line: usize, sizes: &mut Amounts) -> Amounts {
        let power = self.jets.value_of(self.terms * OUTPUTS + line - self.terms);
        sizes[0] = sizes[0].max(power.abs());
        [power, 0.0, 0.0, 0.0]
    }
}

impl Potential {
    /// Whether it is there in a mode.
    pub(super) fn is_in(&self, mode: &Mode) -> bool {
        self.pair.is_none_or(|pair| mode.pressed().any(|pressed| pressed == pair))
    }

    pub(super) fn key(&self, body: Option<usize>, kind: ContributionKind) -> Key {
        Key { load: self.load.clone(), law: Some(self.law), body, kind }
    }

    fn is_of(&self, term: &Term) -> bool {
        self.load == term.load && self.law == term.law && self.body.is_none_or(|body| body == term.body)
    }
}

fn lines(equations: &Equations, potentials: &[Potential], mode: &Mode) -> Vec<Line> {
    let mut taken = vec![0; potentials.len()];
    let mut lines = vec![];
    for (term, velocity) in terms(equations, mode) {
        let mut push = |kind: ContributionKind, term: Term| {
            let key = Key { load: term.load.clone(), law: Some(term.law), body: Some(term.body), kind };
            lines.push(Line { key, term, velocity: velocity.clone() });
        };
        let Some(index) = potentials.iter().position(|potential| potential.is_of(&term)) else {
            push(ContributionKind::Work, term);
            continue;
        };
        let elastic = &potentials[index].elastic[taken[index]];
        taken[index] += 1;
        let part = Term { force: elastic.force.clone(), couple: elastic.couple.clone(), ..term.clone() };
        if !potentials[index].is_whole {
            let rest = Term { force: &term.force - &part.force, couple: &term.couple - &part.couple, ..term };
            push(ContributionKind::Work, rest);
        }
        push(ContributionKind::Conservative, part);
    }
    lines
}

/// All terms of a mode, each with the velocity of its point. What a pivot, a joint or a rigid surface holds moves as they do, so
/// that at rest they do no work at all, not even that of rounding, and what a joint does to one of its bodies it takes from the other.
fn terms(equations: &Equations, mode: &Mode) -> Vec<(Term, Vector)> {
    let model = equations.model();
    let acting = equations.acting_with_shares(mode).into_iter().map(|(of, keeps, term)| {
        let velocity = match of {
            TermOf::Joint(joint, _) => model.joints[joint].velocity(),
            TermOf::Pair(pair, _) if keeps => kept_with(&equations.pairs()[pair]),
            TermOf::Friction(pair, _) if mode.grip(pair).is_some_and(Grip::is_still) => {
                let pair = &equations.pairs()[pair];
                if pair.other.is_some() { pair.material_velocity() } else { rate(&pair.through) }
            }
            TermOf::Pair(..) | TermOf::Friction(..) | TermOf::Load(_) | TermOf::Brake(..) => {
                let motion = model.bodies[term.body].kinematics();
                motion.velocity() + motion.omega() * term.arm.perpendicular()
            }
        };
        (term, velocity)
    });
    let pivots = equations.pivot_terms(mode).filter_map(|term| {
        let (pivot, _) = equations.pivot_arm(term.body)?;
        Some((term, rate(&model.pivots[pivot].world)))
    });
    acting.chain(pivots).collect()
}

/// Velocity of the point by which a pair touches as far as the normal force does work there: that of the surface along its normal, or of
/// one body for both.
fn kept_with(pair: &Pair) -> Vector {
    match pair.other {
        Some(_) => pair.material_velocity(),
        None => -pair.closing().derivative(&time_symbol()) * &pair.normal,
    }
}

fn outputs(equations: &Equations, line: &Line, about: &Vector) -> Vec<Expr> {
    let body = &equations.model().bodies[line.term.body];
    let motion = body.kinematics();
    let place = &(motion.position() - about) + &line.term.arm;
    let turning = [line.term.couple.clone(), motion.omega()];
    let reach = [body.reach()];
    let all =
        [line.velocity.components(), line.term.force.components(), &turning, place.components(), &reach];
    all.concat()
}
