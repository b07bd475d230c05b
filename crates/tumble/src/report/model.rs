//! Forces, laws and equations of motion, as they were integrated.

use tumble_expr::{Expr, Graph, Symbol, Vector, is_identically_zero};
use tumble_math::{Left, Math as Formula};
use tumble_mech::{Equations, Law, Mode, Term};
use tumble_report::report::{Block, BodyModel, ForceRow, Math, Model, Picture, Text};
use tumble_scene::{FreeBody, Instant, Study};

use super::equations;
use super::names::{Names, math, words};
use crate::case::Case;
use crate::free_bodies;
use crate::pipeline::PipelineError;
use crate::symbols;

/// Formulas of more signs than these are only counted.
const MOST_SIGNS_IN_TABLE: usize = 120;
/// Formulas of more operations than this come to more signs than are read anywhere: they are not even brought into a short form,
/// which takes long.
pub(super) const MOST_OPERATIONS: usize = 300;

pub(super) fn of(study: &Study, names: &Names, case: &Case) -> Result<Model, PipelineError> {
    let bodies = (0..study.model.bodies.len()).map(|body| one(study, names, case, body));
    Ok(Model {
        intro: vec![],
        assumptions: assumptions(study),
        bodies: bodies.collect::<Result<_, _>>()?,
        modes: equations::modes(study, names, case),
    })
}

/// What the laws in use take for granted.
fn assumptions(study: &Study) -> Vec<Text> {
    let model = &study.model;
    let said = [
        (true, "The bodies are rigid and move in one plane."),
        (
            matches!(model.gravity, tumble_mech::Gravity::Horizontal(_)),
            "The plane is horizontal: weight and support cancel out of it.",
        ),
        (!model.pivots.is_empty() && model.joints.is_empty(), "Pivots have no friction."),
        (!model.joints.is_empty(), "Pivots and joints have no friction, and do not give way."),
        (
            model.joints.iter().any(|joint| joint.from.is_some()),
            "What joins bodies on the way does so in no time: an impact without rebound.",
        ),
        (
            !model.surfaces.is_empty() && model.surfaces.iter().all(|surface| surface.friction.is_none()),
            "Surfaces have no friction: they push along their normals only.",
        ),
        (
            model.surfaces.iter().any(|surface| surface.friction.is_some()),
            "Friction is dry: its coefficients do not depend on the speed, the pressure or the time at rest.",
        ),
        (model.surfaces.iter().any(|s| s.law.is_rigid()), "An impact on a rigid surface takes no time."),
    ];
    said.into_iter().filter(|(holds, _)| *holds).map(|(_, words)| words.into()).collect()
}

fn one(study: &Study, names: &Names, case: &Case, body: usize) -> Result<BodyModel, PipelineError> {
    let names = &names.of_body(body);
    Ok(BodyModel {
        name: study.model.bodies[body].name.as_str().into(),
        diagrams: diagrams(study, case, body)?,
        forces: forces(study, names, case, body),
        laws: vec![laws(study, names, case, body)],
    })
}

fn diagrams(study: &Study, case: &Case, body: usize) -> Result<Vec<Picture>, PipelineError> {
    let asked: Vec<&FreeBody> = study.free_bodies.iter().filter(|sheet| sheet.body == body).collect();
    let time = busiest(case, body);
    let own = FreeBody {
        name: String::new(),
        title: Some(format!("Forces on {}", study.model.bodies[body].name)),
        body,
        at: vec![(Instant { text: String::new(), time: time * tumble_expr::units::S }, String::new())],
    };
    let sheets = if asked.is_empty() { vec![&own] } else { asked };
    let picture = |sheet: &FreeBody| -> Result<Picture, PipelineError> {
        let svg = free_bodies::sheet(study, case, sheet)?.svg();
        let picture = Picture::new(svg, Text::default());
        Ok(if sheet.name.is_empty() { picture } else { picture.stored(format!("{}.svg", sheet.name)) })
    };
    sheets.into_iter().map(picture).collect()
}

