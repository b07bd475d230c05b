//! Diagrams in words, for those who cannot see them.

use crate::text::Label;

use super::arrow::{Arrow, Couple};
use super::body::FreeBodyDiagram;
use super::cone::FrictionCone;
use super::strokes::DIGITS;

/// Everything that acts in a panel: each force with its components and point of action.
pub(super) fn describe(body: &FreeBodyDiagram) -> String {
    let drawn = body.drawable();
    let mut parts: Vec<String> = drawn.forces.iter().map(|force| force_words(force, body)).collect();
    parts.extend(drawn.cones.iter().map(cone_words));
    parts.extend(drawn.couples.iter().map(|couple| couple_words(couple, body)));
    parts.extend(drawn.resultant.iter().map(|sum| force_words(sum, body)));
    let side = body.side.as_ref().map(|side| side.as_body(&body.unit));
    let side_forces = side.iter().flat_map(|side| side.drawable().forces);
    parts.extend(side_forces.map(|force| format!("out of the plane, {}", force_words(&force, body))));
    parts.extend(
        body.listed().iter().chain(&side.map_or(Vec::new(), |side| side.listed())).map(Label::to_plain),
    );
    parts.extend(drawn.velocities.iter().map(|velocity| {
        let [x, y] = velocity.vector.map(plain);
        format!("velocity {} with components ({x}, {y}) m/s", velocity.symbol.to_plain())
    }));
    parts.extend(
        drawn
            .angle
            .iter()
            .map(|angle| format!("angle {} = {}°", angle.symbol.to_plain(), plain(angle.value.to_degrees()))),
    );
    if parts.is_empty() {
        parts.push(format!("no {}", body.unit.quantity));
    }
    format!("{}: {}.", title(body), parts.join("; "))
}

fn title(body: &FreeBodyDiagram) -> String {
    let words = std::iter::once(&body.name).chain(&body.heading).map(Label::to_plain);
    let words: Vec<_> = words.filter(|word| !word.is_empty()).collect();
    if words.is_empty() { "Body".to_owned() } else { words.join(", ") }
}

fn force_words(force: &Arrow, body: &FreeBodyDiagram) -> String {
    let unit = Label::unit(&body.unit.arrow).to_plain();
    let symbol = if force.symbol.is_empty() { String::new() } else { force.symbol.to_plain() + " = " };
    format!(
        "{} {} {symbol}{} {unit}, components ({}, {}) {unit}, at ({}, {}) m",
        force.kind.name(),
        body.unit.quantity,
        plain(force.magnitude()),
        plain(force.vector[0]),
        plain(force.vector[1]),
        plain(force.point[0]),
        plain(force.point[1]),
    )
}

fn cone_words(cone: &FrictionCone) -> String {
    let half = plain(cone.coefficient.atan().to_degrees());
    let [x, y] = cone.point.map(plain);
    format!("cone of friction at ({x}, {y}) m, {half}° to both sides of the normal force")
}

fn couple_words(couple: &Couple, body: &FreeBodyDiagram) -> String {
    let unit = Label::unit(&body.unit.couple).to_plain();
    let symbol = if couple.symbol.is_empty() { String::new() } else { couple.symbol.to_plain() + " = " };
    let value = plain(couple.value);
    format!("{} couple {symbol}{value} {unit}, counter-clockwise positive", couple.kind.name())
}

/// A number as diagrams print it.
fn plain(value: f64) -> String {
    Label::number(value, DIGITS).to_plain()
}
