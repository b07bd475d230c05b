//! Works of loads up to an instant, by the names they have in checks: `floor.work`.

use tumble_expr::{Expr, Substitution, Symbol, units};
use tumble_mech::{At, Contribution, Kind, RunBalance};

use crate::balance::ABOUT;
use crate::case::Solution;
use crate::pipeline::PipelineError;

/// How their names end.
const WORK: &str = ".work";

/// A formula with its works as numbers.
pub(crate) struct Known {
    /// The formula with the works that were found.
    pub(crate) formula: Expr,
    /// What it may be instead: for each work, the formula with that work off by its error.
    pub(crate) variants: Vec<Expr>,
    /// For each work, the formula with that one off by what the potentials are known to at most.
    pub(crate) blurred: Vec<Expr>,
    /// Whether all errors are known.
    pub(crate) is_sure: bool,
}

/// Puts in the works that loads have done up to an instant; `None` outside the motion.
pub(crate) fn known(solution: Solution<'_>, formula: Expr, at: At) -> Result<Option<Known>, PipelineError> {
    let symbols: Vec<Symbol> = formula.symbols().into_iter().filter(is_work).collect();
    if symbols.is_empty() {
        return Ok(Some(Known { formula, variants: vec![], blurred: vec![], is_sure: true }));
    }
    let mut balance = RunBalance::of(solution.run, ABOUT)?;
    let Some(reading) = balance.at(at.time, at.side)? else { return Ok(None) };
    let errors = match solution.trust {
        Some(trust) => trust.work_errors(&mut balance, at.time, at.side)?,
        None => None,
    };
    let sum = |symbol: &Symbol, of: &[f64]| -> f64 {
        let load = symbol.name.strip_suffix(WORK).unwrap_or_default();
        let contributions = balance.contributions.iter().zip(of);
        contributions
            .filter(|(contribution, _)| is_work_of(contribution, load))
            .map(|(_, amount)| amount)
            .sum()
    };
    let blur = match solution.trust {
        Some(trust) => trust.potential_error(solution.run, at)?.unwrap_or(0.0),
        None => 0.0,
    };
    let with = |off: Option<usize>, by: &dyn Fn(&Symbol) -> f64| {
        let mut found = Substitution::default();
        for (index, symbol) in symbols.iter().enumerate() {
            let error = if off == Some(index) { by(symbol) } else { 0.0 };
            found.insert(symbol.clone(), Expr::from(sum(symbol, &reading.work) + error) * units::J);
        }
        found.apply(&formula)
    };
    let each = |by: &dyn Fn(&Symbol) -> f64| (0..symbols.len()).map(|index| with(Some(index), by)).collect();
    let error = |symbol: &Symbol| errors.as_ref().map_or(0.0, |errors| sum(symbol, errors));
    Ok(Some(Known {
        formula: with(None, &|_| 0.0),
        variants: each(&error),
        blurred: each(&|_| blur),
        is_sure: errors.is_some(),
    }))
}

/// Whether a symbol is the work of a load.
pub(crate) fn is_work(symbol: &Symbol) -> bool {
    symbol.name.ends_with(WORK)
}

/// Whether a contribution is what the force of a load, or a part of a load such as one contact of a surface, did to a body.
fn is_work_of(contribution: &Contribution, load: &str) -> bool {
    let rest = contribution.load.strip_prefix(load);
    let is_part = rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'));
    is_part && matches!(contribution.kind, Kind::Conservative | Kind::Work | Kind::Impact)
}
