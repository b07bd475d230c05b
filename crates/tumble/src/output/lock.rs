//! One writer at a time: a file beside the results that its writer has locked.
//!
//! The system lets go of a lock when its process ends, however that ends, so that what a killed run has left of its lock
//! is no obstacle.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, ErrorKind, Read, Seek, Write};
use std::path::{Path, PathBuf};

use super::{Foreign, OutputError, attempt};

/// What the file says while it is locked, before the number of the process.
const HELD: &str = "Results beside this file are being written by tumble, process ";
/// What it says once it is no more: whoever has opened it before has to open another.
const RETIRED: &str = "No lock any more.\n";
/// Longer files are none of ours.
const LONGEST: u64 = 200;
/// A lock that was given up while it was being taken is taken anew; more often than this is somebody else's luck.
const TRIES: usize = 100;

/// The right to write some results, until it is dropped.
#[derive(Debug)]
pub(super) struct Lock {
    file: File,
    path: PathBuf,
    /// Whether the file system knows locks. Where not, two writers do not see each other.
    pub(super) is_sure: bool,
}

/// What became of taking a lock.
enum Taken {
    Ours(Lock),
    /// It was given up in between.
    Gone,
    Held,
    /// The file is somebody's.
    Foreign,
}

impl Lock {
    /// Takes the lock of a place; `option` is what chooses another place.
    pub(super) fn take(place: &Path, option: &'static str) -> Result<Self, OutputError> {
        let name = place.file_name().unwrap_or_default().to_string_lossy();
        let path = place.with_file_name(format!(".{name}.lock"));
        for _ in 0..TRIES {
            let Some(file) = attempt(&path, open(&path))? else { continue };
            match attempt(&path, Self::of(file, &path))? {
                Taken::Ours(lock) => return Ok(lock),
                Taken::Gone => continue,
                Taken::Held => break,
                Taken::Foreign => return Err(OutputError::foreign(&path, Foreign::Unmarked, option)),
            }
        }
        Err(OutputError::Busy { place: place.to_owned(), process: holder(&path), option })
    }

    /// Locks a file that was opened at this path, if it still is there and nobody's.
    fn of(mut file: File, path: &Path) -> io::Result<Taken> {
        let is_sure = match file.try_lock() {
            Ok(()) => true,
            Err(TryLockError::WouldBlock) => return Ok(Taken::Held),
            Err(TryLockError::Error(_)) => false,
        };
        match text(&mut file)?.as_str() {
            RETIRED => Ok(Taken::Gone),
            text if text.is_empty() || text.starts_with(HELD) => {
                let mut lock = Self { file, path: path.to_owned(), is_sure };
                lock.write(&format!("{HELD}{}\n", std::process::id()))?;
                Ok(Taken::Ours(lock))
            }
            _ => Ok(Taken::Foreign),
        }
    }

    fn write(&mut self, text: &str) -> io::Result<()> {
        self.file.set_len(0)?;
        self.file.rewind()?;
        self.file.write_all(text.as_bytes())
    }
}

impl Drop for Lock {
    /// Removes the file while it is locked, and only then says so in it: who has it open finds that out, and who opens
    /// the path makes a new one.
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.path);
        let _ = self.write(RETIRED);
    }
}

/// What a file says, as far as it may be ours.
fn text(file: &mut File) -> io::Result<String> {
    let mut bytes = vec![];
    file.rewind()?;
    file.take(LONGEST).read_to_end(&mut bytes)?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// A new file, or the one that is there; `None` if it went away in between.
fn open(path: &Path) -> io::Result<Option<File>> {
    let mut how = OpenOptions::new();
    how.read(true).write(true);
    match how.clone().create_new(true).open(path) {
        Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
        made => return made.map(Some),
    }
    match fs::symlink_metadata(path) {
        Ok(about) if about.is_file() => {}
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        Ok(_) => return Err(io::Error::other("it is a lock file, and something else has its name")),
        Err(error) => return Err(error),
    }
    match how.open(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        opened => opened.map(Some),
    }
}

/// The process that has the lock, where the system lets others read what is locked.
fn holder(path: &Path) -> Option<u32> {
    fs::read_to_string(path).ok()?.strip_prefix(HELD)?.trim().parse().ok()
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::time::Duration;

    use super::*;

    fn folder() -> tempfile::TempDir {
        tempfile::tempdir().expect("a temporary folder")
    }

    #[test]
    fn one_at_a_time() {
        let folder = folder();
        let place = folder.path().join("stone");
        let first = Lock::take(&place, "--out").expect("free");
        let Err(OutputError::Busy { process, .. }) = Lock::take(&place, "--out") else {
            panic!("two at once")
        };
        assert!(process.is_none_or(|process| process == std::process::id()));
        drop(first);
        drop(Lock::take(&place, "--out").expect("free again"));
        assert_eq!(fs::read_dir(folder.path()).expect("readable").count(), 0, "nothing is left");
    }

    #[test]
    fn what_a_killed_run_has_left_is_taken_over() {
        let folder = folder();
        for left in ["", &format!("{HELD}4294967295\n")] {
            fs::write(folder.path().join(".stone.lock"), left).expect("writable");
            Lock::take(&folder.path().join("stone"), "--out").expect("nobody has it");
        }
    }

    #[test]
    fn a_file_of_that_name_is_left_alone() {
        let folder = folder();
        let mine = folder.path().join(".stone.lock");
        fs::write(&mine, "mine").expect("writable");
        let taken = Lock::take(&folder.path().join("stone"), "--out");
        assert!(matches!(taken, Err(OutputError::Foreign { .. })), "{taken:?}");
        assert_eq!(fs::read_to_string(&mine).expect("there"), "mine");
    }

    /// Else one could have the old file locked, and another the new one.
    #[test]
    fn a_lock_that_was_opened_before_it_was_given_up_is_none() {
        let folder = folder();
        let path = folder.path().join(".stone.lock");
        let first = Lock::take(&folder.path().join("stone"), "--out").expect("free");
        let opened = open(&path).expect("readable").expect("there");
        drop(first);
        let _second = Lock::take(&folder.path().join("stone"), "--out").expect("free again");
        assert!(matches!(Lock::of(opened, &path), Ok(Taken::Gone)));
        assert!(path.exists(), "the second one is held");
    }

    #[test]
    fn of_many_at_once_no_two_have_it() {
        let folder = folder();
        let place = folder.path().join("stone");
        let (holders, taken) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let try_often = || {
            for _ in 0..300 {
                let Ok(lock) = Lock::take(&place, "--out") else { continue };
                assert_eq!(holders.fetch_add(1, Ordering::SeqCst), 0, "two have it");
                std::thread::sleep(Duration::from_micros(20));
                holders.fetch_sub(1, Ordering::SeqCst);
                taken.fetch_add(1, Ordering::SeqCst);
                drop(lock);
            }
        };
        std::thread::scope(|scope| (0..4).for_each(|_| drop(scope.spawn(try_often))));
        assert!(taken.into_inner() > 0);
    }
}
