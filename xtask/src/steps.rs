//! A step is a name and a function; a run of steps goes to the end and then says what failed.

use std::process::ExitCode;
use std::time::{Duration, Instant};

use anyhow::Result;

use crate::workspace::Workspace;

/// One entry of a plan.
#[derive(Clone, Copy)]
pub(crate) struct Step {
    /// As printed in the heading and in the table.
    pub(crate) name: &'static str,
    /// What the step does; an error fails the step, not the run.
    pub(crate) run: fn(&Workspace) -> Result<()>,
}

struct Outcome {
    name: &'static str,
    ok: bool,
    spent: Duration,
}

/// Runs every step, failed ones included, and prints the table and the count.
pub(crate) fn run_all(steps: &[Step], workspace: &Workspace) -> ExitCode {
    let outcomes: Vec<Outcome> = steps.iter().map(|step| run_one(step, workspace)).collect();
    print!("\n{}{}", table(&outcomes), count(&outcomes));
    if outcomes.iter().all(|outcome| outcome.ok) { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn run_one(step: &Step, workspace: &Workspace) -> Outcome {
    println!("\n=== {} ===", step.name);
    let start = Instant::now();
    let result = (step.run)(workspace);
    if let Err(error) = &result {
        eprintln!("{} failed: {error:#}", step.name);
    }
    Outcome { name: step.name, ok: result.is_ok(), spent: start.elapsed() }
}

fn table(outcomes: &[Outcome]) -> String {
    let width = outcomes.iter().map(|outcome| outcome.name.len()).max().unwrap_or(0);
    outcomes.iter().map(|outcome| row(outcome, width)).collect()
}

fn row(outcome: &Outcome, width: usize) -> String {
    let verdict = if outcome.ok { "ok" } else { "failed" };
    format!("{:<width$}  {verdict:<6}  {:>7.1} s\n", outcome.name, outcome.spent.as_secs_f64())
}

/// The last line of every run, alone on its line.
fn count(outcomes: &[Outcome]) -> String {
    let passed = outcomes.iter().filter(|outcome| outcome.ok).count();
    format!("{passed} passed, {} failed\n", outcomes.len() - passed)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outcome(name: &'static str, ok: bool) -> Outcome {
        Outcome { name, ok, spent: Duration::from_millis(1250) }
    }

    #[test]
    fn table_aligns_and_counts() {
        let outcomes = [outcome("tests", true), outcome("documentation", false)];
        assert_eq!(table(&outcomes), "tests          ok          1.2 s\ndocumentation  failed      1.2 s\n");
        assert_eq!(count(&outcomes), "1 passed, 1 failed\n");
    }
}
