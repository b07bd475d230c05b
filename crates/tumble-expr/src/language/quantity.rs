//! A number with its chain of units to a formula in SI units.

use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::characters;
use super::error::{Code, FormulaError, Span};
use super::numbers;
use super::suggest;
use super::syntax::Standing;
use super::unit_chain::{Chain, Factor};
use super::units::{self, NamedUnit, UnitTag};
use crate::expr::Node;
use crate::{Dimension, Exponent, Expr, Kind};

/// A quantity as it stands in a text.
pub(super) struct Written<'f> {
    pub(super) text: &'f str,
    pub(super) span: Span,
    pub(super) value: &'f BigRational,
    pub(super) chain: &'f Chain,
    pub(super) standing: Standing,
}

/// What the units of a chain say beyond their dimension.
pub(super) fn tags(text: &str, chain: &Chain) -> Vec<UnitTag> {
    let tag = |factor: &Factor| Some(units::unit(&text[factor.word.clone()])?.tag);
    chain.factors.iter().filter_map(tag).collect()
}

impl Written<'_> {
    /// The quantity as a formula; `is_name` knows the names of the scene.
    pub(super) fn resolve(&self, is_name: &dyn Fn(&str) -> bool) -> Result<Expr, FormulaError> {
        let units = self.chain.factors.iter().map(|factor| self.unit(factor, is_name));
        let units = units.collect::<Result<Vec<_>, _>>()?;
        self.refuse_names(is_name)?;
        let mut scale = Scale::new(self.value.clone());
        for (unit, factor) in units.iter().zip(&self.chain.factors) {
            scale.times(unit, factor.exponent).ok_or_else(|| self.exponent_range())?;
        }
        self.in_range(&scale)?;
        Ok(scale.into_expr())
    }

    fn word(&self, factor: &Factor) -> &str {
        &self.text[factor.word.clone()]
    }

    fn unit(
        &self,
        factor: &Factor,
        is_name: &dyn Fn(&str) -> bool,
    ) -> Result<&'static NamedUnit, FormulaError> {
        let word = self.word(factor);
        units::unit(word).ok_or_else(|| match is_name(word) {
            true => self.name_behind_number(factor),
            false => self.unknown(factor),
        })
    }

    fn name_behind_number(&self, factor: &Factor) -> FormulaError {
        let word = self.word(factor);
        let message = format!("`{word}` is a name of the scene, not a unit");
        let error = FormulaError::new(Code::UnitOrName, factor.word.clone(), message).label("not a unit");
        error.help(self.spaced(factor))
    }

    /// The spelling in which the chain ends before the factor.
    fn spaced(&self, factor: &Factor) -> String {
        let number = self.text[self.span.start..self.chain.span.start].trim_end();
        let whole = &self.text[self.chain.span.clone()];
        let at = factor.word.start - self.chain.span.start;
        match at.checked_sub(1) {
            None => format!("write `{number}*{whole}` for the product"),
            Some(operator) => {
                let (units, sign, rest) = (&whole[..operator], &whole[operator..at], &whole[at..]);
                format!(
                    "write `{number} {units} {sign} {rest}`: spaces end the units; or `{number}*{whole}` if all of it are names"
                )
            }
        }
    }

    fn unknown(&self, factor: &Factor) -> FormulaError {
        let word = self.word(factor);
        let latin = characters::skeleton(word);
        let error =
            FormulaError::new(Code::UnknownUnit, factor.word.clone(), format!("`{word}` is not a unit"));
        let error = error.label("unknown unit");
        let foreign = characters::foreign_letter(word);
        let exact = units::unit(&latin).map(|unit| unit.symbol.to_owned());
        match (exact.or_else(|| units::nearest_unit(word)), foreign) {
            (Some(near), Some(letter)) => {
                error.help(format!("{letter} is no Latin letter: did you mean `{near}`?"))
            }
            (Some(near), None) => error.help(format!("did you mean `{near}`?")),
            (None, Some(letter)) if latin != word => {
                error.help(format!("{letter} is no Latin letter: write `{latin}`"))
            }
            _ => error.help("a word behind a number is its unit; a product is written with `*`"),
        }
    }

    /// Units that are names as well are refused wherever a reader could take them for the names.
    fn refuse_names(&self, is_name: &dyn Fn(&str) -> bool) -> Result<(), FormulaError> {
        let factors = &self.chain.factors;
        let named = |factor: &&Factor| is_name(self.word(factor));
        let all_named = |part: &[Factor]| part.iter().all(|factor| named(&factor));
        let group = self.chain.groups.iter().find(|group| all_named(&factors[(*group).clone()]));
        let misread = match self.standing {
            Standing::Bracketed => None,
            // Brackets that hold names only could divide by those names.
            Standing::Alone if group.is_some() => group.map(|group| &factors[group.start]),
            Standing::Alone => factors.first().filter(|_| all_named(factors) && factors.len() > 1),
            Standing::Within => factors.iter().find(named),
        };
        misread.map_or(Ok(()), |factor| Err(self.unit_or_name(factor)))
    }

    fn unit_or_name(&self, factor: &Factor) -> FormulaError {
        let (word, written) = (self.word(factor), &self.text[self.span.clone()]);
        let number = self.text[self.span.start..self.chain.span.start].trim_end();
        let names = &self.text[self.chain.span.clone()];
        let meaning = units::unit(word).map_or("a unit", |unit| unit.definition);
        FormulaError::new(
            Code::UnitOrName,
            factor.word.clone(),
            format!("`{word}` is a unit and a name of the scene"),
        )
        .label(format!("{meaning}, or the name?"))
        .help(match self.before_brackets(factor) {
            Some((units, brackets)) => {
                format!("write `{number} {units} / {brackets}` for the names, `({written})` for the units")
            }
            None => {
                format!(
                    "write `{number}*{names}` for the name, `({written})` for the unit, or rename `{word}`"
                )
            }
        })
    }

    /// The chain before the brackets that the factor begins, and the rest, where all before it are units only.
    fn before_brackets(&self, factor: &Factor) -> Option<(&str, &str)> {
        let chain = self.chain.span.clone();
        let first = self.chain.groups.iter().find(|group| self.chain.factors[group.start] == *factor)?;
        // Before the word stand the bracket and the slash.
        let (units, rest) = (chain.start..factor.word.start - 2, factor.word.start - 1..chain.end);
        (first.start > 0).then(|| (&self.text[units], &self.text[rest]))
    }

    fn exponent_range(&self) -> FormulaError {
        let message = "the powers in this unit are out of range";
        FormulaError::new(Code::UnitExponent, self.chain.span.clone(), message)
    }

    fn in_range(&self, scale: &Scale) -> Result<(), FormulaError> {
        if numbers::is_representable(&scale.ratio) {
            return Ok(());
        }
        let too_large = scale.ratio.abs() > BigRational::one();
        Err(numbers::out_of_range(self.span.clone(), too_large).label("in SI units"))
    }
}

