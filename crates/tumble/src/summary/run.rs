//! What one run came to, as `summary.json` has it.

use std::collections::BTreeMap;
use std::io;

use serde::Serialize;
use tumble_mech::{MultipleImpacts, Spread};
use tumble_report::results::{BalanceSummary, EquilibriumSummary};
use tumble_scene::Study;

use super::{Said, said};
use tumble_report::results::{CheckResult, FindResult, Finished, Happened, is_angle, unit};

/// A new line of a run in the list of all.
const NEW_LINE: &str = "\n    ";

#[derive(Serialize)]
struct RunSummary<'a> {
    folder: String,
    label: &'a str,
    complete: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    stopped: Option<Stop>,
    parameters: BTreeMap<String, Quantity>,
    numerics: Numerics,
    end: End,
    events: Vec<Event<'a>>,
    finds: Vec<Find<'a>>,
    checks: Vec<Check<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    equilibrium: Option<EquilibriumSummary<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    warnings: Vec<Said>,
    #[serde(skip_serializing_if = "Option::is_none")]
    balance: Option<&'a BalanceSummary>,
}

#[derive(Serialize)]
struct Stop {
    time: f64,
    reason: String,
}

#[derive(Serialize)]
struct Quantity {
    value: f64,
    unit: String,
}

#[derive(Serialize)]
struct Numerics {
    accuracy: f64,
    order: usize,
    steps: u64,
    exact_steps: u64,
    rejected_steps: u64,
    modes: u64,
    sign_changes: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    contacts: Option<Contacts>,
    #[serde(skip_serializing_if = "Option::is_none")]
    quadrature: Option<Quadrature>,
    #[serde(skip_serializing_if = "Option::is_none")]
    trust: Option<Trust>,
}

/// What a check run says of the motion.
#[derive(Serialize)]
struct Trust {
    /// Accuracy that steps were held to.
    used_accuracy: f64,
    /// Error of the states at the end, or where the verified digits end, in units of their scales.
    reached: f64,
    /// Time after which no digit is verified; the end of the motion where they last.
    verified_until: f64,
    /// Why the check run diverged, if it did before the end.
    #[serde(skip_serializing_if = "Option::is_none")]
    divergence: Option<String>,
}

/// Where there are surfaces.
#[derive(Serialize)]
struct Contacts {
    /// Contacts, impacts included.
    count: usize,
    /// Times that impacts following each other ever faster have ended in contact.
    zeno_sequences: usize,
    /// How impacts of one body at one instant were taken.
    impacts: &'static str,
}

/// Sums that stand for integrals along lines.
#[derive(Serialize)]
struct Quadrature {
    nodes: usize,
    change: f64,
    settled: bool,
}

#[derive(Serialize)]
struct End {
    time: f64,
    states: BTreeMap<String, Quantity>,
}

#[derive(Serialize)]
struct Event<'a> {
    time: f64,
    what: &'a [String],
}

/// Numbers that are none are `null`.
#[derive(Serialize)]
struct Find<'a> {
    name: &'a str,
    that: &'a str,
    unit: &'a str,
    at: f64,
    value: f64,
    error: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    between: Option<[f64; 2]>,
    status: &'static str,
}

#[derive(Serialize)]
struct Check<'a> {
    name: &'a str,
    that: &'a str,
    unit: &'a str,
    at: f64,
    found: f64,
    expected: f64,
    within: f64,
    /// Error stated of what was found.
    error: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    between: Option<[f64; 2]>,
    holds: bool,
    status: &'static str,
}

/// The text of a run, as it stands in the list of all.
pub(crate) fn page(study: &Study, case: &Finished) -> io::Result<String> {
    let text = serde_json::to_string_pretty(&summary(study, case))?;
    // No line feed stands in a string of JSON.
    Ok(text.replace('\n', NEW_LINE))
}

fn summary<'a>(study: &Study, case: &'a Finished) -> RunSummary<'a> {
    RunSummary {
        folder: case.folder(),
        label: &case.label,
        complete: case.refusal.is_none(),
        stopped: case
            .refusal
            .as_ref()
            .map(|refusal| Stop { time: refusal.time, reason: refusal.reason.to_string() }),
        parameters: parameters(study, case),
        numerics: numerics(study, case),
        end: end(case),
        events: case.events.iter().map(|Happened { time, what, .. }| Event { time: *time, what }).collect(),
        finds: case.finds.iter().map(find).collect(),
        checks: case.checks.iter().map(check).collect(),
        equilibrium: case.equilibrium.as_ref().map(EquilibriumSummary::of),
        warnings: said(&case.said),
        balance: case.balance.as_ref(),
    }
}

fn parameters(study: &Study, case: &Finished) -> BTreeMap<String, Quantity> {
    let symbols = study.model.parameters.symbols().into_iter();
    let values = symbols.zip(&case.inputs);
    values
        .map(|(symbol, value)| {
            let is_angle = study.angles.contains(&*symbol.name);
            (symbol.name.to_string(), Quantity { value: *value, unit: unit(symbol.dimension, is_angle) })
        })
        .collect()
}

fn numerics(study: &Study, case: &Finished) -> Numerics {
    let work = case.work;
    Numerics {
        accuracy: case.accuracy.value(),
        order: case.order,
        steps: work.steps,
        exact_steps: work.exact_steps,
        rejected_steps: work.rejected,
        modes: work.modes,
        sign_changes: work.flips,
        contacts: contacts(study, case),
        trust: case.held.as_ref().map(|held| Trust {
            used_accuracy: held.used,
            reached: held.reached,
            verified_until: held.verified_until().min(case.end),
            divergence: held.horizon.as_ref().map(|horizon| horizon.reason.to_string()),
        }),
        quadrature: case.quadrature.map(|found| Quadrature {
            nodes: found.nodes,
            change: found.change,
            settled: found.settled,
        }),
    }
}

fn contacts(study: &Study, case: &Finished) -> Option<Contacts> {
    let impacts = match study.model.multiple_impacts {
        MultipleImpacts::Simultaneous => "simultaneous",
        MultipleImpacts::Sequential => "sequential",
    };
    let found = Contacts { count: case.contacts, zeno_sequences: case.zeno_sequences, impacts };
    (!study.model.surfaces.is_empty()).then_some(found)
}

fn end(case: &Finished) -> End {
    let named = case.states.iter().map(|(symbol, value)| {
        let unit = unit(symbol.dimension, is_angle(symbol));
        (symbol.name.to_string(), Quantity { value: *value, unit })
    });
    End { time: case.end, states: named.collect() }
}

/// The least and greatest of what is not unique.
fn between(spread: Spread) -> [f64; 2] {
    [spread.least, spread.greatest]
}

/// The value of what is unique.
fn only(value: f64, spread: Option<Spread>) -> f64 {
    spread.map_or(value, |_| f64::NAN)
}

fn find(result: &FindResult) -> Find<'_> {
    Find {
        name: &result.name,
        that: &result.that,
        unit: &result.unit,
        at: result.at,
        value: only(result.value, result.spread),
        error: result.error.filter(|_| !result.value.is_nan()),
        between: result.spread.map(between),
        status: result.status(),
    }
}

fn check(result: &CheckResult) -> Check<'_> {
    Check {
        name: &result.name,
        that: &result.that,
        unit: &result.unit,
        at: result.at,
        found: only(result.found, result.spread),
        expected: result.expected,
        within: result.within,
        error: result.error.filter(|_| !result.found.is_nan()),
        between: result.spread.map(between),
        holds: result.holds,
        status: result.status(),
    }
}
