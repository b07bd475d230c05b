//! The report as PDF, set by Typst within this process: no file is read, nothing is asked for from a network.

mod document;
mod inline;
mod tables;
#[cfg(test)]
mod tests;
mod world;

use thiserror::Error;
use typst::diag::{SourceDiagnostic, SourceResult, Warned};
use typst::foundations::Smart;
use typst_layout::PagedDocument;
use typst_pdf::PdfOptions;

use super::Report;
use world::InMemory;

/// A report as PDF.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pdf {
    /// The file. Equal reports give equal bytes.
    pub bytes: Vec<u8>,
    /// What the typesetter remarked, in its own words.
    pub warnings: Vec<String>,
}

/// Why a report cannot be set.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("the report cannot be set as PDF: {}", .0.join("; "))]
pub struct PdfError(Vec<String>);

/// The report on A4.
pub(super) fn pdf(report: &Report) -> Result<Pdf, PdfError> {
    let set = set(report);
    let options = PdfOptions { creator: Smart::Custom(Some("tumble".to_owned())), ..PdfOptions::default() };
    let bytes = set.output.and_then(|document| typst_pdf::pdf(&document, &options));
    let bytes = bytes.map_err(|errors| PdfError(errors.iter().map(words).collect()));
    // It keeps what it found for the next document, of which there is none.
    typst::comemo::evict(0);
    Ok(Pdf { bytes: bytes?, warnings: set.warnings.iter().map(words).collect() })
}

/// The pages, or what is wrong with them.
fn set(report: &Report) -> Warned<SourceResult<PagedDocument>> {
    let (text, drawings) = document::of(report);
    typst::compile(&InMemory::new(text, drawings))
}

fn words(diagnostic: &SourceDiagnostic) -> String {
    diagnostic.message.to_string()
}
