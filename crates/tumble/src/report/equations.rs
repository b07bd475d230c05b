//! The equations of motion as they were integrated, in the symbols of the scene.

use tumble_expr::{Expr, Symbol, is_identically_zero};
use tumble_math::{Left, Mark, Math as Formula, MathError, Notation, Shown};
use tumble_mech::{ContactMode, Mode, Term};
use tumble_report::report::{Block, Mode as ModeShown, Text};
use tumble_scene::Study;

use super::model::{MOST_OPERATIONS, distinct, laws_of, operations};
use super::names::{Names, block};
use crate::case::Case;

/// Equations of more signs than these are not read by anybody: forces stand in them by name.
const MOST_SIGNS: usize = 800;
/// More modes than this are told of in the table of events only.
const MOST_MODES: usize = 6;

/// The equations of motion in each mode that the motion went through.
pub(super) fn modes(study: &Study, names: &Names, case: &Case) -> Vec<ModeShown> {
    let modes = &case.run.trajectory.modes;
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
    let changed = mode.changes.iter().map(|event| format!("after {}", study.model.events[*event].name));
    let all: Vec<String> = touching.chain(acting).chain(changed).collect();
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
            return block(title.into(), written);
        }
    }
    let title =
        format!("{title} With the forces by their names: written out, these equations would fill pages");
    let terms: Vec<Term> = terms.into_iter().filter(|term| term.body == body).collect();
    laws_of(study, names, case, (body, &distinct(terms)), title.trim_start())
}

/// The equations of motion of one body in one mode, with the names they are shown by.
///
/// Forces of several lasting contacts stand in them by name, and what determines them below: solved for, they would be a
/// matrix's inverse.
struct Motion {
    notation: Notation,
    lines: Vec<(Left, Expr)>,
}

impl Motion {
    fn of(study: &Study, names: &Names, case: &Case, mode: &Mode, body: usize) -> Self {
        let equations = &case.run.equations;
        let model_body = &study.model.bodies[body];
        let kinematics = model_body.kinematics();
        let mass = equations.mass_properties(body);
        let constraints = equations.shown_constraints(mode, body);
        let is_solved = constraints.len() < 2;
        let notation = names.of_body(body).notation().clone();
        if study.model.pivot_of(&model_body.name).is_some() {
            let angle = names.shown(&kinematics.angle_symbol().name).to_owned();
            let left = Left::symbol(Formula::derivative(&angle, 2, Mark::Primes));
            let alpha = equations.in_states(mode, &kinematics.alpha_symbol().into());
            return Self { notation, lines: vec![(left, alpha)] };
        }
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
        if !is_identically_zero(&mass.inertia) {
            lines.push(times(&mass.inertia, &kinematics.alpha_symbol(), Term::torque));
        }
        if !is_solved {
            let zero = || Left::symbol(Formula::Number("0".to_owned()));
            lines.extend(constraints.into_iter().map(|constraint| (zero(), constraint)));
        }
        Self { notation, lines }
    }

    fn shown(&self) -> Result<Shown, MathError> {
        self.notation.equations(&self.lines)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pipeline::{self, Options};
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
            for mode in 0..case.run.trajectory.modes.len().min(MOST_MODES) {
                for body in 0..study.model.bodies.len() {
                    compared += compare(&study, &names, case, mode, body);
                }
            }
        }
        assert!(compared > 20, "{compared}");
    }

    fn compare(study: &Study, names: &Names, case: &Case, mode: usize, body: usize) -> usize {
        let trajectory = &case.run.trajectory;
        let motion = Motion::of(study, names, case, &trajectory.modes[mode], body);
        let integrated = integrated(study, case, &trajectory.modes[mode], body);
        let shown = motion.shown().expect("it can be shown");
        let pieces: Vec<_> = trajectory.pieces.iter().filter(|piece| piece.mode == mode).take(20).collect();
        let mut compared = 0;
        // What determines forces of contacts follows the accelerations.
        let integrated = integrated.into_iter().chain(std::iter::repeat(Expr::zero()));
        for (line, ((left, _), right)) in shown.lines.iter().zip(motion.lines.iter().zip(integrated)) {
            let integrated = left.factor.as_ref().map_or_else(|| right.clone(), |factor| factor * &right);
            let mut both =
                case.run.observe(&[line.formula.clone(), integrated]).expect("formulas of the states");
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

    /// The accelerations as the integrator has them.
    fn integrated(study: &Study, case: &Case, mode: &Mode, body: usize) -> Vec<Expr> {
        let of_model = &study.model.bodies[body];
        let motion = of_model.kinematics();
        let [ax, ay] = motion.acceleration_symbols();
        let shown = match study.model.pivot_of(&of_model.name) {
            Some(_) => vec![motion.alpha_symbol()],
            None => vec![ax, ay, motion.alpha_symbol()],
        };
        shown.into_iter().map(|symbol| case.run.equations.in_states(mode, &symbol.into())).collect()
    }
}