/// The middle of the first step on which most loads act on a body, s: worth a diagram where the study asks for none.
fn busiest(case: &Case, body: usize) -> f64 {
    let run = case.run.of_body(body);
    let trajectory = run.trajectory();
    let loads = |mode: &Mode| {
        let terms = case.run.equations.shown_terms(mode);
        loads_of(&terms, body).len()
    };
    let by_mode: Vec<usize> = trajectory.modes.iter().map(loads).collect();
    let most = trajectory.pieces.iter().map(|piece| by_mode[piece.mode]).max();
    let found = trajectory.pieces.iter().find(|piece| Some(by_mode[piece.mode]) == most);
    found.map_or(0.0, |piece| 0.5 * (piece.start + piece.end))
}

/// A row for each load on a body, in the first mode in which it acts.
fn forces(study: &Study, names: &Names, case: &Case, body: usize) -> Vec<ForceRow> {
    let equations = &case.run.equations;
    let mut seen: Vec<String> = vec![];
    let mut rows = vec![];
    for mode in &case.run.of_body(body).trajectory().modes {
        let terms = equations.shown_terms(mode);
        for load in loads_of(&terms, body) {
            if !seen.contains(&load) {
                let own: Vec<&Term> =
                    terms.iter().filter(|term| term.body == body && term.load == load).collect();
                rows.push(row(study, names, equations, &own));
                seen.push(load);
            }
        }
    }
    rows
}

fn loads_of(terms: &[Term], body: usize) -> Vec<String> {
    let mut loads: Vec<String> = vec![];
    for term in terms.iter().filter(|term| term.body == body) {
        if !loads.contains(&term.load) {
            loads.push(term.load.clone());
        }
    }
    loads
}

fn row(study: &Study, names: &Names, equations: &Equations, terms: &[&Term]) -> ForceRow {
    let term = terms[0];
    let symbol = math(&Formula::symbol(&symbols::force(study, &term.load, term.law)));
    if terms.len() > 1 {
        let sum = format!("sum over {} points along the body", terms.len());
        let row =
            ForceRow { name: name_of(term).into(), symbol, formula: words(&sum), ..ForceRow::default() };
        return ForceRow {
            point: "along the body".into(),
            torque: words("sum of the points' torques"),
            ..row
        };
    }
    let formula = match term.law {
        Law::Reaction => words("holds the point in its place"),
        law if law.is_couple() => {
            readable(std::slice::from_ref(&term.couple), |couple| names.formula(&couple[0]))
        }
        _ => readable(term.force.components(), |force| vector(names, force)),
    };
    ForceRow {
        name: name_of(term).into(),
        symbol,
        formula,
        point: point(equations, term).into(),
        torque: match term.law {
            Law::Reaction => words("r × F"),
            _ => readable(std::slice::from_ref(&term.torque()), |torque| names.formula(&torque[0])),
        },
    }
}

/// The formula, or words where it is too long for a table.
fn readable(formulas: &[Expr], shown: impl Fn(&[Expr]) -> Math) -> Math {
    let operations = operations(formulas);
    if operations > MOST_OPERATIONS {
        return words(&format!("a formula of {operations} operations"));
    }
    let shown = shown(formulas);
    match shown.text.chars().count() {
        signs if signs > MOST_SIGNS_IN_TABLE => words(&format!("a formula of {signs} signs")),
        _ => shown,
    }
}

/// How many different operations, numbers and names formulas consist of.
pub(super) fn operations<'a>(formulas: impl IntoIterator<Item = &'a Expr>) -> usize {
    let formulas: Vec<Expr> = formulas.into_iter().cloned().collect();
    let mut graph = Graph::default();
    graph.import(&formulas);
    graph.nodes().len()
}

fn name_of(term: &Term) -> String {
    match term.law {
        Law::Weight => "weight".to_owned(),
        Law::Contact => format!("contact {}", term.load),
        Law::Friction => format!("friction {}", symbols::rubbed(&term.load)),
        Law::Reaction => format!("reaction of {}", term.load),
        _ => term.load.clone(),
    }
}

