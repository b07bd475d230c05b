//! Text to tokens: numbers with their units, names, signs.

use num_rational::BigRational;

use super::characters::{begins_word, foreign, foreign_run, is_space, mixed_alphabets};
use super::error::{Code, FormulaError, Span};
use super::numbers;
use super::syntax::BinaryOperator;
use super::unit_chain::{self, Chain};

/// A word or a sign of a formula.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Token {
    pub(super) kind: TokenKind,
    pub(super) span: Span,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum TokenKind {
    /// A number, with its units if it has any.
    Quantity(BigRational, Option<Chain>),
    /// A value that is already known to be wrong.
    Broken,
    Name,
    BinaryOperator(BinaryOperator),
    Open(Bracket),
    Close(Bracket),
    Comma,
}

/// The two shapes of brackets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Bracket {
    Round,
    Square,
}

/// What the text consists of.
pub(super) struct Lexed {
    pub(super) tokens: Vec<Token>,
    pub(super) errors: Vec<FormulaError>,
    /// Whether what the parser finds wrong is wrong: not so where characters were left out.
    pub(super) complete: bool,
}

pub(super) fn lex(text: &str) -> Lexed {
    let lexed = Lexed { tokens: Vec::new(), errors: Vec::new(), complete: true };
    let mut lexer = Lexer { text, at: 0, lexed };
    while let Some(c) = text[lexer.at..].chars().next() {
        lexer.token(c);
    }
    lexer.lexed
}

/// Signs of other languages, and what they are here.
const STRANGERS: &[(&str, BinaryOperator, &str)] = &[
    ("**", BinaryOperator::Power, "a power is written `a^b`"),
    ("&&", BinaryOperator::Times, "conditions are nested: `if(a < b, if(c < d, x, y), y)`"),
    ("||", BinaryOperator::Times, "conditions are nested: `if(a < b, x, if(c < d, x, y))`"),
    ("==", BinaryOperator::Less, "numbers that vary are never exactly equal: compare with `<` or `>`"),
    ("!=", BinaryOperator::Less, "numbers that vary are never exactly equal: compare with `<` or `>`"),
    ("=<", BinaryOperator::LessEqual, "write `<=`"),
    ("=>", BinaryOperator::GreaterEqual, "write `>=`"),
    ("=", BinaryOperator::Less, "a formula is only the right-hand side; compare with `<` or `>`"),
    (":", BinaryOperator::Divide, "a division is written `a/b`"),
    ("?", BinaryOperator::Less, "a choice is written `if(a < b, x, y)`"),
    ("%", BinaryOperator::Divide, "per cent follows a number directly, as in `10%`"),
];

struct Lexer<'t> {
    text: &'t str,
    at: usize,
    lexed: Lexed,
}

