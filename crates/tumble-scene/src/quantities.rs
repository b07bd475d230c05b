//! The names that a body adds to formulas: `rod.x`, `rod.tip.vy`, `rod.energy`.

use std::collections::BTreeMap;
use std::sync::Arc;

use tumble_expr::language::{Formula, Value};
use tumble_expr::{Dimension, Expr, Symbol, Vector};
use tumble_mech::{Body, Change, Gravity, Model, Pair, Rule, time};

use crate::code::Code;
use crate::curve::quantity;
use crate::diagnostic::{Diagnostic, Span};
use crate::moments;
use crate::names::{Level, Names};
use crate::study::Quantity;

const MOMENTUM: Dimension = Dimension::new(1, 1, -1);
/// How the name of a work ends.
const WORK: &str = ".work";

/// Gives the time its name.
pub(crate) fn define_time(names: &mut Names) {
    names.define(Level::Time, "t", &time());
}

/// Gives all quantities of a body their names.
pub(crate) fn define(names: &mut Names, gravity: &Gravity, body: &Body) {
    let motion = body.kinematics();
    let [x, y] = motion.position_symbols();
    let [vx, vy] = motion.velocity_symbols();
    let [ax, ay] = motion.acceleration_symbols();
    for symbol in [x, y, motion.angle_symbol(), vx, vy, motion.omega_symbol()] {
        define_symbol(names, Level::Motion, symbol);
    }
    for symbol in [ax, ay, motion.alpha_symbol()] {
        define_symbol(names, Level::Output, symbol);
    }
    define_points(names, body);
    let kinetic = body.kinetic_energy();
    names.define(Level::Motion, &format!("{}.kinetic", body.name), &kinetic);
    let energy = kinetic + body.potential_energy(gravity);
    names.define(Level::Motion, &format!("{}.energy", body.name), &energy);
}

fn define_symbol(names: &mut Names, level: Level, symbol: Symbol) {
    let name = symbol.name.to_string();
    names.define(level, &name, &symbol.into());
}

fn define_points(names: &mut Names, body: &Body) {
    let places = body.points_at(body.points.iter().map(|(_, local)| local));
    let points = body.points.iter().map(|(point, _)| point.as_str()).zip(places);
    for (point, place) in points.chain([("cm", body.cm())]) {
        for (quantity, formula) in place.quantities() {
            let level = if quantity.starts_with('a') { Level::Output } else { Level::Motion };
            names.define(level, &format!("{}.{point}.{quantity}", body.name), &formula);
        }
    }
}

/// Gives what may touch its names: `floor.rod.tip.gap`, `.normal`, with friction `.friction` and `.slip`, and `floor.normal` and
/// `floor.friction` for all forces together.
pub(crate) fn define_contacts(names: &mut Names, model: &Model) {
    let (pairs, resisting): (Vec<Pair>, Vec<Pair>) =
        model.pairs().into_iter().partition(|pair| !pair.is_rolling());
    define_resistances(names, model, &resisting);
    for (index, surface) in model.surfaces.iter().enumerate() {
        let of_surface: Vec<&Pair> = pairs.iter().filter(|pair| pair.rule == Rule::Surface(index)).collect();
        for pair in &of_surface {
            define_pair(names, pair, format!("{}.{}", surface.name, model.bodies[pair.body].name));
        }
        let sum = |of: Vec<Symbol>| of.into_iter().map(Expr::from).reduce(|a, b| a + b);
        let rough = of_surface.iter().filter(|pair| pair.friction.is_some());
        let is_round = rough.clone().any(|pair| pair.is_round());
        if let Some(all) = sum(of_surface.iter().map(|pair| pair.force_symbol()).collect()) {
            names.define(Level::Forces, &format!("{}.normal", surface.name), &all);
        }
        if let Some(all) = sum(rough.map(|pair| pair.friction_symbol()).collect()) {
            names.define(Level::Forces, &format!("{}.friction", surface.name), &all);
            define_slips(names, &surface.name, is_round);
        }
        names.touching.insert(surface.name.clone());
    }
}

