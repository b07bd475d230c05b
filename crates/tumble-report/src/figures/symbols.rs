//! How forces and quantities are written in diagrams, tables, equations, curves and the animation: the same everywhere.

use std::collections::{BTreeMap, BTreeSet};

use tumble_drawing::Label;
use tumble_expr::{Node, Symbol, Unary, is_identically_zero};
use tumble_mech::{Application, Frame, Gravity, Joint, Law};
use tumble_scene::Study;

mod spoken;

pub(crate) use spoken::{
    bare, called, holder, in_words, is_moment, joint, noun, the, the_point, without_unit, words,
};

/// Quantities by the end of their names, with the usual letter and in words.
const QUANTITIES: [(&str, &str, &str); 19] = [
    ("x", "x", "horizontal position"),
    ("y", "y", "height"),
    ("vx", "v_x", "horizontal velocity"),
    ("vy", "v_y", "vertical velocity"),
    ("ax", "A_x", "horizontal acceleration"),
    ("ay", "A_y", "vertical acceleration"),
    ("angle", "theta", "angle"),
    ("omega", "omega", "angular velocity"),
    ("alpha", "alpha", "angular acceleration"),
    ("energy", "E", "energy"),
    ("kinetic", "K", "kinetic energy"),
    ("potential", "", "potential energy"),
    ("force", "", "force"),
    ("normal", "", "normal force"),
    ("friction", "", "friction"),
    ("rolling", "", "couple against rolling"),
    ("slip", "", "speed of slip"),
    ("gap", "", "gap"),
    ("work", "", "work"),
];
/// Those that points have too.
const PLACES: [(&str, &str, &str); 6] =
    [QUANTITIES[0], QUANTITIES[1], QUANTITIES[2], QUANTITIES[3], QUANTITIES[4], QUANTITIES[5]];

/// What everything in a study is shown as: the user's own symbols, else the usual letters.
pub(crate) fn all(study: &Study) -> BTreeMap<String, String> {
    let mut symbols = usual(study);
    symbols.extend(study.symbols.iter().map(|(name, symbol)| (name.clone(), symbol.clone())));
    symbols
}

/// Pairs of different quantities that a reader could not tell apart, with what both are shown as: parameters, and what moves.
pub(crate) fn clashes(study: &Study) -> Vec<(String, String, String)> {
    const MOVES: [&str; 7] = ["x", "y", "vx", "vy", "angle", "omega", "alpha"];
    let all = all(study);
    let parameters = study.model.parameters.symbols();
    let parameters = parameters.iter().map(|parameter| parameter.name.to_string());
    let moves = study.model.bodies.iter().flat_map(|body| {
        let turns_only = study.model.pivot_of(&body.name).is_some();
        MOVES[if turns_only { 4 } else { 0 }..].iter().map(|name| format!("{}.{name}", body.name))
    });
    let shown = |name: String| {
        let symbol = all.get(&name).unwrap_or(&name).clone();
        (name, symbol)
    };
    let weight = matches!(study.model.gravity, Gravity::Vertical(_))
        .then(|| ("the weight".to_owned(), "W".to_owned()));
    // Arrows of diagrams have the letter alone.
    let free = study.model.bodies.iter().filter(|body| study.model.pivot_of(&body.name).is_none());
    let letters: BTreeSet<String> = free.map(|body| velocity_among(&all, study, &body.name)).collect();
    let letters = letters.into_iter().filter(|letter| !all.values().any(|shown| shown == letter));
    let velocities = letters.map(|letter| ("the velocity of the centre".to_owned(), letter));
    let named = weight.into_iter().chain(velocities);
    let shown: Vec<(String, String)> = named.chain(parameters.chain(moves).map(shown)).collect();
    let labels: Vec<Label> = shown.iter().map(|(_, symbol)| Label::symbol(symbol)).collect();
    let alike = |(index, (name, symbol)): (usize, &(String, String))| {
        let others = (index + 1..shown.len()).filter(|other| labels[*other] == labels[index]);
        others.map(|other| (name.clone(), shown[other].0.clone(), symbol.clone())).collect::<Vec<_>>()
    };
    shown.iter().enumerate().flat_map(alike).collect()
}

