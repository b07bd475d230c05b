//! What stays of a run once its tables are written: what it came to, without the motion itself.
//!
//! A sweep may have thousands of runs, and a motion with its check runs is much larger than what is told of it.

use tumble_expr::Symbol;
use tumble_mech::{Equilibrium, Quadrature, Record};
use tumble_ode::{Accuracy, Refusal, Work};
use tumble_scene::Diagnostics;

use crate::results::case::{Case, folder};
use crate::results::digits::Held;
use crate::results::{CheckResult, FindResult, case_balance, equilibrium};

/// One run of a study, and what it came to.
#[derive(Debug)]
pub struct Finished {
    /// Counts the runs from 1.
    pub number: usize,
    /// What is different about it, as legends say it: `T = 0.5 s`; empty where there is only one run.
    pub label: String,
    /// What its motion was to be held to.
    pub accuracy: Accuracy,
    /// Time up to which the motion was found, s.
    pub end: f64,
    /// Order of its Taylor steps.
    pub order: usize,
    /// What it cost.
    pub work: Work,
    /// What happened, in order of time.
    pub events: Vec<Happened>,
    /// Sums that stand for integrals along lines, where there are any that were refined.
    pub quadrature: Option<Quadrature>,
    /// How far it can be trusted; nothing is known of a motion that stopped early.
    pub held: Option<Held>,
    /// Why it stopped early, if it did.
    pub refusal: Option<Refusal>,
    /// What the scene asks for.
    pub finds: Vec<FindResult>,
    /// The scene's claims, each with what was found.
    pub checks: Vec<CheckResult>,
    /// The pose of equilibrium near its start, where it is asked for and there is one.
    pub equilibrium: Option<Equilibrium>,
    /// What a user should know of it.
    pub said: Diagnostics,
    /// Values of the parameters, in their order, SI units.
    pub inputs: Vec<f64>,
    /// The states at the end, SI units.
    pub states: Vec<(Symbol, f64)>,
    /// Contacts, impacts included.
    pub contacts: usize,
    /// Times that impacts following each other ever faster have ended in contact.
    pub zeno_sequences: usize,
    /// Energy, momentum and what changed them; `None` where only numbers were asked for.
    pub balance: Option<case_balance::Summary>,
}

/// Something that happened in a run.
#[derive(Clone, Debug)]
pub struct Happened {
    /// When, s.
    pub time: f64,
    /// What, in the model's words.
    pub what: Vec<String>,
    /// Whether digits are verified then.
    pub is_verified: bool,
}

impl Finished {
    /// What stays of a run.
    pub fn of(case: &Case) -> Self {
        let run = &case.run;
        let happened = |event: &tumble_ode::Occurrence<Record>| Happened {
            time: event.time,
            what: run.equations.names_of(&event.record),
            is_verified: case.is_verified(event.time),
        };
        Self {
            number: case.number,
            label: case.label.clone(),
            accuracy: case.accuracy,
            end: run.end().unwrap_or(0.0),
            order: run.order(),
            work: run.work(),
            events: run.events().map(happened).collect(),
            quadrature: run.quadrature,
            held: case.trust.as_ref().map(Held::of),
            refusal: case.refusal.clone(),
            finds: case.finds.clone(),
            checks: case.checks.clone(),
            equilibrium: case.equilibrium.clone(),
            said: case.said.clone(),
            inputs: run.inputs.clone(),
            states: run.last_states(),
            contacts: run.contacts().len(),
            zeno_sequences: run.zeno_sequences(),
            balance: case.balance.as_ref().map(case_balance::Summary::of),
        }
    }

    /// Whether the motion reached its end and every claim holds.
    pub fn is_success(&self) -> bool {
        self.refusal.is_none() && self.checks.iter().all(|check| check.holds)
    }

    /// Lines that tell of its equilibrium, where there is one.
    pub fn equilibrium_lines(&self) -> Vec<String> {
        self.equilibrium.as_ref().map(equilibrium::lines).unwrap_or_default()
    }

    /// The folder of its tables.
    pub fn folder(&self) -> String {
        folder(self.number)
    }
}

/// How many runs ended how.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tally {
    /// Runs that were made.
    pub made: usize,
    /// Those whose motion was refused on the way.
    pub refused: usize,
    /// Those that came to their end, and a claim does not hold.
    pub refuted: usize,
}

impl Tally {
    /// Counts one more.
    pub fn add(&mut self, run: &Finished) {
        self.made += 1;
        match run.refusal {
            Some(_) => self.refused += 1,
            None => self.refuted += usize::from(!run.is_success()),
        }
    }
}
