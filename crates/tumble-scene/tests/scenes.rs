//! The scenes that come with the program are read without a mistake, and hold what they say.

use std::path::PathBuf;

use tumble_scene::{Override, Study, read, read_bytes};

fn path(scene: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(scene).join("scene.toml")
}

fn study(scene: &str, overrides: &[Override]) -> Study {
    let bytes = std::fs::read(path(scene)).expect(scene);
    read_bytes(scene, &bytes, overrides).unwrap_or_else(|mistakes| panic!("{}", mistakes.render(false, 100)))
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
    assert!((value(&study, "V") - 4.651162790697675).abs() < 1e-15);
    assert!((value(&study, "omega") + 28.829521429944272).abs() < 1e-13);
    assert!(study.quantities["ball.angle"].angle && !study.quantities["ball.omega"].angle);
}

#[test]
fn the_thrown_rod() {
    let study = study("02-thrown-rod", &[]);
    for name in ["rod.x", "rod.alpha", "rod.tip.ay", "rod.cm.vx", "rod.energy", "rod.kinetic", "t"] {
        assert!(study.quantities.contains_key(name), "{name}");
    }
    assert_eq!(study.symbols["rod.angle"], "theta");
    assert_eq!(study.plots[0].y.len(), 2);
}

#[test]
fn settings_stand_in_the_place_of_parameters() {
    let set = |name: &str, text: &str| Override { name: name.into(), text: text.into() };
    let study = study("04-kicked-ball", &[set("F", "1kN"), set("y", "0"), set("dt", "R/(11 m/s)")]);
    assert_eq!((value(&study, "F"), value(&study, "y"), value(&study, "dt")), (1000.0, 0.0, 0.01));
    assert_eq!(value(&study, "omega"), 0.0);
}

#[test]
fn a_byte_order_mark_and_windows_lines_are_no_mistakes() {
    let text = std::fs::read_to_string(path("02-thrown-rod")).expect("a scene");
    let text = format!("\u{feff}{}", text.replace('\n', "\r\n"));
    assert!(read("scene.toml", &text, &[]).is_ok());
    let wrong = text.replace("m = \"0.5 kg\"", "m = \"0.5 kgg\"");
    let mistakes = read("scene.toml", &wrong, &[]).expect_err("no unit");
    assert_eq!(mistakes.position(&mistakes.list[0]), Some((9, 10)));
}

/// The figures that a scene's checks compare with, in the same formulas.
#[test]
fn every_check_of_the_scenes_holds() {
    for scene in ["02-thrown-rod", "04-kicked-ball"] {
        let study = study(scene, &[]);
        let number = |formula| study.number(formula).expect("a number");
        let run = study.model.simulate_to(&[], study.until.clone(), study.accuracy).expect("a motion");
        for check in &study.checks {
            let at = check.at.as_ref().map_or(number(&study.until), number);
            let found = run.at(at).and_then(|instant| instant.value(check.that.quantity.formula.clone()));
            let difference = (found.expect("a value") - number(&check.equals)).abs();
            println!("{scene} {}: {difference:e}", check.name);
            assert!(difference <= number(&check.within), "{scene} {}: {difference:e}", check.name);
        }
    }
}
