//! The folder of one scene's results: written aside, then put in place whole.

use std::fs;
use std::path::{Path, PathBuf};

use thiserror::Error;

/// Says that a folder is ours to replace.
const MARKER: &str = ".tumble-output";
const MARKER_TEXT: &str = "Written by tumble, which replaces this folder at the next run.\n";

/// Why results cannot be written.
#[derive(Debug, Error)]
pub enum OutputError {
    /// Something else stands where the results would go.
    #[error("{} exists and was not written by tumble: remove it, or choose another place with --out", .0.display())]
    Foreign(PathBuf),
    /// The file system refuses.
    #[error("cannot write {}: {error}", path.display())]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// Why.
        error: std::io::Error,
    },
    /// A table cannot be written.
    #[error("cannot write a table: {0}")]
    Table(#[from] csv::Error),
    /// A picture cannot be made.
    #[error("cannot draw {name}: {reason}")]
    Picture {
        /// Its name.
        name: String,
        /// Why.
        reason: String,
    },
}

/// A folder being filled.
pub struct Folder {
    aside: PathBuf,
    place: PathBuf,
}

impl Folder {
    /// Begins the folder `name` in `out`. What stood there before stays until [`Folder::finish`].
    pub fn begin(out: &Path, name: &str) -> Result<Self, OutputError> {
        let place = out.join(name);
        if place.exists() && !place.join(MARKER).is_file() {
            return Err(OutputError::Foreign(place));
        }
        // Two runs at once must not write into one folder.
        let aside = out.join(format!(".{name}.{}.partial", std::process::id()));
        remove(&aside)?;
        attempt(&aside, fs::create_dir_all(&aside))?;
        let folder = Self { aside, place };
        folder.write(MARKER, MARKER_TEXT.as_bytes())?;
        Ok(folder)
    }

    /// Path of a file being written, its folders made.
    pub fn path(&self, file: &str) -> Result<PathBuf, OutputError> {
        let path = self.aside.join(file);
        if let Some(parent) = path.parent() {
            attempt(parent, fs::create_dir_all(parent))?;
        }
        Ok(path)
    }

    /// Writes a file.
    pub fn write(&self, file: &str, contents: &[u8]) -> Result<(), OutputError> {
        let path = self.path(file)?;
        attempt(&path, fs::write(&path, contents))
    }

    /// Puts the folder in its place.
    pub fn finish(self) -> Result<PathBuf, OutputError> {
        remove(&self.place)?;
        attempt(&self.place, fs::rename(&self.aside, &self.place))?;
        Ok(self.place.clone())
    }
}

impl Drop for Folder {
    /// After [`Folder::finish`] there is nothing left to remove.
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.aside);
    }
}

fn remove(folder: &Path) -> Result<(), OutputError> {
    if folder.exists() { attempt(folder, fs::remove_dir_all(folder)) } else { Ok(()) }
}

fn attempt(path: &Path, result: std::io::Result<()>) -> Result<(), OutputError> {
    result.map_err(|error| OutputError::Write { path: path.to_owned(), error })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_finished_folder_is_replaced_whole() {
        let out = tempfile::tempdir().expect("a temporary folder");
        for text in ["one", "two"] {
            let folder = Folder::begin(out.path(), "scene").expect("ours");
            folder.write("deep/file.txt", text.as_bytes()).expect("writable");
            let place = folder.finish().expect("writable");
            assert_eq!(fs::read_to_string(place.join("deep/file.txt")).expect("there"), text);
        }
        assert_eq!(fs::read_dir(out.path()).expect("readable").count(), 1);
    }

    #[test]
    fn what_is_not_ours_is_left_alone() {
        let out = tempfile::tempdir().expect("a temporary folder");
        fs::create_dir(out.path().join("scene")).expect("writable");
        fs::write(out.path().join("scene/thesis.tex"), "years of work").expect("writable");
        assert!(matches!(Folder::begin(out.path(), "scene"), Err(OutputError::Foreign(_))));
        assert!(out.path().join("scene/thesis.tex").exists());
    }

    #[test]
    fn an_unfinished_folder_leaves_the_last_one() {
        let out = tempfile::tempdir().expect("a temporary folder");
        let first = Folder::begin(out.path(), "scene").expect("ours");
        first.write("file.txt", b"first").expect("writable");
        let place = first.finish().expect("writable");
        drop(Folder::begin(out.path(), "scene").expect("ours"));
        assert_eq!(fs::read_to_string(place.join("file.txt")).expect("there"), "first");
        assert_eq!(fs::read_dir(out.path()).expect("readable").count(), 1);
    }
}
