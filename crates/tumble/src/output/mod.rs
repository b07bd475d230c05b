//! What is written: folders of results, tables in them, and single files. Each replaces its like and nothing else.
//!
//! Everything is written aside and put in place whole, under a lock, so that a run that fails or is killed leaves the
//! last results as they were.

mod file;
mod folder;
mod hash;
mod lock;
mod manifest;
mod spool;
mod table;

use std::path::{Path, PathBuf};
use std::{fmt, fs, io};

use thiserror::Error;
use tumble_scene::printable;

pub(crate) use file::{Kind, Single};
pub(crate) use folder::{Folder, Placed};
pub(crate) use hash::Hash;
pub use spool::Spool;
pub(crate) use table::TableFile;

/// Why results cannot be written.
#[derive(Debug, Error)]
pub enum OutputError {
    /// Something else stands where the results would go.
    #[error("{} {why}: move it away, or choose another place with {option}", shown(place))]
    Foreign {
        /// Where the results would go.
        place: PathBuf,
        /// What stands there.
        why: Foreign,
        /// What chooses another place.
        option: &'static str,
    },
    /// Something else is writing the same results.
    #[error(
        "another tumble{} is writing {}: wait until it has ended, or choose another place with {option}",
        process.map_or_else(String::new, |process| format!(" (process {process})")), shown(place)
    )]
    Busy {
        /// Where the results go.
        place: PathBuf,
        /// Who it is, where the system tells.
        process: Option<u32>,
        /// What chooses another place.
        option: &'static str,
    },
    /// The file system refuses.
    #[error("cannot write {}: {error}", shown(path))]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// Why.
        error: io::Error,
    },
    /// The results are complete and could not be put in place.
    #[error("{why}; the results are complete in {}, until the next run of this scene", shown(kept))]
    Kept {
        /// Where they are.
        kept: PathBuf,
        /// Why they are not in place.
        why: Box<OutputError>,
    },
    /// A picture cannot be made.
    #[error("cannot draw {name}: {reason}")]
    Picture {
        /// Its name.
        name: String,
        /// Why.
        reason: String,
    },
}

/// Why something is not to be replaced; paths are relative to it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Foreign {
    /// Nothing says that tumble has written it.
    Unmarked,
    /// It is a link, or no ordinary file or folder.
    Special,
    /// It is a file where a folder would go.
    File,
    /// It is a folder where a file would go.
    Folder,
    /// It was changed since tumble wrote it.
    Edited,
    /// It holds something that tumble did not write.
    Holds(PathBuf),
    /// It holds a file that was changed since tumble wrote it.
    Changed(PathBuf),
    /// It holds what the scene is read from.
    Needed(PathBuf),
}

impl fmt::Display for Foreign {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unmarked => write!(f, "exists and was not written by tumble"),
            Self::Special => write!(f, "is a link or a device, which is not replaced"),
            Self::File => write!(f, "is a file, and results need a folder"),
            Self::Folder => write!(f, "is a folder, and a file is to be written"),
            Self::Edited => write!(f, "was changed since tumble wrote it"),
            Self::Holds(path) => write!(f, "holds {}, which was not written by tumble", shown(path)),
            Self::Changed(path) => {
                write!(f, "holds {}, which was changed since tumble wrote it", shown(path))
            }
            Self::Needed(path) => write!(f, "holds {}, which the scene is read from", shown(path)),
        }
    }
}

impl OutputError {
    fn foreign(place: &Path, why: Foreign, option: &'static str) -> Self {
        Self::Foreign { place: place.to_owned(), why, option }
    }
}

/// A path as messages have it.
pub(crate) fn shown(path: &Path) -> String {
    printable(&path.to_string_lossy()).into_owned()
}

/// The outcome of an operation on a file, which the error names.
fn attempt<T>(path: &Path, result: io::Result<T>) -> Result<T, OutputError> {
    result.map_err(|error| OutputError::Write { path: path.to_owned(), error })
}

/// Makes the folder that something is to be written in, and those above it.
fn make(folder: &Path, option: &'static str) -> Result<(), OutputError> {
    // A link to a folder may stand for the folder that results go to: it is not what is replaced.
    if fs::metadata(folder).is_ok_and(|about| !about.is_dir()) {
        return Err(OutputError::foreign(folder, Foreign::File, option));
    }
    attempt(folder, fs::create_dir_all(folder))
}

/// Ending of what only exists while it is written.
const PARTIAL: &str = "partial";

/// What runs that were killed have left beside a place, with one of these endings.
fn leftovers(place: &Path, endings: &[&str]) -> Vec<PathBuf> {
    let (Some(folder), Some(name)) = (place.parent(), place.file_name().and_then(|name| name.to_str()))
    else {
        return vec![];
    };
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let entries = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let is_left = |path: &PathBuf| {
        path.file_name().and_then(|entry| entry.to_str()).is_some_and(|entry| is_of(entry, name, endings))
    };
    let mut left: Vec<PathBuf> = entries.filter(is_left).collect();
    left.sort();
    left
}

/// Whether a name is `.NAME.PROCESS.partial`.
fn is_of(entry: &str, name: &str, endings: &[&str]) -> bool {
    let rest = entry.strip_prefix('.').and_then(|entry| entry.strip_prefix(name)?.strip_prefix('.'));
    rest.and_then(|rest| rest.split_once('.')).is_some_and(|(process, ending)| {
        let is_number = !process.is_empty() && process.bytes().all(|byte| byte.is_ascii_digit());
        is_number && endings.contains(&ending)
    })
}

/// A name beside a place that nothing else has: `.stone.1234.partial`.
fn beside(place: &Path, ending: &str) -> PathBuf {
    let name = place.file_name().unwrap_or_default().to_string_lossy();
    place.with_file_name(format!(".{name}.{}.{ending}", std::process::id()))
}
