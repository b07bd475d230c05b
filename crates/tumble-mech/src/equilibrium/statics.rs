//! Newton's method on the equations of statics of a mode, as one tape.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};
use tumble_expr::{Branches, Expr, Jets, Layout, Substitution, Tape};
use tumble_ode::Reason;

use super::formulas::outputs;
use super::{BALANCED, Linearised, MOST_CUTS, MOST_STEPS, NoEquilibrium, Reaction};
use crate::coordinates::Measure;
use crate::equations::{Equations, on_body};
use crate::mode::Mode;
use crate::parameters::time_symbol;
use crate::restrained::least_solution;
use crate::row::Row;
use crate::term::Term;

/// Singular values below this part of the largest are zero: that way nothing pushes, and no step is made.
const SINGULAR: f64 = 1e-11;
/// In parts of the largest force: more is not left by rounding.
const STEEP: f64 = 1e-9;
/// rad; a farther turn in one step leads to another branch of the angle.
const MOST_TURN: f64 = 0.5;

/// A pose that was tried, and what holds it.
#[derive(Clone, Debug)]
pub(crate) struct At {
    /// Of the mode without contacts.
    pub(crate) states: Vec<f64>,
    /// By row.
    multipliers: DVector<f64>,
}

/// How contacts are at a pose.
pub(crate) struct Contacts {
    /// Of all pairs, m.
    pub(crate) gaps: Vec<f64>,
    /// Of those that touch, by pair, N.
    pub(crate) forces: Vec<(usize, f64)>,
}

/// The numbers of a pose.
struct Numbers {
    /// Forces by coordinate, of loads and rows together.
    force: DVector<f64>,
    /// Their sizes added up.
    strength: DVector<f64>,
    gaps: DVector<f64>,
    linear: Linearised,
}

pub(crate) struct Statics<'a> {
    equations: &'a Equations,
    inputs: &'a [f64],
    mode: Mode,
    rows: Vec<Row>,
    layout: Layout,
    /// States that are coordinates which something can move.
    coordinates: Vec<usize>,
    turns: Vec<bool>,
    /// Index of the body of each coordinate.
    bodies: Vec<usize>,
    /// What symbols stand for without any velocity.
    still: Substitution,
    tape: Jets<f64>,
    start: Vec<f64>,
    /// Largest force at the start, in units in which masses are one: what goes to nothing with the rest is measured by it.
    first: f64,
}

impl<'a> Statics<'a> {
    pub(crate) fn new(
        equations: &'a Equations,
        mode: &Mode,
        states: &[f64],
        inputs: &'a [f64],
    ) -> Result<Self, Reason> {
        let all = mode.bodies.clone();
        let rows: Vec<Row> =
            equations.islands(mode, &all).iter().flat_map(|island| equations.rows_on(mode, island)).collect();
        let known = equations.layout(&Mode { contacts: vec![], ..mode.clone() });
        let multipliers = rows.iter().map(|row| row.multiplier.clone());
        let symbols = known.states.iter().cloned().chain(multipliers).collect();
        let layout = Layout::new(symbols, time_symbol(), known.inputs);
        let (mut coordinates, mut turns, mut bodies) = (vec![], vec![], vec![]);
        for body in all {
            for (state, measure) in equations.moved_coordinates(mode, body) {
                coordinates.push(state);
                turns.push(measure == Measure::Angle);
                bodies.push(body);
            }
        }
        let still = equations.still(mode, &rows);
        let outputs = outputs(equations, mode, &rows, &still, &layout, &coordinates);
        let tape = Jets::new(Arc::new(Tape::compile(&layout, &outputs)?), 0, inputs);
        let (start, mode) = (states.to_vec(), mode.clone());
        Ok(Self {
            equations,
            inputs,
            mode,
            rows,
            layout,
            coordinates,
            turns,
            bodies,
            still,
            tape,
            start,
            first: 0.0,
        })
    }

    /// The pose of equilibrium nearest to where it starts.
    pub(crate) fn solve(&mut self) -> Result<At, NoEquilibrium> {
        let multipliers = DVector::zeros(self.rows.len());
        let mut at = At { states: self.start.clone(), multipliers };
        at.multipliers = self.holding(&at);
        let strength = self.numbers(&at);
        self.first = strength.linear.units().0.component_mul(&strength.strength).amax();
        let mut left = self.left(&at);
        for _ in 0..MOST_STEPS {
            if left <= BALANCED {
                return Ok(at);
            }
            let step = self.step(&at);
            let tried = (0..MOST_CUTS).map(|cuts| 0.5_f64.powi(cuts as i32)).find_map(|part| {
                let mut next = at.clone();
                let moved = self.coordinates.iter().zip(&step);
                moved.for_each(|(state, step)| next.states[*state] += part * step);
                next.multipliers = self.holding(&next);
                let rest = self.left(&next);
                (rest < left).then_some((next, rest))
            });
            let Some((next, rest)) = tried else { break };
            (at, left) = (next, rest);
        }
        // Where forces are steep, rounding of the coordinates leaves more of them than their own.
        match self.step(&at).amax() <= BALANCED * self.size(&at) && left <= STEEP {
            true => Ok(at),
            false => Err(self.not_found(&at)),
        }
    }

