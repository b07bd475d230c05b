//! The equations of motion as they were integrated, in the symbols of the scene.

use crate::report::{Block, Definition, ModeEquations, Text};
use tumble_expr::{Expr, Symbol, is_identically_zero};
use tumble_mech::{Anchor, ContactMode, Joint, Law, Pair};
use tumble_notation::Math;
use tumble_scene::Study;

use super::alike::Kind;
use super::motion::{Line, Motion, Setting, inertia_name, second};
use super::names::{Names, math};
use super::once::{BESIDE_LAWS, BY_NAME, OTHERS_BY_NAME, defined_once, told_once};
use super::passed::Passed;
use super::reduced::simple;
use super::{passed, words};
use crate::figures::symbols;
use crate::results::Case;

/// What a condition on accelerations comes from.
const STAYS: &str = "points that touch or are joined have one acceleration";
/// What is said of forces that are zero because others bear all: any share of theirs would move the bodies alike.
const ONE_CHOICE: &str = "one choice of many, since more points touch than are needed";
/// More modes than this are told of in the table of events only.
const MOST_MODES: usize = 6;

/// The equations of motion in each mode that any run went through.
pub(super) fn modes(study: &Study, names: &Names, cases: &[Case], kinds: &[Kind]) -> Vec<ModeEquations> {
    let modes = passed::lasting(cases);
    let told: Vec<usize> = kinds.iter().flat_map(Kind::told).copied().collect();
    let shown = modes.iter().take(MOST_MODES).map(|Passed { case, mode }| {
        let setting = Setting { study, names, case, mode };
        let mut motions = setting.motions();
        motions.retain(|motion| told.contains(&motion.body));
        let blocks: Vec<Block> = motions.iter().filter_map(|motion| equations_of(&setting, motion)).collect();
        let is_short = |body: &usize| motions.iter().any(|motion| motion.body == *body && motion.is_short());
        let holds = match (told.iter().all(is_short), blocks.is_empty()) {
            (true, _) => "",
            (false, true) => BY_NAME,
            (false, false) => OTHERS_BY_NAME,
        };
        let blocks = defined_once(blocks);
        ModeEquations {
            // What holds in the only mode holds throughout, unless something touches in it.
            name: match modes.len() == 1 && mode.contacts.is_empty() {
                true => Text::default(),
                false => words::mode(study, &case.run.equations, mode).into(),
            },
            holds: holds.into(),
            equations: blocks,
        }
    });
    let told = shown.fold(vec![], told_once).into_iter();
    told.map(|mode| ModeEquations { name: mode.name.capitalised(), ..mode }).collect()
}

fn equations_of(setting: &Setting<'_>, motion: &Motion) -> Option<Block> {
    let Setting { study, names, .. } = *setting;
    let shown = motion.shown().filter(|_| motion.is_short())?.clone();
    let body = symbols::bare(&study.model.bodies[motion.body].name);
    let is_beside = !motion.by_law.is_empty();
    let title = match (study.model.bodies.len() > 1, motion.follows) {
        (true, true) => format!("{body}, and the forces that hold it"),
        (false, true) => "The forces that hold it follow from".to_owned(),
        (true, false) if is_beside => format!("{body}, {BESIDE_LAWS}"),
        (true, false) => body,
        (false, false) if is_beside => Text::from(BESIDE_LAWS).capitalised().to_plain(),
        (false, false) => String::new(),
    };
    let about_pivot = Math::symbol(&inertia_name(study, &study.model.bodies[motion.body].name));
    let place = shown.definitions.iter().position(|line| line.left.as_ref() == Some(&about_pivot));
    let reasons: Vec<Option<String>> = motion.lines.iter().map(|line| why(setting, motion, line)).collect();
    let shown_lines: Vec<Math> = shown.lines.iter().map(tumble_notation::Line::math).collect();
    let mut block = names.shown_block(title.into(), Ok(shown));
    if let Some(index) = place {
        block.definitions[index].meaning = "about the pivot".into();
    }
    for ((line, shown), why) in block.lines.iter_mut().zip(shown_lines).zip(&reasons) {
        if let Some(why) = why {
            *line = math(&Math::Row(vec![shown, Math::Text(format!("\u{2003}since {why}"))]));
        }
    }
    let is_open = |(line, why): (&Line, &Option<String>)| why.is_none() && is_condition(setting, line);
    if motion.lines.iter().zip(&reasons).any(is_open) {
        block.definitions.push(Definition { symbol: math(&zero()), meaning: STAYS.into() });
    }
    block.definitions.extend(without_force(setting, motion.body));
    block.definitions.extend(seats(study, names, motion));
    block.definitions.extend(second_rate(study, names, motion));
    Some(block)
}

/// Contacts of a body that touch and are given no force.
fn without_force(setting: &Setting<'_>, body: usize) -> Option<Definition> {
    let Setting { study, case, mode, .. } = *setting;
    let idle = mode.contacts.iter().filter(|(_, contact)| *contact == ContactMode::Idle);
    let pairs = idle.map(|(pair, _)| &case.run.equations.pairs()[*pair]).filter(|pair| pair.body == body);
    let forces = pairs.map(|pair| Math::symbol(&symbols::force(study, &pair.name, Law::Contact)));
    let equal = |all, next| Math::equation(all, next);
    let all = forces.chain([Math::Number("0".to_owned())]).reduce(equal)?;
    let is_none = matches!(all, Math::Number(_));
    (!is_none).then(|| Definition { symbol: math(&all), meaning: ONE_CHOICE.into() })
}

