//! What the values of a model must be: at the start, and after every event that sets parameters.

use std::collections::{BTreeSet, HashMap, HashSet};
use std::convert::Infallible;
use std::sync::Arc;

use tumble_expr::{Binary, Expr, Vector, is_identically_zero};
use tumble_ode::Reason;

use crate::body::{Body, Part};
use crate::contact::BodyContact;
use crate::coordinates::{Coordinates, Pivot};
use crate::equations::Equations;
use crate::error::ModelError;
use crate::event::Event;
use crate::fixed::{Fixed, LARGEST_ANGLE};
use crate::formulas::Stated;
use crate::friction::Friction;
use crate::interaction::Interaction;
use crate::model::Model;
use crate::parameters::{Known, Parameters};
use crate::shape::{Shape, square};
use crate::surface::{ContactLaw, Surface};

/// A moment of inertia about a pivot is nothing if it is this part of what the same mass has at the distances that its lever
/// is the difference of: so much is left by rounding of a lever that is none.
const NO_LEVER: f64 = 1e-30;

/// A corner of a polygon that turns back by less than this part of the polygon's area is straight.
const STRAIGHT: f64 = 1e-12;

/// What a value must be.
#[derive(Clone, Copy, Debug)]
enum Must {
    /// Positive; with its SI unit.
    BePositive(&'static str),
    /// Zero or positive; with its SI unit.
    NotBeNegative(&'static str),
    /// A restitution.
    LieWithinOne,
    /// What is left of static friction beyond the kinetic one.
    HoldAsMuch,
    /// The length of a vector that says where something points.
    Point,
    /// The angle of a body, or one that it is turned back to.
    BeAnAngle,
    /// What remains of a moment of inertia about a pivot.
    Turn,
    /// What a bowl has more of than what moves in it, m.
    LeaveRoom,
    /// What the shortest side of a polygon, and what is between its sides, has more than rounding, m.
    HaveSides,
    /// Twice the area of a polygon that goes round counter-clockwise.
    GoRoundLeft,
    /// The least area of the triangles by which a polygon is told to be convex.
    BeConvex,
}

/// A value that something has to have.
struct Condition {
    /// Body, load or surface that it belongs to.
    owner: String,
    /// What messages call it.
    what: String,
    formula: Expr,
    must: Must,
    /// Whether it follows from other values of the owner, whose mistakes are reported instead.
    follows: bool,
}

impl Model {
    /// All mistakes in the values of a model with these parameters: what is negative, too large, or no number, at the start or
    /// after an event that sets parameters.
    pub fn value_mistakes(&self, parameters: &Parameters) -> Vec<ModelError> {
        match parameters.known() {
            Ok(known) => self.mistakes_with(&known),
            Err(mistakes) => mistakes.0,
        }
    }

    pub(crate) fn mistakes_with(&self, known: &Known<'_>) -> Vec<ModelError> {
        let conditions = Conditions::of(self, known);
        let all: Vec<usize> = (0..conditions.list.len()).collect();
        let broken = match conditions.broken(|formulas| known.evaluate(formulas), &all) {
            Ok(broken) => broken,
            Err(mistake) => return vec![mistake],
        };
        let wrong: HashSet<usize> = broken.iter().map(|(index, _)| *index).collect();
        let mut mistakes = conditions.told(broken);
        mistakes.extend(unfit(self, known, &mistakes));
        let events = self.events.iter().flat_map(|event| conditions.broken_by(event, known, &wrong));
        mistakes.extend(events);
        mistakes
    }
}

/// The conditions of a model, with those that each parameter has a part in.
struct Conditions {
    list: Vec<Condition>,
    by_parameter: HashMap<Arc<str>, Vec<usize>>,
}

impl Conditions {
    /// Those on what is fixed by the parameters: what changes with the time or the motion has no value yet.
    fn of(model: &Model, known: &Known<'_>) -> Self {
        let (mut list, mut by_parameter) = (vec![], HashMap::<_, Vec<usize>>::new());
        for condition in conditions(model) {
            let symbols = condition.formula.symbols();
            if !symbols.iter().all(|symbol| known.parameters().contains(symbol)) {
                continue;
            }
            for symbol in symbols {
                by_parameter.entry(symbol.name).or_default().push(list.len());
            }
            list.push(condition);
        }
        Self { list, by_parameter }
    }

    /// Those of some conditions that do not hold, by their indices.
    fn broken(
        &self,
        evaluate: impl Fn(&[Expr]) -> Result<Vec<f64>, ModelError>,
        some: &[usize],
    ) -> Result<Vec<(usize, ModelError)>, ModelError> {
        let formulas: Vec<Expr> = some.iter().map(|index| self.list[*index].formula.clone()).collect();
        let values = evaluate(&formulas)?;
        let found = some.iter().zip(values);
        Ok(found.filter_map(|(index, value)| Some((*index, self.list[*index].mistake(value)?))).collect())
    }

    /// Without what follows from others.
    fn told(&self, broken: Vec<(usize, ModelError)>) -> Vec<ModelError> {
        let of = |index: &usize| &self.list[*index];
        let own = broken.iter().map(|(index, _)| of(index)).filter(|condition| !condition.follows);
        let blamed: HashSet<&str> = own.map(|condition| condition.owner.as_str()).collect();
        let is_told = |index: &usize| !of(index).follows || !blamed.contains(of(index).owner.as_str());
        let told = broken.iter().filter(|(index, _)| is_told(index));
        told.map(|(_, mistake)| mistake.clone()).collect()
    }

    /// Conditions that held and do not any more once an event has set its parameters.
    fn broken_by(&self, event: &Event, known: &Known<'_>, wrong: &HashSet<usize>) -> Vec<ModelError> {
        let some: Vec<usize> =
            self.touched(&[event]).into_iter().filter(|index| !wrong.contains(index)).collect();
        let after = known.after(event.settings());
        let broken = after
            .and_then(|after| self.broken(|formulas| after.evaluate(formulas), &some))
            .unwrap_or_default();
        let after =
            |mistake| ModelError::AfterEvent { event: event.name.clone(), mistake: Box::new(mistake) };
        self.told(broken).into_iter().map(after).collect()
    }

    /// Those that parameters which some events set have a part in.
    fn touched(&self, events: &[&Event]) -> BTreeSet<usize> {
        let names = events.iter().flat_map(|event| event.settings()).map(|(name, _)| name.as_str());
        names.filter_map(|name| self.by_parameter.get(name)).flatten().copied().collect()
    }
}

/// Formulas of the parameters in a model, and what their values must be.
pub(crate) struct Sound {
    conditions: Conditions,
    /// Of the conditions, then of the parts.
    formulas: Vec<Expr>,
    /// What is fixed in the model's other formulas.
    parts: Vec<Fixed>,
}

impl Sound {
    fn of(model: &Model, known: &Known<'_>) -> Self {
        let conditions = Conditions::of(model, known);
        let stated: Vec<Expr> = model.stated().into_iter().map(|stated| stated.formula).collect();
        let parts = known.parameters().fixed_parts(&stated);
        let of_conditions = conditions.list.iter().map(|condition| &condition.formula);
        let formulas = of_conditions.chain(parts.iter().map(|part| &part.formula)).cloned().collect();
        Self { conditions, formulas, parts }
    }

    /// Whether nothing is wrong with these values; what is, [`Model::mistakes_with`] says.
    fn allows(&self, model: &Model, known: &Known<'_>) -> bool {
        let Ok(values) = known.evaluate(&self.formulas) else { return false };
        let (conditions, parts) = values.split_at(self.conditions.list.len());
        let mut conditions = self.conditions.list.iter().zip(conditions);
        let mut parts = self.parts.iter().zip(parts);
        conditions.all(|(condition, value)| condition.mistake(*value).is_none())
            && parts.all(|(part, value)| part.allows(*value))
            && known.has_sound_formulas()
            && model.events.iter().all(|event| self.allows_after(event, known))
    }

    fn allows_after(&self, event: &Event, known: &Known<'_>) -> bool {
        event.settings().is_empty() || self.conditions.broken_by(event, known, &HashSet::new()).is_empty()
    }
}

impl Equations {
    /// All mistakes in the values of the model with these parameters.
    pub(crate) fn value_mistakes(&self, known: &Known<'_>) -> Vec<ModelError> {
        let sound = self.built().sound.get(&(), || Ok::<_, Infallible>(Sound::of(self.model(), known)));
        match sound {
            Ok(sound) if sound.allows(self.model(), known) => vec![],
            _ => self.model().mistakes_with(known),
        }
    }

    /// A reason to stop where several events together make a value impossible that none of them does alone.
    pub(crate) fn refuse_changes(&self, changes: &[usize], inputs: &[f64]) -> Result<(), Reason> {
        if changes.len() < 2 {
            return Ok(());
        }
        let bits = inputs.iter().map(|value| value.to_bits()).collect();
        self.built()
            .sound_changes
            .get(&(changes.to_vec(), bits), || self.check_changes(changes, inputs))
            .map(|_| ())
    }

    fn check_changes(&self, changes: &[usize], inputs: &[f64]) -> Result<(), Reason> {
        let (model, before) = (self.model(), Known::of(&self.model().parameters, inputs));
        let events: Vec<&Event> = changes.iter().map(|event| &model.events[*event]).collect();
        let settings: Vec<(String, Expr)> =
            events.iter().flat_map(|event| event.settings()).cloned().collect();
        let conditions = Conditions::of(model, &before);
        let some: Vec<usize> = conditions.touched(&events).into_iter().collect();
        let broken = before
            .after(&settings)
            .and_then(|after| conditions.broken(|formulas| after.evaluate(formulas), &some));
        let broken = broken.map(|broken| conditions.told(broken)).map_err(|mistake| vec![mistake]);
        let (Ok(mistakes) | Err(mistakes)) = broken;
        let names: Vec<String> = events.iter().map(|event| format!("`{}`", event.name)).collect();
        match mistakes.first() {
            None => Ok(()),
            Some(mistake) => Err(Reason::Model(format!("after {}: {mistake}", names.join(", ")))),
        }
    }
}

/// Formulas that hold something infinite, or the sine of an angle without digits, where nothing else is wrong with what they
/// belong to.
fn unfit(model: &Model, known: &Known<'_>, others: &[ModelError]) -> Vec<ModelError> {
    let own = known.parameters().formulas();
    let own = own.map(|(symbol, formula)| (format!("parameter `{}`", symbol.name), formula.clone()));
    let stated = model.stated().into_iter().map(|Stated { what, formula, .. }| (what, formula));
    let all: Vec<(String, Expr)> = own.chain(stated).collect();
    let blamed: HashSet<&str> = others.iter().filter_map(ModelError::owner).collect();
    let found = known.mistakes_of(all.iter().map(|(what, formula)| (what.as_str(), formula)));
    let is_new = |mistake: &ModelError| mistake.owner().is_none_or(|owner| !blamed.contains(owner));
    found.into_iter().filter(is_new).collect()
}

impl Condition {
    fn mistake(&self, value: f64) -> Option<ModelError> {
        let what = || self.what.clone();
        let unit = match self.must {
            Must::BePositive(unit) | Must::NotBeNegative(unit) => unit,
            _ => "",
        };
        match self.must {
            Must::Point if !(value > 0.0 && value.is_finite()) => {
                Some(ModelError::NoDirection { what: what() })
            }
            _ if !value.is_finite() => Some(ModelError::NotFinite { what: what(), value }),
            Must::LeaveRoom if value <= 0.0 => Some(ModelError::NoRoom { what: what(), less: value.abs() }),
            Must::HaveSides if value <= 0.0 => Some(ModelError::Flat { what: what() }),
            Must::GoRoundLeft if value < 0.0 => Some(ModelError::Clockwise { what: what() }),
            Must::BeConvex if value < 0.0 => Some(ModelError::NotConvex { what: what() }),
            Must::Turn if value <= 0.0 => Some(ModelError::NoInertia { what: what() }),
            Must::BePositive(_) if value <= 0.0 => {
                Some(ModelError::NotPositive { what: what(), value, unit })
            }
            Must::BePositive(_) if value.is_subnormal() => {
                Some(ModelError::TooSmall { what: what(), value, unit })
            }
            Must::NotBeNegative(_) if value < 0.0 => Some(ModelError::Negative { what: what(), value, unit }),
            Must::LieWithinOne if !(0.0..=1.0).contains(&value) => {
                Some(ModelError::Restitution { what: what(), value })
            }
            Must::HoldAsMuch if value < 0.0 => {
                Some(ModelError::StaticBelowKinetic { what: what(), below: -value })
            }
            Must::BeAnAngle if value.abs() > LARGEST_ANGLE => {
                Some(ModelError::Angle { what: what(), value, most: LARGEST_ANGLE })
            }
            _ => None,
        }
    }
}

fn conditions(model: &Model) -> Vec<Condition> {
    let pivots: HashMap<&str, &Pivot> =
        model.pivots.iter().rev().map(|pivot| (pivot.body.as_str(), pivot)).collect();
    let bodies = model.bodies.iter().flat_map(|body| of_body(body, pivots.get(body.name.as_str()).copied()));
    let interactions = model.interactions.iter().flat_map(|interaction| of_interaction(&**interaction));
    let surfaces = model.surfaces.iter().flat_map(of_surface);
    let starts = model.starts.iter().flat_map(|(body, start)| {
        let what = format!("start of `{body}`");
        start.angle.iter().map(move |angle| own(body, what.clone(), angle.clone(), Must::BeAnAngle))
    });
    let contacts = model.contacts.iter().flat_map(of_contact).chain(of_polygons(model));
    bodies.chain(interactions).chain(surfaces).chain(of_bowls(model)).chain(contacts).chain(starts).collect()
}

fn own(owner: &str, what: String, formula: Expr, must: Must) -> Condition {
    Condition { owner: owner.to_owned(), what, formula, must, follows: false }
}

/// Masses and lengths that must be positive, and what follows from them.
fn of_body(body: &Body, pivot: Option<&Pivot>) -> Vec<Condition> {
    let name = body.name.as_str();
    let properties = body.mass_properties();
    let of = |what: &str, formula: Expr, must| own(name, format!("{what} of `{name}`"), formula, must);
    let mut all = vec![of("mass", properties.mass.clone(), Must::BePositive("kg"))];
    for (index, part) in body.parts.iter().enumerate() {
        let part_name = body.part_name(index);
        let of = |key: &str, size, must| own(name, format!("{key} of {part_name}"), size, must);
        let sizes = part.shape.sizes().into_iter().map(|(key, size)| of(key, size, Must::BePositive("m")));
        let radii = part.shape.radii().into_iter().map(|(key, size)| of(key, size, Must::NotBeNegative("m")));
        all.extend(sizes.chain(radii));
    }
    let restitution = body.restitution.iter().cloned();
    all.extend(restitution.map(|restitution| of("restitution", restitution, Must::LieWithinOne)));
    all.extend(of_friction(name, body.friction.as_ref()));
    // Nothing turns what has no moment of inertia by its form; any other is divided by.
    let must = match is_identically_zero(&properties.inertia) || pivot.is_some() {
        true => Must::NotBeNegative("kg m^2"),
        false => Must::BePositive("kg m^2"),
    };
    let inertia = of("moment of inertia", properties.inertia.clone(), must);
    let about_pivot = pivot.map(|pivot| {
        let about = Coordinates::of(Some(pivot), &properties).inertia(&properties);
        let size = square(&properties.centre) + square(&pivot.point);
        let left = about - NO_LEVER * &properties.mass * size;
        own(name, format!("pivot `{}`", pivot.name), left, Must::Turn)
    });
    let derived = std::iter::once(inertia).chain(about_pivot);
    all.extend(derived.map(|condition| Condition { follows: true, ..condition }));
    all
}

/// What polygons that are met by their edges must be.
fn of_polygons(model: &Model) -> Vec<Condition> {
    let of_surface = |surface: &Surface| {
        let corners = surface.polygon.iter();
        let name = format!("`{}`", surface.name);
        corners.flat_map(|corners| of_polygon([&surface.name, &name], corners)).collect::<Vec<_>>()
    };
    let surfaces = model.surfaces.iter().flat_map(of_surface);
    let bodies = (0..model.bodies.len()).filter(|body| model.meets_by_edges(*body)).flat_map(|body| {
        let body = &model.bodies[body];
        let part = |(index, part): (usize, &Part)| match &part.shape {
            Shape::Polygon { corners } => of_polygon([&body.name, &body.part_name(index)], corners),
            _ => vec![],
        };
        body.parts.iter().enumerate().flat_map(part).collect::<Vec<_>>()
    });
    surfaces.chain(bodies).collect()
}

/// `name` is the owner, and what messages call what the polygon is of.
fn of_polygon([owner, name]: [&str; 2], corners: &[Vector]) -> Vec<Condition> {
    let of = |formula, must| own(owner, format!("polygon of {name}"), formula, must);
    let count = corners.len();
    let area = |a: usize, b: usize, c: usize| {
        let [a, b, c] = [a, b, c].map(|corner| &corners[corner % count]);
        (b - a).cross_planar(&(c - b))
    };
    let fan: Vec<Expr> = (1..count.saturating_sub(1)).map(|corner| area(0, corner, corner + 1)).collect();
    let Some(whole) = fan.iter().cloned().reduce(|sum, next| sum + next) else { return vec![] };
    let sides = (0..count).map(|corner| (&corners[(corner + 1) % count] - &corners[corner]).norm());
    let Some(round) = sides.clone().reduce(|sum, next| sum + next) else { return vec![] };
    let between = whole.abs() / &round;
    let narrowest = sides.fold(between, |a, b| Expr::binary(Binary::Min, a, b)) - STRAIGHT * round;
    // It turns left at every corner, and goes round once: all corners are seen one after the other from the first.
    let turns = (0..count).map(|corner| area(corner, corner + 1, corner + 2));
    let least = fan.into_iter().chain(turns).reduce(|a, b| Expr::binary(Binary::Min, a, b));
    let following = |formula, must| Condition { follows: true, ..of(formula, must) };
    let sides = following(narrowest, Must::HaveSides);
    let convex = least.map(|least| following(least + STRAIGHT * whole.abs(), Must::BeConvex));
    [sides, of(whole, Must::GoRoundLeft)].into_iter().chain(convex).collect()
}

fn of_interaction(interaction: &dyn Interaction) -> Vec<Condition> {
    let name = interaction.name();
    let of = |key: &str, formula: Expr, must| own(name, format!("{key} of `{name}`"), formula, must);
    let coefficients = interaction.nonnegative().into_iter();
    let coefficients = coefficients.map(|(key, formula, unit)| of(key, formula, Must::NotBeNegative(unit)));
    let angles = interaction.angles().into_iter().map(|(key, angle)| of(key, angle, Must::BeAnAngle));
    let length = |vector: Vector| vector.norm();
    let directions = interaction.directions().into_iter();
    let directions =
        directions.map(|(key, vector)| Condition { follows: true, ..of(key, length(vector), Must::Point) });
    coefficients.chain(angles).chain(directions).collect()
}

fn of_surface(surface: &Surface) -> Vec<Condition> {
    let name = surface.name.as_str();
    let of = |key: &str, formula: &Expr, must| own(name, format!("{key} of `{name}`"), formula.clone(), must);
    let law = of_law(name, &surface.law).into_iter();
    let normal = of("normal", &surface.normal.norm(), Must::Point);
    let radius = surface.circle.iter().map(|circle| of("radius", &circle.radius, Must::BePositive("m")));
    law.chain([normal]).chain(radius).chain(of_friction(name, surface.friction.as_ref())).collect()
}

fn of_law(name: &str, law: &ContactLaw) -> Vec<Condition> {
    let of = |key: &str, formula: &Expr, must| own(name, format!("{key} of `{name}`"), formula.clone(), must);
    let coefficient = |(key, formula, _): (&str, &Expr, _)| match key {
        "restitution" => of(key, formula, Must::LieWithinOne),
        "stiffness" => of(key, formula, Must::BePositive("N/m")),
        _ => of(key, formula, Must::NotBeNegative("kg/s")),
    };
    law.dimensions().into_iter().map(coefficient).collect()
}

fn of_contact(contact: &BodyContact) -> Vec<Condition> {
    let name = contact.name.as_str();
    let restitution = contact.restitution.iter().map(|restitution| {
        own(name, format!("restitution of `{name}`"), restitution.clone(), Must::LieWithinOne)
    });
    let compliant = contact.compliant.iter().flat_map(|law| of_law(name, law));
    restitution.chain(compliant).chain(of_friction(name, contact.friction.as_ref())).collect()
}

fn of_friction(name: &str, friction: Option<&Friction>) -> Vec<Condition> {
    let of = |key: &str, formula: Expr, must| own(name, format!("{key} of `{name}`"), formula, must);
    let coefficients = friction.into_iter().flat_map(Friction::coefficients);
    let coefficients = coefficients.map(|(key, formula)| of(key, formula.clone(), Must::NotBeNegative("")));
    let left = friction.map(|friction| &friction.of_rest - &friction.kinetic);
    let left = left.map(|left| of("static friction", left, Must::HoldAsMuch));
    let left = left.map(|condition| Condition { follows: true, ..condition });
    let rolling = friction.and_then(|friction| friction.rolling.clone());
    let rolling = rolling.map(|rolling| of("rolling resistance", rolling, Must::NotBeNegative("m")));
    coefficients.chain(left).chain(rolling).collect()
}

/// What a bowl has more of than what moves in it.
fn of_bowls(model: &Model) -> Vec<Condition> {
    let bowls = model.surfaces.iter().filter_map(|surface| Some((surface, surface.circle.as_ref()?)));
    let mut all = vec![];
    for (surface, circle) in bowls.filter(|(_, circle)| circle.inside) {
        for body in &model.bodies {
            let met = body.features().into_iter().filter(|feature| surface.meets_at(body, feature));
            all.extend(met.map(|feature| {
                let what = format!("radius of `{}`", surface.name);
                own(&surface.name, what, &circle.radius - &feature.radius, Must::LeaveRoom)
            }));
        }
    }
    all
}
