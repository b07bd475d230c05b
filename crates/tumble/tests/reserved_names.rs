//! The page of the scene language lists the names that a scene may not use, and these are all of them.

use std::collections::BTreeSet;

use crate::common::{folder, read, repository, text, tumble, write};
use tumble_expr::language::{BUILTINS, PI, UNITS};

/// The words in backticks of a table row, by the first of them, or by what stands in the first cell.
fn words(heading: &str, cell: usize) -> Vec<Vec<String>> {
    let page = read(&repository("docs/scene-language.md"));
    let (_, below) = page.split_once(heading).expect("the heading");
    let section = below.split("\n#").next().expect("a section");
    let rows = section.lines().filter(|line| line.starts_with("| ")).skip(1);
    let cells = rows.map(|row| row.split('|').nth(cell).expect("a cell").to_owned());
    let quoted = |cell: String| cell.split('`').skip(1).step_by(2).map(str::to_owned).collect::<Vec<_>>();
    let words =
        |texts: Vec<String>| texts.iter().flat_map(|text| text.split(' ')).map(str::to_owned).collect();
    cells.map(quoted).map(words).collect()
}

/// The rows of the reserved names: the time, what formulas know, the accuracy, the weight, quantities of bodies.
fn reserved() -> [Vec<String>; 5] {
    words("### Reserved names", 1).try_into().expect("five rows")
}

/// The codes of the mistakes of a scene with this section in it.
fn mistakes(section: &str) -> Vec<String> {
    let scene = format!(
        "version = 1\nworld.gravity = \"0 m/s^2\"\nrun.until = \"1 s\"\n\
         [body.rod]\nrod = {{ from = [0, 0], to = [\"1 m\", 0] }}\nmass = \"1 kg\"\n{section}\n"
    );
    match tumble_scene::read("scene.toml", &scene, &[]) {
        Ok(_) => vec![],
        Err(found) => found.list.iter().map(|mistake| mistake.code.as_str().to_owned()).collect(),
    }
}

const TAKEN: &str = "E0523";

#[test]
fn names_that_formulas_know_are_listed_and_refused() {
    let [time, known, ..] = reserved();
    assert_eq!(time, ["t"]);
    let listed: BTreeSet<&str> = known.iter().map(String::as_str).collect();
    assert_eq!(listed, BUILTINS.iter().map(|builtin| builtin.name).chain([PI]).collect());
    for name in time.iter().chain(&known) {
        assert_eq!(mistakes(&format!("[parameters]\n{name} = 1")), [TAKEN], "{name}");
        assert_eq!(
            mistakes(&format!("[event.{name}]\nwhen = \"rod.y falls through 0 m\"")),
            [TAKEN],
            "{name}"
        );
    }
    for name in &known {
        assert_eq!(mistakes(&format!("[functions]\n\"f({name})\" = \"1\"")), ["E0116"], "{name}");
    }
    assert!(mistakes("[functions]\n\"f(t)\" = \"t\"").is_empty());
}

#[test]
fn the_accuracy_is_no_parameter() {
    let [_, _, accuracy, ..] = reserved();
    assert_eq!(accuracy, ["accuracy"]);
    assert_eq!(mistakes("[parameters]\naccuracy = 1"), [TAKEN]);
    assert!(mistakes("[force.accuracy]\non = \"rod\"\ntorque = \"1 N*m\"").is_empty());
}

#[test]
fn gravity_is_the_weight() {
    let [_, _, _, weight, _] = reserved();
    assert_eq!(weight, ["gravity"]);
    assert_eq!(mistakes("[force.gravity]\non = \"rod\"\ntorque = \"1 N*m\""), [TAKEN]);
    assert!(mistakes("[parameters]\ngravity = 1").is_empty());
}

/// What the table of a run has of a body without points is what points may not be called.
#[test]
fn quantities_of_a_body_are_listed_and_refused() {
    let [.., quantities] = reserved();
    let folder = folder();
    let scene = "version = 1\nworld.gravity = \"0 m/s^2\"\nrun.until = \"1 s\"\n[body.a]\nball = { radius = \"1 m\" }\nmass = \"1 kg\"\n";
    write(&folder.path().join("a.toml"), scene);
    assert!(tumble(folder.path(), &["run", "a.toml", "--no-figures"]).status.success());
    let table = read(&folder.path().join("out/a/run-001/trajectory.csv"));
    let header = table.lines().next().expect("a header");
    let columns = header.split(',').filter_map(|column| column.strip_prefix("a."));
    let shown: BTreeSet<&str> = columns.filter_map(|column| column.split(['.', ' ']).next()).collect();
    assert_eq!(quantities.iter().map(String::as_str).collect::<BTreeSet<_>>(), shown);
    for name in &quantities {
        assert_eq!(mistakes(&format!("points.{name} = [0, 0]")), [TAKEN], "{name}");
    }
}

#[test]
fn every_unit_is_in_the_table() {
    let listed: BTreeSet<String> = words("### Units", 2).concat().into_iter().collect();
    assert_eq!(listed, UNITS.iter().map(|unit| unit.symbol.to_owned()).collect());
    let said = text(&tumble(folder().path(), &["units"]).stdout);
    assert!(listed.iter().all(|unit| said.contains(&format!("\n  {unit} "))));
}
