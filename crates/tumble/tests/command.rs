//! The command as a user meets it: exit codes, messages, and nothing where it does not belong.

use std::fs;
use std::path::Path;

use crate::common::{folder, text, tumble, write};

const STONE: &str = r#"
version = 1
title = "A stone falls"
world.gravity = "g"
run.until = "2 s"

[parameters]
g = "10 m/s^2"

[body.stone]
point = {}
mass = "1 kg"

[check.depth]
that = "stone.y"
equals = "-20 m"
within = "1e-12 m"
"#;

/// Its resistance stops the block within the run, and then both signs of it are wrong.
const BLOCK: &str = r#"
version = 1
world.gravity = "0 m/s^2"
run.until = "2 s"

[body.block]
point = {}
mass = "1 kg"
start = { velocity = ["1 m/s", 0] }

[force.friction]
on = "block"
at = "block.cm"
force = ["if(block.vx < 0, 1 N, -1 N)", 0]
"#;

/// A folder with a scene `scene.toml` in `stone/`, and what the command makes of it there.
fn ended(scene: &str, arguments: &[&str]) -> (Option<i32>, String) {
    let folder = folder();
    write(&folder.path().join("stone/scene.toml"), scene);
    ended_in(folder.path(), arguments)
}

/// The exit code and both streams, which are no terminals.
fn ended_in(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let output = tumble(folder, arguments);
    let streams = text(&output.stdout) + &text(&output.stderr);
    assert!(!streams.contains('\u{1b}'), "colour where there is no terminal: {streams}");
    (output.status.code(), streams)
}

#[test]
fn a_run_that_goes_well() {
    let (code, said) = ended(STONE, &["run", "stone/scene.toml"]);
    assert_eq!(code, Some(0), "{said}");
    assert!(said.starts_with("A stone falls\n  2 s in 1 step, all exact, 0 events, 15 digits\n"), "{said}");
    assert!(said.contains("check depth: stone.y = -20 m at 2 s holds"), "{said}");
}

#[test]
fn a_check_that_fails() {
    let (code, said) = ended(STONE, &["run", "stone/scene.toml", "--set", "g=9 m/s^2"]);
    assert_eq!(code, Some(1), "{said}");
    assert!(said.contains("stone.y = -18 m at 2 s FAILS, expected -20 m within"), "{said}");
}

#[test]
fn a_scene_with_a_mistake() {
    let (code, said) = ended(&STONE.replace("1 kg", "1 kilo"), &["run", "stone/scene.toml"]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("E0201") && said.contains("`kilo` is not a unit"), "{said}");
    assert!(said.contains("stone/scene.toml:12:"), "{said}");
}

#[test]
fn a_parameter_that_there_is_not() {
    let (code, said) = ended(STONE, &["run", "stone/scene.toml", "--set", "G=9 m/s^2"]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("there is no parameter `G`") && said.contains("did you mean \"g\"?"), "{said}");
}

#[test]
fn a_setting_of_another_dimension() {
    let (code, said) = ended(STONE, &["check", "stone/scene.toml", "--set", "g=9 m"]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("E0404"), "{said}");
}

#[test]
fn the_accuracy_is_set_and_swept() {
    let accuracy = |arguments: &[&str], scene: &str| {
        let folder = folder();
        write(&folder.path().join("stone/scene.toml"), scene);
        let (code, said) = ended_in(folder.path(), arguments);
        assert_eq!(code, Some(0), "{said}");
        let summary = crate::common::read(&folder.path().join("out/stone/summary.json"));
        let summary: serde_json::Value = serde_json::from_str(&summary).expect("JSON");
        let runs = summary["runs"].as_array().expect("a list").clone();
        let accuracy = |run: &serde_json::Value| run["numerics"]["accuracy"].as_f64().expect("a number");
        (runs.iter().map(accuracy).collect::<Vec<_>>(), said)
    };
    let set = ["run", "stone/scene.toml", "--no-figures", "--set", "accuracy=1e-6"];
    assert_eq!(accuracy(&set[..3], STONE).0, [1e-9]);
    assert_eq!(accuracy(&set, STONE).0, [1e-6]);
    let swept = format!("{STONE}\n[sweep]\naccuracy = [1e-12, \"1e-4\"]\n");
    let (found, said) = accuracy(&["run", "stone/scene.toml"], &swept);
    assert_eq!(found, [1e-12, 1e-4]);
    assert!(said.contains("\n  accuracy = 1e-12: 2 s in 1 step"), "{said}");
    assert_eq!(accuracy(&set, &swept).0, [1e-6], "what is set is not swept");
}

