//! The report as a file beside the figures.

use std::path::{Component, Path};

use tumble_drawing::Animation;
use tumble_report::report::{Lab, Report, Text, live};
use tumble_report::results::Runs;
use tumble_report::site::Ways;
use tumble_scene::Study;

use crate::output::Folder;
use crate::pipeline::{Options, PipelineError};
use crate::summary::Source;

/// The lesson of a scene, in its folder.
const LESSON: &str = "README.md";

/// The engine, as `cargo xtask lab` builds it.
const ENGINE: &[u8] = include_bytes!("../assets/engine.wasm.lzma");

/// How a report is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Form {
    /// One page that opens in any browser: `report.html`.
    #[default]
    Html,
    /// Text with formulas and links to the figures: `report.md`.
    Markdown,
    /// None.
    None,
}

/// A site of pages that a report stands in.
#[derive(Clone, Debug, Default)]
pub struct InSite {
    /// What every page of it leads to.
    pub ways: Ways,
    /// The way to the lesson of the scene, if it has one there.
    pub lesson: Option<String>,
    /// Scenes that its page offers to begin with, each with what it is.
    pub templates: Vec<(&'static str, &'static str)>,
}

/// Writes the report of a study, with where it comes from. What others tell of it: what was found, and the motion.
pub(crate) fn write(
    source: &Source,
    study: &Study,
    runs: Runs<'_>,
    folder: &Folder,
    options: &Options,
) -> Result<(Text, Option<Animation>), PipelineError> {
    let (file, written): (_, fn(&Report) -> String) = match options.report {
        Form::None => return Ok(Default::default()),
        Form::Html => ("report.html", Report::html),
        Form::Markdown => ("report.md", Report::markdown),
    };
    let (lab, meta) = (lab(source, study, options), meta(source));
    let (lesson, ways) = match &options.site {
        Some(site) => (site.lesson.clone(), Some(site.ways.clone())),
        None => (lesson(source, folder), None),
    };
    let report = Report { lesson, ways, meta, lab, ..tumble_report::of(study, runs)? };
    folder.write(file, written(&report).as_bytes())?;
    Ok((report.lead, report.analyze.animation))
}

/// The engine with the scene that the page plays; a study of a program has none.
fn lab(source: &Source, study: &Study, options: &Options) -> Option<Lab> {
    let is_wanted = options.report == Form::Html && !options.no_play && !source.path.as_os_str().is_empty();
    is_wanted.then(|| Lab {
        engine: ENGINE,
        name: source.path.display().to_string(),
        scene: String::from_utf8_lossy(&source.bytes).into_owned(),
        files: source.beside.clone(),
        set: options.set.clone(),
        play: live::play(study),
        templates: options.site.iter().flat_map(|site| site.templates.iter().copied()).collect(),
    })
}

fn meta(source: &Source) -> Vec<(Text, Text)> {
    let program = format!("tumble {}", env!("CARGO_PKG_VERSION"));
    let hash =
        source.hash().map(|hash| ("Checksum of the scene\u{2019}s file (SHA-256)".into(), hash.into()));
    let kind = if hash.is_some() { "Scene" } else { "Study" };
    let name = (kind.into(), source.shown_name().into());
    [name].into_iter().chain(hash).chain([("Made by".into(), program.into())]).collect()
}

/// The way from the folder of the results to the lesson beside the scene, if there is one.
fn lesson(source: &Source, folder: &Folder) -> Option<String> {
    let lesson = source.path.parent()?.join(LESSON);
    let there =
        if source.path.file_name()? == "scene.toml" { lesson.canonicalize().ok()? } else { return None };
    relative(&folder.place()?, &there)
}

/// From one folder to a file, with `/` between names.
fn relative(from: &Path, to: &Path) -> Option<String> {
    let (from, to): (Vec<Component>, Vec<Component>) =
        (from.components().collect(), to.components().collect());
    let common = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    let up = from[common..].iter().map(|_| Some("..".to_owned()));
    let down = to[common..].iter().map(|part| part.as_os_str().to_str().map(str::to_owned));
    let parts: Option<Vec<String>> = up.chain(down).collect();
    parts.filter(|_| common > 0).map(|parts| parts.join("/"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_way_to_the_lesson_goes_up_and_down() {
        let way = |from: &str, to: &str| relative(Path::new(from), Path::new(to));
        assert_eq!(
            way("/a/out/one", "/a/scenes/one/README.md").as_deref(),
            Some("../../scenes/one/README.md")
        );
        assert_eq!(way("/a", "/a/README.md").as_deref(), Some("README.md"));
    }

    #[test]
    fn the_footer_says_what_the_numbers_are_of() {
        let said = |path: &str| {
            let source =
                Source { path: path.into(), name: "rod".to_owned(), bytes: b"abc".to_vec(), beside: vec![] };
            let plain = |(name, value): &(Text, Text)| format!("{}: {}", name.to_plain(), value.to_plain());
            meta(&source).iter().map(plain).collect::<Vec<_>>()
        };
        // FIPS 180-2, B.1.
        let hash = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        let hash = format!("Checksum of the scene\u{2019}s file (SHA-256): {hash}");
        let program = concat!("Made by: tumble ", env!("CARGO_PKG_VERSION"));
        assert_eq!(said("rod/scene.toml"), ["Scene: rod", &hash, program]);
        assert_eq!(said(""), ["Study: rod", program], "a study of a program has no file");
    }
}
