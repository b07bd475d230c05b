//! The files that a scene names: measured tables beside it, and nothing elsewhere.

use std::collections::BTreeMap;
use std::io;
use std::path::{Component, Path, PathBuf};

use toml::de::DeTable;

/// A table's file may have this many bytes.
pub const MAX_FILE_BYTES: usize = 64 << 20;

/// Where a scene's measured tables come from.
pub trait Files {
    /// Contents of the file of that name, which never leads out of the scene's folder.
    fn read(&self, relative: &str) -> io::Result<Vec<u8>>;
}

/// For scenes that have no files.
#[derive(Clone, Copy, Debug)]
pub struct NoFiles;

impl Files for NoFiles {
    fn read(&self, _: &str) -> io::Result<Vec<u8>> {
        Err(io::Error::new(io::ErrorKind::Unsupported, "this scene was read without a folder"))
    }
}

/// The folder that a scene stands in.
#[derive(Clone, Debug)]
pub struct Folder(pub PathBuf);

impl Folder {
    /// The folder of a scene's file.
    pub fn of(scene: &Path) -> Self {
        let folder = scene.parent().filter(|parent| !parent.as_os_str().is_empty());
        Self(folder.unwrap_or(Path::new(".")).to_owned())
    }
}

impl Files for Folder {
    fn read(&self, relative: &str) -> io::Result<Vec<u8>> {
        let refuse = |why: &str| Err(io::Error::new(io::ErrorKind::InvalidInput, why));
        if !is_inside(relative) {
            return refuse("it leads out of the scene's folder");
        }
        let (folder, file) = (self.0.canonicalize()?, self.0.join(relative).canonicalize()?);
        if !file.starts_with(&folder) {
            return refuse("it leads out of the scene's folder");
        }
        let about = file.metadata()?;
        if !about.is_file() {
            return refuse("it is no file");
        }
        if about.len() > MAX_FILE_BYTES as u64 {
            return refuse(&format!("it has {} bytes, more than {MAX_FILE_BYTES}", about.len()));
        }
        std::fs::read(file)
    }
}

/// Whether a name stays in its folder, on every system.
pub(crate) fn is_inside(relative: &str) -> bool {
    let plain = Path::new(relative).components().all(|part| matches!(part, Component::Normal(_)));
    plain && !relative.is_empty() && !relative.contains(['\\', ':', '\0'])
}

/// Every file that the document's tables name and may have.
pub(crate) fn of_tables(document: &DeTable, files: &dyn Files) -> BTreeMap<String, io::Result<Vec<u8>>> {
    let tables = document.get("table").and_then(|tables| tables.get_ref().as_table());
    let named = tables.into_iter().flat_map(|tables| tables.values());
    let names = named.filter_map(|table| table.get_ref().as_table()?.get("file")?.get_ref().as_str());
    names.filter(|name| is_inside(name)).map(|name| (name.to_owned(), files.read(name))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stay_in_the_folder() {
        for name in ["gust.csv", "data/gust.csv", "a..b.csv"] {
            assert!(is_inside(name), "{name}");
        }
        let out =
            ["", "/etc/passwd", "../gust.csv", "a/../../b", "..", "./..", "C:/a.csv", "a\\b.csv", "a\0b"];
        for name in out {
            assert!(!is_inside(name), "{name}");
        }
    }

    #[test]
    fn a_folder_reads_its_files_only() {
        let folder = Folder::of(&Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.toml"));
        assert!(folder.read("src/files.rs").is_ok());
        for name in ["../tumble/Cargo.toml", "src", "none.csv"] {
            assert!(folder.read(name).is_err(), "{name}");
        }
        assert_eq!(Folder::of(Path::new("scene.toml")).0, Path::new("."));
    }
}
