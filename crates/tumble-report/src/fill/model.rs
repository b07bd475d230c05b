//! Forces, laws and equations of motion, as they were integrated.

use crate::report::{Block, BodyModel, ForceRow, ModelPart, Picture, Text, Typeset};
use tumble_expr::{Expr, Graph, Node, Symbol, Unary, Vector, Written, is_identically_zero};
use tumble_mech::{
    Application, AppliedImpulse, Equations, Frame, Friction, Law, NORMAL, Pair, Statement, TANGENT, Term,
    rotated,
};
use tumble_notation::{Left, Math, Operator};
use tumble_scene::{FreeBody, Study};

use super::alike::{self, Kind};
use super::equations;
use super::names::{MASS, Names, math, words};
use super::once::{self, BY_LAWS, BY_NAME};
use super::words::spoken;
use crate::figures::{air, captions, free_bodies, instants, symbols};
use crate::results::Case;
use crate::results::CaseError;

/// Runs of a sweep among which one is looked for whose diagrams show most.
const MOST_LOOKED_AT: usize = 12;
/// A torque of more signs than these is said by its arm and its force.
const MOST_SIGNS_IN_TABLE: usize = 36;
/// Formulas of more operations than this come to more signs than are read anywhere: they are not even brought into a short form,
/// which takes long.
pub(super) const MOST_OPERATIONS: usize = 300;

pub(super) fn of(study: &Study, names: &Names, cases: &[Case]) -> Result<ModelPart, CaseError> {
    let (case, drawn) = (&cases[0], if cases.len() > 1 { fullest(study, cases)? } else { &cases[0] });
    let kinds = alike::kinds(study, case);
    let mut said = vec![];
    let bodies = kinds.iter().map(|kind| one(study, names, [case, drawn], kind, &mut said));
    let bodies: Vec<BodyModel> = bodies.collect::<Result<_, _>>()?;
    let mut modes = equations::modes(study, names, case, &kinds);
    // What the laws have said the equations do not say again.
    let rows = bodies.iter().flat_map(|body| &body.forces).flat_map(|row| row.law.iter().chain(&row.torque));
    let laws = bodies.iter().flat_map(|body| &body.laws).flat_map(|law| &law.definitions);
    let said: Vec<&Typeset> = rows.chain(laws.map(|definition| &definition.symbol)).collect();
    let equations = modes.iter_mut().flat_map(|mode| &mut mode.equations);
    equations.for_each(|block| block.definitions.retain(|definition| !said.contains(&&definition.symbol)));
    let laws: Vec<&Typeset> = bodies.iter().flat_map(|body| &body.laws).flat_map(|law| &law.lines).collect();
    let acts = bodies.iter().any(|body| !body.forces.is_empty());
    once::say_once(&mut modes, &laws, if acts { BY_NAME } else { BY_LAWS });
    Ok(ModelPart { intro: vec![], assumptions: assumptions(study), bodies, modes })
}

/// What the laws in use take for granted.
fn assumptions(study: &Study) -> Vec<Text> {
    let model = &study.model;
    let (surfaces, contacts) = (model.surfaces.iter(), model.contacts.iter());
    let of_bodies = model.bodies.iter().any(|body| body.friction.is_some());
    let of_pairs = contacts.clone().any(|contact| contact.friction.is_some());
    let is_rough = of_bodies || of_pairs || surfaces.clone().any(|surface| surface.friction.is_some());
    let frictions =
        surfaces.clone().map(|surface| &surface.friction).chain(contacts.clone().map(|own| &own.friction));
    let resists = frictions.flatten().any(|friction| friction.rolling.is_some());
    // Else there is one only who could say it.
    let is_said_by_several = of_bodies
        || model.bodies.iter().any(|body| body.restitution.is_some())
        || contacts.clone().any(|contact| contact.surfaces(model).next().is_some());
    let said = [
        (true, "The bodies are rigid and move in one plane."),
        (
            matches!(model.gravity, tumble_mech::Gravity::Horizontal(_)),
            "The plane is horizontal: weight and support cancel out of it.",
        ),
        (!model.pivots.is_empty() && model.joints.is_empty(), "Pivots have no friction."),
        (!model.joints.is_empty(), "Pivots and joints are rigid and have no friction."),
        (
            model.joints.iter().any(|joint| joint.from.is_some()),
            "Bodies that are joined on the way are joined in an instant, by an impact without rebound.",
        ),
        (
            !model.surfaces.is_empty() && !is_rough,
            "Surfaces have no friction: they push along their normals only.",
        ),
        (
            is_rough,
            "Friction is dry: its coefficients do not depend on the speed, the pressure or the time at rest.",
        ),
        (resists, "Rolling resistance is a couple of lasting contacts; impacts know nothing of it."),
        (
            is_said_by_several,
            "Restitution and friction are those said for the pair; where nothing is, a body's own (of two bodies the lesser), else the surface's.",
        ),
        (surfaces.clone().any(|s| s.law.is_rigid()), "An impact on a rigid surface takes no time."),
    ];
    said.into_iter().filter(|(holds, _)| *holds).map(|(_, words)| words.into()).collect()
}

