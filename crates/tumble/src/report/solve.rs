//! Closed forms where there are any, and how the rest was integrated.

use tumble_expr::{Dimension, Expr, Substitution, Symbol};
use tumble_math::{Left, Math as Formula, Motion, Operator, integrate_twice, polynomial_in};
use tumble_mech::{Mode, Record, Run};
use tumble_ode::{Cause, Event};
use tumble_report::report::{Block, Column, Definition, Math, Phase, Solve, Table, Text};
use tumble_report::{Label, numeral};
use tumble_scene::Study;

use super::equations::mode_name;
use super::names::{Names, math, quantity};
use crate::case::Case;
use crate::digits::Held;
use crate::pipeline::PipelineError;
use crate::tables::{is_angle, unit};

/// Phases beyond these are told of by the table of events.
const MOST_PHASES: usize = 4;
/// Digits of numbers in closed forms.
const DIGITS: usize = 6;

pub(super) fn of(study: &Study, names: &Names, cases: &[Case]) -> Result<Solve, PipelineError> {
    let phases = phases(study, names, &cases[0])?;
    let intro = match (phases.is_empty(), &cases[0].run.work()) {
        (false, work) if work.exact_steps == work.steps => {
            "Between the events all accelerations are constant or polynomials in time: the motion is known in closed form."
        }
        (false, _) => "The motion begins with phases that are known in closed form; the rest was integrated.",
        (true, _) => "The equations have no closed form that the program knows: they were integrated.",
    };
    Ok(Solve {
        intro: vec![intro.into()],
        phases,
        method: method(cases),
        tables: cases.iter().map(events).collect(),
    })
}

fn method(cases: &[Case]) -> Vec<(Text, Text)> {
    let row = |name: &str, value: &dyn Fn(&Case) -> String| {
        let values: Vec<(&str, String)> = cases.iter().map(|case| (&*case.label, value(case))).collect();
        (Text::from(name), Text::from(by_run(&values)))
    };
    let work = |case: &Case| case.run.work();
    let mut rows = vec![
        row("Method", &|_| "Taylor series, each step checked against the equations".to_owned()),
        row("Accuracy asked", &|case| format!("{:e}", case.accuracy.value())),
        row("Order of the series", &|case| case.run.order().to_string()),
        row("Steps", &|case| work(case).steps.to_string()),
        row("of them exact, the motion being a polynomial", &|case| work(case).exact_steps.to_string()),
        row("Steps shortened and repeated", &|case| work(case).rejected.to_string()),
        row("Sets of equations, one for each way of touching", &|case| work(case).modes.to_string()),
    ];
    rows.extend(trust(cases));
    if cases.iter().any(|case| case.run.quadrature.is_some()) {
        rows.push(row("Points along lines that stand for integrals", &|case| {
            case.run.quadrature.map_or_else(String::new, |found| format!("{}", found.nodes))
        }));
    }
    for (case, refusal) in cases.iter().filter_map(|case| Some((case, case.refusal.as_ref()?))) {
        rows.push((of_run("Stopped", cases, case), Text::from(refusal.to_string())));
    }
    rows
}

/// One value if all runs have the same, else that of each run with its label.
fn by_run(values: &[(&str, String)]) -> String {
    match values {
        [(_, first), rest @ ..] if rest.iter().all(|(_, value)| value == first) => first.clone(),
        _ => {
            let each = values.iter().map(|(label, value)| format!("{label}: {value}"));
            each.collect::<Vec<_>>().join("; ")
        }
    }
}

/// What is told of one run, with its label where there are several.
fn of_run(what: &str, cases: &[Case], case: &Case) -> Text {
    if cases.len() > 1 { format!("{what}, {}", case.label).into() } else { what.into() }
}

/// What a check run says, a row for each thing that it says of any run.
fn trust(cases: &[Case]) -> Vec<(Text, Text)> {
    let rows = cases.iter().flat_map(|case| {
        let name = |what: &str| of_run(what, cases, case);
        let held = case
            .trust
            .as_ref()
            .map(|trust| (name("Verified by an independent check run"), Held::of(trust).words().into()));
        let horizon = case.trust.as_ref().and_then(|trust| trust.horizon.as_ref());
        let why =
            horizon.map(|horizon| (name("Verified digits end because"), horizon.reason.to_string().into()));
        held.into_iter().chain(why)
    });
    rows.collect()
}

/// A row an event.
fn events(case: &Case) -> Table {
    let caption = if case.label.is_empty() { "Events".to_owned() } else { format!("Events, {}", case.label) };
    let heading = Text::from(Label::symbol("t")).and(" (s)");
    let columns = vec![Column::numbers(heading), Column::words("What happens")];
    let row = |event: &Event<Record>| {
        let names = case.run.equations.names_of(&event.record);
        vec![quantity(event.time, ""), names.join(", ").into()]
    };
    let mut table = Table::new(caption, columns);
    table.rows = case.run.events().map(row).collect();
    if table.rows.is_empty() {
        table.notes.push("Nothing happens on the way.".into());
    }
    table
}

