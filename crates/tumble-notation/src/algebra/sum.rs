//! Sums: equal terms collected, common factors known.

use std::collections::BTreeMap;

use num_traits::{One, Signed, Zero};
use tumble_expr::Exponent;

use super::{Algebra, Factor, Form, Id};
use crate::rational::{self, Rational};

/// Terms of a sum: parts without a number in front, each with its number.
pub(crate) type Terms = BTreeMap<Id, Rational>;

impl Algebra {
    /// Adds `by * id` to the terms; sums are taken apart.
    pub(crate) fn add_term(&mut self, terms: &mut Terms, by: &Rational, id: Id) {
        if let Form::Sum(inner) = self.form(id).clone() {
            inner.into_iter().for_each(|(part, own)| join(terms, part, rational::times(&own, by)));
        } else {
            let (own, part) = self.split(id);
            join(terms, part, rational::times(&own, by));
        }
    }

    /// The sum of these terms, whatever its length.
    pub(crate) fn raw_sum(&mut self, mut terms: Terms) -> Id {
        terms.retain(|_, by| !by.is_zero());
        if terms.values().any(|by| rational::bits(by) > rational::LARGEST_BITS) {
            return self.refuse_long();
        }
        if terms.len() > 1 {
            return self.intern(Form::Sum(terms.into_iter().collect()));
        }
        match terms.pop_first() {
            Some((part, by)) => self.raw_product(by, &[(part, Exponent::one())]),
            None => self.zero(),
        }
    }

    /// The terms that a part is the sum of, without multiplying anything out.
    pub(crate) fn terms(&mut self, id: Id) -> Terms {
        let mut terms = Terms::new();
        self.add_term(&mut terms, &Rational::one(), id);
        terms
    }

    /// A sum as a number, the factors that its terms share (all denominators are), and a sum that shares none.
    pub(crate) fn primitive(&mut self, sum: Id) -> (Rational, Vec<Factor>, Id) {
        let Form::Sum(terms) = self.form(sum).clone() else {
            return (Rational::one(), vec![], sum);
        };
        let content = content(&terms);
        let shared = self.shared_factors(&terms);
        if content.is_one() && shared.is_empty() {
            return (content, shared, sum);
        }
        let inverse: Vec<Factor> = shared.iter().map(|(id, exponent)| (*id, -*exponent)).collect();
        let mut rest = Terms::new();
        for (part, by) in terms {
            let factors: Vec<Factor> = inverse.iter().copied().chain([(part, Exponent::one())]).collect();
            let divided = self.raw_product(rational::over(&by, &content), &factors);
            // A multiple of a sum is its terms, which may cancel others.
            let (own, part) = self.split(divided);
            self.add_term(&mut rest, &own, part);
        }
        let primitive = self.raw_sum(rest);
        (content, shared, primitive)
    }

    /// Factors of all terms with their least exponents, where a missing factor counts as exponent zero.
    fn shared_factors(&self, terms: &[(Id, Rational)]) -> Vec<Factor> {
        let mut least: BTreeMap<Id, (usize, Exponent)> = BTreeMap::new();
        for (part, _) in terms {
            for (id, exponent) in self.factors(*part) {
                let entry = least.entry(id).or_insert((0, exponent));
                *entry = (entry.0 + 1, entry.1.min(exponent));
            }
        }
        let everywhere = |(id, (count, exponent)): (Id, (usize, Exponent))| {
            let least = if count == terms.len() { exponent } else { exponent.min(Exponent::zero()) };
            (!least.is_zero()).then_some((id, least))
        };
        least.into_iter().filter_map(everywhere).collect()
    }

    /// The factor that all terms share, and what is left of them; the least exponents of all terms, so denominators
    /// that only some terms have stay with those.
    pub(crate) fn factors_of_all(&self, terms: &[(Id, Rational)]) -> Vec<Factor> {
        let mut shared: Option<BTreeMap<Id, Exponent>> = None;
        for (part, _) in terms {
            let own: BTreeMap<Id, Exponent> = self.factors(*part).into_iter().collect();
            shared = Some(match shared {
                None => own,
                Some(before) => before
                    .into_iter()
                    .filter_map(|(id, exponent)| Some((id, nearer(exponent, *own.get(&id)?)?)))
                    .collect(),
            });
        }
        shared.unwrap_or_default().into_iter().collect()
    }
}

/// The exponent nearer to zero of two with one sign.
fn nearer(a: Exponent, b: Exponent) -> Option<Exponent> {
    let positive = a.is_positive();
    (positive == b.is_positive()).then(|| if positive { a.min(b) } else { a.max(b) })
}

pub(crate) fn join(terms: &mut Terms, part: Id, by: Rational) {
    let sum = match terms.remove(&part) {
        Some(before) => rational::plus(&before, &by),
        None => by,
    };
    if !sum.is_zero() {
        terms.insert(part, sum);
    }
}

/// The common divisor of the numbers, with the sign that most terms have; the first decides a tie.
pub(crate) fn content(terms: &[(Id, Rational)]) -> Rational {
    let divisor = terms.iter().fold(Rational::zero(), |gcd, (_, by)| rational::common_divisor(&gcd, by));
    let negative = terms.iter().filter(|(_, by)| by.is_negative()).count();
    let first = terms.first().is_some_and(|(_, by)| by.is_negative());
    let minus = 2 * negative > terms.len() || (2 * negative == terms.len() && first);
    if minus { -divisor } else { divisor }
}
