//! Many runs in one figure: between which values a quantity is, at every instant, over all runs that still go on.

use tumble_drawing::{Band, CurveFigure, DataSeries, Label};
use tumble_expr::Expr;
use tumble_ode::Side;
use tumble_scene::{Plot, Study};

use crate::figures::{joined, label};
use crate::results::moments::Moments;
use crate::results::{Case, CaseError};

/// Instants at which the runs are compared: about the pixels across a figure.
const INSTANTS: usize = 600;
/// Fewer runs have no quarters.
const LEAST: usize = 4;
/// How strong the colours are of all runs and of the half of them in the middle.
const ALL: f64 = 0.15;
const MIDDLE: f64 = 0.35;

/// Adds bands from the least to the greatest and of the half in the middle, and the median, for each curve of the figure over time.
pub(super) fn add(
    figure: &mut CurveFigure,
    study: &Study,
    cases: &[Case],
    plot: &Plot,
) -> Result<(), CaseError> {
    let times = times(cases);
    for curve in &plot.y {
        let mut values: Vec<Vec<f64>> = vec![vec![]; times.len()];
        for case in cases {
            gather(&mut values, &times, study, case, plot, &curve.quantity.formula)?;
        }
        values.iter_mut().for_each(|values| values.sort_unstable_by(f64::total_cmp));
        let name = if plot.y.len() > 1 { label(study, curve) } else { Label::default() };
        let named = |what: &str| joined(name.clone(), Label::plain(what));
        let place = figure.series.len();
        let between = |low: f64, high: f64| {
            let points = times.iter().zip(&values);
            points.map(|(t, values)| [*t, part(values, low), part(values, high)]).collect()
        };
        let band =
            |what: &str, points, strength| Band { label: named(what), points, series: place, strength };
        figure.bands.push(band(&format!("all {} runs", cases.len()), between(0.0, 1.0), ALL));
        figure.bands.push(band("half of them", between(0.25, 0.75), MIDDLE));
        let median = times.iter().zip(&values).map(|(t, values)| [*t, part(values, 0.5)]).collect();
        figure.series.push(DataSeries { label: named("median"), points: median, dotted: false });
    }
    Ok(())
}

/// Equal steps to the end of the longest run.
fn times(cases: &[Case]) -> Vec<f64> {
    let end = cases.iter().filter_map(|case| case.run.end()).fold(0.0, f64::max);
    (0..=INSTANTS).map(|index| end * index as f64 / INSTANTS as f64).collect()
}

/// Adds what a run has at those instants at which the figure shows it.
fn gather(
    values: &mut [Vec<f64>],
    times: &[f64],
    study: &Study,
    case: &Case,
    plot: &Plot,
    formula: &Expr,
) -> Result<(), CaseError> {
    let study = &study.with(&case.parameters);
    let moments = Moments::of(study, case.solution());
    let (Some(timed), Some([from, to]), Some(end)) =
        (moments.known(formula), moments.window(plot.during.as_ref())?, case.run.end())
    else {
        return Ok(());
    };
    let mut observer = case.run.observe(std::slice::from_ref(&timed.formula))?;
    for (time, values) in times.iter().zip(values) {
        if *time < from || *time > to.min(end) {
            continue;
        }
        values
            .extend(observer.at(*time, Side::After).map(|found| found[0]).filter(|value| value.is_finite()));
    }
    Ok(())
}

/// The value that a part of all do not reach, between neighbours; none of too few.
fn part(sorted: &[f64], part: f64) -> f64 {
    if sorted.len() < LEAST {
        return f64::NAN;
    }
    let place = part * (sorted.len() - 1) as f64;
    let below = place as usize;
    let above = (below + 1).min(sorted.len() - 1);
    sorted[below] + (place - below as f64) * (sorted[above] - sorted[below])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarters_lie_between_neighbours() {
        let sorted = [1.0, 2.0, 3.0, 5.0];
        let found = [0.0, 0.25, 0.5, 1.0].map(|share| part(&sorted, share));
        assert_eq!(found, [1.0, 1.75, 2.5, 5.0]);
        assert!(part(&sorted[..3], 0.5).is_nan());
    }
}
