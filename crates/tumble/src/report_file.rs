//! The report as a file beside the figures.

use std::path::{Component, Path};

use tumble_report::report::Report;
use tumble_scene::Study;

use crate::output::Folder;
use crate::pipeline::{PipelineError, Runs};
use crate::report;
use crate::summary::Source;

/// The lesson of a scene, in its folder.
const LESSON: &str = "README.md";

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

/// Writes the report of a study, with where it comes from.
pub(crate) fn write(
    source: &Source,
    study: &Study,
    runs: Runs<'_>,
    folder: &Folder,
    form: Form,
) -> Result<(), PipelineError> {
    let (file, written): (_, fn(&Report) -> String) = match form {
        Form::None => return Ok(()),
        Form::Html => ("report.html", Report::html),
        Form::Markdown => ("report.md", Report::markdown),
    };
    let report = Report { lesson: lesson(source, folder), meta: meta(source), ..report::of(study, runs)? };
    Ok(folder.write(file, written(&report).as_bytes())?)
}

fn meta(source: &Source) -> Vec<(String, String)> {
    let program = format!("tumble {}", env!("CARGO_PKG_VERSION"));
    let hash = source.hash().map(|hash| ("SHA-256 of the scene".to_owned(), hash));
    let kind = if hash.is_some() { "Scene" } else { "Study" };
    let name = (kind.to_owned(), source.shown_name());
    [name].into_iter().chain(hash).chain([("Program".to_owned(), program)]).collect()
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
}
