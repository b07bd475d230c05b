//! The folder of one scene's results: written aside, then put in place whole.

use std::cell::RefCell;
use std::fs::{self, File};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use super::lock::Lock;
use super::manifest::{HEAD, MARKER, Manifest};
use super::table::Sink;
use super::{Foreign, OutputError, PARTIAL, attempt, beside, leftovers, make, shown};

/// What chooses another place for results.
const OPTION: &str = "--out";
/// Ending of the last results while they are replaced.
const OLD: &str = "old";

/// A folder being filled.
#[derive(Debug)]
pub struct Folder {
    aside: PathBuf,
    place: PathBuf,
    /// What the scene is read from.
    needed: Vec<PathBuf>,
    written: RefCell<Manifest>,
    /// The list as it grows, for whoever finds the folder of a run that was killed.
    marker: RefCell<File>,
    /// Whether what was written stays where it is.
    is_kept: bool,
    notes: Vec<String>,
    /// Given up last.
    _lock: Lock,
}

/// Results in their place.
#[derive(Debug)]
pub(crate) struct Placed {
    /// The folder.
    pub(crate) folder: PathBuf,
    /// What is left over and was not removed, with the reason.
    pub(crate) notes: Vec<String>,
}

impl Folder {
    /// Begins the folder `name` in `out`. What stood there before stays until [`Folder::finish`].
    ///
    /// The scene is read from the files `needed`, which must not be in what is replaced.
    pub fn begin(out: &Path, name: &str, needed: &[PathBuf]) -> Result<Self, OutputError> {
        make(out, OPTION)?;
        let place = out.join(name);
        let lock = Lock::take(&place, OPTION)?;
        refuse(&place, needed)?;
        let notes = if lock.is_sure { clear(&place) } else { vec![] };
        let aside = beside(&place, PARTIAL);
        attempt(&aside, fs::create_dir(&aside))?;
        let marker = aside.join(MARKER);
        let begun =
            File::create_new(&marker).and_then(|mut file| file.write_all(HEAD.as_bytes()).map(|()| file));
        let begun = begun.inspect_err(|_| {
            let _ = fs::remove_file(&marker);
            let _ = fs::remove_dir(&aside);
        });
        Ok(Self {
            marker: RefCell::new(attempt(&marker, begun)?),
            needed: needed.to_vec(),
            aside,
            place,
            written: RefCell::default(),
            is_kept: false,
            notes,
            _lock: lock,
        })
    }

    /// A file to be written, its folders made.
    pub(super) fn sink(&self, file: &str) -> Result<Sink, OutputError> {
        let path = self.aside.join(file);
        if let Some(parent) = path.parent() {
            attempt(parent, fs::create_dir_all(parent))?;
        }
        let line = Manifest::begun(file);
        attempt(&self.aside.join(MARKER), self.marker.borrow_mut().write_all(line.as_bytes()))?;
        attempt(&path, Sink::create(&path))
    }

    /// Notes a file that was written.
    pub(super) fn wrote(&self, file: &str, sink: Sink) {
        self.written.borrow_mut().add(file.to_owned(), sink.hash());
    }

    /// Writes a file.
    pub fn write(&self, file: &str, contents: &[u8]) -> Result<(), OutputError> {
        let mut sink = self.sink(file)?;
        attempt(&self.aside.join(file), sink.write_all(contents))?;
        self.wrote(file, sink);
        Ok(())
    }

    /// Puts the folder in its place.
    pub(crate) fn finish(mut self) -> Result<Placed, OutputError> {
        let (marker, text) = (self.aside.join(MARKER), self.written.borrow().text());
        attempt(&marker, fs::write(&marker, text))?;
        match self.put() {
            Ok(note) => {
                self.notes.extend(note);
                Ok(Placed { folder: self.place.clone(), notes: std::mem::take(&mut self.notes) })
            }
            Err(why) => {
                self.is_kept = true;
                Err(OutputError::Kept { kept: self.aside.clone(), why: Box::new(why) })
            }
        }
    }

    /// Moves the last results away, these in, and removes the last ones; a note if those cannot be removed.
    fn put(&self) -> Result<Option<String>, OutputError> {
        // Much may have happened since the run began.
        let Some(last) = refuse(&self.place, &self.needed)? else {
            attempt(&self.place, fs::rename(&self.aside, &self.place))?;
            return Ok(None);
        };
        let old = beside(&self.place, OLD);
        attempt(&self.place, fs::rename(&self.place, &old))?;
        let put = fs::rename(&self.aside, &self.place).inspect_err(|_| {
            let _ = fs::rename(&old, &self.place);
        });
        attempt(&self.place, put)?;
        Ok(last
            .remove(&old)
            .err()
            .map(|error| format!("the last results are left in {}: {error}", shown(&old))))
    }
}

impl Drop for Folder {
    /// Removes what was written, if it was not put in place.
    fn drop(&mut self) {
        if !self.is_kept
            && let Some(begun) = Manifest::read(&self.aside)
        {
            let _ = begun.remove(&self.aside);
        }
    }
}

/// Refuses a place where something stands that is not to be replaced; else what is on the list of what stands there.
fn refuse(place: &Path, needed: &[PathBuf]) -> Result<Option<Manifest>, OutputError> {
    let about = match fs::symlink_metadata(place) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        about => attempt(place, about)?,
    };
    let refused = |why: Foreign| Err(OutputError::foreign(place, why, OPTION));
    if !about.is_dir() {
        return refused(if about.is_file() { Foreign::File } else { Foreign::Special });
    }
    if let Some(path) = inside(place, needed) {
        return refused(Foreign::Needed(path));
    }
    let Some(manifest) = Manifest::read(place) else { return refused(Foreign::Unmarked) };
    match attempt(place, manifest.foreign(place))? {
        Some(why) => refused(why),
        None => Ok(Some(manifest)),
    }
}

/// The first of these files that is in a folder, by its path there.
fn inside(folder: &Path, files: &[PathBuf]) -> Option<PathBuf> {
    let folder = folder.canonicalize().ok()?;
    files.iter().find_map(|file| file.canonicalize().ok()?.strip_prefix(&folder).ok().map(Path::to_owned))
}

/// Removes what runs that were killed have left, which no living process can be writing under our lock; notes on what
/// holds more than they wrote, which is left.
fn clear(place: &Path) -> Vec<String> {
    leftovers(place, &[PARTIAL, OLD]).iter().filter_map(|left| clear_one(left)).collect()
}

fn clear_one(folder: &Path) -> Option<String> {
    let note = |why: &str| Some(format!("{}, left by a run that was ended, {why}: it stays", shown(folder)));
    if !fs::symlink_metadata(folder).is_ok_and(|about| about.is_dir()) {
        return note(&Foreign::Special.to_string());
    }
    let Some(manifest) = Manifest::read(folder) else {
        // It may have been killed before it said so. Only an empty folder can be removed like this.
        return fs::remove_dir(folder).err().and_then(|_| note(&Foreign::Unmarked.to_string()));
    };
    match manifest.unlisted(folder) {
        Ok(Some(why)) => note(&why.to_string()),
        Ok(None) => {
            manifest.remove(folder).err().and_then(|error| note(&format!("cannot be removed ({error})")))
        }
        Err(error) => note(&format!("cannot be read ({error})")),
    }
}
