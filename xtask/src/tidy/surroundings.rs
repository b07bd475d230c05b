//! What runs in a browser too asks nothing of the machine: no files, no threads, no time.

use super::Finding;
use super::source::{has_word, shipped};
use super::tree::{File, Tree};

/// The crates of the way from a scene to its report.
const CRATES: [&str; 8] = ["expr", "ode", "mech", "scene", "notation", "drawing", "report", "lab"];
/// The files that may: the folder of a scene, for programs that have one.
const ALLOWED: [&str; 1] = ["crates/tumble-scene/src/files.rs"];
const MODULES: [&str; 6] = ["fs", "thread", "time", "env", "process", "net"];

pub(super) fn check(tree: &Tree) -> Vec<Finding> {
    let folders = CRATES.map(|name| format!("crates/tumble-{name}/src/"));
    let files = folders.iter().flat_map(|folder| tree.below(folder, ".rs"));
    files.filter(|file| !ALLOWED.contains(&file.path.as_str())).flat_map(check_file).collect()
}

fn check_file(file: &File) -> Vec<Finding> {
    let found =
        |line: &str| MODULES.map(|name| format!("std::{name}")).into_iter().find(|path| has_word(line, path));
    let lines = shipped(file).into_iter().filter_map(|(number, line)| Some((number, found(line)?)));
    let refused = |path: String| format!("`{path}` is not there in a browser: leave it to the facade");
    lines.map(|(number, path)| Finding::refused(&file.path, number, refused(path))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn count(path: &str, line: &str) -> usize {
        check(&Tree::from(&[(path, line)])).len()
    }

    #[test]
    fn files_and_threads_are_found_below_the_facade_only() {
        assert_eq!(count("crates/tumble-report/src/a.rs", "let text = std::fs::read(path);"), 1);
        assert_eq!(count("crates/tumble-mech/src/a.rs", "use std::time::Instant;"), 1);
        assert_eq!(count("crates/tumble/src/a.rs", "use std::thread;"), 0);
        assert_eq!(count("crates/tumble-scene/src/files.rs", "std::fs::read(file)"), 0);
        assert_eq!(count("crates/tumble-report/src/a.rs", "use std::fmt;"), 0);
    }
}
