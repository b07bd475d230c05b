//! The laws of the impacts that happened: what they do to a body, what is given back, and how friction holds meanwhile.

use std::collections::BTreeSet;

use crate::report::{Block, Definition, Text, Typeset};
use tumble_expr::{Dimension, Expr, Symbol, Unary, is_identically_zero};
use tumble_mech::{ContactLaw, Friction, MultipleImpacts, Pair, Restitution, Rule, Source};
use tumble_notation::{Math, Operator};
use tumble_scene::Study;

use super::alike::listed;
use super::names::{Names, math, side};
use super::once::defined_once;
use super::words;
use crate::figures::symbols;
use crate::results::Case;

/// Letters of an impulse, of the arm to where it acts, and of the angular impulse of a couple.
const IMPULSE: &str = "J";
const ARM: &str = "r";
const COUPLE: &str = "H";

/// What impulses do to a body; nothing where there were none. What their letters mean stands where they come first: `said` has the letters that
/// are known.
pub(super) fn of_body(
    study: &Study,
    names: &Names,
    cases: &[Case],
    body: usize,
    said: &mut Vec<String>,
) -> Option<Block> {
    let impulses = cases.iter().flat_map(|case| case.run.events()).flat_map(|event| &event.record.impulses);
    let mut own = impulses.filter(|impulse| impulse.body == body).peekable();
    own.peek()?;
    let has_couples = own.any(|impulse| impulse.couple != 0.0);
    let (model_body, properties) = (&study.model.bodies[body], cases[0].run.equations.mass_properties(body));
    let velocity = match study.model.bodies.len() {
        1 => symbols::velocity(study, &model_body.name),
        _ => symbols::below(&symbols::velocity(study, &model_body.name), &model_body.name),
    };
    let turning = model_body.kinematics().omega_symbol();
    let own = names.of_body(body).with_inertia(study, body, &properties.inertia);
    let changes = |factor: &Expr, symbol: &str, by: Vec<Math>| {
        let change = Math::Row(vec![Math::Text("\u{394}".to_owned()), Math::symbol(symbol)]);
        let left = Math::Product(vec![side(own.notation(), factor), change]);
        math(&Math::equation(left, Math::Row(by)))
    };
    let sum = || Math::Text("\u{3a3}\u{2009}".to_owned());
    let mut lines =
        vec![changes(&names.mass(&properties.mass), &velocity, vec![sum(), Math::symbol(IMPULSE)])];
    let mut letters = vec![meant(&[IMPULSE], "impulse on it")];
    if !is_identically_zero(&properties.inertia) {
        let mut moment =
            vec![sum(), Math::symbol(ARM), Math::Operator(Operator::Cross), Math::symbol(IMPULSE)];
        letters.push(meant(&[ARM], "from the centre of mass to where it acts"));
        if has_couples {
            moment.extend([Math::Operator(Operator::Plus), sum(), Math::symbol(COUPLE)]);
            letters.push(meant(&[COUPLE], "angular impulse of a couple"));
        }
        lines.push(changes(&properties.inertia, names.shown(&turning.name), moment));
    }
    letters.retain(|letter| !said.contains(&letter.symbol.text));
    said.extend(letters.iter().map(|letter| letter.symbol.text.clone()));
    Some(Block { title: "In an impact".into(), lines, definitions: letters })
}

/// The laws of the contacts that struck, one block for all that strike alike.
pub(super) fn laws(study: &Study, names: &Names, cases: &[Case]) -> Vec<Block> {
    let mut found: Vec<(Vec<String>, Block)> = vec![];
    let struck = struck(study, cases);
    for pair in struck.pairs {
        let (who, block) = (who(study, pair), law(names, pair, struck.are_single));
        match found.iter_mut().find(|(_, known)| *known == block) {
            Some((all, _)) if all.contains(&who) => {}
            Some((all, _)) => all.push(who),
            None => found.push((vec![who], block)),
        }
    }
    let titled =
        |(who, block): (Vec<String>, Block)| Block { title: Text::from(listed(&who)).capitalised(), ..block };
    defined_once(found.into_iter().map(titled).collect())
}

/// What struck.
struct Struck<'a> {
    /// The rigid pairs with an impact.
    pairs: Vec<&'a Pair>,
    /// Whether each impact was by itself, and none at the same instant changed what came of it.
    are_single: bool,
}

