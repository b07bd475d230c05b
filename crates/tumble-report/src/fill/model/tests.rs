//! What laws say is what is integrated.

use super::*;
use crate::scenes::motions_of;
use tumble_expr::{Expr, Substitution, Symbol, language::Value};
use tumble_mech::{Mode, Statement, Term};

/// Integrals of the board are summed over this many pieces by Simpson's rule, those of the program by its own: where the wind on
/// a line changes its sign, the first is off by about the cube of a piece.
const PIECES: u32 = 200;
const QUADRATURE: f64 = 1e-6;
/// States that are tried for each law.
const STATES: usize = 8;

/// Numbers between -1 and 1 in no order.
fn number(state: usize, index: usize) -> f64 {
    let turned = (state as f64 + 1.0) * 0.618_033_988_749_895 + (index as f64 + 1.0) * 0.754_877_666_246_693;
    2.0 * (turned * 7.0).fract() - 1.0
}

/// Force and torque of a load, and the same as the board says them.
fn both(terms: &[&Term], stated: &Statement) -> Option<Vec<(Expr, Expr)>> {
    let sum = |part: &dyn Fn(&Term) -> Expr| terms.iter().fold(Expr::zero(), |sum, term| sum + part(term));
    let mut found = vec![];
    let force = match &stated.force {
        Some(force) => match force.value(PIECES)? {
            Value::Vector(force) => Some(force),
            Value::Scalar(_) => return None,
        },
        None => None,
    };
    if let Some(force) = &force {
        found.push((force.x().clone(), sum(&|term| term.force.x().clone())));
        found.push((force.y().clone(), sum(&|term| term.force.y().clone())));
    }
    let torque = match (&stated.torque, force) {
        (Some(torque), _) => match torque.value(PIECES)? {
            Value::Scalar(torque) => torque,
            Value::Vector(_) => return None,
        },
        (None, force) => terms[0].arm.cross_planar(&force?),
    };
    found.push((torque, sum(&Term::torque)));
    Some(found)
}

/// In every scene and mode, what each law says has the value of the terms that are integrated, at states of all kinds.
#[test]
fn what_laws_say_is_what_is_integrated() {
    let mut compared = 0;
    for (study, cases) in crate::scenes::all().map(|scene| motions_of(&scene)).chain([crate::scenes::laws()])
    {
        for case in &cases {
            let study = study.with(&case.parameters);
            for mode in &case.run.trajectory().modes {
                compared += compare(&study, case, mode);
            }
        }
    }
    assert!(compared > 500, "{compared}");
}

fn compare(study: &Study, case: &Case, mode: &Mode) -> usize {
    let equations = &case.run.equations;
    let terms = equations.shown_terms(mode);
    let mut compared = 0;
    for stated in equations.shown_statements(mode) {
        let own: Vec<&Term> =
            terms.iter().filter(|term| term.body == stated.body && term.load == stated.load).collect();
        let pairs = both(&own, &stated).expect("vectors and numbers where they belong");
        for state in 0..STATES {
            let mut here = Substitution::default();
            for (index, symbol) in equations.states(mode).into_iter().enumerate() {
                here.insert(symbol.clone(), number(state, index) * one(&symbol));
            }
            here.insert(
                Symbol::new("t", tumble_expr::Dimension::TIME),
                (1.0 + number(state, 99)) * tumble_expr::units::S,
            );
            for (said, integrated) in &pairs {
                let values =
                    [said, integrated].map(|formula| here.apply(&equations.in_states(mode, formula)));
                let values = study.model.parameters.evaluate(&values).expect("numbers");
                // The ways between many bodies may be parallel at such a state: then the rows of their contacts depend on each
                // other, and what keeps them has no value, said or integrated.
                if values.iter().all(|value| value.is_nan()) && !study.model.contacts.is_empty() {
                    continue;
                }
                let scale = values[1].abs().max(1e-3);
                assert!((values[0] - values[1]).abs() <= QUADRATURE * scale, "{}: {values:?}", stated.load);
                compared += 1;
            }
        }
    }
    compared
}

