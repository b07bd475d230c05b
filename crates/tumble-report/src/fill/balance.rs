//! Energy, momentum, and what changed them, as tables and a figure.

use crate::report::{BalancePart, Chart, Column, PrintedTable, Text};
use tumble_drawing::Label;
use tumble_mech::{Balance, ContributionKind, Equations};
use tumble_scene::{Sheet, Study};

use super::names::{quantity, quantity_to};
use super::words;
use crate::figures::captions;
use crate::figures::energies::sheet;
use crate::results::{Case, CaseBalance};

/// What is less than this part of the largest of its kind in the run is zero but for rounding; a residual is told as it is.
const NOTHING: f64 = 1e-14;
/// Digits of a residual: none of it is verified, its size is what tells.
const SIZE: usize = 2;

const WHAT_IT_SAYS: &str = "Energy changes by the work of the loads without potential energy, momentum by the impulses of all loads. The residual is rounding error, \
     and what the integration left out.";

/// A run whose digits have ended has none at its end.
fn unverified(case: &Case) -> Option<Text> {
    let (until, end) = (case.verified_until(), case.run.end()?);
    let words = || Text::from("Digits are verified up to ").and(quantity(until, "s"));
    (until.is_finite() && until < end)
        .then(|| words().and("; what comes later is one of the motions that start almost alike."))
}

pub(super) fn of(study: &Study, case: &Case) -> Option<BalancePart> {
    let balance = case.balance.as_ref()?;
    Some(BalancePart {
        intro: std::iter::once(WHAT_IT_SAYS.into()).chain(unverified(case)).collect(),
        tables: vec![balances(balance), contributions(study, &case.run.equations, balance)],
        plots: energies(study, balance).into_iter().chain(residual(balance, case.accuracy.value())).collect(),
    })
}

/// The energies, where the scene does not show them by itself.
fn energies(study: &Study, balance: &CaseBalance) -> Option<Chart> {
    let is_asked = study.balances.iter().any(|asked| asked.show == Sheet::Energies);
    let figure = || sheet(balance, "Energies", Sheet::Energies);
    (!is_asked).then(|| Chart::over_time(figure(), captions::ENERGIES))
}

/// What is left of the energy, where it is more than the accuracy asked for: less is told by the table.
fn residual(balance: &CaseBalance, accuracy: f64) -> Option<Chart> {
    let figure = sheet(balance, "Residual of the energy", Sheet::Residual);
    let all = figure.series.iter().flat_map(|series| &series.points).map(|point| point[1].abs());
    let is_seen = all.fold(0.0, f64::max) > accuracy * balance.energy.scale;
    is_seen.then(|| Chart::over_time(figure, captions::RESIDUAL))
}

fn balances(balance: &CaseBalance) -> PrintedTable {
    let columns = vec![
        Column::words("Balance"),
        Column::numbers("At the start"),
        Column::numbers("At the end"),
        Column::numbers("Accounted for"),
        Column::numbers("Residual"),
    ];
    let row = |name: &str, unit: &str, of: &Balance| {
        let values = [of.start, of.end, of.change].map(|value| seen(value, of));
        let name = Text::from(format!("{name} (")).and(Label::unit(unit)).and(")");
        std::iter::once(name).chain(values).chain([quantity_to(of.residual, SIZE, "")]).collect()
    };
    let [x, y] = &balance.total.momentum;
    PrintedTable::new("The loads account for what changed.", columns)
        .row(row("Energy", "J", &balance.energy))
        .row(row("Momentum, x", "N*s", x))
        .row(row("Momentum, y", "N*s", y))
        .row(row("Angular momentum about the origin", "N*m*s", &balance.total.angular_momentum))
}

fn seen(value: f64, of: &Balance) -> Text {
    quantity(if value.abs() < NOTHING * of.scale { 0.0 } else { value }, "")
}

/// How a load has done its work, where it is not by its force along the way.
fn kind(kind: ContributionKind) -> &'static str {
    match kind {
        ContributionKind::Work => "",
        ContributionKind::Conservative => " (potential)",
        ContributionKind::Driven => " (moved from outside)",
        ContributionKind::Impact => " (impacts)",
        ContributionKind::ParameterJump => " (change of a parameter)",
        ContributionKind::Release => " (release)",
    }
}

fn contributions(study: &Study, equations: &Equations, balance: &CaseBalance) -> PrintedTable {
    let with = |words: &str, unit: &str| Text::from(format!("{words} (")).and(Label::unit(unit)).and(")");
    let columns = vec![
        Column::words("Load"),
        Column::numbers(with("Work", "J")),
        Column::numbers(with("Impulse, x", "N*s")),
        Column::numbers(with("Impulse, y", "N*s")),
        Column::numbers(with("Angular impulse", "N*m*s")),
    ];
    let mut table = PrintedTable::new("Each load contributes this much.", columns);
    for (index, (_, contribution)) in balance.contributions.iter().enumerate() {
        // Where its error is known, what is less is none.
        let error = balance.work_errors.as_ref().map_or(0.0, |errors| errors[index]);
        let work = if contribution.work.abs() <= error { 0.0 } else { contribution.work };
        let ([x, y], angular) = (&balance.total.momentum, &balance.total.angular_momentum);
        let cells = [
            seen(work, &balance.energy),
            seen(contribution.impulse[0], x),
            seen(contribution.impulse[1], y),
            seen(contribution.angular_impulse, angular),
        ];
        // What has done nothing is not told, such as a floor that does not move.
        if cells.iter().any(|cell| cell.to_plain() != "0") {
            let load = words::load(study, equations, &contribution.load, contribution.body);
            let name = Text::from(format!("{load}{}", kind(contribution.kind)));
            table.rows.push(std::iter::once(name).chain(cells).collect());
        }
    }
    if balance.contributions.iter().any(|(_, contribution)| !contribution.counts()) {
        table.notes.push("Work marked (potential) is already in the potential energy.".into());
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::motions_called;

    #[test]
    fn work_that_is_less_than_its_error_is_none() {
        let (study, mut cases) = motions_called("03-bouncing-rod");
        cases[0].balance = CaseBalance::of(&cases[0]).expect("a balance");
        let part = of(&study, &cases[0]).expect("a balance");
        let works: Vec<[String; 2]> =
            part.tables[1].rows.iter().map(|row| [row[0].to_plain(), row[1].to_plain()]).collect();
        // A floor without damping gives back all that it takes.
        let floor = |point: &str| [format!("the floor on the {point} (potential)"), "0".to_owned()];
        assert!(works.contains(&floor("tail")) && works.contains(&floor("tip")), "{works:?}");
        assert!(works[0][0] == "gravity (potential)" && works[0][1] != "0", "{works:?}");
    }
}
