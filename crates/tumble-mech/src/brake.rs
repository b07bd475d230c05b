//! # Law
//! A load may be a part that brakes: `F = A + B sign(s)` with a rate s, as a user writes dry friction, `-mu N sign(v)`. While s is
//! not zero its sign is what it says. Where s is zero and each sign leads to the other, s stays zero, and the sign is as much between -1
//! and 1 as keeps it so: `s' = 0` is one row more, whose multiplier is `nu = W sigma`, with `B = D W` where D knows no forces and W has
//! all of them that are found with the motion. It holds as long as `|nu| <= |W|`.
//! # Symbols and units
//! s (m/s or 1/s), sigma the sign, nu and W (N, or 1 where B knows no such force), D what the load is for a unit of nu.
//! # Sign and frame
//! World axes; a load brakes if its positive sign makes s fall.
//! # Validity
//! B is linear in the sign, and all loads with one s have one W. What is not so is left to the integrator, which refuses what stays at zero;
//! so is what drives instead of braking.
//! # Source
//! Coulomb's law as a differential inclusion (Filippov 1988).
//! # Checked by
//! `tests/brakes.rs`: stops, break-away, a slope, an oscillator, a load that grows, against closed forms and against the friction of surfaces.

use std::collections::HashSet;

use tumble_expr::units::{M, N};
use tumble_expr::{Dimension, Expr, Symbol, Vector, is_identically_zero};
use tumble_ode::Direction;

use crate::contact::{Change, Grip, Watched, Way};
use crate::coordinates::Measure;
use crate::equations::Equations;
use crate::kinematics::Kinematics;
use crate::mode::Mode;
use crate::parameters::time_symbol;
use crate::record::Happening;
use crate::row::{Row, Wrench};
use crate::term::{Law, Term};

/// Forces where what does not depend on them is looked at, SI units: primes, so that nothing cancels there.
const SOMEWHERE: [i32; 6] = [3, 7, 13, 19, 29, 37];

/// A sign of a rate in loads.
#[derive(Clone, Debug)]
pub(crate) struct Brake {
    /// Stands for the sign in the loads.
    pub(crate) sign: Symbol,
    /// s
    pub(crate) rate: Expr,
    /// That s stays zero, kept by nu.
    pub(crate) row: Row,
    /// What a unit of nu is.
    pub(crate) pushes: Vec<Wrench>,
    /// What the loads do by nu.
    pub(crate) terms: Vec<Term>,
    /// W
    limit: Expr,
    /// Whether W is never negative.
    is_normal: bool,
    /// Bodies that the loads act on, or that s is of.
    pub(crate) bodies: Vec<usize>,
}

/// The brakes in some loads, whose signs are replaced by their symbols.
pub(crate) fn all(terms: &mut [Term], motions: &[&Kinematics], forces: &HashSet<Symbol>) -> Vec<Brake> {
    let mut rates: Vec<Expr> = vec![];
    for term in terms.iter().filter(|term| matches!(term.law, Law::Force | Law::Torque)) {
        for rate in parts(term).iter().flat_map(Expr::signs) {
            // One rate of several loads is one brake.
            let known = rates.iter().any(|known| is_identically_zero(&(known - &rate)));
            rates.extend((!known && is_rate(&rate, motions, forces)).then_some(rate));
        }
    }
    let mut found = vec![];
    for rate in rates {
        let maker = Maker { rate: &rate, motions, forces, index: found.len() };
        if let Some((brake, loads)) = maker.brake(terms) {
            loads.into_iter().for_each(|(index, term)| terms[index] = term);
            found.push(brake);
        }
    }
    found
}

/// Components along x and y, and the couple.
fn parts(term: &Term) -> [Expr; 3] {
    [term.force.x().clone(), term.force.y().clone(), term.couple.clone()]
}

/// Whether a formula is the rate of something, which forces can stop.
fn is_rate(formula: &Expr, motions: &[&Kinematics], forces: &HashSet<Symbol>) -> bool {
    let used = formula.symbols();
    let accelerations =
        motions.iter().flat_map(|body| body.acceleration_symbols().into_iter().chain([body.alpha_symbol()]));
    let is_known = !used.iter().any(|symbol| forces.contains(symbol))
        && !accelerations.into_iter().any(|symbol| used.contains(&symbol));
    let is_measured = [Dimension::SPEED, Dimension::ANGULAR_RATE].map(Ok).contains(&formula.dimension());
    is_known && is_measured && !gradients(formula, motions).is_empty()
}

