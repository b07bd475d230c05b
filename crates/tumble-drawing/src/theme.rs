//! Colours, line styles and sizes shared by all figures, in pixels at scale 1.

/// A colour of the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rgb(pub u8, pub u8, pub u8);

impl Rgb {
    /// The colour as `#rrggbb`.
    pub fn hex(self) -> String {
        format!("#{:02x}{:02x}{:02x}", self.0, self.1, self.2)
    }

    /// A paler colour: 1 keeps it, 0 gives white. Opaque, so that overlaps do not darken.
    pub fn strength(self, strength: f64) -> Self {
        let keep = strength.clamp(0.0, 1.0);
        let mix = |c: u8| (255.0 - keep * (255.0 - f64::from(c))).round() as u8;
        Self(mix(self.0), mix(self.1), mix(self.2))
    }
}

impl Rgb {
    /// A darker tone for text, which needs more contrast than lines.
    pub fn for_text(self) -> Self {
        let darker = |c: u8| (TEXT_TONE * f64::from(c)).round() as u8;
        Self(darker(self.0), darker(self.1), darker(self.2))
    }
}

impl From<Rgb> for crate::svg::AttributeValue {
    fn from(colour: Rgb) -> Self {
        colour.hex().into()
    }
}

/// Part of a series' colour that its labels have: the palest ones come to a contrast of 4.5 on white.
const TEXT_TONE: f64 = 0.64;

/// Text and frames.
pub const INK: Rgb = Rgb(0x1a, 0x1a, 0x1a);
/// Secondary lines: event marks, ground hatching.
pub const GREY: Rgb = Rgb(0x80, 0x80, 0x80);
/// The page.
pub const PAPER: Rgb = Rgb(0xff, 0xff, 0xff);

/// Number of colours of series.
pub const PALETTE_SIZE: usize = 7;

/// Okabe and Ito's palette as far as it stands out from white, and darker tones for the rest: told apart by colour-blind readers. Pages
/// have the same.
const PALETTE: [Rgb; PALETTE_SIZE] = [
    Rgb(0x00, 0x72, 0xb2),
    Rgb(0xd5, 0x5e, 0x00),
    Rgb(0x00, 0x9e, 0x73),
    Rgb(0x7a, 0x3f, 0x53),
    Rgb(0x00, 0x00, 0x00),
    Rgb(0x70, 0x70, 0x3b),
    Rgb(0x19, 0x41, 0x6b),
];

/// Dash patterns in pixels; the first is a full line. Their number and the
/// palette's have no common factor, so 42 series differ.
const DASHES: [&str; 6] = ["", "7 3", "7 2.5 1.5 2.5", "2 2", "12 3", "7 2.5 1.5 2.5 1.5 2.5"];

/// Colour, dashes and thickness of a line: of one series, or of an arrow's shaft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineStyle {
    /// Colour of the line.
    pub colour: Rgb,
    /// `stroke-dasharray`; empty for a full line.
    pub dashes: &'static str,
    /// Thickness in pixels.
    pub thickness: f64,
}

impl LineStyle {
    const fn new(colour: Rgb, dashes: &'static str, thickness: f64) -> Self {
        Self { colour, dashes, thickness }
    }

    /// The style of series number `index`, counted from 0.
    pub fn of(index: usize) -> Self {
        let (colour, dashes) = (PALETTE[index % PALETTE.len()], DASHES[index % DASHES.len()]);
        Self { colour, dashes, thickness: CURVE }
    }

    /// The sample of a band in the colour of series number `index`, so much paler.
    pub fn of_band(index: usize, strength: f64) -> Self {
        let colour = PALETTE[index % PALETTE.len()].strength(strength);
        Self { colour, dashes: "", thickness: BAND_SAMPLE }
    }
}

/// Weight. Arrows take Okabe and Ito's colours in darker tones, so that thin
/// shafts and labels are legible on white; line styles differ as well.
pub const WEIGHT: LineStyle = LineStyle::new(Rgb(0x00, 0x5f, 0x9e), "", 2.2);
/// Forces of surfaces.
pub const CONTACT: LineStyle = LineStyle::new(Rgb(0xc4, 0x4a, 0x00), "", 3.0);
/// Forces of the air.
pub const AIR: LineStyle = LineStyle::new(Rgb(0x00, 0x7d, 0x5b), "6 2.5", 2.2);
/// Forces that somebody applies.
pub const APPLIED: LineStyle = LineStyle::new(Rgb(0x9c, 0x3f, 0x78), "11 2.5", 2.6);
/// Forces of springs.
pub const SPRING: LineStyle = LineStyle::new(Rgb(0x54, 0x3e, 0x24), "2.5 2", 2.6);
/// Forces of pivots and other supports.
pub const REACTION: LineStyle = LineStyle::new(Rgb(0x1a, 0x1a, 0x1a), "", 2.2);
/// Sums of forces.
pub const RESULTANT: LineStyle = LineStyle::new(Rgb(0x1a, 0x1a, 0x1a), "", 1.3);
/// Velocities.
pub const MOTION: LineStyle = LineStyle::new(Rgb(0x5a, 0x5a, 0x5a), "", 1.2);
/// Arms from a centre of mass.
pub const ARM: LineStyle = LineStyle::new(Rgb(0x1a, 0x1a, 0x1a), "", 0.9);
/// Bodies under forces: paler than any arrow.
pub const BODY: Rgb = Rgb(0x8d, 0x97, 0xa3);

