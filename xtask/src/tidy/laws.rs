//! A module that states a law of physics says in its header what the law is and how it is known to be right.

use super::Finding;
use super::tree::{File, Tree};

const CRATE: &str = "crates/tumble-mech/src/";
const FOLDER: &str = "crates/tumble-mech/src/laws/";
const SECTIONS: [&str; 6] =
    ["Law", "Symbols and units", "Sign and frame", "Validity", "Source", "Checked by"];
const HEADING: &str = "//! # ";

pub(super) fn check(tree: &Tree) -> Vec<Finding> {
    tree.below(CRATE, ".rs").filter(|file| states_law(file)).flat_map(check_header).collect()
}

/// Whether the header is asked for: by the marker, or by the folder.
fn states_law(file: &File) -> bool {
    let marked = file.lines().any(|(_, line)| line.strip_prefix(HEADING) == Some(SECTIONS[0]));
    let placed = file.path.starts_with(FOLDER) && !file.path.ends_with("/mod.rs");
    marked || placed
}

fn check_header(file: &File) -> Vec<Finding> {
    let sections = sections(file);
    let names: Vec<&str> = sections.iter().map(|section| section.name).collect();
    if names != SECTIONS {
        let message =
            format!("sections of the header are [{}], not [{}]", names.join(", "), SECTIONS.join(", "));
        return vec![Finding::refused(&file.path, 0, message)];
    }
    let empty = sections.iter().filter(|section| !section.has_text);
    empty
        .map(|section| Finding::refused(&file.path, section.line, format!("nothing in `{}`", section.name)))
        .collect()
}

struct Section<'a> {
    name: &'a str,
    line: usize,
    has_text: bool,
}

fn sections(file: &File) -> Vec<Section<'_>> {
    let mut sections: Vec<Section> = Vec::new();
    for (line, text) in file.lines().filter(|(_, text)| text.starts_with("//!")) {
        if let Some(name) = text.strip_prefix(HEADING) {
            sections.push(Section { name, line, has_text: false });
        } else if let Some(section) = sections.last_mut() {
            section.has_text |= text != "//!";
        }
    }
    sections
}

#[cfg(test)]
mod tests {
    use super::*;

    const PATH: &str = "crates/tumble-mech/src/drag.rs";

    fn header(names: &[&str]) -> String {
        names.iter().map(|name| format!("//! # {name}\n//!\n//! Text.\n")).collect()
    }

    #[test]
    fn the_six_in_order() {
        assert!(check(&Tree::from(&[(PATH, &header(&SECTIONS))])).is_empty());
    }

    #[test]
    fn missing_swapped_or_empty_is_refused() {
        let swapped = ["Law", "Sign and frame", "Symbols and units", "Validity", "Source", "Checked by"];
        let empty = header(&SECTIONS).replacen("//! Text.\n", "", 1);
        for text in [header(&SECTIONS[..5]), header(&swapped), empty] {
            assert_eq!(check(&Tree::from(&[(PATH, &text)])).len(), 1, "{text}");
        }
    }

    #[test]
    fn unmarked_modules_are_free_outside_the_folder() {
        let plain = "//! Helpers.\n";
        assert!(check(&Tree::from(&[(PATH, plain)])).is_empty());
        assert!(check(&Tree::from(&[("crates/tumble-mech/src/laws/mod.rs", plain)])).is_empty());
        assert_eq!(check(&Tree::from(&[("crates/tumble-mech/src/laws/drag.rs", plain)])).len(), 1);
    }
}