/// A formula as it stands at a curve: what has a symbol by it, `rod.angle in deg` as well.
pub(crate) fn label(symbols: &BTreeMap<String, String>, text: &str) -> Label {
    let text = without_unit(text);
    let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
    let mut label = Label::default();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let end = rest.find(|c: char| is_part(c) != is_part(first)).unwrap_or(rest.len());
        let (piece, after) = rest.split_at(end);
        let is_name = first.is_alphabetic() && !after.starts_with('(');
        label = label.then(match symbols.get(piece).filter(|_| is_name) {
            Some(symbol) => Label::symbol(symbol),
            None if is_name && !piece.contains('.') => Label::symbol(piece),
            None => Label::plain(&piece.replace('-', "\u{2212}").replace('*', "\u{b7}")),
        });
        rest = after;
    }
    label
}

/// The user's own symbol for a load, or the usual letter with the load's name.
pub(crate) fn force(study: &Study, load: &str, law: Law) -> String {
    if let Some(own) = study.symbols.get(load) {
        return own.clone();
    }
    if let Some(named) = named(study, load) {
        return study.symbols.get(&named).cloned().unwrap_or(named);
    }
    let last = last(load);
    match law {
        Law::Weight => "W".to_owned(),
        Law::Contact => format!("N_{}", contact(study, load)),
        Law::Friction => format!("f_{}", contact(study, rubbed(load))),
        Law::Rolling => format!("C_{}", contact(study, rubbed(load))),
        Law::Reaction => format!("R_{last}"),
        _ if law.is_couple() => format!("tau_{last}"),
        _ => format!("F_{last}"),
    }
}

/// The parameter that an applied force or torque is, along an axis: the `F` of `(F, 0)`, which is its symbol then. None where others
/// are that parameter too.
pub(crate) fn named(study: &Study, load: &str) -> Option<String> {
    let own = only_symbol(&study.model.loads.iter().find(|known| known.name == load)?.application)?;
    let parameters = study.model.parameters.symbols();
    let shared =
        study.model.loads.iter().filter(|other| only_symbol(&other.application).as_ref() == Some(&own));
    (parameters.contains(&own) && shared.count() == 1).then(|| own.name.to_string())
}

/// The symbol that an application is, or the opposite of.
fn only_symbol(application: &Application) -> Option<Symbol> {
    let components = match application {
        Application::Torque(torque) => std::slice::from_ref(torque),
        Application::Force { frame: Frame::Body, .. } => return None,
        Application::Force { force, .. } => force.components(),
    };
    let mut parts = components.iter().filter(|part| !is_identically_zero(part));
    let part = parts.next().filter(|_| parts.next().is_none())?;
    let part = if let Node::Unary(Unary::Neg, of) = part.node() { of } else { part };
    if let Node::Symbol(symbol) = part.node() { Some(symbol.clone()) } else { None }
}

/// The contact that friction or a rolling resistance of this name is of.
pub(crate) fn rubbed(load: &str) -> &str {
    load.strip_suffix(".friction").or_else(|| load.strip_suffix(".rolling")).unwrap_or(load)
}

/// Where a body is touched: by the point, `tip` of `floor.rod.tip`, and where there are several surfaces by them too; where bodies meet
/// each other, by both of them.
pub(crate) fn contact(study: &Study, pair: &str) -> String {
    match pair.split_once('.') {
        Some((contact, bodies)) if study.model.contacts.iter().any(|known| known.name == contact) => {
            bodies.replace('.', "_")
        }
        Some((surface, _)) if study.model.surfaces.len() > 1 => format!("{surface}_{}", last(pair)),
        _ => last(pair).to_owned(),
    }
}

/// The symbol of what a load does to turn a body about its centre of mass: the torque of a force, and of a couple itself.
pub(crate) fn torque_of(study: &Study, (load, law): (&str, Law), body: usize) -> String {
    let symbol = force(study, load, law);
    match law.is_couple() {
        true => symbol,
        false => torque(&of_body(study, &symbol, load, &study.model.bodies[body].name)),
    }
}