/// By body, how a rate follows from its velocities.
fn gradients(rate: &Expr, motions: &[&Kinematics]) -> Vec<Wrench> {
    let used = rate.symbols();
    let of = |(body, motion): (usize, &&Kinematics)| {
        let [vx, vy] = motion.velocity_symbols();
        let all = [vx, vy, motion.omega_symbol()];
        if !all.iter().any(|symbol| used.contains(symbol)) {
            return None;
        }
        let [x, y, couple] = all.map(|symbol| rate.derivative(&symbol));
        let none = || Vector::planar(Expr::zero(), Expr::zero());
        Some(Wrench { body, arm: none(), force: Vector::planar(x, y), couple })
    };
    motions.iter().enumerate().filter_map(of).collect()
}

/// A brake being made.
struct Maker<'a> {
    rate: &'a Expr,
    motions: &'a [&'a Kinematics],
    forces: &'a HashSet<Symbol>,
    index: usize,
}

/// B as D and W.
struct Factors {
    /// By load, along x and y and the couple.
    directions: Vec<[Expr; 3]>,
    limit: Expr,
    dimension: Dimension,
    is_normal: bool,
}

impl Maker<'_> {
    /// The brake, and the loads with its symbol.
    fn brake(&self, terms: &[Term]) -> Option<(Brake, Vec<(usize, Term)>)> {
        let sign = Symbol::new(format!("sign {}", self.index), Dimension::NONE);
        let own = terms.iter().enumerate().filter(|(_, term)| matches!(term.law, Law::Force | Law::Torque));
        let replaced = own.map(|(index, term)| (index, self.replaced(term, &sign)));
        let uses = |term: &Term| parts(term).iter().any(|part| part.symbols().contains(&sign));
        let loads: Vec<(usize, Term)> = replaced.filter(|(_, term)| uses(term)).collect();
        let window = loads.first()?.1.window;
        let slopes = loads.iter().map(|(_, term)| self.slopes(term, &sign)).collect::<Option<Vec<_>>>()?;
        let factors =
            self.factors(&slopes).filter(|_| loads.iter().all(|(_, term)| term.window == window))?;
        let force = Symbol::new(format!("braking {}", self.index), factors.dimension);
        let row = self.row(force.clone());
        let pushes: Vec<Wrench> =
            loads.iter().zip(factors.directions).map(|((_, term), push)| wrench(term, push)).collect();
        let terms =
            loads.iter().zip(&pushes).map(|((_, term), push)| pushed(term, push, &force.clone().into()));
        let mut bodies: Vec<usize> = row.wrenches.iter().chain(&pushes).map(|wrench| wrench.body).collect();
        bodies.sort_unstable();
        bodies.dedup();
        let Factors { limit, is_normal, .. } = factors;
        let terms = terms.collect();
        Some((Brake { sign, rate: self.rate.clone(), row, pushes, terms, limit, is_normal, bodies }, loads))
    }

    fn replaced(&self, term: &Term, sign: &Symbol) -> Term {
        let by = Expr::from(sign.clone());
        let of = |formula: &Expr| formula.with_sign(self.rate, &by);
        Term { force: term.force.map(of), couple: of(&term.couple), ..term.clone() }
    }

    /// B of a load; `None` where it is not linear in the sign.
    fn slopes(&self, term: &Term, sign: &Symbol) -> Option<[Expr; 3]> {
        let only = HashSet::from([sign.clone()]);
        let parts = parts(term);
        let is_linear = parts.iter().all(|part| part.nonlinear_part(&only).is_none());
        is_linear.then(|| parts.map(|part| part.derivative(sign)))
    }

    /// B as directions that know no forces, times what has them all; `None` where it is no such product.
    fn factors(&self, slopes: &[[Expr; 3]]) -> Option<Factors> {
        let used = slopes.iter().flatten().flat_map(Expr::symbols);
        let mut read: Vec<Symbol> = used.filter(|symbol| self.forces.contains(symbol)).collect();
        read.sort_unstable_by(|a, b| a.name.cmp(&b.name));
        read.dedup();
        let Some(first) = read.first() else {
            let directions = slopes.to_vec();
            let (limit, dimension) = (Expr::one(), Dimension::NONE);
            return Some(Factors { directions, limit, dimension, is_normal: true });
        };
        if slopes.iter().flatten().any(|part| part.nonlinear_part(self.forces).is_some()) {
            return self.factors_of_any(slopes, &read);
        }
        let without = |formula: &Expr| {
            let mut none = tumble_expr::Substitution::default();
            read.iter().for_each(|symbol| none.insert(symbol.clone(), Expr::zero()));
            none.apply(formula)
        };
        // Of each component what it is for a unit of each force, and then what it is without any.
        let by_force = |part: &Expr| -> Vec<Expr> {
            read.iter().map(|symbol| part.derivative(symbol)).chain([without(part)]).collect()
        };
        let all: Vec<[Vec<Expr>; 3]> = slopes.iter().map(|own| own.each_ref().map(by_force)).collect();
        let leading = all.iter().flatten().find(|part| !is_identically_zero(&part[0]))?;
        let is_multiple = |part: &Vec<Expr>| {
            let mut others = part.iter().zip(leading);
            others.all(|(own, of)| is_identically_zero(&(own * &leading[0] - of * &part[0])))
        };
        if !all.iter().flatten().all(is_multiple) {
            return None;
        }
        let share = |of: &Expr| match is_identically_zero(&(of - &leading[0])) {
            true => Expr::one(),
            false => of / &leading[0],
        };
        let alone = &leading[read.len()];
        let is_alone = is_identically_zero(alone);
        let limit = read.iter().zip(leading).map(|(symbol, of)| share(of) * Expr::from(symbol.clone()));
        let limit = limit.reduce(|sum, next| sum + next)?;
        let is_normal = is_alone
            && read.iter().zip(leading).all(|(symbol, of)| {
                symbol.name.ends_with(".normal") && is_identically_zero(&(of - &leading[0]))
            });
        Some(Factors {
            directions: all.iter().map(|own| own.each_ref().map(|part| part[0].clone())).collect(),
            limit: if is_alone { limit } else { limit + alone / &leading[0] },
            dimension: first.dimension,
            is_normal,
        })
    }

    /// The same where B is no sum of forces: it is the first part of it that has any, times directions.
    fn factors_of_any(&self, slopes: &[[Expr; 3]], read: &[Symbol]) -> Option<Factors> {
        let reads = |part: &&Expr| part.symbols().iter().any(|symbol| self.forces.contains(symbol));
        let leading = slopes.iter().flatten().find(reads)?;
        let mut somewhere = tumble_expr::Substitution::default();
        for (value, symbol) in SOMEWHERE.into_iter().cycle().zip(read) {
            let unit = if symbol.dimension == Dimension::TORQUE { 1 * N * M } else { 1 * N };
            somewhere.insert(symbol.clone(), value * unit);
        }
        let share = |part: &Expr| {
            if is_identically_zero(&(part - leading)) {
                return Some(Expr::one());
            }
            let share = part / leading;
            let is_fixed = |symbol: &Symbol| is_identically_zero(&share.derivative(symbol));
            read.iter().all(is_fixed).then(|| somewhere.apply(&share))
        };
        let shares = slopes.iter().map(|[x, y, couple]| Some([share(x)?, share(y)?, share(couple)?]));
        Some(Factors {
            directions: shares.collect::<Option<Vec<_>>>()?,
            limit: leading.clone(),
            dimension: leading.dimension().ok()?,
            is_normal: false,
        })
    }

    fn row(&self, multiplier: Symbol) -> Row {
        let is_speed = self.rate.dimension() == Ok(Dimension::SPEED);
        let measure = if is_speed { Measure::Length } else { Measure::Angle };
        let (rate, acceleration) = (self.rate.clone(), self.acceleration());
        let wrenches = gradients(self.rate, self.motions);
        Row { multiplier, wrenches, position: rate.clone(), rate, acceleration, measure }
    }

    /// s'
    fn acceleration(&self) -> Expr {
        let used = self.rate.symbols();
        let changes = self.motions.iter().flat_map(|body| {
            let ([x, y], [vx, vy], [ax, ay]) =
                (body.position_symbols(), body.velocity_symbols(), body.acceleration_symbols());
            let (turns, turning) = (body.omega_symbol(), body.alpha_symbol());
            [
                (x, vx.clone()),
                (y, vy.clone()),
                (body.angle_symbol(), turns.clone()),
                (vx, ax),
                (vy, ay),
                (turns, turning),
            ]
        });
        let changes = changes.filter(|(symbol, _)| used.contains(symbol));
        let by_time = self.rate.derivative(&time_symbol());
        changes
            .fold(by_time, |sum, (symbol, change)| sum + self.rate.derivative(&symbol) * Expr::from(change))
    }
}

