//! Files stay short enough to be read at once.

use super::Finding;
use super::tree::{File, Tree};

const WARNED: usize = 400;
const REFUSED: usize = 600;

/// Files that may be longer.
const ALLOWED: &[&str] = &[];

pub(super) fn check(tree: &Tree) -> Vec<Finding> {
    let files = tree.below("", ".rs").filter(|file| !ALLOWED.contains(&file.path.as_str()));
    files.filter_map(check_file).collect()
}

fn check_file(file: &File) -> Option<Finding> {
    let lines = file.lines().count();
    if lines > REFUSED {
        Some(Finding::refused(&file.path, 0, format!("{lines} lines, more than {REFUSED}")))
    } else if lines > WARNED {
        Some(Finding::warning(&file.path, 0, format!("{lines} lines, more than {WARNED}")))
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn warned_then_refused() {
        let finding = |lines: usize| check(&Tree::from(&[("a.rs", &"\n".repeat(lines))])).pop();
        assert_eq!(finding(400), None);
        assert!(finding(401).is_some_and(|finding| !finding.refuses));
        assert!(finding(600).is_some_and(|finding| !finding.refuses));
        assert!(finding(601).is_some_and(|finding| finding.refuses));
    }
}