/// Settings may end it at 1 s, before most of what it looks at.
const SHORT: &str = r#"
version = 1
world.gravity = "10 m/s^2"
run.until = "end"
output.every = "1.5 s"

[parameters]
end = "2 s"
h = "99 m"

[body.stone]
point = {}
mass = "1 kg"

[event.low]
when = "stone.y falls through -h"
action = "stop"

[find.early]
that = "stone.y"
at = "0.5 s"

[find.late]
that = "stone.y"
at = "1.5 s"

[check.depth]
that = "stone.y"
at = "2 s"
equals = "-20 m"
within = "1e-12 m"

[plot.later]
y = "stone.y"
during = ["1.2 s", "1.4 s"]

[stroboscope.flight]
every = "1.5 s"

[free_body.weight]
body = "stone"
at = ["0.5 s", "1.5 s"]
"#;

#[test]
fn what_a_setting_leaves_out_of_the_run_is_not_reached() {
    for set in ["end=1s", "h=5m"] {
        let folder = folder();
        write(&folder.path().join("stone.toml"), SHORT);
        let (code, said) = ended_in(folder.path(), &["run", "stone.toml", "--set", set]);
        assert_eq!(code, Some(1), "{said}");
        let says = "not reached: its event or its time does not come in this motion\n";
        for what in ["find late: ", "check depth: FAILS, "] {
            assert!(said.contains(&format!("  {what}{says}")), "{said}");
        }
        assert!(said.contains("find early: stone.y = -1.25 m at 0.5 s"), "{said}");
        assert!(!said.contains("NaN"), "{said}");
        let summary = crate::common::read(&folder.path().join("out/stone/summary.json"));
        let summary: serde_json::Value = serde_json::from_str(&summary).expect("JSON");
        let run = &summary["runs"][0];
        assert_eq!(
            (&run["finds"][0]["status"], &run["finds"][0]["value"]),
            (&"found".into(), &(-1.25).into())
        );
        assert_eq!(
            (&run["finds"][1]["status"], &run["finds"][1]["value"]),
            (&"not reached".into(), &().into())
        );
        let check = &run["checks"][0];
        assert_eq!((&check["status"], &check["holds"]), (&"not reached".into(), &false.into()));
        assert!(check["found"].is_null() && check["at"].is_null(), "{check}");
        let report = crate::common::read(&folder.path().join("out/stone/report.html"));
        let page = report.split("<script").next().expect("text");
        assert!(page.contains("not reached") && !page.contains("NaN"));
    }
    assert_eq!(ended(SHORT, &["run", "stone/scene.toml"]).0, Some(0), "without a setting all is reached");
}

#[test]
fn nothing_that_a_terminal_obeys_is_said() {
    let folder = folder();
    let name = "ev\u{1b}[31mil\u{202e}\n  check all: holds";
    write(&folder.path().join(name).join("scene.toml"), &STONE.replace("title = \"A stone falls\"\n", ""));
    let scene = format!("{name}/scene.toml");
    let gif = format!("{name}.gif/x");
    let set = format!("{name}=1");
    for arguments in [
        &["run", &scene, "--no-figures"][..],
        &["check", &scene],
        &["check", "stone.toml", "--set", &set],
        &["run", &format!("{name}.toml")],
        &["run", &scene, "--out", &scene],
        &["gallery", name],
        &["new", name],
        &["explain", name],
        &["units", name],
        &["animate", &scene, "--to", &gif],
        &["completions", name],
        &[name],
    ] {
        write(&folder.path().join("stone.toml"), STONE);
        let (_, said) = ended_in(folder.path(), arguments);
        assert!(!said.contains(|c: char| c != '\n' && tumble_scene::is_unseen(c)), "{arguments:?}: {said:?}");
        assert!(!said.is_empty(), "{arguments:?}");
        assert!(!said.lines().any(|line| line == "  check all: holds"), "{arguments:?}: {said}");
    }
}

