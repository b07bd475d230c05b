//! What the motion says: curves, pictures, balance, checks, and what was found.

use crate::report::{Analyze, Chart, CheckRow, Column, Picture, PrintedTable, RunAnalysis, Text};
use tumble_drawing::Label;
use tumble_expr::Expr;
use tumble_expr::language::{is_name, parse};
use tumble_mech::Extreme;
use tumble_ode::Side;
use tumble_scene::{Instant, Study};

use super::names::{Names, in_degrees, quantity, quantity_to};
use super::words::spoken;
use super::{animation, balance, findings, sweep};
use crate::figures::{self, captions, symbols};
use crate::results::moments::Moments;
use crate::results::{Case, CaseError, CheckResult, Runs, equilibrium, telling};

/// Digits of an error: its size is what counts.
const ERROR_DIGITS: usize = 1;
/// Digits of what is expected beyond those that are compared.
const FINER: f64 = 3.0;
/// Doubles have no more digits.
const MOST_DIGITS: f64 = 17.0;
/// Digits of what is expected, at most: the last ones of a double are rounding.
const MOST_EXPECTED: f64 = 15.0;
/// What is less than this part of the largest value of a curve is zero but for rounding.
const NOTHING: f64 = 1e-15;

pub(super) fn of(study: &Study, names: &Names, runs: Runs<'_>) -> Result<Analyze, CaseError> {
    let told = telling(runs.cases);
    let (mut plots, mut pictures) = (sweep::curves(study, runs.survey), sweep::maps(study, runs.survey));
    plots.extend(self::plots(study, runs.cases, &told)?);
    pictures.extend(self::pictures(study, &told)?);
    let findings = findings::of(study, runs, &told)?;
    let verified = (!findings.is_empty()).then(|| findings::ALL_VERIFIED.into());
    Ok(Analyze {
        intro: sweep::which_are_shown(runs.cases, &told).into_iter().chain(verified).collect(),
        animation: Some(animation::of(study, &told)?),
        plots,
        pictures,
        comparison: comparison(study, names, runs.cases, &told)?,
        cases: cases(study, names, &told)?,
        checks: vec![],
        findings,
    })
}

/// What belongs to single runs; what a balance is, the first says.
fn cases(study: &Study, names: &Names, told: &[&Case]) -> Result<Vec<RunAnalysis>, CaseError> {
    let mut cases: Vec<RunAnalysis> =
        told.iter().map(|case| one(study, names, case)).collect::<Result<_, _>>()?;
    for balance in cases.iter_mut().skip(1).flat_map(|case| &mut case.balance) {
        balance.intro.clear();
        balance.tables.iter_mut().for_each(|table| table.notes.clear());
    }
    Ok(cases)
}

fn plots(study: &Study, cases: &[Case], told: &[&Case]) -> Result<Vec<Chart>, CaseError> {
    let plot = |plot: &tumble_scene::Plot| {
        let figure = figures::curves(study, cases, plot)?;
        let caption = captions::curves(&figure);
        let shown = match plot.x {
            None => Chart::over_time(figure, caption),
            Some(_) => Chart::new(figure, caption),
        };
        Ok(shown.stored(format!("{}.svg", plot.name)))
    };
    let balances = study.balances.iter().map(|asked| {
        let figure = figures::energies::of(study, told, asked);
        let caption = captions::curves(&figure);
        Ok(Chart::over_time(figure, caption).stored(format!("{}.svg", asked.name)))
    });
    study.plots.iter().map(plot).chain(balances).collect()
}

fn pictures(study: &Study, told: &[&Case]) -> Result<Vec<Picture>, CaseError> {
    let picture = |asked: &tumble_scene::Stroboscope| {
        let svg = figures::picture(study, told, asked)?.svg();
        Ok(Picture::new(svg, captions::stroboscope(study, asked)?).stored(format!("{}.svg", asked.name)))
    };
    study.stroboscopes.iter().map(picture).collect()
}