/// The same for bodies that meet each other: `balls.red.white.gap`; of two bodies that meet in several points all forces together are
/// `slide.block.wedge.normal`, and of a contact of two bodies alone `slide.normal`.
pub(crate) fn define_meetings(names: &mut Names, model: &Model) {
    let (pairs, resisting): (Vec<Pair>, Vec<Pair>) =
        model.pairs().into_iter().partition(|pair| !pair.is_rolling());
    define_resistances(names, model, &resisting);
    let mut sums: BTreeMap<(usize, String), [Vec<Symbol>; 2]> = BTreeMap::new();
    for pair in pairs {
        let (Rule::Bodies(rule), Some(other)) = (pair.rule, pair.other) else { continue };
        let contact = &model.contacts[rule].name;
        let [first, second] = [pair.body, other].map(|body| &model.bodies[body].name);
        let bodies = format!("{contact}.{first}.{second}");
        define_pair(names, &pair, bodies.clone());
        if pair.friction.is_some() {
            define_slips(names, contact, pair.is_round());
        }
        names.touching.insert(contact.clone());
        // Round bodies meet in one point, which has the name of both.
        let [normals, frictions] = sums.entry((rule, bodies)).or_default();
        normals.push(pair.force_symbol());
        frictions.extend(pair.friction.iter().map(|_| pair.friction_symbol()));
    }
    define_sums(names, model, &sums);
}

/// All forces of two bodies on each other together, where they are several; and of a contact of two bodies alone.
fn define_sums(names: &mut Names, model: &Model, sums: &BTreeMap<(usize, String), [Vec<Symbol>; 2]>) {
    let mut couples = vec![0; model.contacts.len()];
    sums.keys().for_each(|(rule, _)| couples[*rule] += 1);
    for ((rule, bodies), of) in sums {
        let is_only = couples[*rule] == 1;
        let places = [(of[0].len() > 1).then_some(bodies), is_only.then_some(&model.contacts[*rule].name)];
        for place in places.into_iter().flatten() {
            for (quantity, of) in ["normal", "friction"].into_iter().zip(of) {
                let all = of.iter().cloned().map(Expr::from).reduce(|a, b| a + b);
                all.into_iter()
                    .for_each(|all| names.define(Level::Forces, &format!("{place}.{quantity}"), &all));
            }
        }
    }
}

/// Gives the welds that contacts make their names: `hits.dart.board.joint.force`.
pub(crate) fn define_captures(names: &mut Names, model: &Model) {
    for joint in model.joints.iter().filter(|joint| joint.captured_by.is_some()) {
        define_joint(names, &joint.name, joint.multipliers());
        names.happenings.insert(format!("{}.start", joint.name));
    }
}

/// Names of one pair; `bodies` is that of all pairs of the same bodies.
fn define_pair(names: &mut Names, pair: &Pair, bodies: String) {
    names.define(Level::Motion, &format!("{}.gap", pair.name), &pair.gap());
    names.define(Level::Forces, &format!("{}.normal", pair.name), &pair.force_symbol().into());
    if pair.friction.is_some() {
        define_slips(names, &pair.name, pair.is_round());
        define_slips(names, &bodies, pair.is_round());
        names.define(Level::Forces, &format!("{}.friction", pair.name), &pair.friction_symbol().into());
        names.define(Level::Motion, &format!("{}.slip", pair.name), &pair.slip_rate());
    }
    names.touching.extend([pair.name.clone(), bodies]);
}

/// Names couples against rolling, `floor.ball.rim.rolling`, and the instants at which what rolls stops or begins to.
fn define_resistances(names: &mut Names, model: &Model, resisting: &[Pair]) {
    for pair in resisting {
        let couple = pair.rolling_couple().unwrap_or_else(Expr::zero);
        names.define(Level::Forces, &format!("{}.rolling", pair.name), &couple);
        let bodies = pair.bodies().map(|body| model.bodies[body].name.as_str());
        let rule = match pair.rule {
            Rule::Surface(surface) => &model.surfaces[surface].name,
            Rule::Bodies(contact) => &model.contacts[contact].name,
        };
        let all = [rule.as_str()].into_iter().chain(bodies).collect::<Vec<_>>().join(".");
        for place in [rule, &all, &pair.name] {
            names.happenings.extend(Change::OF_ROLLING.map(|change| format!("{place}.{}", change.word())));
        }
    }
}