/// One of its unit.
fn one(symbol: &Symbol) -> Expr {
    use tumble_expr::units::{M, S};
    let units = [1.0 * M, 1.0 * M / S, 1.0 / S];
    units.into_iter().find(|unit| unit.dimension() == Ok(symbol.dimension)).unwrap_or_else(Expr::one)
}

/// The model of a scene of the gallery, and the captions of the free-body sheets that it asks for.
fn model_of(name: &str) -> (ModelPart, Vec<String>) {
    let (study, cases) = crate::scenes::motions_called(name);
    let names = Names::of(&study).expect("names");
    let sheet = |asked| free_bodies::sheet(&study, &cases[0], asked).expect("a sheet");
    let captions = study.free_bodies.iter().flat_map(|asked| sheet(asked).captions);
    let captions = captions.map(|caption| caption.to_plain()).collect();
    (of(&study, &names, &cases).expect("a model"), captions)
}

#[test]
fn of_two_corners_that_stick_to_one_slope_only_friction_is_open() {
    let (_, captions) = model_of("17-block-on-a-slope");
    let open: Vec<&String> = captions.iter().filter(|caption| caption.contains("not unique")).collect();
    let [open] = open[..] else { panic!("{captions:?}") };
    assert!(open.contains("f_corner1") && open.contains("f_corner2") && !open.contains("N_"), "{open}");
    let (_, captions) = model_of("16-bench-on-three-feet");
    assert!(captions.iter().any(|caption| caption.contains("N_left, N_middle, N_right")), "{captions:?}");
}

#[test]
fn a_force_that_is_open_and_given_nothing_is_in_the_picture() {
    let shown = |name: &str, panel: usize, letter: char| {
        let (study, cases) = crate::scenes::motions_called(name);
        let sheet = free_bodies::sheet(&study, &cases[0], &study.free_bodies[0]).expect("a sheet");
        let symbols = sheet.panels[panel].forces.iter().map(|arrow| arrow.symbol.to_plain());
        symbols.filter(|symbol| symbol.starts_with(letter)).collect::<Vec<_>>()
    };
    assert_eq!(shown("16-bench", 0, 'N'), ["N_left", "N_right", "N_middle"]);
    assert_eq!(shown("17-block", 1, 'f'), ["f_corner1", "f_corner2"]);
}

/// The kinetic coefficient where it slides, the static one where it sticks, and of smooth surfaces none.
#[test]
fn cones_of_friction_are_as_wide_as_the_coefficient_that_counts() {
    let widths = |name: &str, run: usize, panel: usize| {
        let (study, cases) = crate::scenes::motions_called(name);
        let sheet = free_bodies::sheet(&study, &cases[run], &study.free_bodies[0]).expect("a sheet");
        sheet.panels[panel].cones.iter().map(|cone| cone.coefficient).collect::<Vec<_>>()
    };
    assert_eq!(widths("17-block", 0, 0), [0.4, 0.4]);
    assert_eq!(widths("17-block", 0, 1), [0.5, 0.5]);
    assert_eq!(widths("03-bouncing-rod", 0, 1), [0.0; 0]);
    // Impulses of an impact of two disks.
    assert_eq!(widths("24-glancing", 0, 0), [0.1]);
}

/// What slides all along an impact is on the edge of the kinetic cone; where it takes the static coefficient to hold the end, the cone is that wide.
#[test]
fn cones_of_impacts_hold_their_impulses() {
    let scene = |holds: f64| {
        format!(
            "version = 1\nworld.gravity = \"9.81 m/s^2\"\nrun.until = \"0.25 s\"\n[body.rod]\nmass = \"0.5 kg\"\n\
             rod = {{ from = [\"-0.5 m\", 0], to = [\"0.5 m\", 0] }}\n\
             start = {{ at = [0, \"0.45 m\"], angle = \"30 deg\" }}\n[surface.floor]\nthrough = [0, 0]\n\
             rigid = {{ restitution = 0, friction = {{ static = {holds}, kinetic = 0.3 }} }}\n\
             [free_body.impact]\nbody = \"rod\"\nat = \"floor.contact[1].start\"\n"
        )
    };
    let cone = |holds: f64| {
        let scene = scene(holds);
        let (study, cases) = crate::scenes::motions_in("rod", scene.as_bytes(), &tumble_scene::NoFiles);
        let sheet = free_bodies::sheet(&study, &cases[0], &study.free_bodies[0]).expect("a sheet");
        let [cone] = &sheet.panels[0].cones[..] else { panic!("{:?}", sheet.panels[0].cones) };
        (cone.coefficient, (cone.friction[0] / cone.normal[1] * 1e6).round() / 1e6)
    };
    assert_eq!(cone(0.9), (0.9, 0.742_307));
    assert_eq!(cone(0.5), (0.3, 0.3));
}

