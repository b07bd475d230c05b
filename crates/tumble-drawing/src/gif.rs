//! Motions as animated GIF files, by the embedded fonts and our own rasteriser.

use std::collections::BTreeMap;
use std::fmt::Display;

use ::gif::{AnyExtension, DisposalMethod, Encoder, Extension, Frame, Repeat};
use color_quant::NeuQuant;
use resvg::tiny_skia::Pixmap;

use crate::animation::{Animation, MovingCase};
use crate::png::{PngError, drawn};

mod frame;

/// Of a pixel.
const BYTES: usize = 4;
/// Longest animation in frames: a minute at 30 a second.
const MOST_FRAMES: usize = 1800;
/// Frames a second that viewers show as asked; GIF counts hundredths of a second.
const RATES: std::ops::RangeInclusive<f64> = 1.0..=50.0;
/// Frames that the colours are chosen from.
const SAMPLED: usize = 12;
/// Colours that a GIF can hold.
const COLOURS: usize = 256;
/// Every pixel that is given counts when colours are chosen.
const EVERY: i32 = 1;
/// How long the last frame stays before the motion starts again, in hundredths of a second.
const LAST_DELAY: u16 = 150;
/// How long a motion takes if nobody says otherwise, in seconds.
const GOOD_LENGTH: f64 = 7.0;
/// Widths in pixels that make sense.
const WIDTHS: std::ops::RangeInclusive<u32> = 64..=4096;

/// The comment in each of our files, which says whose it is. The zeros are for whoever writes the file: a hash in their
/// place tells whether it was changed.
pub const ANIMATION_SEAL: &str =
    "tumble animation 0000000000000000000000000000000000000000000000000000000000000000";

/// Why an animation could not be made.
#[derive(Debug, thiserror::Error)]
pub enum GifError {
    /// There is no case of this number, or nothing that can be drawn moves in it.
    #[error("case {case} of {cases} has no motion")]
    NoMotion {
        /// The case, counted from 0.
        case: usize,
        /// How many cases there are.
        cases: usize,
    },
    /// The width is out of bounds.
    #[error("a width of {0} pixels is not between 64 and 4096")]
    Width(u32),
    /// The rate is out of bounds.
    #[error("a rate of {0} frames a second is not between 1 and 50")]
    Rate(f64),
    /// The motion takes too long at this speed and rate.
    #[error("the motion would take {frames} frames, more than {most}: play it faster or with fewer frames")]
    TooLong {
        /// Frames that it would take.
        frames: f64,
        /// The greatest number of frames.
        most: usize,
    },
    /// A frame could not be drawn.
    #[error(transparent)]
    Frame(#[from] PngError),
    /// The file could not be encoded.
    #[error("the animation cannot be encoded: {0}")]
    Encoding(String),
}

fn encoding(error: impl Display) -> GifError {
    GifError::Encoding(error.to_string())
}

/// The bytes of an animated GIF of one case (counted from 0), `width` pixels
/// wide, with `rate` frames a second, at the animation's own speed.
pub fn animation_gif(animation: &Animation, case: usize, width: u32, rate: f64) -> Result<Vec<u8>, GifError> {
    if !WIDTHS.contains(&width) {
        return Err(GifError::Width(width));
    }
    if !RATES.contains(&rate) {
        return Err(GifError::Rate(rate));
    }
    let none = GifError::NoMotion { case, cases: animation.cases.len() };
    let Some(scene) = animation.cases.get(case).and_then(frame::Scene::new) else { return Err(none) };
    let times = times(&animation.cases[case], animation.speed, rate)?;
    let picture = |t: &f64| drawn(&scene.svg(*t, f64::from(width)), 1.0);
    let every = times.len().div_ceil(SAMPLED);
    let mut counts = BTreeMap::new();
    for t in times.iter().step_by(every) {
        count(picture(t)?.data(), &mut counts);
    }
    encode(&times, picture, &NeuQuant::new(EVERY, COLOURS, &weighed(&counts)), rate)
}

/// Counts the pixels of each colour; neighbours are often alike.
fn count(pixels: &[u8], counts: &mut BTreeMap<[u8; BYTES], usize>) {
    let (pixels, _) = pixels.as_chunks::<BYTES>();
    for alike in pixels.chunk_by(|one, next| one == next) {
        *counts.entry(alike[0]).or_default() += alike.len();
    }
}

/// The pixels that the palette is chosen from: of each colour the root of as many as there are. The white of a page alone would take all the time,
/// and lines are thin.
fn weighed(counts: &BTreeMap<[u8; BYTES], usize>) -> Vec<u8> {
    counts.iter().flat_map(|(colour, count)| colour.repeat(count.isqrt())).collect()
}

/// Instants of the frames: the last one is the end of the motion.
fn times(motion: &MovingCase, speed: f64, rate: f64) -> Result<Vec<f64>, GifError> {
    let [from, to] = motion.span();
    let length = if speed > 0.0 { (to - from) / speed } else { GOOD_LENGTH };
    let frames = (length * rate).round().max(1.0);
    if frames.is_nan() || frames > MOST_FRAMES as f64 {
        return Err(GifError::TooLong { frames, most: MOST_FRAMES });
    }
    let count = frames as usize;
    Ok((0..=count).map(|i| from + (to - from) * i as f64 / count as f64).collect())
}

fn encode(
    times: &[f64],
    picture: impl Fn(&f64) -> Result<Pixmap, PngError>,
    colours: &NeuQuant,
    rate: f64,
) -> Result<Vec<u8>, GifError> {
    let first = picture(&times[0])?;
    let [width, height] = [first.width() as u16, first.height() as u16];
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width, height, &colours.color_map_rgb()).map_err(encoding)?;
    let comment = AnyExtension(Extension::Comment as u8);
    encoder.write_raw_extension(comment, &[ANIMATION_SEAL.as_bytes()]).map_err(encoding)?;
    encoder.set_repeat(Repeat::Infinite).map_err(encoding)?;
    let mut before: Option<Vec<u8>> = None;
    for (i, t) in times.iter().enumerate() {
        let now = indices(colours, picture(t)?.data());
        let mut frame = changed(before.as_deref(), &now, [width, height]);
        frame.delay = delay(i, times.len(), rate);
        encoder.write_frame(&frame).map_err(encoding)?;
        before = Some(now);
    }
    drop(encoder);
    Ok(bytes)
}

