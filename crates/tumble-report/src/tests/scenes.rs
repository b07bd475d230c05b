//! The scenes of the gallery, for tests.

use std::path::{Path, PathBuf};

use tumble_scene::{Files, Folder, Study, read_bytes_in};

use crate::results::{Case, Combinations};

/// The files of all scenes.
pub(crate) fn all() -> impl Iterator<Item = PathBuf> {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let folders = std::fs::read_dir(scenes).expect("the scenes");
    folders.map(|folder| folder.expect("readable").path().join("scene.toml"))
}

/// The runs of the scene of the gallery whose folder begins so.
pub(crate) fn motions_called(name: &str) -> (Study, Vec<Case>) {
    let is_own = |scene: &PathBuf| {
        scene
            .parent()
            .and_then(Path::file_name)
            .is_some_and(|folder| folder.to_string_lossy().starts_with(name))
    };
    motions_of(&all().find(is_own).expect("a scene of this name"))
}

/// The runs of a scene with their motions.
pub(crate) fn motions_of(scene: &Path) -> (Study, Vec<Case>) {
    let bytes = std::fs::read(scene).expect("readable");
    motions_in(&scene.display().to_string(), &bytes, &Folder::of(scene))
}

/// The runs of a scene's text.
pub(crate) fn motions_in(name: &str, text: &[u8], beside: &dyn Files) -> (Study, Vec<Case>) {
    let study = read_bytes_in(name, text, &[], beside).expect("a scene without mistakes");
    let runs = Combinations::of(&study).expect("values that can be set");
    let run = |index| Case::run(&runs, index, |_, _| std::ops::ControlFlow::Continue(()));
    let cases = (0..runs.count()).map(|index| run(index).expect("a scene that runs")).collect();
    (study, cases)
}

/// A scene with every law that no scene of the gallery has.
pub(crate) fn laws() -> (Study, Vec<Case>) {
    motions_in("laws", include_bytes!("laws.toml"), &tumble_scene::NoFiles)
}
