//! Files while they are written: each remembers its path, for what goes wrong, and the hash of its contents.

use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use super::decimal::Decimal;
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
    decimal: Decimal,
}

impl<'f> Table<'f> {
    /// Begins the table of that name in a folder.
    pub(crate) fn begin(folder: &'f Folder, name: &str) -> Result<Self, OutputError> {
        let sink = folder.sink(name)?;
        let path = sink.path.clone();
        let writer = csv::Writer::from_writer(sink);
        Ok(Self { folder, name: name.to_owned(), path, writer, decimal: Decimal::default() })
    }

    /// Writes a row.
    pub(crate) fn row(&mut self, cells: impl IntoIterator<Item = String>) -> Result<(), OutputError> {
        attempt(&self.path, self.writer.write_record(cells).map_err(io::Error::from))
    }

    /// Writes a cell of the row that is being written.
    pub(crate) fn text(&mut self, cell: &str) -> Result<(), OutputError> {
        attempt(&self.path, self.writer.write_field(cell).map_err(io::Error::from))
    }

    /// Writes cells of the row that is being written: the shortest decimals that read back as the same numbers.
    pub(crate) fn numbers(&mut self, values: &[f64]) -> Result<(), OutputError> {
        for value in values {
            let written = self.writer.write_field(self.decimal.of(*value));
            attempt(&self.path, written.map_err(io::Error::from))?;
        }
        Ok(())
    }

    /// Ends the row that is being written.
    pub(crate) fn end_row(&mut self) -> Result<(), OutputError> {
        let nothing: [&[u8]; 0] = [];
        attempt(&self.path, self.writer.write_record(nothing).map_err(io::Error::from))
    }

    /// Ends the table.
    pub(crate) fn finish(self) -> Result<(), OutputError> {
        let sink = attempt(&self.path, self.writer.into_inner().map_err(|error| error.into_error()))?;
        self.folder.wrote(&self.name, sink);
        Ok(())
    }
}
