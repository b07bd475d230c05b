//! Code that the compiler does not check is in named files only.

use super::Finding;
use super::source::{code, has_word};
use super::tree::Tree;

/// The files that may have it.
const ALLOWED: &[&str] = &["crates/tumble-lab/src/abi.rs"];

/// Written in two parts, so that this file is not a finding of itself.
const WORD: &str = concat!("un", "safe");

pub(super) fn check(tree: &Tree) -> Vec<Finding> {
    let files = tree.below("", ".rs").filter(|file| !ALLOWED.contains(&file.path.as_str()));
    let lines = files.flat_map(|file| file.lines().map(move |(number, line)| (file, number, line)));
    lines
        .filter(|(_, _, line)| has_word(code(line), WORD))
        .map(|(file, number, _)| {
            Finding::refused(&file.path, number, format!("`{WORD}` outside the named files"))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(text: &str) -> Vec<usize> {
        check(&Tree::from(&[("crates/a/src/lib.rs", text)])).into_iter().map(|finding| finding.line).collect()
    }

    #[test]
    fn the_keyword_is_found() {
        assert_eq!(lines(&format!("fn a() {{\n    {WORD} {{ b() }}\n}}\n")), [2]);
    }

    #[test]
    fn lint_names_and_comments_are_not() {
        assert!(lines(&format!("#![forbid({WORD}_code)]\n// {WORD}\n")).is_empty());
    }
}
