//! LaTeX as MathML, in pieces between which a line may end: browsers do not break a formula by themselves.

use pulldown_latex::config::{DisplayMode, RenderConfig};
use pulldown_latex::{Parser, Storage, push_mathml};

/// Shorter formulas stay in one piece: a narrow page has room for them.
const SHORT: usize = 40;
/// A line may end before these, where nothing encloses them.
const BREAKS: [&str; 4] = [" = ", " + ", " - ", " \\, "];
/// What encloses others, and what ends it.
const OPENS: [&str; 3] = ["{", "\\left", "\\begin"];
const CLOSES: [&str; 3] = ["}", "\\right", "\\end"];

/// The formula; `None` where it cannot be read.
pub(super) fn mathml(latex: &str, display_mode: DisplayMode) -> Option<String> {
    let pieces = if latex.len() > SHORT { pieces(latex) } else { vec![latex] };
    let shown: Option<Vec<String>> = pieces.iter().map(|piece| one(piece, display_mode)).collect();
    Some(shown?.join("<wbr>"))
}

fn one(latex: &str, display_mode: DisplayMode) -> Option<String> {
    let storage = Storage::new();
    if !Parser::new(latex, &storage).all(|event| event.is_ok()) {
        return None;
    }
    let mut found = String::new();
    let config = RenderConfig { display_mode, ..RenderConfig::default() };
    push_mathml(&mut found, Parser::new(latex, &storage), config).ok()?;
    // Pieces stand in a line; what is large in a display stays large in each of them.
    Some(found.replacen("display=\"block\"", "displaystyle=\"true\"", 1))
}

/// The formula cut before each sign that nothing encloses.
fn pieces(latex: &str) -> Vec<&str> {
    let (mut found, mut from, mut depth) = (vec![], 0, 0_i32);
    for (at, _) in latex.char_indices() {
        let rest = &latex[at..];
        let begins = |words: &[&str]| words.iter().any(|word| rest.starts_with(word));
        // An escaped brace is a sign.
        let is_escaped = latex[..at].ends_with('\\');
        depth += i32::from(begins(&OPENS) && !is_escaped) - i32::from(begins(&CLOSES) && !is_escaped);
        if depth == 0 && begins(&BREAKS) {
            found.push(&latex[from..at]);
            from = at;
        }
    }
    found.push(&latex[from..]);
    found.retain(|piece| !piece.trim().is_empty());
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_are_cut_where_nothing_encloses_the_sign() {
        let latex = r"I = \frac{a + b}{c} + \left( d - e \right) \, f_{1 + 2}";
        assert_eq!(pieces(latex), ["I", r" = \frac{a + b}{c}", r" + \left( d - e \right)", r" \, f_{1 + 2}"]);
    }

    #[test]
    fn what_cannot_be_read_is_none() {
        assert!(mathml(r"\frac{a}{b}", DisplayMode::Inline).is_some_and(|shown| shown.contains("<mfrac>")));
        assert_eq!(mathml(r"\nosuchthing{a}", DisplayMode::Inline), None);
        assert_eq!(mathml("{a", DisplayMode::Inline), None);
    }

    #[test]
    fn displays_are_large_in_a_line() {
        let shown = mathml("x = y", DisplayMode::Block).unwrap_or_default();
        assert!(shown.contains("displaystyle=\"true\"") && !shown.contains("display=\"block\""), "{shown}");
    }
}
