//! Reading the chain of units that follows a number: `m/s^2` in `9.81 m/s^2`, `kg/(m*s)`, `1/s`.

use std::ops::Range;

use num_traits::{ToPrimitive, Zero};

use super::characters::{begins_word, continues_word};
use super::error::{Code, FormulaError, Span};
use super::{numbers, units};
use crate::Exponent;

/// Units multiplied and divided, without inner spaces.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Chain {
    /// Where it stands.
    pub span: Span,
    /// Its factors from left to right.
    pub factors: Vec<Factor>,
    /// Which of the factors stand in brackets behind a slash, a range for each pair of brackets.
    pub groups: Vec<Range<usize>>,
}

/// One word of a chain of units with its power.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Factor {
    /// Where the word stands, without its power.
    pub word: Span,
    /// Its power, negative behind a `/`.
    pub exponent: Exponent,
}

/// Powers of units beyond this are surely slips, and would make huge numbers.
const LARGEST_EXPONENT: i32 = 24;

/// And so are chains of more units than this.
const MOST_FACTORS: usize = 16;

/// Reads the chain that begins at `start`; `None` where a name or a call begins there, or nothing of the kind.
pub(super) fn read(text: &str, start: usize) -> Option<(Chain, Option<FormulaError>)> {
    let mut reader = Reader::new(text, start);
    (reader.factor(false) || reader.inverse()).then(|| reader.rest(start))
}

/// One past the word that begins at `start`: a name without dots, or a per cent sign.
pub(super) fn word_end(text: &str, start: usize) -> usize {
    let rest = &text[start..];
    match rest.chars().next() {
        Some('%') => start + 1,
        Some(c) if begins_word(c) => start + rest.find(|c| !continues_word(c)).unwrap_or(rest.len()),
        _ => start,
    }
}

struct Reader<'t> {
    text: &'t str,
    at: usize,
    factors: Vec<Factor>,
    groups: Vec<Range<usize>>,
    error: Option<FormulaError>,
}

impl<'t> Reader<'t> {
    fn new(text: &'t str, at: usize) -> Self {
        Self { text, at, factors: Vec::new(), groups: Vec::new(), error: None }
    }

    fn rest(mut self, start: usize) -> (Chain, Option<FormulaError>) {
        while let Some(divides) = self.sign() {
            if !(self.factor(divides) || divides && self.group()) {
                self.at -= 1;
                break;
            }
        }
        if self.factors.len() > MOST_FACTORS {
            self.error.get_or_insert_with(|| too_many(start..self.at));
        }
        (Chain { span: start..self.at, factors: self.factors, groups: self.groups }, self.error)
    }

    /// Steps over `*` or `/` and tells whether it divides.
    fn sign(&mut self) -> Option<bool> {
        let sign = self.text[self.at..].chars().next().filter(|c| matches!(c, '*' | '/'))?;
        self.at += 1;
        Some(sign == '/')
    }

    /// `1/s` and `1/(m*s)`, where a unit stands behind the slash: nothing else can follow a number so.
    fn inverse(&mut self) -> bool {
        let start = self.at;
        if self.text[start..].starts_with("1/") {
            self.at += 2;
            if self.group() || (self.factor(true) && self.is_unit(&self.factors[0])) {
                return true;
            }
            *self = Self::new(self.text, start);
        }
        false
    }

    /// `(m*s^2)` behind a slash. Brackets belong to the chain only where every word in them is a unit and no power
    /// stands behind them, so that names in brackets stay names.
    fn group(&mut self) -> bool {
        if !self.text[self.at..].starts_with('(') {
            return false;
        }
        let mut inner = Self::new(self.text, self.at + 1);
        let mut complete = inner.factor(true);
        while let (true, Some(divides)) = (complete, inner.sign()) {
            complete = inner.factor(!divides);
        }
        let behind = self.text[inner.at..].strip_prefix(')').map(str::trim_start);
        let closed = behind.is_some_and(|rest| !rest.starts_with('^'));
        if !complete || !closed || inner.error.is_some() || !inner.factors.iter().all(|f| self.is_unit(f)) {
            return false;
        }
        self.groups.push(self.factors.len()..self.factors.len() + inner.factors.len());
        self.factors.extend(inner.factors);
        self.at = inner.at + 1;
        true
    }

    fn is_unit(&self, factor: &Factor) -> bool {
        units::unit(&self.text[factor.word.clone()]).is_some()
    }

    /// Reads one word with its power; a name with a dot and the name of a call are left alone.
    fn factor(&mut self, divides: bool) -> bool {
        let end = word_end(self.text, self.at);
        let rest = &self.text[end..];
        let dotted = rest.strip_prefix('.').is_some_and(|r| r.starts_with(begins_word));
        if end == self.at || dotted || rest.starts_with('(') {
            return false;
        }
        let word = self.at..end;
        self.at = end;
        let power = self.power();
        self.factors.push(Factor { word, exponent: if divides { -power } else { power } });
        true
    }

    fn power(&mut self) -> Exponent {
        let Some(rest) = self.text[self.at..].strip_prefix('^') else {
            return Exponent::from_integer(1);
        };
        let length = power_length(rest);
        let value = exponent(&rest[..length]);
        let slip = if value.is_none() { rest[length..].find(|c| !continues_word(c)) } else { Some(0) };
        let span = self.at..self.at + 1 + slip.map_or(rest.len(), |slip| length + slip);
        self.at = span.end;
        value.unwrap_or_else(|| {
            self.error.get_or_insert_with(|| bad_power(span));
            Exponent::from_integer(1)
        })
    }
}

