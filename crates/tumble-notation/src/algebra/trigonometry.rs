//! Sine and cosine: exact angles, signs, and the identities of sums.

use num_bigint::BigInt;
use num_traits::{One, Signed, ToPrimitive, Zero};
use tumble_expr::{Exponent, Unary};

use super::sum::{Terms, join};
use super::{Algebra, Factor, Form, Function, Id};
use crate::rational::{Rational, ratio};

/// Most terms of a sum in which pairs are looked for.
const MOST_TERMS: usize = 40;

impl Algebra {
    pub(super) fn call(&mut self, op: Unary, id: Id) -> Id {
        self.intern(Form::Call(Function::Unary(op), vec![id]))
    }

    pub(crate) fn sine(&mut self, angle: Id) -> Id {
        let (turns, rest) = self.half_turns(angle);
        self.sine_of(turns, rest)
    }

    pub(crate) fn cosine(&mut self, angle: Id) -> Id {
        let (turns, rest) = self.half_turns(angle);
        self.sine_of(turns + ratio(1, 2), rest)
    }

    /// An angle as a multiple of pi and the rest.
    fn half_turns(&mut self, angle: Id) -> (Rational, Id) {
        let pi = self.intern(Form::Pi);
        let mut terms = self.terms(angle);
        let turns = terms.remove(&pi).unwrap_or_else(Rational::zero);
        (turns, self.raw_sum(terms))
    }

    /// `sin(turns pi + rest)`.
    fn sine_of(&mut self, turns: Rational, rest: Id) -> Id {
        if self.is_zero(rest) {
            return self.sine_of_pi(&turns);
        }
        let (minus, rest) = self.positive(rest);
        // sin(a - x) = sin(pi - a + x)
        let turns = if minus { Rational::one() - turns } else { turns };
        let doubled = &turns * ratio(2, 1);
        if !doubled.is_integer() {
            return self.sine_beyond(&turns, rest);
        }
        let quarter = (doubled.to_integer() % BigInt::from(4)).to_i64().unwrap_or(0).rem_euclid(4);
        let function = self.call(if quarter % 2 == 0 { Unary::Sin } else { Unary::Cos }, rest);
        if quarter < 2 { function } else { self.negated(function) }
    }

    /// `sin(turns pi + rest)` where no quarter turn is left: the whole half turns become a sign.
    fn sine_beyond(&mut self, turns: &Rational, rest: Id) -> Id {
        let whole = turns.floor();
        let pi = self.intern(Form::Pi);
        let mut terms = self.terms(rest);
        join(&mut terms, pi, turns - &whole);
        let angle = self.raw_sum(terms);
        let sine = self.call(Unary::Sin, angle);
        self.after_half_turns(&whole, sine)
    }

    /// `sin(turns pi)`: exact at multiples of 30 and 45 degrees.
    fn sine_of_pi(&mut self, turns: &Rational) -> Id {
        let whole = turns.floor();
        let part = turns - &whole;
        let part = if part > ratio(1, 2) { Rational::one() - part } else { part };
        // The square of the sine.
        let square = [(0, 1, 0, 1), (1, 6, 1, 4), (1, 4, 1, 2), (1, 3, 3, 4), (1, 2, 1, 1)]
            .into_iter()
            .find(|(p, q, ..)| ratio(*p, *q) == part)
            .map(|(_, _, p, q)| ratio(p, q));
        let sine = match square {
            Some(square) => {
                let square = self.number(square);
                self.raw_product(Rational::one(), &[(square, Exponent::new(1, 2))])
            }
            None => {
                let pi = self.intern(Form::Pi);
                let angle = self.scaled(part, pi);
                self.call(Unary::Sin, angle)
            }
        };
        self.after_half_turns(&whole, sine)
    }

    /// A sine so many whole half turns further.
    fn after_half_turns(&mut self, whole: &Rational, sine: Id) -> Id {
        if (whole / ratio(2, 1)).is_integer() { sine } else { self.negated(sine) }
    }

    /// A part or its negative, whichever has the plus sign; says whether it is the negative.
    pub(crate) fn positive(&mut self, id: Id) -> (bool, Id) {
        let minus = match self.form(id) {
            Form::Number(value) => value.is_negative(),
            Form::Product(by, _) => by.is_negative(),
            Form::Sum(terms) => super::sum::content(terms).is_negative(),
            _ => false,
        };
        (minus, if minus { self.negated(id) } else { id })
    }

