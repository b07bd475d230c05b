//! What runs came to, in lines for people.

use std::io;
use std::path::Path;

use tumble::output::Spool;
use tumble::{CheckResult, FindResult, Finished};
use tumble_scene::{printable, printable_lines};

use crate::tools::say::say;

/// Of a time that does not come.
const NOT_REACHED: &str = "not reached: its event or its time does not come in this motion";
/// Smaller numbers are written with a power of ten.
const SMALL: f64 = 1e-5;

/// What is to be said of runs once their results are in place. There may be more than memory should hold.
pub(crate) struct Told(Spool);

impl Told {
    /// Of no run; what becomes long goes to the disk of this folder.
    pub(crate) fn beside(folder: &Path) -> Self {
        Self(Spool::beside(folder))
    }

    /// Adds a run.
    pub(crate) fn add(&mut self, run: &Finished) -> io::Result<()> {
        self.0.add(&printable_lines(&of_run(run)))
    }

    /// Says it all.
    pub(crate) fn say(&mut self) -> io::Result<()> {
        for text in self.0.texts()? {
            say!("{}", text?);
        }
        Ok(())
    }
}

/// What a run came to.
fn of_run(run: &Finished) -> String {
    let Finished { end, work, .. } = run;
    let label = if run.label.is_empty() { String::new() } else { format!("{}: ", run.label) };
    let exact = if work.exact_steps == work.steps { ", all exact" } else { "" };
    let (steps, events) = (count(work.steps, "step"), count(run.events.len() as u64, "event"));
    let digits = run.held.as_ref().map_or_else(String::new, |held| format!(", {}", held.words()));
    let mut lines = vec![format!("  {label}{end} s in {steps}{exact}, {events}{digits}")];
    if let Some(found) = run.quadrature.filter(|found| !found.settled) {
        let (nodes, change) = (found.nodes, found.change);
        lines.push(format!("  the sum over {nodes} nodes along a line is only good to {change:.0e}"));
    }
    lines.extend(run.equilibrium_lines());
    lines.extend(run.finds.iter().map(of_find));
    lines.extend(run.checks.iter().map(of_check));
    lines.extend(run.refusal.as_ref().map(|refusal| format!("  incomplete: {refusal}")));
    lines.join("\n")
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
pub(crate) fn count(number: u64, what: &str) -> String {
    format!("{number} {what}{}", if number == 1 { "" } else { "s" })
}

/// A path as a terminal may have it.
pub(crate) fn shown(path: &Path) -> String {
    printable(&path.to_string_lossy()).into_owned()
}
