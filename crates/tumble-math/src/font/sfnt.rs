//! OpenType files: their tables, and one with fewer glyphs.

use std::collections::BTreeMap;

use super::{cff, math_table};

/// A big-endian file or table, read at any place.
#[derive(Clone, Copy)]
pub(super) struct Reader<'a> {
    data: &'a [u8],
}

impl<'a> Reader<'a> {
    pub(super) fn new(data: &'a [u8]) -> Self {
        Self { data }
    }

    pub(super) fn bytes(&self, at: usize, length: usize) -> Option<&'a [u8]> {
        self.data.get(at..at.checked_add(length)?)
    }

    /// What comes from a place on.
    pub(super) fn from(&self, at: usize) -> Option<Self> {
        self.data.get(at..).map(Self::new)
    }

    pub(super) fn unsigned(&self, at: usize, length: usize) -> Option<usize> {
        Some(self.bytes(at, length)?.iter().fold(0, |value, byte| value << 8 | usize::from(*byte)))
    }

    pub(super) fn u16(&self, at: usize) -> Option<u16> {
        self.bytes(at, 2).map(|bytes| u16::from_be_bytes([bytes[0], bytes[1]]))
    }

    fn u32(&self, at: usize) -> Option<usize> {
        self.unsigned(at, 4)
    }

    /// A table of the file.
    pub(super) fn table(&self, tag: &[u8; 4]) -> Option<&'a [u8]> {
        let count = usize::from(self.u16(4)?);
        let record = (0..count).map(|index| 12 + 16 * index).find(|at| self.bytes(*at, 4) == Some(tag))?;
        self.bytes(self.u32(record + 8)?, self.u32(record + 12)?)
    }

    /// The glyphs of characters, from a segmented map of all of Unicode.
    pub(super) fn characters(&self) -> Option<BTreeMap<char, u16>> {
        let cmap = Self::new(self.table(b"cmap")?);
        let count = usize::from(cmap.u16(2)?);
        let tables = (0..count).filter_map(|index| cmap.from(cmap.u32(8 + 8 * index)?));
        let groups = tables.into_iter().find(|table| table.u16(0) == Some(12))?;
        let mut map = BTreeMap::new();
        for index in 0..groups.u32(12)? {
            let at = 16 + 12 * index;
            let (first, last, glyph) = (groups.u32(at)?, groups.u32(at + 4)?, groups.u32(at + 8)?);
            for code in first..=last.min(first + usize::from(u16::MAX)) {
                let character = char::from_u32(u32::try_from(code).ok()?);
                map.insert(character?, u16::try_from(glyph + code - first).ok()?);
            }
        }
        Some(map)
    }
}

/// Which old glyph each new one is; the first is the one for what is missing.
pub(super) struct Glyphs {
    pub(super) old: Vec<u16>,
    new: BTreeMap<u16, u16>,
}

impl Glyphs {
    fn new(first: impl Iterator<Item = u16>) -> Self {
        let mut glyphs = Self { old: vec![], new: BTreeMap::new() };
        std::iter::once(0).chain(first).for_each(|glyph| glyphs.add(glyph));
        glyphs
    }

    pub(super) fn add(&mut self, glyph: u16) {
        if let Ok(place) = u16::try_from(self.old.len())
            && !self.new.contains_key(&glyph)
        {
            self.new.insert(glyph, place);
            self.old.push(glyph);
        }
    }

    pub(super) fn new_of(&self, old: u16) -> Option<u16> {
        self.new.get(&old).copied()
    }
}

/// The font of these characters and of the taller forms of their glyphs; `None` where the source is not as expected.
pub(super) fn reduced(source: &[u8], family: &str, characters: &[char]) -> Option<Vec<u8>> {
    let reader = Reader::new(source);
    let map = reader.characters()?;
    let wanted: Vec<(char, u16)> = characters.iter().filter_map(|c| Some((*c, *map.get(c)?))).collect();
    let mut glyphs = Glyphs::new(wanted.iter().map(|(_, glyph)| *glyph));
    let math = Reader::new(reader.table(b"MATH")?);
    math_table::add_variants(&math, &mut glyphs)?;
    let widths = widths(&reader, &glyphs)?;
    let count = u16::try_from(glyphs.old.len()).ok()?;
    let tables = [
        (b"CFF ", cff::reduced(reader.table(b"CFF ")?, &glyphs)?),
        (b"MATH", math_table::reduced(&math, &glyphs)?),
        (b"OS/2", reader.table(b"OS/2")?.to_vec()),
        (b"cmap", character_map(&wanted, &glyphs)),
        (b"head", patched(reader.table(b"head")?, 8, &[0; 4])?),
        (b"hhea", patched(reader.table(b"hhea")?, 34, &count.to_be_bytes())?),
        (b"hmtx", widths),
        (b"maxp", patched(reader.table(b"maxp")?, 4, &count.to_be_bytes())?),
        (b"name", names(family)),
        (b"post", [&[0, 3, 0, 0][..], &[0; 28]].concat()),
    ];
    Some(file(&tables))
}

