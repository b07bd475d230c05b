//! The laws of the impacts that happened: what they do to a body, what is given back, and how friction holds meanwhile.

use std::collections::BTreeSet;

use crate::report::{Block, Definition, Text, Typeset};
use tumble_expr::{Dimension, Expr, Symbol, Unary, is_identically_zero};
use tumble_mech::{ContactLaw, Friction, Pair, Restitution, Rule, Source};
use tumble_notation::{Math, Operator};
use tumble_scene::Study;

use super::alike::listed;
use super::names::{Names, math, side};
use super::once::defined_once;
use super::words;
use crate::figures::symbols;
use crate::results::Case;

/// What impulses do to a body; nothing where there were none.
pub(super) fn of_body(study: &Study, names: &Names, cases: &[Case], body: usize) -> Option<Block> {
    let mut impulses =
        cases.iter().flat_map(|case| case.run.events()).flat_map(|event| &event.record.impulses);
    impulses.find(|impulse| impulse.body == body)?;
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
        let sum = [Math::Text("\u{3a3}\u{2009}".to_owned())].into_iter().chain(by);
        math(&Math::equation(left, Math::Row(sum.collect())))
    };
    let impulse = || Math::symbol("J");
    let mut lines = vec![changes(&names.mass(&properties.mass), &velocity, vec![impulse()])];
    if !is_identically_zero(&properties.inertia) {
        let moment = vec![Math::symbol("r"), Math::Operator(Operator::Cross), impulse()];
        lines.push(changes(&properties.inertia, names.shown(&turning.name), moment));
    }
    Some(Block { title: "In an impact".into(), lines, definitions: vec![] })
}

/// The laws of the contacts that struck, one block for all that strike alike.
pub(super) fn laws(study: &Study, names: &Names, cases: &[Case]) -> Vec<Block> {
    let mut found: Vec<(Vec<String>, Block)> = vec![];
    for pair in struck(cases) {
        let (who, block) = (who(study, pair), law(names, pair));
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

/// The rigid pairs with an impact.
fn struck(cases: &[Case]) -> Vec<&Pair> {
    let mut all: BTreeSet<usize> = BTreeSet::new();
    for event in cases.iter().flat_map(|case| case.run.events()) {
        all.extend(event.record.impulses.iter().filter_map(|impulse| match impulse.source {
            Source::Pair(pair) => Some(pair),
            _ => None,
        }));
    }
    let pairs = cases[0].run.equations.pairs();
    all.into_iter().map(|pair| &pairs[pair]).collect()
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

fn law(names: &Names, pair: &Pair) -> Block {
    let (mut lines, mut definitions) = restitution(names, pair);
    if let Some(friction) = &pair.friction {
        lines.extend(coulomb(names, friction));
        let meaning = "forces along the normal and along the surface, at each moment of the impact";
        definitions.push(meant(&["N", "f"], meaning));
        definitions.push(meant(&["s"], "speed of slip, with its sign"));
    }
    Block { title: Text::default(), lines, definitions }
}

/// What comes back of an impact.
fn restitution(names: &Names, pair: &Pair) -> (Vec<Typeset>, Vec<Definition>) {
    let ContactLaw::Rigid { restitution } = &pair.law else { return (vec![], vec![]) };
    let times = |left: &str, factor: Expr, right: &str| {
        let (rate, side) = (Expr::symbol(right, Dimension::NONE), Math::symbol(left));
        vec![names.relation(side, Operator::Equals, &(factor * rate))]
    };
    match pair.friction.as_ref().map(|friction| friction.restitution.unwrap_or_default()) {
        None | Some(Restitution::Newton) => (
            times("v_n,1", -restitution, "v_n,0"),
            vec![meant(&["v_n,0", "v_n,1"], "rate of the gap before and after the impact")],
        ),
        Some(Restitution::Poisson) => (
            times("J_1", restitution.clone(), "J_0"),
            vec![meant(
                &["J_0", "J_1"],
                "normal impulse while they approach each other, and while they part",
            )],
        ),
        Some(Restitution::Stronge) => (
            times("W_1", -(restitution * restitution), "W_0"),
            vec![meant(
                &["W_0", "W_1"],
                "work of the normal force while they approach each other, and while they part",
            )],
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
