//! # Law
//! What keeps bodies in a mode may be more than is needed: three feet on a floor, three parallel cranks. With G the generalized
//! forces of a unit of each multiplier, all lambda with one `G lambda` make one motion; two of them differ by a vector of the null
//! space of G. Each row k that was left out gives a vector of it, `e_k - sum c_i e_i` with `g_k = sum c_i g_i` over the rows that
//! are kept. A quantity is unique where its gradient by lambda is orthogonal to these, N. One that is linear in lambda lies between
//! the least and the greatest value of all `lambda_0 + N y` in which no contact pulls: two linear programs.
//! # Symbols and units
//! lambda multipliers of contacts and joints (N or N m), lambda_0 those that the equations have found.
//! # Sign and frame
//! A contact pushes with lambda >= 0; a joint's multipliers may have any sign, and so may friction of what sticks, whose limits are
//! not looked at.
//! # Validity
//! Rigid bodies; what bears how much of a load is a question of how little they yield. The reaction of a pivot follows from all
//! other forces.
//! # Source
//! Statical indeterminacy; null space of the equilibrium matrix.
//! # Checked by
//! `tests/uniqueness.rs`: benches and beams on more supports than they need, cranks beside each other.

use nalgebra::{DMatrix, DVector};
use tumble_expr::{Expr, Substitution, Symbol, Unit, is_identically_zero};
use tumble_ode::{Reason, Side};

use crate::contact::{ContactMode, Grip};
use crate::equations::{Equations, on_body};
use crate::linear_program::greatest;
use crate::link::RowOf;
use crate::mode::Mode;
use crate::run::{Run, RunError};

/// A row that was left out follows from the others to this part of its size: a little more than the root of what contacts are told
/// apart by, where pivots are squares.
const FOLLOWS: f64 = 1e-4;
/// Parts of a sum, or of a row, below this are rounding of places that joints and contacts keep to 1e-12 and better.
const NOTHING: f64 = 1e-9;

/// What a motion leaves open of a quantity that is not unique.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Least value with the same motion and no contact that pulls; minus infinity where nothing bounds it, or where the quantity is
    /// not linear in the forces.
    pub least: f64,
    /// Greatest such value, or infinity.
    pub greatest: f64,
}

/// Multipliers of which some are more than needed.
struct Redundancy {
    symbols: Vec<Symbol>,
    is_contact: Vec<bool>,
    /// How many of them, at the end, belong to rows that are left out.
    left_out: usize,
    /// By multiplier and row left out: what changes no motion.
    directions: DMatrix<f64>,
}

/// Where and when.
#[derive(Clone, Copy)]
pub(crate) struct Spot<'a> {
    pub(crate) mode: &'a Mode,
    pub(crate) time: f64,
    pub(crate) states: &'a [f64],
    pub(crate) inputs: &'a [f64],
}

impl Run {
    /// What is open of some formulas of the motion at a time: `None` of what is unique, and outside the motion.
    pub fn spreads(&self, formulas: &[Expr], time: f64, side: Side) -> Result<Vec<Option<Spread>>, RunError> {
        let mut found = vec![None; formulas.len()];
        for (groups, places) in self.grouped(formulas) {
            let motion = self.part(&groups).motion();
            let Some(place) = motion.place_at(time, side) else { continue };
            let own: Vec<Expr> = places.iter().map(|index| formulas[*index].clone()).collect();
            let mode = &motion.modes[place.mode];
            let spreads = self.equations.spreads(mode, time, &place.states, &self.inputs, &own)?;
            places.into_iter().zip(spreads).for_each(|(index, spread)| found[index] = spread);
        }
        Ok(found)
    }