/// Whether a line is no law of motion, but says of accelerations what contacts and joints make of them.
fn is_condition(setting: &Setting<'_>, line: &Line) -> bool {
    let bodies = setting.study.model.bodies.iter().map(|body| body.kinematics());
    let mut rates = bodies.flat_map(|own| [&own.acceleration_symbols()[..], &[own.alpha_symbol()]].concat());
    let symbols = line.right.symbols();
    is_identically_zero(&line.is) && rates.any(|rate| symbols.contains(&rate))
}

/// Why a line holds that is no law of motion, where a contact of the body is the reason.
fn why(setting: &Setting<'_>, motion: &Motion, line: &Line) -> Option<String> {
    let is_followed = motion.follows && line.left.factor.is_none();
    let condition = &line.is - &line.right;
    (is_followed || is_condition(setting, line)).then(|| reason(setting, motion.body, &condition))?
}

/// What stands for any condition.
fn zero() -> Math {
    Math::equation(Math::Text("\u{2026}".to_owned()), Math::Number("0".to_owned()))
}

/// Why a condition on the acceleration of one body holds: of contacts with a surface along whose normal or across which it is.
fn reason(setting: &Setting<'_>, body: usize, condition: &Expr) -> Option<String> {
    let Setting { study, case, mode, .. } = *setting;
    let kinematics = study.model.bodies[body].kinematics();
    let [x, y] = kinematics.acceleration_symbols().map(|symbol| condition.derivative(&symbol));
    let is_zero = |formula: &Expr| is_identically_zero(&simple(formula));
    let touching = mode.contacts.iter().filter(|(_, contact)| *contact == ContactMode::Resting);
    let touching = touching.map(|(pair, _)| &case.run.equations.pairs()[*pair]);
    let touching: Vec<_> = touching.filter(|pair| pair.body == body && pair.other.is_none()).collect();
    if is_zero(&x) && is_zero(&y) {
        let lies = touching.len() > 1 && condition.symbols().len() == 1;
        return lies.then(|| format!("{} does not turn", symbols::the(&study.model.bodies[body].name)));
    }
    let because = |along: fn(&Expr, &Expr, &Pair) -> Expr, [one, several]: [&str; 2]| {
        let own: Vec<_> = touching.iter().filter(|pair| is_zero(&along(&x, &y, pair))).collect();
        let first = own.first()?;
        let own = own.iter().filter(|pair| pair.rule == first.rule);
        let points: Vec<String> = own.map(|pair| words::point(study, pair)).collect();
        let (what, to) = (words::together(&points), words::against(study, first));
        Some(format!("{what} {} {to}", if points.len() > 1 { several } else { one }))
    };
    because(|x, y, pair| x * pair.normal.y() - y * pair.normal.x(), ["stays on", "stay on"]).or_else(|| {
        because(
            |x, y, pair| x * pair.normal.x() + y * pair.normal.y(),
            ["does not slip on", "do not slip on"],
        )
    })
}

/// What `alpha` is where the equation of motion above says `theta''`.
fn second_rate(study: &Study, names: &Names, motion: &Motion) -> Option<Definition> {
    let alpha = study.model.bodies[motion.body].kinematics().alpha_symbol();
    let is_read = motion.shown()?.lines.iter().any(|line| line.formula.symbols().contains(&alpha));
    let is_told = motion.follows && is_read && study.model.bodies.len() == 1;
    let symbol = Math::symbol(names.shown(&alpha.name));
    let equation = Math::equation(symbol, second(study, names, motion.body).symbol);
    is_told.then(|| Definition { symbol: math(&equation), meaning: Text::default() })
}

/// What the places in equations mean at which joints were made on the way.
fn seats(study: &Study, names: &Names, motion: &Motion) -> Vec<Definition> {
    let used = |symbol: &Symbol| motion.lines.iter().any(|line| line.right.symbols().contains(symbol));
    let seated = study.model.joints.iter().filter(|joint| joint.is_seated);
    let definition = |joint: &Joint| {
        let Anchor::Material(point) = &joint.ends[1] else { return None };
        let symbols = point.arm.components().iter().flat_map(Expr::symbols);
        let mut own: Vec<Symbol> = symbols.filter(used).collect();
        own.sort_by(|a, b| a.name.cmp(&b.name));
        let parts = own.iter().map(|symbol| Math::symbol(names.shown(&symbol.name)));
        let parts: Vec<Vec<Math>> = parts.map(|part| vec![part]).collect();
        let (joint, body) = (symbols::joint(&joint.name), symbols::the(&point.body.body));
        let meaning = format!("where {joint} is on {body}, from its centre of mass, along its axes");
        (!parts.is_empty())
            .then(|| Definition { symbol: math(&Math::Matrix(parts)), meaning: meaning.into() })
    };
    seated.filter_map(definition).collect()
}

#[cfg(test)]
mod tests;
