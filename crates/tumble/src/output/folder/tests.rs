//! A folder replaces its like only.

use super::*;

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

fn begun(out: &Path) -> Result<Folder, OutputError> {
    Folder::begin(out, "scene", &[])
}

/// Results of two files, in their place.
fn written(out: &Path, text: &str) -> Placed {
    let folder = begun(out).expect("ours");
    folder.write("file.txt", text.as_bytes()).expect("writable");
    folder.write("deep/file.txt", text.as_bytes()).expect("writable");
    folder.finish().expect("writable")
}

/// Why the results in a folder are not replaced, which must be as they were afterwards.
fn refused(out: &Path) -> Foreign {
    let Err(OutputError::Foreign { place, why, .. }) = begun(out) else { panic!("replaced") };
    assert_eq!(place, out.join("scene"));
    assert_eq!(fs::read_dir(out).expect("readable").count(), 1, "nothing else is left");
    why
}

#[test]
fn a_finished_folder_is_replaced_whole() {
    let out = folder();
    for text in ["one", "two"] {
        let placed = written(out.path(), text);
        assert_eq!(fs::read_to_string(placed.folder.join("deep/file.txt")).expect("there"), text);
        assert_eq!(placed.notes, Vec::<String>::new());
    }
    assert_eq!(fs::read_dir(out.path()).expect("readable").count(), 1);
}

#[test]
fn what_is_not_ours_is_left_alone() {
    let out = folder();
    fs::create_dir(out.path().join("scene")).expect("writable");
    fs::write(out.path().join("scene/thesis.tex"), "years of work").expect("writable");
    assert_eq!(refused(out.path()), Foreign::Unmarked);
    assert!(out.path().join("scene/thesis.tex").exists());
}

#[test]
fn what_came_into_our_folder_is_left_alone() {
    let out = folder();
    let place = written(out.path(), "ours").folder;
    for name in ["notes.txt", "deep/notes.txt", "file.TXT", ".hidden"] {
        fs::write(place.join(name), "mine").expect("writable");
        assert_eq!(refused(out.path()), Foreign::Holds(name.into()));
        fs::remove_file(place.join(name)).expect("writable");
    }
    fs::create_dir(place.join("empty")).expect("writable");
    assert_eq!(refused(out.path()), Foreign::Holds("empty".into()));
    fs::remove_dir(place.join("empty")).expect("writable");
    fs::write(place.join("deep/file.txt"), "ours, corrected").expect("writable");
    assert_eq!(refused(out.path()), Foreign::Changed("deep/file.txt".into()));
    fs::remove_file(place.join("deep/file.txt")).expect("writable");
    fs::write(place.join(".DS_Store"), "of the system").expect("writable");
    written(out.path(), "again");
}

#[cfg(unix)]
#[test]
fn links_are_neither_followed_nor_replaced() {
    use std::os::unix::fs::symlink;
    let (out, other) = (folder(), folder());
    let place = written(out.path(), "ours").folder;
    fs::remove_file(place.join("file.txt")).expect("writable");
    fs::write(other.path().join("mine"), "ours").expect("writable");
    symlink(other.path().join("mine"), place.join("file.txt")).expect("a link");
    assert_eq!(refused(out.path()), Foreign::Holds("file.txt".into()));
    fs::remove_file(place.join("file.txt")).expect("writable");
    fs::rename(&place, other.path().join("moved")).expect("writable");
    symlink(other.path().join("moved"), &place).expect("a link");
    assert_eq!(refused(out.path()), Foreign::Special);
}

#[test]
fn what_the_scene_is_read_from_is_left_alone() {
    let out = folder();
    let place = written(out.path(), "ours").folder;
    let needed = [out.path().join("scene.toml"), place.join("deep/../deep/file.txt")];
    let Err(OutputError::Foreign { why, .. }) = Folder::begin(out.path(), "scene", &needed) else {
        panic!("replaced")
    };
    assert_eq!(why, Foreign::Needed("deep/file.txt".into()));
}

#[test]
fn an_unfinished_folder_leaves_the_last_one() {
    let out = folder();
    let place = written(out.path(), "first").folder;
    let second = begun(out.path()).expect("ours");
    second.write("file.txt", b"second").expect("writable");
    drop(second);
    assert_eq!(fs::read_to_string(place.join("file.txt")).expect("there"), "first");
    assert_eq!(fs::read_dir(out.path()).expect("readable").count(), 1);
}

#[test]
fn what_comes_while_a_run_is_made_is_left_alone_and_the_results_are_kept() {
    let out = folder();
    let place = written(out.path(), "first").folder;
    let second = begun(out.path()).expect("ours");
    second.write("file.txt", b"second").expect("writable");
    fs::write(place.join("notes.txt"), "mine").expect("writable");
    let Err(OutputError::Kept { kept, why }) = second.finish() else { panic!("replaced") };
    assert!(matches!(*why, OutputError::Foreign { why: Foreign::Holds(_), .. }), "{why}");
    assert_eq!(fs::read_to_string(kept.join("file.txt")).expect("there"), "second");
    assert_eq!(fs::read_to_string(place.join("file.txt")).expect("there"), "first");
}

#[test]
fn only_one_writes_at_a_time() {
    let out = folder();
    let first = begun(out.path()).expect("ours");
    assert!(matches!(begun(out.path()), Err(OutputError::Busy { .. })));
    drop(first);
    begun(out.path()).expect("ours again");
}

/// A folder as a run leaves it that is killed while it writes `file.txt`.
fn killed(out: &Path, name: &str) -> PathBuf {
    let left = out.join(name);
    drop(begin(&left).expect("writable"));
    fs::write(left.join(MARKER), HEAD.to_owned() + &Manifest::begun("file.txt")).expect("writable");
    fs::write(left.join("file.txt"), "cut of").expect("writable");
    left
}

#[test]
fn what_killed_runs_have_left_is_removed() {
    let out = folder();
    let left = [".scene.1234.partial", ".scene.12.old"].map(|name| killed(out.path(), name));
    fs::create_dir(out.path().join(".scene.77.partial")).expect("writable");
    let others = [".scene.1.12.partial", ".other.12.partial", ".scene.x.partial", ".scene.12.partial.bak"];
    let others = others.map(|name| killed(out.path(), name));
    assert_eq!(written(out.path(), "next").notes, Vec::<String>::new());
    assert!(left.iter().all(|left| !left.exists()), "removed");
    assert!(others.iter().all(|other| other.exists()), "none of this scene");
    assert_eq!(fs::read_dir(out.path()).expect("readable").count(), others.len() + 1);
}

#[test]
fn what_came_into_the_folder_of_a_killed_run_is_told_of() {
    let out = folder();
    let left = killed(out.path(), ".scene.1234.partial");
    fs::write(left.join("notes.txt"), "mine").expect("writable");
    fs::create_dir_all(out.path().join(".scene.5.partial/mine")).expect("writable");
    let notes = written(out.path(), "next").notes;
    assert_eq!(notes.len(), 2);
    assert!(notes[0].contains("holds notes.txt"), "{notes:?}");
    assert!(left.join("file.txt").exists() && left.join("notes.txt").exists());
    assert!(out.path().join(".scene.5.partial/mine").exists());
}

#[test]
fn the_list_names_every_file_with_its_hash() {
    let out = folder();
    let place = written(out.path(), "abc").folder;
    let text = fs::read_to_string(place.join(MARKER)).expect("there");
    // The example of FIPS 180-4.
    let hash = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
    assert_eq!(text, format!("{HEAD}{hash}  deep/file.txt\n{hash}  file.txt\n"));
}
