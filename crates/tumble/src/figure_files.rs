//! Figures as files: SVG, and PNG beside it.

use tumble_drawing::Svg;
use tumble_report::figures;
use tumble_report::results::Runs;
use tumble_scene::Study;

use crate::output::Folder;
use crate::pipeline::PipelineError;

/// Pixels of a PNG for one of the drawing: sharp in print at a page's width.
#[cfg(feature = "png")]
const PNG_SCALE: f64 = 2.0;

/// Writes everything the study asks for, all runs in one figure, and returns the names, without endings.
pub(crate) fn write(study: &Study, runs: Runs<'_>, folder: &Folder) -> Result<Vec<String>, PipelineError> {
    let mut names = vec![];
    figures::all(study, runs, |name, svg| {
        save(folder, &name, &svg)?;
        names.push(name);
        Ok::<_, PipelineError>(())
    })?;
    Ok(names)
}

fn save(folder: &Folder, name: &str, svg: &Svg) -> Result<(), PipelineError> {
    folder.write(&format!("{name}.svg"), svg.to_string().as_bytes())?;
    #[cfg(feature = "png")]
    {
        let failed = |error: tumble_drawing::PngError| crate::output::OutputError::Picture {
            name: name.to_owned(),
            reason: error.to_string(),
        };
        let png = tumble_drawing::png(svg, PNG_SCALE).map_err(failed)?;
        folder.write(&format!("{name}.png"), &png)?;
    }
    Ok(())
}
