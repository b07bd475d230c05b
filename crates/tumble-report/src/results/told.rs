//! What a run came to, in lines for people: the command prints them, and the page shows them.

use tumble_mech::Extreme;

use crate::results::{CheckResult, FindResult, Finished, Located};

/// Of a time that does not come.
const NOT_REACHED: &str = "not reached: its event or its time does not come in this motion";
/// Smaller numbers are written with a power of ten.
const SMALL: f64 = 1e-5;

impl Finished {
    /// What it came to.
    pub fn told(&self) -> String {
        let Self { end, work, .. } = self;
        let label = if self.label.is_empty() { String::new() } else { format!("{}: ", self.label) };
        let exact = if work.exact_steps == work.steps { ", all exact" } else { "" };
        let (steps, events) = (count(work.steps, "step"), count(self.events.len() as u64, "event"));
        let digits = self.held.as_ref().map_or_else(String::new, |held| format!(", {}", held.words()));
        let mut lines = vec![format!("  {label}{end} s in {steps}{exact}, {events}{digits}")];
        if let Some(found) = self.quadrature.filter(|found| !found.settled) {
            let (nodes, change) = (found.nodes, found.change);
            lines.push(format!("  the sum over {nodes} nodes along a line is only good to {change:.0e}"));
        }
        lines.extend(self.equilibrium_lines());
        lines.extend(self.finds.iter().map(of_find));
        lines.extend(self.checks.iter().map(of_check));
        lines.extend(self.refusal.as_ref().map(|refusal| format!("  incomplete: {refusal}")));
        lines.join("\n")
    }
}

impl Located {
    /// `greatest` or `least`.
    pub fn word(&self) -> &'static str {
        if self.which == Extreme::Greatest { "greatest" } else { "least" }
    }

    /// Where an answer is greatest or least along a sweep:
    /// `  find far: greatest at T = 2.01 s, between 2.009 s and 2.011 s: 178.2 deg (10 more runs)`.
    pub fn told(&self) -> String {
        let Self { find, unit, parameter, parameter_unit, place, .. } = self;
        let at = |value: f64| with_unit(rounded(value), parameter_unit);
        let between = match (place.between, place.equal) {
            (_, Some(equal)) => {
                format!(" and in {} up to {}", count(equal.runs as u64 - 1, "other run"), at(equal.last))
            }
            (Some([low, high]), None) => format!(", between {} and {}", at(low), at(high)),
            (None, None) => ", where the sweep ends".to_owned(),
        };
        let made = match place.made {
            0 => String::new(),
            made => format!(" ({})", count(made as u64, "more run")),
        };
        let (which, value) = (self.word(), with_unit(place.best.value, unit));
        format!("  find {find}: {which} at {parameter} = {}{between}: {value}{made}", at(place.best.at))
    }
}

fn of_find(find: &FindResult) -> String {
    let FindResult { name, that, unit, at, value, .. } = find;
    if !find.is_reached() {
        return format!("  find {name}: {NOT_REACHED}");
    }
    if let Some(open) = find.open() {
        return format!("  find {name}: {that} {open}, at {at} s");
    }
    format!("  find {name}: {that} = {} at {at} s, {}", with_unit(*value, unit), find.certainty())
}

fn of_check(check: &CheckResult) -> String {
    let CheckResult { name, that, unit, at, .. } = check;
    if !check.is_reached() {
        return format!("  check {name}: FAILS, {NOT_REACHED}");
    }
    if let Some(open) = check.open() {
        return format!("  check {name}: FAILS, {that} {open}, at {at} s");
    }
    let found = with_unit(check.found, unit);
    let ending = match check.holds {
        true => format!("holds{}", doubt(check)),
        false => {
            let [expected, within] = [check.expected, check.within].map(|value| with_unit(value, unit));
            format!("FAILS, expected {expected} within {within}")
        }
    };
    format!("  check {name}: {that} = {found} at {at} s {ending}")
}

/// To seven digits: a place that was looked for has no more.
fn rounded(value: f64) -> f64 {
    format!("{value:.6e}").parse().unwrap_or(value)
}

/// That a claim which holds might as well not.
fn doubt(check: &CheckResult) -> String {
    match check.error {
        _ if check.is_sure() => String::new(),
        Some(error) => format!(", though it is only known to {error:.0e}"),
        None => ", though no digit of it is known".to_owned(),
    }
}

/// A value of a check, `9.6 m`.
fn with_unit(value: f64, unit: &str) -> String {
    if unit.is_empty() { short(value) } else { format!("{} {unit}", short(value)) }
}

/// All digits, and no row of zeros.
fn short(value: f64) -> String {
    if value != 0.0 && value.abs() < SMALL { format!("{value:e}") } else { value.to_string() }
}

/// `1 step`, `2 steps`
pub fn count(number: u64, what: &str) -> String {
    format!("{number} {what}{}", if number == 1 { "" } else { "s" })
}
