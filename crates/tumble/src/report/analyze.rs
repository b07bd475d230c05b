//! What the motion says: curves, pictures, balance, checks, and what was found.

use tumble_expr::Expr;
use tumble_mech::Extreme;
use tumble_ode::Side;
use tumble_report::numeral;
use tumble_report::report::{Analyze, Case as CaseShown, Check, Column, Picture, Plot, Table, Text};
use tumble_scene::{Instant, Study};

use super::names::{Names, quantity};
use super::{animation, balance, findings};
use crate::balance_figures;
use crate::case::Case;
use crate::checks::CheckResult;
use crate::equilibrium;
use crate::figures;
use crate::moments::Moments;
use crate::pipeline::PipelineError;

/// Digits of an error: its size is what counts.
const ERROR_DIGITS: usize = 1;

pub(super) fn of(study: &Study, names: &Names, cases: &[Case]) -> Result<Analyze, PipelineError> {
    Ok(Analyze {
        intro: vec![],
        animation: Some(animation::of(study, cases)?),
        plots: plots(study, cases)?,
        pictures: pictures(study, cases)?,
        comparison: comparison(study, names, cases)?,
        cases: cases.iter().map(one).collect::<Result<_, _>>()?,
        checks: vec![],
        findings: findings::of(study, cases)?,
    })
}

fn plots(study: &Study, cases: &[Case]) -> Result<Vec<Plot>, PipelineError> {
    let plot = |plot: &tumble_scene::Plot| {
        let figure = figures::curves(study, cases, plot)?;
        let shown = match plot.x {
            None => Plot::over_time(figure, Text::default()),
            Some(_) => Plot::new(figure, Text::default()),
        };
        Ok(shown.stored(format!("{}.svg", plot.name)))
    };
    let balances = study.balances.iter().map(|asked| {
        let figure = balance_figures::of(study, cases, asked);
        Ok(Plot::over_time(figure, Text::default()).stored(format!("{}.svg", asked.name)))
    });
    study.plots.iter().map(plot).chain(balances).collect()
}

fn pictures(study: &Study, cases: &[Case]) -> Result<Vec<Picture>, PipelineError> {
    let picture = |asked: &tumble_scene::Stroboscope| {
        let svg = figures::picture(study, cases, asked)?.svg();
        Ok(Picture::new(svg, Text::default()).stored(format!("{}.svg", asked.name)))
    };
    study.stroboscopes.iter().map(picture).collect()
}

/// The runs of a sweep side by side.
fn comparison(study: &Study, names: &Names, cases: &[Case]) -> Result<Option<Table>, PipelineError> {
    if cases.len() < 2 {
        return Ok(None);
    }
    let over_time = study.plots.iter().filter(|plot| plot.x.is_none());
    let curves: Vec<_> =
        over_time.flat_map(|plot| plot.y.iter().map(|curve| (curve, plot.during.as_ref()))).collect();
    let mut columns = vec![Column::words("Run"), Column::numbers("Events")];
    for (curve, _) in &curves {
        let unit = &curve.quantity.unit;
        let unit = if unit.is_empty() { String::new() } else { format!(" ({unit})") };
        let name = match &curve.label {
            Some(label) => label.as_str().into(),
            None => Text::from(names.label(&curve.text)),
        };
        let head = |what: &str| Text::from(format!("{what} ")).and(name.clone()).and(unit.clone());
        columns.extend([
            Column::numbers(head("least")),
            Column::numbers(head("greatest")),
            Column::numbers(head("last")),
        ]);
    }
    let mut table = Table::new("The runs side by side", columns);
    for case in cases {
        let study = study.with(&case.parameters);
        let mut cells =
            vec![Text::from(figures::case_label(case)), case.run.events().count().to_string().into()];
        for (curve, during) in &curves {
            let values = least_greatest_last(&study, case, &curve.quantity.formula, *during)?;
            cells.extend(values.map(|value| quantity(value, "")));
        }
        table.rows.push(cells);
    }
    Ok(Some(table))
}

/// What a curve comes to in one run; no numbers where it is not there.
fn least_greatest_last(
    study: &Study,
    case: &Case,
    formula: &Expr,
    during: Option<&[Instant; 2]>,
) -> Result<[f64; 3], PipelineError> {
    let (run, moments) = (&case.run, Moments::of(study, case.solution()));
    let (Some(formula), Some(window), Some(end)) =
        (moments.known(formula).map(|timed| timed.formula), moments.window(during)?, run.end())
    else {
        return Ok([f64::NAN; 3]);
    };
    // A curve with so many corners that its extremes cannot be told has none here.
    let extreme = |which| run.extreme(&formula, which, window).ok().flatten().map(|peak| peak.value);
    let last = run.observe(std::slice::from_ref(&formula))?.at(window[1].min(end), Side::After);
    let found = [extreme(Extreme::Least), extreme(Extreme::Greatest), last.map(|values| values[0])];
    Ok(found.map(|value| value.unwrap_or(f64::NAN)))
}

fn one(case: &Case) -> Result<CaseShown, PipelineError> {
    let stopped =
        case.refusal.as_ref().map(|refusal| Text::from(format!("This run is incomplete: {refusal}.")));
    Ok(CaseShown {
        name: figures::case_label(case),
        intro: stopped.into_iter().collect(),
        balance: balance::of(case),
        tables: case.equilibrium.as_ref().map(equilibrium::tables).unwrap_or_default(),
        checks: case.checks.iter().map(shown).collect(),
        ..CaseShown::default()
    })
}

fn shown(check: &CheckResult) -> Check {
    let unit = check.unit.as_str();
    let what = Text::from(format!("{}: {}", check.name, check.that));
    let at =
        if check.at.is_finite() { Text::from(" at ").and(quantity(check.at, "s")) } else { Text::default() };
    Check {
        what: what.and(at),
        expected: precise(check.expected, unit),
        found: match check.open() {
            _ if !check.is_reached() => check.status().into(),
            Some(open) => open.into(),
            None => precise(check.found, unit).and(error(check)),
        },
        within: precise(check.within, unit),
        passed: check.holds,
    }
}

/// By how much it may be off.
fn error(check: &CheckResult) -> Text {
    match check.error {
        Some(error) => Text::from(" ± ").and(numeral::significant(error, ERROR_DIGITS)),
        None => Text::default(),
    }
}

/// Every digit: what was compared.
fn precise(value: f64, unit: &str) -> Text {
    if !value.is_finite() {
        return "–".into();
    }
    let number = Text::from(format!("{value:?}").replace('-', "−"));
    if unit.is_empty() { number } else { number.and("\u{a0}").and(tumble_report::Label::unit(unit)) }
}
