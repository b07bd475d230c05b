//! The MATH table: measures as they are, glyph variants and corrections for the glyphs that are kept.

use super::sfnt::{Glyphs, Reader};

/// Bytes of the constants: 4 plain numbers, 51 with a correction for devices, and a percentage.
const CONSTANTS: usize = 214;
/// Where the first number with a correction stands, and how many there are.
const FIRST_VALUE: usize = 8;
const VALUES: usize = 51;
/// Brackets, bars and roots take taller and taller glyphs, then pieces; so many sizes are plenty for formulas in a page.
const MOST_VARIANTS: usize = 6;

/// Glyphs that a table lists, in order.
fn coverage(table: &Reader<'_>) -> Option<Vec<u16>> {
    let count = usize::from(table.u16(2)?);
    if table.u16(0)? == 1 {
        return (0..count).map(|index| table.u16(4 + 2 * index)).collect();
    }
    let mut glyphs = vec![];
    for index in 0..count {
        glyphs.extend(table.u16(4 + 6 * index)?..=table.u16(6 + 6 * index)?);
    }
    Some(glyphs)
}

fn at_offset<'a>(table: &Reader<'a>, at: usize) -> Option<Reader<'a>> {
    let offset = usize::from(table.u16(at)?);
    if offset == 0 { None } else { table.from(offset) }
}

/// A glyph, and the four numbers that say how it joins others.
type Piece<'a> = (u16, &'a [u8]);

/// How one glyph grows: taller glyphs with their heights, and pieces to build it from.
struct Growth<'a> {
    variants: Vec<(u16, u16)>,
    /// Italic correction of the whole, and the pieces, each a glyph and four numbers.
    assembly: Option<(u16, Vec<Piece<'a>>)>,
}

fn growth<'a>(table: &Reader<'a>) -> Option<Growth<'a>> {
    let count = usize::from(table.u16(2)?).min(MOST_VARIANTS);
    let variant = |index: usize| Some((table.u16(4 + 4 * index)?, table.u16(6 + 4 * index)?));
    let variants: Option<Vec<_>> = (0..count).map(variant).collect();
    let assembly = match at_offset(table, 0) {
        None => None,
        Some(pieces) => {
            let count = usize::from(pieces.u16(4)?);
            let piece = |index: usize| Some((pieces.u16(6 + 10 * index)?, pieces.bytes(8 + 10 * index, 8)?));
            Some((pieces.u16(0)?, (0..count).map(piece).collect::<Option<Vec<_>>>()?))
        }
    };
    Some(Growth { variants: variants?, assembly })
}

/// Glyphs that grow upwards (or sideways) with how they do.
fn growths<'a>(math: &Reader<'a>, sideways: bool) -> Option<Vec<(u16, Growth<'a>)>> {
    let variants = at_offset(math, 8)?;
    let Some(covered) = at_offset(&variants, 2 + 2 * usize::from(sideways)) else { return Some(vec![]) };
    let glyphs = coverage(&covered)?;
    let skipped = if sideways { usize::from(variants.u16(6)?) } else { 0 };
    let all = glyphs.into_iter().enumerate();
    all.map(|(index, glyph)| Some((glyph, growth(&at_offset(&variants, 10 + 2 * (skipped + index))?)?)))
        .collect()
}

/// Adds the taller forms of the glyphs that are there. Sideways growth is left out: formulas have no wide accents.
pub(super) fn add_variants(math: &Reader<'_>, glyphs: &mut Glyphs) -> Option<()> {
    for (glyph, growth) in growths(math, false)? {
        if glyphs.new_of(glyph).is_none() {
            continue;
        }
        growth.variants.iter().for_each(|(variant, _)| glyphs.add(*variant));
        let pieces = growth.assembly.into_iter().flat_map(|(_, pieces)| pieces);
        pieces.for_each(|(piece, _)| glyphs.add(piece));
    }
    Some(())
}

/// The table for these glyphs.
pub(super) fn reduced(math: &Reader<'_>, glyphs: &Glyphs) -> Option<Vec<u8>> {
    let constants = constants(&at_offset(math, 4)?)?;
    let info = glyph_info(&at_offset(math, 6)?, glyphs)?;
    let variants = variants(math, glyphs)?;
    let info_at = 10 + constants.len();
    let header = [1, 0, 10, info_at as u16, (info_at + info.len()) as u16].map(u16::to_be_bytes).concat();
    Some([header, constants, info, variants].concat())
}

