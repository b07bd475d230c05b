//! A single file, such as an animation: it replaces one of its kind only.

use std::fs::{self, File};
use std::io::{ErrorKind, Read, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::hash::Hash;
use super::lock::Lock;
use super::{Foreign, OutputError, PARTIAL, attempt, beside, leftovers, make};

/// Bytes within which a file of ours has its seal.
const BEGINNING: usize = 1 << 16;
/// Digits of a hash, which a seal ends in.
const DIGITS: usize = 64;

/// A kind of file.
#[derive(Clone, Copy)]
pub(crate) struct Kind {
    /// What stands in every file of the kind, once. It ends in as many zeros as a hash has digits; the hash of the file as
    /// it is with them is written in their place.
    pub(crate) seal: &'static str,
    /// What chooses another place for it.
    pub(crate) option: &'static str,
}

impl Kind {
    /// Where the hash stands in a file of this kind.
    fn place(self, contents: &[u8]) -> Option<Range<usize>> {
        let sign = &self.seal.as_bytes()[..self.seal.len() - DIGITS];
        let beginning = &contents[..contents.len().min(BEGINNING)];
        let start = beginning.windows(sign.len()).position(|part| part == sign)? + sign.len();
        (start + DIGITS <= contents.len()).then_some(start..start + DIGITS)
    }

    /// The file with the hash in its place.
    fn sealed(self, contents: &[u8]) -> Vec<u8> {
        let mut sealed = contents.to_vec();
        if let Some(place) = self.place(contents) {
            let hash = Hash::of(contents).to_string();
            sealed[place].copy_from_slice(hash.as_bytes());
        }
        sealed
    }

    /// Why a file of these contents is not one that tumble has written like this.
    fn refuses(self, mut contents: Vec<u8>) -> Option<Foreign> {
        let Some(place) = self.place(&contents) else { return Some(Foreign::Unmarked) };
        let written = contents[place.clone()].to_vec();
        contents[place].fill(b'0');
        let is_same = Hash::of(&contents).to_string().as_bytes() == written;
        (!is_same).then_some(Foreign::Edited)
    }
}

/// A file that is going to be written.
pub(crate) struct Single {
    place: PathBuf,
    kind: Kind,
    _lock: Lock,
}

impl Single {
    /// Refuses what must not be replaced before any work is done for it.
    pub(crate) fn begin(place: &Path, kind: Kind) -> Result<Self, OutputError> {
        if place.file_name().is_none() {
            return Err(OutputError::foreign(place, Foreign::Folder, kind.option));
        }
        let folder = place.parent().filter(|folder| !folder.as_os_str().is_empty());
        make(folder.unwrap_or(Path::new(".")), kind.option)?;
        refuse(place, kind)?;
        let lock = Lock::take(place, kind.option)?;
        if lock.is_sure {
            clear(place, kind);
        }
        Ok(Self { place: place.to_owned(), kind, _lock: lock })
    }

    /// Writes the file aside and puts it in its place.
    pub(crate) fn finish(self, contents: &[u8]) -> Result<PathBuf, OutputError> {
        let aside = beside(&self.place, PARTIAL);
        let written = File::create_new(&aside).and_then(|mut file| {
            let written = file.write_all(&self.kind.sealed(contents));
            written.inspect_err(|_| remove(&aside))
        });
        attempt(&aside, written)?;
        // Much may have happened since the work for it began.
        let put = refuse(&self.place, self.kind);
        let put = put.and_then(|()| attempt(&self.place, fs::rename(&aside, &self.place)));
        put.inspect_err(|_| remove(&aside))?;
        Ok(self.place)
    }
}

/// Removes what was written aside by runs that were killed. What is not whole is left, since nothing says whose it is.
fn clear(place: &Path, kind: Kind) {
    for left in leftovers(place, &[PARTIAL]) {
        if refuse(&left, kind).is_ok() {
            remove(&left);
        }
    }
}

/// Removes what was only begun.
fn remove(aside: &Path) {
    let _ = fs::remove_file(aside);
}

fn refuse(place: &Path, kind: Kind) -> Result<(), OutputError> {
    let about = match fs::symlink_metadata(place) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(()),
        about => attempt(place, about)?,
    };
    let why = match about {
        _ if about.is_dir() => Foreign::Folder,
        _ if !about.is_file() => Foreign::Special,
        _ => match kind.refuses(attempt(place, contents(place, kind))?) {
            Some(why) => why,
            None => return Ok(()),
        },
    };
    Err(OutputError::foreign(place, why, kind.option))
}

/// The contents of a file, or only its beginning if that is none of ours: the rest may be large.
fn contents(path: &Path, kind: Kind) -> std::io::Result<Vec<u8>> {
    let (mut file, mut bytes) = (File::open(path)?, vec![]);
    (&mut file).take(BEGINNING as u64).read_to_end(&mut bytes)?;
    if kind.place(&bytes).is_some() {
        file.read_to_end(&mut bytes)?;
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SEAL: &str = "tumble test 0000000000000000000000000000000000000000000000000000000000000000";
    const KIND: Kind = Kind { seal: SEAL, option: "--to" };

    fn write(place: &Path) -> Result<PathBuf, OutputError> {
        Single::begin(place, KIND)?.finish(format!("head {SEAL} tail").as_bytes())
    }

    #[test]
    fn a_file_replaces_its_like_only() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let place = folder.path().join("deep/file");
        let ours = |place: &Path| fs::read(place).expect("there");
        write(&place).expect("nothing there");
        write(&place).expect("its like");
        let mut changed = ours(&place);
        changed.extend(b" and more");
        let unsealed = format!("head {SEAL} tail").into_bytes();
        for (contents, expected) in [
            (changed, Foreign::Edited),
            (unsealed, Foreign::Edited),
            (b"mine".to_vec(), Foreign::Unmarked),
            (vec![], Foreign::Unmarked),
            (SEAL.as_bytes()[..20].to_vec(), Foreign::Unmarked),
        ] {
            fs::write(&place, &contents).expect("writable");
            let Err(OutputError::Foreign { why, option, .. }) = write(&place) else { panic!("replaced") };
            assert_eq!((why, option), (expected, "--to"));
            assert_eq!(ours(&place), contents);
        }
        assert_eq!(fs::read_dir(folder.path().join("deep")).expect("readable").count(), 1);
    }

    #[test]
    fn what_comes_in_between_is_left_alone() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let place = folder.path().join("file");
        let begun = Single::begin(&place, KIND).expect("nothing there");
        assert!(matches!(Single::begin(&place, KIND), Err(OutputError::Busy { .. })));
        fs::write(&place, "mine").expect("writable");
        assert!(matches!(begun.finish(SEAL.as_bytes()), Err(OutputError::Foreign { .. })));
        assert_eq!(fs::read_to_string(&place).expect("there"), "mine");
        assert_eq!(fs::read_dir(folder.path()).expect("readable").count(), 1);
    }

    #[test]
    fn what_a_killed_run_has_left_is_removed() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let place = folder.path().join("file");
        write(&place).expect("nothing there");
        let [whole, cut] = ["12", "13"].map(|process| folder.path().join(format!(".file.{process}.partial")));
        fs::rename(&place, &whole).expect("writable");
        fs::write(&cut, "nobody knows whose").expect("writable");
        write(&place).expect("nothing there");
        assert!(!whole.exists() && cut.exists());
    }
}
