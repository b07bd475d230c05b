//! Figures of the balance: energies, works, and what is left unexplained.

use tumble_drawing::{Axis, CurveFigure, DataSeries, Label};
use tumble_scene::{BalancePlot, Sheet, Study};

use crate::figures::{case_label, heading, joined};
use crate::results::{Case, CaseBalance};

/// The balances of some runs in one figure; empty where there are none.
pub(crate) fn of(study: &Study, cases: &[&Case], asked: &BalancePlot) -> CurveFigure {
    let mut figure = empty(heading(study, asked.title.as_deref(), &asked.name));
    for case in cases {
        let series = case.balance.iter().flat_map(|balance| curves(balance, asked.show));
        let of_case =
            |curve: DataSeries| DataSeries { label: joined(curve.label, case_label(case)), ..curve };
        figure.series.extend(series.map(of_case));
    }
    figure
}

/// One sheet of one run.
pub(crate) fn sheet(balance: &CaseBalance, title: &str, show: Sheet) -> CurveFigure {
    CurveFigure { series: curves(balance, show), ..empty(Label::markup(title)) }
}

fn empty(title: Label) -> CurveFigure {
    CurveFigure::new(
        title,
        Axis::new(Label::markup("time $t$"), "s"),
        Axis::new(Label::markup("energy $E$"), "J"),
    )
}

/// The columns of the balance that a sheet shows; a residual alone needs no name.
fn curves(balance: &CaseBalance, show: Sheet) -> Vec<DataSeries> {
    let name = |column: &str| match (show, column) {
        (Sheet::Energies, "kinetic" | "potential") => Some(column.to_owned()),
        (Sheet::Energies, "energy") => Some("total".to_owned()),
        (Sheet::Works, _) => column.strip_prefix("work of ").map(str::to_owned),
        (Sheet::Residual, "residual") => Some(String::new()),
        _ => None,
    };
    let columns = balance.columns.iter().enumerate();
    let shown = columns.filter_map(|(index, column)| Some((index, name(column)?)));
    let series = shown.map(|(index, name)| DataSeries {
        label: Label::plain(&name),
        points: balance.rows.iter().map(|row| [row[0], row[index]]).collect(),
        dotted: false,
    });
    series.collect()
}
