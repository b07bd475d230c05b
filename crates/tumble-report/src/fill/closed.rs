//! Stretches of a motion in which every acceleration is a polynomial in time, with their closed forms.

use crate::report::{Block, Definition, Phase, Text, Typeset};
use tumble_drawing::Label;
use tumble_expr::{Dimension, Expr, Substitution, Symbol, is_identically_zero};
use tumble_mech::{Happening, Mode, Parameters, Record, Run};
use tumble_notation::{ClosedForm, Left, Math, Operator, integrate_twice, polynomial_in};
use tumble_ode::{Cause, Occurrence};
use tumble_scene::Study;

use super::names::{Names, in_degrees, math, quantity};
use super::{words, zeros};
use crate::results::{Case, CaseError, is_angle, unit};

/// Phases beyond these are told of by the table of events.
const MOST_PHASES: usize = 4;
/// The same where there are several runs, of those that have no formulas.
const MOST_OF_SEVERAL: usize = 2;
/// Digits of numbers in closed forms.
const DIGITS: usize = 6;

/// A coordinate of a body with its velocity and acceleration.
struct Coordinate {
    body: usize,
    position: Symbol,
    velocity: Symbol,
    acceleration: Symbol,
    start: (Expr, Expr),
}

/// A stretch of time in which every acceleration is a polynomial in it, with what follows.
struct Stretch<'r> {
    mode: &'r Mode,
    begins: Expr,
    /// The time at which it ends, where that has a formula.
    end: Option<Expr>,
    /// Whether an event ends it before the run does.
    ends: bool,
    elapsed: Symbol,
    coordinates: Vec<Coordinate>,
    motions: Vec<ClosedForm>,
}

/// The stretches from the start on in which the motion has a closed form.
fn solved<'r>(study: &Study, run: &'r Run) -> Vec<Stretch<'r>> {
    let starts = || (0..study.model.bodies.len()).flat_map(|body| coordinates(study, body)).collect();
    let (mut coordinates, mut begins): (Vec<Coordinate>, _) =
        (starts(), Expr::zero() * tumble_expr::units::S);
    let mut found: Vec<Stretch<'r>> = vec![];
    let stretches = stretches(run);
    let count = stretches.len();
    // An impact ends a closed form though the mode stays.
    let jumps = run.events().filter(|event| event.record.happened.iter().any(is_jump));
    let last_jump = jumps.map(|event| event.time).fold(0.0, f64::max);
    for (number, (mode, ends)) in stretches.into_iter().take(MOST_PHASES).enumerate() {
        let elapsed = Symbol::new(elapsed_since(number), Dimension::TIME);
        let Some(motions) = motions(run, mode, &coordinates, &begins, &elapsed) else { break };
        let mut next: Vec<Coordinate> = starts();
        if let Some(end) = &ends {
            let mut at_end = Substitution::default();
            at_end.insert(elapsed.clone(), end - &begins);
            for (coordinate, motion) in next.iter_mut().zip(&motions) {
                coordinate.start = (at_end.apply(&motion.position), at_end.apply(&motion.velocity));
            }
        }
        let ends_later = study.number(&begins).is_ok_and(|begins| last_jump > begins);
        found.push(Stretch {
            mode,
            begins,
            end: ends.clone(),
            ends: number + 1 < count || ends_later,
            elapsed,
            coordinates,
            motions,
        });
        // An end at a time that only the run knows has no formula: the closed forms end there.
        let Some(end) = ends else { break };
        (coordinates, begins) = (next, end);
    }
    found
}

/// The closed forms of a run as they are shown.
pub(super) fn phases(
    study: &Study,
    names: &Names,
    case: &Case,
    is_only: bool,
) -> Result<Vec<Phase>, CaseError> {
    let solved = solved(study, &case.run);
    let by_formulas = solved.iter().map(|stretch| phase(study, case, names, stretch));
    let mut phases: Vec<Phase> = by_formulas.collect::<Result<_, _>>()?;
    phases.extend(numeric::phases(
        study,
        names,
        case,
        (phases.len(), if is_only { MOST_PHASES } else { MOST_OF_SEVERAL }),
    )?);
    Ok(phases)
}

/// Whether the motion may not go on as before.
fn is_jump(one: &Happening) -> bool {
    !matches!(one, Happening::Event(_) | Happening::Rest)
}

/// The time since a phase began.
fn elapsed_since(number: usize) -> String {
    if number == 0 { "t".to_owned() } else { format!("t_{number}") }
}