/// The name that a unit's word may have been meant for, as a help on an unknown name.
pub(super) fn unit_hint(word: &str) -> Option<String> {
    let unit = units::unit(word)?;
    Some(format!(
        "`{word}` is a unit ({}); a unit follows its number, as in `2 {word}`, and units are joined without spaces",
        unit.definition
    ))
}

/// The nearest of the names, or the cure of a look-alike.
pub(super) fn name_hint<'c>(word: &str, names: impl Iterator<Item = &'c str> + Clone) -> Option<String> {
    let latin = characters::skeleton(word);
    let foreign = characters::foreign_letter(word).filter(|_| names.clone().any(|name| name == latin));
    if let Some(letter) = foreign {
        return Some(format!("{letter} is no Latin letter: write `{latin}` in Latin letters"));
    }
    suggest::nearest(word, names).map(|near| format!("did you mean `{near}`?"))
}

/// ratio * pi^pi * product of roots, in SI units of the dimension.
struct Scale {
    ratio: BigRational,
    pi: Exponent,
    roots: Vec<(BigRational, Exponent)>,
    dimension: Dimension,
}

impl Scale {
    fn new(ratio: BigRational) -> Self {
        Self { ratio, pi: Exponent::zero(), roots: Vec::new(), dimension: Dimension::NONE }
    }

    fn times(&mut self, unit: &NamedUnit, exponent: Exponent) -> Option<()> {
        self.dimension = self.dimension.times(unit.dimension.power(exponent)?)?;
        self.pi += exponent * unit.pi;
        if unit.is_coherent() {
            return Some(());
        }
        let factor = unit.ratio().pow(*exponent.numer());
        match root(&factor, *exponent.denom()) {
            Some(exact) => self.ratio *= exact,
            None => self.roots.push((factor, Exponent::new(1, *exponent.denom()))),
        }
        Some(())
    }

    fn into_expr(self) -> Expr {
        // A stated zero keeps its dimension, unlike a bare one.
        let kind = Kind::Quantity(self.dimension);
        let number = Expr::make(Node::Number(self.ratio), Ok(kind));
        let pi = Some(self.pi).filter(|power| !power.is_zero()).map(|power| powered(Expr::pi(), power));
        let roots = self.roots.into_iter().map(|(base, power)| powered(Expr::number(base), power));
        pi.into_iter().chain(roots).fold(number, |product, factor| product * factor)
    }
}

fn powered(base: Expr, power: Exponent) -> Expr {
    if power.is_one() { base } else { base.powr(power) }
}

/// The exact root, where it is rational.
fn root(value: &BigRational, degree: i32) -> Option<BigRational> {
    if degree == 1 || value.is_one() {
        return Some(value.clone());
    }
    let degree = degree.to_u32()?;
    let (above, below) = (value.numer().nth_root(degree), value.denom().nth_root(degree));
    let root = BigRational::new(above, below);
    (root.pow(i32::try_from(degree).ok()?) == *value).then_some(root)
}
