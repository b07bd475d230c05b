//! The energy and momentum balance of a run as numbers: energies along it, what every load did, and what is left unexplained.

use serde::Serialize;
use tumble_mech::{Balance, BodyBalance, Contribution, RunBalance};
use tumble_ode::Side;

use crate::results::{Case, CaseError, equal_times};

/// Rows of `balance.csv`, beside both sides of each event.
const ROWS: usize = 500;
/// Angular momentum is about the world's origin.
pub const ABOUT: [f64; 2] = [0.0; 2];

/// Energy, momentum and what changed them, of one run.
#[derive(Clone, Debug)]
pub struct CaseBalance {
    /// Names of the columns of [`CaseBalance::rows`]: time (s), energies and works (J).
    pub columns: Vec<String>,
    /// The energies along the run.
    pub rows: Vec<Vec<f64>>,
    /// What every load did, each with a name that no other has.
    pub contributions: Vec<(String, Contribution)>,
    /// Errors of their works, J; `None` where nothing is known of them.
    pub work_errors: Option<Vec<f64>>,
    /// Kinetic and potential energy of all bodies, J.
    pub energy: Balance,
    /// Momentum (N s) and angular momentum about the origin (N m s) of all bodies.
    pub total: BodyBalance,
    /// The largest of all residuals, relative to what it is a residual of.
    pub relative: f64,
}

impl CaseBalance {
    /// The balance of a run; `None` where nothing moved.
    pub fn of(case: &Case) -> Result<Option<Self>, CaseError> {
        let run = &case.run;
        if run.is_empty() {
            return Ok(None);
        }
        let mut balance = RunBalance::of(run, ABOUT)?;
        let mut rows = vec![];
        for (time, side) in times(run) {
            rows.extend(balance.row(time, side)?);
        }
        let work_errors = match (&case.trust, run.end()) {
            (Some(trust), Some(end)) => trust.work_errors(run, &mut balance, end, Side::After)?,
            _ => None,
        };
        let contributions = balance.contributions.iter().enumerate();
        Ok(Some(Self {
            columns: balance.columns(),
            rows,
            contributions: contributions
                .map(|(index, contribution)| (balance.name_of(index), contribution.clone()))
                .collect(),
            work_errors,
            energy: balance.energy,
            total: balance.total,
            relative: balance.relative(),
        }))
    }
}

/// Equal steps, and both sides of each event.
fn times(run: &tumble_mech::Run) -> Vec<(f64, Side)> {
    let steps = equal_times(run, ROWS).map(|time| (time, Side::After));
    let events = run.events();
    let sides = events.flat_map(|event| [(event.time, Side::Before), (event.time, Side::After)]);
    let mut times: Vec<(f64, Side)> = steps.chain(sides).collect();
    let order = |side: Side| u8::from(side == Side::After);
    times.sort_by(|a, b| a.0.total_cmp(&b.0).then(order(a.1).cmp(&order(b.1))));
    times.dedup();
    times
}

/// The balance in `summary.json`.
#[derive(Clone, Debug, Serialize)]
pub struct Summary {
    energy: BalanceSummary,
    momentum: [BalanceSummary; 2],
    angular_momentum: BalanceSummary,
    largest_relative_residual: f64,
    contributions: Vec<ContributionSummary>,
}

#[derive(Clone, Debug, Serialize)]
struct BalanceSummary {
    start: f64,
    end: f64,
    accounted: f64,
    residual: f64,
}

#[derive(Clone, Debug, Serialize)]
struct ContributionSummary {
    name: String,
    kind: String,
    counts_as_work: bool,
    work: f64,
    impulse: [f64; 2],
    angular_impulse: f64,
}

impl Summary {
    /// What is told of a balance.
    pub fn of(case: &CaseBalance) -> Self {
        let balance = |balance: &Balance| BalanceSummary {
            start: balance.start,
            end: balance.end,
            accounted: balance.change,
            residual: balance.residual,
        };
        let contribution = |(name, contribution): &(String, Contribution)| ContributionSummary {
            name: name.clone(),
            kind: format!("{:?}", contribution.kind).to_lowercase(),
            counts_as_work: contribution.counts(),
            work: contribution.work,
            impulse: contribution.impulse,
            angular_impulse: contribution.angular_impulse,
        };
        let [x, y] = &case.total.momentum;
        Self {
            energy: balance(&case.energy),
            momentum: [balance(x), balance(y)],
            angular_momentum: balance(&case.total.angular_momentum),
            largest_relative_residual: case.relative,
            contributions: case.contributions.iter().map(contribution).collect(),
        }
    }
}
