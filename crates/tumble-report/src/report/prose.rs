//! Running text with symbols and formulas in it.

use super::math::Typeset;
use tumble_drawing::font::Face;
use tumble_drawing::text::Label;

/// A piece of running text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Inline {
    /// Words as they are.
    Words(String),
    /// A symbol, a quantity or a unit, as figures print it.
    Label(Label),
    /// A formula.
    Math(Typeset),
}

/// Running text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Text {
    /// Its pieces in order; spaces between them are the writer's.
    pub pieces: Vec<Inline>,
}

impl Text {
    /// A symbol by its name, for instance `theta0`.
    pub fn symbol(name: &str) -> Self {
        Label::symbol(name).into()
    }

    /// The same text with more at its end: words, a [`Label`] or [`Typeset`].
    pub fn and(mut self, more: impl Into<Text>) -> Self {
        self.pieces.extend(more.into().pieces);
        self
    }

    /// With a capital letter, if it begins with a word: a name with a number, `b11`, stays as it is.
    #[must_use]
    pub fn capitalised(mut self) -> Self {
        let is_said = |piece: &&mut Inline| !matches!(piece, Inline::Words(words) if words.is_empty());
        let first = match self.pieces.iter_mut().find(is_said) {
            Some(Inline::Words(words)) => Some(words),
            Some(Inline::Label(label)) => {
                label.runs.first_mut().filter(|run| run.face == Face::Regular).map(|run| &mut run.text)
            }
            _ => None,
        };
        let is_name = |words: &&mut String| {
            words.split(' ').next().is_some_and(|word| word.contains(|c: char| c.is_ascii_digit()))
        };
        if let Some(words) = first.filter(|words| !is_name(words)) {
            let mut letters = words.chars();
            *words = letters.next().into_iter().flat_map(char::to_uppercase).chain(letters).collect();
        }
        self
    }

    /// Whether there is nothing to show.
    pub fn is_empty(&self) -> bool {
        self.pieces.iter().all(|piece| match piece {
            Inline::Words(words) => words.is_empty(),
            Inline::Label(label) => label.is_empty(),
            Inline::Math(math) => math.mathml.is_empty() && math.text.is_empty() && math.latex.is_empty(),
        })
    }

    /// The text without styles.
    pub fn to_plain(&self) -> String {
        let plain = |piece: &Inline| match piece {
            Inline::Words(words) => words.clone(),
            Inline::Label(label) => label.to_plain(),
            Inline::Math(math) => math.text.clone(),
        };
        self.pieces.iter().map(plain).collect()
    }
}

impl From<String> for Text {
    fn from(words: String) -> Self {
        Self { pieces: vec![Inline::Words(words)] }
    }
}

impl From<&str> for Text {
    fn from(words: &str) -> Self {
        words.to_owned().into()
    }
}

impl From<Label> for Text {
    fn from(label: Label) -> Self {
        Self { pieces: vec![Inline::Label(label)] }
    }
}

impl From<Typeset> for Text {
    fn from(math: Typeset) -> Self {
        Self { pieces: vec![Inline::Math(math)] }
    }
}