/// The modes one after the other, each with the formula of the time at which it ends, where there is one.
fn stretches(run: &Run) -> Vec<(&Mode, Option<Expr>)> {
    let trajectory = &run.trajectory();
    let end = |event: &Occurrence<Record>| match &event.causes[..] {
        [Cause::Scheduled(index), ..] => {
            let times = run.equations.scheduled_times(&trajectory.modes[event.mode_before]);
            times.get(*index).cloned()
        }
        _ => None,
    };
    let Some(first) = trajectory.pieces.first() else { return vec![] };
    let changes: Vec<&Occurrence<Record>> =
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
    let coordinate = |[position, velocity, acceleration]: [Symbol; 3], start: (Expr, Expr)| Coordinate {
        body: index,
        position,
        velocity,
        acceleration,
        start,
    };
    let symbols = [k.angle_symbol(), k.omega_symbol(), k.alpha_symbol()];
    let turning = coordinate(symbols, (value(start.angle), value(start.omega)));
    if study.model.pivot_of(&body.name).is_some() {
        return vec![turning];
    }
    let speed = |axis: usize| start.velocity.as_ref().map_or_else(Expr::zero, |v| v[axis].clone());
    let symbols = [k.position_symbols(), k.velocity_symbols(), k.acceleration_symbols()];
    let along = |axis: usize| {
        coordinate(symbols.each_ref().map(|both| both[axis].clone()), (at[axis].clone(), speed(axis)))
    };
    vec![along(0), along(1), turning]
}

fn motions(
    run: &Run,
    mode: &Mode,
    coordinates: &[Coordinate],
    begins: &Expr,
    elapsed: &Symbol,
) -> Option<Vec<ClosedForm>> {
    let inputs = run.equations.model().parameters.symbols();
    let time = Symbol::new("t", Dimension::TIME);
    let without = without(&run.equations.model().parameters);
    let one = |coordinate: &Coordinate| {
        let acceleration = run.equations.in_states(mode, &coordinate.acceleration.clone().into());
        let acceleration = without_states(run, mode, &without.apply(&acceleration))?;
        let given = |symbol: &Symbol| *symbol == time || inputs.contains(symbol);
        if !acceleration.symbols().iter().all(given) {
            return None;
        }
        let (position, velocity) = &coordinate.start;
        integrate_twice(&acceleration, (&time, begins), elapsed, (position, velocity))
    };
    coordinates.iter().map(one).collect()
}

/// Parameters that are zero in a run: without air there is none in the formulas.
fn without(parameters: &Parameters) -> Substitution {
    let value = |symbol: &Symbol| parameters.evaluate(&[symbol.clone().into()]);
    let is_zero = |symbol: &Symbol| value(symbol).is_ok_and(|value| value[0] == 0.0);
    zeros(parameters.symbols().into_iter().filter(is_zero))
}

/// A formula that no state has a part in, without their symbols; `None` where one has.
fn without_states(run: &Run, mode: &Mode, formula: &Expr) -> Option<Expr> {
    let states = run.equations.states(mode);
    let is_free = states.iter().all(|state| is_identically_zero(&formula.derivative(state)));
    is_free.then(|| zeros(states).apply(formula))
}

fn phase(study: &Study, case: &Case, names: &Names, stretch: &Stretch<'_>) -> Result<Phase, CaseError> {
    let Stretch { mode, begins, elapsed, coordinates, motions, .. } = stretch;
    let mut lines: Vec<Vec<(Left, Expr)>> = vec![vec![]; study.model.bodies.len()];
    let mut numbers: Vec<Typeset> = vec![];
    for (coordinate, motion) in coordinates.iter().zip(motions) {
        let is_still = is_identically_zero(&motion.velocity);
        if is_still && study.model.bodies.len() > 1 {
            continue;
        }
        let both = [(&coordinate.position, &motion.position), (&coordinate.velocity, &motion.velocity)];
        // What does not move has no velocity; of several bodies only what moves is told.
        for (symbol, formula) in both.into_iter().take(if is_still { 1 } else { 2 }) {
            let left = Left::symbol(Math::symbol(names.shown(&symbol.name)));
            lines[coordinate.body].push((left, formula.clone()));
            numbers.push(with_numbers(study, names, symbol, formula, elapsed)?);
        }
    }
    let of_body = |(body, lines): (usize, &Vec<_>)| names.of_body(body).block("", lines);
    let mut symbols: Vec<Block> = lines.iter().enumerate().map(of_body).collect();
    if *elapsed.name != *"t" {
        let since: Expr = Expr::symbol("t", Dimension::TIME) - begins;
        let symbol = names.equation(&elapsed.name, &since);
        let definition = Definition { symbol, meaning: Text::default() };
        if let Some(last) = symbols.last_mut() {
            last.definitions.push(definition);
        }
    }
    // A line without a parameter is the same with numbers.
    let said: Vec<&str> = symbols.iter().flat_map(|block| &block.lines).map(|line| &*line.text).collect();
    numbers.retain(|line| !said.contains(&&*line.text));
    let numbers =
        if numbers.is_empty() { vec![] } else { vec![Block { lines: numbers, ..Default::default() }] };
    let name = Text::from(words::mode(study, &case.run.equations, mode));
    Ok(Phase { name, span: span(study, stretch)?, symbols, numbers })
}

