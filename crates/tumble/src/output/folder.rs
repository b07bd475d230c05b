//! The folder of one scene's results: written aside, then put in place whole.

use std::fs::{self, File};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use super::lock::Lock;
use super::manifest::{HEAD, MARKER, Manifest};
use super::table::Sink;
use super::{Foreign, OutputError, PARTIAL, Spool, attempt, beside, leftovers, make, shown};

/// What chooses another place for results.
const OPTION: &str = "--out";
/// Ending of the last results while they are replaced.
const OLD: &str = "old";

/// A folder being filled.
#[derive(Debug)]
pub(crate) struct Folder {
    aside: PathBuf,
    place: PathBuf,
    /// What the scene is read from.
    needed: Vec<PathBuf>,
    written: Mutex<Manifest>,
    /// The list as it grows, for whoever finds the folder of a run that was killed.
    marker: Mutex<Option<File>>,
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
    pub(crate) fn begin(out: &Path, name: &str, needed: &[PathBuf]) -> Result<Self, OutputError> {
        make(out, OPTION)?;
        let place = out.join(name);
        let lock = Lock::take(&place, OPTION)?;
        refuse(&place, needed)?;
        let notes = if lock.is_sure { clear(&place) } else { vec![] };
        let aside = beside(&place, PARTIAL);
        Ok(Self {
            marker: Mutex::new(Some(begin(&aside)?)),
            needed: needed.to_vec(),
            aside,
            place,
            written: Mutex::default(),
            is_kept: false,
            notes,
            _lock: lock,
        })
    }

    /// Where the results will stand, from the root; `None` where the system cannot tell.
    pub(crate) fn place(&self) -> Option<PathBuf> {
        let out = self.place.parent()?.canonicalize().ok()?;
        Some(out.join(self.place.file_name()?))
    }

    /// A file to be written, its folders made.
    pub(super) fn sink(&self, file: &str) -> Result<Sink, OutputError> {
        let (path, line) = (self.aside.join(file), Manifest::begun(file));
        let listed = held(&self.marker).iter_mut().try_for_each(|marker| marker.write_all(line.as_bytes()));
        attempt(&self.aside.join(MARKER), listed)?;
        if let Some(parent) = path.parent() {
            attempt(parent, fs::create_dir_all(parent))?;
        }
        attempt(&path, Sink::create(&path))
    }

    /// Notes a file that was written.
    pub(super) fn wrote(&self, file: &str, sink: Sink) {
        held(&self.written).add(file, sink.hash());
    }

    /// Writes a file.
    pub(crate) fn write(&self, file: &str, contents: &[u8]) -> Result<(), OutputError> {
        self.write_by(file, |sink| sink.write_all(contents))
    }

    /// Writes a file piece by piece, for what is too long to be held at once.
    pub(crate) fn write_by(
        &self,
        file: &str,
        pieces: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), OutputError> {
        let mut buffer = BufWriter::new(self.sink(file)?);
        let written = pieces(&mut buffer).and_then(|()| Ok(buffer.into_inner()?));
        self.wrote(file, attempt(&self.aside.join(file), written)?);
        Ok(())
    }

    /// The outcome of what is to come into a file, which the error names.
    pub(crate) fn towards<T>(&self, file: &str, outcome: io::Result<T>) -> Result<T, OutputError> {
        attempt(&self.aside.join(file), outcome)
    }

    /// Texts to come into files.
    pub(crate) fn spool(&self) -> Spool {
        Spool::beside(&self.aside)
    }

    /// Puts the folder in its place.
    pub(crate) fn finish(mut self) -> Result<Placed, OutputError> {
        // Some systems do not move a folder of which a file is open.
        held(&self.marker).take();
        let written = std::mem::take(&mut *held(&self.written));
        self.towards(MARKER, self.list(&written))?;
        drop(written);
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

    /// Writes the list of what is in the folder.
    fn list(&self, written: &Manifest) -> io::Result<()> {
        let mut marker = BufWriter::new(File::create(self.aside.join(MARKER))?);
        written.write(&mut marker)?;
        marker.flush()
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

/// What several runs write to. One that has panicked leaves a line too few at worst.
fn held<T>(shared: &Mutex<T>) -> MutexGuard<'_, T> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Makes a folder that says whose it is, and its list.
fn begin(folder: &Path) -> Result<File, OutputError> {
    attempt(folder, fs::create_dir(folder))?;
    let marker = folder.join(MARKER);
    let begun = File::create_new(&marker).and_then(|mut file| file.write_all(HEAD.as_bytes()).map(|()| file));
    let begun = begun.inspect_err(|_| {
        let _ = fs::remove_file(&marker);
        let _ = fs::remove_dir(folder);
    });
    attempt(&marker, begun)
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

#[cfg(test)]
mod tests;