fn power_length(rest: &str) -> usize {
    if rest.starts_with('(') {
        return rest.find(')').map_or(0, |close| close + 1);
    }
    let sign = usize::from(rest.starts_with('-'));
    let digits = rest[sign..].bytes().take_while(|b| b.is_ascii_digit() || *b == b'.').count();
    sign + digits
}

fn exponent(text: &str) -> Option<Exponent> {
    let bare = text.strip_prefix('(').and_then(|t| t.strip_suffix(')')).unwrap_or(text);
    let (numerator, denominator) = bare.split_once('/').unwrap_or((bare, "1"));
    let denominator = plain(denominator).filter(|value| !value.is_zero())?;
    let value = plain(numerator)? / denominator;
    let (n, d) = (value.numer().to_i32()?, value.denom().to_i32()?);
    (n.abs() <= LARGEST_EXPONENT && d <= LARGEST_EXPONENT).then(|| Exponent::new(n, d))
}

fn plain(text: &str) -> Option<num_rational::BigRational> {
    let written = |c: char| c.is_ascii_digit() || matches!(c, '.' | '-');
    (text.len() <= 8 && text.chars().all(written)).then(|| numbers::decimal(text)).flatten()
}

fn too_many(span: Span) -> FormulaError {
    let message = format!("more than {MOST_FACTORS} units are multiplied here");
    FormulaError::new(Code::UnitExponent, span, message)
}

fn bad_power(span: Span) -> FormulaError {
    let message = format!("the power of a unit must be a plain number up to {LARGEST_EXPONENT}");
    FormulaError::new(Code::UnitExponent, span, message)
        .label("not such a number")
        .help("write `2 m^2`, `4 m^-1` or `3 m^(1/2)`; for the power of the whole quantity write `(2 m)^n`")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chain(text: &str) -> (String, Vec<(&str, Exponent)>) {
        let (chain, error) = read(text, 0).expect(text);
        assert_eq!(error, None, "{text}");
        let factors = chain.factors.iter().map(|f| (&text[f.word.clone()], f.exponent)).collect();
        (text[chain.span].to_owned(), factors)
    }

    #[test]
    fn a_chain_has_signed_powers() {
        let one = Exponent::from_integer(1);
        let (whole, factors) = chain("kg*m^2/s^2 + 1");
        assert_eq!(whole, "kg*m^2/s^2");
        assert_eq!(factors, [("kg", one), ("m", one + one), ("s", -one - one)]);
        assert_eq!(chain("m^(1/2)").1, [("m", Exponent::new(1, 2))]);
        assert_eq!(chain("m^-0.5*x").1[0], ("m", Exponent::new(-1, 2)));
        assert_eq!(chain("%").1, [("%", one)]);
    }

    #[test]
    fn a_chain_ends_before_spaces_numbers_names_with_dots_and_calls() {
        for (text, whole) in
            [("m / s", "m"), ("m/2", "m"), ("m*rod.x", "m"), ("m*sin(x)", "m"), ("m/(x)", "m"), ("m*", "m")]
        {
            assert_eq!(chain(text).0, whole);
        }
        assert!(read("sin(x)", 0).is_none() && read("rod.x", 0).is_none() && read("+", 0).is_none());
    }

    #[test]
    fn units_in_brackets_behind_a_slash_belong_to_the_chain() {
        let one = Exponent::from_integer(1);
        assert_eq!(
            chain("kg/(m*s^2) + 1"),
            ("kg/(m*s^2)".into(), vec![("kg", one), ("m", -one), ("s", -one - one)])
        );
        assert_eq!(chain("kg/(m/s)*N").1, [("kg", one), ("m", -one), ("s", one), ("N", one)]);
        assert_eq!(chain("1/(m*s)").1, [("m", -one), ("s", -one)]);
        assert_eq!(chain("1/s*m").1, [("s", -one), ("m", one)]);
        assert_eq!(read("kg/(m*s)/(h)", 0).expect("a chain").0.groups, [1..3, 3..4]);
    }

    #[test]
    fn brackets_with_anything_but_units_are_left_alone() {
        let cases = [
            "(m*x)", "(m s)", "(m*2)", "(m*s", "(m*s)^2", "(m*s) ^2", "(m^n)", "((m))", "(m*(s))", "()",
            "(m*)",
        ];
        for brackets in cases {
            assert_eq!(chain(&format!("kg/{brackets}")).0, "kg", "{brackets}");
            assert!(read(&format!("1/{brackets}"), 0).is_none(), "{brackets}");
        }
        assert!(read("1/2", 0).is_none() && read("1/x", 0).is_none() && read("1/sin(x)", 0).is_none());
    }

    #[test]
    fn powers_that_are_no_small_number_are_refused() {
        for text in ["m^n", "m^", "m^1000000", "m^(1/0)", "m^(a/b)", "m^(1", "m^(1/2/3)", "m^--1"] {
            let (_, error) = read(text, 0).expect(text);
            assert_eq!(error.expect(text).code, Code::UnitExponent);
        }
    }
}