    /// m or rad, at least one.
    fn size(&self, at: &At) -> f64 {
        self.coordinates.iter().map(|state| at.states[*state].abs()).fold(1.0, f64::max)
    }

    fn numbers(&mut self, at: &At) -> Numbers {
        let (n, m) = (self.coordinates.len(), self.rows.len());
        let states: Vec<f64> = at.states.iter().chain(&at.multipliers).copied().collect();
        self.tape.start(0.0, &states, Branches::Free);
        let value = |index: usize| self.tape.value_of(index);
        let (strength, mass, gaps) = (n, 2 * n, 3 * n);
        let (stiffness, gradient) = (3 * n + m, 3 * n + m + n * n);
        Numbers {
            force: DVector::from_fn(n, |i, _| value(i)),
            strength: DVector::from_fn(n, |i, _| value(strength + i)),
            gaps: DVector::from_fn(m, |row, _| value(gaps + row)),
            linear: Linearised {
                mass: DVector::from_fn(n, |i, _| value(mass + i)),
                stiffness: DMatrix::from_fn(n, n, |i, j| value(stiffness + i * n + j)),
                gradient: DMatrix::from_fn(m, n, |row, j| value(gradient + row * n + j)),
            },
        }
    }

    /// Multipliers that leave least of the forces.
    fn holding(&mut self, at: &At) -> DVector<f64> {
        let zero = At { multipliers: DVector::zeros(self.rows.len()), ..at.clone() };
        let Numbers { force, linear, .. } = self.numbers(&zero);
        let (unit, size) = linear.units();
        let scaled = DMatrix::from_diagonal(&size) * &linear.gradient * DMatrix::from_diagonal(&unit);
        let found = least(scaled.transpose(), &-unit.component_mul(&force));
        size.component_mul(&found)
    }

    /// What is left of forces and gaps, in parts of the largest.
    fn left(&mut self, at: &At) -> f64 {
        let Numbers { force, strength, gaps, linear } = self.numbers(at);
        let (unit, size) = linear.units();
        let largest = unit.component_mul(&strength).amax().max(self.first);
        let forces = if largest > 0.0 { unit.component_mul(&force).amax() / largest } else { 0.0 };
        // Gaps over the lengths that a unit of the coordinates is.
        let left = forces.max(size.component_mul(&gaps).amax() / self.extent(at, &unit));
        if left.is_finite() { left } else { f64::INFINITY }
    }

    fn extent(&self, at: &At, unit: &DVector<f64>) -> f64 {
        let sizes =
            self.coordinates.iter().zip(unit).map(|(state, unit)| at.states[*state].abs().max(1.0) / unit);
        sizes.filter(|size| size.is_finite()).fold(f64::MIN_POSITIVE, f64::max)
    }

    /// The change of the coordinates that Newton's method makes, cut so that nothing turns far.
    fn step(&mut self, at: &At) -> DVector<f64> {
        let Numbers { force, gaps, linear, .. } = self.numbers(at);
        let (n, m) = (self.coordinates.len(), self.rows.len());
        let (unit, size) = linear.units();
        let scaled = DMatrix::from_diagonal(&unit) * &linear.stiffness * DMatrix::from_diagonal(&unit);
        let rate = if scaled.amax() > 0.0 { scaled.amax() } else { 1.0 };
        let gradient = DMatrix::from_diagonal(&size) * &linear.gradient * DMatrix::from_diagonal(&unit);
        let mut matrix = DMatrix::zeros(n + m, n + m);
        matrix.view_mut((0, 0), (n, n)).copy_from(&(scaled / rate));
        matrix.view_mut((0, n), (n, m)).copy_from(&gradient.transpose());
        matrix.view_mut((n, 0), (m, n)).copy_from(&gradient);
        let mut right = DVector::zeros(n + m);
        right.rows_mut(0, n).copy_from(&(-unit.component_mul(&force) / rate));
        right.rows_mut(n, m).copy_from(&-size.component_mul(&gaps));
        let found = least(matrix, &right);
        let step = unit.component_mul(&found.rows(0, n));
        let turned = step.iter().zip(&self.turns).filter(|(_, turns)| **turns);
        let most = turned.map(|(step, _)| step.abs()).fold(0.0, f64::max);
        if most > MOST_TURN { step * (MOST_TURN / most) } else { step }
    }

    fn not_found(&mut self, at: &At) -> NoEquilibrium {
        let Numbers { force, linear, .. } = self.numbers(at);
        let (unit, _) = linear.units();
        let worst = unit.component_mul(&force).iamax();
        let name = |body: usize| format!("`{}`", self.equations.model().bodies[body].name);
        NoEquilibrium::NotFound {
            body: name(self.bodies[worst]),
            residual: (force[worst] * unit[worst] * unit[worst]).abs(),
            unit: if self.turns[worst] { "rad/s^2" } else { "m/s^2" },
        }
    }

