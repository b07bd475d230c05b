//! What only the run knows up to an instant, by the names in finds and checks: works of loads, `floor.work`, and what [`tallies`] has.

use tumble_expr::{Expr, Symbol};
use tumble_mech::{At, Contribution, ContributionKind, RunBalance, Trust};
use tumble_ode::Side;

use crate::results::case::Solution;
use crate::results::known::{AllKnown, Known};
use crate::results::moments::is_part;
use crate::results::{ABOUT, CaseError, tallies};

/// How their names end.
const WORK: &str = ".work";

/// Those that a formula names, up to an instant; `None` outside the motion.
pub(crate) fn of(solution: Solution<'_>, formula: &Expr, at: At) -> Result<Option<AllKnown>, CaseError> {
    let symbols: Vec<Symbol> = formula.symbols().into_iter().filter(is_work).collect();
    if symbols.is_empty() {
        return Ok(Some(AllKnown::default()));
    }
    let (works, tallied): (Vec<Symbol>, Vec<Symbol>) =
        symbols.into_iter().partition(|symbol| symbol.name.ends_with(WORK));
    let tallies = tallied.into_iter().map(|symbol| {
        let tally = tallies::found(solution.run, &symbol.name, at)?;
        let error = solution.trust.and_then(|trust| tally.error(solution.run, trust, &symbol.name, at));
        Some((symbol, Known { value: tally.value, error, blur: tally.blur }))
    });
    let Some(mut known) = tallies.collect::<Option<Vec<_>>>() else { return Ok(None) };
    if works.is_empty() {
        return Ok(Some(AllKnown(known)));
    }
    let mut balance = RunBalance::of(solution.run, ABOUT)?;
    let Some(reading) = balance.at(at.time, at.side)? else { return Ok(None) };
    let errors = match solution.trust {
        Some(trust) => trust.work_errors(solution.run, &mut balance, at.time, at.side)?,
        None => None,
    };
    let [here, before] = around(solution, &mut balance, at)?;
    let whole = balance.contributions.iter().zip(&reading.work);
    let rounding: Vec<f64> = whole.map(|(contribution, work)| contribution.rounding(*work)).collect();
    let work = |symbol: Symbol| {
        let load = symbol.name.strip_suffix(WORK).unwrap_or_default();
        let sum = |of: &[f64]| -> f64 {
            let contributions = balance.contributions.iter().zip(of);
            contributions
                .filter(|(contribution, _)| is_work_of(contribution, load))
                .map(|(_, amount)| amount)
                .sum()
        };
        let moved = if before.is_empty() { 0.0 } else { (sum(&here) - sum(&before)).abs() };
        let (value, error) = (sum(&reading.work), errors.as_deref().map(sum));
        (symbol.clone(), Known { value, error, blur: moved + sum(&rounding) })
    };
    known.extend(works.into_iter().map(work));
    Ok(Some(AllKnown(known)))
}

/// The works at an event and a little before it: as far as rounding may have moved its time.
fn around(solution: Solution<'_>, balance: &mut RunBalance, at: At) -> Result<[Vec<f64>; 2], CaseError> {
    let late = if at.off > 0.0 { Trust::instant_blur(solution.run, at.time) } else { 0.0 };
    if late == 0.0 {
        return Ok([vec![], vec![]]);
    }
    let mut works = |time: f64, side: Side| {
        let reading = balance.at(time, side)?;
        Ok::<_, CaseError>(reading.map_or(vec![], |reading| reading.work))
    };
    Ok([works(at.time, Side::Before)?, works(at.time - late, Side::After)?])
}

/// Whether a symbol is the work of a load, an impulse or a count.
pub(crate) fn is_work(symbol: &Symbol) -> bool {
    symbol.name.ends_with(WORK) || tallies::is_tally(&symbol.name)
}

/// Whether a contribution is what the force of a load, or a part of a load such as one contact of a surface, did to a body.
fn is_work_of(contribution: &Contribution, load: &str) -> bool {
    is_part(&contribution.load, load)
        && matches!(
            contribution.kind,
            ContributionKind::Conservative | ContributionKind::Work | ContributionKind::Impact
        )
}
