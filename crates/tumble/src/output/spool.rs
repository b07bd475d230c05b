//! Texts that are more than memory should hold: once they are long, in a file without a name, which ends with its process.

use std::io::{self, BufRead, BufReader, Seek, Write};
use std::path::Path;

use tempfile::SpooledTempFile;

/// Bytes that are held in memory.
const SHORT: usize = 1 << 16;
/// Ends a text, and stands in none.
const END: u8 = 0;

/// Texts, one after the other.
#[derive(Debug)]
pub struct Spool(SpooledTempFile);

impl Spool {
    /// Without a text. What becomes long goes to the disk of this folder, which has to be there by then.
    pub fn beside(folder: &Path) -> Self {
        Self(tempfile::spooled_tempfile_in(SHORT, folder))
    }

    /// Adds a text.
    pub fn add(&mut self, text: &str) -> io::Result<()> {
        self.0.write_all(&[text.as_bytes(), &[END]].concat())
    }

    /// The texts, in order. More can be added when all were read.
    pub fn texts(&mut self) -> io::Result<impl Iterator<Item = io::Result<String>>> {
        self.0.rewind()?;
        let texts = BufReader::new(&mut self.0).split(END);
        Ok(texts.map(|text| String::from_utf8(text?).map_err(io::Error::other)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_come_back_in_order_from_memory_and_from_the_disk() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        for count in [0, 1, 100] {
            let mut spool = Spool::beside(folder.path());
            let texts: Vec<String> = (0..count).map(|index| format!("{index}\n").repeat(1000)).collect();
            texts.iter().for_each(|text| spool.add(text).expect("a disk"));
            let read: io::Result<Vec<String>> = spool.texts().expect("a disk").collect();
            assert_eq!(read.expect("texts"), texts);
        }
        assert_eq!(std::fs::read_dir(folder.path()).expect("a folder").count(), 0, "none has a name");
    }
}
