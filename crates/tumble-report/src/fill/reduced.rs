//! Equations of motion without the forces of joints and lasting contacts, where the conditions that these hold can be solved for
//! accelerations by dividing by numbers and parameters only.
//!
//! The conditions `J a + b = 0` give `a = T q + c` with independent accelerations q; since the forces do no work on what T moves,
//! `T^T M (T q + c) = T^T F` with the other forces F (d'Alembert's principle). A sliding ladder becomes `phi'' = 3 g/(2 L) sin phi`.

use tumble_expr::{Expr, Substitution, Symbol, is_identically_zero};
use tumble_mech::{Equations, Law, Mode, Term};
use tumble_notation::Notation;
use tumble_scene::Study;

use super::{pivots, sum, zeros};
use crate::results::Case;

/// A factor of less is the rounding of zero: those of conditions are components of unit vectors.
const LEAST_FACTOR: f64 = 1e-9;

/// An acceleration with its inertia and the applied force, or torque, in its direction.
struct Direction {
    body: usize,
    symbol: Symbol,
    inertia: Expr,
    force: Expr,
}

/// An equation of motion: `inertia symbol = right`.
pub(super) struct Reduced {
    /// Index of the body.
    pub(super) body: usize,
    /// The acceleration.
    pub(super) symbol: Symbol,
    /// What it is multiplied by.
    pub(super) inertia: Expr,
    /// The rest.
    pub(super) right: Expr,
}

/// What conditions make of accelerations.
pub(super) struct Solved {
    /// Equations of motion, one for each independent acceleration.
    pub(super) motion: Vec<Reduced>,
    /// The other accelerations, each by one condition: body, symbol, formula.
    pub(super) follow: Vec<(usize, Symbol, Expr)>,
}

/// The equations of all bodies that conditions hold in a mode; `None` where they hold none or cannot be solved so.
pub(super) fn of(study: &Study, case: &Case, mode: &Mode, conditions: &[Expr]) -> Option<Solved> {
    let bodies: Vec<usize> = (0..study.model.bodies.len())
        .filter(|body| !case.run.equations.shown_constraints(mode, *body).is_empty())
        .collect();
    let directions: Vec<Direction> =
        bodies.iter().flat_map(|body| directions(study, case, mode, *body)).collect();
    let turning = pivots::accelerations(study, case);
    let conditions: Vec<Expr> = conditions.iter().map(|condition| turning.apply(condition)).collect();
    let (given, by_one) = eliminated(study, &directions, conditions)?;
    let solved = |symbol: &Symbol| given.iter().any(|(known, _)| known == symbol);
    let free: Vec<&Direction> = directions.iter().filter(|one| !solved(&one.symbol)).collect();
    let motion = free.iter().map(|along| projected(&directions, &given, along));
    let follow = by_one.iter().map(|(symbol, formula)| {
        let body = directions.iter().find(|one| one.symbol == *symbol).map_or(0, |one| one.body);
        (body, symbol.clone(), formula.clone())
    });
    Some(Solved { motion: motion.collect(), follow: follow.collect() })
}

/// The accelerations of a body that are not those of another: of its centre and about it, or about its pivot.
fn directions(study: &Study, case: &Case, mode: &Mode, body: usize) -> Vec<Direction> {
    let equations = &case.run.equations;
    let (mass, kinematics) = (equations.mass_properties(body), study.model.bodies[body].kinematics());
    let terms = applied(equations, mode, body);
    if let Some(pivot) = study.model.pivot_of(&study.model.bodies[body].name) {
        let force = pivots::torque(case, (body, pivot), &terms);
        let inertia = pivots::inertia(case, body, pivot);
        return vec![Direction { body, symbol: kinematics.alpha_symbol(), inertia, force }];
    }
    let [ax, ay] = kinematics.acceleration_symbols();
    let along = |symbol: Symbol, inertia: &Expr, force: Expr| Direction {
        body,
        symbol,
        inertia: inertia.clone(),
        force,
    };
    vec![
        along(ax, &mass.mass, sum(terms.iter().map(|term| term.force.x().clone()))),
        along(ay, &mass.mass, sum(terms.iter().map(|term| term.force.y().clone()))),
        along(kinematics.alpha_symbol(), &mass.inertia, sum(terms.iter().map(Term::torque))),
    ]
}