fn wrench(term: &Term, [x, y, couple]: [Expr; 3]) -> Wrench {
    Wrench { body: term.body, arm: term.arm.clone(), force: Vector::planar(x, y), couple }
}

fn pushed(term: &Term, push: &Wrench, force: &Expr) -> Term {
    Term { force: push.force.map(|part| part * force), couple: &push.couple * force, ..term.clone() }
}

impl Brake {
    /// Name by which the integrator knows what is watched of it.
    pub(crate) fn guard_name(&self, watched: Watched) -> String {
        let what = match watched {
            Watched::Cone(Way::Forward) => "forward",
            Watched::Cone(Way::Backward) => "backward",
            _ => "rate",
        };
        format!("{}.{what}", self.sign.name)
    }

    /// The rate while it is not held, what is left of nu on each side while it is.
    pub(crate) fn watched(&self, watched: Watched) -> Expr {
        let Watched::Cone(way) = watched else { return self.rate.clone() };
        let left = &self.limit - way.sign() * Expr::from(self.row.multiplier.clone());
        if self.is_normal { left } else { self.limit.sign() * left }
    }

    /// nu and W.
    pub(crate) fn held(&self) -> [Expr; 2] {
        [self.row.multiplier.clone().into(), self.limit.clone()]
    }

    /// What s is the sum of, without signs: its rounding is relative to that.
    pub(crate) fn size(&self, motions: &[&Kinematics]) -> Expr {
        self.row.wrenches.iter().fold(Expr::zero(), |sum, of| {
            let motion = motions[of.body];
            let [vx, vy] = motion.velocity_symbols().map(Expr::from);
            sum + (of.force.x() * vx).abs() + (of.force.y() * vy).abs() + (&of.couple * motion.omega()).abs()
        })
    }
}

