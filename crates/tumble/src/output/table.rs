//! Files while they are written: each remembers its path, for what goes wrong, and the hash of its contents.

use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use super::manifest::hexadecimal;
use super::{Folder, OutputError, attempt};

/// A file of a folder.
pub(super) struct Sink {
    path: PathBuf,
    file: File,
    hasher: Sha256,
}

impl Sink {
    pub(super) fn create(path: &Path) -> io::Result<Self> {
        Ok(Self { path: path.to_owned(), file: File::create_new(path)?, hasher: Sha256::new() })
    }

    /// The hash of what was written.
    pub(super) fn hash(self) -> String {
        hexadecimal(self.hasher)
    }
}

impl Write for Sink {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.file.write(bytes)?;
        self.hasher.update(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// A table of a folder, as CSV.
pub(crate) struct Table<'f> {
    folder: &'f Folder,
    name: String,
    path: PathBuf,
    writer: csv::Writer<Sink>,
}

impl<'f> Table<'f> {
    /// Begins the table of that name in a folder.
    pub(crate) fn begin(folder: &'f Folder, name: &str) -> Result<Self, OutputError> {
        let sink = folder.sink(name)?;
        let path = sink.path.clone();
        Ok(Self { folder, name: name.to_owned(), path, writer: csv::Writer::from_writer(sink) })
    }

    /// Writes a row.
    pub(crate) fn row(&mut self, cells: impl IntoIterator<Item = String>) -> Result<(), OutputError> {
        attempt(&self.path, self.writer.write_record(cells).map_err(io::Error::from))
    }

    /// Ends the table.
    pub(crate) fn finish(self) -> Result<(), OutputError> {
        let sink = attempt(&self.path, self.writer.into_inner().map_err(|error| error.into_error()))?;
        self.folder.wrote(&self.name, sink);
        Ok(())
    }
}
