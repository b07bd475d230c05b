//! What is given and what is sought.

use tumble_expr::{Dimension, Expr, Symbol, is_identically_zero};
use tumble_mech::{Body, Shape};
use tumble_ode::Side;
use tumble_report::report::{BodyRow, Identify, Quantity, Text};
use tumble_scene::{Question, Study};

use super::names::{Names, quantity};
use crate::case::Case;
use crate::pipeline::PipelineError;
use crate::tables::{is_angle, unit};

pub(super) fn of(study: &Study, names: &Names, case: &Case) -> Result<Identify, PipelineError> {
    let bodies = study.model.bodies.iter().map(|body| row(study, names, body));
    Ok(Identify {
        intro: vec![],
        scene: super::animation::drawing(study, names, case)?,
        bodies: bodies.collect::<Result<_, _>>()?,
        parameters: parameters(study, names)?,
        initial: initial(names, case),
        sought: sought(study, names),
    })
}

fn row(study: &Study, names: &Names, body: &Body) -> Result<BodyRow, PipelineError> {
    let mass = body.mass_properties();
    let given = |name: &str, symbol: &str, formula: &Expr, unit: &str| -> Result<Quantity, PipelineError> {
        let found = Quantity {
            name: name.into(),
            symbol: Text::symbol(symbol),
            value: quantity(study.number(formula)?, ""),
            unit: unit.to_owned(),
            ..Quantity::default()
        };
        // A number, or a parameter, says all by itself.
        let is_formula = formula.children().len() > 1 && !is_identically_zero(formula);
        Ok(if is_formula { found.by(names.equation(symbol, formula)) } else { found })
    };
    Ok(BodyRow {
        name: body.name.as_str().into(),
        shape: shape(body).into(),
        properties: vec![
            given("mass", "M", &mass.mass, "kg")?,
            given("centre of mass, x", "x_c", mass.centre.x(), "m")?,
            given("centre of mass, y", "y_c", mass.centre.y(), "m")?,
            given("moment of inertia about it", "I", &mass.inertia, "kg*m^2")?,
        ],
    })
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

fn parameters(study: &Study, names: &Names) -> Result<Vec<Quantity>, PipelineError> {
    let all = study.model.parameters.formulas();
    all.map(|(symbol, formula)| {
        let value = study.number(&symbol.clone().into())?;
        let found = Quantity {
            name: symbol.name.to_string().into(),
            symbol: names.label(&symbol.name).into(),
            value: quantity(value, ""),
            unit: unit_of(study, symbol),
            ..Quantity::default()
        };
        Ok(if formula.symbols().is_empty() { found } else { found.by(names.written(formula)) })
    })
    .collect()
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
fn initial(names: &Names, case: &Case) -> Vec<Quantity> {
    let run = &case.run;
    let states = run.equations.states(&run.equations.idle_mode());
    let formulas: Vec<Expr> = states.iter().map(|state| state.clone().into()).collect();
    let values = run.observe(&formulas).ok().and_then(|mut observer| observer.at(0.0, Side::Before));
    let values = values.unwrap_or_default();
    let row = |(symbol, value): (Symbol, f64)| Quantity {
        name: symbol.name.to_string().into(),
        symbol: names.label(&symbol.name).into(),
        value: quantity(value, ""),
        unit: unit(symbol.dimension, is_angle(&symbol)),
        ..Quantity::default()
    };
    states.into_iter().zip(values).map(row).collect()
}

/// What the scene and its figures ask for.
fn sought(study: &Study, names: &Names) -> Vec<Text> {
    let of_time = |text: &str| Text::from(names.label(text)).and("(t)");
    let find = |question: &Question| Text::from(names.label(&question.that.text));
    let mut sought: Vec<Text> = study.finds.iter().map(find).collect();
    for curve in study.plots.iter().flat_map(|plot| &plot.y) {
        let text = of_time(&curve.text);
        if !sought.contains(&text) {
            sought.push(text);
        }
    }
    let forces = study.free_bodies.iter();
    sought.extend(
        forces.map(|sheet| Text::from(format!("the forces on {}", study.model.bodies[sheet.body].name))),
    );
    sought
}
