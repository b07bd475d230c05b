//! Captions: what is seen in each figure of a report.

use tumble_drawing::free_body::{ArrowUnit, FreeBodyDiagram, FreeBodySheet};
use tumble_drawing::scale::Range;
use tumble_drawing::{Animation, CurveFigure, Label, Mark, SceneDrawing};
use tumble_scene::{Stroboscope, Study};

use crate::figures::symbols;
use crate::fill::{listed, quantity};
use crate::report::{END_OF_DIGITS, Text};
use crate::results::CaseError;

/// Energies over time.
pub(crate) const ENERGIES: &str = "The curves show kinetic, potential and total energy over time.";
/// What is left of the energy.
pub(crate) const RESIDUAL: &str =
    "The curve shows the energy that the works of the loads do not account for, over time.";
/// An answer over two parameters.
pub(crate) const MAP: &str = "Each run has a cell; the ring is about the best.";

/// More kinds of events than these are not told one by one.
const MOST_EVENTS: usize = 3;
/// Nor are those of more signs than these.
const MOST_SIGNS: usize = 90;
/// Digits of times.
const DIGITS: usize = 4;
/// What the bands of a figure are.
const BANDS: &str = "The pale band goes from the least to the greatest value over all runs that still go on, the darker one over \
                     the half of them in the middle. The first line is their median; the others are single runs.";

/// The scene at its start, with what its arrows are.
pub(crate) fn scene(drawing: &SceneDrawing) -> Text {
    let velocity = drawing.bodies.iter().find_map(|body| body.velocity.as_ref()).map(|(_, label)| label);
    let rate = drawing.bodies.iter().find_map(|body| body.rate.as_ref()).map(|(_, label)| label);
    let forces = drawing.forces.iter().map(|force| force.symbol.clone());
    let force = forces.reduce(|all, next| all.then(Label::plain(", ")).then(next));
    let arrows = [
        (velocity, "the velocity of the centre of mass"),
        (rate, "the angular velocity"),
        (force.as_ref(), "an applied force"),
        (drawing.gravity.as_ref().map(|(_, label)| label), "the acceleration of gravity"),
        (drawing.wind.as_ref().map(|(_, label)| label), "the wind"),
    ];
    let shown = arrows.into_iter().filter_map(|(label, words)| Some((label?.clone(), words)));
    Text::from("The scene is drawn as it starts.").and(meaning(shown))
}

/// What a sheet shows, in words: whose forces, and what the letters mean that are not forces and that no sheet `said` before.
pub(crate) fn free_bodies(study: &Study, sheet: &FreeBodySheet, body: &str, said: &mut Vec<String>) -> Text {
    let velocity = symbols::velocity(study, body);
    let any = |has: &dyn Fn(&FreeBodyDiagram) -> bool| sheet.panels.iter().any(has);
    let has = |symbol: &str| any(&|panel| panel.velocities.iter().any(|v| v.symbol == Label::symbol(symbol)));
    let is_of_impulses = |panel: &FreeBodyDiagram| panel.unit == ArrowUnit::impulse();
    let has_row = any(&|panel| !panel.spreads.is_empty());
    let letters = [
        (
            any(&|panel| !panel.arms.is_empty()),
            "r",
            "the arm (a thin arrow) from the centre of mass to where a force acts",
        ),
        (
            any(&|panel| !panel.couples.is_empty() && !is_of_impulses(panel)),
            "tau",
            "the torque about the centre of mass (counter-clockwise positive)",
        ),
        (any(&is_of_impulses), "J", "the impulse of an impact"),
        (has(&velocity), &*velocity, "the velocity of the centre of mass"),
        (any(&|panel| panel.rate.is_some()), "omega", "the angular velocity"),
        (has("u"), "u", "the velocity of the air past the point where it acts"),
    ];
    let new: Vec<_> = letters
        .into_iter()
        .filter(|(shown, letter, _)| *shown && !said.iter().any(|one| one == letter))
        .collect();
    said.extend(new.iter().map(|(_, letter, _)| (*letter).to_owned()));
    let row = " Thin arrows in a row show the force along the body, the thick one their sum.";
    let row = if has_row { row } else { "" };
    let letters = new.into_iter().map(|(_, letter, words)| (Label::symbol(letter), words));
    Text::from(format!("The arrows show everything that acts on {}.{row}", symbols::the(body)))
        .and(meaning(letters))
}

/// What symbols mean, as a sentence.
fn meaning<'w>(symbols: impl Iterator<Item = (Label, &'w str)>) -> Label {
    let symbols: Vec<_> = symbols.collect();
    let one = |(i, (symbol, words)): (usize, &(Label, &str))| {
        let (before, verb) = match i {
            0 => (" Here ", " is"),
            _ if i + 1 == symbols.len() => (" and ", ""),
            _ => (", ", ""),
        };
        Label::plain(before).then(symbol.clone()).then(Label::plain(&format!("{verb} {words}")))
    };
    let all = symbols.iter().enumerate().map(one).reduce(Label::then);
    all.map_or_else(Label::default, |all| all.then(Label::plain(".")))
}

