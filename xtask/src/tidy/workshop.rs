//! What belongs to one machine or to an unfinished hour stays out of the repository.
//!
//! The patterns are written in parts, so that this file is not a finding of itself.

use super::Finding;
use super::source::has_word;
use super::tree::{File, Tree};

/// Folders of somebody's machine.
const FOLDERS: [&str; 4] =
    [concat!("/wo", "rk/"), concat!("/ro", "ot/"), concat!("/ho", "me/"), concat!("/Us", "ers/")];

/// What lies beside the repository.
const OUTSIDE: [&str; 1] = [concat!("../sha", "red")];

/// Hosts of package registries: which one is used is the business of the machine.
const HOSTS: [&str; 8] = [
    concat!("index.crates", ".io"),
    concat!("static.crates", ".io"),
    concat!("crates.io", "-index"),
    concat!("pypi", ".org"),
    concat!("python", "hosted.org"),
    concat!("registry.npm", "js.org"),
    concat!("registry.yarn", "pkg.com"),
    concat!("deb.debian", ".org"),
];

/// Marks of unfinished work.
const MARKS: [&str; 5] = [
    concat!("TO", "DO"),
    concat!("FIX", "ME"),
    concat!("XX", "X"),
    concat!("to", "do!("),
    concat!("unimple", "mented!("),
];

/// The line by which Cargo.lock itself names the standard registry: its file format, allowed there and nowhere else.
const LOCK_LINE: &str = concat!("source = \"registry+https://github.com/rust-lang/", "crates.io", "-index\"");

pub(super) fn check(tree: &Tree) -> Vec<Finding> {
    tree.files().iter().flat_map(check_file).collect()
}

fn check_file(file: &File) -> Vec<Finding> {
    let lines = file.lines().filter(|(_, line)| !is_lock_line(file, line));
    let found = lines.filter_map(|(number, line)| Some((number, find(line)?)));
    found
        .map(|(number, what)| Finding::refused(&file.path, number, format!("`{what}` does not belong here")))
        .collect()
}

fn is_lock_line(file: &File, line: &str) -> bool {
    file.path == "Cargo.lock" && line == LOCK_LINE
}

fn find(line: &str) -> Option<&'static str> {
    let folder = FOLDERS.into_iter().find(|folder| has_absolute(line, folder));
    let part = || OUTSIDE.into_iter().chain(HOSTS).find(|part| line.contains(part));
    let mark = || MARKS.into_iter().find(|mark| has_mark(line, mark));
    folder.or_else(part).or_else(mark)
}

/// Whether the folder stands at the start of a path, not within one or within an address.
fn has_absolute(line: &str, folder: &str) -> bool {
    let continues = |c: char| c.is_alphanumeric() || "_-.~)}".contains(c);
    line.match_indices(folder).any(|(at, _)| !line[..at].ends_with(continues))
}

/// Macros by their text, the other marks as whole words.
fn has_mark(line: &str, mark: &str) -> bool {
    if mark.ends_with('(') { line.contains(mark) } else { has_word(line, mark) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn count(path: &str, text: &str) -> usize {
        check(&Tree::from(&[(path, text)])).len()
    }

    #[test]
    fn every_pattern_is_found() {
        for pattern in FOLDERS.into_iter().chain(OUTSIDE).chain(HOSTS).chain(MARKS) {
            assert_eq!(count("docs/page.md", &format!("see {pattern} there")), 1, "{pattern}");
        }
    }

    #[test]
    fn folders_within_paths_and_addresses_are_free() {
        let folder = FOLDERS[2];
        assert_eq!(count("a.md", &format!("https://example.org{folder}x")), 0);
        assert_eq!(count("a.md", &format!("target{folder}x")), 0);
        assert_eq!(count("a.md", &format!("file://{folder}x")), 1);
    }

    #[test]
    fn the_lock_file_may_name_its_registry() {
        assert_eq!(count("Cargo.lock", LOCK_LINE), 0);
        assert_eq!(count("other.lock", LOCK_LINE), 1);
        assert_eq!(count("Cargo.lock", &format!("source = \"sparse+https://{}/\"", HOSTS[0])), 1);
    }
}
