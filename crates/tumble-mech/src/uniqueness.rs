//! # Law
//! What keeps bodies in a mode may be more than is needed: three feet on a floor, three parallel cranks. With G the generalized
//! forces of a unit of each multiplier, all lambda with one `G lambda` make one motion; two of them differ by a vector of the null
//! space of G. Each row k that was left out gives a vector of it, `e_k - sum c_i e_i` with `g_k = sum c_i g_i` over the rows that
//! are kept. A quantity is unique where its gradient by lambda is orthogonal to these, N. One that is linear in lambda lies between
//! the least and the greatest value of all `lambda_0 + N y` in which no contact pulls and friction is what it can be, `|F| <= mu_s N` at
//! each point that does not slip: two linear programs. Friction of what slips goes with its normal force.
//! # Symbols and units
//! lambda multipliers of contacts and joints (N or N m), lambda_0 those that the equations have found; F friction, N normal force (N), mu_s
//! static coefficient.
//! # Sign and frame
//! A contact pushes with lambda >= 0; a joint's multipliers may have any sign.
//! # Validity
//! Rigid bodies; what bears how much of a load is a question of how little they yield. The reaction of a pivot follows from all
//! other forces.
//! # Source
//! Statical indeterminacy; null space of the equilibrium matrix.
//! # Checked by
//! `tests/uniqueness.rs`: benches and beams on more supports than they need, cranks beside each other, a ladder that is rough at both ends.

mod redundancy;

use nalgebra::{DMatrix, DVector};
use tumble_expr::{Expr, Substitution, Symbol, is_identically_zero};
use tumble_ode::{Reason, Side};

use crate::contact::{ContactMode, Grip};
use crate::equations::{Equations, on_body};
use crate::laws;
use crate::link::RowOf;
use crate::mode::Mode;
use crate::run::{Run, RunError};
use redundancy::{Cone, Redundancy, shares};

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

/// What a formula may be with one motion.
struct Range {
    spread: Spread,
    /// Whether that is more than places that are kept to some digits could make of it.
    is_open: bool,
}