/// Names the instants at which what touches there begins to slide, to stick or, if it is round, to roll: `floor.ball.rolls`.
fn define_slips(names: &mut Names, place: &str, is_round: bool) {
    let happens = |change: &Change| is_round || *change != Change::Rolls;
    let changes = Change::OF_FRICTION.into_iter().filter(happens);
    names.happenings.extend(changes.map(|change| format!("{place}.{}", change.word())));
}

/// Gives what a joint does its names: `hinge.fx`, `hinge.fy`, `hinge.force`, of a weld `joint.torque`.
pub(crate) fn define_joint(names: &mut Names, joint: &str, multipliers: Vec<Symbol>) {
    let force = Vector::planar(multipliers[0].clone().into(), multipliers[1].clone().into());
    names.define(Level::Forces, &format!("{joint}.force"), &force.norm());
    multipliers.into_iter().for_each(|symbol| define_symbol(names, Level::Forces, symbol));
}

/// Names everything that does work, once the model is complete.
pub(crate) fn define_works(names: &mut Names, model: &Model) {
    let loads = model.loads.iter().map(|load| load.name.clone());
    let interactions = model.interactions.iter().map(|interaction| interaction.name().to_owned());
    let pivots = model.pivots.iter().map(|pivot| pivot.name.clone());
    let joints = model.joints.iter().map(|joint| joint.name.clone());
    let impulses = model.impulses.iter().map(|impulse| impulse.name.clone());
    let weight = ["gravity".to_owned()];
    names.working.extend(
        loads
            .chain(interactions)
            .chain(pivots)
            .chain(joints)
            .chain(impulses)
            .chain(weight)
            .chain(names.touching.clone()),
    );
}

/// What a formula names that only the run knows up to an instant, by the names there: works such as `floor.work`, J, impulses such as
/// `floor.contact[1].impulse.x`, N s, and how often something has happened, `floor.contacts` or `apex.count`.
pub(crate) fn works(names: &Names, formula: &Formula) -> Vec<(Arc<str>, Value)> {
    let of_run = |name: &str| -> Option<(Arc<str>, Value)> {
        let is_work = name.strip_suffix(WORK).is_some_and(|load| names.working.contains(load));
        let symbol = match is_work {
            true => Expr::symbol(name, Dimension::TORQUE),
            false => tally(names, name)?,
        };
        Some((name.into(), symbol.into()))
    };
    formula.names().into_iter().filter_map(|name| of_run(name.name)).collect()
}

/// The symbol of an impulse of a contact, or of a count. (Times of contacts are told from it by its name.)
fn tally(names: &Names, name: &str) -> Option<Expr> {
    if let Some((contact, part)) = name.split_once("].impulse") {
        let (pair, count) = moments::contact_of(names, &name[..=contact.len()])?;
        let axis = if part.is_empty() { ".size" } else { part };
        let known = [".x", ".y", ".size"].contains(&axis);
        return known.then(|| Expr::symbol(format!("{pair}.impulse[{count}]{axis}"), MOMENTUM));
    }
    let is_count = match name.rsplit_once('.')? {
        (place, "contacts") => names.touching.contains(place),
        (event, "count") => {
            names.happenings.contains(event) || names.events.iter().any(|known| known == event)
        }
        _ => false,
    };
    is_count.then(|| Expr::symbol(name, Dimension::NONE))
}

/// What is wrong with the name of a work where works are not known.
pub(crate) fn explain_work(names: &Names, name: &str, span: &Span) -> Option<Diagnostic> {
    names.working.contains(name.strip_suffix(WORK)?).then(|| {
        let message =
            format!("`{name}` is the work up to an instant, which only a find or a check at an instant may ask for");
        let mistake = Diagnostic::new(Code::EventInFormula, span.clone(), message).label("a work");
        mistake.help(
            "write it in `that` of a find or a check without `at` or with an instant; `[balance.NAME]` draws all works",
        )
    })
}

/// Every name of the motion with its formula.
pub(crate) fn all(names: &Names) -> BTreeMap<String, Quantity> {
    let scope = names.scope(Level::Output);
    let of_motion = scope.names().filter(|name| names.level_of(name).is_some());
    let formulas = of_motion.filter_map(|name| match scope.value(name)? {
        Value::Scalar(formula) => Some((name.to_owned(), quantity(formula.clone(), [name]))),
        Value::Vector(_) => None,
    });
    formulas.collect()
}
