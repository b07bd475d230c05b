//! The equations of motion as they were integrated, in the symbols of the scene.

use tumble_expr::{Expr, Substitution, Symbol, Vector, is_identically_zero};
use tumble_math::{Left, Mark, Math as Formula, MathError, Notation, Shown};
use tumble_mech::{Anchor, ContactMode, Joint, Mode, Pivot, Term, rotated};
use tumble_report::report::{Block, Definition, Mode as ModeShown, Text};
use tumble_scene::Study;

use super::model::{MOST_OPERATIONS, distinct, laws_of, operations};
use super::names::{Names, block, math};
use crate::case::Case;

/// Equations of more signs than these are not read by anybody: forces stand in them by name.
const MOST_SIGNS: usize = 800;
/// More modes than this are told of in the table of events only.
const MOST_MODES: usize = 6;

/// The equations of motion in each mode that the motion went through.
pub(super) fn modes(study: &Study, names: &Names, case: &Case) -> Vec<ModeShown> {
    let modes = &case.run.trajectory().modes;
    let shown = modes.iter().take(MOST_MODES).map(|mode| ModeShown {
        name: if modes.len() > 1 { mode_name(study, case, mode).into() } else { Text::default() },
        holds: Text::default(),
        equations: (0..study.model.bodies.len())
            .map(|body| equations_of(study, names, case, mode, body))
            .collect(),
    });
    shown.collect()
}

/// What touches and what acts: `floor.rod.tip pressed, kick acts`.
pub(super) fn mode_name(study: &Study, case: &Case, mode: &Mode) -> String {
    let equations = &case.run.equations;
    let touching = mode.contacts.iter().map(|(pair, contact_mode)| {
        let how = match contact_mode {
            ContactMode::Pressed => "pressed",
            ContactMode::Released => "released",
            ContactMode::Resting => "in touch",
            ContactMode::Settling => "settling",
            ContactMode::Idle => "touching",
        };
        format!("{} {how}", equations.pairs()[*pair].name)
    });
    let windows = equations.windows().iter().zip(&mode.windows);
    let acting = windows.map(|(window, acts)| match acts {
        true => format!("{} acts", window.load),
        false => format!("without {}", window.load),
    });
    let joints = study
        .model
        .joints
        .iter()
        .enumerate()
        .filter(|(_, joint)| joint.from.is_some() || joint.until.is_some());
    let joined = joints.map(|(index, joint)| match equations.holds(mode, index) {
        true => format!("{} holds", joint.name),
        false => format!("without {}", joint.name),
    });
    let changed = mode.changes.iter().map(|event| format!("after {}", study.model.events[*event].name));
    let all: Vec<String> = touching.chain(joined).chain(acting).chain(changed).collect();
    match (all.is_empty(), study.model.surfaces.is_empty()) {
        (false, _) => all.join(", "),
        (true, false) => "nothing touches".to_owned(),
        (true, true) => "all the time".to_owned(),
    }
}

fn equations_of(study: &Study, names: &Names, case: &Case, mode: &Mode, body: usize) -> Block {
    let title = if study.model.bodies.len() > 1 { study.model.bodies[body].name.as_str() } else { "" };
    let terms = case.run.equations.shown_terms(mode);
    let motion = Motion::of(study, names, case, mode, body);
    if operations(motion.lines.iter().map(|(_, right)| right)) <= MOST_OPERATIONS {
        let written = motion.shown();
        let signs = written.as_ref().map_or(usize::MAX, |shown| shown.text().chars().count());
        if signs <= MOST_SIGNS {
            let mut shown = block(title.into(), written);
            shown.definitions.extend(seats(study, names, &motion));
            return shown;
        }
    }
    let title =
        format!("{title} With the forces by their names: written out, these equations would fill pages");
    let terms: Vec<Term> = terms.into_iter().filter(|term| term.body == body).collect();
    laws_of(study, names, case, (body, &distinct(terms)), title.trim_start())
}