/// The runs of a sweep side by side.
fn comparison(
    study: &Study,
    names: &Names,
    cases: &[Case],
    told: &[&Case],
) -> Result<Option<PrintedTable>, CaseError> {
    if cases.len() < 2 {
        return Ok(None);
    }
    let over_time = study.plots.iter().filter(|plot| plot.x.is_none());
    let curves: Vec<_> =
        over_time.flat_map(|plot| plot.y.iter().map(|curve| (curve, plot.during.as_ref()))).collect();
    let mut columns = vec![Column::words("Run")];
    columns.extend(study.finds.iter().map(|find| sweep::find_column(study, find)));
    columns.push(Column::numbers("Events"));
    for (curve, _) in &curves {
        let name = match &curve.label {
            Some(label) => label.as_str().into(),
            None => Text::from(names.label(&curve.text)),
        };
        let head = |what: &str| Text::from(format!("{what} ")).and(name.clone());
        let column = |what| Column::numbers(sweep::in_unit(head(what), &curve.quantity.unit));
        columns.extend(["least", "greatest", "last"].map(column));
    }
    let mut table = PrintedTable::new("The runs are shown side by side.", columns);
    let has_events = told.iter().any(|case| case.run.events().next().is_some());
    for case in told {
        let study = study.with(&case.parameters);
        let mut cells = vec![Text::from(figures::case_label(case))];
        cells.extend(case.finds.iter().map(sweep::find_cell));
        let count = case.run.events().count();
        cells.push(if has_events { count.to_string().into() } else { Text::default() });
        for (curve, during) in &curves {
            let values = least_greatest_last(&study, case, &curve.quantity.formula, *during)?;
            cells.extend(values.map(|value| quantity(value, "")));
        }
        table.rows.push(cells);
    }
    table.notes.extend(sweep::others_are_in_files(cases, told));
    Ok(Some(table.upright()))
}

/// What a curve comes to in one run; no numbers where it is not there.
fn least_greatest_last(
    study: &Study,
    case: &Case,
    formula: &Expr,
    during: Option<&[Instant; 2]>,
) -> Result<[f64; 3], CaseError> {
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
    let found = found.map(|value| value.unwrap_or(f64::NAN));
    let largest = found.into_iter().map(f64::abs).fold(0.0, f64::max);
    Ok(found.map(|value| if value.abs() < NOTHING * largest { 0.0 } else { value }))
}

fn one(study: &Study, names: &Names, case: &Case) -> Result<RunAnalysis, CaseError> {
    let stopped =
        case.refusal.as_ref().map(|refusal| Text::from(format!("This run is incomplete: {refusal}.")));
    Ok(RunAnalysis {
        name: figures::case_label(case),
        intro: stopped.into_iter().collect(),
        balance: balance::of(study, case),
        tables: case.equilibrium.as_ref().map(equilibrium::tables).unwrap_or_default(),
        checks: case.checks.iter().map(|check| shown(study, names, check)).collect(),
        ..RunAnalysis::default()
    })
}

/// What is claimed of what: in words, or as the formula was written.
fn asked(study: &Study, names: &Names, check: &CheckResult) -> Text {
    let text = symbols::without_unit(&check.that);
    let formula = parse(text).ok().filter(|_| !is_name(text));
    formula.map_or_else(
        || symbols::called(study, &symbols::all(study), text).into(),
        |formula| names.as_written(study, &formula).into(),
    )
}

fn shown(study: &Study, names: &Names, check: &CheckResult) -> CheckRow {
    let unit = check.unit.as_str();
    let that = asked(study, names, check);
    let name = spoken(&check.name);
    // A name that says the same says nothing.
    let is_its_own = symbols::last(symbols::without_unit(&check.that)) == check.name;
    let what = match is_its_own || that.to_plain().contains(&name) {
        true => that,
        false => Text::from(format!("{name}: ")).and(that),
    };
    let is_moment = symbols::is_moment(study, symbols::without_unit(&check.that));
    let at = match check.at.is_finite() && !is_moment {
        true => Text::from(" at ").and(quantity(check.at, "s")),
        false => Text::default(),
    };
    let degrees = in_degrees(check.expected, MOST_DIGITS as usize, unit);
    CheckRow {
        what: what.and(at),
        expected: precise(without_rounding(check), unit).and(degrees),
        found: match check.open() {
            _ if !check.is_reached() => check.status().into(),
            Some(open) => open.into(),
            None => found(check),
        },
        within: precise(check.within, unit),
        passed: check.holds,
        is_sure: check.is_sure(),
        is_of_other_values: study.is_set,
    }
}

/// What was found, with its error, to the place of that, and no finer than what is expected: digits beyond say nothing.
fn found(check: &CheckResult) -> Text {
    let (found, unit) = (check.found, check.unit.as_str());
    let error = check.error.filter(|error| *error > 0.0);
    if error.is_some_and(|error| found.abs() <= error) {
        return precise(0.0, unit).and(self::error(check));
    }
    let known = error.map_or(f64::INFINITY, |error| digits_to(found, error) + 1.0);
    let digits = (digits_to(found, check.within) + FINER).max(FINER).min(known);
    let value = match digits.is_finite() {
        true => quantity_to(found, digits.clamp(1.0, MOST_DIGITS) as usize, unit),
        false => precise(found, unit),
    };
    value.and(self::error(check)).and(in_degrees(found, digits.clamp(1.0, MOST_DIGITS) as usize, unit))
}

/// Digits before the place of another value.
fn digits_to(value: f64, other: f64) -> f64 {
    let place = |value: f64| value.abs().log10().floor();
    place(value) - place(other)
}

