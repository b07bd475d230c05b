//! What a reader of the page may change, and how far: parameters and starts with their ranges, and presets.

use std::collections::BTreeMap;

use tumble_expr::{Dimension, Expr};
use tumble_mech::{Anchor, Model};

use crate::draft::Draft;
use crate::formula::Want;
use crate::unit_text::UnitText;

/// What may be changed in a page that plays.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Play {
    /// Values, in the order in which they are shown.
    pub knobs: Vec<Knob>,
    /// Values that belong together, to be chosen at once.
    pub presets: Vec<Preset>,
}

/// A parameter or a start that may be changed.
#[derive(Clone, Debug, PartialEq)]
pub struct Knob {
    /// As a setting calls it: `T`, `rod.start.angle`.
    pub name: String,
    /// Its formula, as it is written.
    pub text: String,
    /// Its value, in `unit`.
    pub value: f64,
    /// The unit that it is written in; empty for a pure number.
    pub unit: String,
    /// One of `unit` in SI units.
    pub size: f64,
    /// From where to where, in `unit`.
    pub range: [f64; 2],
    /// Whether equal ratios are equal distances.
    pub is_log: bool,
    /// Whether it is one of those that the scene is about: named in `[play]`, or where that names none, stated by a quantity.
    pub is_first: bool,
}

/// Values that belong together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Preset {
    /// What it is called.
    pub label: String,
    /// What is to be said of it; may be empty.
    pub text: String,
    /// Formulas by the names of settings.
    pub set: Vec<(String, String)>,
}

/// A value that may be set, as it was read.
#[derive(Clone, Debug)]
pub(crate) struct Settable {
    pub(crate) name: String,
    pub(crate) text: String,
    pub(crate) want: Want,
    /// SI units.
    pub(crate) value: f64,
    /// Whether the scene states it, and does not leave it as it is.
    pub(crate) is_stated: bool,
}

/// A range that `[play]` gives.
#[derive(Clone, Debug)]
pub(crate) struct Asked {
    pub(crate) name: String,
    /// SI units.
    pub(crate) range: [f64; 2],
    pub(crate) is_log: bool,
}

/// Ends of a range that are further apart than this are shown by equal ratios where nothing is said.
pub(crate) const DECADES: f64 = 100.0;
/// Half a range about zero, in the unit of what is there: there is nothing to take a size from.
const FROM_ZERO: f64 = 1.0;
/// The same of an angle in degrees.
const HALF_TURN: f64 = 180.0;

/// What may be changed in a scene that was read.
pub(crate) fn of(draft: &Draft) -> Play {
    let all = settable(draft);
    let asked = &draft.asked_to_play;
    let listed = asked.iter().filter_map(|asked| {
        let of = all.iter().find(|value| value.name == asked.name)?;
        Some(knob(of, Some(asked), draft, true))
    });
    let rest = all.iter().filter(|value| asked.iter().all(|asked| asked.name != value.name));
    let rest = rest.map(|value| knob(value, None, draft, asked.is_empty() && value.is_first()));
    Play { knobs: listed.chain(rest).collect(), presets: draft.presets.clone() }
}

/// Every value that may be set, parameters first; none where a parameter has no value.
pub(crate) fn settable(draft: &Draft) -> Vec<Settable> {
    let parameters = &draft.model.parameters;
    let Ok(known) = parameters.known() else { return vec![] };
    let symbols = parameters.symbols().into_iter().zip(known.values().iter().copied());
    let by_name: BTreeMap<_, _> =
        symbols.map(|(symbol, value)| (symbol.name, (symbol.dimension, value))).collect();
    let of_parameter = |(name, text): &(String, String)| {
        let (dimension, value) = *by_name.get(name.as_str())?;
        let want = Want { angle: draft.angular.contains(name), ..Want::constant(dimension) };
        Some(Settable { name: name.clone(), text: text.clone(), want, value, is_stated: true })
    };
    let of_start = |start: &StartValue| {
        let StartValue { name, text, want, is_stated, value, .. } = start.clone();
        let value = known.evaluate(&[value]).ok()?[0];
        Some(Settable { name, text, want, value, is_stated })
    };
    let starts = draft.starts.iter().filter(|start| may_start(&draft.model, start));
    draft.parameter_texts.iter().filter_map(of_parameter).chain(starts.filter_map(of_start)).collect()
}

/// A component of a start as it was read.
#[derive(Clone, Debug)]
pub(crate) struct StartValue {
    pub(crate) name: String,
    pub(crate) body: String,
    pub(crate) text: String,
    pub(crate) want: Want,
    pub(crate) value: Expr,
    pub(crate) is_stated: bool,
}

/// Whether a start is free: stated, or of a body that no joint places; a pivot leaves its angle.
fn may_start(model: &Model, start: &StartValue) -> bool {
    let turns = start.name.ends_with(".angle") || start.name.ends_with(".omega");
    let is_joined = model.joints.iter().any(|joint| {
        joint.ends.iter().any(|end| matches!(end, Anchor::Material(point) if *point.body.body == *start.body))
    });
    start.is_stated || (!is_joined && (turns || model.pivot_of(&start.body).is_none()))
}

impl Settable {
    /// Whether it is a quantity by itself, and no formula of others.
    fn is_first(&self) -> bool {
        self.is_stated && (UnitText::of(&self.text).is_some() || self.text.trim().parse::<f64>().is_ok())
    }
}

fn knob(of: &Settable, asked: Option<&Asked>, draft: &Draft, is_first: bool) -> Knob {
    let unit = UnitText::of(&of.text).unwrap_or_else(|| everyday(of));
    let (size, value) = (unit.size(), unit.number(of.value));
    let range = match asked {
        Some(asked) => asked.range.map(|end| unit.number(end)),
        None => around(value, &unit, draft.swept(&of.name).iter().map(|end| unit.number(*end))),
    };
    let is_log = asked.map_or(range[0] > 0.0 && range[1] > DECADES * range[0], |asked| asked.is_log);
    let (name, text, unit) = (of.name.clone(), of.text.clone(), unit.text().to_owned());
    Knob { name, text, value, unit, size, range, is_log, is_first }
}

/// The unit of what is written without one: degrees for angles.
fn everyday(of: &Settable) -> UnitText {
    match of.want.angle && of.want.dimension == Some(Dimension::NONE) {
        true => UnitText::of("1 deg").unwrap_or_else(|| UnitText::si(of.want)),
        false => UnitText::si(of.want),
    }
}

/// From zero to twice a value, with those that a sweep gives it.
fn around(value: f64, unit: &UnitText, swept: impl Iterator<Item = f64>) -> [f64; 2] {
    let double = [f64::min(0.0, 2.0 * value), f64::max(0.0, 2.0 * value)];
    let range = swept.fold(double, |[low, high], end| [low.min(end), high.max(end)]);
    let about_zero = if unit.text() == "deg" { HALF_TURN } else { FROM_ZERO };
    if range == [0.0; 2] { [-about_zero, about_zero] } else { range }
}
