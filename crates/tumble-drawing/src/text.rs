//! Labels: text with italics, subscripts and superscripts, measured and drawn.

use tumble_notation::numeral::Numeral;
use tumble_notation::{Identifier, is_letter};

use crate::font::{self, Face};
use crate::rect::Rect;
use crate::svg::Element;
use crate::theme;
use crate::units::{MINUS, unit_parts};

/// Size of subscripts and superscripts in units of the text size.
const SCRIPT_SIZE: f64 = 0.7;
/// How far subscripts hang below the baseline, in em of the text.
const SUBSCRIPT_DROP: f64 = 0.2;
/// How far superscripts stand above the baseline, in em of the text.
const SUPERSCRIPT_RISE: f64 = 0.36;
/// Thickness of the paper-coloured rim that parts a label from lines behind it.
const HALO: f64 = 4.0;

/// Where a run stands relative to the line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Level {
    /// On the line.
    #[default]
    Base,
    /// Below, smaller.
    Subscript,
    /// Above, smaller.
    Superscript,
}

impl Level {
    fn size(self) -> f64 {
        if self == Level::Base { 1.0 } else { SCRIPT_SIZE }
    }

    /// Downward shift in em.
    fn drop(self) -> f64 {
        match self {
            Level::Base => 0.0,
            Level::Subscript => SUBSCRIPT_DROP,
            Level::Superscript => -SUPERSCRIPT_RISE,
        }
    }
}

/// A stretch of text in one style.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextRun {
    /// The characters, unescaped.
    pub text: String,
    /// Upright, italic or bold.
    pub face: Face,
    /// Height relative to the line.
    pub level: Level,
}

/// One line of styled text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Label {
    /// The runs from left to right.
    pub runs: Vec<TextRun>,
}

impl From<Numeral> for Label {
    fn from(Numeral { digits, power }: Numeral) -> Self {
        let digits = Self::plain(&digits);
        match power {
            Some(power) => digits.then(Self::power_of_ten(power)),
            None => digits,
        }
    }
}

impl Label {
    /// Upright text, as it is.
    pub fn plain(text: &str) -> Self {
        Self::default().with(text, Face::Regular, Level::Base)
    }

    /// A symbol from a name: `theta` is an italic θ, `w1` an italic w with
    /// subscript 1; words of more than two letters stay upright.
    pub fn symbol(name: &str) -> Self {
        let identifier = Identifier::parse(name);
        let face = |italic: bool| if italic { Face::Italic } else { Face::Regular };
        let label = Self::default().with(&identifier.head, face(identifier.is_italic()), Level::Base);
        identifier.subscript.iter().enumerate().fold(label, |label, (index, part)| {
            let comma = if index == 0 { "" } else { "," };
            let face = face(is_letter(part));
            label.with(comma, Face::Regular, Level::Subscript).with(part, face, Level::Subscript)
        })
    }

    /// The label of a scene's name such as `rod.angle`: the symbol that
    /// `symbols` (pairs of name and symbol) gives it, a symbol of its own if
    /// it has no dot, else the plain name.
    pub fn name(name: &str, symbols: &[(&str, &str)]) -> Self {
        match symbols.iter().find(|(known, _)| *known == name) {
            Some((_, symbol)) => Self::symbol(symbol),
            None if name.contains('.') => Self::plain(name),
            None => Self::symbol(name),
        }
    }

    /// A unit, upright: `m/s^2` has a raised 2, `kg*m` a centred dot.
    pub fn unit(unit: &str) -> Self {
        unit_parts(unit).iter().fold(Self::default(), |label, part| {
            let base = format!("{}{}", part.separator, part.name);
            let label = label.with(&base, Face::Regular, Level::Base);
            label.with(&part.exponent, Face::Regular, Level::Superscript)
        })
    }

    /// A number and its unit, for instance `0.5 s`; the number as the caller wrote it.
    pub fn quantity(number: &str, unit: &str) -> Self {
        Self::plain(&number.replace('-', MINUS)).in_unit(unit)
    }

    /// A number with its unit; a pure number has none.
    pub fn in_unit(self, unit: &str) -> Self {
        // Degrees stand close to the number, other units do not.
        let space = if matches!(unit, "" | "deg") { "" } else { "\u{a0}" };
        self.then(Self::plain(space)).then(Self::unit(unit))
    }

    /// `symbol = number unit`, as in a legend: `Label::equation("T", "0.5", "s")`.
    pub fn equation(symbol: &str, number: &str, unit: &str) -> Self {
        Self::symbol(symbol).then(Self::plain(" = ")).then(Self::quantity(number, unit))
    }