    /// Whether a formula is open at any time between two, s.
    pub fn is_open_within(&self, formula: &Expr, [from, to]: [f64; 2]) -> Result<bool, RunError> {
        let part = self.along(std::slice::from_ref(formula));
        let motion = part.trajectory();
        // Which rows are left out does not change within a mode.
        let mut is_known = vec![false; motion.modes.len()];
        for piece in motion.pieces.iter().filter(|piece| piece.end >= from && piece.start <= to) {
            if std::mem::replace(&mut is_known[piece.mode], true) {
                continue;
            }
            let time = from.max(piece.start);
            let side = if time < piece.end { Side::After } else { Side::Before };
            if part.spreads(std::slice::from_ref(formula), time, side)?[0].is_some() {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Names of the contacts, joints and pivots of a body whose forces are open at a time.
    pub fn open_forces(&self, body: usize, time: f64, side: Side) -> Result<Vec<String>, RunError> {
        let named = self.equations.keeping(body);
        let formulas: Vec<Expr> = named.iter().map(|(_, symbol)| symbol.clone().into()).collect();
        let spreads = self.spreads(&formulas, time, side)?;
        let open = named.into_iter().zip(spreads).filter(|(_, spread)| spread.is_some());
        let mut names: Vec<String> = open.map(|((name, _), _)| name).collect();
        names.dedup();
        Ok(names)
    }
}

impl Equations {
    /// What is open of some formulas of the motion in a mode: `None` of what is unique.
    pub fn spreads(
        &self,
        mode: &Mode,
        time: f64,
        states: &[f64],
        inputs: &[f64],
        formulas: &[Expr],
    ) -> Result<Vec<Option<Spread>>, Reason> {
        let spot = Spot { mode, time, states, inputs };
        let Some(open) = self.redundancy(spot)? else { return Ok(vec![None; formulas.len()]) };
        let reactions = self.reactions(mode);
        formulas.iter().map(|formula| self.spread(spot, &open, &reactions.apply(formula))).collect()
    }

    /// What keeps a body: names, and symbols of the forces.
    fn keeping(&self, body: usize) -> Vec<(String, Symbol)> {
        let pairs = self.pairs().iter().filter(|pair| pair.has(body));
        let pairs = pairs.flat_map(|pair| {
            let friction = pair.friction.iter().map(|_| pair.friction_symbol());
            let forces = std::iter::once(pair.force_symbol()).chain(friction);
            forces.map(|symbol| (pair.name.clone(), symbol)).collect::<Vec<_>>()
        });
        let name = &self.model().bodies[body].name;
        let joints = self.model().joints.iter().filter(|joint| joint.bodies().any(|own| own == name));
        let joints = joints.map(|joint| (joint.name.clone(), joint.multipliers()));
        let pivot =
            self.model().pivot_of(name).map(|pivot| (pivot.name.clone(), pivot.force_symbols().to_vec()));
        let several = joints.chain(pivot);
        let several =
            several.flat_map(|(name, symbols)| symbols.into_iter().map(move |symbol| (name.clone(), symbol)));
        pairs.chain(several).collect()
    }

    /// Reactions of pivots by the forces of all contacts and joints, with those that bear nothing.
    fn reactions(&self, mode: &Mode) -> Substitution {
        let mut terms = self.acting(mode);
        terms.extend(idle(mode).flat_map(|pair| &self.pair_list().terms[pair]));
        let mut reactions = Substitution::default();
        for &body in &mode.bodies {
            let found = self.body_equations(body).reaction(body, &on_body(&terms, body));
            found.into_iter().for_each(|(symbol, force)| reactions.insert(symbol, force));
        }
        reactions
    }

    /// What keeps the islands of which some rows are left out; `None` where there are none.
    fn redundancy(&self, spot: Spot<'_>) -> Result<Option<Redundancy>, Reason> {
        let mode = spot.mode;
        let is_left_out = |index: &usize| mode.redundant.contains(index);
        let joints = self.rows_by_joint(mode);
        let left_out = joints.iter().filter(|(index, _)| is_left_out(index));
        let bodies = left_out.flat_map(|(_, row)| self.bodies_of(*row));
        let without = idle(mode).chain(following(mode));
        let bodies: Vec<usize> = bodies.chain(without.flat_map(|pair| self.pairs()[pair].bodies())).collect();
        if bodies.is_empty() {
            return Ok(None);
        }
        let own: Vec<usize> = self.islands(mode, &bodies).concat();
        let is_own = |row: &RowOf| self.bodies_of(*row).iter().any(|body| own.contains(body));
        let of_joints = |left_out: bool| {
            let rows = joints.iter().filter(move |(index, _)| is_left_out(index) == left_out);
            rows.map(|(_, row)| (*row, false)).collect::<Vec<_>>()
        };
        let of_pair = |pair: usize| (RowOf::Pair(pair), true);
        let of_slip = |pair: usize| (RowOf::Slip(pair), false);
        let contacts = mode.held().map(of_pair).chain(mode.sticking().map(of_slip));
        let mut all: Vec<(RowOf, bool)> = of_joints(false).into_iter().chain(contacts).collect();
        all.retain(|(row, _)| is_own(row));
        let kept = all.len();
        let contacts = idle(mode).map(of_pair).chain(following(mode).map(of_slip));
        all.extend(of_joints(true).into_iter().chain(contacts));
        let (rows, is_contact): (Vec<RowOf>, Vec<bool>) = all.into_iter().unzip();
        let directions = self.directions(spot, &rows, kept)?;
        let symbols: Vec<Symbol> = rows.into_iter().map(|row| self.row(row).multiplier).collect();
        Ok(Some(Redundancy { left_out: symbols.len() - kept, symbols, is_contact, directions }))
    }

    /// By row and row left out, what changes no motion.
    fn directions(&self, spot: Spot<'_>, rows: &[RowOf], kept: usize) -> Result<DMatrix<f64>, Reason> {
        let rows: Vec<(usize, RowOf)> = rows.iter().copied().enumerate().collect();
        let numbers = self.numbers_of(spot.mode, &rows, spot.time, spot.states, spot.inputs)?;
        // In these units a unit of each is as much kinetic energy.
        let unit = numbers.mass.map(|mass| if mass > 0.0 { 1.0 / libm::sqrt(mass) } else { 1.0 });
        let mut forces = DMatrix::from_diagonal(&unit) * numbers.gradient.dense().transpose();
        if forces.iter().any(|value| !value.is_finite()) {
            return Err(Reason::Model("what keeps bodies here is not known by finite numbers".into()));
        }
        let norms: Vec<f64> = forces.column_iter().map(|column| column.norm()).collect();
        let least = NOTHING * norms.iter().fold(0.0, |most: f64, norm| most.max(*norm));
        // A unit that does next to nothing is one that does nothing, of any size.
        let sizes: Vec<f64> = norms.iter().map(|norm| if *norm > least { *norm } else { 1.0 }).collect();
        for (mut column, (norm, size)) in forces.column_iter_mut().zip(norms.iter().zip(&sizes)) {
            column *= if *norm > least { 1.0 / size } else { 0.0 };
        }
        let shares = shares(&forces, kept);
        Ok(DMatrix::from_fn(rows.len(), rows.len() - kept, |row, column| {
            shares[(row, column)] * sizes[kept + column] / sizes[row]
        }))
    }

    /// What is open of a formula in multipliers.
    fn spread(&self, spot: Spot<'_>, open: &Redundancy, formula: &Expr) -> Result<Option<Spread>, Reason> {
        let used = formula.symbols();
        if !open.symbols.iter().any(|symbol| used.contains(symbol)) {
            return Ok(None);
        }
        let gradient: Vec<Expr> = open.symbols.iter().map(|symbol| formula.derivative(symbol)).collect();
        let values = |formulas: &[Expr]| {
            self.values(formulas, spot.mode, spot.time, spot.states, spot.inputs).map(DVector::from_vec)
        };
        let constant = values(&gradient)?;
        let slopes = open.slopes(&constant);
        let is_constant = |slope: &Expr| {
            let mut used = open.symbols.iter().filter(|symbol| slope.symbols().contains(symbol));
            used.all(|symbol| is_identically_zero(&slope.derivative(symbol)))
        };
        let is_linear = gradient.iter().all(is_constant);
        if !is_linear {
            // A square of a force has no slope where that is zero: looked at from elsewhere as well.
            let elsewhere: Vec<Expr> = gradient.iter().map(|slope| open.elsewhere().apply(slope)).collect();
            let is_open = slopes.amax() > 0.0 || open.slopes(&values(&elsewhere)?).amax() > 0.0;
            return Ok(is_open.then_some(Spread { least: f64::NEG_INFINITY, greatest: f64::INFINITY }));
        }
        if slopes.amax() == 0.0 {
            return Ok(None);
        }
        let forces: Vec<Expr> = open.symbols.iter().cloned().map(Expr::from).collect();
        let (found, forces) = (values(std::slice::from_ref(formula))?[0], values(&forces)?);
        let [down, up] = [-&slopes, slopes].map(|slopes| open.farthest(&slopes, &forces));
        let blur = NOTHING * constant.amax() * forces.amax();
        // Feet that nothing may load are redundant, and bear nothing all the same.
        let is_open = down + up > blur;
        let [least, greatest] =
            [found - down, found + up].map(|end| if end.abs() > blur { end } else { 0.0 });
        Ok(is_open.then_some(Spread { least, greatest }))
    }
}

impl Redundancy {
    /// How a quantity of this gradient changes along the directions; zero where it does not but for rounding.
    fn slopes(&self, gradient: &DVector<f64>) -> DVector<f64> {
        DVector::from_fn(self.left_out, |column, _| {
            let parts = gradient.component_mul(&self.directions.column(column));
            let sum = parts.sum();
            if sum.abs() > NOTHING * parts.abs().sum() { sum } else { 0.0 }
        })
    }

    /// All multipliers one unit away.
    fn elsewhere(&self) -> Substitution {
        let mut away = Substitution::default();
        for symbol in &self.symbols {
            away.insert(symbol.clone(), Expr::from(symbol.clone()) + 1 * Unit(symbol.dimension));
        }
        away
    }

    /// How far a quantity of these slopes can grow before a contact would pull.
    fn farthest(&self, slopes: &DVector<f64>, forces: &DVector<f64>) -> f64 {
        let kept = self.symbols.len() - self.left_out;
        // What is left out pushes from nothing on; of a joint both ways.
        let both_ways = (0..self.left_out).filter(|column| !self.is_contact[kept + column]);
        let ways: Vec<(usize, f64)> = (0..self.left_out)
            .map(|column| (column, 1.0))
            .chain(both_ways.map(|column| (column, -1.0)))
            .collect();
        let bounds: Vec<usize> = (0..kept).filter(|row| self.is_contact[*row]).collect();
        let a = DMatrix::from_fn(bounds.len(), ways.len(), |row, way| {
            -ways[way].1 * self.directions[(bounds[row], ways[way].0)]
        });
        let d = DVector::from_fn(ways.len(), |way, _| ways[way].1 * slopes[ways[way].0]);
        greatest(&d, &a, &DVector::from_fn(bounds.len(), |row, _| forces[bounds[row]].max(0.0)))
    }
}

/// Of columns of unit length, `e_k - sum c_i e_i` for each of the last ones that is the sum of the first `kept` with the parts c; zero
/// where it is not.
fn shares(columns: &DMatrix<f64>, kept: usize) -> DMatrix<f64> {
    let left_out = columns.ncols() - kept;
    let mut found = DMatrix::zeros(columns.ncols(), left_out);
    let known = columns.columns(0, kept).into_owned();
    let parts = (kept > 0).then(|| known.clone().svd(true, true));
    for column in 0..left_out {
        let own = columns.column(kept + column).into_owned();
        let solved = parts.as_ref().and_then(|parts| parts.solve(&own, NOTHING).ok());
        let sum = solved.unwrap_or_else(|| DVector::zeros(kept));
        if (&own - &known * &sum).norm() <= FOLLOWS * own.norm() {
            let sum = sum.map(|part| if part.abs() <= NOTHING { 0.0 } else { -part });
            found.view_mut((0, column), (kept, 1)).copy_from(&sum);
            found[(kept + column, column)] = 1.0;
        }
    }
    found
}

/// Pairs that stay on a surface without a force.
fn idle(mode: &Mode) -> impl Iterator<Item = usize> {
    let idle = mode.contacts.iter().filter(|(_, contact_mode)| *contact_mode == ContactMode::Idle);
    idle.map(|(pair, _)| *pair)
}

/// Pairs that do not slip and are given no friction.
fn following(mode: &Mode) -> impl Iterator<Item = usize> {
    mode.grips.iter().filter(|(_, grip)| *grip == Grip::Follows).map(|(pair, _)| *pair)
}
