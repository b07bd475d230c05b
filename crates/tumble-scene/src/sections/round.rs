//! Balls, whose resistance and lift follow from their radius.

use tumble_expr::Expr;
use tumble_mech::{PointRef, Shape};

use crate::code::Code;
use crate::diagnostic::{Diagnostic, Span};
use crate::draft::Draft;

/// A ball: its centre and its radius, m.
pub(super) struct Ball {
    pub(super) centre: PointRef,
    pub(super) radius: Expr,
}

/// The ball that a body is. Only a ball looks the same from wherever the air comes.
pub(super) fn of(draft: &mut Draft, body: &str, span: &Span) -> Option<Ball> {
    let body = draft.body_named(body)?;
    if let [part] = &body.parts[..]
        && let Shape::Ball { centre, radius } | Shape::Shell { centre, radius } = &part.shape
    {
        return Some(Ball { centre: body.at(centre), radius: radius.clone() });
    }
    let message = format!("`{}` is neither one `ball` nor one `shell`", body.name);
    let help = "a coefficient that goes with the radius is known for balls only; give the air's effect by its own coefficient: `[drag]` with `at` and `quadratic`, `[lift]` with `factor`";
    draft.note(Diagnostic::new(Code::ShapeInAir, span.clone(), message).label("no ball").help(help));
    None
}