    /// Text with symbols between dollar signs: `Wind of $w1$ = 20 m/s`.
    /// A dollar sign without a partner is a dollar sign.
    pub fn markup(text: &str) -> Self {
        let pieces: Vec<_> = text.split('$').collect();
        if pieces.len().is_multiple_of(2) {
            return Self::plain(text);
        }
        pieces.iter().enumerate().fold(Self::default(), |label, (i, piece)| {
            label.then(if i % 2 == 1 { Self::symbol(piece) } else { Self::plain(piece) })
        })
    }

    /// A number rounded to at most so many significant digits, for instance `1.25` or `3×10⁻⁷`.
    pub fn number(value: f64, digits: usize) -> Self {
        Numeral::significant(value, digits).into()
    }

    /// A number with all its digits.
    pub fn exact(value: f64) -> Self {
        Numeral::exact(value).into()
    }

    /// A power of ten with a multiplication sign, `×10⁻³`.
    pub fn power_of_ten(exponent: i32) -> Self {
        let exponent = exponent.to_string().replace('-', MINUS);
        Self::plain("×10").with(&exponent, Face::Regular, Level::Superscript)
    }

    /// Adds a run; empty text adds nothing.
    pub fn with(mut self, text: &str, face: Face, level: Level) -> Self {
        match self.runs.last_mut().filter(|run| run.face == face && run.level == level) {
            _ if text.is_empty() => {}
            Some(run) => run.text.push_str(text),
            None => self.runs.push(TextRun { text: text.to_owned(), face, level }),
        }
        self
    }

    /// Joins another label at the end.
    pub fn then(self, other: Label) -> Self {
        other.runs.into_iter().fold(self, |label, run| label.with(&run.text, run.face, run.level))
    }

    /// The same label with its upright text in bold.
    pub fn bold(mut self) -> Self {
        for run in self.runs.iter_mut().filter(|run| run.face == Face::Regular) {
            run.face = Face::Bold;
        }
        self
    }

    /// Whether there is nothing to draw.
    pub fn is_empty(&self) -> bool {
        self.runs.is_empty()
    }

    /// Width in pixels at text size `size` (pixels), by the embedded font.
    pub fn width(&self, size: f64) -> f64 {
        self.runs.iter().map(|run| font::width(&run.text, run.face) * run.level.size() * size).sum()
    }

    /// The label cut to `width` pixels at text size `size`, ending in `…` if it was longer.
    pub fn fitted(&self, size: f64, width: f64) -> Self {
        let mut label = self.clone();
        if label.width(size) <= width {
            return label;
        }
        let with_dots = |label: &Label| label.clone().with("…", Face::Regular, Level::Base);
        while with_dots(&label).width(size) > width && label.drop_last() {}
        with_dots(&label)
    }

    fn drop_last(&mut self) -> bool {
        let Some(run) = self.runs.last_mut() else { return false };
        run.text.pop();
        if run.text.is_empty() {
            self.runs.pop();
        }
        true
    }

    /// The label without styles, or other words where there is none.
    pub fn to_plain_or(&self, otherwise: &str) -> String {
        if self.is_empty() { otherwise.to_owned() } else { self.to_plain() }
    }

    /// The label without styles, for tooltips and screen readers.
    pub fn to_plain(&self) -> String {
        let mark = |level| match level {
            Level::Base => "",
            Level::Subscript => "_",
            Level::Superscript => "^",
        };
        self.runs.iter().map(|run| format!("{}{}", mark(run.level), run.text)).collect()
    }
}

/// Which end of the label its position fixes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TextAnchor {
    /// The left end.
    Start,
    /// The middle.
    #[default]
    Middle,
    /// The right end.
    End,
}

impl TextAnchor {
    fn keyword(self) -> &'static str {
        match self {
            TextAnchor::Start => "start",
            TextAnchor::Middle => "middle",
            TextAnchor::End => "end",
        }
    }
}

/// A label with its place on the page.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedText {
    label: Label,
    at: [f64; 2],
    size: f64,
    anchor: TextAnchor,
    colour: theme::Rgb,
    halo: bool,
    upward: bool,
}

impl PlacedText {
    /// A label with the anchor on its baseline at `at` (`[x, y]`, pixels), `size` pixels high.
    pub fn new(label: &Label, at: [f64; 2], size: f64, anchor: TextAnchor) -> Self {
        let (label, colour) = (label.clone(), theme::INK);
        Self { label, at, size, anchor, colour, halo: false, upward: false }
    }

