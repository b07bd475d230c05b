//! What is wrong with a scene, as values that point into its text.

use std::fmt;

use crate::code::Code;
use crate::printable::{Shown, printable, printable_lines};

pub use tumble_expr::language::Span;

/// A text that was read: the scene, or a setting from the command line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceText {
    /// The file's name, or `--set T=2s`.
    pub name: String,
    /// Its text, a byte-order mark left out.
    pub text: String,
}

/// A part of a source and what is to be said of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Underlined {
    /// Where it is.
    pub span: Span,
    /// What it is; may be empty.
    pub text: String,
}

/// What follows from something that is said of a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Severity {
    /// The scene is not run.
    #[default]
    Error,
    /// The scene is run, and its user should know.
    Warning,
}

/// One mistake, or one warning.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// What follows from it.
    pub severity: Severity,
    /// The kind of mistake.
    pub code: Code,
    /// What is wrong, in one sentence without a full stop.
    pub message: String,
    /// Index of the source that the labels count in.
    pub source: usize,
    /// The parts that are wrong.
    pub labels: Vec<Underlined>,
    /// How to put it right.
    pub help: Option<String>,
}

impl Diagnostic {
    /// A mistake at a place in the scene.
    pub(crate) fn new(code: Code, span: Span, message: impl Into<String>) -> Self {
        let labels = vec![Underlined { span, text: String::new() }];
        let (severity, message) = (Severity::Error, message.into());
        Self { severity, code, message, source: 0, labels, help: None }
    }

    /// The same with the text of its first label.
    pub(crate) fn label(mut self, text: impl Into<String>) -> Self {
        if let Some(label) = self.labels.first_mut() {
            label.text = text.into();
        }
        self
    }

    /// The same with one more place.
    pub(crate) fn also(mut self, span: Span, text: impl Into<String>) -> Self {
        self.labels.push(Underlined { span, text: text.into() });
        self
    }

    /// The same with its cure.
    pub(crate) fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// The same in another source.
    pub(crate) fn within(mut self, source: usize) -> Self {
        self.source = source;
        self
    }

    /// The same without a place: what is missing is nowhere.
    pub(crate) fn nowhere(mut self) -> Self {
        self.labels.clear();
        self
    }

    /// The same as a warning.
    pub(crate) fn warning(mut self) -> Self {
        self.severity = Severity::Warning;
        self
    }

    fn printable(&self, source: &Shown) -> Self {
        let label = |label: &Underlined| Underlined {
            span: source.place(label.span.start)..source.place(label.span.end),
            text: printable(&label.text).into_owned(),
        };
        Self {
            message: printable(&self.message).into_owned(),
            labels: self.labels.iter().map(label).collect(),
            help: self.help.as_deref().map(|help| printable_lines(help).into_owned()),
            ..self.clone()
        }
    }

    fn start(&self) -> usize {
        self.labels.first().map_or(usize::MAX, |label| label.span.start)
    }
}

/// All mistakes of a scene, or all warnings, in the order of the text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Diagnostics {
    /// The texts: the scene first, then the settings.
    pub sources: Vec<SourceText>,
    /// The mistakes; where a scene was refused there is at least one.
    pub list: Vec<Diagnostic>,
}

impl Diagnostics {
    pub(crate) fn new(sources: Vec<SourceText>, mut list: Vec<Diagnostic>) -> Self {
        list.sort_by_key(|diagnostic| (diagnostic.source, diagnostic.start()));
        Self { sources, list }
    }

    /// Adds those of the same scene.
    pub fn extend(&mut self, others: Self) {
        self.list.extend(others.list);
    }

    /// Whether nothing is said.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Line and column of a diagnostic's first label, counted from 1.
    pub fn position(&self, diagnostic: &Diagnostic) -> Option<(usize, usize)> {
        let label = diagnostic.labels.first()?;
        let before = self.sources.get(diagnostic.source)?.text.get(..label.span.start)?;
        let line = before.matches('\n').count() + 1;
        let start = before.rfind('\n').map_or(0, |newline| newline + 1);
        Some((line, before[start..].chars().count() + 1))
    }

    /// The same with nothing in it that a terminal obeys, whatever the texts hold.
    pub(crate) fn printable(&self) -> Self {
        let shown: Vec<Shown> = self.sources.iter().map(|source| Shown::of(&source.text)).collect();
        let list = self.list.iter().map(|mistake| match shown.get(mistake.source) {
            Some(shown) => mistake.printable(shown),
            None => mistake.clone(),
        });
        let list = list.collect();
        let named = self.sources.iter().zip(shown);
        let source = |(source, shown): (&SourceText, Shown)| SourceText {
            name: printable(&source.name).into_owned(),
            text: shown.text,
        };
        Self { sources: named.map(source).collect(), list }
    }
}

/// One mistake a line: `scene.toml:12:9: E0513: mass is missing`.
impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, diagnostic) in self.list.iter().enumerate() {
            let name = self.sources.get(diagnostic.source).map_or("", |source| source.name.as_str());
            let name = printable(name);
            f.write_str(if index == 0 { "" } else { "\n" })?;
            match self.position(diagnostic) {
                Some((line, column)) => write!(f, "{name}:{line}:{column}: ")?,
                None => write!(f, "{name}: ")?,
            }
            write!(f, "{}: {}", diagnostic.code, printable(&diagnostic.message))?;
        }
        Ok(())
    }
}

impl std::error::Error for Diagnostics {}