fn struck<'a>(study: &Study, cases: &'a [Case]) -> Struck<'a> {
    let mut all: BTreeSet<usize> = BTreeSet::new();
    let mut are_single = true;
    for event in cases.iter().flat_map(|case| case.run.events()) {
        let at_once = event.record.impulses.iter().filter_map(|impulse| match impulse.source {
            Source::Pair(pair) => Some(pair),
            _ => None,
        });
        let at_once: BTreeSet<usize> = at_once.collect();
        are_single &= at_once.len() < 2;
        all.extend(at_once);
    }
    are_single |= study.model.multiple_impacts == MultipleImpacts::Sequential;
    let pairs = cases[0].run.equations.pairs();
    Struck { pairs: all.into_iter().map(|pair| &pairs[pair]).collect(), are_single }
}

/// Whose impacts these are.
fn who(study: &Study, pair: &Pair) -> String {
    let name = |body: usize| symbols::the(&study.model.bodies[body].name);
    match (pair.rule, pair.other) {
        (Rule::Bodies(_), Some(other)) if study.model.bodies.len() == 2 => {
            format!("{} with {}", name(pair.body), name(other))
        }
        (Rule::Bodies(_), _) => "bodies with each other".to_owned(),
        (Rule::Surface(_), _) => format!("on {}", words::other(study, pair, pair.body)),
    }
}

fn law(names: &Names, pair: &Pair, is_single: bool) -> Block {
    let (mut lines, mut definitions) = restitution(names, pair, is_single);
    if let Some(friction) = &pair.friction {
        lines.extend(coulomb(names, friction));
        let meaning = "forces along the normal and along the surface, at each moment of the impact";
        definitions.push(meant(&["N", "f"], meaning));
        definitions.push(meant(&["s"], "speed of slip, with its sign"));
    }
    Block { title: Text::default(), lines, definitions }
}

/// What comes back of an impact: without friction the ratio of speeds is that of impulses, where no other contact strikes with it.
fn restitution(names: &Names, pair: &Pair, is_single: bool) -> (Vec<Typeset>, Vec<Definition>) {
    let ContactLaw::Rigid { restitution } = &pair.law else { return (vec![], vec![]) };
    let times = |left: &str, factor: Expr, right: &str| {
        let (rate, side) = (Expr::symbol(right, Dimension::NONE), Math::symbol(left));
        vec![names.relation(side, Operator::Equals, &(factor * rate))]
    };
    let ratio = match &pair.friction {
        None if is_single => Restitution::Newton,
        None => Restitution::Poisson,
        Some(friction) => friction.restitution.unwrap_or_default(),
    };
    let more = if is_single { "" } else { " (as much more as keeps the gap from closing again)" };
    match ratio {
        Restitution::Newton => (
            times("v_n,1", -restitution, "v_n,0"),
            vec![meant(&["v_n,0", "v_n,1"], "rate of the gap before and after the impact")],
        ),
        Restitution::Poisson => (
            times("J_1", restitution.clone(), "J_0"),
            vec![meant(
                &["J_0", "J_1"],
                &format!("normal impulse of the approach, and of the separation{more}"),
            )],
        ),
        Restitution::Stronge => (
            times("W_1", -(restitution * restitution), "W_0"),
            vec![meant(&["W_0", "W_1"], "work of the normal force in the approach, and in the separation")],
        ),
    }
}

/// Friction within an impact.
fn coulomb(names: &Names, friction: &Friction) -> Vec<Typeset> {
    let normal = || Expr::symbol("N", Dimension::FORCE);
    let way = Expr::unary(Unary::Sign, Symbol::new("s", Dimension::SPEED).into());
    let force = || Math::symbol("f");
    let said = |words: &str| vec![Math::Text(format!("\u{2003}{words}"))];
    let slips = side(names.written_notation(), &-(&friction.kinetic * normal() * way));
    let most = side(names.written_notation(), &(&friction.of_rest * normal()));
    let line = |left: Math, operator: Operator, right: Math, when: &str| {
        math(&Math::Row([vec![left, Math::Operator(operator), right], said(when)].concat()))
    };
    vec![
        line(force(), Operator::Equals, slips, "while slipping"),
        line(Math::Bars(Box::new(force())), Operator::LessEqual, most, "while sticking"),
    ]
}

fn meant(letters: &[&str], meaning: &str) -> Definition {
    let comma = || Math::Text(",\u{2009}".to_owned());
    let mut all: Vec<Math> = letters.iter().flat_map(|letter| [Math::symbol(letter), comma()]).collect();
    all.pop();
    Definition { symbol: math(&Math::Row(all)), meaning: meaning.into() }
}
