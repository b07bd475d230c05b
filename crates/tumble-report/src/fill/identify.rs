//! What is given and what is sought.

use std::collections::{BTreeMap, HashSet};

use crate::report::{BodyRow, Identify, QuantityRow, Text};
use tumble_expr::{Dimension, Expr, Node, Symbol, is_identically_zero};
use tumble_mech::{Body, Shape};
use tumble_ode::Side;
use tumble_scene::{Curve, Question, Study, SweepAxis, Swept};

use super::names::{MASS, Names, quantity};
use super::{alike, sizes};
use crate::figures::{finds, symbols};
use crate::results::{Case, CaseError, is_angle, unit};

/// States that are the components of one vector.
const VECTORS: [(&str, &str, &str); 2] = [(".x", ".y", "centre of mass"), (".vx", ".vy", "velocity")];
/// So many values of a swept parameter are all said.
const MOST_VALUES: usize = 5;
/// A component of less than this part of its vector is zero but for rounding.
const NOTHING: f64 = 1e-15;
/// In a scene of more bodies, what is zero at the start is not listed.
const FEW_BODIES: usize = 2;

pub(super) fn of(study: &Study, names: &Names, case: &Case) -> Result<Identify, CaseError> {
    Ok(Identify {
        intro: vec![],
        scene: super::animation::drawing(study, names, case)?,
        bodies: bodies(study, names)?,
        parameters: parameters(study, names)?,
        initial: initial(study, names, case),
        sought: sought(study),
    })
}

/// A row for each body, one for all that differ by name alone.
fn bodies(study: &Study, names: &Names) -> Result<Vec<BodyRow>, CaseError> {
    let mut rows: Vec<(BodyRow, Vec<String>)> = vec![];
    for body in &study.model.bodies {
        let row = row(study, names, body)?;
        let is_like = |other: &BodyRow| other.shape == row.shape && other.properties == row.properties;
        match rows.iter_mut().find(|(other, _)| is_like(other)) {
            Some((_, names)) => names.push(body.name.clone()),
            None => rows.push((row, vec![body.name.clone()])),
        }
    }
    // In axes from the centre the place of the centre says nothing.
    let is_zero = |(row, _): &(BodyRow, Vec<String>)| {
        row.properties[1..3].iter().all(|one| one.value.to_plain() == "0")
    };
    if rows.iter().all(is_zero) {
        rows.iter_mut().for_each(|(row, _)| drop(row.properties.drain(1..3)));
    }
    let named = |(row, names): (BodyRow, Vec<String>)| BodyRow {
        name: alike::listed(&names.iter().map(|name| symbols::bare(name)).collect::<Vec<_>>()).into(),
        shape: if names.len() > 1 { Text::from("each ").and(row.shape) } else { row.shape },
        properties: row.properties,
    };
    Ok(rows.into_iter().map(named).collect())
}

fn row(study: &Study, names: &Names, body: &Body) -> Result<BodyRow, CaseError> {
    let mass = body.mass_properties();
    let by_mass = names.with_mass();
    let given = |name: &str, symbol: &str, formula: &Expr, unit: &str| -> Result<QuantityRow, CaseError> {
        // The place of the centre is a mean by masses; moments of inertia only become longer by their sum.
        let names = if unit == "m" { &by_mass } else { names };
        let found = QuantityRow {
            name: name.into(),
            symbol: Text::symbol(symbol),
            value: quantity(study.number(formula)?, ""),
            unit: unit.to_owned(),
            ..QuantityRow::default()
        };
        let equation = names.equation(symbol, formula);
        // A number, or a parameter, says all by itself.
        let is_formula = formula.children().len() > 1 && !formula.symbols().is_empty();
        Ok(if is_formula && !equation.text.ends_with("= 0") { found.by(equation) } else { found })
    };
    Ok(BodyRow {
        name: body.name.as_str().into(),
        shape: shape(body).into(),
        properties: vec![
            mass_of(
                study,
                names,
                given("mass", mass_symbol(names, &mass.mass), &mass.mass, "kg")?,
                &mass.mass,
            ),
            given("centre of mass in the body's axes, x", "x_c", mass.centre.x(), "m")?,
            given("centre of mass in the body's axes, y", "y_c", mass.centre.y(), "m")?,
            inertia(study, names, body, given("moment of inertia", "I", &mass.inertia, "kg*m^2")?)?,
        ],
    })
}

/// The parameter that a mass is, else M.
fn mass_symbol<'n>(names: &'n Names, mass: &'n Expr) -> &'n str {
    match mass.node() {
        Node::Symbol(parameter) => names.shown(&parameter.name),
        _ => MASS,
    }
}

/// Of several bodies none has the letter M: what their masses are laws say in full.
fn mass_of(study: &Study, names: &Names, found: QuantityRow, mass: &Expr) -> QuantityRow {
    let is_shared = study.model.bodies.len() > 1 && found.formula.is_some();
    if is_shared { QuantityRow { symbol: Text::default(), ..found.by(names.written(mass)) } } else { found }
}