/// What acts on a body beside joints and rigid contacts.
fn applied(equations: &Equations, mode: &Mode, body: usize) -> Vec<Term> {
    let is_held = |term: &Term| match term.law {
        Law::Reaction => true,
        Law::Contact => equations.pairs().iter().any(|pair| pair.name == term.load && pair.law.is_rigid()),
        _ => false,
    };
    let terms = equations.shown_terms(mode).into_iter();
    terms.filter(|term| term.body == body && !is_held(term)).collect()
}

/// An acceleration with its formula.
type Known = (Symbol, Expr);

/// Conditions solved for one acceleration each: by the independent ones, and as each condition says it, where in a chain the next link
/// follows from the one before.
fn eliminated(
    study: &Study,
    directions: &[Direction],
    conditions: Vec<Expr>,
) -> Option<(Vec<Known>, Vec<Known>)> {
    let mut given: Vec<Known> = vec![];
    let mut by_one: Vec<Known> = vec![];
    let mut left: Vec<(Expr, Expr)> =
        conditions.into_iter().map(|condition| (condition.clone(), condition)).collect();
    while let Some((row, symbol, factor)) = pivot(study, directions, &left, &given) {
        let (written, condition) = left.remove(row);
        let formula = solved_for(&condition, &symbol, &factor);
        let mut known = Substitution::default();
        known.insert(symbol.clone(), formula.clone());
        left = left.into_iter().map(|(written, other)| (written, known.apply(&other))).collect();
        given = given.iter().map(|(other, formula)| (other.clone(), known.apply(formula))).collect();
        let is_alike = is_identically_zero(&simple(&(written.derivative(&symbol) - &factor)));
        by_one.push((
            symbol.clone(),
            if is_alike { solved_for(&written, &symbol, &factor) } else { formula.clone() },
        ));
        given.push((symbol, formula));
    }
    let are_met = left.iter().all(|(_, condition)| is_identically_zero(&simple(condition)));
    (are_met && !given.is_empty()).then_some((given, by_one))
}

/// A linear condition solved for a symbol, which has this factor in it.
fn solved_for(condition: &Expr, symbol: &Symbol, factor: &Expr) -> Expr {
    -(zeros([symbol.clone()]).apply(condition) / factor)
}

/// A condition, an acceleration of a centre in it, and its factor, which does not change; turning is kept.
fn pivot(
    study: &Study,
    directions: &[Direction],
    conditions: &[(Expr, Expr)],
    given: &[Known],
) -> Option<(usize, Symbol, Expr)> {
    let is_free = |symbol: &Symbol| given.iter().all(|(known, _)| known != symbol);
    let is_of_centre = |symbol: &Symbol| symbol.dimension == tumble_expr::Dimension::ACCELERATION;
    conditions.iter().enumerate().find_map(|(row, (_, condition))| {
        // In a chain each link follows from the one before.
        let candidates = directions.iter().rev().map(|one| &one.symbol);
        candidates.filter(|symbol| is_of_centre(symbol) && is_free(symbol)).find_map(|symbol| {
            let factor = simple(&condition.derivative(symbol));
            let size = study.number(&factor).ok().filter(|_| factor.symbols().is_empty());
            size.is_some_and(|size| size.abs() > LEAST_FACTOR).then(|| (row, symbol.clone(), factor))
        })
    })
}

/// A formula in its short form, in which nothing stands that falls away; as it is where it has none.
pub(super) fn simple(formula: &Expr) -> Expr {
    let shown = Notation::new().without_automatic_names().formula(formula);
    let line = shown.ok().and_then(|shown| shown.lines.into_iter().next());
    line.map_or_else(|| formula.clone(), |line| line.formula)
}

/// Sum of inertias and forces along one independent acceleration.
fn projected(directions: &[Direction], given: &[(Symbol, Expr)], along: &Direction) -> Reduced {
    let acceleration = |one: &Direction| {
        let found = given.iter().find(|(symbol, _)| *symbol == one.symbol);
        found.map_or_else(|| one.symbol.clone().into(), |(_, formula)| formula.clone())
    };
    let (mut inertia, mut right) = (Expr::zero(), Expr::zero());
    for one in directions {
        let whole: Expr = acceleration(one);
        let share = whole.derivative(&along.symbol);
        if is_identically_zero(&share) {
            continue;
        }
        inertia = inertia + &one.inertia * (&share * &share);
        let rest = zeros([along.symbol.clone()]).apply(&whole);
        right = right + &share * (&one.force - &one.inertia * rest);
    }
    Reduced { body: along.body, symbol: along.symbol.clone(), inertia: simple(&inertia), right }
}
