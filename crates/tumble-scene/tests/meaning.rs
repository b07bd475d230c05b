//! What sections of laws, events, tables and sweeps come to: studies that are run.

#[path = "common/beside.rs"]
mod beside;

use beside::Beside;
use tumble_mech::{Action, Run};
use tumble_scene::{NoFiles, Override, Study, Swept, read_in};

fn study(text: &str, overrides: &[Override]) -> Study {
    let scene = format!("version = 1\nworld.gravity = \"10 m/s^2\"\nrun.until = \"2 s\"\n{text}");
    read_in("scene.toml", &scene, overrides, &Beside)
        .unwrap_or_else(|mistakes| panic!("{}", mistakes.render(false, 100)))
}

fn run(study: &Study) -> Run {
    study.model.simulate_to(&[], study.until.clone(), study.accuracy).expect("a motion")
}

fn at(study: &Study, run: &Run, time: f64, name: &str) -> f64 {
    let formula = study.quantities[name].formula.clone();
    run.at(time).and_then(|instant| instant.value(formula)).expect("a value")
}

const STONE: &str = "[body.stone]\npoint = {}\nmass = \"2 kg\"\n\
    start = { at = [0, 0], velocity = [\"3 m/s\", \"10 m/s\"] }\n";

#[test]
fn a_measured_wind_carries_in_its_units() {
    let table = "[table.gust]\nfile = \"gust.csv\"\ncolumns = [\"t [ms]\", \"w [km/h]\"]\n\
        interpolation = \"linear\"\noutside = \"hold\"\n";
    let study = study(
        &format!(
            "world.wind = [\"gust(t)\", 0]\n{table}{STONE}\n[drag.air]\nat = \"stone.cm\"\nlinear = \"2000 kg/s\"\n"
        ),
        &[],
    );
    // So strong a resistance that the stone goes with the wind: 36 km/h at 500 ms, 18 km/h at 1000 ms and after.
    let run = run(&study);
    assert!((at(&study, &run, 0.499, "stone.vx") - 9.98).abs() < 0.03);
    assert!((at(&study, &run, 1.9, "stone.vx") - 5.0).abs() < 1e-3);
}

#[test]
fn inside_the_wind_x_and_y_are_the_place() {
    let scene = format!(
        "world.wind = [\"x/(1 s) + half(y)\", 0]\nparameters.x = \"7 s\"\nfunctions.\"half(s)\" = \"s/x\"\n{STONE}"
    );
    let study = study(&scene, &[]);
    let place = tumble_expr::Vector::planar(4 * tumble_expr::units::M, 14 * tumble_expr::units::M);
    let wind = study.model.wind.at(&place);
    let speed = study.number(wind.x()).expect("a number");
    assert_eq!(speed, 6.0);
}

#[test]
fn events_are_found_and_change_parameters() {
    let scene = format!(
        "parameters.g2 = \"0 N\"\n{STONE}\n[event.apex]\nwhen = \"stone.vy falls through 0 m/s\"\n\
         action = {{ set = {{ g2 = \"6 N\" }} }}\n\
         [event.down]\nwhen = \"stone.y falls through 1 m\"\naction = \"stop\"\n\
         [force.side]\non = \"stone\"\nat = \"stone.cm\"\nforce = [\"g2\", \"2 N\"]\nduring = [\"apex\", \"10 s\"]\n"
    );
    let study = study(&scene, &[]);
    assert!(matches!(&study.model.events[0].action, Action::Set(set) if set[0].0 == "g2"));
    let run = run(&study);
    let time = |name: &str| {
        let happening = run.equations.named(name).expect(name);
        let mut events = run.trajectory().events.iter();
        let event = events.find(|event| event.record.happened.contains(&happening));
        event.expect(name).time
    };
    assert!((time("apex") - 1.0).abs() < 1e-12);
    // From 5 m down to 1 m it falls with 9 m/s^2, and is pushed aside with 3 m/s^2.
    assert!((time("down") - 1.0 - (8.0f64 / 9.0).sqrt()).abs() < 1e-9);
    assert!((at(&study, &run, 1.9, "stone.vx") - (3.0 + 0.9 * 3.0)).abs() < 1e-9);
}

#[test]
fn a_spring_pulls_and_a_damper_holds_back() {
    let scene = "[body.a]\npoint = {}\nmass = \"1 kg\"\nstart = { at = [\"1 m\", 0] }\n\
        [spring.s]\nbetween = [\"a.cm\", { world = [0, 0] }]\nstiffness = \"(2*pi)^2*1 N/m\"\nrest_length = 0\n";
    let study = study(scene, &[]);
    let run = run(&study);
    assert!((at(&study, &run, 0.5, "a.x") + 1.0).abs() < 1e-9);
}