/// What is drawn over what, and what its bands and its dashed lines are.
pub(crate) fn curves(figure: &CurveFigure) -> Text {
    if !figure.bands.is_empty() {
        return BANDS.into();
    }
    let [x, y] = [&figure.x.label, &figure.y.label];
    if x.is_empty() || y.is_empty() {
        return Text::default();
    }
    let show = if figure.series.len() > 1 { "The curves show " } else { "The curve shows " };
    Text::from(show).and(y.clone()).and(" over ").and(x.clone()).and(".").and(dashed(&figure.marks))
}

/// What happens where there are dashed lines.
fn dashed(marks: &[Mark]) -> Label {
    let end_of_digits = Label::plain(END_OF_DIGITS);
    let (mut events, mut places): (Vec<&Label>, Vec<f64>) = (vec![], vec![]);
    for Mark { label, at } in marks.iter().filter(|mark| mark.label != end_of_digits) {
        if !events.contains(&label) {
            events.push(label);
        }
        if !places.contains(at) {
            places.push(*at);
        }
    }
    let is_short = events.iter().map(|label| label.to_plain().len()).sum::<usize>() <= MOST_SIGNS;
    let quoted = |label: &Label| Label::plain("\u{201c}").then(label.clone()).then(Label::plain("\u{201d}"));
    match &events[..] {
        [] => Label::default(),
        [only] if is_short => {
            let words = if places.len() > 1 { " The dashed lines mark " } else { " The dashed line marks " };
            Label::plain(words).then(quoted(only)).then(Label::plain("."))
        }
        [before @ .., last] if is_short && events.len() <= MOST_EVENTS => {
            let before = before
                .iter()
                .map(|label| quoted(label))
                .reduce(|all, next| all.then(Label::plain(", ")).then(next));
            let all = before.unwrap_or_default().then(Label::plain(" and ")).then(quoted(last));
            Label::plain(" The dashed lines mark ").then(all).then(Label::plain("."))
        }
        _ => Label::plain(" The dashed lines mark events."),
    }
}

/// An answer over what is swept.
pub(crate) fn answers(figure: &CurveFigure, has_more_runs: bool) -> Text {
    let [x, y] = [&figure.x.label, &figure.y.label].map(|label| Text::from(label.clone()));
    let more = if has_more_runs { ", with the best of the runs that were made between them" } else { "" };
    Text::from("The curve shows ")
        .and(y)
        .and(" of each run over ")
        .and(x)
        .and(more)
        .and(".")
        .and(dashed(&figure.marks))
}

/// What a stroboscopic picture shows.
pub(crate) fn stroboscope(study: &Study, asked: &Stroboscope) -> Result<Text, CaseError> {
    let names: Vec<String> =
        asked.bodies.iter().map(|body| symbols::the(&study.model.bodies[*body].name)).collect();
    let every = quantity(study.number(&asked.every)?, "s");
    let (are, path) = match names.len() {
        1 => (" is", ", with the path of its centre of mass as a thin line"),
        _ => (" are", ", with the paths of their centres of mass as thin lines"),
    };
    let path = if asked.trace { path } else { "" };
    Ok(Text::from(listed(&names)).capitalised().and(are).and(" drawn every ").and(every).and(path).and("."))
}

/// From when to when a motion goes; on paper it is that of its first case.
pub(crate) fn motion(animation: &Animation) -> Text {
    let ends = animation.cases.iter().flat_map(|case| [case.times.first(), case.times.last()]).flatten();
    let ends = Range::of(ends.copied()).unwrap_or_default();
    let [from, to] = [ends.low, ends.high].map(|time| Label::number(time, DIGITS).to_plain());
    let first = animation.cases.first().filter(|_| animation.cases.len() > 1).map(|case| case.name.clone());
    let words = Text::from(format!("The motion is shown from {from} to {to}\u{a0}s"));
    first.map_or(words.clone(), |name| words.and(" (").and(name).and(")")).and(".")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_symbols_mean_is_a_sentence() {
        let of = |symbols: &[(&str, &'static str)]| {
            let all: Vec<_> = symbols.iter().map(|(name, words)| (Label::symbol(name), *words)).collect();
            meaning(all.into_iter()).to_plain()
        };
        assert_eq!(of(&[]), "");
        assert_eq!(of(&[("g", "the gravity")]), " Here g is the gravity.");
        let three = [("r", "the arm"), ("v", "the velocity"), ("u", "the wind")];
        assert_eq!(of(&three), " Here r is the arm, v the velocity and u the wind.");
    }

    #[test]
    fn what_dashed_lines_mark_is_a_sentence() {
        let of = |words: &[&str]| {
            let marks: Vec<Mark> =
                words.iter().map(|words| Mark { label: Label::plain(words), ..Mark::default() }).collect();
            dashed(&marks).to_plain()
        };
        assert_eq!(of(&[]), "");
        assert_eq!(of(&["apex", "apex"]), " The dashed line marks “apex”.");
        assert_eq!(of(&["hit", "apex"]), " The dashed lines mark “hit” and “apex”.");
        assert_eq!(of(&["a", "b", "c", "d"]), " The dashed lines mark events.");
        let twice = [1.0, 2.0].map(|at| Mark { label: Label::plain("lowest"), at });
        assert_eq!(dashed(&twice).to_plain(), " The dashed lines mark “lowest”.");
    }
}