fn one(
    study: &Study,
    names: &Names,
    [case, drawn]: [&Case; 2],
    kind: &Kind,
    said: &mut Vec<String>,
) -> Result<BodyModel, CaseError> {
    let body = kind.shown;
    let names = &names.of_body(body);
    Ok(BodyModel {
        name: Text::from(kind.name(study)).capitalised(),
        diagrams: diagrams(study, drawn, body, said)?,
        forces: forces(study, names, case, body),
        laws: vec![laws(study, names, case, body)],
    })
}

/// Those that the scene asks for, else at instants that tell something.
fn diagrams(
    study: &Study,
    case: &Case,
    body: usize,
    said: &mut Vec<String>,
) -> Result<Vec<Picture>, CaseError> {
    let name = &study.model.bodies[body].name;
    let asked: Vec<&FreeBody> = study.free_bodies.iter().filter(|sheet| sheet.body == body).collect();
    let own = FreeBody {
        name: String::new(),
        title: Some(format!("Forces on {}", symbols::the(name))),
        body,
        at: if asked.is_empty() { instants::of(study, case, body)? } else { vec![] },
    };
    let sheets = if asked.is_empty() { vec![&own] } else { asked };
    let mut picture = |asked: &FreeBody| -> Result<Picture, CaseError> {
        let sheet = free_bodies::sheet(study, case, asked)?;
        let picture = Picture::new(sheet.svg(), captions::free_bodies(study, &sheet, name, said));
        Ok(if asked.name.is_empty() { picture } else { picture.stored(format!("{}.svg", asked.name)) })
    };
    sheets.into_iter().map(&mut picture).collect()
}

/// The run for the diagrams: the first of those in which most loads are there.
fn fullest<'a>(study: &Study, cases: &'a [Case]) -> Result<&'a Case, CaseError> {
    let mut best = (0, &cases[0]);
    for case in cases.iter().take(MOST_LOOKED_AT) {
        let loads = instants::loads(case, study.model.bodies.len())?;
        if loads > best.0 {
            best = (loads, case);
        }
    }
    Ok(best.1)
}

/// A row for each load on a body, in the first mode in which it acts.
fn forces(study: &Study, names: &Names, case: &Case, body: usize) -> Vec<ForceRow> {
    let equations = &case.run.equations;
    let mut seen: Vec<String> = vec![];
    let mut rows = vec![];
    for mode in &case.run.of_body(body).trajectory().modes {
        let (terms, statements) = (equations.shown_terms(mode), equations.shown_statements(mode));
        for load in loads_of(&terms, body) {
            if !seen.contains(&load) {
                let own: Vec<&Term> =
                    terms.iter().filter(|term| term.body == body && term.load == load).collect();
                let stated = statements.iter().find(|stated| stated.body == body && stated.load == load);
                // What a contact does to its other body is stated for the first.
                let stated = stated.or_else(|| statements.iter().find(|stated| stated.load == load));
                rows.push(row(study, names, equations, &own, stated));
                seen.push(load);
            }
        }
    }
    rows.extend(
        study
            .model
            .impulses
            .iter()
            .filter(|one| one.body == study.model.bodies[body].name)
            .map(|one| impulse(study, names, one)),
    );
    rows
}

