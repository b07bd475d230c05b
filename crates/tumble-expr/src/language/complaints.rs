//! What the parser says of brackets and comparisons.

use super::error::{Code, FormulaError, Span};

pub(super) fn too_deep(span: Span, limit: usize) -> FormulaError {
    FormulaError::new(Code::TooDeep, span, format!("brackets are nested more than {limit} deep"))
        .help("give parts of the formula names of their own")
}

pub(super) fn mismatch(open: &Span, close: &Span) -> FormulaError {
    FormulaError::new(Code::Bracket, close.clone(), "this bracket does not close the one that is open")
        .also(open.clone(), "opened here")
}

pub(super) fn unopened(text: &str, span: Span) -> FormulaError {
    let message = format!("`{}` closes a bracket that was not opened", &text[span.clone()]);
    FormulaError::new(Code::Bracket, span, message).label("no bracket is open here")
}

pub(super) fn unclosed(text: &str, span: Span) -> FormulaError {
    let message = format!("`{}` is not closed", &text[span.clone()]);
    FormulaError::new(Code::Bracket, span, message)
        .label("opened here")
        .help("close it where its content ends")
}

pub(super) fn chained(span: &Span) -> FormulaError {
    FormulaError::new(Code::ChainedComparison, span.clone(), "the outcome of a comparison is compared again")
        .label("this is true or false, not a number")
        .help("nest the conditions: `if(a < b, if(b < c, x, y), y)`")
}
