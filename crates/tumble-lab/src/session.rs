//! A scene while it is run: stage after stage, each with what the page shows of it.

use std::ops::ControlFlow;

use tumble_report::report::json::{list, number, object, string};
use tumble_report::report::live;
use tumble_report::results::{Case, CaseBalance, CaseError, Combinations, Finished, Runs, Surveyor};
use tumble_scene::{Diagnostics, Study, read_in};

use crate::request::Request;

/// A scene that is run, and how far it is.
#[derive(Debug)]
pub struct Session {
    request: Request,
    stage: Stage,
    study: Option<Study>,
    /// The run that is looked at, of which nothing but the motion is known.
    sketch: Option<(usize, Case)>,
    cases: Vec<Case>,
    /// What was not taken yet, as JSON.
    waiting: Vec<String>,
}

/// What comes next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    Read,
    /// The motion of the run that is looked at: the first picture.
    Sketch,
    /// A run, counted from 0, with its check runs.
    Run(usize),
    Motion,
    Balance,
    Report,
    /// In the place of the report.
    Tables,
    Done,
}

/// Rows of energies: a bar is redrawn no more often.
const ENERGY_ROWS: usize = 200;

/// Why there is nothing to show.
type Refusal = Box<(&'static str, Diagnostics, String)>;

impl Session {
    /// Of a scene of which nothing was done yet.
    pub fn new(request: Request) -> Self {
        Self { request, stage: Stage::Read, study: None, sketch: None, cases: vec![], waiting: vec![] }
    }

    /// Does the next stage. `reached` is told which time of which, s, a run is at, and may end it there. Whether there is more to do.
    pub fn advance(&mut self, reached: impl Fn(f64, f64) -> ControlFlow<()>) -> bool {
        match self.stage(reached) {
            Ok((next, said)) => {
                self.stage = next;
                self.waiting.extend(said);
            }
            Err(refusal) => {
                self.stage = Stage::Done;
                self.waiting.push(refused(&refusal));
            }
        }
        self.stage != Stage::Done
    }

    /// What there is to show since this was last asked: a list of messages, as JSON.
    pub fn take(&mut self) -> String {
        list(self.waiting.drain(..))
    }

    fn stage(
        &mut self,
        reached: impl Fn(f64, f64) -> ControlFlow<()>,
    ) -> Result<(Stage, Option<String>), Refusal> {
        let Some(study) = &self.study else { return self.read() };
        let why = |error| why(error, study);
        match self.stage {
            Stage::Sketch => {
                let (sketch, said) = sketched(study, self.request.shown, reached).unzip();
                self.sketch = sketch;
                Ok((Stage::Run(0), said))
            }
            Stage::Run(index) => {
                let sketch = self.sketch.take_if(|(other, _)| *other == index).map(|(_, case)| case);
                let (case, count) = one_run(study, index, sketch, reached).map_err(why)?;
                let told = told(&case);
                self.cases.push(case);
                let next = if index + 1 < count { Stage::Run(index + 1) } else { Stage::Motion };
                Ok((next, Some(told)))
            }
            Stage::Motion => Ok((Stage::Balance, Some(self.motion(study).map_err(why)?))),
            Stage::Balance => {
                self.cases.iter_mut().try_for_each(balance).map_err(why)?;
                let next = if self.request.tables { Stage::Tables } else { Stage::Report };
                Ok((next, Some(energies(&self.cases))))
            }
            Stage::Tables => Ok((Stage::Done, Some(tables(study, &self.cases).map_err(why)?))),
            Stage::Report => Ok((Stage::Done, Some(self.report(study).map_err(why)?))),
            Stage::Read | Stage::Done => Ok((Stage::Done, None)),
        }
    }

    fn read(&mut self) -> Result<(Stage, Option<String>), Refusal> {
        let Request { name, scene, set, .. } = &self.request;
        let mistaken = |mistakes| Box::new(("mistakes", mistakes, String::new()));
        let mut study = read_in(name, scene, set, &self.request).map_err(mistaken)?;
        if study.title.is_empty() {
            study.title.clone_from(name);
        }
        let parts = [
            ("kind", string("scene")),
            ("title", string(&study.title)),
            ("said", live::said(&study.warnings())),
            ("play", live::play(&study)),
        ];
        self.study = Some(study);
        Ok((Stage::Sketch, Some(object(parts))))
    }

    fn motion(&self, study: &Study) -> Result<String, CaseError> {
        let motion = live::motion(&tumble_report::animation(study, &self.cases)?);
        Ok(object([("kind", string("motion")), ("motion", motion)]))
    }

    fn report(&self, study: &Study) -> Result<String, CaseError> {
        // Extremes are not located here: the reader moves a slider to where they are.
        let mut surveyor = Surveyor::of(study, true)?;
        self.cases.iter().for_each(|case| surveyor.add(&Finished::of(case)));
        let survey = surveyor.end(vec![]);
        let report = tumble_report::of(study, Runs { cases: &self.cases, missing: &[], survey: &survey })?;
        Ok(object([("kind", string("report")), ("parts", live::parts(&report))]))
    }
}

/// The motion of one run, to be drawn. Where there is none, [`one_run`] says why.
fn sketched(
    study: &Study,
    shown: usize,
    reached: impl Fn(f64, f64) -> ControlFlow<()>,
) -> Option<((usize, Case), String)> {
    let all = Combinations::of(study).ok()?;
    let index = shown.min(all.count() - 1);
    let case = Case::sketch(&all, index, reached).ok()?;
    let motion = live::motion(&tumble_report::animation(study, std::slice::from_ref(&case)).ok()?);
    let parts = [("kind", string("sketch")), ("case", index.to_string()), ("motion", motion)];
    Some(((index, case), object(parts)))
}

fn one_run(
    study: &Study,
    index: usize,
    sketch: Option<Case>,
    reached: impl Fn(f64, f64) -> ControlFlow<()>,
) -> Result<(Case, usize), CaseError> {
    let all = Combinations::of(study)?;
    let sketch = sketch.map_or_else(|| Case::sketch(&all, index, &reached), Ok)?;
    Ok((sketch.verified(study, reached)?, all.count()))
}

fn balance(case: &mut Case) -> Result<(), CaseError> {
    case.balance = CaseBalance::of(case)?;
    Ok(())
}

/// The energies along each run.
fn energies(cases: &[Case]) -> String {
    object([("kind", string("energy")), ("cases", list(cases.iter().map(energy)))])
}

/// The tables of the runs, each behind its path.
fn tables(study: &Study, cases: &[Case]) -> Result<String, CaseError> {
    let tables = tumble_report::tables::all(study, cases)?;
    let files = tables.iter().map(|(path, text)| list([string(path), string(text)]));
    Ok(object([("kind", string("tables")), ("files", list(files))]))
}

/// What a run came to, in the words of the command, and the bits of its motion.
fn told(case: &Case) -> String {
    let finished = Finished::of(case);
    let find = |find: &tumble_report::results::FindResult| {
        list([string(&find.name), number(find.value), string(&find.unit), number(find.at)])
    };
    object([
        ("kind", string("run")),
        ("label", string(&finished.label)),
        ("told", string(&finished.told())),
        ("end", number(finished.end)),
        ("finds", list(finished.finds.iter().map(find))),
        ("success", finished.is_success().to_string()),
        ("fails", finished.checks.iter().any(|check| !check.holds).to_string()),
        ("said", live::said(&finished.said)),
        ("bits", string(&format!("{:016x}", bits(case)))),
    ])
}

/// Rows of time (s), kinetic and potential energy (J); none where nothing moved.
fn energy(case: &Case) -> String {
    let rows = case.balance.as_ref().map_or(&[][..], |balance| &balance.rows);
    let every = rows.len().div_ceil(ENERGY_ROWS).max(1);
    list(rows.iter().step_by(every).map(|row| list(row.iter().take(3).map(|value| number(*value)))))
}

/// All numbers of a motion in one: equal motions have equal ones, and others do not but by a chance of 1 to 2^64.
fn bits(case: &Case) -> u64 {
    let each = case.run.tracks().flat_map(|motion| {
        motion.pieces.iter().flat_map(|piece| {
            let states = piece.states.all().iter().copied();
            [piece.start, piece.left_out, piece.end, piece.length].into_iter().chain(states)
        })
    });
    each.chain(case.run.events().map(|event| event.time)).fold(0xcbf2_9ce4_8422_2325, |hash, value| {
        value
            .to_bits()
            .to_le_bytes()
            .iter()
            .fold(hash, |hash: u64, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3))
    })
}

fn why(error: CaseError, study: &Study) -> Refusal {
    match error.placed(study) {
        CaseError::Scene(mistakes) => Box::new(("mistakes", *mistakes, String::new())),
        CaseError::Refused(said) => Box::new(("refused", *said, String::new())),
        CaseError::Interrupted => Box::new(("stopped", Diagnostics::default(), String::new())),
        other => Box::new(("refused", Diagnostics::default(), other.to_string())),
    }
}

fn refused(refusal: &Refusal) -> String {
    let (kind, said, words) = &**refusal;
    object([("kind", string(kind)), ("said", live::said(said)), ("words", string(words))])
}
