//! What is written replaces its like and nothing else: whatever else stands there stays, and the message says so.

use std::fs;
use std::path::Path;

use crate::common::{folder, read, text, tumble, write};

const STONE: &str = r#"
version = 1
world.gravity = "10 m/s^2"
run.until = "1 s"

[body.stone]
ball = { radius = "0.1 m" }
mass = "1 kg"
"#;

const GUST: &str = r#"
[table.gust]
file = "gust.csv"
columns = ["t [s]", "w [m/s]"]
interpolation = "linear"
outside = "hold"

[functions]
"w(s)" = "gust(s)"
"#;

/// The exit code and what was said.
fn ended(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let output = tumble(folder, arguments);
    (output.status.code(), text(&output.stdout) + &text(&output.stderr))
}

#[track_caller]
fn goes_well(folder: &Path, arguments: &[&str]) {
    let (code, said) = ended(folder, arguments);
    assert_eq!(code, Some(0), "{said}");
}

/// Every file below a folder with its contents, links not followed.
fn everything(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut found = vec![];
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("readable").path();
        let kind = fs::symlink_metadata(&path).expect("there").file_type();
        if kind.is_dir() {
            found.extend(everything(&path));
        } else {
            let contents = if kind.is_file() { fs::read(&path).expect("readable") } else { vec![] };
            found.push((path.display().to_string(), contents));
        }
    }
    found.sort();
    found
}

/// That a command ends with the code of files, says why, and has changed nothing.
#[track_caller]
fn is_refused(folder: &Path, arguments: &[&str], says: &[&str]) {
    let before = everything(folder);
    let (code, said) = ended(folder, arguments);
    assert_eq!(code, Some(4), "{said}");
    for says in says {
        assert!(said.contains(says), "{said}");
    }
    assert!(everything(folder) == before, "{arguments:?} has changed something");
}

const RUN: &[&str] = &["run", "stone/scene.toml", "--no-figures"];

fn stone() -> tempfile::TempDir {
    let folder = folder();
    write(&folder.path().join("stone/scene.toml"), STONE);
    folder
}

#[test]
fn what_was_put_into_the_results_stays() {
    let folder = stone();
    goes_well(folder.path(), RUN);
    goes_well(folder.path(), RUN);
    let mine = folder.path().join("out/stone/run-001/notes.txt");
    write(&mine, "mine");
    is_refused(folder.path(), RUN, &["out/stone holds run-001/notes.txt", "not written by tumble", "--out"]);
    fs::remove_file(mine).expect("writable");
    let table = folder.path().join("out/stone/run-001/trajectory.csv");
    write(&table, &(read(&table) + "corrected by hand\n"));
    is_refused(folder.path(), RUN, &["out/stone holds run-001/trajectory.csv", "changed since", "--out"]);
}

#[test]
fn a_scene_in_the_results_stays() {
    let folder = stone();
    goes_well(folder.path(), RUN);
    let moved = folder.path().join("out/stone/scene.toml");
    fs::rename(folder.path().join("stone/scene.toml"), &moved).expect("writable");
    is_refused(folder.path(), &["run", "out/stone/scene.toml"], &["out/stone holds scene.toml"]);
    // Its own folder, which has our mark.
    is_refused(
        &folder.path().join("out/stone"),
        &["run", "scene.toml", "--out", ".."],
        &["holds scene.toml"],
    );
    fs::remove_file(folder.path().join("out/stone/.tumble-output")).expect("writable");
    is_refused(
        &folder.path().join("out/stone"),
        &["run", "scene.toml", "--out", ".."],
        &["holds scene.toml"],
    );
}

/// A table in the results is one that tumble has written, to the bit: nothing but the scene tells that it is needed.
#[test]
fn tables_of_the_scene_in_the_results_stay() {
    let folder = stone();
    goes_well(folder.path(), RUN);
    let gust = GUST.replace("gust.csv", "out/stone/run-001/trajectory.csv");
    let gust = gust.replace("w [m/s]", "stone.vx [m/s]");
    write(&folder.path().join("stone.toml"), &(STONE.to_owned() + &gust));
    let says = "out/stone holds run-001/trajectory.csv, which the scene is read from";
    is_refused(folder.path(), &["run", "stone.toml"], &[says]);
    goes_well(folder.path(), &["run", "stone.toml", "--no-figures", "--out", "elsewhere"]);
}

