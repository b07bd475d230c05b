//! The report of every scene: it says what the summary says, shows what a scene calls itself and runs none of it.

use crate::common::{folder, gallery, read, repository, write};
use serde_json::Value;
use tumble::pipeline::{self, Options, Outcome};
use tumble::{CheckResult, ReportForm};

/// A report is one file that is mailed and opened on telephones.
const LARGEST: usize = 2 << 20;

fn run(scene: &std::path::Path, out: &std::path::Path, report: ReportForm) -> Outcome {
    let options = Options { out: out.to_owned(), report, ..Options::default() };
    pipeline::run(scene, &options).expect("a motion")
}

#[test]
fn numbers_are_those_of_the_summary() {
    for (name, outcome) in gallery() {
        let page = read(&outcome.folder.join("report.html")).replace('\u{2009}', "");
        assert!(page.len() < LARGEST, "{name}: {} bytes", page.len());
        let text = read(&outcome.folder.join("summary.json"));
        let mut compared = 0;
        for check in outcome.cases.iter().flat_map(|case| &case.checks) {
            let found = format!("{:?}", check.found);
            assert!(text.contains(&format!("\"found\": {found}")), "{name}: {found} is not in the summary");
            let known = as_compared(check);
            let ways = [format!("{known:?}"), format!("{known:e}")].map(|number| as_printed(&number));
            let is_shown = ways.iter().any(|shown| page.contains(shown));
            assert!(is_shown, "{name}: {} of check {} is not in the report", ways[0], check.name);
            compared += 1;
        }
        let summary: Value = serde_json::from_str(&text).expect("JSON");
        for run in summary["runs"].as_array().expect("runs") {
            let steps = run["numerics"]["steps"].as_u64().expect("steps").to_string();
            assert!(page.contains(&steps), "{name}: {steps} steps");
            let residual = run["balance"]["largest_relative_residual"].as_f64().expect("a number");
            assert!(residual < BALANCED, "{name}: {residual:e} of the balance is left");
        }
        assert!(compared > 0, "{name} has checks");
    }
}

/// What was found to the place of its error, where there is one, and to two places behind what is allowed.
fn as_compared(check: &CheckResult) -> f64 {
    let place = |value: f64| value.abs().log10().floor();
    let (found, error) = (check.found, check.error.filter(|error| *error > 0.0));
    if error.is_some_and(|error| found.abs() <= error) {
        return 0.0;
    }
    let known = error.map_or(f64::INFINITY, |error| place(found) - place(error));
    let compared = (place(found) - place(check.within)).max(0.0) + 2.0;
    let behind = compared.min(known).clamp(0.0, 16.0);
    format!("{found:.*e}", behind as usize).parse().expect("a number")
}

/// A number as Rust writes it, as a page shows it: a true minus, powers of ten as such, no fraction of zero.
fn as_printed(number: &str) -> String {
    let number = number.replace('-', "−");
    let whole = |digits: &str| digits.strip_suffix(".0").unwrap_or(digits).to_owned();
    match number.split_once('e') {
        Some((digits, power)) => format!("{}×10<sup>{power}</sup>", whole(digits)),
        None => whole(&number),
    }
}

/// What is left of a balance, in parts of what moves in it.
const BALANCED: f64 = 1e-8;

/// The figures of the balance show their columns, and each only its own.
#[test]
fn balances_are_figures_where_a_scene_asks_for_them() {
    let out = folder();
    let path = out.path().join("throw.toml");
    let scene = read(&repository("scenes/02-thrown-rod/scene.toml"));
    let sheets =
        ["energies", "works", "residual"].map(|show| format!("[balance.{show}]\nshow = \"{show}\"\n"));
    write(&path, &format!("{scene}\n{}", sheets.concat()));
    let outcome = run(&path, out.path(), ReportForm::None);
    let drawn = |name: &str| read(&outcome.folder.join(format!("{name}.svg")));
    for (name, [own, other]) in
        [("energies", ["kinetic", "air on rod"]), ("works", ["air on rod", "kinetic"])]
    {
        let svg = drawn(name);
        // Two runs, with the name of each behind that of the curve.
        assert!(svg.contains(own) && !svg.contains(other), "{name}");
        assert!(svg.contains("with air") && svg.contains("without air"), "{name}");
    }
    assert!(drawn("residual").contains("with air"));
}

