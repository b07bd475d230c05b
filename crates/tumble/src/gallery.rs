//! Every scene of a folder, and the page that shows them.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

use thiserror::Error;
use tumble_report::gallery_page::{Entry, Figure, GALLERY_SEAL, IndexPage, Link};

use crate::output::{Kind, OutputError, Single, shown};
use crate::pipeline::{self, Options, Outcome, PipelineError};
use tumble_report::results::Finished;

/// Why there is no gallery.
#[derive(Debug, Error)]
pub enum GalleryError {
    /// The folder cannot be read.
    #[error("cannot read {}: {error}", shown(path))]
    Read {
        /// The folder.
        path: PathBuf,
        /// Why.
        error: std::io::Error,
    },
    /// There is nothing to show.
    #[error("no scene in {}: each is a folder with a scene.toml", shown(.0))]
    Empty(PathBuf),
    /// The page cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// No more was wanted.
    #[error("interrupted: {run} of {all} scenes were run, and {} is as it was", shown(page))]
    Interrupted {
        /// Scenes that were run to their end.
        run: usize,
        /// All scenes.
        all: usize,
        /// The page, which is not written.
        page: PathBuf,
    },
}

/// Galleries replace galleries only.
const PAGE: Kind = Kind { seal: GALLERY_SEAL, option: "--out" };

/// One scene of the gallery: its file and what its run came to.
pub struct Shown {
    /// The scene file.
    pub scene: PathBuf,
    /// What it came to.
    pub result: Result<Outcome, PipelineError>,
}

/// Runs every `scene.toml` of the folders in `scenes`, in order of their names, and writes the index page.
///
/// `seen` is told of each scene as it is done. One that fails does not stop the others.
pub fn run(scenes: &Path, options: &Options, mut seen: impl FnMut(&Shown)) -> Result<PathBuf, GalleryError> {
    let (scenes, page) = (find(scenes)?, options.out.join("index.html"));
    let file = Single::begin(&page, PAGE)?;
    let mut shown = vec![];
    for scene in &scenes {
        let result = pipeline::run(scene, options);
        shown.push(Shown { scene: scene.clone(), result });
        shown.iter().last().into_iter().for_each(&mut seen);
        if options.stop.load(Ordering::Relaxed) {
            break;
        }
    }
    let (run, all) = (finished(&shown), scenes.len());
    if run < all {
        return Err(GalleryError::Interrupted { run, all, page });
    }
    Ok(file.finish(index(&shown).to_string().as_bytes())?)
}

/// Scenes that were run to their end, well or not.
fn finished(shown: &[Shown]) -> usize {
    let is_cut_off = |shown: &&Shown| match &shown.result {
        Ok(outcome) => !outcome.missing.is_empty(),
        Err(error) => error.is_interruption(),
    };
    shown.iter().filter(|shown| !is_cut_off(shown)).count()
}

fn find(scenes: &Path) -> Result<Vec<PathBuf>, GalleryError> {
    let failed = |error| GalleryError::Read { path: scenes.to_owned(), error };
    let mut found = vec![];
    for entry in fs::read_dir(scenes).map_err(failed)? {
        let scene = entry.map_err(failed)?.path().join("scene.toml");
        found.extend(scene.is_file().then_some(scene));
    }
    found.sort();
    if found.is_empty() { Err(GalleryError::Empty(scenes.to_owned())) } else { Ok(found) }
}

fn index(shown: &[Shown]) -> IndexPage {
    let entries = shown.iter().filter_map(|shown| shown.result.as_ref().ok()).map(entry).collect();
    IndexPage { title: "The gallery".into(), language: "en".into(), entries }
}

fn entry(outcome: &Outcome) -> Entry {
    let folder = outcome.folder.file_name().unwrap_or_default().to_string_lossy();
    let path = |file: &str| format!("{folder}/{file}");
    let figure = |name: &String| Figure {
        path: path(&format!("{name}.svg")),
        alt: format!("{}: {}", outcome.study.title, name.replace(['-', '_'], " ")),
        caption: String::new(),
    };
    let link = |file: String| Link { path: path(&file), text: file };
    let tables = outcome.cases.iter().flat_map(|case| {
        ["trajectory.csv", "events.csv", "balance.csv"].map(|table| format!("{}/{table}", case.folder()))
    });
    let summary = std::iter::once(outcome.lead.clone()).chain(outcome.cases.iter().filter_map(fault));
    Entry {
        title: outcome.study.title.clone(),
        report: path("report.html"),
        summary: summary.filter(|line| !line.is_empty()).collect(),
        figures: outcome.figures.iter().map(figure).collect(),
        data: std::iter::once("summary.json".to_owned()).chain(tables).map(link).collect(),
    }
}

/// Why a run is not what it should be, if it is not.
fn fault(run: &Finished) -> Option<String> {
    let refuted = run.checks.iter().filter(|check| !check.holds).count();
    let which = if run.label.is_empty() { String::new() } else { format!("{}: ", run.label) };
    let checks =
        (refuted > 0).then(|| format!("{which}{refuted} of {} checks do not hold.", run.checks.len()));
    run.refusal.as_ref().map(|refusal| format!("{which}{refusal}")).or(checks)
}
