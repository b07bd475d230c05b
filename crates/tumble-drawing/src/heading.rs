//! Titles above figures, broken into lines.

use crate::svg::Element;
use crate::text::{Label, PlacedText, TextAnchor};
use crate::theme::{GAP, LARGE, LEADING, MARGIN};

/// A title of one or more lines at the top left of a picture: there it is seen also where the page is narrower than the picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Heading {
    lines: Vec<Label>,
}

impl Heading {
    /// The title broken into lines that fit a picture `width` pixels wide.
    pub fn new(title: &Label, width: f64) -> Self {
        Self { lines: wrapped(&title.clone().bold(), LARGE, width - 2.0 * MARGIN) }
    }

    /// Where the rest of the picture may begin, in pixels from its top.
    pub fn bottom(&self) -> f64 {
        let lines = self.lines.len() as f64 * LARGE * LEADING;
        MARGIN + if self.lines.is_empty() { 0.0 } else { lines + GAP }
    }

    /// The lines.
    pub fn draw(&self) -> Element {
        let line = |(i, label): (usize, &Label)| {
            let y = MARGIN + LARGE + i as f64 * LARGE * LEADING;
            PlacedText::new(label, [MARGIN, y], LARGE, TextAnchor::Start).element()
        };
        Element::new("g").children(self.lines.iter().enumerate().map(line))
    }
}

/// Breaks a label at its blanks into lines at most `width` pixels wide at
/// text size `size`; a longer word is cut.
pub fn wrapped(label: &Label, size: f64, width: f64) -> Vec<Label> {
    let mut lines: Vec<Label> = Vec::new();
    for word in words(label) {
        let longer = lines.last().map(|line| line.clone().then(Label::plain(" ")).then(word.clone()));
        match (lines.last_mut(), longer.filter(|longer| longer.width(size) <= width)) {
            (Some(line), Some(longer)) => *line = longer,
            _ => lines.push(word.fitted(size, width)),
        }
    }
    lines
}

/// The words between blanks, with their styles.
fn words(label: &Label) -> Vec<Label> {
    let mut words = vec![Label::default()];
    for run in &label.runs {
        for (i, part) in run.text.split(' ').enumerate() {
            if i > 0 {
                words.push(Label::default());
            }
            if let Some(word) = words.last_mut() {
                *word = std::mem::take(word).with(part, run.face, run.level);
            }
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_titles_take_several_lines() {
        let title = Label::markup("Angle of the rod in a wind of amplitude $w1$ that varies with time");
        let lines = wrapped(&title, 10.0, 120.0);
        assert!(lines.len() > 1);
        assert!(lines.iter().all(|line| line.width(10.0) <= 120.0));
        let joined = lines.iter().map(Label::to_plain).collect::<Vec<_>>().join(" ");
        assert_eq!(joined, title.to_plain());
    }

    #[test]
    fn an_endless_word_is_cut() {
        let lines = wrapped(&Label::plain(&"m".repeat(200)), 10.0, 100.0);
        assert!(lines.len() == 1 && lines[0].width(10.0) <= 100.0);
    }

    #[test]
    fn no_title_takes_no_room() {
        assert_eq!(Heading::new(&Label::default(), 100.0).bottom(), MARGIN);
    }
}