fn patched(table: &[u8], at: usize, bytes: &[u8]) -> Option<Vec<u8>> {
    let mut table = table.to_vec();
    table.get_mut(at..at + bytes.len())?.copy_from_slice(bytes);
    Some(table)
}

fn widths(reader: &Reader<'_>, glyphs: &Glyphs) -> Option<Vec<u8>> {
    let long = usize::from(Reader::new(reader.table(b"hhea")?).u16(34)?);
    let hmtx = Reader::new(reader.table(b"hmtx")?);
    let mut widths = vec![];
    for glyph in glyphs.old.iter().map(|glyph| usize::from(*glyph)) {
        let width = hmtx.bytes(4 * glyph.min(long.checked_sub(1)?), 2)?;
        let bearing = if glyph < long { 4 * glyph + 2 } else { 4 * long + 2 * (glyph - long) };
        widths.extend_from_slice(width);
        widths.extend_from_slice(hmtx.bytes(bearing, 2)?);
    }
    Some(widths)
}

/// A segmented map with one segment a character.
fn character_map(wanted: &[(char, u16)], glyphs: &Glyphs) -> Vec<u8> {
    let groups: Vec<(u32, u16)> =
        wanted.iter().filter_map(|(c, old)| Some((u32::from(*c), glyphs.new_of(*old)?))).collect();
    let count = u32::try_from(groups.len()).unwrap_or(0);
    // Version, one table, for Windows and all of Unicode, 12 bytes on: format 12.
    let mut cmap = [0u16, 1, 3, 10, 0, 12, 12, 0].map(u16::to_be_bytes).concat();
    for number in [16 + 12 * count, 0, count] {
        cmap.extend(number.to_be_bytes());
    }
    for (code, glyph) in groups {
        for number in [code, code, u32::from(glyph)] {
            cmap.extend(number.to_be_bytes());
        }
    }
    cmap
}

/// Where the glyphs come from and under which terms, in the font itself.
const LICENCE: &str = "Part of New Computer Modern Math, (C) 2019-2026 Antonis Tsolomitis, reduced and renamed. \
    GUST Font License, http://tug.org/fonts/licenses/GUST-FONT-LICENSE.txt";

fn names(family: &str) -> Vec<u8> {
    let postscript = family.replace(' ', "");
    let entries = [
        (0u16, LICENCE),
        (1, family),
        (2, "Regular"),
        (3, family),
        (4, family),
        (5, "Version 1.0"),
        (6, &postscript),
    ];
    let mut records = vec![];
    let mut text: Vec<u8> = vec![];
    for (id, words) in entries {
        let encoded: Vec<u8> = words.encode_utf16().flat_map(u16::to_be_bytes).collect();
        let (length, start) = (encoded.len() as u16, text.len() as u16);
        // Windows, Unicode, English.
        for number in [3, 1, 0x409, id, length, start] {
            records.extend(number.to_be_bytes());
        }
        text.extend(encoded);
    }
    let count = entries.len() as u16;
    let header = [0, count, 6 + 12 * count].map(u16::to_be_bytes).concat();
    [header, records, text].concat()
}

/// A file of these tables, which must be in the order of their tags.
fn file(tables: &[(&[u8; 4], Vec<u8>)]) -> Vec<u8> {
    let count = tables.len() as u16;
    let power = count.ilog2() as u16;
    let range = 16 << power;
    let mut header = b"OTTO".to_vec();
    for number in [count, range, power, 16 * count - range] {
        header.extend(number.to_be_bytes());
    }
    let mut at = 12 + 16 * tables.len();
    let mut body = vec![];
    for (tag, table) in tables {
        header.extend_from_slice(*tag);
        for number in [checksum(table), at as u32, table.len() as u32] {
            header.extend(number.to_be_bytes());
        }
        body.extend_from_slice(table);
        body.resize(body.len().next_multiple_of(4), 0);
        at = 12 + 16 * tables.len() + body.len();
    }
    [header, body].concat()
}

fn checksum(table: &[u8]) -> u32 {
    let word = |chunk: &[u8]| {
        chunk.iter().chain(&[0; 3]).take(4).fold(0u32, |word, byte| word << 8 | u32::from(*byte))
    };
    table.chunks(4).map(word).fold(0, u32::wrapping_add)
}