impl Lexer<'_> {
    fn token(&mut self, c: char) {
        let rest = &self.text[self.at..];
        let number = |r: &str| r.starts_with(|c: char| c.is_ascii_digit());
        if is_space(c) {
            self.at += 1;
        } else if number(rest) || rest.strip_prefix('.').is_some_and(number) {
            self.number();
        } else if begins_word(c) {
            self.name();
        } else if !self.stranger() && !self.sign(c) {
            self.foreign();
        }
    }

    fn push(&mut self, kind: TokenKind, end: usize) {
        let span = self.at..end;
        self.at = end;
        self.lexed.tokens.push(Token { kind, span });
    }

    fn number(&mut self) {
        let literal = numbers::read(self.text, self.at);
        let spaces = self.text[literal.end..].bytes().take_while(|b| is_space(char::from(*b))).count();
        let (chain, chain_error) = match unit_chain::read(self.text, literal.end + spaces) {
            Some((chain, error)) => (Some(chain), error),
            None => (None, None),
        };
        let end = chain.as_ref().map_or(literal.end, |chain| chain.span.end);
        let kind = match (literal.value, chain_error) {
            (Ok(value), None) => TokenKind::Quantity(value, chain),
            (value, chain_error) => {
                self.lexed.errors.extend(value.err().into_iter().chain(chain_error));
                TokenKind::Broken
            }
        };
        self.push(kind, end);
    }

    fn name(&mut self) {
        let end = name_end(self.text, self.at);
        if let Some(length) = miscounted(&self.text[end..]) {
            return self.miscounted(end..end + length);
        }
        let error = mixed_alphabets(&self.text[self.at..end], self.at);
        let kind = if error.is_some() { TokenKind::Broken } else { TokenKind::Name };
        self.lexed.errors.extend(error);
        self.push(kind, end);
    }

    /// A name with a count that is none, and what follows it.
    fn miscounted(&mut self, count: Span) {
        let counts = &self.text[count.clone()];
        let message = format!("`{counts}` counts none of several");
        let error = FormulaError::new(Code::Number, count.clone(), message).label("which one?");
        self.lexed.errors.push(error.help("write `[1]`, `[2]` and so on, or `[last]`"));
        let rest = self.text[count.end..].strip_prefix('.').filter(|rest| rest.starts_with(begins_word));
        let end = rest.map_or(count.end, |_| name_end(self.text, count.end + 1));
        self.push(TokenKind::Broken, end);
    }

    /// An operator of another language, reported and replaced by the nearest of ours.
    fn stranger(&mut self) -> bool {
        let rest = &self.text[self.at..];
        let Some((sign, operator, help)) = STRANGERS.iter().find(|(sign, ..)| rest.starts_with(sign)) else {
            return false;
        };
        let end = self.at + sign.len();
        let error =
            FormulaError::new(Code::BinaryOperator, self.at..end, format!("`{sign}` is no operator here"));
        self.lexed.errors.push(error.help(*help));
        self.push(TokenKind::BinaryOperator(*operator), end);
        true
    }

    fn sign(&mut self, c: char) -> bool {
        let equal = self.text[self.at + c.len_utf8()..].starts_with('=');
        let kind = match c {
            '(' => TokenKind::Open(Bracket::Round),
            '[' => TokenKind::Open(Bracket::Square),
            ')' => TokenKind::Close(Bracket::Round),
            ']' => TokenKind::Close(Bracket::Square),
            ',' => TokenKind::Comma,
            _ => match BinaryOperator::from_sign(c, equal) {
                Some(operator) => TokenKind::BinaryOperator(operator),
                None => return false,
            },
        };
        let length = if matches!(c, '<' | '>') && equal { 2 } else { 1 };
        self.push(kind, self.at + length);
        true
    }

    fn foreign(&mut self) {
        let end = foreign_run(self.text, self.at);
        self.lexed.errors.push(foreign(self.text, self.at..end));
        self.lexed.complete = false;
        self.at = end;
    }
}

/// Counts what is the last of its kind.
const LAST: &str = "last";

/// One past the name that begins at `start`: words joined by dots, each perhaps with a count such as `contact[1]` or `apex[last]`.
pub(super) fn name_end(text: &str, start: usize) -> usize {
    let mut end = counted_end(text, unit_chain::word_end(text, start));
    while let Some(rest) = text[end..].strip_prefix('.') {
        if !rest.starts_with(begins_word) {
            break;
        }
        end = counted_end(text, unit_chain::word_end(text, end + 1));
    }
    end
}

fn counted_end(text: &str, end: usize) -> usize {
    let Some(inner) = text[end..].strip_prefix('[') else { return end };
    let count = match inner.starts_with(LAST) {
        true => LAST.len(),
        false => inner.bytes().take_while(u8::is_ascii_digit).count(),
    };
    if count > 0 && inner[count..].starts_with(']') { end + count + 2 } else { end }
}

/// How long the square brackets are that stand at a name's end, where they count nothing.
fn miscounted(text: &str) -> Option<usize> {
    let inside = text.strip_prefix('[')?;
    let close = inside.find(']').filter(|close| !inside[..*close].contains(['[', '(']))?;
    Some(close + 2)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> Vec<&str> {
        let lexed = lex(text);
        assert!(lexed.errors.is_empty(), "{text}: {:?}", lexed.errors);
        lexed.tokens.iter().map(|token| &text[token.span.clone()]).collect()
    }

    #[test]
    fn quantities_are_one_token() {
        assert_eq!(words("-9.81 m/s^2*t"), ["-", "9.81 m/s^2*t"]);
        assert_eq!(words("2  m + 5m<=x"), ["2  m", "+", "5m", "<=", "x"]);
        assert_eq!(words("3 kg*sin(x)"), ["3 kg", "*", "sin", "(", "x", ")"]);
        assert_eq!(words("c.at(10%)"), ["c.at", "(", "10%", ")"]);
    }

    #[test]
    fn names_have_dots_digits_and_counts() {
        assert_eq!(words("rod.tip.vx*w1_0"), ["rod.tip.vx", "*", "w1_0"]);
        assert_eq!(words("floor.contact[1].start"), ["floor.contact[1].start"]);
        assert_eq!(words("θ-Δx"), ["θ", "-", "Δx"]);
    }
}
