//! Input that no person writes: very large, very deep, very long. It is read or refused, and soon.

use std::time::{Duration, Instant};

use tumble_scene::{Study, read, read_bytes};

/// Each of these takes a small part of a second on an idle machine.
const SOON: Duration = Duration::from_secs(20);

fn scene(parameters: &str) -> String {
    format!(
        "version = 1\nworld.gravity = 0\nrun.until = \"1 s\"\nbody.b = {{ point = {{}}, mass = \"1 kg\" }}\n\n[parameters]\n{parameters}\n"
    )
}

/// The study, or the first message.
#[track_caller]
fn soon(text: &str) -> Result<Study, String> {
    let start = Instant::now();
    let outcome = read("scene.toml", text, &[]);
    let shown = outcome.map_err(|mistakes| mistakes.render(false, 100));
    assert!(start.elapsed() < SOON, "it took {:?}", start.elapsed());
    shown
}

#[test]
fn parameters_that_double_each_other() {
    let doubled: String = (1..=60).map(|n| format!("a{n} = \"a{} + a{}\"\n", n - 1, n - 1)).collect();
    let study = soon(&scene(&format!("a0 = \"1 m\"\n{doubled}"))).expect("a study");
    let values = study.model.parameters.values().expect("numbers");
    assert!(values.contains(&(1u64 << 60).to_string().parse().expect("a number")));
}

#[test]
fn functions_that_double_each_other() {
    let doubled: String =
        (1..=60).map(|n| format!("\"f{n}(a)\" = \"f{}(a) + f{}(a)\"\n", n - 1, n - 1)).collect();
    let functions = format!("[functions]\n\"f0(a)\" = \"a + a\"\n{doubled}");
    let text = scene(&format!("x = \"f60(1 m)\"\n{functions}"));
    let study = soon(&text).expect("a study");
    assert_eq!(study.model.parameters.values().expect("numbers"), [2f64.powi(61)]);
    let plot = "[plot.p]\ny = \"f60(b.x)\"\n";
    let study = soon(&format!("{text}{plot}")).expect("a study");
    assert_eq!(study.plots[0].y[0].quantity.unit, "m");
}

#[test]
fn brackets_and_signs_beyond_measure() {
    for (open, close) in [("(", ")"), ("[", "]"), ("-", ""), ("sin(", ")"), ("2^", "")] {
        let formula = format!("{}1{}", open.repeat(100_000), close.repeat(100_000));
        assert!(soon(&scene(&format!("x = \"{formula}\""))).is_err(), "{open}");
    }
    let tables = format!("x = {}{}", "[".repeat(100_000), "]".repeat(100_000));
    assert!(soon(&scene(&tables)).is_err());
    assert!(soon(&scene(&format!("x = {}", "{ a = ".repeat(100_000)))).is_err());
    assert!(soon(&scene(&format!("[{}]\ny = 1", "a.".repeat(50_000) + "a"))).is_err());
}

#[test]
fn long_names_and_titles() {
    let name = "n".repeat(10_000);
    let text = scene(&format!("{name} = \"1 m\"\nx = \"2*{name}\"\ny = \"2*{name}n\""));
    assert!(soon(&text).is_err_and(|said| said.contains("E0301")));
    let titled = |title: &str| soon(&format!("title = \"{title}\"\n{}", scene("x = 1")));
    let study = titled("Шар, bal·le, 球 \u{1f3b1}").expect("a study");
    assert!(study.title.contains('球'));
    assert!(titled("Шар \u{202e}").is_err_and(|said| said.contains("E0507") && !said.contains('\u{202e}')));
}

#[test]
fn many_mistakes_are_not_all_looked_into() {
    let known: String = (0..20_000).map(|n| format!("known{n} = \"1 m\"\n")).collect();
    let unknown: String = (0..20_000).map(|n| format!("unknown{n} = \"knowm{n}x + 1 m\"\n")).collect();
    assert!(soon(&scene(&format!("{known}{unknown}"))).is_err_and(|said| said.contains("more")));
}

#[test]
fn long_sweeps_and_lists() {
    let list = vec!["\"1 s\""; 1_000_000].join(", ");
    let text = format!("{}\n[sweep]\nx = [{list}]\n", scene("x = \"1 s\""));
    assert!(soon(&text).is_err_and(|said| said.contains("1000000 runs")));
}

#[test]
fn an_empty_scene_and_one_without_bodies() {
    for text in ["", " \n", "\u{feff}", "# nothing\n"] {
        assert!(soon(text).is_err());
    }
    let said = soon("version = 1\nworld.gravity = 0\nrun.until = \"1 s\"\n[body]\n").map(drop);
    assert!(said.is_err_and(|said| said.contains("there is no body")));
}

#[test]
fn bytes_that_are_no_text() {
    for bytes in [&b"\xff\xfe"[..], b"\xef\xbb", b"a = \"\xc3\"", &[0; 1000]] {
        assert!(
            read_bytes("scene.toml", bytes, &[])
                .is_err_and(|mistakes| !mistakes.render(false, 80).is_empty())
        );
    }
}

#[test]
fn a_figure_in_another_unit_holds_numbers_of_it() {
    let plots = "[plot.p]\nx = \"b.x - 3 in in ft\"\ny = [\"b.omega in rpm\", \"2*b.omega in rpm\"]\n";
    let study = soon(&format!("{}{plots}", scene(""))).expect("a study");
    let plot = &study.plots[0];
    let (x, y) = (plot.x.as_ref().expect("given"), &plot.y[0]);
    assert_eq!((x.quantity.unit.as_str(), y.quantity.unit.as_str()), ("ft", "rpm"));
    assert_eq!((x.text.as_str(), y.text.as_str()), ("b.x - 3 in", "b.omega"));
    // At the origin 3 in before it is -1/4 ft.
    let number = |formula: &tumble_expr::Expr| {
        let mut by = tumble_expr::Substitution::default();
        for body in &study.model.bodies {
            let motion = body.kinematics();
            let [x, _] = motion.position_symbols();
            by.insert(x, 0 * tumble_expr::units::M);
        }
        study.number(&by.apply(formula)).expect("a number")
    };
    assert_eq!(number(&x.quantity.formula), -0.25);
}
