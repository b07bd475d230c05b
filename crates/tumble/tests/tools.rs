//! The commands that run no scene, as a user meets them.

use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::common::{folder, read, text, tumble, write};

/// Exit code, standard output and standard error, none of which is a terminal.
fn ended_in(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = tumble(folder, arguments);
    (output.status.code(), text(&output.stdout), text(&output.stderr))
}

fn ended(arguments: &[&str]) -> (Option<i32>, String, String) {
    ended_in(folder().path(), arguments)
}

fn said(arguments: &[&str]) -> String {
    let (code, out, error) = ended(arguments);
    assert_eq!((code, error.as_str()), (Some(0), ""), "{arguments:?}");
    out
}

/// Every kind of scene that can be begun with.
const KINDS: &[&str] = &["pendulum", "throw", "bounce", "kick", "empty"];

#[test]
fn every_new_scene_has_no_mistakes_and_runs() {
    let folder = folder();
    for kind in KINDS {
        let (code, out, error) = ended_in(folder.path(), &["new", kind, "--kind", kind]);
        assert_eq!(code, Some(0), "{kind}: {error}");
        let scene = format!("{kind}/scene.toml");
        assert!(out.contains(&format!("tumble run {scene}")), "{out}");
        for command in ["check", "run"] {
            let (code, out, error) = ended_in(folder.path(), &[command, &scene]);
            assert_eq!(code, Some(0), "{command} {kind}: {out}{error}");
            assert!(!out.contains("FAILS") && !out.contains("incomplete"), "{kind}: {out}");
        }
    }
    let help = said(&["new", "--help"]);
    let listed = help.lines().filter_map(|line| line.trim().strip_prefix("- ")?.split(':').next());
    assert_eq!(listed.collect::<Vec<_>>(), KINDS);
}

#[test]
fn a_new_scene_is_a_pendulum_where_nobody_can_be_asked() {
    let folder = folder();
    assert_eq!(ended_in(folder.path(), &["new", "swing"]).0, Some(0));
    assert!(read(&folder.path().join("swing/scene.toml")).contains("title = \"Pendulum\""));
}

#[test]
fn a_new_scene_replaces_nothing_and_stays_in_its_folder() {
    let folder = folder();
    let inner = folder.path().join("inner");
    write(&inner.join("swing/notes.txt"), "mine");
    write(&inner.join("file"), "mine");
    for name in ["swing", "file"] {
        let (code, _, error) = ended_in(&inner, &["new", name]);
        assert_eq!(code, Some(4), "{error}");
        assert!(error.contains("exists already"), "{error}");
    }
    for name in ["../up", "..", ".", "", "a/b", "/tmp/tumble-up", "a\\b", "x."] {
        let (code, _, error) = ended_in(&inner, &["new", name]);
        assert_eq!(code, Some(2), "{name}: {error}");
    }
    let names = |folder: &Path| {
        let entries =
            fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("readable").file_name());
        let mut names: Vec<_> = entries.map(|name| name.to_string_lossy().into_owned()).collect();
        names.sort();
        names
    };
    assert_eq!(names(folder.path()), ["inner"]);
    assert_eq!(names(&inner), ["file", "swing"]);
    assert_eq!(names(&inner.join("swing")), ["notes.txt"]);
}

#[test]
fn units_are_listed_told_and_converted() {
    let all = said(&["units"]);
    assert!(all.contains("\nforce, in N\n") && all.contains("\n  knot 1852/3600"), "{all}");
    assert!(said(&["units", "force"]).starts_with("force, in N\n  N "));
    let one = said(&["units", "lbf"]);
    assert!(one.contains("1 lbf = 4.4482216152605 N, exactly"), "{one}");
    for words in [&["units", "3 ft/s"][..], &["units", "3", "ft/s"]] {
        let out = said(words);
        // By hand: 3*0.3048 m/s, and 3*0.3048*3.6 km/h.
        assert!(out.contains("= 0.9144 m/s") || out.contains("0.9144 m/s\n"), "{out}");
        assert!(out.contains("3.29184 km/h"), "{out}");
    }
    assert!(said(&["units", "-20 rpm"]).contains("-120 deg/s\n"));
    assert!(said(&["units", "kg/(m*s)"]).contains("= 1 kg/(m*s)\n"));
}