impl Equations {
    /// What people call a brake: its first load.
    pub fn brake_name(&self, brake: usize) -> &str {
        &self.brakes()[brake].terms[0].load
    }

    /// What people call so, by any of its loads: `rub.sticks`.
    pub(crate) fn named_brake(&self, name: &str) -> Option<Happening> {
        let (load, word) = name.rsplit_once('.')?;
        let changes = [(Change::Sticks, true), (Change::Slides, false)];
        let (_, sticks) = changes.into_iter().find(|(change, _)| change.word() == word)?;
        let is_of = |brake: &Brake| brake.terms.iter().any(|term| term.load == load);
        self.brakes().iter().position(is_of).map(|brake| Happening::Brake { brake, sticks })
    }

    /// Brakes that act in a mode.
    pub(crate) fn acting_brakes(&self, mode: &Mode) -> Vec<usize> {
        let acts = |brake: &Brake| {
            let window = brake.terms[0].window.is_none_or(|window| mode.windows[window]);
            window && brake.bodies.iter().all(|body| mode.has(*body))
        };
        self.brakes().iter().enumerate().filter(|(_, brake)| acts(brake)).map(|(index, _)| index).collect()
    }

    /// What is watched of the brakes: their guards come after those of the pairs that touch.
    pub(crate) fn watched_brakes(&self, mode: &Mode) -> Vec<(usize, Watched, Direction)> {
        let watched = |brake: usize| match mode.brake(brake) {
            None => vec![(brake, Watched::Slip, Direction::Both)],
            Some(Grip::Slides(Way::Forward)) => vec![(brake, Watched::Slip, Direction::Falling)],
            Some(Grip::Slides(Way::Backward)) => vec![(brake, Watched::Slip, Direction::Rising)],
            Some(_) => [Way::Forward, Way::Backward]
                .map(|way| (brake, Watched::Cone(way), Direction::Falling))
                .to_vec(),
        };
        self.acting_brakes(mode).into_iter().flat_map(watched).collect()
    }

    /// Whether a state is the rate of a brake that holds.
    pub(crate) fn is_braked(&self, mode: &Mode, state: &Symbol) -> bool {
        let is_it = |brake: usize| matches!(self.brakes()[brake].rate.node(), tumble_expr::Node::Symbol(own) if own == state);
        mode.braked().any(is_it)
    }
}