/// A row for an impulse that an event applies.
fn impulse(study: &Study, names: &Names, applied: &AppliedImpulse) -> ForceRow {
    let kinematics =
        study.model.bodies[study.model.body_index(&applied.body).unwrap_or_default()].kinematics();
    let name =
        format!("impulse of {}, when “{}” happens", symbols::the(&applied.name), spoken(&applied.when));
    let symbol = symbols::impulse(symbols::last(&applied.name));
    let stated = |left: &str, right: Written| names.stated(Math::symbol(left), &right, &applied.name);
    let (law, point, torque) = match &applied.application {
        Application::Torque(couple) => {
            (stated(&symbol, Written::Scalar(couple.clone())), "", vec![math(&Math::symbol(&symbol))])
        }
        Application::Force { at, force, frame } => {
            let turned =
                if *frame == Frame::Body { rotated(force, &kinematics.angle()) } else { force.clone() };
            let arm = Written::named(&symbols::arm(&symbol), Written::Vector(at.arm(&kinematics)));
            let acts = Written::named(&symbol, Written::Vector(turned.clone()));
            let torque =
                names.stated(Math::symbol(&symbols::torque(&symbol)), &arm.cross(acts), &applied.name);
            (
                stated(&symbol, Written::Vector(turned)),
                "its point of action",
                torque.into_iter().take(2).collect(),
            )
        }
    };
    ForceRow { name: name.into(), symbol: math(&Math::symbol(&symbol)), law, point: point.into(), torque }
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

fn row(
    study: &Study,
    names: &Names,
    equations: &Equations,
    terms: &[&Term],
    stated: Option<&Statement>,
) -> ForceRow {
    let term = terms[0];
    let symbol = symbols::force(study, &term.load, term.law);
    let law = law(study, names, equations, term, stated, &symbol);
    let mut torque = torque(names, terms, stated, &symbol);
    torque.retain(|line| !law.iter().skip(1).any(|said| said == line));
    ForceRow {
        name: name_of(study, equations, term).into(),
        symbol: math(&signed(&symbol, is_opposite(term) || is_on_other(equations, term))),
        law,
        point: if terms.len() > 1 || stated.is_some_and(is_spread) {
            "every point of it".into()
        } else {
            point(equations, term).into()
        },
        torque,
    }
}

/// Whether a law is a sum along lines.
fn is_spread(stated: &Statement) -> bool {
    fn has_integral(written: &Written) -> bool {
        match written {
            Written::Integral { .. } => true,
            Written::Sum(terms) => terms.iter().any(|(_, term)| has_integral(term)),
            Written::Product(factors) => factors.iter().any(has_integral),
            _ => false,
        }
    }
    stated.force.as_ref().is_some_and(has_integral)
}

/// What the law says; where it says nothing, the components.
fn law(
    study: &Study,
    names: &Names,
    equations: &Equations,
    term: &Term,
    stated: Option<&Statement>,
    symbol: &str,
) -> Vec<Typeset> {
    let said = stated.and_then(|stated| stated.force.as_ref().or(stated.torque.as_ref()));
    let is_of = |pair: &&Pair| pair.name == symbols::rubbed(&term.load);
    let touches = matches!(term.law, Law::Contact | Law::Friction | Law::Rolling);
    if let Some(pair) = equations.pairs().iter().find(is_of).filter(|_| touches) {
        return contact(names, pair, term, said, (symbol, is_on_other(equations, term)));
    }
    let right = match (said, term.law) {
        (None, Law::Reaction) if is_identically_zero(&term.couple) => {
            return vec![words("holds the point in its place")];
        }
        (None, Law::Reaction) => {
            return vec![words("holds the point in its place, and the body at its angle")];
        }
        (None, law) if law.is_couple() => Written::Scalar(term.couple.clone()),
        (None, _) => Written::Vector(term.force.clone()),
        (Some(said), _) => said.clone(),
    };
    if let (Some(_), Written::Vector(vector)) = (symbols::named(study, &term.load), &right) {
        // Its symbol is in it: an equation would say it twice.
        return vec![math(&names.vector(vector))];
    }
    let names = if term.law == Law::Weight { &names.with_mass() } else { names };
    let mut lines = names.stated(Math::symbol(symbol), &right, &term.load);
    // The table of bodies says it.
    lines.retain(|line| !line.text.starts_with(&format!("{MASS} = ")));
    lines
}

/// What a contact pushes with along the normal, or rubs with along the surface; nothing says how strongly a rigid one pushes.
fn contact(
    names: &Names,
    pair: &Pair,
    term: &Term,
    said: Option<&Written>,
    (symbol, is_on_other): (&str, bool),
) -> Vec<Typeset> {
    let letter = if term.law == Law::Friction { TANGENT } else { NORMAL };
    let acts = Math::Product(vec![Math::symbol(symbol), Math::symbol(letter)]);
    let acts = if is_on_other { Math::Row(vec![Math::Operator(Operator::Negative), acts]) } else { acts };
    if term.law == Law::Rolling {
        return resistance(names, pair, (symbol, is_on_other));
    }
    let Some(said) = said else { return vec![math(&acts)] };
    let mut lines = names.stated(acts.clone(), said, &term.load);
    if pair.law.is_rigid() || is_on_other || term.law == Law::Friction {
        // It says that it is along a direction, and no more; how strongly is said for the first body.
        lines[0] = math(&acts);
    }
    let friction = pair.friction.as_ref().filter(|_| term.law == Law::Friction);
    lines.extend(friction.into_iter().flat_map(|friction| coulomb(names, pair, friction, symbol)));
    lines
}

/// Friction while it slips with the rate s, and its bound while it does not.
fn coulomb(names: &Names, pair: &Pair, friction: &Friction, symbol: &str) -> Vec<Typeset> {
    let slip = Symbol::new("s", tumble_expr::Dimension::SPEED);
    let way = Expr::unary(Unary::Sign, slip.into());
    let normal: Expr = pair.force_symbol().into();
    let slips = names.equation(symbol, &-(&friction.kinetic * &normal * way));
    let own = Math::Bars(Box::new(Math::symbol(symbol)));
    let holds = names.relation(own, Operator::LessEqual, &(&friction.of_rest * &normal));
    let with_speed = Math::Row(vec![Math::Text("while it slips at\u{a0}".to_owned()), Math::symbol("s")]);
    vec![slips, math(&with_speed), holds, words("while it sticks")]
}

/// The couple against rolling while it turns with the rate omega against the other, and its bound while it does not.
fn resistance(names: &Names, pair: &Pair, (symbol, is_on_other): (&str, bool)) -> Vec<Typeset> {
    let Some(length) = pair.friction.as_ref().and_then(|friction| friction.rolling.as_ref()) else {
        return vec![];
    };
    let own = Math::symbol(symbol);
    if is_on_other {
        return vec![math(&Math::Row(vec![Math::Operator(Operator::Negative), own]))];
    }
    let turning = Symbol::new("omega", tumble_expr::Dimension::ANGULAR_RATE);
    let most = length * Expr::from(pair.force_symbol());
    let turns = names.equation(symbol, &-(&most * Expr::unary(Unary::Sign, turning.into())));
    let holds = names.relation(Math::Bars(Box::new(own.clone())), Operator::LessEqual, &most);
    vec![
        math(&own),
        turns,
        words("while it turns with ω against what it rolls on"),
        holds,
        words("while it does not"),
    ]
}

/// Whether it is the opposite of what a joint's symbol says: on the other of its bodies.
fn is_opposite(term: &Term) -> bool {
    let is_opposite = |component: &Expr| {
        let symbols = component.symbols();
        let multiplier = symbols.iter().next().filter(|_| symbols.len() == 1);
        multiplier.is_some_and(|multiplier| is_identically_zero(&(component.derivative(multiplier) + 1)))
    };
    term.law == Law::Reaction && term.force.components().iter().any(is_opposite)
}

/// Whether it is what a contact does to the second of its bodies.
fn is_on_other(equations: &Equations, term: &Term) -> bool {
    let touches = matches!(term.law, Law::Contact | Law::Friction | Law::Rolling);
    let mut pairs = equations.pairs().iter().filter(|pair| pair.name == symbols::rubbed(&term.load));
    touches && pairs.any(|pair| pair.other == Some(term.body))
}

/// A symbol, or its opposite.
fn signed(symbol: &str, is_opposite: bool) -> Math {
    let symbol = Math::symbol(symbol);
    match is_opposite {
        true => Math::Row(vec![Math::Operator(Operator::Negative), symbol]),
        false => symbol,
    }
}

/// The torque about the centre of mass: as the law says it, by its formula if that is short, or as arm and force.
fn torque(names: &Names, terms: &[&Term], stated: Option<&Statement>, symbol: &str) -> Vec<Typeset> {
    let term = terms[0];
    let own = Math::symbol(&symbols::torque(symbol));
    if let Some(Statement { force: Some(_), torque: Some(torque), .. }) = stated {
        return names.stated(own, torque, &term.load).into_iter().take(1).collect();
    }
    if term.law.is_couple() {
        return vec![math(&Math::symbol(symbol))];
    }
    let has_arm = !term.arm.components().iter().all(is_identically_zero);
    if !has_arm {
        return vec![names.formula(&term.couple)];
    }
    if term.law != Law::Reaction {
        let formula = names.formula(&term.torque());
        if formula.text.chars().count() <= MOST_SIGNS_IN_TABLE {
            let is_zero = is_identically_zero(&term.torque());
            if is_zero || formula.text == "0" {
                return vec![formula];
            }
            let arm = Written::Vector(term.arm.clone());
            let arm = names.stated(Math::symbol(&symbols::arm(symbol)), &arm, &term.load);
            return [vec![names.equation(&symbols::torque(symbol), &term.torque())], arm].concat();
        }
    }
    let arm = Written::named(&symbols::arm(symbol), Written::Vector(term.arm.clone()));
    let force = Written::Scalar(Symbol::new(symbol, tumble_expr::Dimension::FORCE).into());
    let force = if is_opposite(term) { force.negative() } else { force };
    let force = match direction(term, stated) {
        Some(direction) => Written::Product(vec![force, direction]),
        None => force,
    };
    let moment = arm.cross(force);
    let whole = match is_identically_zero(&term.couple) {
        true => moment,
        false => {
            // The couple on the second body is the opposite of the symbol.
            let is_minus = matches!(term.couple.node(), Node::Unary(Unary::Neg, _));
            let couple = if is_minus { -&term.couple } else { term.couple.clone() };
            Written::Sum(vec![(false, moment), (is_minus, Written::Scalar(couple))])
        }
    };
    names.stated(own, &whole, &term.load)
}

/// Along which unit vector a contact pushes or rubs: its symbol is a number.
fn direction(term: &Term, stated: Option<&Statement>) -> Option<Written> {
    let letter = match term.law {
        Law::Contact => NORMAL,
        Law::Friction => TANGENT,
        _ => return None,
    };
    let unit = air::named(stated?.force.as_ref()?, letter)?;
    Some(Written::named(letter, unit.clone()))
}

/// How many different operations, numbers and names formulas consist of.
pub(super) fn operations<'a>(formulas: impl IntoIterator<Item = &'a Expr>) -> usize {
    let formulas: Vec<Expr> = formulas.into_iter().cloned().collect();
    let mut graph = Graph::default();
    graph.import(&formulas);
    graph.nodes().len()
}