#[test]
fn what_is_no_unit_is_a_mistake() {
    for (asked, says) in [
        ("2 kilo", "did you mean `kg`?"),
        ("furlong", "`furlong` is not a unit"),
        ("1,5 m", "write `1.5`"),
        ("[1 m, 2 m]", "a vector"),
        ("1 < 2", "expected"),
        ("sqrt(-1)", "not a finite number"),
        ("2*x", "nothing is named `x`"),
    ] {
        let (code, out, error) = ended(&["units", asked]);
        assert_eq!((code, out.as_str()), (Some(2), ""), "{asked}: {error}");
        assert!(error.contains(says), "{asked}: {error}");
    }
}

#[test]
fn codes_are_explained() {
    let out = said(&["explain", "e0203"]);
    assert!(out.starts_with("E0203: The power of a unit is not a plain number in range.\n"), "{out}");
    assert!(out.contains("\n    x = \"2 m^n\"\n") && !out.contains("```"), "{out}");
    assert!(out.lines().all(|line| line.chars().count() <= 100));
    let all = said(&["explain"]);
    for code in ["E0101  ", "E0410  ", "E0555  "] {
        assert!(all.lines().any(|line| line.starts_with(code)), "{all}");
    }
    let (code, out, error) = ended(&["explain", "E0206"]);
    assert_eq!((code, out.as_str()), (Some(2), ""));
    assert!(error.contains("did you mean E0205?"), "{error}");
}

#[test]
fn every_shell_has_its_completions() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let out = said(&["completions", shell]);
        assert!(out.contains("gallery") && out.contains("explain"), "{shell}");
    }
    assert_eq!(ended(&["completions", "tcsh"]).0, Some(2));
}

#[test]
fn the_schema_is_json() {
    let schema: serde_json::Value = serde_json::from_str(&said(&["schema"])).expect("JSON");
    assert_eq!(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
    assert_eq!(schema["required"].as_array().map(Vec::len), Some(4));
}

/// The exit code and what was said of a command whose reader goes away before it has read anything.
fn without_a_reader(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_tumble"));
    command.current_dir(folder).args(arguments).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("the command starts");
    drop(child.stdout.take());
    let mut said = String::new();
    child.stderr.take().expect("piped").read_to_string(&mut said).expect("UTF-8");
    (child.wait().expect("it ends").code(), said)
}

#[test]
fn a_broken_pipe_ends_quietly() {
    let folder = folder();
    assert_eq!(ended_in(folder.path(), &["new", "stone", "--kind", "empty"]).0, Some(0));
    let commands: &[&[&str]] = &[
        &["units"],
        &["explain"],
        &["explain", "E0101"],
        &["schema"],
        &["completions", "zsh"],
        &["run", "stone/scene.toml"],
        &["check", "stone/scene.toml"],
        &["--help"],
    ];
    for arguments in commands {
        assert_eq!(without_a_reader(folder.path(), arguments), (Some(0), String::new()), "{arguments:?}");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_told() {
    let mut command = Command::new(env!("CARGO_BIN_EXE_tumble"));
    let full = fs::OpenOptions::new().write(true).open("/dev/full").expect("Linux has it");
    let output = command.arg("units").stdout(full).output().expect("the command starts");
    assert_eq!(output.status.code(), Some(4));
    assert!(text(&output.stderr).contains("cannot write to standard output"));
}

#[test]
fn there_is_no_colour_where_there_is_no_terminal() {
    for arguments in [
        &["units", "2 kilo"][..],
        &["units"],
        &["explain", "E0101"],
        &["explain", "x"],
        &["--help"],
        &["walk"],
    ] {
        let (_, out, error) = ended(arguments);
        assert!(!out.contains('\u{1b}') && !error.contains('\u{1b}'), "{arguments:?}");
    }
}
