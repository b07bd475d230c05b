//! Figures of a run: the study says which, the motion says what is in them.

pub(crate) mod air;
mod bands;
pub(crate) mod captions;
mod cones;
pub(crate) mod energies;
pub(crate) mod finds;
pub(crate) mod free_bodies;
pub(crate) mod instants;
pub(crate) mod symbols;

use tumble_drawing::free_body::{Ground, GroundCircle};
use tumble_drawing::{
    Axis, BodyPath, CurveFigure, DataSeries, Label, Mark, Outline, Pose, StroboscopicPicture, Svg,
};
use tumble_expr::{Dimension, Expr, Vector};
use tumble_mech::{Body, Record, Run, Shape};
use tumble_ode::{Occurrence, Side};
use tumble_scene::{Curve, Diagnostics, Plot, Stroboscope, Study};

use crate::fill::words;
use crate::report::END_OF_DIGITS;
use crate::results::moments::Moments;
use crate::results::{Case, CaseError, FAMILY, Runs, SampleRow, sample, sample_between, telling};

/// Points of a drawn path: more than a screen has pixels across.
const TRACE_POINTS: usize = 2000;
/// More event marks than this cannot be told apart in one figure.
const MOST_MARKS: usize = 12;
/// Events so near each other, as a part of the axis, have one mark: their lines would be one.
const ONE_LINE: f64 = 1e-4;
/// More instants than this are a smear, and a mistake in the interval.
const MOST_INSTANTS: usize = 1000;

/// Draws everything the study asks for, all runs in one figure, and gives each with its name, without ending, to `save`.
///
/// Of a long sweep, pictures and diagrams are of those runs only that tell something.
pub fn all<E: From<CaseError>>(
    study: &Study,
    runs: Runs<'_>,
    mut save: impl FnMut(String, Svg) -> Result<(), E>,
) -> Result<(), E> {
    let (cases, told) = (runs.cases, telling(runs.cases));
    for (name, svg) in finds::all(study, runs.survey) {
        save(name, svg)?;
    }
    if cases.is_empty() {
        return Ok(());
    }
    for plot in &study.plots {
        save(plot.name.clone(), curves(study, cases, plot)?.svg())?;
    }
    for stroboscope in &study.stroboscopes {
        save(stroboscope.name.clone(), picture(study, &told, stroboscope)?.svg())?;
    }
    for asked in &study.balances {
        save(asked.name.clone(), energies::of(study, &told, asked).svg())?;
    }
    for asked in &study.free_bodies {
        for case in &told {
            let name = if cases.len() > 1 {
                format!("{}.{}", asked.name, case.folder())
            } else {
                asked.name.clone()
            };
            save(name, free_bodies::sheet(study, case, asked)?.svg())?;
        }
    }
    Ok(())
}

/// What is to be said of symbols: two quantities that are shown by the same one.
pub fn clashes(study: &Study) -> Option<Diagnostics> {
    let one = |(name, other, symbol): (String, String, String)| study.shown_alike(&name, &other, &symbol);
    symbols::clashes(study).into_iter().map(one).reduce(|mut all, next| {
        all.extend(next);
        all
    })
}

/// Whether a study has any figure.
pub fn are_asked_for(study: &Study) -> bool {
    let Study { plots, stroboscopes, balances, free_bodies, .. } = study;
    !(plots.is_empty() && stroboscopes.is_empty() && balances.is_empty() && free_bodies.is_empty())
}

/// What stands above a figure: its title, or that of the scene and the figure's name.
pub(crate) fn heading(study: &Study, title: Option<&str>, name: &str) -> Label {
    let own = || format!("{}: {}", study.title, name.replace(['-', '_'], " "));
    Label::markup(&title.map_or_else(own, str::to_owned))
}

