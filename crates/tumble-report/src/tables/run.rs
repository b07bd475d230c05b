//! The tables of one run.

use std::collections::HashSet;

use tumble_expr::Expr;
use tumble_mech::{Pair, Rule, Run};
use tumble_scene::Study;

use super::{TableWriter, VERIFIED, column, verified};
use crate::results::{Case, CaseError, is_angle, sample, unit};

/// A row a time: every quantity that the scene shows.
pub fn trajectory<T: TableWriter>(study: &Study, case: &Case, table: &mut T) -> Result<(), T::Error> {
    let study = &study.with(&case.parameters);
    let apart = apart(&case.run);
    // The time is the first column.
    let is_shown = |name: &str| name != "t" && !couple(name).is_some_and(|couple| apart.contains(couple));
    let shown = || study.quantities.iter().filter(|(name, _)| is_shown(name));
    let formulas: Vec<Expr> = shown().map(|(_, quantity)| quantity.formula.clone()).collect();
    let header = shown().map(|(name, quantity)| column(name, &quantity.unit));
    let first = ["t [s]".to_owned(), "phase".to_owned()];
    table.row(first.into_iter().chain(header).chain([VERIFIED.to_owned()]))?;
    for row in sample(study, &case.run, &formulas)? {
        table.numbers(&[row.time]);
        table.text(&row.phase.to_string());
        table.numbers(&row.values);
        table.text(verified(case.is_verified(row.time)));
        table.end_row()?;
    }
    Ok(())
}

/// Names of couples that might have met, since all bodies may, and have not: of a hundred bodies these are some five thousand, with several columns
/// each.
fn apart(run: &Run) -> HashSet<String> {
    let (model, pairs) = (run.equations.model(), run.equations.pairs());
    let name = |pair: &Pair| {
        let (Rule::Bodies(rule), Some(other)) = (pair.rule, pair.other) else { return None };
        let [first, second] = [pair.body, other].map(|body| &model.bodies[body].name);
        let contact = Some(&model.contacts[rule]).filter(|contact| contact.between.is_none())?;
        Some(format!("{}.{first}.{second}", contact.name))
    };
    let met: HashSet<String> =
        run.contacts().iter().filter_map(|contact| name(&pairs[contact.pair])).collect();
    pairs.iter().filter_map(name).filter(|name| !met.contains(name)).collect()
}

/// The couple that a quantity may be of: `all.b1.b2` of `all.b1.b2.gap`.
fn couple(name: &str) -> Option<&str> {
    name.match_indices('.').nth(2).map(|(end, _)| &name[..end])
}

/// A row an event: what happened, and every state just before and just after.
pub fn events<T: TableWriter>(case: &Case, table: &mut T) -> Result<(), T::Error> {
    let run = &case.run;
    // What some modes have beyond the states of the bodies is the integrator's own.
    let states = run.equations.states(&run.equations.idle_mode());
    let columns = ["before", "after"].into_iter().flat_map(|side| {
        states
            .iter()
            .map(move |state| format!("{side} {} [{}]", state.name, unit(state.dimension, is_angle(state))))
    });
    let first = ["t [s]".to_owned(), "what".to_owned()];
    table.row(first.into_iter().chain(columns).chain([VERIFIED.to_owned()]))?;
    let formulas: Vec<Expr> = states.iter().map(|state| state.clone().into()).collect();
    let mut observer = run.observe(&formulas).map_err(CaseError::from)?;
    for (index, event) in run.events().enumerate() {
        table.numbers(&[event.time]);
        table.text(&run.equations.names_of(&event.record).join(", "));
        for values in observer.at_event(index).into_iter().flatten() {
            table.numbers(&values);
        }
        table.text(verified(case.is_verified(event.time)));
        table.end_row()?;
    }
    Ok(())
}

/// A row a time: energies, and works up to it; nothing where no balance was made.
pub fn balance<T: TableWriter>(case: &Case, table: &mut T) -> Result<(), T::Error> {
    let Some(balance) = &case.balance else { return Ok(()) };
    let units = |name: &String| if name == "t" { "t [s]".to_owned() } else { format!("{name} [J]") };
    table.row(balance.columns.iter().map(units).chain([VERIFIED.to_owned()]))?;
    for row in &balance.rows {
        table.numbers(row);
        table.text(verified(case.is_verified(row[0])));
        table.end_row()?;
    }
    Ok(())
}