/// The measures without corrections for devices.
fn constants(table: &Reader<'_>) -> Option<Vec<u8>> {
    let mut bytes = table.bytes(0, CONSTANTS)?.to_vec();
    for value in 0..VALUES {
        bytes.get_mut(FIRST_VALUE + 4 * value + 2..)?.get_mut(..2)?.fill(0);
    }
    Some(bytes)
}

/// A list of glyphs in the order of their new numbers, with what belongs to each.
fn sorted<T>(mut items: Vec<(u16, T)>) -> (Vec<u8>, Vec<T>) {
    items.sort_by_key(|(glyph, _)| *glyph);
    let mut bytes = [1, items.len() as u16].map(u16::to_be_bytes).concat();
    items.iter().for_each(|(glyph, _)| bytes.extend(glyph.to_be_bytes()));
    (bytes, items.into_iter().map(|(_, item)| item).collect())
}

/// Numbers of glyphs: italic corrections or places of accents.
fn values(table: &Reader<'_>, glyphs: &Glyphs) -> Option<Vec<u8>> {
    let listed = coverage(&at_offset(table, 0)?)?;
    let mut kept = vec![];
    for (index, old) in listed.into_iter().enumerate() {
        if let Some(new) = glyphs.new_of(old) {
            kept.push((new, table.u16(4 + 4 * index)?));
        }
    }
    let (covered, kept) = sorted(kept);
    let mut bytes = [4 + 4 * kept.len() as u16, kept.len() as u16].map(u16::to_be_bytes).concat();
    kept.into_iter().for_each(|value| bytes.extend([value, 0].map(u16::to_be_bytes).concat()));
    bytes.extend(covered);
    Some(bytes)
}

/// Italic corrections and places of accents; kerning of corners is left out.
fn glyph_info(table: &Reader<'_>, glyphs: &Glyphs) -> Option<Vec<u8>> {
    let corrections = at_offset(table, 0).map_or(Some(vec![]), |part| values(&part, glyphs))?;
    let accents = at_offset(table, 2).map_or(Some(vec![]), |part| values(&part, glyphs))?;
    let first = if corrections.is_empty() { 0 } else { 8 };
    let second = if accents.is_empty() { 0 } else { 8 + corrections.len() as u16 };
    let header = [first, second, 0, 0].map(u16::to_be_bytes).concat();
    Some([header, corrections, accents].concat())
}

/// How the kept glyphs grow upwards.
fn variants(math: &Reader<'_>, glyphs: &Glyphs) -> Option<Vec<u8>> {
    let overlap = at_offset(math, 8)?.u16(0)?;
    let kept = growths(math, false)?.into_iter();
    let kept = kept.filter_map(|(old, growth)| Some((glyphs.new_of(old)?, growth)));
    let (covered, kept) = sorted(kept.collect());
    let coverage_at = 10 + 2 * kept.len();
    let mut header = [overlap, coverage_at as u16, 0, kept.len() as u16, 0].map(u16::to_be_bytes).concat();
    let mut body = vec![];
    for growth in kept {
        header.extend(((coverage_at + covered.len() + body.len()) as u16).to_be_bytes());
        body.extend(construction(&growth, glyphs)?);
    }
    Some([header, covered, body].concat())
}

fn construction(growth: &Growth<'_>, glyphs: &Glyphs) -> Option<Vec<u8>> {
    let length = 4 + 4 * growth.variants.len() as u16;
    let at = if growth.assembly.is_some() { length } else { 0 };
    let mut bytes = [at, growth.variants.len() as u16].map(u16::to_be_bytes).concat();
    for (variant, height) in &growth.variants {
        bytes.extend([glyphs.new_of(*variant)?, *height].map(u16::to_be_bytes).concat());
    }
    if let Some((correction, pieces)) = &growth.assembly {
        bytes.extend([*correction, 0, pieces.len() as u16].map(u16::to_be_bytes).concat());
        for (piece, numbers) in pieces {
            bytes.extend(glyphs.new_of(*piece)?.to_be_bytes());
            bytes.extend_from_slice(numbers);
        }
    }
    Some(bytes)
}