#[test]
fn a_pivot_with_a_torque_is_not_said_to_have_no_friction() {
    let said = |name: &str| {
        let (model, _) = model_of(name);
        model
            .assumptions
            .iter()
            .map(Text::to_plain)
            .find(|words| words.starts_with("Pivots"))
            .expect("a pivot")
    };
    assert_eq!(said("07-measured-gust"), "Pivots have no friction but for the torques that are stated.");
    assert_eq!(said("01-pendulum-in-the-wind"), "Pivots have no friction.");
}

#[test]
fn letters_of_accelerations_are_explained_at_the_first_body_only() {
    let (model, _) = model_of("11-double-pendulum");
    let explained = model.bodies.iter().map(|body| {
        let definitions = body.laws.iter().flat_map(|law| &law.definitions);
        definitions.filter(|one| one.meaning.to_plain().contains("acceleration")).count()
    });
    assert_eq!(explained.collect::<Vec<_>>(), [2, 0]);
}

#[test]
fn a_moment_of_inertia_about_a_pivot_says_so() {
    let (model, _) = model_of("12-bullet-in-a-rod");
    let definitions =
        model.modes.iter().flat_map(|mode| &mode.equations).flat_map(|block| &block.definitions);
    let own: Vec<String> = definitions
        .filter(|one| one.symbol.latex.contains("I_{P"))
        .map(|one| one.meaning.to_plain())
        .collect();
    assert_eq!(own, ["about the pivot"]);
}

#[test]
fn what_an_impulse_does_to_turn_a_body_is_no_torque() {
    let (model, _) = model_of("13-four-bar-linkage");
    let [crank, ..] = &model.bodies[..] else { panic!("no bodies") };
    let row = &crank.impulses[0];
    assert_eq!([&*row.symbol.text, &*row.torque[0].text], ["H_hammer"; 2]);
    assert!(crank.forces.iter().all(|force| !force.name.to_plain().contains("hammer")), "{crank:?}");
}

/// Lines of blocks as text.
fn lines<'a>(blocks: impl IntoIterator<Item = &'a crate::report::Block>) -> Vec<String> {
    blocks.into_iter().flat_map(|block| &block.lines).map(|line| line.text.clone()).collect()
}

/// The first run of 21 has no friction, the first of 16 a foot in the air.
#[test]
fn what_only_a_later_run_of_a_sweep_does_is_in_the_model() {
    let (bench, _) = model_of("16-bench-on-three-feet");
    assert!(bench.bodies[0].forces.iter().any(|row| row.symbol.text == "N_middle"), "{bench:?}");
    let (rod, _) = model_of("21-rough-floor");
    let names: Vec<String> = rod.modes.iter().map(|mode| mode.name.to_plain()).collect();
    assert!(names.contains(&"The tip sticks to the floor".to_owned()), "{names:?}");
}

#[test]
fn masses_cancel_and_what_lies_flat_does_not_turn() {
    let (rod, _) = model_of("08-rigid-rod");
    let of_modes: Vec<_> = rod.modes.iter().map(|mode| lines(&mode.equations)).collect();
    assert_eq!(of_modes[0], ["A_x = 0", "A_y = \u{2212}g", "α = 0"]);
    let lies = |line: &String| line.split('\u{2003}').next().unwrap_or_default().to_owned();
    assert_eq!(of_modes[1].iter().map(lies).collect::<Vec<_>>(), ["α = 0", "A_y = 0"]);
    // The friction of a pressed foot is no multiple of the mass.
    let (pressed, _) = model_of("28-painleve-rod");
    assert!(lines(&pressed.modes[0].equations).contains(&"m A_x = f_foot".to_owned()), "{pressed:?}");
}

