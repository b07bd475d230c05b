//! `summary.json`: what was run, with what, and what came out, for programs.

use std::collections::BTreeMap;
use std::fs;
use std::io::Write;
use std::path::{Component, Path, PathBuf};

use serde::{Serialize, Serializer};
use sha2::{Digest, Sha256};
use tumble_mech::MultipleImpacts;
use tumble_scene::{Diagnostic, Diagnostics, Study, printable};

use crate::case::{self, Missing};
use crate::checks::CheckResult;
use crate::finished::{Finished, Happened};
use crate::output::Folder;
use crate::pipeline::{PipelineError, Written};
use crate::questions::FindResult;
use crate::tables::{is_angle, unit};

/// Name and version of the file's layout; the version grows when a key changes its meaning or goes.
const SCHEMA: &str = "tumble-summary";
const SCHEMA_VERSION: u32 = 1;

/// A scene file as it was read.
pub(crate) struct Source {
    pub(crate) path: PathBuf,
    /// Name of the scene: of its folder where the file is called `scene.toml`, else of the file.
    pub(crate) name: String,
    pub(crate) bytes: Vec<u8>,
}

/// Larger files are no scenes.
const LARGEST_FILE: u64 = 16 << 20;

impl Source {
    pub(crate) fn read(path: &Path) -> Result<Self, PipelineError> {
        let failed = |error| PipelineError::Read { path: path.to_owned(), error };
        let about = fs::metadata(path).map_err(failed)?;
        if !about.is_file() {
            return Err(failed(std::io::Error::other("it is not a regular file")));
        }
        if about.len() > LARGEST_FILE {
            let reason = format!("it has {} bytes, and a scene at most {LARGEST_FILE}", about.len());
            return Err(failed(std::io::Error::other(reason)));
        }
        let bytes = fs::read(path).map_err(failed)?;
        Ok(Self { path: path.to_owned(), name: scene_name(path), bytes })
    }
}

impl Source {
    /// The name as people see it.
    pub(crate) fn shown_name(&self) -> String {
        printable(&self.name).into_owned()
    }
}

/// The name of a folder that results can have.
fn scene_name(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let folder = path.canonicalize().ok().and_then(|path| {
        path.parent().and_then(Path::file_name).map(|name| name.to_string_lossy().into_owned())
    });
    let name = if stem == "scene" { folder.unwrap_or(stem) } else { stem };
    // A file `..toml` has the name of the folder that it is in.
    let is_plain = Path::new(&name).components().all(|part| matches!(part, Component::Normal(_)));
    if is_plain && !name.is_empty() { name } else { "scene".to_owned() }
}

#[derive(Serialize)]
struct Summary<'a> {
    schema: &'static str,
    schema_version: u32,
    program: &'static str,
    program_version: &'static str,
    scene_sha256: String,
    title: &'a str,
    complete: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    interrupted: Option<Interrupted<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    warnings: Vec<Said>,
    figures: &'a [String],
    runs: RunSummaries<'a>,
}

/// The runs, each put into its form as it is written.
struct RunSummaries<'a> {
    study: &'a Study,
    cases: &'a [Finished],
}

impl Serialize for RunSummaries<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.cases.iter().map(|case| of_run(self.study, case)))
    }
}

/// Where no more runs were wanted.
#[derive(Serialize)]
struct Interrupted<'a> {
    finished: usize,
    not_made: Vec<NotMade<'a>>,
}

#[derive(Serialize)]
struct NotMade<'a> {
    folder: String,
    label: &'a str,
}

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
    #[serde(skip_serializing_if = "Vec::is_empty")]
    warnings: Vec<Said>,
    #[serde(skip_serializing_if = "Option::is_none")]
    balance: Option<&'a crate::balance::Summary>,
}