#[test]
fn a_sweep_has_values_labels_and_units() {
    let scene = format!(
        "{STONE}\n[parameters]\na = \"1 m\"\nb = \"2*a\"\nv = \"10 km/h\"\nn = 1\n[sweep]\na = [0, \"b/2 + 1 cm\"]\n\
         v = {{ from = \"10 km/h\", to = \"1000 km/h\", count = 3, spacing = \"log\" }}\nn = [1, 2.5]\n"
    );
    let refused =
        tumble_scene::read("scene.toml", &format!("version = 1\n{scene}"), &[]).expect_err("a circle");
    assert!(refused.to_string().contains("depends on `a`, which is swept"));
    let study = self::study(&scene.replace("b/2 + 1 cm", "n*3 cm").replace("n = [1, 2.5]\n", ""), &[]);
    let labels = |axis: usize| {
        let values = study.sweep[axis].values.iter();
        values
            .map(|value| (value.label.clone(), study.number(&value.value).expect("a number")))
            .collect::<Vec<_>>()
    };
    assert_eq!(labels(0), [("a = 0".to_owned(), 0.0), ("a = n*3 cm".to_owned(), 0.03)]);
    let speeds = labels(1);
    assert_eq!(speeds[1].0, "v = 100 km/h");
    assert!((speeds[1].1 - 100.0 / 3.6).abs() < 1e-12);
    assert_eq!(study.sweep[0].values.at(0).value.dimension(), Ok(tumble_expr::Dimension::LENGTH));
}

#[test]
fn a_setting_takes_the_place_of_a_sweep() {
    let set = Override { name: "a".into(), text: "3 m".into() };
    let study =
        study(&format!("{STONE}\n[parameters]\na = \"1 m\"\n[sweep]\na = [\"1 m\", \"2 m\"]\n"), &[set]);
    assert!(study.sweep.is_empty());
}

#[test]
fn the_accuracy_is_set_and_swept_like_a_parameter() {
    let sweep =
        "[sweep]\naccuracy = { from = 1e-12, to = 1e-6, count = 3, spacing = \"log\" }\nv = [\"1 m/s\"]\n";
    let scene = format!("{STONE}\n[parameters]\nv = \"1 m/s\"\n{sweep}");
    let swept = study(&scene, &[]);
    assert_eq!((&swept.sweep[0].of, swept.sweep.len()), (&Swept::Accuracy, 2));
    let values = swept.sweep[0].values.iter();
    let values: Vec<_> =
        values.map(|value| (swept.number(&value.value).expect("a number"), value.label)).collect();
    let labels = ["accuracy = 1e-12", "accuracy = 1e-9", "accuracy = 1e-6"];
    for ((value, label), (expected, known)) in
        values.into_iter().zip([1e-12f64, 1e-9, 1e-6].into_iter().zip(labels))
    {
        assert!((value / expected - 1.0).abs() < 1e-12, "{value}");
        assert_eq!(label, known);
    }
    let set = |text: &str| Override { name: "accuracy".into(), text: text.into() };
    let set = study(&scene, &[set("1e-4"), set(" 1e-5 ")]);
    assert_eq!((set.accuracy.value(), set.sweep.len()), (1e-5, 1), "the last one counts");
}

/// A setting may end the run before what the scene looks at. Without one, that is a mistake of the scene.
#[test]
fn a_setting_may_end_the_run_early() {
    let scene = format!(
        "version = 1\nworld.gravity = \"10 m/s^2\"\nrun.until = \"end\"\noutput.every = \"1 s\"\n{STONE}\n\
         [parameters]\nend = \"2 s\"\n[plot.y]\ny = \"stone.y\"\nduring = [\"1.5 s\", \"2 s\"]\n\
         [find.y]\nthat = \"stone.y\"\nat = \"2 s\"\n[find.least]\nthat = \"stone.y\"\nat = \"its least\"\n\
         during = [\"1.5 s\", \"2 s\"]\n"
    );
    let codes = |scene: &str, set: &[&str]| {
        let set: Vec<_> =
            set.iter().map(|text| Override { name: "end".into(), text: (*text).into() }).collect();
        let mistakes = read_in("scene.toml", scene, &set, &NoFiles).err();
        mistakes
            .into_iter()
            .flat_map(|found| found.list)
            .map(|mistake| mistake.code.as_str())
            .collect::<Vec<_>>()
    };
    assert!(codes(&scene, &[]).is_empty());
    assert!(codes(&scene, &["0.5 s"]).is_empty());
    assert_eq!(codes(&scene, &["0 s"]), ["E0530"], "no run at all");
    let short = scene.replace("end = \"2 s\"", "end = \"0.5 s\"");
    assert_eq!(codes(&short, &[]), ["E0533"; 4]);
    let early = scene.replace("at = \"2 s\"", "at = \"-2 s\"");
    assert_eq!(codes(&early, &["0.5 s"]), ["E0533"], "nothing comes before the start");
}

#[test]
fn units_of_what_is_shown() {
    let plots = [
        ("stone.energy", "J"),
        ("stone.energy/(2 s)", "W"),
        ("2 kg*stone.ay", "N"),
        ("1 m*2 kg*stone.ay", "N m"),
        ("stone.angle/2", "rad"),
        ("stone.omega", "rad/s"),
        ("stone.x/stone.y", ""),
        ("stone.x*stone.y", "m^2"),
    ];
    for (y, unit) in plots {
        let study = study(&format!("{STONE}\n[plot.a]\ny = \"{y}\"\n"), &[]);
        assert_eq!(study.plots[0].y[0].quantity.unit, unit, "{y}");
    }
}