    pub(crate) fn linearised(&mut self, at: &At) -> Linearised {
        self.numbers(at).linear
    }

    /// Values of formulas of any kinematic symbols but accelerations.
    pub(crate) fn values(&self, at: &At, formulas: &[Expr]) -> Result<Vec<f64>, Reason> {
        let formulas: Vec<Expr> = formulas.iter().map(|formula| self.still.apply(formula)).collect();
        let mut tape = Jets::new(Arc::new(Tape::compile(&self.layout, &formulas)?), 0, self.inputs);
        let states: Vec<f64> = at.states.iter().chain(&at.multipliers).copied().collect();
        tape.start(0.0, &states, Branches::Free);
        Ok((0..formulas.len()).map(|index| tape.value_of(index)).collect())
    }

    /// Gaps of all pairs, and the forces of those that touch, by pair.
    pub(crate) fn contacts(&self, at: &At) -> Result<Contacts, Reason> {
        let pairs = self.equations.pairs();
        let touching: Vec<usize> = self.mode.contacts.iter().map(|(pair, _)| *pair).collect();
        let gaps = pairs.iter().map(|pair| pair.gap());
        let forces = touching.iter().map(|pair| Expr::from(pairs[*pair].force_symbol()));
        let values = self.values(at, &gaps.chain(forces).collect::<Vec<_>>())?;
        let (gaps, forces) = values.split_at(pairs.len());
        let forces = touching.into_iter().zip(forces.iter().copied()).collect();
        Ok(Contacts { gaps: gaps.to_vec(), forces })
    }

    /// What joints, pivots and contacts do.
    pub(crate) fn reactions(&self, at: &At) -> Result<Vec<Reaction>, Reason> {
        let model = self.equations.model();
        let acting = self.equations.acting(&self.mode);
        let mut named: Vec<(String, [Expr; 3])> = vec![];
        for pivot in &model.pivots {
            let body = model.body_index(&pivot.body).unwrap_or_default();
            let sum = |of: &dyn Fn(&Term) -> Expr| {
                on_body(&acting, body).into_iter().fold(Expr::zero(), |sum, term| sum - of(term))
            };
            let [x, y] = [sum(&|term| term.force.x().clone()), sum(&|term| term.force.y().clone())];
            named.push((pivot.name.clone(), [x, y, Expr::zero()]));
        }
        let holding =
            model.joints.iter().enumerate().filter(|(joint, _)| self.equations.holds(&self.mode, *joint));
        for (_, joint) in holding {
            let mut parts = joint.multipliers().into_iter().map(Expr::from);
            let [x, y, couple] = [0; 3].map(|_| parts.next().unwrap_or_else(Expr::zero));
            named.push((joint.name.clone(), [x, y, couple]));
        }
        for (pair, _) in &self.mode.contacts {
            let pair = &self.equations.pairs()[*pair];
            let force = Expr::from(pair.force_symbol()) * &pair.normal;
            named.push((pair.name.clone(), [force.x().clone(), force.y().clone(), Expr::zero()]));
        }
        let formulas: Vec<Expr> = named.iter().flat_map(|(_, parts)| parts.clone()).collect();
        let values = self.values(at, &formulas)?;
        let reaction = |((name, _), parts): (&(String, [Expr; 3]), &[f64])| Reaction {
            name: name.clone(),
            force: [parts[0], parts[1]],
            couple: parts[2],
        };
        Ok(named.iter().zip(values.chunks_exact(3)).map(reaction).collect())
    }
}

impl Linearised {
    /// Units in which masses are one, and in which gradients of rows are.
    pub(crate) fn units(&self) -> (DVector<f64>, DVector<f64>) {
        let largest = self.mass.amax();
        let unit = self.mass.map(|mass| {
            let mass = if mass > SINGULAR * largest { mass } else { largest };
            if mass > 0.0 { 1.0 / libm::sqrt(mass) } else { 1.0 }
        });
        let scaled = &self.gradient * DMatrix::from_diagonal(&unit);
        let size = DVector::from_fn(scaled.nrows(), |row, _| {
            let norm = scaled.row(row).norm();
            if norm > 0.0 { 1.0 / norm } else { 1.0 }
        });
        (unit, size)
    }
}

/// The least solution of equations that may depend on each other, or contradict each other a little.
fn least(matrix: DMatrix<f64>, right: &DVector<f64>) -> DVector<f64> {
    let columns = matrix.ncols();
    let is_finite = matrix.iter().chain(right.iter()).all(|value| value.is_finite());
    if columns == 0 || matrix.nrows() == 0 || !is_finite {
        return DVector::zeros(columns);
    }
    let right = DMatrix::from_column_slice(right.len(), 1, right.as_slice());
    let found = least_solution(matrix, &right, SINGULAR);
    found.map_or_else(|| DVector::zeros(columns), |found| found.column(0).into_owned())
}