pub(crate) fn curves(study: &Study, cases: &[Case], plot: &Plot) -> Result<CurveFigure, CaseError> {
    let x = plot.x.as_ref().map_or(tumble_mech::time(), |curve| curve.quantity.formula.clone());
    let y = plot.y.iter().map(|curve| curve.quantity.formula.clone());
    let formulas: Vec<Expr> = std::iter::once(x).chain(y).collect();
    let x_axis = match &plot.x {
        Some(curve) => axis(study, std::slice::from_ref(curve)),
        None => Axis::new(Label::markup("time $t$"), "s"),
    };
    let title = heading(study, plot.title.as_deref(), &plot.name);
    let mut figure = CurveFigure::new(title, x_axis, axis(study, &plot.y));
    if cases.len() > FAMILY && plot.x.is_none() {
        bands::add(&mut figure, study, cases, plot)?;
    }
    for case in telling(cases) {
        let of_case = study.with(&case.parameters);
        let moments = Moments::of(&of_case, case.solution());
        // What waits for something that does not happen in this run has no curve.
        let known: Option<Vec<Expr>> =
            formulas.iter().map(|formula| Some(moments.known(formula)?.formula)).collect();
        let Some(known) = known else { continue };
        let Some(rows) = rows(&of_case, case, plot, &known)?.map(begun) else { continue };
        for (index, curve) in plot.y.iter().enumerate() {
            let points = rows.iter().map(|row| [row.values[0], row.values[index + 1]]).collect();
            // One curve a run needs no name: the axis says what it is.
            let curve = if plot.y.len() > 1 { label(study, curve) } else { Label::default() };
            figure.series.push(DataSeries { label: joined(curve, case_label(case)), points, dotted: false });
        }
    }
    if plot.x.is_none() {
        let shown = shown(&figure);
        if let [case] = cases {
            mark_events(&mut figure, study, case, shown);
        }
        mark_ends_of_digits(&mut figure, cases, shown);
    }
    Ok(figure)
}

/// Without what was just before the first instant, which the figure does not show.
fn begun(mut rows: Vec<SampleRow>) -> Vec<SampleRow> {
    let first = rows.first().map_or(0.0, |row| row.time);
    let before = rows.iter().take_while(|row| row.time == first).count();
    rows.drain(..before.saturating_sub(1));
    rows
}

/// The motion where the figure shows it; `None` if what it waits for does not happen in this run.
fn rows(
    study: &Study,
    case: &Case,
    plot: &Plot,
    formulas: &[Expr],
) -> Result<Option<Vec<SampleRow>>, CaseError> {
    let Some(during) = &plot.during else { return Ok(Some(sample(study, &case.run, formulas)?)) };
    let window = Moments::of(study, case.solution()).window(Some(during))?;
    let end = case.run.end().unwrap_or(0.0);
    window
        .filter(|[from, _]| *from < end)
        .map(|window| sample_between(&case.run, formulas, window))
        .transpose()
}

/// First and last time that curves are of, s.
fn shown(figure: &CurveFigure) -> [f64; 2] {
    let times = figure.series.iter().flat_map(|series| &series.points).map(|[time, _]| *time);
    times.fold([f64::INFINITY, f64::NEG_INFINITY], |[from, to], time| [from.min(time), to.max(time)])
}

/// Marks from where on no digit is verified.
fn mark_ends_of_digits(figure: &mut CurveFigure, cases: &[Case], [from, to]: [f64; 2]) {
    for case in telling(cases) {
        let at = case.verified_until();
        if from <= at && at < to {
            figure.marks.push(Mark { at, label: joined(Label::plain(END_OF_DIGITS), case_label(case)) });
        }
    }
}

/// Marks what happens along the time axis, but for its ends, unless so much does that no mark could be read.
fn mark_events(figure: &mut CurveFigure, study: &Study, case: &Case, [from, to]: [f64; 2]) {
    let events = case.run.events();
    let events: Vec<_> = events.filter(|event| from < event.time && event.time < to).collect();
    if events.len() > MOST_MARKS {
        return;
    }
    let is_one = |a: &&Occurrence<Record>, b: &&Occurrence<Record>| b.time - a.time <= ONE_LINE * (to - from);
    for instant in events.chunk_by(is_one) {
        let said: Vec<_> = instant.iter().map(|event| words::event(study, &case.run, event)).collect();
        figure.marks.push(Mark { at: instant[0].time, label: Label::plain(&said.join(", ")) });
    }
}

/// What is different about a run: `T = 0.5 s` with its symbol, or the user's words.
pub(crate) fn case_label(case: &Case) -> Label {
    let part = |part: &str| match part.split_once(" = ") {
        Some((symbol, value)) => {
            let (number, unit) = value.split_once(' ').unwrap_or((value, ""));
            Label::equation(symbol, number, unit)
        }
        None => Label::plain(part),
    };
    case.label
        .split(", ")
        .map(part)
        .reduce(|all, next| all.then(Label::plain(", ")).then(next))
        .unwrap_or_default()
}