#[test]
fn markdown_links_to_the_figures() {
    let out = folder();
    let outcome = run(&repository("scenes/04-kicked-ball/scene.toml"), out.path(), ReportForm::Markdown);
    let text = read(&outcome.folder.join("report.md"));
    assert!(!outcome.folder.join("report.html").exists());
    for figure in ["x.svg", "ball.svg"] {
        assert!(text.contains(figure) && outcome.folder.join(figure).is_file(), "{figure}");
    }
    for move_ in ["Identify", "Model", "Solve", "Analyze"] {
        assert!(text.contains(move_), "{move_}");
    }
}

/// What a scene says is shown, never run.
#[test]
fn a_scene_s_texts_are_shown_and_not_run() {
    let evil = "<script>alert(1)</script><img src=x onerror=alert(2)>";
    let scene = read(&repository("scenes/04-kicked-ball/scene.toml"));
    let scene = scene.replacen("title = \"", &format!("title = \"{evil}"), 2);
    let place = folder();
    let file = place.path().join("scene.toml");
    write(&file, &scene);
    let outcome = run(&file, place.path(), ReportForm::Html);
    let page = read(&outcome.folder.join("report.html"));
    assert!(!page.contains("<script>alert") && !page.contains("<img src=x"), "it would run");
    assert!(page.contains("&lt;script&gt;alert(1)"), "it is shown");
}

/// The closed forms of the textbook's kicked ball.
#[test]
fn the_kicked_ball_is_solved_in_symbols() {
    let out = folder();
    let outcome = run(&repository("scenes/04-kicked-ball/scene.toml"), out.path(), ReportForm::Html);
    let page = read(&outcome.folder.join("report.html"));
    for formula in
        ["M A_x = F", "I α = −b F", "X = F t²/(2 M)", "θ = −b F t²/(2 I)", "V = F T/M", "ω = −b F T/I"]
    {
        assert!(page.contains(formula), "{formula}");
    }
}

/// Two disks alike, shown by the same letters: each has its own moment of inertia, by its own name.
#[test]
fn a_moment_of_inertia_is_that_of_its_body() {
    const DISKS: &str = r#"version = 1
        title = "Three disks"
        world.gravity = "9.81 m/s^2"
        run.until = "1 s"
        [parameters]
        m1 = "1 kg"
        m2 = "8 kg"
        R = "1 m"
        I1 = "m1*R^2/2"
        [body.first]
        disk = { radius = "R" }
        mass = "m1"
        [body.second]
        disk = { radius = "R" }
        mass = "m2"
        [body.third]
        disk = { radius = "R" }
        mass = "m2"
        [force.a]
        on = "first"
        torque = "1 N*m"
        [force.b]
        on = "second"
        torque = "3 N*m"
        [force.c]
        on = "third"
        torque = "5 N*m"
        [symbols]
        m1 = "m"
        m2 = "m"
    "#;
    let place = folder();
    let file = place.path().join("scene.toml");
    write(&file, DISKS);
    let outcome = run(&file, place.path(), ReportForm::Html);
    let page = read(&outcome.folder.join("report.html"));
    for own in ["I₁ α_first = ", "I_second α_second = ", "I_third α_third = ", "t²/I_second", "t²/I_third"]
    {
        assert!(page.contains(own), "{own}");
    }
    assert_eq!(page.matches("t²/I₁").count(), page.matches("θ_first = (0.5").count());
}

/// The problem in words, what a scene says of its sections, and the way to the lesson.
#[test]
fn words_of_a_scene_and_the_way_to_its_lesson_stand_in_the_report() {
    let place = folder();
    let (file, lesson) = (place.path().join("scene.toml"), place.path().join("README.md"));
    let scene = read(&repository("scenes/04-kicked-ball/scene.toml"));
    let (before, own) = scene.split_once("text = \"\"\"").expect("words");
    let (_, after) = own.split_once("\"\"\"").expect("their end");
    let scene = format!("{before}text = \"\"\"A ball is\nkicked at $y$.\n\nHow fast?\"\"\"{after}");
    let scene = scene.replacen("on = \"ball\"", "text = \"A foot.\"\non = \"ball\"", 1);
    write(&file, &scene);
    let without = run(&file, &place.path().join("out"), ReportForm::Markdown);
    assert!(!read(&without.folder.join("report.md")).contains("README"));
    write(&lesson, "# A lesson");
    let outcome = run(&file, &place.path().join("out"), ReportForm::Html);
    let page = read(&outcome.folder.join("report.html"));
    assert!(page.contains("<p>A ball is kicked at <i>y</i>.</p>\n<p>How fast?</p>"), "{page}");
    assert!(page.contains("<p>Kick: A foot.</p>"), "{page}");
    let (_, after) = page.split_once("<a href=\"").expect("a link");
    let (way, _) = after.split_once('"').expect("its end");
    assert_eq!(read(&outcome.folder.join(way)), "# A lesson");
}