fn name_of(study: &Study, equations: &Equations, term: &Term) -> String {
    let mut pairs = equations.pairs().iter();
    let pair = pairs.find(|pair| pair.name == symbols::rubbed(&term.load));
    match (term.law, pair) {
        (Law::Weight, _) => "weight".to_owned(),
        (Law::Contact, Some(pair)) => super::words::contact(study, pair, term.body),
        (Law::Friction, Some(_)) => "friction".to_owned(),
        (Law::Rolling, Some(_)) => "rolling resistance".to_owned(),
        (Law::Reaction, _) => format!("reaction of {}", symbols::joint(&term.load)),
        _ => spoken(&term.load),
    }
}

/// Where a force acts, in words.
fn point(equations: &Equations, term: &Term) -> String {
    if term.law.is_couple() {
        return String::new();
    }
    if term.arm.components().iter().all(is_identically_zero) {
        return "the centre of mass".to_owned();
    }
    let body = &equations.model().bodies[term.body];
    let is_there = |(_, at): &&(String, Vector)| {
        let arm = body.at(at).world_arm();
        (&arm - &term.arm).components().iter().all(is_identically_zero)
    };
    match (term.law, body.points.iter().find(is_there)) {
        (_, Some((name, _))) if equations.model().bodies.len() == 1 => symbols::the(name),
        (_, Some((name, _))) => format!("{} of {}", symbols::the(name), symbols::the(&body.name)),
        (Law::Contact | Law::Friction, None) => "the point of contact".to_owned(),
        (Law::Reaction, None) => symbols::joint(&term.load),
        _ => "its point of action".to_owned(),
    }
}

