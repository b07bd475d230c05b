//! `start = { at = [..], velocity = [..], angle = "..", omega = ".." }`: what a body starts from.

use tumble_expr::{Dimension, Expr, Vector};
use tumble_mech::Start;

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::formula::{self, Text, Want};
use crate::keys::{Keys, Takes, may};
use crate::names::Names;
use crate::play::StartValue;

#[rustfmt::skip]
pub(super) const KEYS: Keys = Keys::of("start", &[&[
    may("at", Takes::PLACE, "where it is drawn", "[0, \"2 m\"]", "place of the centre of mass"),
    may("velocity", Takes::Vector(Dimension::SPEED), "0", "[\"1 m/s\", 0]", "of the centre of mass"),
    may("angle", Takes::Angle(Dimension::NONE), "0", "\"30 deg\"", "counter-clockwise"),
    may("omega", Takes::Angle(Dimension::ANGULAR_RATE), "0", "\"2 rad/s\"", "angular velocity"),
]]);

/// What stands between the name of a body and that of a component in a setting, `rod.start.angle`.
const START: &str = ".start.";
/// The components that can be set.
const COMPONENTS: [&str; 6] = ["x", "y", "vx", "vy", "angle", "omega"];

/// Whether a setting is of what a body starts from.
pub(crate) fn is_setting(names: &Names, name: &str) -> bool {
    name.split_once(START).is_some_and(|(body, part)| {
        COMPONENTS.contains(&part) && names.bodies.iter().any(|known| known == body)
    })
}

/// Place and velocity are those of the centre of mass; what is not given is as drawn, and at rest.
pub(super) fn read(draft: &mut Draft, body: &str, table: &mut Table) {
    let field = table.take("start");
    if let Some(field) = &field {
        draft.remember(format!("start of `{body}`"), &field.key_span);
    }
    let inner = field.as_ref().and_then(|field| draft.table(field, &KEYS));
    let is_mistaken = field.is_some() && inner.is_none();
    let mut inner = inner.unwrap_or_else(|| Table::empty(&KEYS));
    let mut of = Of { draft, body };
    let at = of.pair(&mut inner, "at", ["x", "y"]);
    let velocity = of.pair(&mut inner, "velocity", ["vx", "vy"]);
    let [angle, omega] = ["angle", "omega"].map(|key| of.one(inner.take(key), key, Want::of(&KEYS, key)));
    draft.done(inner);
    let start = Start { at, velocity, angle, omega };
    let is_given =
        [start.at.is_some(), start.velocity.is_some(), start.angle.is_some(), start.omega.is_some()];
    if !is_mistaken && (field.is_some() || is_given.contains(&true)) {
        draft.model.starts.push((body.to_owned(), start));
    }
}

/// The start of a body while it is read.
struct Of<'d> {
    draft: &'d mut Draft,
    body: &'d str,
}

impl Of<'_> {
    /// Two components that are given together.
    fn pair(&mut self, table: &mut Table, key: &'static str, parts: [&'static str; 2]) -> Option<Vector> {
        let want = Want::of(&KEYS, key);
        let given = match table.take(key) {
            Some(field) => self.draft.pair(&field, "[x, y]")?.map(Some),
            None => [None, None],
        };
        let [first, second] = given;
        let (x, y) = (self.one(first, parts[0], want), self.one(second, parts[1], want));
        match (x, y) {
            (Some(x), Some(y)) => Some(Vector::planar(x, y)),
            (None, None) => None,
            // The other component of a velocity is zero, of a place it is not known.
            (x, y) if key == "velocity" => {
                let zero = || Expr::zero() * tumble_expr::Unit(Dimension::SPEED);
                Some(Vector::planar(x.unwrap_or_else(zero), y.unwrap_or_else(zero)))
            }
            (x, _) => {
                let missing = if x.is_some() { parts[1] } else { parts[0] };
                self.refuse_half(missing);
                None
            }
        }
    }

    /// A place of which only one component is set.
    fn refuse_half(&mut self, missing: &str) {
        let body = self.body;
        let set =
            self.draft.settings.iter().find(|setting| setting.name.starts_with(&format!("{body}{START}")));
        let Some(origin) = set.map(|setting| setting.text.origin.clone()) else { return };
        let message = format!("`{body}` has no place at its start of which one component could be set alone");
        let mistake = Diagnostic::new(Code::Start, origin.whole(), message).within(origin.source);
        self.draft.note(mistake.label("one of two").help(format!("set `{body}{START}{missing}` too")));
    }

    /// A component: what a setting says, else what the scene does.
    fn one(&mut self, field: Option<Field>, part: &'static str, want: Want) -> Option<Expr> {
        let name = format!("{}{START}{part}", self.body);
        // The scene's own has to make sense too.
        let own = match field {
            Some(field) => Some(self.draft.text(&field, want).and_then(|text| self.number(text, want))?),
            None => None,
        };
        let set = match self.draft.setting(&name) {
            Some(text) => Some(self.number(text, want)?),
            None => None,
        };
        let given = set.or(own);
        let value = given.as_ref().map(|(_, value)| value.clone());
        let (is_stated, body) = (given.is_some(), self.body.to_owned());
        let (text, known) = given.unwrap_or_else(|| ("0".to_owned(), Expr::zero()));
        self.draft.starts.push(StartValue { name, body, text, want, value: known, is_stated });
        value
    }

    fn number(&mut self, text: Text, want: Want) -> Option<(String, Expr)> {
        let value = formula::number(&self.draft.names, &text, want);
        Some((text.text, self.draft.all_noted(value)?))
    }
}