pub(crate) fn joined(a: Label, b: Label) -> Label {
    if a.is_empty() || b.is_empty() { a.then(b) } else { a.then(Label::plain(", ")).then(b) }
}

/// What the axis of some curves says: in words what they are, if that is one thing, and their symbols.
pub(crate) fn axis(study: &Study, curves: &[Curve]) -> Axis {
    let unit = curves.first().map_or("", |curve| &curve.quantity.unit);
    if let [first, _, ..] = curves
        && curves.iter().any(|curve| curve.label.is_some())
    {
        return Axis::new(Label::plain(&measured(first)), unit);
    }
    let words = match curves {
        [only] if only.label.is_none() => symbols::words(study, &only.text),
        [first, rest @ ..] if !rest.is_empty() => {
            let noun = |curve: &Curve| symbols::noun(study, &curve.text);
            let one = noun(first).filter(|one| rest.iter().all(|curve| noun(curve) == Some(one)));
            Some(one.map_or_else(|| measured(first), str::to_owned)).filter(|words| !words.is_empty())
        }
        _ => None,
    };
    let labels =
        curves.iter().map(|curve| label(study, curve)).filter(|label| !label.to_plain().contains('.'));
    let joined = labels.reduce(|all, next| all.then(Label::plain(", ")).then(next)).unwrap_or_default();
    let axis = match words {
        Some(words) if joined.is_empty() => Label::plain(&words),
        Some(words) => Label::plain(&format!("{words} ")).then(joined),
        None => joined,
    };
    Axis::new(axis, unit)
}

/// What curves with labels of their own have in common: `force`, `length`.
fn measured(curve: &Curve) -> String {
    let described = curve.quantity.dimension.describe();
    let noun = described.split(" (").next().unwrap_or_default();
    match (curve.angle, curve.quantity.dimension == Dimension::NONE) {
        // The dimension is also that of a torque; the unit tells.
        _ if curve.quantity.unit == "J" => "energy".to_owned(),
        (true, true) => "angle".to_owned(),
        (false, true) => String::new(),
        _ => noun.trim_start_matches("an ").trim_start_matches("a ").to_owned(),
    }
}

pub(crate) fn label(study: &Study, curve: &Curve) -> Label {
    match &curve.label {
        Some(label) => Label::markup(label),
        None => symbols::label(&symbols::all(study), &curve.text),
    }
}

pub(crate) fn picture(
    study: &Study,
    cases: &[&Case],
    stroboscope: &Stroboscope,
) -> Result<StroboscopicPicture, CaseError> {
    let several = stroboscope.bodies.len() > 1;
    let mut picture = StroboscopicPicture {
        title: heading(study, stroboscope.title.as_deref(), &stroboscope.name),
        surfaces: surfaces(study, &cases[0].run, 0.0)?,
        ..StroboscopicPicture::default()
    };
    for case in cases {
        let study = study.with(&case.parameters);
        for index in &stroboscope.bodies {
            let body = &study.model.bodies[*index];
            let mut track = track(&study, &case.run, stroboscope, body)?;
            let name = if several { Label::plain(&symbols::bare(&body.name)) } else { Label::default() };
            track.label = joined(name, case_label(case));
            picture.tracks.push(track);
        }
    }
    Ok(picture)
}

fn track(study: &Study, run: &Run, stroboscope: &Stroboscope, body: &Body) -> Result<BodyPath, CaseError> {
    let end = run.end().unwrap_or(0.0);
    let every = study.number(&stroboscope.every)?;
    let count = ((end / every * (1.0 + 1e-12)).floor() as usize).min(MOST_INSTANTS);
    let poses = poses(run, body, (0..=count).map(|index| (index as f64 * every).min(end)))?;
    let trace = if stroboscope.trace {
        let times = (0..=TRACE_POINTS).map(|index| end * index as f64 / TRACE_POINTS as f64);
        poses_to_path(&self::poses(run, body, times)?)
    } else {
        vec![]
    };
    Ok(BodyPath { label: Label::default(), shapes: with_strings(study, body)?, poses, trace })
}

fn poses_to_path(poses: &[Pose]) -> Vec<[f64; 2]> {
    poses.iter().map(Pose::centre).collect()
}