/// `M A = sum F` by components and `I alpha = sum tau`, each load by its symbol.
fn laws(study: &Study, names: &Names, case: &Case, body: usize) -> Block {
    let run = case.run.of_body(body);
    let modes = run.trajectory().modes.iter();
    let terms = modes.flat_map(|mode| case.run.equations.shown_terms(mode));
    let terms = distinct(terms.filter(|term| term.body == body).collect());
    laws_of(study, names, case, (body, &terms), "Newton's laws")
}

fn laws_of(study: &Study, names: &Names, case: &Case, (body, terms): (usize, &[Term]), title: &str) -> Block {
    let kinematics = study.model.bodies[body].kinematics();
    let mass = case.run.equations.mass_properties(body);
    let component = |axis: usize| {
        let parts = terms.iter().filter(|term| !is_identically_zero(&term.force[axis]));
        let signed = |term| {
            let component = component(study, names, term, axis);
            let is_opposite = is_on_other(&case.run.equations, term) && term.force[axis].symbols().len() > 1;
            if is_opposite { -component } else { component }
        };
        parts.map(signed).fold(Expr::zero(), |sum, force| sum + force)
    };
    let turns =
        |term: &&Term| !is_identically_zero(&term.torque()) && names.formula(&term.torque()).text != "0";
    let torque = terms.iter().filter(turns);
    let torque = torque.map(|term| {
        let force = symbols::force(study, &term.load, term.law);
        let name = if term.law.is_couple() { force } else { symbols::torque(&force) };
        Expr::from(Symbol::new(name, tumble_expr::Dimension::TORQUE))
    });
    let torque = torque.fold(Expr::zero(), |sum, torque| sum + torque);
    let [ax, ay] = kinematics.acceleration_symbols();
    let left = |factor: &Expr, symbol: &Symbol| Left::times(factor, Math::symbol(names.shown(&symbol.name)));
    let (m, inertia) = (&names.mass(&mass.mass), &mass.inertia);
    // The right sides are accelerations: the factor of the left side is multiplied on.
    let mut lines = vec![(left(m, &ax), component(0) / m), (left(m, &ay), component(1) / m)];
    if !is_identically_zero(inertia) {
        lines.push((left(inertia, &kinematics.alpha_symbol()), torque / inertia));
    }
    names.with_inertia(study, body, inertia).block(title, &lines)
}