#[test]
fn a_command_line_that_is_not_one() {
    for arguments in [&["walk"][..], &[], &["run"], &["run", "stone/scene.toml", "--set", "g"]] {
        assert_eq!(ended(STONE, arguments).0, Some(2), "{arguments:?}");
    }
}

/// A browser sets pages better than a program of our own would.
#[test]
fn a_report_as_pdf_is_printed_by_a_browser() {
    let place = folder();
    write(&place.path().join("stone/scene.toml"), STONE);
    let (code, said) = ended_in(place.path(), &["run", "stone/scene.toml", "--report", "pdf"]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("a browser prints report.html") && said.contains("--print-to-pdf"), "{said}");
    assert!(!place.path().join("out").exists(), "nothing was run");
}

#[test]
fn a_motion_that_is_refused() {
    let folder = folder();
    write(&folder.path().join("block.toml"), BLOCK);
    let (code, said) = ended_in(folder.path(), &["run", "block.toml"]);
    assert_eq!(code, Some(3), "{said}");
    assert!(
        said.contains("incomplete: stopped at t = 1 s: `(block.vx - 0)` is zero and stays there"),
        "{said}"
    );
    let summary = crate::common::read(&folder.path().join("out/block/summary.json"));
    assert!(summary.contains("\"complete\": false"), "{summary}");
}

#[test]
fn files_that_cannot_be_read() {
    for path in ["nothing.toml", "stone", "."] {
        let (code, said) = ended(STONE, &["run", path]);
        assert_eq!(code, Some(4), "{said}");
        assert!(said.starts_with(&format!("error: cannot read {path}: ")), "{said}");
    }
    assert_eq!(ended(STONE, &["gallery", "nothing"]).0, Some(4));
    assert_eq!(ended(STONE, &["gallery", "stone"]).0, Some(4));
}

#[test]
fn a_folder_that_is_not_ours_is_left_alone() {
    let folder = folder();
    write(&folder.path().join("stone/scene.toml"), STONE);
    write(&folder.path().join("out/stone/notes.txt"), "mine");
    let (code, said) = ended_in(folder.path(), &["run", "stone/scene.toml"]);
    assert_eq!(code, Some(4), "{said}");
    assert!(said.contains("was not written by tumble"), "{said}");
    let left: Vec<_> = fs::read_dir(folder.path().join("out")).expect("there").collect();
    assert_eq!(left.len(), 1);
    assert_eq!(crate::common::read(&folder.path().join("out/stone/notes.txt")), "mine");
}

#[test]
fn a_check_runs_nothing() {
    let folder = folder();
    write(&folder.path().join("stone/scene.toml"), STONE);
    let (code, said) = ended_in(folder.path(), &["check", "stone/scene.toml"]);
    assert_eq!((code, said.as_str()), (Some(0), "A stone falls: stone/scene.toml has no mistakes\n"));
    assert!(!folder.path().join("out").exists());
}

#[test]
fn a_gallery_shows_every_scene_and_ends_as_the_worst() {
    let folder = folder();
    write(&folder.path().join("scenes/01-stone/scene.toml"), STONE);
    write(&folder.path().join("scenes/02-wrong/scene.toml"), &STONE.replace("-20 m", "-30 m"));
    let (code, said) = ended_in(folder.path(), &["gallery"]);
    assert_eq!(code, Some(1), "{said}");
    assert!(said.ends_with("the gallery is out/index.html\n"), "{said}");
    let page = crate::common::read(&folder.path().join("out/index.html"));
    assert!(page.contains("01-stone/summary.json") && page.contains("02-wrong/summary.json"));
}