/// Size of tick labels and legends.
pub const SMALL: f64 = 15.0;
/// Size of axis labels.
pub const NORMAL: f64 = 17.0;
/// Size of titles.
pub const LARGE: f64 = 18.0;

/// Thickness of frames and ticks.
pub const HAIRLINE: f64 = 0.8;
/// Thickness of curves.
pub const CURVE: f64 = 1.6;

/// Thickness of the sample of a band in a legend.
const BAND_SAMPLE: f64 = 10.0;

/// A page this narrow, in pixels, shows the parts of a broad drawing below each other.
pub(crate) const NARROW: f64 = 444.0;
/// Distance between a figure's content and the edge of the picture.
pub const MARGIN: f64 = 12.0;
/// Distance between neighbouring things, such as ticks and their labels.
pub const GAP: f64 = 6.0;
/// Baseline to baseline, in units of the text size.
pub const LEADING: f64 = 1.3;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn styles_of_twenty_series_differ() {
        let styles: Vec<_> = (0..42).map(LineStyle::of).collect();
        for (i, a) in styles.iter().enumerate() {
            assert!(styles[..i].iter().all(|b| b != a));
        }
    }

    /// How strong red, green and blue are.
    fn linear(colour: Rgb) -> [f64; 3] {
        [colour.0, colour.1, colour.2].map(|c| {
            let part = f64::from(c) / 255.0;
            if part <= 0.04045 { part / 12.92 } else { ((part + 0.055) / 1.055).powf(2.4) }
        })
    }

    fn light([r, g, b]: [f64; 3]) -> f64 {
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }

    fn contrast_with_white(colour: Rgb) -> f64 {
        1.05 / (light(linear(colour)) + 0.05)
    }

    #[test]
    fn labels_of_series_stand_out_from_white() {
        for colour in PALETTE.map(Rgb::for_text) {
            assert!(contrast_with_white(colour) >= 4.5, "{colour:?}");
        }
    }

    const FORCES: [LineStyle; 6] = [WEIGHT, CONTACT, AIR, APPLIED, SPRING, REACTION];

    /// WCAG 2 asks for 3 of graphics.
    #[test]
    fn lines_stand_out_from_white() {
        for colour in PALETTE.into_iter().chain(FORCES.map(|style| style.colour)) {
            assert!(contrast_with_white(colour) >= 3.0, "{colour:?}: {}", contrast_with_white(colour));
        }
    }

    /// As those see colours who have all cones or lack one kind (Machado, Oliveira and Fernandes 2009, severity 1), in linear RGB.
    const EYES: [[[f64; 3]; 3]; 4] = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
        [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.01182, 0.04294, 0.968881]],
        [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.3039]],
    ];

    /// CIELAB, white D65.
    fn lab(rgb: [f64; 3]) -> [f64; 3] {
        let part = |t: f64| {
            if t > 216.0 / 24389.0 { t.cbrt() } else { (24389.0 / 27.0 * t + 16.0) / 116.0 }
        };
        let [r, g, b] = rgb;
        let x = part((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505);
        let z = part((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089);
        let y = part(light(rgb));
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    }

    /// The least distance of two colours for any eyes.
    fn least_apart(colours: &[Rgb]) -> f64 {
        let seen = |eyes: &[[f64; 3]; 3], colour: Rgb| {
            let rgb = linear(colour);
            lab(eyes.map(|row| row.iter().zip(rgb).map(|(a, b)| a * b).sum::<f64>().clamp(0.0, 1.0)))
        };
        let mut least = f64::INFINITY;
        for eyes in &EYES {
            for (index, one) in colours.iter().enumerate() {
                for other in &colours[..index] {
                    let [a, b] = [seen(eyes, *one), seen(eyes, *other)];
                    let square: f64 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
                    least = least.min(square.sqrt());
                }
            }
        }
        least
    }

    /// 2.3 is just seen side by side; forces differ by their lines as well.
    #[test]
    fn colours_are_told_apart_by_all_eyes() {
        assert!(least_apart(&PALETTE) >= 15.0, "{}", least_apart(&PALETTE));
        let forces = FORCES.map(|style| style.colour);
        assert!(least_apart(&forces) >= 10.0, "{}", least_apart(&forces));
    }

    #[test]
    fn strength_fades_to_white() {
        assert_eq!(INK.strength(1.0), INK);
        assert_eq!(INK.strength(0.0), PAPER);
    }
}