/// A component of a force by its symbol.
fn component(study: &Study, names: &Names, term: &Term, axis: usize) -> Expr {
    let force = symbols::force(study, &term.load, term.law);
    // What is along an axis has its symbol, with the sign that it acts with.
    let own = term.force[axis].symbols();
    let is_own = |symbol: &Symbol| is_multiplier(study, symbol) || names.shown(&symbol.name) == force;
    if !own.is_empty() && own.iter().all(is_own) {
        return term.force[axis].clone();
    }
    Symbol::new(symbols::below(&force, ["x", "y"][axis]), tumble_expr::Dimension::FORCE).into()
}

/// Whether a symbol stands for a force that follows from conditions.
fn is_multiplier(study: &Study, symbol: &Symbol) -> bool {
    let contacts = study.model.pairs();
    let joints = study.model.joints.iter().flat_map(tumble_mech::Joint::multipliers);
    let pivots = study.model.pivots.iter().flat_map(tumble_mech::Pivot::force_symbols);
    contacts.iter().any(|pair| pair.force_symbol() == *symbol)
        || joints.chain(pivots).any(|known| known == *symbol)
}

/// The first term of each load.
fn distinct(terms: Vec<Term>) -> Vec<Term> {
    let mut found: Vec<Term> = vec![];
    for term in terms {
        if !found.iter().any(|known| known.load == term.load) {
            found.push(term);
        }
    }
    found
}

#[cfg(test)]
mod tests;