/// By the formula of the shape, where the scene has numbers for its sizes.
fn inertia(study: &Study, names: &Names, body: &Body, found: QuantityRow) -> Result<QuantityRow, CaseError> {
    let by_shape = sizes::inertia(study, names, body, "I")?;
    Ok(by_shape.map_or(found.clone(), |shown| found.by(shown.symbol).noted(shown.meaning)))
}

fn shape(body: &Body) -> String {
    let one = |shape: &Shape| match shape {
        Shape::Point { .. } => "a point",
        Shape::Rod { .. } => "a thin uniform rod",
        Shape::Disk { .. } => "a uniform disk",
        Shape::Ring { .. } => "a thin ring",
        Shape::Ball { .. } => "a solid ball",
        Shape::Shell { .. } => "a thin spherical shell",
        Shape::Box { .. } => "a uniform box",
        Shape::Polygon { .. } => "a uniform polygon",
    };
    match (&body.parts[..], &body.stated) {
        ([only], None) => one(&only.shape).to_owned(),
        ([], _) => "mass and inertia are given".to_owned(),
        (_, Some(_)) => "its mass and inertia are given, its shape is drawn".to_owned(),
        (parts, None) => format!("{} parts joined rigidly", parts.len()),
    }
}

fn parameters(study: &Study, names: &Names) -> Result<Vec<QuantityRow>, CaseError> {
    let (all, varying) = (study.model.parameters.formulas(), varying(study));
    all.map(|(symbol, formula)| {
        let (value, unit) = read(study.number(&symbol.clone().into())?, unit_of(study, symbol));
        let found = QuantityRow {
            name: study
                .meanings
                .get(&*symbol.name)
                .map(|words| Text::from(tumble_drawing::Label::markup(words)))
                .unwrap_or_default(),
            symbol: names.label(&symbol.name).into(),
            value: quantity(value, ""),
            unit,
            ..QuantityRow::default()
        };
        let found = match swept(study, symbol) {
            Some(values) => QuantityRow { value: values, unit: String::new(), ..found },
            None if formula.symbols().is_empty() => found,
            None => found.by(names.written(formula)),
        };
        // Its value is that of one run.
        let varies = found.formula.is_some() && varying.contains(symbol);
        Ok(if varies { QuantityRow { value: Text::default(), unit: String::new(), ..found } } else { found })
    })
    .collect()
}

/// The values that a swept parameter takes, as legends call them, with their numbers; of many, the first, the last and how many.
fn swept(study: &Study, parameter: &Symbol) -> Option<Text> {
    let values = &axis_of(study, parameter)?.values;
    let label = |index: usize| -> Text {
        let value = values.at(index);
        match value.label.split_once(" = ") {
            Some((_, number)) => number.into(),
            // The user's own words.
            None => match study.number(&value.value) {
                Ok(number) => {
                    let (number, unit) = read(number, unit_of(study, parameter));
                    Text::from(format!("{} (", value.label)).and(quantity(number, &unit)).and(")")
                }
                Err(_) => value.label.into(),
            },
        }
    };
    let count = values.count();
    let all: Vec<Text> = match count {
        0..=MOST_VALUES => (0..count).map(label).collect(),
        _ => vec![label(0), "…".into(), label(count - 1).and(format!(" ({count} values)"))],
    };
    all.into_iter().reduce(|all, next| all.and(", ").and(next))
}

fn axis_of<'a>(study: &'a Study, parameter: &Symbol) -> Option<&'a SweepAxis> {
    let own = Swept::Parameter(parameter.name.to_string());
    study.sweep.iter().find(|axis| axis.of == own)
}

/// Parameters that are swept, or computed from such, which come before them.
fn varying(study: &Study) -> HashSet<&Symbol> {
    let mut found = HashSet::new();
    for (symbol, formula) in study.model.parameters.formulas() {
        let is_swept = axis_of(study, symbol).is_some();
        if is_swept || formula.symbols().iter().any(|part| found.contains(part)) {
            found.insert(symbol);
        }
    }
    found
}

/// Angles are read in degrees.
fn read(value: f64, unit: String) -> (f64, String) {
    if unit == "rad" { (value.to_degrees(), "deg".to_owned()) } else { (value, unit) }
}

/// Nothing for a pure number.
fn unit_of(study: &Study, parameter: &Symbol) -> String {
    let is_angle = study.is_angle(&parameter.name) || is_called_angular(study, parameter);
    if parameter.dimension == Dimension::NONE && !is_angle {
        return String::new();
    }
    unit(parameter.dimension, is_angle)
}

/// Whether the scene calls it an angular velocity or acceleration: of what it is computed its unit does not tell.
fn is_called_angular(study: &Study, parameter: &Symbol) -> bool {
    let rates = [Dimension::ANGULAR_RATE, Dimension::ANGULAR_ACCELERATION];
    let meaning = study.meanings.get(&*parameter.name);
    rates.contains(&parameter.dimension) && meaning.is_some_and(|words| words.starts_with("angular "))
}