pub(crate) fn poses(
    run: &Run,
    body: &Body,
    times: impl Iterator<Item = f64>,
) -> Result<Vec<Pose>, CaseError> {
    let kinematics = body.kinematics();
    let position = kinematics.position();
    let mut observer = run.observe(&[position[0].clone(), position[1].clone(), kinematics.angle()])?;
    let pose = |t: f64| {
        let values = observer.at(t, Side::After)?;
        Some(Pose { t, x: values[0], y: values[1], angle: values[2] })
    };
    Ok(times.filter_map(pose).collect())
}

/// What bodies meet, where it is at a time, s: planes, and the edges of polygons and circles.
pub(crate) fn surfaces(study: &Study, run: &Run, time: f64) -> Result<Vec<Ground>, CaseError> {
    let mut found = vec![];
    for surface in &study.model.surfaces {
        let radius = surface.circle.iter().map(|circle| circle.radius.clone());
        let corners = surface.polygon.iter().flatten().flat_map(|corner| corner.components().to_vec());
        let formulas = [surface.through.components(), surface.normal.components()].concat();
        let formulas: Vec<Expr> = formulas.into_iter().chain(radius).chain(corners).collect();
        let Some(at) = run.observe(&formulas)?.at(time, Side::After) else { continue };
        let (point, name) = ([at[0], at[1]], Label::plain(&symbols::bare(&surface.name)));
        match (&surface.circle, &surface.polygon) {
            (Some(circle), _) => {
                found.push(Ground::round(point, GroundCircle { radius: at[4], hollow: circle.inside }, name));
            }
            (None, Some(_)) => {
                let corners: Vec<[f64; 2]> =
                    at[4..].chunks_exact(2).map(|place| [place[0], place[1]]).collect();
                found.extend(Ground::around(&corners, name));
            }
            (None, None) => found.push(Ground::new(point, [at[2], at[3]], name)),
        }
    }
    Ok(found)
}

/// Shapes of a body, and the strings that it hangs by: a round body, or a point, that a pivot beside it holds.
pub(crate) fn with_strings(study: &Study, body: &Body) -> Result<Vec<Outline>, CaseError> {
    let mut found = outlines(study, body)?;
    let Some(pivot) = study.model.pivot_of(&body.name) else { return Ok(found) };
    let arm = &pivot.point - &body.mass_properties().centre;
    let to = [study.number(arm.x())?, study.number(arm.y())?];
    let far = |from: [f64; 2]| (to[0] - from[0]).hypot(to[1] - from[1]);
    let from = match found[..] {
        [Outline::Circle { centre, radius, .. }] if far(centre) > radius => Some(centre),
        [Outline::Point(at)] if far(at) > 0.0 => Some(at),
        _ => None,
    };
    // Behind the body.
    found.splice(0..0, from.map(|from| Outline::Cord { from, to }));
    Ok(found)
}

/// Shapes of a body with its centre of mass at the origin.
pub(crate) fn outlines(study: &Study, body: &Body) -> Result<Vec<Outline>, CaseError> {
    let centre = body.mass_properties().centre;
    let place = |at: &Vector| -> Result<[f64; 2], CaseError> {
        let arm = at - &centre;
        Ok([study.number(arm.x())?, study.number(arm.y())?])
    };
    let outline = |shape: &Shape| -> Result<Outline, CaseError> {
        Ok(match shape {
            Shape::Point { at } => Outline::Point(place(at)?),
            Shape::Rod { from, to, .. } => Outline::Segment { from: place(from)?, to: place(to)? },
            Shape::Disk { centre, radius }
            | Shape::Ring { centre, radius }
            | Shape::Ball { centre, radius }
            | Shape::Shell { centre, radius } => {
                let is_hollow = matches!(shape, Shape::Ring { .. });
                Outline::Circle { centre: place(centre)?, radius: study.number(radius)?, is_hollow }
            }
            Shape::Box { centre, width, height } => {
                let ([x, y], w, h) =
                    (place(centre)?, study.number(width)? / 2.0, study.number(height)? / 2.0);
                Outline::Polygon(vec![[x - w, y - h], [x + w, y - h], [x + w, y + h], [x - w, y + h]])
            }
            Shape::Polygon { corners } => {
                Outline::Polygon(corners.iter().map(place).collect::<Result<_, _>>()?)
            }
        })
    };
    if body.parts.is_empty() {
        return Ok(vec![Outline::Point([0.0, 0.0])]);
    }
    body.parts.iter().map(|part| outline(&part.shape)).collect()
}