    /// `sin^2 + cos^2 = 1` and the sums of angles, wherever two terms are alike but for these.
    pub(crate) fn trigonometric_sums(&mut self, terms: &mut Terms) {
        if terms.len() > MOST_TERMS {
            return;
        }
        while self.one_pair(terms) {}
    }

    fn one_pair(&mut self, terms: &mut Terms) -> bool {
        let all: Vec<(Id, Rational)> = terms.iter().map(|(id, by)| (*id, by.clone())).collect();
        all.iter().any(|(term, by)| self.pairs_of(terms, *term, by))
    }

    fn pairs_of(&mut self, terms: &mut Terms, term: Id, by: &Rational) -> bool {
        let waves: Vec<(Unary, Id, Exponent)> =
            self.factors(term).into_iter().filter_map(|factor| self.wave(factor)).collect();
        for (i, first) in waves.iter().enumerate() {
            if first.0 == Unary::Sin
                && first.2 >= Exponent::from_integer(2)
                && self.square_pair(terms, term, by, first.1)
            {
                return true;
            }
            for second in &waves[i + 1..] {
                if self.angle_pair(terms, term, by, (first.0, first.1), (second.0, second.1)) {
                    return true;
                }
            }
        }
        false
    }

    /// A sine or cosine to a power of at least one.
    fn wave(&self, (id, exponent): Factor) -> Option<(Unary, Id, Exponent)> {
        match self.form(id) {
            Form::Call(Function::Unary(op @ (Unary::Sin | Unary::Cos)), parts)
                if exponent >= Exponent::one() =>
            {
                Some((*op, parts[0], exponent))
            }
            _ => None,
        }
    }

    /// `R sin^2 a + R cos^2 a = R`
    fn square_pair(&mut self, terms: &mut Terms, term: Id, by: &Rational, angle: Id) -> bool {
        let (sine, cosine) = (self.call(Unary::Sin, angle), self.call(Unary::Cos, angle));
        let two = Exponent::from_integer(2);
        let rest = self.raw_product(Rational::one(), &[(term, Exponent::one()), (sine, -two)]);
        let partner = self.raw_product(Rational::one(), &[(rest, Exponent::one()), (cosine, two)]);
        if terms.get(&partner) != Some(by) {
            return false;
        }
        terms.remove(&term);
        terms.remove(&partner);
        self.add_term(terms, by, rest);
        true
    }

    /// `cos a cos b + sin a sin b = cos(a - b)`, `sin a cos b + cos a sin b = sin(a + b)`, and with minus signs.
    fn angle_pair(
        &mut self,
        terms: &mut Terms,
        term: Id,
        by: &Rational,
        (f, a): (Unary, Id),
        (g, b): (Unary, Id),
    ) -> bool {
        let other = |op: Unary| if op == Unary::Sin { Unary::Cos } else { Unary::Sin };
        if a == b {
            return false;
        }
        let one = Exponent::one();
        let [fa, gb] = [self.call(f, a), self.call(g, b)];
        let [fa2, gb2] = [self.call(other(f), a), self.call(other(g), b)];
        let rest = self.raw_product(Rational::one(), &[(term, one), (fa, -one), (gb, -one)]);
        let partner = self.raw_product(Rational::one(), &[(rest, one), (fa2, one), (gb2, one)]);
        let Some(partner_by) = terms.get(&partner).cloned().filter(|other| other.abs() == by.abs()) else {
            return false;
        };
        let alike = partner_by == *by;
        let (wave, sign) = self.joined_wave((f, a), (g, b), alike);
        let whole = self.raw_product(sign * by, &[(rest, one), (wave, one)]);
        terms.remove(&term);
        terms.remove(&partner);
        self.add_term(terms, &Rational::one(), whole);
        true
    }

    fn joined_wave(&mut self, (f, a): (Unary, Id), (g, b): (Unary, Id), alike: bool) -> (Id, Rational) {
        // cos a cos b +- sin a sin b = cos(a -+ b), sin a cos b +- cos a sin b = sin(a +- b)
        let (first, second) = if (f, g) == (Unary::Cos, Unary::Sin) { (b, a) } else { (a, b) };
        let by = if alike == (f == g) { -Rational::one() } else { Rational::one() };
        let mut terms = self.terms(first);
        self.add_term(&mut terms, &by, second);
        let angle = self.sum(terms);
        let wave = if f == g { self.cosine(angle) } else { self.sine(angle) };
        // sin a sin b - cos a cos b = -cos(a + b)
        let is_minus = f == Unary::Sin && f == g && !alike;
        (wave, if is_minus { -Rational::one() } else { Rational::one() })
    }
}
