//! What a page that plays needs beside the report: the engine, and what it runs.

/// The engine, and the scene that it runs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lab {
    /// The engine, packed by LZMA.
    pub engine: &'static [u8],
    /// What messages call the scene.
    pub name: String,
    /// The scene.
    pub scene: String,
    /// Files that it reads, by their names there.
    pub files: Vec<(String, Vec<u8>)>,
    /// What the command line has set.
    pub set: Vec<(String, String)>,
    /// What may be changed, as [`live::play`](super::live::play) tells the page.
    pub play: String,
    /// Scenes to begin with, each with what it is.
    pub templates: Vec<(&'static str, &'static str)>,
}
