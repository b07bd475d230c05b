//! The scenes that come with the program are read without a mistake, and hold what they say.

use std::path::PathBuf;

use tumble_scene::{Folder, Override, Study, SweepValue, Swept, read, read_bytes_in};

fn path(scene: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(scene).join("scene.toml")
}

fn study(scene: &str, overrides: &[Override]) -> Study {
    let bytes = std::fs::read(path(scene)).expect(scene);
    read_bytes_in(scene, &bytes, overrides, &Folder::of(&path(scene)))
        .unwrap_or_else(|mistakes| panic!("{}", mistakes.render(false, 100)))
}

fn value(study: &Study, parameter: &str) -> f64 {
    let symbols = study.model.parameters.symbols();
    let index = symbols.iter().position(|symbol| *symbol.name == *parameter).expect(parameter);
    study.model.parameters.values().expect("numbers")[index]
}

#[test]
fn the_kicked_ball() {
    let study = study("04-kicked-ball", &[]);
    assert_eq!((study.plots.len(), study.checks.len(), study.stroboscopes.len()), (4, 7, 1));
    // Speed and angular rate after the kick, by the impulse F dt and its moment.
    let run = study.model.simulate_to(&[], study.until.clone(), study.accuracy).expect("a motion");
    let found = ["ball.vx", "ball.omega"].map(|name| {
        let formula = study.quantities[name].formula.clone();
        run.at(1.0).and_then(|end| end.value(formula)).expect("a value")
    });
    assert!((found[0] - 4.651162790697675).abs() < 1e-14, "{found:?}");
    assert!((found[1] + 28.829521429944272).abs() < 1e-13, "{found:?}");
    let units = ["angle", "omega", "alpha", "x", "vx", "ax", "kinetic"];
    let units = units.map(|name| study.quantities[&format!("ball.{name}")].unit.clone());
    assert_eq!(units, ["rad", "rad/s", "rad/s^2", "m", "m/s", "m/s^2", "J"]);
}

#[test]
fn the_thrown_rod() {
    let study = study("02-thrown-rod", &[]);
    for name in ["rod.x", "rod.alpha", "rod.tip.ay", "rod.cm.vx", "rod.energy", "rod.kinetic", "t"] {
        assert!(study.quantities.contains_key(name), "{name}");
    }
    assert_eq!(study.symbols["rod.angle"], "theta");
    assert_eq!(study.plots[0].y.len(), 2);
    let labels: Vec<_> = study.sweep[0].values.iter().map(|value| value.label).collect();
    assert_eq!(labels, ["without air", "with air"]);
}

#[test]
fn settings_stand_in_the_place_of_parameters() {
    let set = |name: &str, text: &str| Override { name: name.into(), text: text.into() };
    let study = study("04-kicked-ball", &[set("F", "1kN"), set("b", "0"), set("dt", "R/(11 m/s)")]);
    assert_eq!((value(&study, "F"), value(&study, "b"), value(&study, "dt")), (1000.0, 0.0, 0.01));
    assert_eq!(value(&study, "during"), 0.005);
}

#[test]
fn a_byte_order_mark_and_windows_lines_are_no_mistakes() {
    let text = std::fs::read_to_string(path("02-thrown-rod")).expect("a scene");
    let text = format!("\u{feff}{}", text.replace('\n', "\r\n"));
    assert!(read("scene.toml", &text, &[]).is_ok());
    let wrong = text.replace("m = \"0.5 kg\"", "m = \"0.5 kgg\"");
    let mistakes = read("scene.toml", &wrong, &[]).expect_err("no unit");
    let line = 1 + text.lines().position(|line| line.starts_with("m = ")).expect("a mass");
    assert_eq!(mistakes.position(&mistakes.list[0]), Some((line, 10)));
}

/// Gusts in step with the swing throw the pendulum over the top, others do not.
#[test]
fn the_pendulum_in_the_wind() {
    let study = study("01-pendulum-in-the-wind", &[]);
    let expected = [(0.0, 0.55), (0.0, 0.59), (-2.38, 3.06), (-0.80, 1.44)];
    for (choice, (low, high)) in choices(&study).iter().zip(expected) {
        let run = choice.model.simulate_to(&[], choice.until.clone(), choice.accuracy).expect("a motion");
        let angle = study.quantities["rod.angle"].formula.clone();
        let at = |step: i32| {
            run.at(f64::from(step) / 100.0).and_then(|at| at.value(angle.clone())).expect("a value")
        };
        let angles: Vec<f64> = (0..=2000).map(at).collect();
        let (least, most) =
            (angles.iter().copied().fold(0.0, f64::min), angles.iter().copied().fold(0.0, f64::max));
        assert!((least - low).abs() < 0.006 && (most - high).abs() < 0.006, "{least} to {most}");
    }
}

/// The study with each combination of the values that it sweeps.
fn choices(study: &Study) -> Vec<Study> {
    let mut choices = vec![study.clone()];
    for axis in &study.sweep {
        let with = |study: &Study, value: &SweepValue| {
            let mut study = study.clone();
            if let Swept::Parameter(name) = &axis.of {
                study.model.parameters.set(name, value.value.clone()).expect("a value");
            }
            study
        };
        choices =
            choices.iter().flat_map(|study| axis.values.iter().map(|value| with(study, &value))).collect();
    }
    choices
}
