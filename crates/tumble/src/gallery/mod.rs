//! Every scene of a folder as a site: an index, reports that play, lessons, a book, and a page to begin with nothing.

mod documents;
mod examples;
mod formula;
mod markdown;

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

use thiserror::Error;
use tumble_report::report::Text;
use tumble_report::results::Finished;
use tumble_report::site::{Entry, GALLERY_SEAL, Index, Link, Page, Ways, url};
use tumble_report::tables::OF_RUN;

use crate::output::{Kind, OutputError, Single, shown};
use crate::pipeline::{self, Options, Outcome, PipelineError};
use crate::report_file::InSite;
use crate::templates::TEMPLATES;

use documents::{BOOK_PAGE, Documents, lesson_page, report_page};
pub use examples::completed;

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
    /// A page cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The scene that one begins with has no report.
    #[error("the page to begin with: {0}")]
    Start(#[from] Box<PipelineError>),
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

/// The results of the scene that one begins with; if a scene is called so, with a sign more.
const START: &str = "start";
const LANGUAGE: &str = "en";

/// Runs every `scene.toml` of the folders in `scenes`, in order of their names, and writes the site.
///
/// `seen` is told of each scene as it is done. One that fails does not stop the others.
pub fn run(scenes: &Path, options: &Options, mut seen: impl FnMut(&Shown)) -> Result<PathBuf, GalleryError> {
    let (folder, page) = (scenes, options.out.join("index.html"));
    let scenes = find(folder)?;
    let file = Single::begin(&page, PAGE)?;
    let site = Site::of(folder, &scenes);
    let mut shown = vec![];
    for scene in &scenes {
        let result = pipeline::run(scene, &site.options(&name_of(scene), options));
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
    site.start(options)?;
    site.write_documents(options)?;
    Ok(file.finish(site.index(&shown).page().to_string().as_bytes())?)
}

/// The pages around the reports.
struct Site {
    documents: Documents,
    ways: Ways,
    /// The results of the scene that one begins with.
    start: String,
}

impl Site {
    fn of(folder: &Path, scenes: &[PathBuf]) -> Self {
        let names: Vec<String> = scenes.iter().map(|scene| name_of(scene)).collect();
        let mut start = START.to_owned();
        while names.contains(&start) {
            start.push('_');
        }
        let documents = Documents::beside(folder, &names);
        let place = |path: &str, text: &str| Link { path: path.to_owned(), text: text.to_owned() };
        let mut places =
            vec![place("index.html", "Gallery"), place(&report_page(&start), "Start from nothing")];
        places.extend(documents.has_book().then(|| place(BOOK_PAGE, "The book")));
        Self { documents, ways: Ways { root: String::new(), places }, start }
    }

    /// How a scene is run whose report stands in the site.
    fn options(&self, name: &str, options: &Options) -> Options {
        let lesson = self.documents.lesson(name).map(|_| format!("../{}", lesson_page(name)));
        let site = InSite { ways: self.ways.below(), lesson, templates: vec![] };
        Options { site: Some(site), ..options.clone() }
    }

    /// A report that begins with a template and plays any scene.
    fn start(&self, options: &Options) -> Result<(), GalleryError> {
        let site = InSite { ways: self.ways.below(), lesson: None, templates: TEMPLATES.to_vec() };
        let options = Options { site: Some(site), ..options.clone() };
        pipeline::run_scene(&self.start, TEMPLATES[0].1, &options).map_err(Box::new)?;
        Ok(())
    }

    fn write_documents(&self, options: &Options) -> Result<(), GalleryError> {
        let scaffold = markdown::scaffold(&self.documents);
        for (path, text) in &self.documents.texts {
            let text = markdown::rendered(&self.documents, scaffold.as_deref(), path, text);
            let place = options.out.join(self.documents.page_of(path));
            let page = self.page_of(path, text).to_string();
            Single::begin(&place, PAGE)?.finish(page.as_bytes())?;
        }
        Ok(())
    }

    fn page_of(&self, path: &str, text: markdown::Text) -> Page {
        let html = match self.documents.scene_of(path) {
            Some(scene) => with_report(&text.html, scene),
            None => text.html,
        };
        let page = Page {
            title: text.title,
            language: LANGUAGE.to_owned(),
            ways: self.ways.below(),
            content: format!("<div class=\"text\">\n{html}</div>\n"),
            has_formulas: text.has_formulas,
            scripts: String::new(),
        };
        page.playing(&url(&format!("../{}", report_page(&self.start))))
    }

    fn index(&self, shown: &[Shown]) -> Index {
        let outcomes =
            shown.iter().filter_map(|shown| Some((name_of(&shown.scene), shown.result.as_ref().ok()?)));
        Index {
            title: "The gallery".into(),
            language: LANGUAGE.into(),
            ways: self.ways.clone(),
            entries: outcomes.map(|(name, outcome)| self.entry(&name, outcome)).collect(),
        }
    }

    fn entry(&self, name: &str, outcome: &Outcome) -> Entry {
        let tables =
            outcome.cases.iter().flat_map(|case| OF_RUN.map(|table| format!("{}/{table}", case.folder())));
        let link = |file: String| Link { path: format!("{name}/{file}"), text: file };
        let lesson = self.documents.lesson(name);
        let happens = lesson.map(markdown::first_paragraph).map(Text::from);
        let summary = happens.into_iter().chain([outcome.lead.clone()]);
        let summary = summary.chain(outcome.cases.iter().filter_map(fault).map(Text::from));
        Entry {
            title: outcome.study.title.clone(),
            lesson: lesson.map(|_| lesson_page(name)),
            report: report_page(name),
            summary: summary.filter(|line| !line.is_empty()).collect(),
            motion: outcome.motion.clone(),
            data: std::iter::once("summary.json".to_owned()).chain(tables).map(link).collect(),
        }
    }
}

/// A lesson with the report of its scene below the heading, to be opened or to play with where it stands.
fn with_report(html: &str, scene: &str) -> String {
    let page = url(&format!("../{}", report_page(scene)));
    let report = format!(
        "<div class=\"example\" data-page=\"{page}\"><p><a href=\"{page}\">The report of this scene, to play with</a></p></div>\n"
    );
    let (heading, rest) = html.split_once("</h1>").unwrap_or(("", html));
    let end = if heading.is_empty() { "" } else { "</h1>\n" };
    format!("{heading}{end}{report}{rest}")
}

/// The name of a scene: that of its folder.
fn name_of(scene: &Path) -> String {
    let folder = scene.parent().and_then(Path::file_name).unwrap_or_default();
    folder.to_string_lossy().into_owned()
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

/// Why a run is not what it should be, if it is not.
fn fault(run: &Finished) -> Option<String> {
    let refuted = run.checks.iter().filter(|check| !check.holds).count();
    let which = if run.label.is_empty() { String::new() } else { format!("{}: ", run.label) };
    let checks =
        (refuted > 0).then(|| format!("{which}{refuted} of {} checks do not hold.", run.checks.len()));
    run.refusal.as_ref().map(|refusal| format!("{which}{refusal}")).or(checks)
}
