//! The header of a user's function: `w(t)`, `press(depth, area)`.

use std::sync::Arc;

use super::builtins::is_reserved;
use super::error::{Code, FormulaError, Span};
use super::lexer::{self, Bracket, Token, TokenKind};

/// Name and arguments of a function, with their places in the header.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Header {
    /// The function's name.
    pub name: Arc<str>,
    /// Where it stands.
    pub span: Span,
    /// The arguments' names and where they stand.
    pub arguments: Vec<(Arc<str>, Span)>,
}

impl Header {
    /// Reads `name(argument, ...)`.
    pub fn parse(text: &str) -> Result<Self, Vec<FormulaError>> {
        let lexed = lexer::lex(text);
        if !lexed.errors.is_empty() {
            return Err(lexed.errors);
        }
        let header = Self::shape(text, &lexed.tokens).ok_or_else(|| vec![not_a_header(text)])?;
        let errors = header.mistakes();
        if errors.is_empty() { Ok(header) } else { Err(errors) }
    }

    fn shape(text: &str, tokens: &[Token]) -> Option<Self> {
        let [name, open, inner @ .., close] = tokens else { return None };
        let name = word(text, name)?;
        let round = open.kind == TokenKind::Open(Bracket::Round);
        let closed = close.kind == TokenKind::Close(Bracket::Round);
        let arguments = inner.split(|token| token.kind == TokenKind::Comma).map(|part| match part {
            [token] => word(text, token),
            _ => None,
        });
        let arguments: Vec<_> = arguments.collect::<Option<_>>()?;
        (round && closed).then_some(Self { name: name.0, span: name.1, arguments })
    }

    fn mistakes(&self) -> Vec<FormulaError> {
        let named = std::iter::once((&self.name, &self.span));
        let all: Vec<_> = named.chain(self.arguments.iter().map(|(name, span)| (name, span))).collect();
        let mistake = |(at, (name, span)): (usize, &(&Arc<str>, &Span))| {
            let earlier = all[..at].iter().find(|(other, _)| other == name);
            match earlier {
                Some((_, first)) => Some(twice(name, first, span)),
                None => unusable(name, span, at > 0),
            }
        };
        all.iter().enumerate().filter_map(mistake).collect()
    }
}

fn word(text: &str, token: &Token) -> Option<(Arc<str>, Span)> {
    let named = token.kind == TokenKind::Name;
    named.then(|| (text[token.span.clone()].into(), token.span.clone()))
}

fn not_a_header(text: &str) -> FormulaError {
    FormulaError::new(Code::Header, 0..text.len(), "this is not the header of a function")
        .label("expected a name and the names of its arguments in brackets")
        .help("write `w(t)` or `f(a, b)`; what has no arguments is a parameter")
}

fn twice(name: &str, first: &Span, second: &Span) -> FormulaError {
    FormulaError::new(Code::Header, second.clone(), format!("`{name}` is named twice"))
        .label("again here")
        .also(first.clone(), "first here")
}

fn unusable(name: &str, span: &Span, is_argument: bool) -> Option<FormulaError> {
    let error = |message: String| Some(FormulaError::new(Code::Header, span.clone(), message));
    if is_reserved(name) {
        error(format!("`{name}` is a name that every formula knows"))
    } else if is_argument && name.contains(['.', '[']) {
        error(format!("the argument `{name}` is not a plain name"))
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn name_and_arguments_have_places() {
        let header = Header::parse("press( depth, area )").expect("parses");
        assert_eq!((&*header.name, header.span), ("press", 0..5));
        assert_eq!(header.arguments, [("depth".into(), 7..12), ("area".into(), 14..18)]);
    }

    #[test]
    fn what_is_no_header_is_refused() {
        for text in ["", "w", "w()", "w(t", "w t", "w(2)", "w(a b)", "w(a,)", "w(a)(b)", "sin(x)", "f(a, a)"]
        {
            assert_eq!(Header::parse(text).expect_err(text)[0].code, Code::Header, "{text}");
        }
        for text in ["f(pi)", "f(rod.x)", "f(f)"] {
            assert_eq!(Header::parse(text).expect_err(text)[0].labels[0].0, 2..text.len() - 1, "{text}");
        }
        assert_eq!(Header::parse("w(t−)").expect_err("minus sign")[0].code, Code::Character);
    }
}
