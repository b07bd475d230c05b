//! What is given and what is sought.

use crate::report::{BodyRow, Identify, Quantity, Text};
use tumble_expr::{Dimension, Expr, Symbol, is_identically_zero};
use tumble_mech::{Body, Extreme, Shape};
use tumble_ode::Side;
use tumble_scene::{Question, Study, When};

use super::alike;
use super::names::{Names, quantity};
use super::sizes;
use crate::figures::symbols;
use crate::results::Case;
use crate::results::CaseError;
use crate::results::{is_angle, unit};

pub(super) fn of(study: &Study, names: &Names, case: &Case) -> Result<Identify, CaseError> {
    Ok(Identify {
        intro: vec![],
        scene: super::animation::drawing(study, names, case)?,
        bodies: bodies(study, names)?,
        parameters: parameters(study, names)?,
        initial: initial(study, names, case),
        sought: sought(study, names),
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
    let named = |(row, names): (BodyRow, Vec<String>)| BodyRow {
        name: alike::listed(&names).into(),
        shape: if names.len() > 1 { Text::from("each ").and(row.shape) } else { row.shape },
        properties: row.properties,
    };
    Ok(rows.into_iter().map(named).collect())
}

fn row(study: &Study, names: &Names, body: &Body) -> Result<BodyRow, CaseError> {
    let mass = body.mass_properties();
    let given = |name: &str, symbol: &str, formula: &Expr, unit: &str| -> Result<Quantity, CaseError> {
        let found = Quantity {
            name: name.into(),
            symbol: Text::symbol(symbol),
            value: quantity(study.number(formula)?, ""),
            unit: unit.to_owned(),
            ..Quantity::default()
        };
        // A number, or a parameter, says all by itself.
        let is_formula =
            formula.children().len() > 1 && !formula.symbols().is_empty() && !is_identically_zero(formula);
        Ok(if is_formula { found.by(names.equation(symbol, formula)) } else { found })
    };
    Ok(BodyRow {
        name: body.name.as_str().into(),
        shape: shape(body).into(),
        properties: vec![
            given("mass", "M", &mass.mass, "kg")?,
            given("centre of mass, x", "x_c", mass.centre.x(), "m")?,
            given("centre of mass, y", "y_c", mass.centre.y(), "m")?,
            inertia(study, names, body, given("moment of inertia about it", "I", &mass.inertia, "kg*m^2")?)?,
        ],
    })
}

/// By the formula of the shape, where the scene has numbers for its sizes.
fn inertia(study: &Study, names: &Names, body: &Body, found: Quantity) -> Result<Quantity, CaseError> {
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

fn parameters(study: &Study, names: &Names) -> Result<Vec<Quantity>, CaseError> {
    let all = study.model.parameters.formulas();
    all.map(|(symbol, formula)| {
        let value = study.number(&symbol.clone().into())?;
        let found = Quantity {
            name: own_name(study, symbol),
            symbol: names.label(&symbol.name).into(),
            value: quantity(value, ""),
            unit: unit_of(study, symbol),
            ..Quantity::default()
        };
        Ok(if formula.symbols().is_empty() { found } else { found.by(names.written(formula)) })
    })
    .collect()
}

/// The name of a parameter that is shown by another symbol; its own says all.
fn own_name(study: &Study, parameter: &Symbol) -> Text {
    let other = study.symbols.contains_key(&*parameter.name);
    if other { parameter.name.to_string().into() } else { Text::default() }
}

/// Nothing for a pure number.
fn unit_of(study: &Study, parameter: &Symbol) -> String {
    let is_angle = study.angles.contains(&*parameter.name);
    if parameter.dimension == Dimension::NONE && !is_angle {
        return String::new();
    }
    unit(parameter.dimension, is_angle)
}

/// The states just before anything happens.
fn initial(study: &Study, names: &Names, case: &Case) -> Vec<Quantity> {
    let run = &case.run;
    let states = run.equations.states(&run.equations.idle_mode());
    let formulas: Vec<Expr> = states.iter().map(|state| state.clone().into()).collect();
    let values = run.observe(&formulas).ok().and_then(|mut observer| observer.at(0.0, Side::Before));
    let values = values.unwrap_or_default();
    let row = |(symbol, value): (Symbol, f64)| Quantity {
        name: symbols::words(study, &symbol.name).unwrap_or_else(|| symbol.name.to_string()).into(),
        symbol: names.label(&symbol.name).into(),
        value: quantity(value, ""),
        unit: unit(symbol.dimension, is_angle(&symbol)),
        ..Quantity::default()
    };
    states.into_iter().zip(values).map(row).collect()
}

/// What the scene and its figures ask for.
fn sought(study: &Study, names: &Names) -> Vec<Text> {
    let called = |text: &str| {
        let words = symbols::words(study, text).map_or_else(String::new, |words| words + " ");
        Text::from(words).and(names.label(text))
    };
    let find = |question: &Question| {
        let when = match question.at {
            When::Extreme { which: Extreme::Greatest, .. } => "the greatest ",
            When::Extreme { which: Extreme::Least, .. } => "the least ",
            When::End => "at the end, ",
            When::At(_) => "at an instant, ",
        };
        Text::from(when).and(called(&question.that.text))
    };
    let mut sought: Vec<Text> = study.finds.iter().map(find).collect();
    for curve in study.plots.iter().flat_map(|plot| &plot.y) {
        let text = match &curve.label {
            Some(label) => Text::from(tumble_drawing::Label::markup(label)),
            None => called(&curve.text),
        };
        let text = text.and(" over time");
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