impl Range {
    const ANY: Self =
        Self { spread: Spread { least: f64::NEG_INFINITY, greatest: f64::INFINITY }, is_open: true };
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
        Ok(self.ranges(formulas, time, side)?.into_iter().map(opened).collect())
    }

    /// How far apart the values are that a formula may have, where they are so near each other that it is told as unique: what holds near its
    /// limit can be shared in few ways.
    pub(crate) fn left_open(&self, formula: &Expr, time: f64, side: Side) -> Result<f64, RunError> {
        if !self.equations.reads_forces(formula) {
            return Ok(0.0);
        }
        let range = self.ranges(std::slice::from_ref(formula), time, side)?.swap_remove(0);
        Ok(range
            .filter(|range| !range.is_open)
            .map_or(0.0, |range| range.spread.greatest - range.spread.least))
    }

    fn ranges(&self, formulas: &[Expr], time: f64, side: Side) -> Result<Vec<Option<Range>>, RunError> {
        let mut found: Vec<Option<Range>> = formulas.iter().map(|_| None).collect();
        for (groups, places) in self.grouped(formulas) {
            let motion = self.part(&groups).motion();
            let Some(place) = motion.place_at(time, side) else { continue };
            let own: Vec<Expr> = places.iter().map(|index| formulas[*index].clone()).collect();
            let mode = &motion.modes[place.mode];
            let spot = Spot { mode, time, states: &place.states, inputs: &self.inputs };
            let ranges = self.equations.ranges(spot, &own)?;
            places.into_iter().zip(ranges).for_each(|(index, range)| found[index] = range);
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
        Ok(self.ranges(Spot { mode, time, states, inputs }, formulas)?.into_iter().map(opened).collect())
    }

    fn ranges(&self, spot: Spot<'_>, formulas: &[Expr]) -> Result<Vec<Option<Range>>, Reason> {
        let Some(open) = self.redundancy(spot)? else { return Ok(formulas.iter().map(|_| None).collect()) };
        let reactions = self.reactions(spot.mode);
        formulas.iter().map(|formula| self.range(spot, &open, &reactions.apply(formula))).collect()
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
        terms.extend(idle(mode).flat_map(|pair| self.pair_list().terms(pair)));
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
        let without = idle(mode).chain(borne(mode));
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
        let contacts = idle(mode).map(of_pair).chain(borne(mode).map(of_slip));
        let left_out = of_joints(true).into_iter().chain(contacts);
        all.extend(left_out.filter(|(row, _)| is_own(row)));
        let (rows, is_contact): (Vec<RowOf>, Vec<bool>) = all.into_iter().unzip();
        let directions = self.directions(spot, &rows, kept)?;
        let cones = self.cones(mode, &rows);
        let symbols: Vec<Symbol> = rows.into_iter().map(|row| self.row(row).multiplier).collect();
        Ok(Some(Redundancy { left_out: symbols.len() - kept, symbols, is_contact, directions, cones }))
    }

    /// What friction can be at the points of some rows that do not slip.
    fn cones(&self, mode: &Mode, rows: &[RowOf]) -> Vec<Cone> {
        let place = |of: RowOf| rows.iter().position(|row| *row == of);
        let cone = |(along, row): (usize, &RowOf)| {
            let RowOf::Slip(pair) = *row else { return None };
            let own = &self.pairs()[pair];
            let owner = self.pair_list().owner.get(&pair).copied().unwrap_or(pair);
            let friction = own.friction.as_ref()?.of_rest.clone();
            let across = place(RowOf::Pair(owner));
            let known = || laws::compliant::normal_force(own).filter(|_| mode.is_pressed(owner));
            let normal = across.map(|_| own.force_symbol().into()).or_else(known)?;
            let follows = mode.grip(pair) == Some(Grip::Follows);
            Some(Cone { friction, normal, across, along, patch: own.slips_with(pair), follows })
        };
        let is_still = |(_, row): &(usize, &RowOf)| match row {
            RowOf::Slip(pair) => mode.grip(*pair).is_some_and(Grip::is_still),
            _ => false,
        };
        rows.iter().enumerate().filter(is_still).filter_map(cone).collect()
    }

    /// By row and row left out, what changes no motion.
    fn directions(&self, spot: Spot<'_>, rows: &[RowOf], kept: usize) -> Result<DMatrix<f64>, Reason> {
        let tie = |(place, row): (usize, &RowOf)| {
            let RowOf::Pair(pair) = *row else { return None };
            let slides = !spot.mode.grip(pair)?.is_still();
            Some((place, RowOf::Slip(pair), self.tie(spot.mode, pair).filter(|_| slides)?))
        };
        let tied: Vec<(usize, RowOf, Expr)> = rows.iter().enumerate().filter_map(tie).collect();
        let along = tied.iter().map(|(_, row, _)| *row);
        let numbered: Vec<(usize, RowOf)> = rows.iter().copied().chain(along).enumerate().collect();
        let numbers = self.numbers_of(spot.mode, &numbered, spot.time, spot.states, spot.inputs)?;
        // In these units a unit of each is as much kinetic energy.
        let unit = numbers.mass.map(|mass| if mass > 0.0 { 1.0 / libm::sqrt(mass) } else { 1.0 });
        let all = DMatrix::from_diagonal(&unit) * numbers.gradient.dense().transpose();
        let mut forces = all.columns(0, rows.len()).into_owned();
        let ties: Vec<Expr> = tied.iter().map(|(.., tie)| tie.clone()).collect();
        let ties = self.values(&ties, spot.mode, spot.time, spot.states, spot.inputs)?;
        for (index, ((place, ..), tie)) in tied.iter().zip(ties).enumerate() {
            forces.column_mut(*place).axpy(tie, &all.column(rows.len() + index), 1.0);
        }
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
    fn range(&self, spot: Spot<'_>, open: &Redundancy, formula: &Expr) -> Result<Option<Range>, Reason> {
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
            return Ok(is_open.then_some(Range::ANY));
        }
        if slopes.amax() == 0.0 {
            return Ok(None);
        }
        let forces: Vec<Expr> = open.symbols.iter().cloned().map(Expr::from).collect();
        let (found, forces) = (values(std::slice::from_ref(formula))?[0], values(&forces)?);
        let of_cones = |of: fn(&Cone) -> &Expr| {
            values(&open.cones.iter().map(|cone| of(cone).clone()).collect::<Vec<_>>())
        };
        let (friction, normal) = (of_cones(|cone| &cone.friction)?, of_cones(|cone| &cone.normal)?);
        let limits = open.limits(&forces, [&friction, &normal]);
        let [down, up] = [-&slopes, slopes].map(|slopes| limits.farthest(&slopes));
        let blur = NOTHING * constant.amax() * forces.amax();
        // Feet that nothing may load are redundant, and bear nothing all the same.
        let is_open = down + up > blur;
        let [least, greatest] =
            [found - down, found + up].map(|end| if end.abs() > blur || !is_open { end } else { 0.0 });
        Ok(Some(Range { spread: Spread { least, greatest }, is_open }))
    }
}

fn opened(range: Option<Range>) -> Option<Spread> {
    range.filter(|range| range.is_open).map(|range| range.spread)
}

/// Pairs that stay on a surface without a force.
fn idle(mode: &Mode) -> impl Iterator<Item = usize> {
    let idle = mode.contacts.iter().filter(|(_, contact_mode)| *contact_mode == ContactMode::Idle);
    idle.map(|(pair, _)| *pair)
}

/// Pairs that do not slip and whose friction is not what keeps them from it: they have none, or as much as there can be.
fn borne(mode: &Mode) -> impl Iterator<Item = usize> {
    let borne = mode.grips.iter().filter(|(_, grip)| matches!(grip, Grip::Follows | Grip::Strains(_)));
    borne.map(|(pair, _)| *pair)
}
