//! Where a crate says which of its tests are programs, every file of tests is in one: what is forgotten would never run.

use super::Finding;
use super::tree::{File, Tree};

/// What a crate says that lists its tests itself.
const LISTS: &str = "autotests = false";

pub(super) fn check(tree: &Tree) -> Vec<Finding> {
    let crates = tree.below("crates/", "Cargo.toml").filter(|file| file.text().contains(LISTS));
    crates.flat_map(|own| check_crate(tree, own)).collect()
}

fn check_crate(tree: &Tree, manifest: &File) -> Vec<Finding> {
    let folder = manifest.path.trim_end_matches("Cargo.toml").to_owned() + "tests/";
    let files: Vec<(&str, &File)> = tree
        .below(&folder, ".rs")
        .filter_map(|file| Some((file.path.strip_prefix(&folder)?.strip_suffix(".rs")?, file)))
        .filter(|(name, _)| !name.contains('/'))
        .collect();
    let is_program = |name: &str| manifest.text().contains(&format!("name = \"{name}\""));
    let is_part = |name: &str| {
        let mut programs = files.iter().filter(|(program, _)| is_program(program));
        programs.any(|(_, program)| program.text().lines().any(|line| line == format!("mod {name};")))
    };
    let forgotten = files.iter().filter(|(name, _)| !is_program(name) && !is_part(name));
    forgotten.map(|(_, file)| Finding::refused(&file.path, 0, "no program of tests has it")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn count(program: &str) -> usize {
        let manifest = "autotests = false\n[[test]]\nname = \"all\"\n";
        let files = [
            ("crates/a/Cargo.toml", manifest),
            ("crates/a/tests/all.rs", program),
            ("crates/a/tests/rod.rs", ""),
            ("crates/a/tests/common/mod.rs", ""),
        ];
        check(&Tree::from(&files)).len()
    }

    #[test]
    fn a_file_that_no_program_has_is_refused() {
        assert_eq!(count("mod rod;\n"), 0);
        assert_eq!(count("mod rods;\n"), 1);
    }
}
