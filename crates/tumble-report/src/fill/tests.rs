//! What holds in whole reports.

use tumble_scene::{NoFiles, Study};

use super::of;
use crate::report::Report;
use crate::results::{Case, CaseBalance, Runs, Surveyor};
use crate::scenes;

/// A sweep of a pendulum whose pose of equilibrium is asked for, with events, and a claim.
const PENDULUM: &str = r#"
    version = 1
    world.gravity = "9.81 m/s^2"
    run.until = "3 s"
    sweep = { A = ["20 deg", "30 deg"] }

    [parameters]
    A = "20 deg"

    [body.rod]
    rod = { from = [0, 0], to = [0, "-1 m"] }
    mass = "2 kg"
    start = { angle = "A" }

    [pivot.hinge]
    body = "rod"
    point = [0, 0]
    world = [0, "3 m"]

    [find.last]
    that = "rod.angle"

    [check.start]
    that = "rod.angle"
    at = "0 s"
    equals = "A"
    within = "1e-9 rad"

    [equilibrium]
"#;

fn report((study, mut cases): (Study, Vec<Case>)) -> Report {
    for case in &mut cases {
        case.balance = CaseBalance::of(case).expect("a balance");
    }
    let survey = Surveyor::of(&study, true).expect("a sweep").end(vec![]);
    of(&study, Runs { cases: &cases, missing: &[], survey: &survey }).expect("a report")
}

/// The captions of all tables of a page, without marks.
fn captions(page: &str) -> Vec<String> {
    let inside = |part: &str| Some(part.split_once("</caption>")?.0.to_owned());
    let all = page.split("<caption>").skip(1).filter_map(inside);
    let plain = |caption: String| {
        let parts = caption.split('<').map(|part| part.split_once('>').map_or(part, |(_, words)| words));
        parts.collect::<String>()
    };
    all.map(plain).collect()
}

#[test]
fn captions_of_tables_are_sentences() {
    let pendulum = scenes::motions_in("pendulum", PENDULUM.as_bytes(), &NoFiles);
    let [pendulum, ball] =
        [pendulum, scenes::motions_called("09")].map(|motions| captions(&report(motions).html()));
    for words in ["The bodies have", "The runs are", "equilibrium", "hold", "claims"] {
        assert!(pendulum.iter().any(|caption| caption.contains(words)), "{words}: {pendulum:?}");
    }
    assert!(ball.iter().any(|caption| caption.contains("events")), "{ball:?}");
    for caption in pendulum.iter().chain(&ball) {
        let words = caption.split(' ').count();
        assert!(caption.starts_with(char::is_uppercase) && caption.ends_with('.') && words > 2, "{caption}");
    }
}

/// 20 degrees at the start, in the table of claims of both forms.
#[test]
fn angles_that_were_found_are_told_in_degrees_too() {
    let report = report(scenes::motions_in("pendulum", PENDULUM.as_bytes(), &NoFiles));
    let spaces = |text: String| text.replace("\u{a0}", " ");
    let html = spaces(report.html());
    let rows: Vec<&str> = html.split("<tr>").filter(|row| row.contains("✓")).collect();
    assert!(rows.len() == 2 && rows[0].matches("(20°)").count() == 2, "{}", rows.len());
    let markdown = spaces(report.markdown());
    let rows: Vec<&str> = markdown.lines().filter(|row| row.contains("passed")).collect();
    assert!(rows.len() == 2 && rows[1].matches("30°").count() == 2, "{rows:?}");
}

#[test]
fn what_is_computed_as_an_angle_has_its_unit() {
    let block = report(scenes::motions_called("27-rocking-block"));
    let unit = |symbol: &str| {
        let own =
            block.identify.parameters.iter().find(|row| row.symbol == crate::report::Text::symbol(symbol));
        own.map(|row| row.unit.clone()).unwrap_or_default()
    };
    assert_eq!(["alpha", "theta_0", "omega_0", "r"].map(unit), ["deg", "deg", "rad/s", ""]);
}

/// Walks that follow each formula to what it is computed of take longer with every parameter, twice as long every other one.
#[test]
fn parameters_computed_of_parameters_are_each_looked_at_once() {
    let next = |n: usize| format!("A{n} = \"0.5*A{} + 0.5*A{}\"", n - 1, n - 2);
    let chain: Vec<String> = (2..64).map(next).collect();
    let given = format!("A = \"A0\"\nA0 = \"20 deg\"\nA1 = \"A0\"\n{}", chain.join("\n"));
    let scene = PENDULUM.replace("sweep = { A =", "sweep = { A0 =").replacen("A = \"20 deg\"", &given, 1);
    let (study, cases) = scenes::motions_in("chain", scene.as_bytes(), &NoFiles);
    assert!(study.is_angle("A63"));
    let found = report((study, cases));
    let last = crate::report::Text::symbol("A63");
    let row = found.identify.parameters.iter().find(|row| row.symbol == last).expect("the last of the chain");
    assert_eq!(row.value, crate::report::Text::default(), "the value of one run");
}