/// What the places in equations mean at which joints were made on the way.
fn seats(study: &Study, names: &Names, motion: &Motion) -> Vec<Definition> {
    let used = |symbol: &Symbol| motion.lines.iter().any(|(_, right)| right.symbols().contains(symbol));
    let seated = study.model.joints.iter().filter(|joint| joint.is_seated);
    let definition = |joint: &Joint| {
        let Anchor::Material(point) = &joint.ends[1] else { return None };
        let symbols = point.arm.components().iter().flat_map(Expr::symbols);
        let mut own: Vec<Symbol> = symbols.filter(used).collect();
        own.sort_by(|a, b| a.name.cmp(&b.name));
        let parts = own.iter().map(|symbol| Formula::symbol(names.shown(&symbol.name)));
        let parts: Vec<Vec<Formula>> = parts.map(|part| vec![part]).collect();
        let body = &point.body.body;
        let meaning = format!("where {} is on {body}, from its centre of mass, along its axes", joint.name);
        (!parts.is_empty())
            .then(|| Definition { symbol: math(&Formula::Matrix(parts)), meaning: meaning.into() })
    };
    seated.filter_map(definition).collect()
}

/// The equations of motion of one body in one mode, with the names they are shown by.
///
/// Forces of joints and of several lasting contacts stand in them by name, and what determines them below: solved for, they would
/// be a matrix's inverse.
struct Motion {
    notation: Notation,
    lines: Vec<(Left, Expr)>,
}

impl Motion {
    fn of(study: &Study, names: &Names, case: &Case, mode: &Mode, body: usize) -> Self {
        let equations = &case.run.equations;
        let model_body = &study.model.bodies[body];
        let kinematics = model_body.kinematics();
        let constraints = equations.shown_constraints(mode, body);
        let is_joined = study.model.joints.iter().enumerate().any(|(index, joint)| {
            equations.holds(mode, index) && joint.bodies().any(|name| name == model_body.name)
        });
        let is_solved = constraints.len() < 2 && !is_joined;
        let pivot = study.model.pivot_of(&model_body.name);
        let notation = names.of_body(body).notation().clone();
        let (notation, mut lines) = match (pivot, is_solved) {
            (Some(_), true) => {
                let angle = names.shown(&kinematics.angle_symbol().name).to_owned();
                let left = Left::symbol(Formula::derivative(&angle, 2, Mark::Primes));
                let alpha = equations.in_states(mode, &kinematics.alpha_symbol().into());
                (notation, vec![(left, alpha)])
            }
            (Some(pivot), false) => {
                let inertia = about_pivot(case, body, pivot);
                let line = turned(names, case, mode, (body, pivot), &inertia);
                let named = match inertia.symbols().is_empty() {
                    true => notation,
                    false => notation.define(inertia_name(study, &model_body.name), &inertia),
                };
                (named, vec![line])
            }
            (None, _) => (notation, free(names, case, mode, body, is_solved)),
        };
        if !is_solved {
            let of_pivots = of_pivots(study, case);
            // What two bodies share stands with the later one.
            let own = constraints.iter().filter(|constraint| last_of(study, constraint) == Some(body));
            let conditions = own.map(|constraint| shortest(&notation, &of_pivots.apply(constraint)));
            lines.extend(conditions.map(|condition| (nothing(), condition)));
        }
        Self { notation, lines }
    }

    fn shown(&self) -> Result<Shown, MathError> {
        self.notation.equations(&self.lines)
    }
}

/// `M A = sum F` and `I alpha = sum tau`, solved for where nothing stands by its name.
fn free(names: &Names, case: &Case, mode: &Mode, body: usize, is_solved: bool) -> Vec<(Left, Expr)> {
    let equations = &case.run.equations;
    let kinematics = equations.model().bodies[body].kinematics();
    let mass = equations.mass_properties(body);
    let terms = if is_solved { vec![] } else { equations.shown_terms(mode) };
    let times = |factor: &Expr, symbol: &Symbol, part: fn(&Term) -> Expr| {
        let left = Left::times(factor, Formula::symbol(names.shown(&symbol.name)));
        let own = terms.iter().filter(|term| term.body == body);
        let right = match is_solved {
            true => equations.in_states(mode, &symbol.clone().into()),
            false => own.map(part).fold(Expr::zero(), |sum, part| sum + part) / factor,
        };
        (left, right)
    };
    let [ax, ay] = kinematics.acceleration_symbols();
    let mut lines = vec![
        times(&mass.mass, &ax, |term| term.force.x().clone()),
        times(&mass.mass, &ay, |term| term.force.y().clone()),
    ];
    let torque = own_torque(&terms, body);
    if !is_identically_zero(&mass.inertia) {
        lines.push(times(&mass.inertia, &kinematics.alpha_symbol(), Term::torque));
    } else if !is_identically_zero(&torque) {
        // A point mass on a massless rod.
        lines.push((nothing(), torque));
    }
    lines
}