/// By how much it may be off.
fn error(check: &CheckResult) -> Text {
    match check.error {
        Some(error) => Text::from(" ± ").and(Label::number(error, ERROR_DIGITS)),
        None => Text::default(),
    }
}

/// What is expected, a little finer than it is compared: further digits are rounding of its formula.
fn without_rounding(check: &CheckResult) -> f64 {
    let digits = digits_to(check.expected, check.within) + FINER;
    let places = if digits.is_finite() { digits.clamp(FINER, MOST_EXPECTED) - 1.0 } else { MOST_DIGITS };
    format!("{:.*e}", places as usize, check.expected).parse().unwrap_or(check.expected)
}

/// Every digit: what was compared.
fn precise(value: f64, unit: &str) -> Text {
    if !value.is_finite() {
        return "–".into();
    }
    let number = Text::from(Label::exact(value));
    if unit.is_empty() { number } else { number.and("\u{a0}").and(tumble_drawing::Label::unit(unit)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(value: f64, within: f64, error: Option<f64>) -> CheckResult {
        CheckResult {
            name: String::new(),
            that: String::new(),
            unit: String::new(),
            at: 0.0,
            found: value,
            expected: value,
            within,
            error,
            spread: None,
            holds: true,
        }
    }

    #[test]
    fn what_is_expected_is_shown_a_little_finer_than_it_is_compared() {
        let shown = |value: f64, within: f64| without_rounding(&check(value, within, None));
        assert_eq!(shown(1.136_799_999_999_999_1, 1e-12), 1.1368);
        assert_eq!(shown(318.825_000_000_000_8, 1e-7), 318.825);
        assert_eq!(shown(10.217_161_074_258_682, 3.0), 10.22);
        assert_eq!(shown(7.699_999_999_999_999, 1e-14), 7.7);
        assert_eq!(shown(-1e-3, 0.5), -1e-3);
        assert_eq!((shown(0.0, 1e-9), shown(0.1 + 0.2, 0.0)), (0.0, 0.1 + 0.2));
    }

    #[test]
    fn degrees_stand_beside_radians() {
        let shown = |value: f64, digits: usize, unit: &str| in_degrees(value, digits, unit).to_plain();
        assert_eq!(shown(std::f64::consts::FRAC_PI_6, 9, "rad"), "\u{a0}(30°)");
        assert_eq!([shown(1.2, 9, "rad"), shown(1.2, 2, "rad")], ["\u{a0}(68.75°)", "\u{a0}(69°)"]);
        let nothing =
            [shown(0.0, 9, "rad"), shown(f64::NAN, 9, "rad"), shown(1.2, 9, "rad/s"), shown(1.2, 9, "")];
        assert_eq!(nothing, [""; 4]);
    }

    #[test]
    fn degrees_stand_beside_an_angle_that_was_found() {
        let shown = |value: f64, error: Option<f64>, unit: &str| {
            found(&CheckResult { unit: unit.to_owned(), ..check(value, 0.0, error) }).to_plain()
        };
        assert_eq!(shown(1.2, Some(0.001), "rad"), "1.2\u{a0}rad ± 0.001\u{a0}(68.75°)");
        assert_eq!(shown(1.2, Some(0.02), "rad"), "1.2\u{a0}rad ± 0.02\u{a0}(68.8°)");
        assert_eq!(shown(1.5, None, "rad"), "1.5\u{a0}rad\u{a0}(85.94°)");
        assert_eq!(shown(1e-12, Some(0.001), "rad"), "0\u{a0}rad ± 0.001");
        assert_eq!(shown(68.75, Some(0.001), "deg"), "68.75° ± 0.001");
    }

    #[test]
    fn what_was_found_is_shown_to_the_place_of_its_error() {
        let shown = |value: f64, error: Option<f64>| {
            let found = found(&check(value, 0.0, error)).to_plain();
            found.split(" ± ").next().map(str::to_owned).unwrap_or_default()
        };
        // As fine as what is expected.
        let compared = |value: f64, within: f64| found(&check(value, within, None)).to_plain();
        assert_eq!(compared(12.593_993_869_568_88, 3.0), "12.59");
        assert_eq!(compared(0.1 + 0.2, 1e-9), "0.3");
        assert_eq!(shown(1.024_690_108_640_719_6, Some(1e-14)), "1.02469010864072");
        assert_eq!(shown(1.024_690_108_640_719_6, Some(1.6e-14)), "1.02469010864072");
        assert_eq!(shown(6.93e-16, Some(5e-12)), "0");
        assert_eq!(shown(374.999_999_999_999_9, Some(7e-10)), "375");
        // Nothing is known of it, or it is exact.
        assert_eq!(shown(0.1 + 0.2, None), "0.30000000000000004");
        assert_eq!(shown(0.1 + 0.2, Some(0.0)), "0.30000000000000004");
    }
}
