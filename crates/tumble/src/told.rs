//! What runs came to, in lines for people.

use std::io;
use std::path::Path;

use tumble::Finished;
use tumble::output::Spool;
use tumble_scene::{printable, printable_lines};

use crate::tools::say::say;

/// What is to be said of runs once their results are in place. There may be more than memory should hold.
pub(crate) struct Told(Spool);

impl Told {
    /// Of no run; what becomes long goes to the disk of this folder.
    pub(crate) fn beside(folder: &Path) -> Self {
        Self(Spool::beside(folder))
    }

    /// Adds a run.
    pub(crate) fn add(&mut self, run: &Finished) -> io::Result<()> {
        self.0.add(&printable_lines(&run.told()))
    }

    /// Says it all.
    pub(crate) fn say(&mut self) -> io::Result<()> {
        for text in self.0.texts()? {
            say!("{}", text?);
        }
        Ok(())
    }
}

/// A path as a terminal may have it.
pub(crate) fn shown(path: &Path) -> String {
    printable(&path.to_string_lossy()).into_owned()
}
