//! The engine of pages is that of the sources; it is renewed once when a piece of work ends, and told of until then.

use super::Finding;
use super::tree::Tree;
use crate::lab;

pub(super) fn check(tree: &Tree) -> Vec<Finding> {
    let warning =
        || Finding::warning(lab::SOURCES, 0, "not that of the sources: `cargo xtask lab` renews it");
    (!lab::is_renewed(tree)).then(warning).into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stale_engine_is_told_of() {
        let source = ("crates/tumble-lab/src/lib.rs", "one");
        let hash = lab::hash(&Tree::from(&[source]));
        assert!(check(&Tree::from(&[source, (lab::SOURCES, &hash)])).is_empty());
        let changed = ("crates/tumble-lab/src/lib.rs", "two");
        let found = check(&Tree::from(&[changed, (lab::SOURCES, &hash)]));
        assert!(found.len() == 1 && !found[0].refuses);
    }
}
