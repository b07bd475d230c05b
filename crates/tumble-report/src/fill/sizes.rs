//! Moments of inertia of shapes whose sizes are numbers in the scene: by the formula of the shape, with letters for them.

use tumble_expr::{Dimension, Expr, Symbol};
use tumble_mech::{Body, Shape};
use tumble_scene::Study;

use super::names::{Names, quantity};
use crate::report::{Definition, Text};
use crate::results::CaseError;

/// `I = m (w^2 + h^2)/12`, and what the letters mean; nothing where the scene has names for the sizes.
pub(super) fn inertia(
    study: &Study,
    names: &Names,
    body: &Body,
    name: &str,
) -> Result<Option<Definition>, CaseError> {
    let Some((lettered, sizes)) = lettered(body) else { return Ok(None) };
    let size = |(letter, size): &(&str, Expr)| -> Result<Text, CaseError> {
        Ok(Text::symbol(letter).and("\u{a0}=\u{a0}").and(quantity(study.number(size)?, "m")))
    };
    let sizes: Vec<Text> = sizes.iter().map(size).collect::<Result<_, _>>()?;
    let sizes = sizes.into_iter().reduce(|all, next| all.and(", ").and(next)).unwrap_or_default();
    let symbol = names.equation(name, &lettered.mass_properties().inertia);
    Ok(Some(Definition { symbol, meaning: Text::from("with ").and(sizes) }))
}

/// A body of one shape whose sizes are numbers, with letters for them.
fn lettered(body: &Body) -> Option<(Body, Vec<(&'static str, Expr)>)> {
    let mut lettered = body.clone();
    let [part] = &mut lettered.parts[..] else { return None };
    let letter = |(name, size): (&'static str, &mut Expr)| {
        (name, std::mem::replace(size, Symbol::new(name, Dimension::LENGTH).into()))
    };
    let sizes: Vec<(&str, Expr)> = match &mut part.shape {
        Shape::Box { width, height, .. } => [("w", width), ("h", height)].map(letter).into(),
        Shape::Disk { radius, .. }
        | Shape::Ring { radius, .. }
        | Shape::Ball { radius, .. }
        | Shape::Shell { radius, .. } => vec![letter(("R", radius))],
        _ => return None,
    };
    let is_number = sizes.iter().all(|(_, size)| size.symbols().is_empty()) && body.stated.is_none();
    is_number.then_some((lettered, sizes))
}