/// From when to when a stretch is.
fn span(study: &Study, stretch: &Stretch<'_>) -> Result<Text, CaseError> {
    let from = study.number(&stretch.begins)?;
    let end = stretch.end.as_ref().map(|end| study.number(end)).transpose()?;
    Ok(from_to(from, end, stretch.ends))
}

/// `from t = 0 s to 0.01 s`; nothing of what holds all the time. Something may end it at a time that is not said.
fn from_to(from: f64, end: Option<f64>, ends: bool) -> Text {
    let until = match end {
        Some(end) => Text::from(" to ").and(quantity(end, "s")),
        None if ends => " to the next event".into(),
        None if from == 0.0 => return Text::default(),
        None => " on".into(),
    };
    Text::from("from ").and(Label::symbol("t")).and(" = ").and(quantity(from, "s")).and(until)
}

/// The polynomial with its coefficients as numbers with their units.
fn with_numbers(
    study: &Study,
    names: &Names,
    symbol: &Symbol,
    formula: &Expr,
    elapsed: &Symbol,
) -> Result<Typeset, CaseError> {
    let powers = polynomial_in(formula, elapsed).unwrap_or_default();
    let powers: Result<Vec<f64>, _> = powers.iter().map(|coefficient| study.number(coefficient)).collect();
    Ok(line(names, symbol, &powers?, &Math::symbol(&elapsed.name)))
}

/// The same by the coefficients in SI units, lowest power first.
fn line(names: &Names, symbol: &Symbol, powers: &[f64], time: &Math) -> Typeset {
    let mut terms = vec![];
    let mut dimension = symbol.dimension;
    for (degree, &value) in powers.iter().enumerate() {
        let unit = unit(dimension, is_angle(symbol));
        dimension = dimension.over(Dimension::TIME).unwrap_or(dimension);
        if value == 0.0 {
            continue;
        }
        let number = Math::number(value.abs(), DIGITS);
        let quantity = Math::Product([number].into_iter().chain(in_unit(&unit)).collect());
        let power = match degree {
            0 => None,
            1 => Some(time.clone()),
            _ => Some(Math::Power(Box::new(time.clone()), Box::new(Math::Number(degree.to_string())))),
        };
        let term = match power {
            Some(power) if !unit.is_empty() => Math::Product(vec![Math::Brackets(Box::new(quantity)), power]),
            Some(power) => Math::Product(vec![quantity, power]),
            None => quantity,
        };
        terms.push((value < 0.0, term));
    }
    if terms.is_empty() {
        terms.push((false, Math::Number("0".to_owned())));
    }
    let left = [names.notation().symbol(&symbol.name), Math::Operator(Operator::Equals)];
    // One that stays.
    let is_turned = is_angle(symbol) && symbol.dimension == Dimension::NONE;
    let stays = is_turned && powers.iter().skip(1).all(|value| *value == 0.0);
    let degrees = if stays { in_degrees(powers[0], DIGITS, "rad").to_plain() } else { String::new() };
    let degrees = (!degrees.is_empty()).then_some(Math::Text(degrees));
    math(&Math::Row(left.into_iter().chain(Math::terms(terms)).chain(degrees).collect()))
}

/// `m/s²` as it is printed; nothing for a pure number.
fn in_unit(unit: &str) -> Option<Math> {
    (!unit.is_empty()).then(|| Math::Text(unit.replace("^2", "²").replace("^3", "³").replace('*', "·")))
}

mod numeric;
#[cfg(test)]
mod tests;