/// Throws whose range is greatest at 45 degrees.
const THROWS: &str = r#"version = 1
    title = "Throws"
    world.gravity = "10 m/s^2"
    run.until = "2 s"
    [parameters]
    up = "30 deg"
    v = "5 m/s"
    [body.stone]
    point = {}
    mass = "1 kg"
    start = { velocity = ["v*cos(up)", "v*sin(up)"] }
    [event.down]
    when = "stone.y falls through 0 m"
    action = "stop"
    [find.range]
    that = "stone.x"
    [plot.path]
    y = "stone.y"
    [sweep]
"#;

/// The greatest answer of a sweep lies between the values that are stated, and is known to the digits that are stated.
#[test]
fn the_greatest_answer_of_a_sweep_is_located() {
    let place = folder();
    let file = place.path().join("throws.toml");
    write(&file, &format!("{THROWS}up = {{ from = \"20 deg\", to = \"75 deg\", count = 12 }}"));
    let outcome = run(&file, place.path(), ReportForm::Html);
    let summary: Value = serde_json::from_str(&read(&outcome.folder.join("summary.json"))).expect("JSON");
    let located = &summary["located"][0];
    let between = [0, 1].map(|side| located["between"][side].as_f64().expect("a number"));
    assert!(between[0] < 45.0 && 45.0 < between[1] && between[1] - between[0] < 0.02, "{located}");
    assert!((located["value"].as_f64().expect("a number") - 2.5).abs() < 1e-6, "{located}");
    assert_eq!(located["which"], "greatest");
    let page = read(&outcome.folder.join("report.html"));
    assert!(page.contains("Horizontal position <i>x</i> at the end is largest"));
    assert!(page.contains("all 12 runs") && page.contains("median"), "a long sweep is bands");
    assert!(outcome.folder.join("find.range.svg").is_file());
    let least = &summary["located"][1];
    assert_eq!(
        (&least["which"], least["more_runs"].as_u64(), least.get("between")),
        (&Value::from("least"), Some(0), None)
    );
}

/// A row a run, a row an event, in the order of the runs.
#[test]
fn a_sweep_has_a_table_of_its_runs_and_one_of_its_events() {
    let place = folder();
    let file = place.path().join("throws.toml");
    write(&file, &format!("{THROWS}v = [\"1 m/s\", \"2 m/s\"]\nup = [\"30 deg\", \"45 deg\", \"60 deg\"]"));
    let outcome = run(&file, place.path(), ReportForm::Html);
    let table = read(&outcome.folder.join("runs.csv"));
    // The label of a run has a comma in quotes.
    let table = table.replace(", ", "; ");
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), 7);
    assert!(rows.iter().all(|row| row.len() == rows[0].len()), "{table}");
    assert_eq!(rows[0][..4], ["run", "label", "up [rad]", "v [m/s]"]);
    let column = |name: &str| rows[0].iter().position(|cell| *cell == name).expect("a column");
    let (range, state) = (column("find range [m]"), column("state"));
    let ranges: Vec<f64> = rows[1..].iter().map(|row| row[range].parse().expect("a number")).collect();
    assert!((ranges[4] - 0.4).abs() < 1e-9, "{ranges:?}");
    assert!(rows[1..].iter().all(|row| row[state] == "complete"));
    let events = read(&outcome.folder.join("events.csv"));
    assert_eq!(events.lines().next(), Some("run,v [m/s],up [rad],t [s],what,verified"));
    assert_eq!(events.lines().count(), 7);
    let page = read(&outcome.folder.join("report.html"));
    assert!(!page.contains("median"), "six runs are curves");
    let without = run(&repository("scenes/04-kicked-ball/scene.toml"), place.path(), ReportForm::None);
    assert!(!without.folder.join("runs.csv").exists(), "nothing is swept");
}