/// About its centre of mass.
fn own_torque(terms: &[Term], body: usize) -> Expr {
    let own = terms.iter().filter(|term| term.body == body);
    own.map(Term::torque).fold(Expr::zero(), |sum, torque| sum + torque)
}

/// The left side of what is zero.
fn nothing() -> Left {
    Left::symbol(Formula::Number("0".to_owned()))
}

/// `I_P alpha = sum tau` of a body about its pivot, with the forces of joints by their names; where the pivot moves, less
/// `M r x A_P`.
fn turned(
    names: &Names,
    case: &Case,
    mode: &Mode,
    (body, pivot): (usize, &Pivot),
    inertia: &Expr,
) -> (Left, Expr) {
    let equations = &case.run.equations;
    let kinematics = equations.model().bodies[body].kinematics();
    let mass = equations.mass_properties(body);
    let arm = rotated(&(&mass.centre - &pivot.point), &kinematics.angle());
    let terms = equations.shown_terms(mode);
    let own = terms.iter().filter(|term| term.body == body && term.load != pivot.name);
    let torque =
        own.map(|term| term.torque_about(&(&arm + &term.arm))).fold(Expr::zero(), |sum, torque| sum + torque);
    let carried = &mass.mass * arm.cross_planar(&acceleration(pivot));
    let left = Left::times(inertia, Formula::symbol(names.shown(&kinematics.alpha_symbol().name)));
    (left, (torque - carried) / inertia)
}

/// Of the point that a pivot holds.
fn acceleration(pivot: &Pivot) -> Vector {
    let rate = |path: Vector| Anchor::World(path).velocity();
    rate(rate(pivot.world.clone()))
}

/// Accelerations of the centres of bodies on pivots, by how the bodies turn.
fn of_pivots(study: &Study, case: &Case) -> Substitution {
    let mut all = Substitution::default();
    for (index, body) in study.model.bodies.iter().enumerate() {
        let Some(pivot) = study.model.pivot_of(&body.name) else { continue };
        let kinematics = body.kinematics();
        let centre = &case.run.equations.mass_properties(index).centre;
        let arm = rotated(&(centre - &pivot.point), &kinematics.angle());
        let omega = kinematics.omega();
        let turning = kinematics.alpha() * arm.perpendicular() - (&omega * &omega) * &arm;
        let centre = acceleration(pivot) + turning;
        for (symbol, component) in kinematics.acceleration_symbols().into_iter().zip(centre.components()) {
            all.insert(symbol, component.clone());
        }
    }
    all
}

/// The last body that a condition is about.
fn last_of(study: &Study, condition: &Expr) -> Option<usize> {
    let symbols = condition.symbols();
    let is_of = |body: &str| {
        symbols.iter().any(|symbol| symbol.name.split_once('.').is_some_and(|(stem, _)| stem == body))
    };
    study.model.bodies.iter().rposition(|body| is_of(&body.name))
}

/// Moment of inertia of a body about its pivot.
fn about_pivot(case: &Case, body: usize, pivot: &Pivot) -> Expr {
    let mass = case.run.equations.mass_properties(body);
    let away = &mass.centre - &pivot.point;
    &mass.inertia + &mass.mass * away.components().iter().fold(Expr::zero(), |sum, part| sum + part * part)
}

/// `I_P`, with the body's name where there are several.
fn inertia_name(study: &Study, body: &str) -> String {
    if study.model.bodies.len() > 1 { format!("I_P,{body}") } else { "I_P".to_owned() }
}