/// The colours of pixels (four bytes each) by their numbers; neighbours are often alike.
fn indices(colours: &NeuQuant, pixels: &[u8]) -> Vec<u8> {
    let mut known: (&[u8], u8) = (&[], 0);
    let index = |pixel| {
        if known.0 != pixel {
            known = (pixel, colours.index_of(pixel) as u8);
        }
        known.1
    };
    pixels.chunks_exact(4).map(index).collect()
}

/// Hundredths of a second until the next frame; rounding does not add up.
fn delay(i: usize, frames: usize, rate: f64) -> u16 {
    let at = |i: usize| (100.0 * i as f64 / rate).round();
    if i + 1 == frames { LAST_DELAY } else { (at(i + 1) - at(i)) as u16 }
}

/// The rectangle that differs from the frame before.
fn changed(before: Option<&[u8]>, now: &[u8], [width, height]: [u16; 2]) -> Frame<'static> {
    let w = usize::from(width);
    let differs = |i: &usize| before.is_none_or(|before| before[*i] != now[*i]);
    let (mut left, mut right, mut top, mut bottom) = (w - 1, 0, usize::from(height) - 1, 0);
    for i in (0..now.len()).filter(differs) {
        let (x, y) = (i % w, i / w);
        (left, right, top, bottom) = (left.min(x), right.max(x), top.min(y), bottom.max(y));
    }
    // Nothing changed: one pixel keeps the time.
    if right < left || bottom < top {
        (left, right, top, bottom) = (0, 0, 0, 0);
    }
    let rows = (top..=bottom).flat_map(|y| now[y * w + left..=y * w + right].iter().copied());
    Frame {
        left: left as u16,
        top: top as u16,
        width: (right - left + 1) as u16,
        height: (bottom - top + 1) as u16,
        buffer: rows.collect::<Vec<_>>().into(),
        dispose: DisposalMethod::Keep,
        ..Frame::default()
    }
}

#[cfg(test)]
mod tests;