/// The states just before anything happens: positions and velocities as vectors, and of many bodies what is not zero.
fn initial(study: &Study, names: &Names, case: &Case) -> Vec<QuantityRow> {
    let run = &case.run;
    let mut states = run.equations.states(&run.equations.idle_mode());
    let points =
        study.model.bodies.iter().filter(|body| is_identically_zero(&body.mass_properties().inertia));
    let turning: Vec<Symbol> = points
        .map(|body| body.kinematics())
        .flat_map(|own| [own.angle_symbol(), own.omega_symbol()])
        .collect();
    // A point does not turn.
    states.retain(|state| !turning.contains(state));
    let formulas: Vec<Expr> = states.iter().map(|state| state.clone().into()).collect();
    let values = run.observe(&formulas).ok().and_then(|mut observer| observer.at(0.0, Side::Before));
    let values: BTreeMap<&str, f64> =
        states.iter().map(|state| &*state.name).zip(values.unwrap_or_default()).collect();
    let rows = states.iter().filter_map(|state| start(study, names, state, &values));
    let (told, zero): (Vec<_>, Vec<_>) =
        rows.partition(|(_, is_zero)| !is_zero || study.model.bodies.len() <= FEW_BODIES);
    let others = QuantityRow { name: "all others".into(), value: "0".into(), ..QuantityRow::default() };
    told.into_iter().map(|(row, _)| row).chain((!zero.is_empty()).then_some(others)).collect()
}

/// A row for a state, or for both components of a vector, and whether it is zero; none for a second component.
fn start(
    study: &Study,
    names: &Names,
    state: &Symbol,
    values: &BTreeMap<&str, f64>,
) -> Option<(QuantityRow, bool)> {
    let vector = VECTORS.iter().find_map(|(x, y, words)| {
        let owner = state.name.strip_suffix(x).or_else(|| state.name.strip_suffix(y))?;
        let other = format!("{owner}{y}");
        values.contains_key(&*other).then_some((owner, other, *words))
    });
    let value = |name: &str| values.get(name).copied().unwrap_or(f64::NAN);
    let found = match vector {
        Some((_, other, _)) if *other == *state.name => return None,
        Some((owner, other, words)) => {
            let of = if study.model.bodies.len() > 1 {
                format!(" of {}", symbols::the(owner))
            } else {
                String::new()
            };
            let pair = |x: Text, y: Text| Text::from("(").and(x).and(", ").and(y).and(")");
            let [x, y] = [value(&state.name), value(&other)];
            let symbol = pair(names.label(&state.name).into(), names.label(&other).into());
            let seen = |value: f64| if value.abs() < NOTHING * x.hypot(y) { 0.0 } else { value };
            let values = [x, y].map(|value| quantity(seen(value), ""));
            let [shown_x, shown_y] = values;
            (format!("{words}{of}"), symbol, pair(shown_x, shown_y), x == 0.0 && y == 0.0)
        }
        None => {
            let words = symbols::words(study, &state.name).unwrap_or_else(|| state.name.to_string());
            let own = value(&state.name);
            let shown =
                if is_angle(state) && state.dimension == Dimension::NONE { own.to_degrees() } else { own };
            (words, names.label(&state.name).into(), quantity(shown, ""), own == 0.0)
        }
    };
    let (name, symbol, value, is_zero) = found;
    let unit = read(0.0, unit(state.dimension, is_angle(state))).1;
    Some((QuantityRow { name: name.into(), symbol, value, unit, ..QuantityRow::default() }, is_zero))
}

/// What the scene and its figures ask for.
fn sought(study: &Study) -> Vec<Text> {
    let all = symbols::all(study);
    let called = |text: &str| Text::from(symbols::called(study, &all, text));
    let asked = |questions: &[Question]| {
        let others = questions[1..].iter().map(|question| finds::that(study, question));
        let first = Text::from(finds::called(study, &questions[0]));
        others.fold(first, |all, other| all.and(", ").and(other))
    };
    let mut sought: Vec<Text> = finds::at_once(study).map(asked).collect();
    let named = |curve: &Curve| match &curve.label {
        Some(label) => Text::from(tumble_drawing::Label::markup(label)),
        None => called(&curve.text),
    };
    for (plot, curve) in study.plots.iter().flat_map(|plot| plot.y.iter().map(move |curve| (plot, curve))) {
        let over = plot.x.as_ref().map_or_else(|| "time".into(), named);
        let text = named(curve).and(" over ").and(over);
        if !sought.contains(&text) {
            sought.push(text);
        }
    }
    let forces = study.free_bodies.iter();
    sought.extend(forces.map(|sheet| {
        Text::from(format!("the forces on {}", symbols::the(&study.model.bodies[sheet.body].name)))
    }));
    sought
}