/// A coordinate of a body with its velocity and acceleration.
struct Coordinate {
    body: usize,
    position: Symbol,
    velocity: Symbol,
    acceleration: Symbol,
    start: (Expr, Expr),
}

/// Stretches from the start on in which every acceleration is a polynomial in time.
fn phases(study: &Study, names: &Names, case: &Case) -> Result<Vec<Phase>, PipelineError> {
    let run = &case.run;
    let mut coordinates: Vec<Coordinate> =
        (0..study.model.bodies.len()).flat_map(|body| coordinates(study, body)).collect();
    let mut begins = Expr::zero() * tumble_expr::units::S;
    let mut found = vec![];
    let mut known = true;
    for (number, (mode, ends)) in stretches(run).into_iter().take(MOST_PHASES).enumerate() {
        let elapsed = Symbol::new(if number == 0 { "t" } else { "tau" }, Dimension::TIME);
        let Some(motions) = motions(run, mode, &coordinates, &begins, &elapsed) else { break };
        found.push(phase(study, case, names, mode, (&begins, &elapsed), &coordinates, &motions)?);
        // An end at a time that only the run knows has no formula: the closed forms end there.
        known = known && ends.is_some();
        let Some(end) = ends.filter(|_| known) else { break };
        let mut at_end = Substitution::default();
        at_end.insert(elapsed, &end - &begins);
        for (coordinate, motion) in coordinates.iter_mut().zip(motions) {
            coordinate.start = (at_end.apply(&motion.position), at_end.apply(&motion.velocity));
        }
        begins = end;
    }
    Ok(found)
}

/// The modes one after the other, each with the formula of the time at which it ends, where there is one.
fn stretches(run: &Run) -> Vec<(&Mode, Option<Expr>)> {
    let trajectory = &run.trajectory();
    let end = |event: &Event<Record>| match &event.causes[..] {
        [Cause::Scheduled(index), ..] => {
            let times = run.equations.scheduled_times(&trajectory.modes[event.mode_before]);
            times.get(*index).cloned()
        }
        _ => None,
    };
    let Some(first) = trajectory.pieces.first() else { return vec![] };
    let changes: Vec<&Event<Record>> =
        trajectory.events.iter().filter(|event| event.mode_before != event.mode_after).collect();
    let mut found = vec![];
    let mut mode = first.mode;
    for event in changes {
        found.push((&trajectory.modes[mode], end(event)));
        mode = event.mode_after;
    }
    found.push((&trajectory.modes[mode], None));
    found
}

fn coordinates(study: &Study, index: usize) -> Vec<Coordinate> {
    let body = &study.model.bodies[index];
    let start = study.model.start_of(&body.name);
    let k = body.kinematics();
    let centre = body.mass_properties().centre;
    let at = start.at.unwrap_or(centre);
    let value = |formula: Option<Expr>| formula.unwrap_or_else(Expr::zero);
    let turning = Coordinate {
        body: index,
        position: k.angle_symbol(),
        velocity: k.omega_symbol(),
        acceleration: k.alpha_symbol(),
        start: (value(start.angle), value(start.omega)),
    };
    if study.model.pivot_of(&body.name).is_some() {
        return vec![turning];
    }
    let ([x, y], [vx, vy], [ax, ay]) = (k.position_symbols(), k.velocity_symbols(), k.acceleration_symbols());
    let speed = |axis: usize| start.velocity.as_ref().map_or_else(Expr::zero, |v| v[axis].clone());
    vec![
        Coordinate {
            body: index,
            position: x,
            velocity: vx,
            acceleration: ax,
            start: (at[0].clone(), speed(0)),
        },
        Coordinate {
            body: index,
            position: y,
            velocity: vy,
            acceleration: ay,
            start: (at[1].clone(), speed(1)),
        },
        turning,
    ]
}

fn motions(
    run: &Run,
    mode: &Mode,
    coordinates: &[Coordinate],
    begins: &Expr,
    elapsed: &Symbol,
) -> Option<Vec<Motion>> {
    let inputs = run.equations.model().parameters.symbols();
    let time = Symbol::new("t", Dimension::TIME);
    let one = |coordinate: &Coordinate| {
        let acceleration = run.equations.in_states(mode, &coordinate.acceleration.clone().into());
        let given = |symbol: &Symbol| *symbol == time || inputs.contains(symbol);
        if !acceleration.symbols().iter().all(given) {
            return None;
        }
        let (position, velocity) = &coordinate.start;
        integrate_twice(&acceleration, (&time, begins), elapsed, (position, velocity))
    };
    coordinates.iter().map(one).collect()
}