/// The symbol of a force of a joint or contact as it is for one of its two bodies, whose arm and torque are not the other's: with
/// `disk2` first, of `N_disk1_disk2`; `R_elbow,arm`.
pub(crate) fn of_body(study: &Study, symbol: &str, load: &str, body: &str) -> String {
    let is_between = |joint: &Joint| joint.name == load && joint.bodies().count() > 1;
    if study.model.joints.iter().any(is_between) {
        return below(symbol, body);
    }
    let bodies = contact(study, rubbed(load));
    let is_between = study.model.contacts.iter().any(|known| load.starts_with(&format!("{}.", known.name)));
    match bodies.strip_suffix(&format!("_{body}")).filter(|_| is_between) {
        Some(first) => symbol.replacen(&bodies, &format!("{body}_{first}"), 1),
        None => symbol.to_owned(),
    }
}

/// The letter of a body's velocity: `v` of `v_x`, or that of the user's own symbol; V where a parameter is shown so.
pub(crate) fn velocity(study: &Study, body: &str) -> String {
    velocity_among(&all(study), study, body)
}

/// The same, where what everything is shown as is known.
fn velocity_among(all: &BTreeMap<String, String>, study: &Study, body: &str) -> String {
    let shown = all.get(&format!("{body}.vx")).map_or("v", String::as_str);
    let letter = shown.split('_').next().unwrap_or(shown);
    let is_taken = |name: &str| all.get(name).map_or(name, String::as_str) == letter;
    let parameters = study.model.parameters.symbols();
    if parameters.iter().any(|symbol| is_taken(&symbol.name)) { "V".to_owned() } else { letter.to_owned() }
}

/// A symbol with one more letter below it: `N_tip,y`, `W_y`.
pub(crate) fn below(symbol: &str, letter: &str) -> String {
    let separator = if symbol.contains('_') { ',' } else { '_' };
    format!("{symbol}{separator}{letter}")
}

/// The torque of a force: `tau_air` of `F_air`, `tau_N,tip` of the contact's `N_tip`.
pub(crate) fn torque(force: &str) -> String {
    let below = force.strip_prefix("F_").or_else(|| force.strip_prefix("R_")).unwrap_or(force);
    format!("tau_{}", below.replace('_', ","))
}

/// An angular impulse by its name: `H_hammer`.
pub(crate) fn angular_impulse(name: &str) -> String {
    format!("H_{name}")
}

/// An impulse at a place, or by its name: `J_tip`.
pub(crate) fn impulse(place: &str) -> String {
    format!("J_{place}")
}

/// The couple by which a weld holds a body at its angle: `C_wood`.
pub(crate) fn couple(joint: &str) -> String {
    format!("C_{}", last(joint))
}

/// The arm of a force: `r_air` of `F_air`, `r_tip` of the contact's `N_tip`.
pub(crate) fn arm(force: &str) -> String {
    format!("r_{}", force.split_once('_').map_or(force, |(_, below)| below))
}

/// The last word of a name: `tip` of `floor.rod.tip`.
pub(crate) fn last(name: &str) -> &str {
    name.rsplit('.').next().unwrap_or(name)
}

