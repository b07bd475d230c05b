//! What a scene says in words, at the move of the report that its section belongs to.

use crate::report::{Report, Text};
use tumble_drawing::Label;
use tumble_scene::Commentary;

use super::words::spoken;

/// Puts each commentary where its section is told of; the problem itself comes first.
pub(super) fn into(report: &mut Report, texts: &[Commentary]) {
    for commentary in texts {
        let place = match commentary.section.as_str() {
            "force" | "impulse" | "drag" | "lift" | "spring" | "damper" | "torsion" | "free_body" => {
                &mut report.model.intro
            }
            "run" | "output" => &mut report.solve.intro,
            "equilibrium" | "plot" | "stroboscope" | "balance" | "find" | "check" => {
                &mut report.analyze.intro
            }
            _ => &mut report.identify.intro,
        };
        place.extend(paragraphs(commentary));
    }
}

/// The first of a section that has a name begins with it.
fn paragraphs(commentary: &Commentary) -> impl Iterator<Item = Text> {
    commentary.paragraphs.iter().enumerate().map(|(index, words)| {
        let said = Text::from(Label::markup(words));
        match (index, commentary.name.is_empty()) {
            (0, false) => Text::from(format!("{}: ", spoken(&commentary.name))).capitalised().and(said),
            _ => said,
        }
    })
}
