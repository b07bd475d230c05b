//! `[lift.NAME]`: the lift on a spinning body.

use tumble_expr::Dimension;
use tumble_mech::Magnus;

use super::{body, each, round};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::formula::Want;
use crate::keys::{Keys, Takes, may, must};

const DENSITY: Dimension = Dimension::new(-3, 1, 0);

#[rustfmt::skip]
pub(super) const KEYS: Keys = Keys::of("[lift.NAME]", &[&[
    must("on", Takes::BODY, "\"ball\"",
        "name of the body; the force acts at its centre of mass, or at the ball's centre"),
    may("factor", Takes::Quantity(Dimension::MASS), "this or the next two", "\"0.01 kg\"", "S, a mass"),
    may("density", Takes::Quantity(DENSITY), "none", "\"1.2 kg/m^3\"",
        "rho, of the air: with `slope`, for a ball"),
    may("slope", Takes::PURE, "none", "1",
        "for a ball: S is rho C_L pi R^3/2, with the slope C_L of the lift coefficient over R omega/v"),
]])
.one_of(&[&["factor", "density"]]);

pub(super) fn read(draft: &mut Draft, section: &Field) {
    each(draft, section, &KEYS, lift);
}

/// The lift factor itself, or what it is computed from for a ball.
fn lift(draft: &mut Draft, field: &Field, table: &mut Table) {
    let name = draft.own_name("a lift", field);
    let on = draft.required(table, "on").map(|on| (body(draft, &on), on.span));
    let factor = table.take("factor");
    let (density, slope) = (table.take("density"), table.take("slope"));
    match (factor, density, slope) {
        (Some(factor), None, None) => {
            draft.remember(format!("factor of `{name}`"), &factor.span);
            let factor = draft.number(&factor, Want::constant(Dimension::MASS));
            let on = on.and_then(|(on, _)| draft.body_named(&on?));
            let (Some(factor), Some(on)) = (factor, on) else { return };
            draft.model.interact(Magnus { name, at: on.cm(), factor });
        }
        (None, Some(density), Some(slope)) => {
            let density = draft.number(&density, Want::constant(DENSITY));
            let slope = draft.number(&slope, Want::constant(Dimension::NONE));
            let ball = on.and_then(|(on, span)| round::of(draft, &on?, &span));
            let (Some(ball), Some(density), Some(slope)) = (ball, density, slope) else { return };
            draft.model.interact(Magnus::ball(name, ball.centre, &ball.radius, density, slope));
        }
        (factor, density, slope) => {
            let given = [&density, &slope, &factor].into_iter().flatten().next();
            let mistake = neither(table, given, factor.is_some());
            draft.note(mistake);
        }
    }
}

fn neither(table: &Table, given: Option<&Field>, both: bool) -> Diagnostic {
    let (code, problem) = match (given, both) {
        (Some(_), true) => (Code::Exclusive, "states its factor twice"),
        (Some(_), false) => (Code::MissingKey, "has only one of `density` and `slope`"),
        (None, _) => (Code::MissingKey, "does not say how strong it is"),
    };
    let span = given.map_or(table.span.clone(), |field| field.key_span.clone());
    Diagnostic::new(code, span, format!("`{}` {problem}", table.title))
        .help("write either `factor = \"0.01 kg\"`, or `density` and `slope` for a ball: `density = \"1.2 kg/m^3\"`, `slope = 1`")
}
