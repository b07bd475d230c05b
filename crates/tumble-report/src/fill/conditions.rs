//! What joints and contacts keep at zero, written as shortly as can be.

use tumble_expr::{Expr, Symbol, is_identically_zero};
use tumble_mech::{ContactMode, Equations, Kinematics, Mode, Pair};
use tumble_notation::Notation;
use tumble_scene::Study;

use super::zeros;

/// Signs that a fraction is worth.
const FRACTION: usize = 10;

/// The last body that a condition is about.
pub(super) fn last_of(study: &Study, condition: &Expr) -> Option<usize> {
    let symbols = condition.symbols();
    let is_of = |body: &str| {
        symbols.iter().any(|symbol| symbol.name.split_once('.').is_some_and(|(stem, _)| stem == body))
    };
    study.model.bodies.iter().rposition(|body| is_of(&body.name))
}

/// A multiple of what is zero that is written with the fewest signs: without halves, and without lengths that are in all of it.
pub(super) fn shortest(study: &Study, notation: &Notation, condition: &Expr) -> Expr {
    let sizes = sizes(study, condition);
    let multiples = |formula: &Expr| {
        let whole = [-1, 2, -2, 3, -3, 4, -4, 6, -6].map(|factor| factor * formula);
        let scaled = sizes.iter().flat_map(|size| [formula * size, formula / size]);
        whole.into_iter().chain([2, 3, 4].map(|factor| formula / factor)).chain(scaled).collect::<Vec<_>>()
    };
    let mut best = (written(notation, condition), condition.clone());
    loop {
        let with_length =
            multiples(&best.1).into_iter().map(|formula| (written(notation, &formula), formula));
        match with_length.min_by_key(|(signs, _)| *signs).filter(|(signs, _)| *signs < best.0) {
            Some(shorter) => best = shorter,
            None => return best.1,
        }
    }
}

/// Conditions with the sums and differences of two in their place where these are shorter: of two corners on a slope, how their
/// middle moves and how the body turns.
pub(super) fn combined(study: &Study, notation: &Notation, mut conditions: Vec<Expr>) -> Vec<Expr> {
    let dimension = |formula: &Expr| formula.dimension().ok();
    for later in 0..conditions.len() {
        for earlier in 0..later {
            let [one, other] = [&conditions[earlier], &conditions[later]];
            if dimension(one) != dimension(other) {
                continue;
            }
            // Any two of these say what the two have said.
            let mut four = [one.clone(), other.clone(), one + other, one - other];
            four.sort_by_cached_key(|formula| written(notation, formula));
            let shortest = |formula: &Expr| shortest(study, notation, formula);
            (conditions[earlier], conditions[later]) = (shortest(&four[0]), shortest(&four[1]));
        }
    }
    conditions
}

/// The contacts that rest of a body, if all are with one plane whose normal does not change.
pub(super) fn on_one_plane<'e>(
    study: &Study,
    equations: &'e Equations,
    mode: &Mode,
    body: usize,
) -> Option<Vec<&'e Pair>> {
    let own = mode.contacts.iter().map(|(pair, contact)| (&equations.pairs()[*pair], contact));
    let own: Vec<_> = own.filter(|(pair, _)| pair.body == body || pair.other == Some(body)).collect();
    let on_planes = resting_on_planes(study, equations, mode, body);
    let [first, ..] = on_planes[..] else { return None };
    let are_same = on_planes.iter().all(|other| are_of_one_plane(first, other));
    let are_all = own.iter().all(|(pair, contact)| {
        **contact == ContactMode::Idle || on_planes.iter().any(|known| known.name == pair.name)
    });
    (are_same && are_all).then_some(on_planes)
}

/// Whether a body lies on one plane, whose normal does not change, with two of its points: then it does not turn.
pub(super) fn lies(study: &Study, equations: &Equations, mode: &Mode, body: usize) -> bool {
    let pairs = resting_on_planes(study, equations, mode, body);
    pairs
        .iter()
        .enumerate()
        .any(|(index, one)| pairs[..index].iter().any(|other| are_of_one_plane(one, other)))
}

fn are_of_one_plane(one: &Pair, other: &Pair) -> bool {
    let off = &one.normal - &other.normal;
    one.rule == other.rule && off.components().iter().all(is_identically_zero)
}

fn resting_on_planes<'e>(study: &Study, equations: &'e Equations, mode: &Mode, body: usize) -> Vec<&'e Pair> {
    let parameters = study.model.parameters.symbols();
    let is_fixed = |part: &Expr| part.symbols().iter().all(|symbol| parameters.contains(symbol));
    let rests = |contact: &ContactMode| matches!(contact, ContactMode::Resting | ContactMode::Settling);
    let on_planes = |pair: &&Pair| {
        pair.body == body && pair.other.is_none() && pair.normal.components().iter().all(is_fixed)
    };
    let pairs = mode.contacts.iter().filter(|(_, contact)| rests(contact));
    pairs.map(|(pair, _)| &equations.pairs()[*pair]).filter(on_planes).collect()
}

/// The conditions of a body that does not turn: that it does not, and what is left of the others, each once.
pub(super) fn without_turning(kinematics: &Kinematics, conditions: Vec<Expr>) -> Vec<Expr> {
    let still = zeros([kinematics.omega_symbol(), kinematics.alpha_symbol()]);
    let mut kept: Vec<Expr> = vec![kinematics.alpha()];
    for condition in conditions.iter().map(|condition| still.apply(condition)) {
        let is_said = |known: &Expr| is_identically_zero(&(known - &condition));
        if !is_identically_zero(&condition) && !kept.iter().any(is_said) {
            kept.push(condition);
        }
    }
    kept
}

/// How long a formula of accelerations is, in signs.
fn written(notation: &Notation, formula: &Expr) -> usize {
    // A fraction is read less easily than some more signs.
    let length = |text: String| text.chars().count() + FRACTION * text.matches('/').count();
    let notation = notation.clone().without_automatic_names();
    notation.formula(formula).map_or(usize::MAX, |shown| length(shown.text()))
}

/// The lengths in a formula that have names, and how much they differ: a ball in a bowl goes round at their difference.
fn sizes(study: &Study, formula: &Expr) -> Vec<Expr> {
    let symbols = formula.symbols();
    let is_size = |one: &Symbol| symbols.contains(one) && one.dimension == tumble_expr::Dimension::LENGTH;
    let named: Vec<Expr> =
        study.model.parameters.symbols().into_iter().filter(is_size).map(Expr::from).collect();
    let pairs =
        named.iter().enumerate().flat_map(|(index, one)| named[..index].iter().map(move |other| one - other));
    let differences: Vec<Expr> = pairs.collect();
    named.into_iter().chain(differences).collect()
}