/// Something that a user should know.
#[derive(Serialize)]
struct Said {
    code: &'static str,
    message: String,
    /// The scene's file, or the setting of the command line.
    source: String,
    /// Counted from 1; none where it is about no place.
    #[serde(skip_serializing_if = "Option::is_none")]
    line: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    column: Option<usize>,
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

#[derive(Serialize)]
struct Find<'a> {
    name: &'a str,
    that: &'a str,
    unit: &'a str,
    at: Option<f64>,
    value: Option<f64>,
    error: Option<f64>,
    status: &'static str,
}

#[derive(Serialize)]
struct Check<'a> {
    name: &'a str,
    that: &'a str,
    unit: &'a str,
    at: Option<f64>,
    found: Option<f64>,
    expected: Option<f64>,
    within: f64,
    /// Error stated of what was found.
    error: Option<f64>,
    holds: bool,
    status: &'static str,
}

pub(crate) fn write(
    source: &Source,
    study: &Study,
    written: &Written,
    folder: &Folder,
) -> Result<(), PipelineError> {
    let Written { figures, cases, missing } = written;
    let summary = Summary {
        schema: SCHEMA,
        schema_version: SCHEMA_VERSION,
        program: "tumble",
        program_version: env!("CARGO_PKG_VERSION"),
        scene_sha256: hash(&source.bytes),
        title: &study.title,
        complete: missing.is_empty() && cases.iter().all(|case| case.refusal.is_none()),
        interrupted: interrupted(written),
        warnings: said(&study.warnings()),
        figures,
        runs: RunSummaries { study, cases },
    };
    let file = |mut sink: &mut dyn Write| {
        serde_json::to_writer_pretty(&mut sink, &summary)?;
        sink.write_all(b"\n")
    };
    Ok(folder.write_by("summary.json", file)?)
}

fn said(diagnostics: &Diagnostics) -> Vec<Said> {
    let one = |diagnostic: &Diagnostic| {
        let name = diagnostics.sources.get(diagnostic.source).map_or("", |source| source.name.as_str());
        // Where the scene stands on somebody's machine is no part of a result.
        let file = Path::new(name).file_name().filter(|_| diagnostic.source == 0);
        let source = file.map_or(name.into(), |file| file.to_string_lossy());
        let position = diagnostics.position(diagnostic);
        Said {
            code: diagnostic.code.as_str(),
            message: diagnostic.message.clone(),
            source: source.into_owned(),
            line: position.map(|(line, _)| line),
            column: position.map(|(_, column)| column),
        }
    };
    diagnostics.list.iter().map(one).collect()
}

fn interrupted(written: &Written) -> Option<Interrupted<'_>> {
    let missing = written.missing.iter();
    let not_made = missing.map(|Missing { number, label }| NotMade { folder: case::folder(*number), label });
    let not_made: Vec<_> = not_made.collect();
    (!not_made.is_empty()).then_some(Interrupted { finished: written.cases.len(), not_made })
}

fn of_run<'a>(study: &Study, case: &'a Finished) -> RunSummary<'a> {
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
        events: case.events.iter().map(|Happened { time, what }| Event { time: *time, what }).collect(),
        finds: case.finds.iter().map(find).collect(),
        checks: case.checks.iter().map(check).collect(),
        warnings: said(&case.said),
        balance: case.balance.as_ref(),
    }
}

pub(crate) fn hash(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
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
            verified_until: held.horizon.as_ref().map_or(case.end, |horizon| horizon.time),
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

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

fn find(result: &FindResult) -> Find<'_> {
    Find {
        name: &result.name,
        that: &result.that,
        unit: &result.unit,
        at: finite(result.at),
        value: finite(result.value),
        error: result.error.and_then(finite),
        status: result.status(),
    }
}

fn check(result: &CheckResult) -> Check<'_> {
    Check {
        name: &result.name,
        that: &result.that,
        unit: &result.unit,
        at: finite(result.at),
        found: finite(result.found),
        expected: finite(result.expected),
        within: result.within,
        error: result.error.and_then(finite),
        holds: result.holds,
        status: result.status(),
    }
}
