//! Reads printed text the way a person does, and computes its value: brackets that are missing show as wrong numbers.

use std::collections::HashMap;

use tumble_notation::Printed;

use super::{Evaluator, Points, close};

/// Every line of text has the value of its formula. `spelling` says how a symbol is printed.
pub fn assert_reads_as(shown: &Printed, positive: &[&str], spelling: &dyn Fn(&str) -> String) {
    let all = shown.lines.iter().chain(&shown.definitions);
    let formulas: Vec<_> = all.clone().map(|line| line.formula.clone()).collect();
    let mut evaluator = Evaluator::new(&formulas);
    let mut points = Points::new();
    for _ in 0..5 {
        let names = evaluator.names.clone();
        let values: Vec<f64> = names
            .iter()
            .map(|name| {
                let value = points.next();
                if points.next() < 0.9 && !positive.contains(&name.as_str()) { -value } else { value }
            })
            .collect();
        let expected = evaluator.at(&values);
        let mut known: HashMap<String, f64> =
            names.iter().zip(&values).map(|(name, value)| (spelling(name), *value)).collect();
        known.insert("π".to_owned(), std::f64::consts::PI);
        known.insert("e".to_owned(), std::f64::consts::E);
        for (line, value) in shown.definitions.iter().zip(&expected[shown.lines.len()..]) {
            let name = tumble_notation::text(line.left.as_ref().expect("a definition has a name"));
            known.insert(name, *value);
        }
        for (line, expected) in all.clone().zip(&expected) {
            let text = tumble_notation::text(&line.right);
            if text.contains('…') || !expected.is_finite() {
                continue;
            }
            let found = value(&text, &known);
            assert!(close(*expected, found), "`{text}` reads as {found}, not {expected}, with {known:?}");
        }
    }
}

/// The value of a line of text.
pub fn value(text: &str, known: &HashMap<String, f64>) -> f64 {
    let mut reader = Reader { rest: text.chars().collect(), at: 0, known };
    let value = reader.sum();
    assert_eq!(reader.at, reader.rest.len(), "`{text}` was read up to {}", reader.at);
    value
}

struct Reader<'a> {
    rest: Vec<char>,
    at: usize,
    known: &'a HashMap<String, f64>,
}

impl Reader<'_> {
    fn peek(&self) -> char {
        self.rest.get(self.at).copied().unwrap_or('\0')
    }

    fn takes(&mut self, text: &str) -> bool {
        let starts = text.chars().enumerate().all(|(i, c)| self.rest.get(self.at + i) == Some(&c));
        if starts {
            self.at += text.chars().count();
        }
        starts
    }

    fn sum(&mut self) -> f64 {
        let minus = self.takes("−");
        let first = self.product();
        let mut sum = if minus { -first } else { first };
        loop {
            if self.takes(" + ") {
                sum += self.product();
            } else if self.takes(" − ") {
                sum -= self.product();
            } else {
                return sum;
            }
        }
    }

    /// Factors side by side; a line divides all before it by the one factor after it.
    fn product(&mut self) -> f64 {
        let mut product = self.factor();
        loop {
            if self.takes("/") {
                product /= self.factor();
            } else if self.takes("·") {
                product *= self.factor();
            } else if self.peek() == ' '
                && !matches!(self.rest.get(self.at + 1), Some('+' | '−' | '<' | '≤' | 'i' | 'o'))
            {
                self.at += 1;
                if !self.unit() {
                    product *= self.factor();
                }
            } else {
                return product;
            }
        }
    }

    /// Units of written quantities are those of the values.
    fn unit(&mut self) -> bool {
        let units = ["m/s²", "kg m/s²", "m", "kg", "s"];
        let ends = |reader: &Self, unit: &str| {
            let next = reader.rest.get(reader.at + unit.chars().count()).copied().unwrap_or('\0');
            !next.is_alphabetic() && reader.known.keys().all(|name| name != unit)
        };
        let found = units.into_iter().find(|unit| {
            let here: String = self.rest[self.at..].iter().take(unit.chars().count()).collect();
            here == *unit && ends(self, unit)
        });
        found.is_some_and(|unit| self.takes(unit))
    }

    fn factor(&mut self) -> f64 {
        let base = self.atom();
        match self.exponent() {
            Some(exponent) => base.powf(exponent),
            None => base,
        }
    }

    fn exponent(&mut self) -> Option<f64> {
        if self.takes("^(") {
            let exponent = self.sum();
            assert!(self.takes(")"));
            return Some(exponent);
        }
        let digits = "⁰¹²³⁴⁵⁶⁷⁸⁹";
        let minus = self.takes("⁻");
        let mut found = None;
        while let Some(digit) = digits.chars().position(|c| c == self.peek()) {
            self.at += 1;
            found = Some(found.unwrap_or(0.0) * 10.0 + digit as f64);
        }
        found.map(|value: f64| if minus { -value } else { value })
    }

    fn atom(&mut self) -> f64 {
        if let Some(value) = self.name() {
            return value;
        }
        if self.takes("(") {
            return self.until(")");
        }
        if self.takes("|") {
            return self.until("|").abs();
        }
        if self.takes("√") {
            return self.atom().sqrt();
        }
        if self.peek().is_ascii_digit() {
            return self.number();
        }
        self.function()
    }

    fn until(&mut self, end: &str) -> f64 {
        let value = self.sum();
        assert!(self.takes(end), "no `{end}` at {} of {}", self.at, self.rest.iter().collect::<String>());
        value
    }

    /// The longest known name that stands here.
    fn name(&mut self) -> Option<f64> {
        let rest: String = self.rest[self.at..].iter().collect();
        let ends = |name: &str| {
            let last = name.chars().last().unwrap_or(' ');
            let next = rest[name.len()..].chars().next().unwrap_or(' ');
            !last.is_alphanumeric() || !(next.is_alphabetic() || next == '_' || "₀₁₂₃₄₅₆₇₈₉".contains(next))
        };
        let here = self.known.keys().filter(|name| rest.starts_with(name.as_str()) && ends(name));
        let name = here.max_by_key(|name| name.len())?.clone();
        self.takes(&name);
        Some(self.known[&name])
    }

    fn number(&mut self) -> f64 {
        let from = self.at;
        // Long numbers are in groups of three.
        while self.peek().is_ascii_digit() || ['.', '\u{2009}'].contains(&self.peek()) {
            self.at += 1;
        }
        let digits = self.rest[from..self.at].iter().filter(|c| **c != '\u{2009}');
        digits.collect::<String>().parse().expect("digits")
    }

    fn function(&mut self) -> f64 {
        let from = self.at;
        while self.peek().is_ascii_alphabetic() {
            self.at += 1;
        }
        let name: String = self.rest[from..self.at].iter().collect();
        let power = self.exponent().unwrap_or(1.0);
        let bracket = self.takes("(");
        let argument = if bracket {
            self.until(")")
        } else {
            assert!(self.takes(" "), "`{name}` at {from} of {}", self.rest.iter().collect::<String>());
            self.atom()
        };
        let value = match name.as_str() {
            "sin" => argument.sin(),
            "cos" => argument.cos(),
            "tan" => argument.tan(),
            "arcsin" => argument.asin(),
            "arctan" => argument.atan(),
            "sinh" => argument.sinh(),
            "cosh" => argument.cosh(),
            "tanh" => argument.tanh(),
            "ln" => argument.ln(),
            "sgn" => argument.signum(),
            "step" => f64::from(u8::from(argument >= 0.0)),
            _ => panic!("`{name}` in {}", self.rest.iter().collect::<String>()),
        };
        value.powf(power)
    }
}
