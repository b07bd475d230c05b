//! Diagnostics as a person reads them: the line of the file with the words underlined, and the cure.

use std::fmt;

use miette::{
    GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteError, MietteSpanContents, SourceCode,
    SourceSpan, SpanContents,
};

use crate::diagnostic::{Diagnostic, Diagnostics, Severity, SourceText, Underlined};

/// This many mistakes are shown; the rest is counted.
const SHOWN: usize = 50;

/// Bytes; a longer line is not drawn. The drawing counts columns with 16 bits, and nobody reads so far.
const LONGEST_LINE: usize = 2000;

impl Diagnostics {
    /// Every mistake with its place in the text, for a terminal of `width` columns.
    ///
    /// Whatever the scene holds, nothing but colours that were asked for is in it that a terminal obeys.
    pub fn render(&self, colour: bool, width: usize) -> String {
        self.printable().drawn(colour, width)
    }

    fn drawn(&self, colour: bool, width: usize) -> String {
        let theme = if colour { GraphicalTheme::unicode() } else { GraphicalTheme::unicode_nocolor() };
        let handler = GraphicalReportHandler::new_themed(theme).with_width(width.max(40)).with_links(false);
        let mut shown = String::new();
        for diagnostic in self.list.iter().take(SHOWN) {
            self.render_one(&handler, diagnostic, &mut shown);
        }
        match self.list.len().saturating_sub(SHOWN) {
            0 => {}
            more => shown.push_str(&format!("and {more} more\n")),
        }
        shown
    }

    fn render_one(&self, handler: &GraphicalReportHandler, diagnostic: &Diagnostic, shown: &mut String) {
        let source = &self.sources[diagnostic.source.min(self.sources.len() - 1)];
        let before = shown.len();
        if is_wide(diagnostic, &source.text) {
            return self.say_one(diagnostic, shown);
        }
        if handler.render_report(shown, &Report { diagnostic, source: Shown(source) }).is_err() {
            shown.truncate(before);
            shown.push_str(&format!("{}: {}: {}\n", source.name, diagnostic.code, diagnostic.message));
        }
        shown.push('\n');
    }

    /// The mistake in words, where its line is too long to be drawn.
    fn say_one(&self, diagnostic: &Diagnostic, shown: &mut String) {
        let only = Diagnostics { sources: self.sources.clone(), list: vec![diagnostic.clone()] };
        let help = diagnostic.help.as_ref().map_or_else(String::new, |help| format!("  help: {help}\n"));
        shown.push_str(&format!("{only}\n{help}\n"));
    }
}

/// Whether a line that would be drawn is longer than the drawing can count.
fn is_wide(diagnostic: &Diagnostic, text: &str) -> bool {
    let touched = |label: &Underlined| {
        let start = text[..label.span.start].rmatch_indices('\n').nth(1).map_or(0, |(at, _)| at + 1);
        let end = text[label.span.end..]
            .match_indices('\n')
            .nth(1)
            .map_or(text.len(), |(at, _)| label.span.end + at);
        text[start..end].lines().any(|line| line.len() > LONGEST_LINE)
    };
    diagnostic.labels.iter().any(touched)
}

/// A diagnostic together with its text, as the renderer wants them.
#[derive(Debug)]
struct Report<'d> {
    diagnostic: &'d Diagnostic,
    source: Shown<'d>,
}

#[derive(Debug)]
struct Shown<'d>(&'d SourceText);

impl SourceCode for Shown<'_> {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let part = self.0.text.read_span(span, before, after)?;
        Ok(Box::new(MietteSpanContents::new_named(
            self.0.name.clone(),
            part.data(),
            *part.span(),
            part.line(),
            part.column(),
            part.line_count(),
        )))
    }
}

impl fmt::Display for Report<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.diagnostic.message)
    }
}

impl std::error::Error for Report<'_> {}

impl miette::Diagnostic for Report<'_> {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(self.diagnostic.code))
    }

    fn severity(&self) -> Option<miette::Severity> {
        Some(match self.diagnostic.severity {
            Severity::Error => miette::Severity::Error,
            Severity::Warning => miette::Severity::Warning,
        })
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        let help = self.diagnostic.help.as_ref()?;
        Some(Box::new(help))
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        (!self.diagnostic.labels.is_empty()).then_some(&self.source)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let labelled = self.diagnostic.labels.iter().map(|label| {
            let text = (!label.text.is_empty()).then(|| label.text.clone());
            LabeledSpan::new(text, label.span.start, label.span.len())
        });
        Some(Box::new(labelled))
    }
}
