//! What tumble has written into a folder: the list in it that says what a later run may replace.

use std::collections::BTreeMap;
use std::fs::{self, File, FileType};
use std::io::{self, BufRead, BufReader, Read, Write};
use std::ops::Bound;
use std::path::{Path, PathBuf};

use super::Foreign;
use super::hash::Hash;

/// The file that says that a folder is ours to replace, and what is in it.
pub(super) const MARKER: &str = ".tumble-output";
/// Its first lines; then a line a file, as `sha256sum` writes it.
pub(super) const HEAD: &str = "Written by tumble. The next run replaces this folder,\nunless it holds more than this or a file was changed.\n";
/// In the place of the hash of a file that is being written.
const BEGUN: &str = "begun";
/// Between hash and path.
const GAP: &str = "  ";
/// Files that systems put into folders that somebody looks at. They are nobody's work.
const OF_SYSTEMS: &[&str] = &[".DS_Store", "Thumbs.db", "desktop.ini", ".directory"];

/// Paths in a folder, with `/`, and the hash of what was written there; none where the writing was not finished. A sweep has
/// many thousands.
#[derive(Debug, Default)]
pub(super) struct Manifest(BTreeMap<Box<str>, Option<Hash>>);

impl Manifest {
    /// The list in a folder; `None` where there is none of ours.
    pub(super) fn read(folder: &Path) -> Option<Self> {
        let marker = folder.join(MARKER);
        if !fs::symlink_metadata(&marker).is_ok_and(|about| about.is_file()) {
            return None;
        }
        let mut text = BufReader::new(File::open(marker).ok()?);
        let mut head = [0; HEAD.len()];
        text.read_exact(&mut head).ok().filter(|()| head == *HEAD.as_bytes())?;
        let mut listed = BTreeMap::new();
        for line in text.lines() {
            let line = line.ok()?;
            let Some((hash, path)) = line.split_once(GAP) else { continue };
            listed.insert(path.into(), Hash::read(hash));
        }
        Some(Self(listed))
    }

    /// Writes it, but for files whose writing was not finished.
    pub(super) fn write(&self, to: &mut dyn Write) -> io::Result<()> {
        to.write_all(HEAD.as_bytes())?;
        for (path, hash) in &self.0 {
            hash.iter().try_for_each(|hash| writeln!(to, "{hash}{GAP}{path}"))?;
        }
        Ok(())
    }

    /// The line of a file that is about to be written.
    pub(super) fn begun(path: &str) -> String {
        format!("{BEGUN}{GAP}{path}\n")
    }

    /// Adds a file that was written.
    pub(super) fn add(&mut self, path: &str, hash: Hash) {
        self.0.insert(path.into(), Some(hash));
    }

    /// What is in a folder and is not on the list, or is not what was written.
    pub(super) fn foreign(&self, folder: &Path) -> io::Result<Option<Foreign>> {
        let is_same = |path: &str| Ok(self.0.get(path) == Some(&Some(Hash::of_file(&folder.join(path))?)));
        self.unlike(folder, "", &is_same)
    }

    /// The same of a folder that was not finished, whose files may be cut off.
    pub(super) fn unlisted(&self, folder: &Path) -> io::Result<Option<Foreign>> {
        self.unlike(folder, "", &|_| Ok(true))
    }

    fn unlike(
        &self,
        folder: &Path,
        within: &str,
        is_same: &dyn Fn(&str) -> io::Result<bool>,
    ) -> io::Result<Option<Foreign>> {
        for (path, kind) in entries(folder, within)? {
            let found = match self.is_listed(&path, kind) {
                false => Some(Foreign::Holds(PathBuf::from(&path))),
                true if kind.is_dir() => self.unlike(folder, &path, is_same)?,
                true if self.0.contains_key(&*path) && !is_same(&path)? => {
                    Some(Foreign::Changed(PathBuf::from(&path)))
                }
                true => None,
            };
            if found.is_some() {
                return Ok(found);
            }
        }
        Ok(None)
    }

    fn is_listed(&self, path: &str, kind: FileType) -> bool {
        if kind.is_dir() {
            let within = format!("{path}/");
            let next = self.0.range::<str, _>((Bound::Included(&*within), Bound::Unbounded)).next();
            return next.is_some_and(|(file, _)| file.starts_with(&within));
        }
        let name = path.rsplit('/').next().unwrap_or(path);
        kind.is_file() && (path == MARKER || self.0.contains_key(path) || OF_SYSTEMS.contains(&name))
    }

    /// Removes what is on the list, and the folder if nothing else is in it.
    pub(super) fn remove(&self, folder: &Path) -> io::Result<()> {
        self.remove_within(folder, "")?;
        // Up to here the folder says that it is ours.
        fs::remove_file(folder.join(MARKER))?;
        fs::remove_dir(folder)
    }

    fn remove_within(&self, folder: &Path, within: &str) -> io::Result<()> {
        for (path, kind) in entries(folder, within)? {
            let is_ours = self.is_listed(&path, kind);
            if is_ours && kind.is_dir() {
                self.remove_within(folder, &path)?;
                fs::remove_dir(folder.join(path))?;
            } else if is_ours && path != MARKER {
                fs::remove_file(folder.join(path))?;
            }
        }
        Ok(())
    }
}

/// What is directly in a folder of a folder, with its path there. Links are not followed.
fn entries(folder: &Path, within: &str) -> io::Result<Vec<(String, FileType)>> {
    let entry = |entry: io::Result<fs::DirEntry>| {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        let path = if within.is_empty() { name } else { format!("{within}/{name}") };
        Ok((path, entry.file_type()?))
    };
    let mut found = fs::read_dir(folder.join(within))?.map(entry).collect::<io::Result<Vec<_>>>()?;
    found.sort_by(|a, b| a.0.cmp(&b.0));
    Ok(found)
}