#[test]
fn what_stands_where_a_folder_would_go_stays() {
    let folder = stone();
    write(&folder.path().join("file"), "mine");
    write(&folder.path().join("out/stone"), "mine");
    is_refused(folder.path(), RUN, &["out/stone is a file", "--out"]);
    is_refused(
        folder.path(),
        &["run", "stone/scene.toml", "--out", "file"],
        &["file is a file, and results need a folder"],
    );
    is_refused(
        folder.path(),
        &["run", "stone/scene.toml", "--out", "file/deep"],
        &["cannot write file/deep: "],
    );
    is_refused(
        folder.path(),
        &["run", "stone/scene.toml", "--out", "."],
        &["./stone holds scene.toml, which the scene"],
    );
    write(&folder.path().join("elsewhere/.stone.lock"), "mine");
    is_refused(
        folder.path(),
        &["run", "stone/scene.toml", "--out", "elsewhere"],
        &["elsewhere/.stone.lock exists and"],
    );
}

#[cfg(unix)]
#[test]
fn links_stay() {
    use std::os::unix::fs::symlink;
    let folder = stone();
    goes_well(folder.path(), RUN);
    fs::create_dir(folder.path().join("other")).expect("writable");
    symlink("../out/stone", folder.path().join("other/stone")).expect("a link");
    symlink("nowhere", folder.path().join("other/ball.gif")).expect("a link");
    is_refused(folder.path(), &["run", "stone/scene.toml", "--out", "other"], &["other/stone is a link"]);
    #[cfg(feature = "png")]
    is_refused(
        folder.path(),
        &["animate", "stone/scene.toml", "--to", "other/ball.gif"],
        &["is a link", "--to"],
    );
    // The folder that results go to may be one.
    symlink("out", folder.path().join("linked")).expect("a link");
    goes_well(folder.path(), &["run", "stone/scene.toml", "--no-figures", "--out", "linked"]);
}

#[cfg(feature = "png")]
#[test]
fn an_animation_replaces_an_animation_only() {
    let folder = stone();
    let to =
        |file: &'static str| ["animate", "stone/scene.toml", "--width", "64", "--rate", "2", "--to", file];
    is_refused(
        folder.path(),
        &to("stone/scene.toml"),
        &["stone/scene.toml exists and was not written by tumble", "--to"],
    );
    is_refused(folder.path(), &to("stone"), &["stone is a folder"]);
    is_refused(folder.path(), &to("stone/scene.toml/ball.gif"), &["stone/scene.toml is a file"]);
    goes_well(folder.path(), &to("ball.gif"));
    goes_well(folder.path(), &to("ball.gif"));
    let ball = folder.path().join("ball.gif");
    let mut changed = fs::read(&ball).expect("there");
    changed.push(b' ');
    fs::write(&ball, changed).expect("writable");
    is_refused(folder.path(), &to("ball.gif"), &["ball.gif was changed since tumble wrote it"]);
    // A GIF of somebody else.
    fs::write(&ball, b"GIF89a\x01\0\x01\0\0\0\0;").expect("writable");
    is_refused(folder.path(), &to("ball.gif"), &["ball.gif exists and was not written by tumble"]);
    // A page of ours is another kind.
    fs::create_dir(folder.path().join("scenes")).expect("writable");
    fs::rename(folder.path().join("stone"), folder.path().join("scenes/stone")).expect("writable");
    goes_well(folder.path(), &["gallery"]);
    is_refused(
        folder.path(),
        &["animate", "scenes/stone/scene.toml", "--width", "64", "--to", "out/index.html"],
        &["was not written by tumble"],
    );
}

#[test]
fn a_gallery_replaces_a_gallery_only() {
    let folder = folder();
    write(&folder.path().join("scenes/stone/scene.toml"), STONE);
    write(&folder.path().join("out/index.html"), "<title>my page</title>");
    is_refused(
        folder.path(),
        &["gallery"],
        &["out/index.html exists and was not written by tumble", "--out"],
    );
    assert!(!folder.path().join("out/stone").exists(), "nothing was run for it");
    fs::remove_file(folder.path().join("out/index.html")).expect("writable");
    goes_well(folder.path(), &["gallery"]);
    goes_well(folder.path(), &["gallery"]);
    let page = folder.path().join("out/index.html");
    write(&page, &read(&page).replace("The gallery", "My gallery"));
    is_refused(folder.path(), &["gallery"], &["out/index.html was changed since tumble wrote it"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_file_that_cannot_be_written_is_named() {
    let folder = stone();
    let (code, said) = ended(folder.path(), &["run", "stone/scene.toml", "--out", "/proc/tumble"]);
    assert_eq!((code, said.starts_with("error: cannot write /proc/tumble: ")), (Some(4), true), "{said}");
}
