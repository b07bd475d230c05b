//! Newton's laws for a body, each load by its symbol.

use crate::report::{Block, Definition};
use tumble_expr::{Dimension, Expr, Symbol, is_identically_zero};
use tumble_mech::{Equations, Law, Term};
use tumble_notation::{Left, Math};
use tumble_scene::Study;

use super::forces::{direction, is_on_other};
use super::names::{Names, math};
use super::passed::Passed;
use super::sum;
use crate::figures::symbols;
use crate::results::Case;

/// A component of a contact of more signs than these is said by its direction.
const MOST_SIGNS: usize = 24;

/// `M A = sum F` by components and `I alpha = sum tau`, each load by its symbol.
/// What their letters mean stands at the first body: `said` has the letters that are known.
pub(super) fn of(
    study: &Study,
    names: &Names,
    passed: &[Passed<'_>],
    body: usize,
    said: &mut Vec<String>,
) -> Block {
    let case = passed[0].case;
    let terms = passed.iter().flat_map(|Passed { case, mode }| case.run.equations.shown_terms(mode));
    let terms = distinct(terms.filter(|term| term.body == body).collect());
    let mut block = laws_of(study, names, case, (body, &terms), "Newton's laws");
    let is_new = |definition: &Definition| !said.contains(&definition.symbol.text);
    let new: Vec<Definition> = letters(study, names, case, body).into_iter().filter(is_new).collect();
    said.extend(new.iter().map(|definition| definition.symbol.text.clone()));
    block.definitions.splice(..0, new);
    block
}

/// The letters of the left sides.
fn letters(study: &Study, names: &Names, case: &Case, body: usize) -> Vec<Definition> {
    let kinematics = study.model.bodies[body].kinematics();
    let [along, _] = kinematics.acceleration_symbols();
    let turns = !is_identically_zero(&case.run.equations.mass_properties(body).inertia);
    let turning = kinematics.alpha_symbol();
    let all = [(true, along, "acceleration of the centre of mass"), (turns, turning, "angular acceleration")];
    let letter = |(_, symbol, meaning): (bool, Symbol, &str)| {
        let shown = names.shown(&symbol.name);
        let letter = Math::symbol(shown.split('_').next().unwrap_or(shown));
        Definition { symbol: math(&letter), meaning: meaning.into() }
    };
    all.into_iter().filter(|(has, ..)| *has).map(letter).collect()
}

fn laws_of(study: &Study, names: &Names, case: &Case, (body, terms): (usize, &[Term]), title: &str) -> Block {
    let kinematics = study.model.bodies[body].kinematics();
    let mass = case.run.equations.mass_properties(body);
    let component = |axis: usize| {
        let parts = terms.iter().filter(|term| !is_identically_zero(&term.force[axis]));
        sum(parts.map(|term| component(study, names, &case.run.equations, (term, axis))))
    };
    let turns =
        |term: &&Term| !is_identically_zero(&term.torque()) && names.formula(&term.torque()).text != "0";
    let torque = terms.iter().filter(turns);
    let torque = torque.map(|term| {
        let name = symbols::torque_of(study, (&term.load, term.law), body);
        Expr::from(Symbol::new(name, Dimension::TORQUE))
    });
    let torque = sum(torque);
    let [ax, ay] = kinematics.acceleration_symbols();
    let left = |factor: &Expr, symbol: &Symbol| Left::times(factor, Math::symbol(names.shown(&symbol.name)));
    let (m, inertia) = (&names.mass(&mass.mass), &mass.inertia);
    // The right sides are accelerations: the factor of the left side is multiplied on.
    let mut lines = vec![(left(m, &ax), component(0) / m), (left(m, &ay), component(1) / m)];
    if !is_identically_zero(inertia) {
        lines.push((left(inertia, &kinematics.alpha_symbol()), torque / inertia));
    }
    names.with_inertia(study, body, inertia).block(title, &lines)
}

/// A component of a force: of a contact as its direction says it, if that is short; else by its symbol.
fn component(study: &Study, names: &Names, equations: &Equations, (term, axis): (&Term, usize)) -> Expr {
    let force = symbols::force(study, &term.load, term.law);
    let own = term.force[axis].symbols();
    let is_own = |symbol: &Symbol| is_multiplier(study, symbol) || names.shown(&symbol.name) == force;
    let parameters = study.model.parameters.symbols();
    let is_given = |symbol: &Symbol| is_own(symbol) || parameters.contains(symbol);
    let letter = direction(study, equations, term);
    // What is along an axis has its symbol, with the sign that it acts with; the weight is what everybody knows.
    let is_along = !own.is_empty() && own.iter().all(is_own) || term.law == Law::Weight;
    let is_short =
        || own.iter().all(is_given) && names.formula(&term.force[axis]).text.chars().count() <= MOST_SIGNS;
    if is_along || (letter.is_some() && own.iter().any(is_own) && is_short()) {
        return term.force[axis].clone();
    }
    let below = |symbol: &str| symbols::below(symbol, ["x", "y"][axis]);
    let Some(letter) = letter else { return Symbol::new(below(&force), Dimension::FORCE).into() };
    let along: Expr = Symbol::new(below(&letter), Dimension::NONE).into();
    let along = Expr::from(Symbol::new(force, Dimension::FORCE)) * along;
    if is_on_other(equations, term) { -along } else { along }
}

/// Whether a symbol stands for a force that follows from conditions.
fn is_multiplier(study: &Study, symbol: &Symbol) -> bool {
    let contacts = study.model.pairs();
    let joints = study.model.joints.iter().flat_map(tumble_mech::Joint::multipliers);
    let pivots = study.model.pivots.iter().flat_map(tumble_mech::Pivot::force_symbols);
    contacts.iter().any(|pair| pair.force_symbol() == *symbol)
        || joints.chain(pivots).any(|known| known == *symbol)
}

/// The first term of each load.
fn distinct(terms: Vec<Term>) -> Vec<Term> {
    let mut found: Vec<Term> = vec![];
    for term in terms {
        if !found.iter().any(|known| known.load == term.load) {
            found.push(term);
        }
    }
    found
}
