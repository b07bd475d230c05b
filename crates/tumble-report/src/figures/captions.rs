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
pub(crate) const ENERGIES: &str = "Kinetic, potential and total energy over time.";
/// What is left of the energy.
pub(crate) const RESIDUAL: &str = "Energy that the works of the loads do not account for, over time.";
/// An answer over two parameters.
pub(crate) const MAP: &str = "A cell for each run; the ring is about the best.";

/// More kinds of events than these are not told one by one.
const MOST_EVENTS: usize = 3;
/// Nor are those of more signs than these.
const MOST_SIGNS: usize = 90;
/// Digits of times.
const DIGITS: usize = 4;
/// What the bands of a figure are.
const BANDS: &str = "Pale: from the least to the greatest value over all runs that still go on; darker: the half of them in the \
                     middle; the first line is their median. The others are single runs.";

/// The scene at its start, with what its arrows are.
pub(crate) fn scene(drawing: &SceneDrawing) -> Text {
    let velocity = drawing.bodies.iter().find_map(|body| body.velocity.as_ref()).map(|(_, label)| label);
    let rate = drawing.bodies.iter().find_map(|body| body.rate.as_ref()).map(|(_, label)| label);
    let forces = drawing.forces.iter().map(|force| force.symbol.clone());
    let force = forces.reduce(|all, next| all.then(Label::plain(", ")).then(next));
    let arrows = [
        (velocity, "velocity of the centre of mass"),
        (rate, "angular velocity"),
        (force.as_ref(), "applied force"),
        (drawing.gravity.as_ref().map(|(_, label)| label), "acceleration of gravity"),
        (drawing.wind.as_ref().map(|(_, label)| label), "wind"),
    ];
    let shown = arrows.into_iter().filter_map(|(label, words)| Some((label?.clone(), words)));
    Text::from("The scene at the start. ").and(meaning(shown))
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
            "thin arrow, the arm from the centre of mass to where a force acts",
        ),
        (
            any(&|panel| !panel.couples.is_empty() && !is_of_impulses(panel)),
            "tau",
            "torque about the centre of mass, counter-clockwise positive",
        ),
        (any(&is_of_impulses), "J", "impulse of an impact"),
        (has(&velocity), &*velocity, "velocity of the centre of mass"),
        (any(&|panel| panel.rate.is_some()), "omega", "angular velocity"),
        (has("u"), "u", "velocity of the air past the point where it acts"),
    ];
    let new: Vec<_> = letters
        .into_iter()
        .filter(|(shown, letter, _)| *shown && !said.iter().any(|one| one == letter))
        .collect();
    said.extend(new.iter().map(|(_, letter, _)| (*letter).to_owned()));
    let row = "Thin arrows in a row: the force along the body; the thick one: their sum. ";
    let row = if has_row { row } else { "" };
    let letters = new.into_iter().map(|(_, letter, words)| (Label::symbol(letter), words));
    Text::from(format!("Everything that acts on {}. {row}", symbols::the(body))).and(meaning(letters))
}

/// Symbols with what they mean.
fn meaning<'w>(symbols: impl Iterator<Item = (Label, &'w str)>) -> Label {
    let one = |(symbol, words): (Label, &str)| symbol.then(Label::plain(&format!(": {words}")));
    let all = symbols.map(one).reduce(|all, next| all.then(Label::plain("; ")).then(next));
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
    Text::from(y.clone()).and(" over ").and(x.clone()).and(dashed(&figure.marks)).and(".").capitalised()
}

/// What happens where there are dashed lines.
fn dashed(marks: &[Mark]) -> Label {
    let end_of_digits = Label::plain(END_OF_DIGITS);
    let mut events: Vec<&Label> = vec![];
    for Mark { label, .. } in marks.iter().filter(|mark| mark.label != end_of_digits) {
        if !events.contains(&label) {
            events.push(label);
        }
    }
    match events.len() {
        0 => Label::default(),
        1..=MOST_EVENTS if events.iter().map(|label| label.to_plain().len()).sum::<usize>() <= MOST_SIGNS => {
            let all = events.into_iter().cloned().reduce(|all, next| all.then(Label::plain("; ")).then(next));
            Label::plain("; dashed: ").then(all.unwrap_or_default())
        }
        _ => Label::plain("; dashed lines are events"),
    }
}

/// An answer over what is swept.
pub(crate) fn answers(figure: &CurveFigure, has_more_runs: bool) -> Text {
    let [x, y] = [&figure.x.label, &figure.y.label].map(|label| Text::from(label.clone()));
    let more = if has_more_runs { ", with the best of the runs that were made between them" } else { "" };
    y.and(" of each run over ").and(x).and(more).and(dashed(&figure.marks)).and(".").capitalised()
}

/// What a stroboscopic picture shows.
pub(crate) fn stroboscope(study: &Study, asked: &Stroboscope) -> Result<Text, CaseError> {
    let names: Vec<String> =
        asked.bodies.iter().map(|body| symbols::the(&study.model.bodies[*body].name)).collect();
    let every = quantity(study.number(&asked.every)?, "s");
    let dotted = if asked.trace { "; thin lines: the path of the centre of mass" } else { "" };
    Ok(Text::from(listed(&names)).capitalised().and(" every ").and(every).and(dotted).and("."))
}

/// From when to when a motion goes; on paper it is that of its first case.
pub(crate) fn motion(animation: &Animation) -> Text {
    let ends = animation.cases.iter().flat_map(|case| [case.times.first(), case.times.last()]).flatten();
    let ends = Range::of(ends.copied()).unwrap_or_default();
    let [from, to] = [ends.low, ends.high].map(|time| Label::number(time, DIGITS).to_plain());
    let first = animation.cases.first().filter(|_| animation.cases.len() > 1).map(|case| case.name.clone());
    let words = Text::from(format!("The motion from {from} to {to}\u{a0}s"));
    first.map_or(words.clone(), |name| words.and(", ").and(name)).and(".")
}