fn phase(
    study: &Study,
    case: &Case,
    names: &Names,
    mode: &Mode,
    (begins, elapsed): (&Expr, &Symbol),
    coordinates: &[Coordinate],
    motions: &[Motion],
) -> Result<Phase, PipelineError> {
    let mut lines: Vec<Vec<(Left, Expr)>> = vec![vec![]; study.model.bodies.len()];
    let mut numbers: Vec<Math> = vec![];
    for (coordinate, motion) in coordinates.iter().zip(motions) {
        for (symbol, formula) in
            [(&coordinate.position, &motion.position), (&coordinate.velocity, &motion.velocity)]
        {
            let left = Left::symbol(Formula::symbol(names.shown(&symbol.name)));
            lines[coordinate.body].push((left, formula.clone()));
            numbers.push(with_numbers(study, names, symbol, formula, elapsed)?);
        }
    }
    let of_body = |(body, lines): (usize, &Vec<_>)| names.of_body(body).block("", lines);
    let mut symbols: Vec<Block> = lines.iter().enumerate().map(of_body).collect();
    if *elapsed.name != *"t" {
        let since: Expr = Expr::symbol("t", Dimension::TIME) - begins;
        let symbol = names.equation("tau", &since);
        let definition = Definition { symbol, meaning: Text::default() };
        if let Some(last) = symbols.last_mut() {
            last.definitions.push(definition);
        }
    }
    let from = study.number(begins)?;
    Ok(Phase {
        name: mode_name(study, case, mode).into(),
        span: Text::from("from ").and(Label::symbol("t")).and(" = ").and(quantity(from, "s")),
        symbols,
        numbers: vec![Block { lines: numbers, ..Default::default() }],
    })
}

/// The polynomial with its coefficients as numbers with their units.
fn with_numbers(
    study: &Study,
    names: &Names,
    symbol: &Symbol,
    formula: &Expr,
    elapsed: &Symbol,
) -> Result<Math, PipelineError> {
    let coefficients = polynomial_in(formula, elapsed).unwrap_or_default();
    let time = Formula::symbol(&elapsed.name);
    let mut parts = vec![names.notation().symbol(&symbol.name), Formula::Operator(Operator::Equals)];
    for (degree, coefficient) in coefficients.iter().enumerate() {
        let value = study.number(coefficient)?;
        if value == 0.0 {
            continue;
        }
        let is_first = parts.len() == 2;
        parts.extend(match (is_first, value < 0.0) {
            (true, true) => Some(Formula::Operator(Operator::Negative)),
            (true, false) => None,
            (false, true) => Some(Formula::Operator(Operator::Minus)),
            (false, false) => Some(Formula::Operator(Operator::Plus)),
        });
        let number = Formula::Number(numeral::significant(value.abs(), DIGITS).to_plain());
        let unit = unit(coefficient.dimension().unwrap_or(symbol.dimension), is_angle(symbol));
        let power = match degree {
            0 => None,
            1 => Some(time.clone()),
            _ => Some(Formula::Power(Box::new(time.clone()), Box::new(Formula::Number(degree.to_string())))),
        };
        parts.push(Formula::Product([number].into_iter().chain(in_unit(&unit)).chain(power).collect()));
    }
    if parts.len() == 2 {
        parts.push(Formula::Number("0".to_owned()));
    }
    Ok(math(&Formula::Row(parts)))
}

/// `m/s^2` as it is printed; nothing for a pure number.
fn in_unit(unit: &str) -> Option<Formula> {
    let (mut parts, mut text) = (vec![], String::new());
    for (index, part) in unit.split('/').filter(|part| !part.is_empty()).enumerate() {
        let over = if index > 0 { "/" } else { "" };
        let (base, power) = part.split_once('^').unwrap_or((part, ""));
        let base = base.replace('*', "\u{b7}");
        if power.is_empty() {
            text += &format!("{over}{base}");
            continue;
        }
        let before = std::mem::take(&mut text) + over;
        parts.extend((!before.is_empty()).then_some(Formula::Text(before)));
        parts
            .push(Formula::Power(Box::new(Formula::Text(base)), Box::new(Formula::Number(power.to_owned()))));
    }
    if !text.is_empty() {
        parts.push(Formula::Text(text));
    }
    (!parts.is_empty()).then_some(Formula::Row(parts))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What belongs to one run stands at the same place in every row.
    #[test]
    fn values_stay_with_their_runs() {
        let row = |values: [&str; 3]| {
            let values: Vec<(&str, String)> =
                ["a", "b", "c"].into_iter().zip(values.map(str::to_owned)).collect();
            by_run(&values)
        };
        assert_eq!(row(["18", "18", "18"]), "18");
        assert_eq!(row(["18", "18", "20"]), "a: 18; b: 18; c: 20");
        assert_eq!(row(["18", "20", "18"]), "a: 18; b: 20; c: 18");
    }
}