/// The usual letters: those of the only body stand alone, those of several have its name.
fn usual(study: &Study) -> BTreeMap<String, String> {
    let bodies = &study.model.bodies;
    let mut symbols = BTreeMap::new();
    let turning = turning(study);
    for body in bodies {
        for (name, letter, _) in QUANTITIES.into_iter().filter(|(_, letter, _)| !letter.is_empty()) {
            let letter = if name == "alpha" { turning } else { letter };
            let shown = if bodies.len() == 1 { letter.to_owned() } else { below(letter, &body.name) };
            symbols.insert(format!("{}.{name}", body.name), shown);
        }
        for ((point, _), (name, letter, _)) in
            body.points.iter().flat_map(|point| PLACES.map(|of| (point, of)))
        {
            symbols.insert(format!("{}.{point}.{name}", body.name), below(letter, point));
        }
    }
    for law in &study.model.interactions {
        symbols.insert(format!("{}.s", law.name()), "s".to_owned());
    }
    for pair in study.model.pairs() {
        let touched = contact(study, &pair.name);
        symbols.insert(format!("{}.normal", pair.name), format!("N_{touched}"));
        symbols.insert(format!("{}.friction", pair.name), format!("f_{touched}"));
        symbols.insert(format!("{}.rolling", pair.name), format!("C_{touched}"));
        symbols.insert(format!("{}.rolling_force", pair.name), format!("p_{touched}"));
    }
    for surface in &study.model.surfaces {
        let letter = |letter: &str| {
            if study.model.surfaces.len() > 1 { below(letter, &surface.name) } else { letter.to_owned() }
        };
        symbols.insert(format!("{}.normal", surface.name), letter("N"));
        symbols.insert(format!("{}.friction", surface.name), letter("f"));
    }
    for (joint, multipliers) in joints(study) {
        let force = force(study, &joint, Law::Reaction);
        symbols.insert(format!("{joint}.force"), force.clone());
        let letters = multipliers.iter().zip(["x", "y"]);
        for (symbol, letter) in letters {
            symbols.insert(symbol.name.to_string(), below(&force, letter));
        }
        if let Some(couple) = multipliers.get(2) {
            symbols.insert(couple.name.to_string(), self::couple(&joint));
        }
        for (seat, letter) in [("seat_x", "x"), ("seat_y", "y")] {
            symbols.insert(format!("{joint}.{seat}"), format!("{letter}_{}", last(&joint)));
        }
    }
    symbols
}

/// The letter of angular accelerations: epsilon where a parameter is shown as alpha.
fn turning(study: &Study) -> &'static str {
    let shown = |symbol: &Symbol| {
        study.symbols.iter().find(|(name, _)| **name == *symbol.name).map(|(_, shown)| &**shown)
    };
    let parameters = study.model.parameters.symbols();
    let is_taken = parameters.iter().any(|symbol| shown(symbol).unwrap_or(&symbol.name) == "alpha");
    if is_taken { "epsilon" } else { "alpha" }
}

/// What keeps each pivot and joint, by its name: components of the force, and the couple of a weld.
fn joints(study: &Study) -> Vec<(String, Vec<Symbol>)> {
    let pivots = study.model.pivots.iter().map(|pivot| (pivot.name.clone(), pivot.force_symbols().into()));
    let joints = study.model.joints.iter().map(|joint| (joint.name.clone(), joint.multipliers()));
    pivots.chain(joints).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use tumble_drawing::text::Label;

    #[test]
    fn formulas_are_shown_by_their_symbols() {
        let symbols = BTreeMap::from([("rod.angle".to_owned(), "theta".to_owned())]);
        assert_eq!(label(&symbols, "rod.angle in deg"), Label::symbol("theta"));
        assert_eq!(label(&symbols, "cos(rod.angle)").to_plain(), "cos(θ)");
        assert_eq!(label(&symbols, "w1"), Label::symbol("w1"));
        assert_eq!(label(&symbols, "rod.slip").to_plain(), "rod.slip");
    }

    #[test]
    fn what_two_bodies_share_has_arms_of_each() {
        let (study, _) = crate::scenes::motions_called("24-glancing-disks");
        let load = study.model.pairs()[0].name.clone();
        let arm_on = |body: &str| arm(&of_body(&study, "J_disk1_disk2", &load, body));
        assert_eq!([arm_on("disk1"), arm_on("disk2")], ["r_disk1_disk2", "r_disk2_disk1"]);
        let (study, _) = crate::scenes::motions_called("11-double-pendulum");
        let torque_on = |body: &str| torque(&of_body(&study, "R_elbow", "elbow", body));
        assert_eq!([torque_on("arm"), torque_on("forearm")], ["tau_elbow,arm", "tau_elbow,forearm"]);
        assert_eq!(of_body(&study, "R_hinge", "hinge", "arm"), "R_hinge");
    }

    #[test]
    fn a_parameter_called_alpha_keeps_its_letter() {
        let shown = |name: &str| all(&crate::scenes::motions_called(name).0)["block.alpha"].clone();
        assert_eq!(shown("27-rocking-block"), "epsilon");
        assert_eq!(shown("17-block-on-a-slope"), "alpha");
    }
}
