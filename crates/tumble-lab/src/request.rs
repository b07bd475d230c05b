//! What is asked of the engine, as bytes: a list of texts, each behind its length.

use std::collections::BTreeMap;
use std::io;

use tumble_scene::{Files, Override};

/// A scene that is to be run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Request {
    /// What messages call the scene.
    pub name: String,
    /// The scene.
    pub scene: String,
    /// Values in the place of those of the scene.
    pub set: Vec<Override>,
    /// Files that the scene reads, by their names there.
    pub files: BTreeMap<String, Vec<u8>>,
    /// Which run is looked at, counted from 0: its motion comes first.
    pub shown: usize,
    /// Whether the tables that the command writes are wanted, and not the report.
    pub tables: bool,
}

impl Request {
    /// The request that the bytes hold: each text behind its length (four bytes, the lowest first): the name and the scene, then
    /// `set`, a name and a formula, `file`, a name and its content, `shown` and a number, or `tables` and an empty text, for each
    /// of them. `None` if that is not what they are.
    pub fn of(bytes: &[u8]) -> Option<Self> {
        let mut parts = Parts(bytes);
        let mut request = Self { name: parts.text()?, scene: parts.text()?, ..Self::default() };
        while let Some(kind) = parts.next() {
            let name = parts.text()?;
            match kind {
                b"set" => request.set.push(Override { name, text: parts.text()? }),
                b"shown" => request.shown = name.parse().ok()?,
                b"tables" => request.tables = true,
                b"file" => _ = request.files.insert(name, parts.next()?.to_vec()),
                _ => return None,
            }
        }
        parts.0.is_empty().then_some(request)
    }

    /// The bytes that hold it.
    pub fn bytes(&self) -> Vec<u8> {
        let number = self.shown.to_string();
        let set = self.set.iter().flat_map(|set| ["set", &set.name, &set.text].map(str::as_bytes));
        let files = self.files.iter().flat_map(|(name, content)| [b"file", name.as_bytes(), content]);
        let shown = ["shown", &number].map(str::as_bytes);
        let tables = self.tables.then_some(["tables", ""].map(str::as_bytes));
        let texts = [self.name.as_bytes(), self.scene.as_bytes()];
        let parts =
            texts.into_iter().chain(set).chain(files).chain(shown).chain(tables.into_iter().flatten());
        parts
            .flat_map(|part| (part.len() as u32).to_le_bytes().into_iter().chain(part.iter().copied()))
            .collect()
    }
}

/// What was not read yet.
struct Parts<'b>(&'b [u8]);

impl<'b> Parts<'b> {
    fn next(&mut self) -> Option<&'b [u8]> {
        let (length, rest) = self.0.split_first_chunk()?;
        let (part, rest) = rest.split_at_checked(u32::from_le_bytes(*length) as usize)?;
        self.0 = rest;
        Some(part)
    }

    fn text(&mut self) -> Option<String> {
        String::from_utf8(self.next()?.to_vec()).ok()
    }
}

impl Files for Request {
    fn read(&self, relative: &str) -> io::Result<Vec<u8>> {
        let missing = || io::Error::new(io::ErrorKind::NotFound, "the page does not have it");
        self.files.get(relative).cloned().ok_or_else(missing)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn requests_come_back_from_their_bytes() {
        let set = vec![Override { name: "T".into(), text: "2 s".into() }];
        let files = BTreeMap::from([("gust.csv".to_owned(), vec![0, 255])]);
        let request =
            Request { name: "a".into(), scene: "version = 1\n".into(), set, files, shown: 3, tables: true };
        assert_eq!(Request::of(&request.bytes()), Some(request));
    }

    #[test]
    fn other_bytes_are_no_request() {
        let bytes = Request { name: "a".into(), scene: "b".into(), ..Request::default() }.bytes();
        // What is looked at may be left out.
        let whole = bytes.len() - 2 * 4 - "shown0".len();
        for short in (0..bytes.len()).filter(|short| *short != whole) {
            assert_eq!(Request::of(&bytes[..short]), None);
        }
        assert_eq!(Request::of(&[bytes, vec![1, 0, 0, 0]].concat()), None);
        assert_eq!(Request::of(&[255; 12]), None);
    }
}
