//! A scene is a folder `scenes/NN-name` with the scene and the lesson.

use std::collections::BTreeSet;

use super::Finding;
use super::tree::Tree;

const FOLDER: &str = "scenes/";
const FILES: [&str; 2] = ["scene.toml", "README.md"];

pub(super) fn check(tree: &Tree) -> Vec<Finding> {
    scenes(tree).into_iter().flat_map(|scene| check_scene(tree, scene)).collect()
}

/// The names of the folders directly in `scenes`.
fn scenes(tree: &Tree) -> BTreeSet<&str> {
    let paths = tree.below(FOLDER, "").filter_map(|file| file.path.strip_prefix(FOLDER));
    paths.filter_map(|path| path.split_once('/')).map(|(scene, _)| scene).collect()
}

fn check_scene(tree: &Tree, scene: &str) -> Vec<Finding> {
    let path = format!("{FOLDER}{scene}");
    let missing = FILES.iter().filter(|file| tree.file(&format!("{path}/{file}")).is_none());
    let mut findings: Vec<_> =
        missing.map(|file| Finding::refused(&path, 0, format!("{file} is missing"))).collect();
    if !is_numbered(scene) {
        findings.push(Finding::refused(&path, 0, "is not named NN-name, as in 01-pendulum"));
    }
    findings
}

fn is_numbered(scene: &str) -> bool {
    let Some((number, name)) = scene.split_once('-') else { return false };
    number.len() == 2 && number.bytes().all(|byte| byte.is_ascii_digit()) && !name.is_empty()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn count(paths: &[&str]) -> usize {
        let files: Vec<_> = paths.iter().map(|&path| (path, "")).collect();
        check(&Tree::from(&files)).len()
    }

    #[test]
    fn both_files_and_a_number() {
        assert_eq!(count(&["scenes/01-rod/scene.toml", "scenes/01-rod/README.md", "scenes/README.md"]), 0);
        assert_eq!(count(&["scenes/01-rod/scene.toml"]), 1);
        assert_eq!(count(&["scenes/rod/scene.toml", "scenes/rod/README.md"]), 1);
        assert_eq!(count(&["scenes/1-rod/figure.svg"]), 3);
    }
}