/// A multiple of what is zero that is written with the fewest signs: without halves of lengths.
fn shortest(notation: &Notation, condition: &Expr) -> Expr {
    let written = |formula: &Expr| {
        let shown = notation.clone().without_automatic_names().formula(formula);
        shown.map_or(usize::MAX, |shown| shown.text().chars().count())
    };
    let multiples = [1, -1, 2, -2, 3, -3, 4, -4, 6, -6].map(|factor| factor * condition);
    multiples.into_iter().min_by_key(written).unwrap_or_else(|| condition.clone())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pipeline::{self, Options};
    use tumble_expr::Dimension;
    use tumble_ode::Side;

    /// Rounding of formulas in another order of operations.
    const ROUNDING: f64 = 1e-9;

    /// Two contacts that last.
    const LADDER: &str = r#"version = 1
        world.gravity = "9.81 m/s^2"
        run.until = "1 s"
        [body.ladder]
        rod = { from = [0, "2 m"], to = [0, "-2 m"] }
        mass = "12 kg"
        start = { at = ["1 m", "sqrt(3)*(1 m)"], angle = "30 deg" }
        [surface.floor]
        through = [0, 0]
        rigid = { restitution = 0 }
        [surface.wall]
        through = [0, 0]
        normal = [1, 0]
        rigid = { restitution = 0 }
    "#;

    /// In every scene and mode, what is printed has the value of what was integrated, along the motion itself.
    #[test]
    fn printed_equations_are_those_that_were_integrated() {
        let scenes = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
        let scenes = std::fs::read_dir(scenes).expect("the scenes");
        let scenes = scenes.map(|folder| folder.expect("readable").path().join("scene.toml"));
        let own = tempfile::tempdir().expect("a folder");
        let ladder = own.path().join("ladder.toml");
        std::fs::write(&ladder, LADDER).expect("written");
        let mut compared = 0;
        for scene in scenes.chain([ladder]) {
            let (study, cases) = pipeline::motions(&scene, &Options::default()).expect("a scene that runs");
            let case = &cases[0];
            let study = study.with(&case.parameters);
            let names = Names::of(&study).expect("names");
            for mode in 0..case.run.trajectory().modes.len().min(MOST_MODES) {
                for body in 0..study.model.bodies.len() {
                    compared += compare(&study, &names, case, mode, body);
                }
            }
        }
        assert!(compared > 20, "{compared}");
    }

    fn compare(study: &Study, names: &Names, case: &Case, mode: usize, body: usize) -> usize {
        let trajectory = &case.run.trajectory();
        let motion = Motion::of(study, names, case, &trajectory.modes[mode], body);
        let integrated = integrated(study, case, &trajectory.modes[mode], body);
        let shown = motion.shown().expect("it can be shown");
        let pieces: Vec<_> = trajectory.pieces.iter().filter(|piece| piece.mode == mode).take(20).collect();
        let seats = seats_of(case, mode, pieces.first().copied());
        let mut compared = 0;
        // What determines forces of contacts follows the accelerations.
        let integrated = integrated.into_iter().chain(std::iter::repeat(Expr::zero()));
        for (line, ((left, _), right)) in shown.lines.iter().zip(motion.lines.iter().zip(integrated)) {
            let integrated = left.factor.as_ref().map_or_else(|| right.clone(), |factor| factor * &right);
            // Places of joints are states of this mode alone.
            let both = [&line.formula, &integrated].map(|formula| seats.apply(formula));
            let mut both = case.run.observe(&both).expect("formulas of the states");
            for piece in &pieces {
                let middle = 0.5 * (piece.start + piece.end);
                let values = both.at(middle, Side::After).expect("within the run");
                let scale = values[1].abs().max(1e-3);
                assert!((values[0] - values[1]).abs() <= ROUNDING * scale, "{values:?}: {}", shown.text());
                compared += 1;
            }
        }
        compared
    }

    /// The numbers that the places of joints are in a mode.
    fn seats_of(case: &Case, mode: usize, piece: Option<&tumble_ode::Piece>) -> Substitution {
        let symbols = case.run.equations.states(&case.run.trajectory().modes[mode]);
        let values = piece.map(|piece| piece.states_at(piece.end)).unwrap_or_default();
        let mut seats = Substitution::default();
        let places = symbols
            .into_iter()
            .zip(values)
            .filter(|(symbol, _)| symbol.dimension == Dimension::LENGTH && symbol.name.contains(".seat_"));
        places.for_each(|(symbol, value)| seats.insert(symbol, value * tumble_expr::units::M));
        seats
    }

    /// The accelerations as the integrator has them.
    fn integrated(study: &Study, case: &Case, mode: &Mode, body: usize) -> Vec<Expr> {
        let of_model = &study.model.bodies[body];
        let motion = of_model.kinematics();
        let [ax, ay] = motion.acceleration_symbols();
        let shown = match study.model.pivot_of(&of_model.name) {
            Some(_) => vec![motion.alpha_symbol()],
            None if is_identically_zero(&case.run.equations.mass_properties(body).inertia) => vec![ax, ay],
            None => vec![ax, ay, motion.alpha_symbol()],
        };
        shown.into_iter().map(|symbol| case.run.equations.in_states(mode, &symbol.into())).collect()
    }
}