/// Where a force acts, in words.
fn point(equations: &Equations, term: &Term) -> String {
    if term.arm.components().iter().all(is_identically_zero) {
        return "centre of mass".to_owned();
    }
    let body = &equations.model().bodies[term.body];
    let is_there = |(_, at): &&(String, Vector)| {
        let arm = body.at(at).world_arm();
        (&arm - &term.arm).components().iter().all(is_identically_zero)
    };
    match (term.law, body.points.iter().find(is_there)) {
        (_, Some((name, _))) => format!("{}.{name}", body.name),
        (Law::Contact | Law::Friction, None) => symbols::rubbed(&term.load).to_owned(),
        (Law::Reaction, None) => term.load.clone(),
        (law, None) if law.is_couple() => "everywhere".to_owned(),
        _ => "its point of action".to_owned(),
    }
}

fn vector(names: &Names, components: &[Expr]) -> Math {
    let part = |component: &Expr| -> Formula {
        let shown = names.notation().clone().without_automatic_names().formula(component);
        match shown {
            Ok(shown) => shown.lines.into_iter().next().map_or(Formula::Row(vec![]), |line| line.right),
            Err(error) => Formula::Text(error.to_string()),
        }
    };
    math(&Formula::Matrix(components.iter().map(|component| vec![part(component)]).collect()))
}

/// `M A = sum F` by components and `I alpha = sum tau`, each load by its symbol.
fn laws(study: &Study, names: &Names, case: &Case, body: usize) -> Block {
    let run = case.run.of_body(body);
    let modes = run.trajectory().modes.iter();
    let terms = modes.flat_map(|mode| case.run.equations.shown_terms(mode));
    let terms = distinct(terms.filter(|term| term.body == body).collect());
    laws_of(study, names, case, (body, &terms), "Newton's laws")
}

pub(super) fn laws_of(
    study: &Study,
    names: &Names,
    case: &Case,
    (body, terms): (usize, &[Term]),
    title: &str,
) -> Block {
    let kinematics = study.model.bodies[body].kinematics();
    let mass = case.run.equations.mass_properties(body);
    let component = |axis: usize| {
        let parts = terms.iter().filter(|term| !is_identically_zero(&term.force[axis]));
        let letter = ["x", "y"][axis];
        let symbol = |term: &Term| -> Expr {
            Symbol::new(
                symbols::below(&symbols::force(study, &term.load, term.law), letter),
                tumble_expr::Dimension::FORCE,
            )
            .into()
        };
        parts.map(symbol).fold(Expr::zero(), |sum, force| sum + force)
    };
    let torque = terms.iter().filter(|term| !is_identically_zero(&term.torque()));
    let torque = torque.map(|term| {
        let name = format!("tau_{}", symbols::force(study, &term.load, term.law).replace('_', ","));
        Expr::from(Symbol::new(name, tumble_expr::Dimension::TORQUE))
    });
    let torque = torque.fold(Expr::zero(), |sum, torque| sum + torque);
    let m: Expr = Symbol::new("M", tumble_expr::Dimension::MASS).into();
    let inertia: Expr = Symbol::new("I", tumble_expr::Dimension::INERTIA).into();
    let [ax, ay] = kinematics.acceleration_symbols();
    let left =
        |factor: &Expr, symbol: &Symbol| Left::times(factor, Formula::symbol(names.shown(&symbol.name)));
    // The right sides are accelerations: the factor of the left side is multiplied on.
    let mut lines = vec![(left(&m, &ax), component(0) / &m), (left(&m, &ay), component(1) / &m)];
    if !is_identically_zero(&mass.inertia) {
        lines.push((left(&inertia, &kinematics.alpha_symbol()), torque / &inertia));
    }
    names.block(title, &lines)
}

/// The first term of each load.
pub(super) fn distinct(terms: Vec<Term>) -> Vec<Term> {
    let mut found: Vec<Term> = vec![];
    for term in terms {
        if !found.iter().any(|known| known.load == term.load) {
            found.push(term);
        }
    }
    found
}
