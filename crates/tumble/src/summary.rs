//! `summary.json`: what was run, with what, and what came out, for programs.

mod located;
mod run;

use std::cell::RefCell;
use std::fs;
use std::io::{self, Write};
use std::path::{Component, Path, PathBuf};

use serde::ser::{Error, SerializeSeq};
use serde::{Serialize, Serializer};
use serde_json::value::RawValue;
use tumble_scene::{Diagnostic, Diagnostics, printable};

use crate::output::{Folder, Hash, Spool};
use crate::pipeline::{Outcome, PipelineError};
use tumble_report::results::{self, Missing};

pub(crate) use run::page;

/// The file.
pub(crate) const FILE: &str = "summary.json";

/// Name and version of the file's layout; the version grows when a key changes its meaning or goes.
const SCHEMA: &str = "tumble-summary";
const SCHEMA_VERSION: u32 = 1;

/// A scene file as it was read.
pub(crate) struct Source {
    pub(crate) path: PathBuf,
    /// Name of the scene: of its folder where the file is called `scene.toml`, else of the file.
    pub(crate) name: String,
    pub(crate) bytes: Vec<u8>,
    /// The files that it reads, by their names in it.
    pub(crate) beside: Vec<(String, Vec<u8>)>,
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
        Ok(Self { path: path.to_owned(), name: scene_name(path), bytes, beside: vec![] })
    }
}

impl Source {
    /// Of a study that a program made.
    pub(crate) fn of_program(name: &str) -> Result<Self, PipelineError> {
        match tumble_scene::file_name_fault(name) {
            Some(fault) => Err(PipelineError::Name { name: name.to_owned(), fault }),
            None => Ok(Self { path: PathBuf::new(), name: name.to_owned(), bytes: vec![], beside: vec![] }),
        }
    }

    /// Of a scene that is no file.
    pub(crate) fn of_text(name: &str, text: &str) -> Self {
        Self { path: "scene.toml".into(), name: name.to_owned(), bytes: text.into(), beside: vec![] }
    }

    /// The hash of the scene, where there is one.
    pub(crate) fn hash(&self) -> Option<String> {
        (!self.path.as_os_str().is_empty()).then(|| Hash::of(&self.bytes).to_string())
    }

    /// Every file that it is made of.
    pub(crate) fn needed(&self) -> Vec<PathBuf> {
        let folder = tumble_scene::Folder::of(&self.path);
        let beside = self.beside.iter().map(|(name, _)| folder.0.join(name));
        std::iter::once(self.path.clone()).chain(beside).collect()
    }

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
    #[serde(skip_serializing_if = "Option::is_none")]
    scene_sha256: Option<String>,
    title: &'a str,
    complete: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    interrupted: Option<Interrupted<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    warnings: Vec<Said>,
    figures: &'a [String],
    #[serde(skip_serializing_if = "Vec::is_empty")]
    located: Vec<located::Entry<'a>>,
    runs: Pages,
}

/// The runs, of which no two are in memory at once.
struct Pages(RefCell<Spool>);

impl Serialize for Pages {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut list = serializer.serialize_seq(None)?;
        let mut pages = self.0.borrow_mut();
        for page in pages.texts().map_err(S::Error::custom)? {
            let page = page.map_err(S::Error::custom)?;
            list.serialize_element(&RawValue::from_string(page).map_err(S::Error::custom)?)?;
        }
        list.end()
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

/// Writes what all runs came to; the pages, by [`page`], are of each.
pub(crate) fn write(
    source: &Source,
    outcome: &Outcome,
    pages: Spool,
    folder: &Folder,
) -> Result<(), PipelineError> {
    let summary = Summary {
        schema: SCHEMA,
        schema_version: SCHEMA_VERSION,
        program: "tumble",
        program_version: env!("CARGO_PKG_VERSION"),
        scene_sha256: source.hash(),
        title: &outcome.study.title,
        complete: outcome.missing.is_empty() && outcome.tally.refused == 0,
        interrupted: interrupted(outcome),
        warnings: said(&outcome.study.warnings()),
        figures: &outcome.figures,
        located: outcome.located.iter().map(located::entry).collect(),
        runs: Pages(RefCell::new(pages)),
    };
    let file = |mut sink: &mut dyn Write| {
        serde_json::to_writer_pretty(&mut sink, &summary).map_err(io::Error::from)?;
        sink.write_all(b"\n")
    };
    Ok(folder.write_by(FILE, file)?)
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

fn interrupted(outcome: &Outcome) -> Option<Interrupted<'_>> {
    let missing = outcome.missing.iter();
    let not_made =
        missing.map(|Missing { number, label }| NotMade { folder: results::folder(*number), label });
    let not_made: Vec<_> = not_made.collect();
    (!not_made.is_empty()).then_some(Interrupted { finished: outcome.tally.made, not_made })
}