#[test]
fn the_laws_of_impacts_stand_once_for_all_that_strike_alike() {
    let (disks, _) = model_of("24-glancing-disks");
    assert_eq!(lines(&disks.impacts)[0], "J₁ = e J₀", "{disks:?}");
    assert_eq!(
        lines(&disks.bodies[0].laws[1..]),
        ["m₁ (Δv_disk1) = Σ\u{2009}J", "I_disk1 (Δω_disk1) = Σ\u{2009}r × J"]
    );
    let (pool, _) = model_of("25-pool-break");
    let titles: Vec<String> = pool.impacts.iter().map(|block| block.title.to_plain()).collect();
    assert_eq!(titles.len(), 2, "{titles:?}");
    let (rod, _) = model_of("01-pendulum-in-the-wind");
    assert!(rod.impacts.is_empty() && rod.bodies[0].laws.len() == 1, "{rod:?}");
}

/// The ratio of speeds is that of impulses where contacts strike one by one, and only there.
#[test]
fn what_strikes_at_once_has_a_ratio_of_impulses() {
    let first = |name: &str| lines(&model_of(name).0.impacts)[0].clone();
    assert_eq!(first("22-newtons-cradle"), "v_(n,1) = \u{2212}v_(n,0)");
    assert_eq!(first("09-bouncing-ball"), "v_(n,1) = \u{2212}e v_(n,0)");
    assert!(
        first("23-three-balls-at-once").starts_with("J\u{2081} = "),
        "{}",
        first("23-three-balls-at-once")
    );
}

/// The hammer gives the crank an angular impulse that no force has.
#[test]
fn couples_of_an_instant_are_in_the_law_of_impacts() {
    let (linkage, _) = model_of("13-four-bar-linkage");
    let of = |body: usize| lines(&linkage.bodies[body].laws[1..])[1].clone();
    assert!(of(0).ends_with("r × J + Σ\u{2009}H") && of(1).ends_with("r × J"), "{} {}", of(0), of(1));
}

/// A ball among others is touched from all sides: no direction stands for two.
#[test]
fn each_contact_has_a_direction_of_its_own() {
    let (pool, _) = model_of("25-pool-break");
    let laws = lines(pool.bodies.iter().flat_map(|body| &body.laws));
    let pushed: Vec<&String> = laws.iter().filter(|line| line.matches("N_").count() > 2).collect();
    assert!(!pushed.is_empty(), "{laws:?}");
    for line in pushed {
        assert_eq!(line.matches("n_").count(), line.matches("N_").count(), "{line}");
    }
    // All feet on one floor are pushed alike.
    let (block, _) = model_of("17-block-on-a-slope");
    let rows = block.bodies[0].forces.iter().flat_map(|row| &row.law);
    assert!(rows.clone().any(|line| line.text.starts_with("n = ")), "{:?}", rows.collect::<Vec<_>>());
}

#[test]
fn what_never_strikes_has_no_impacts_in_its_assumptions() {
    let speaks = |name: &str| {
        let assumed = model_of(name).0.assumptions;
        assumed.iter().any(|text| text.to_plain().starts_with("An impact"))
    };
    assert!(speaks("09-bouncing-ball") && !speaks("20-rolling-down") && !speaks("28-painleve-rod"));
}

/// Of four periods of the gusts the third swings the pendulum furthest.
#[test]
fn diagrams_are_of_the_run_with_the_greatest_answer() {
    let (study, cases) = crate::scenes::motions_called("01-pendulum-in-the-wind");
    assert_eq!(fullest(&study, &cases).expect("a run").label, "T = 2 s");
}

#[test]
fn the_second_of_two_bodies_has_the_opposite_of_the_impulse() {
    let (study, cases) = crate::scenes::motions_called("24-glancing-disks");
    let model = of(&study, &Names::of(&study).expect("names"), &cases).expect("a model");
    let has_minus = |body: &BodyModel| body.diagrams[0].svg.description.contains("\u{2212}J");
    assert_eq!(model.bodies.iter().map(has_minus).collect::<Vec<_>>(), [false, true]);
}
