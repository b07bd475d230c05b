//! Files while they are written: each remembers its path, for what goes wrong, and the hash of its contents.

use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};
use tumble_report::tables::{Held, TableWriter};

use super::hash::Hash;
use super::{Folder, OutputError, attempt};
use crate::pipeline::PipelineError;

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
    pub(super) fn hash(self) -> Hash {
        Hash::finish(self.hasher)
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

/// Bytes of a table that are written at once.
const BLOCK: usize = 1 << 16;

/// A table of a folder, as CSV (RFC 4180, with rows that end in a line feed).
pub(crate) struct TableFile<'f> {
    folder: &'f Folder,
    name: String,
    sink: Sink,
    /// What is not written yet.
    rows: Held,
}

impl<'f> TableFile<'f> {
    /// Begins the table of that name in a folder.
    pub(crate) fn begin(folder: &'f Folder, name: &str) -> Result<Self, OutputError> {
        Ok(Self { folder, name: name.to_owned(), sink: folder.sink(name)?, rows: Held::default() })
    }

    fn write(&mut self) -> Result<(), OutputError> {
        let written = self.sink.write_all(self.rows.text.as_bytes());
        attempt(&self.sink.path, written)?;
        self.rows.text.clear();
        Ok(())
    }

    /// Ends the table.
    pub(crate) fn finish(mut self) -> Result<(), OutputError> {
        self.write()?;
        self.folder.wrote(&self.name, self.sink);
        Ok(())
    }
}

impl TableWriter for TableFile<'_> {
    type Error = PipelineError;

    fn text(&mut self, cell: &str) {
        self.rows.text(cell);
    }

    fn numbers(&mut self, values: &[f64]) {
        self.rows.numbers(values);
    }

    fn end_row(&mut self) -> Result<(), PipelineError> {
        self.rows.end_row()?;
        if self.rows.text.len() >= BLOCK {
            self.write()?;
        }
        Ok(())
    }
}
