//! The outlines: a CFF table with fewer glyphs.

use super::sfnt::{Glyphs, Reader};
use super::subroutines;

/// Operators of a font's dictionary that hold places in the table: they are written anew.
const CHARSET: u16 = 15;
const ENCODING: u16 = 16;
const CHAR_STRINGS: u16 = 17;
const PRIVATE: u16 = 18;
/// Operators that name a string; strings are left out.
const STRINGS: [u16; 7] = [0, 1, 2, 3, 4, 0xc00, 0xc15];
/// The last of the names that every reader knows without a list of strings.
const LAST_STANDARD_NAME: usize = 390;
/// The operator of a private dictionary for subroutines.
const SUBROUTINES: u16 = 19;

/// An operator of a dictionary with its operands as they were written, and as integers.
struct Entry<'a> {
    operator: u16,
    bytes: &'a [u8],
    operands: Vec<usize>,
}

/// What only outlines use: a dictionary and, right behind it, subroutines.
struct Private<'a> {
    dictionary: &'a [u8],
    subroutines: Vec<u8>,
}

/// A list of byte strings, and where it ends.
fn index<'a>(table: &Reader<'a>, at: usize) -> Option<(Vec<&'a [u8]>, usize)> {
    let count = usize::from(table.u16(at)?);
    if count == 0 {
        return Some((vec![], at + 2));
    }
    let size = table.unsigned(at + 2, 1)?;
    let offset = |item: usize| table.unsigned(at + 3 + size * item, size);
    let base = at + 2 + size * (count + 1);
    let item = |item: usize| {
        let (from, to) = (offset(item)?, offset(item + 1)?);
        table.bytes(base + from, to.checked_sub(from)?)
    };
    let items: Option<Vec<&[u8]>> = (0..count).map(item).collect();
    Some((items?, base + offset(count)?))
}

fn write_index(items: &[&[u8]]) -> Vec<u8> {
    let mut bytes = (items.len() as u16).to_be_bytes().to_vec();
    if items.is_empty() {
        return bytes;
    }
    let total: usize = items.iter().map(|item| item.len()).sum();
    let size: usize = if total < usize::from(u16::MAX) { 2 } else { 4 };
    bytes.push(size as u8);
    let mut offset = 1u32;
    bytes.extend_from_slice(&offset.to_be_bytes()[4 - size..]);
    for item in items {
        offset += item.len() as u32;
        bytes.extend_from_slice(&offset.to_be_bytes()[4 - size..]);
    }
    items.iter().for_each(|item| bytes.extend_from_slice(item));
    bytes
}

/// The entries of a dictionary. Only integers that count places are understood; other operands are passed over.
fn dictionary(bytes: &[u8]) -> Option<Vec<Entry<'_>>> {
    let (mut entries, mut operands) = (vec![], vec![]);
    let (mut at, mut start) = (0, 0);
    while let Some(first) = bytes.get(at).copied() {
        let reader = Reader::new(bytes);
        let (value, length) = match first {
            0..=21 => {
                let wide = first == 12;
                let operator =
                    if wide { 0xc00 | reader.unsigned(at + 1, 1)? as u16 } else { u16::from(first) };
                at += 1 + usize::from(wide);
                entries.push(Entry {
                    operator,
                    bytes: &bytes[start..at],
                    operands: std::mem::take(&mut operands),
                });
                start = at;
                continue;
            }
            28 => (reader.unsigned(at + 1, 2)?, 3),
            29 => (reader.unsigned(at + 1, 4)?, 5),
            // A decimal ends with a half byte of ones.
            30 => (0, 2 + bytes[at + 1..].iter().position(|byte| byte & 15 == 15 || byte >> 4 == 15)?),
            32..=246 => (usize::from(first).saturating_sub(139), 1),
            247..=250 => (usize::from(first - 247) * 256 + reader.unsigned(at + 1, 1)? + 108, 2),
            251..=254 => (0, 2),
            _ => return None,
        };
        operands.push(value);
        at += length;
    }
    Some(entries)
}

/// An integer operand of fixed length.
fn operand(value: usize) -> Vec<u8> {
    [&[29][..], &(value as u32).to_be_bytes()].concat()
}

/// The table with these glyphs; `None` for fonts with global subroutines or with keyed glyphs, which this does not read.
pub(super) fn reduced(table: &[u8], glyphs: &Glyphs) -> Option<Vec<u8>> {
    let reader = Reader::new(table);
    let (names, at) = index(&reader, reader.unsigned(2, 1)?)?;
    let (dictionaries, at) = index(&reader, at)?;
    let (_, at) = index(&reader, at)?;
    let (global, _) = index(&reader, at)?;
    let top = dictionary(dictionaries.first()?)?;
    let operands =
        |wanted: u16| top.iter().find(|entry| entry.operator == wanted).map(|entry| &entry.operands);
    let (outlines, _) = index(&reader, *operands(CHAR_STRINGS)?.first()?)?;
    let [size, place] = operands(PRIVATE)?[..] else { return None };
    let private = reader.bytes(place, size)?;
    if !global.is_empty() || glyphs.old.len() > LAST_STANDARD_NAME {
        return None;
    }
    let kept: Option<Vec<&[u8]>> =
        glyphs.old.iter().map(|old| outlines.get(usize::from(*old)).copied()).collect();
    let kept = kept?;
    let subroutines = match dictionary(private)?.iter().find(|entry| entry.operator == SUBROUTINES) {
        None => vec![],
        // Only where they follow at once, so that the place in the dictionary stays true.
        Some(entry) if entry.operands == [size] => {
            write_index(&subroutines::kept(&index(&reader, place + size)?.0, &kept)?)
        }
        Some(_) => return None,
    };
    let private = Private { dictionary: private, subroutines };
    let moved = [CHARSET, ENCODING, CHAR_STRINGS, PRIVATE];
    let kept_entries =
        top.iter().filter(|entry| !moved.contains(&entry.operator) && !STRINGS.contains(&entry.operator));
    let fixed: Vec<u8> = kept_entries.flat_map(|entry| entry.bytes.iter().copied()).collect();
    let name = vec![b'X'; names.first()?.len()];
    Some(assembled(&name, &fixed, &private, &write_index(&kept), glyphs.old.len()))
}

/// The parts one after another, with a dictionary that says where they are.
fn assembled(name: &[u8], fixed: &[u8], private: &Private<'_>, outlines: &[u8], count: usize) -> Vec<u8> {
    // Glyph names in the standard order, whatever they mean: nobody looks at them.
    let charset = [&[2, 0, 1][..], &(count.saturating_sub(2) as u16).to_be_bytes()].concat();
    let header = [&[1, 0, 4, 4][..], &write_index(&[name])].concat();
    let top = |charset_at: usize, outlines_at: usize, private_at: usize| {
        let parts = [
            fixed.to_vec(),
            operand(charset_at),
            vec![CHARSET as u8],
            operand(outlines_at),
            vec![CHAR_STRINGS as u8],
            operand(private.dictionary.len()),
            operand(private_at),
            vec![PRIVATE as u8],
        ];
        write_index(&[&parts.concat()])
    };
    // All operands have fixed lengths, so the places do not move.
    let charset_at = header.len() + top(0, 0, 0).len() + 4;
    let outlines_at = charset_at + charset.len();
    let private_at = outlines_at + outlines.len();
    // No strings and no global subroutines: two empty lists.
    let no_strings = [0; 4];
    let top = top(charset_at, outlines_at, private_at);
    [&header, &top[..], &no_strings[..], &charset, outlines, private.dictionary, &private.subroutines]
        .concat()
}