    /// A label centred, in both directions, on the middle of `place`.
    pub fn centred(label: &Label, place: &Rect, size: f64) -> Self {
        let [x, y] = place.centre();
        Self::new(label, [x, middle_baseline(y, size)], size, TextAnchor::Middle)
    }

    /// In another colour than ink.
    pub fn colour(mut self, colour: theme::Rgb) -> Self {
        self.colour = colour;
        self
    }

    /// With a rim of paper colour, for labels over lines.
    pub fn halo(mut self) -> Self {
        self.halo = true;
        self
    }

    /// Turned a quarter turn, to be read from the right, about the anchor.
    pub fn upward(mut self) -> Self {
        self.upward = true;
        self
    }

    /// Whether there is nothing to draw.
    pub fn is_empty(&self) -> bool {
        self.label.is_empty()
    }

    /// The `text` element.
    pub fn element(&self) -> Element {
        let mut text = Element::new("text")
            .attrs([("x", self.at[0]), ("y", self.at[1]), ("font-size", self.size)])
            .attr("text-anchor", self.anchor.keyword())
            .attr("fill", self.colour)
            .attr("xml:space", "preserve");
        if self.upward {
            let [x, y] = self.at.map(crate::svg::number);
            text = text.attr("transform", format!("rotate(-90 {x} {y})"));
        }
        if self.halo {
            text = text.stroked(theme::PAPER, HALO);
            text = text.attr("stroke-linejoin", "round").attr("paint-order", "stroke");
        }
        self.runs().fold(text, Element::child)
    }

    fn runs(&self) -> impl Iterator<Item = Element> {
        let mut drop = 0.0;
        self.label.runs.iter().map(move |run| {
            let shift = (run.level.drop() - drop) * self.size;
            drop = run.level.drop();
            tspan(run, shift, self.size)
        })
    }
}

fn tspan(run: &TextRun, shift: f64, size: f64) -> Element {
    let mut span = Element::new("tspan");
    if shift != 0.0 {
        span = span.attr("dy", shift);
    }
    if run.level != Level::Base {
        span = span.attr("font-size", size * SCRIPT_SIZE);
    }
    span = match run.face {
        Face::Regular => span,
        Face::Italic => span.attr("font-style", "italic"),
        Face::Bold => span.attr("font-weight", "bold"),
    };
    span.text(&run.text)
}

/// The baseline that centres figures and capitals of text size `size` on height `y` (pixels).
pub fn middle_baseline(y: f64, size: f64) -> f64 {
    y + font::CAP_HEIGHT * size / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(label: &Label) -> String {
        PlacedText::new(label, [0.0, 0.0], 10.0, TextAnchor::Start).runs().map(|e| e.to_string()).collect()
    }

    #[test]
    fn symbols_are_italic_and_figures_upright() {
        assert_eq!(
            shown(&Label::symbol("omega0")),
            r#"<tspan font-style="italic">ω</tspan><tspan dy="2" font-size="7">0</tspan>"#
        );
        assert_eq!(shown(&Label::symbol("mass")), "<tspan>mass</tspan>");
    }

    #[test]
    fn units_are_upright_with_raised_exponents() {
        let label = Label::unit("kg*m^2/s");
        assert_eq!(label.to_plain(), "kg·m^2/s");
        assert!(label.runs.iter().all(|run| run.face == Face::Regular));
        assert!(shown(&label).contains(r#"<tspan dy="3.6">/s</tspan>"#));
    }

    #[test]
    fn dotted_names_follow_the_callers_symbols() {
        let symbols = [("rod.angle", "theta")];
        assert_eq!(Label::name("rod.angle", &symbols).to_plain(), "θ");
        assert_eq!(Label::name("rod.omega", &symbols).to_plain(), "rod.omega");
        assert_eq!(Label::name("w1", &symbols).to_plain(), "w_1");
    }

    #[test]
    fn equations_and_markup() {
        assert_eq!(Label::equation("T", "-0.5", "s").to_plain(), "T = −0.5\u{a0}s");
        assert_eq!(Label::markup("Wind $w1$ = 20").to_plain(), "Wind w_1 = 20");
        assert_eq!(Label::markup("costs 3 $").to_plain(), "costs 3 $");
    }

    #[test]
    fn long_labels_are_cut() {
        let label = Label::plain("a rather long label").fitted(10.0, 40.0);
        assert!(label.width(10.0) <= 40.0);
        assert!(label.to_plain().ends_with('…'));
    }

    #[test]
    fn scripts_are_narrower_than_text() {
        assert!(Label::symbol("w1").width(10.0) < Label::plain("w1").width(10.0));
    }
}
