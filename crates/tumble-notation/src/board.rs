//! What laws say, printed as it is written: names first, then what they stand for.

use std::sync::Arc;

use tumble_expr::{Expr, Named, Symbol, Written};

use crate::layout::{Math, Operator};
use crate::{MathError, Notation};

impl Notation {
    /// `left = right`, and below it an equation for each name in it, in the order of reading.
    ///
    /// `shown` says what a name of the law is called here, where its own is taken.
    pub fn stated(
        &self,
        left: Math,
        right: &Written,
        shown: &dyn Fn(&str) -> String,
    ) -> Result<Vec<Math>, MathError> {
        let mut board = Board { notation: self.clone().without_automatic_names(), shown, explained: vec![] };
        let mut lines = vec![Math::equation(left, board.math(right)?)];
        for named in right.names() {
            lines.push(board.definition(&named)?);
        }
        lines.extend(board.explained);
        Ok(lines)
    }
}

struct Board<'a> {
    notation: Notation,
    shown: &'a dyn Fn(&str) -> String,
    /// What names within formulas stand for.
    explained: Vec<Math>,
}

impl Board<'_> {
    fn definition(&mut self, named: &Arc<Named>) -> Result<Math, MathError> {
        let name = self.name(&named.name);
        let left = match &named.of {
            Some(variable) => {
                let variable = self.notation.symbol(&variable.name).bracketed();
                Math::Row(vec![name, variable])
            }
            None => name,
        };
        Ok(Math::equation(left, self.math(&named.is)?))
    }

    /// A name; a prime behind it marks a rate.
    fn name(&self, name: &str) -> Math {
        match name.strip_suffix('\'') {
            Some(of) => Math::derivative(&(self.shown)(of), 1),
            None => Math::symbol(&(self.shown)(name)),
        }
    }

    fn math(&mut self, written: &Written) -> Result<Math, MathError> {
        Ok(match written {
            Written::Scalar(formula) => self.scalar(formula)?,
            Written::Vector(vector) => {
                let row = |component: &Expr| Ok(vec![self.scalar(component)?]);
                Math::Matrix(vector.components().iter().map(row).collect::<Result<_, MathError>>()?)
            }
            Written::Name(named) => self.name(&named.name),
            Written::Sum(terms) => self.sum(terms)?,
            Written::Product(factors) => self.product(factors)?,
            Written::Norm(of) => Math::Bars(Box::new(self.math(of)?)),
            Written::Dot(pair) => self.between(pair, Operator::Times)?,
            Written::Cross(pair) => self.between(pair, Operator::Cross)?,
            Written::Integral { of, over, limits } => self.integral(of, over, limits)?,
        })
    }

    fn scalar(&mut self, formula: &Expr) -> Result<Math, MathError> {
        let shown = self.notation.formula(formula)?;
        for line in shown.definitions.iter().map(crate::Line::math) {
            if !self.explained.contains(&line) {
                self.explained.push(line);
            }
        }
        let line = shown.lines.into_iter().next();
        Ok(line.map_or_else(|| Math::Row(vec![]), |line| line.right))
    }

    fn sum(&mut self, terms: &[(bool, Written)]) -> Result<Math, MathError> {
        let term = |(minus, term): &(bool, Written)| Ok((*minus, self.term(term)?));
        let terms: Vec<_> = terms.iter().map(term).collect::<Result<_, MathError>>()?;
        Ok(Math::Row(Math::terms(terms)))
    }

    /// With brackets if it is a sum.
    fn term(&mut self, term: &Written) -> Result<Math, MathError> {
        let math = self.math(term)?;
        Ok(if is_sum(&math) { math.bracketed() } else { math })
    }

    fn product(&mut self, factors: &[Written]) -> Result<Math, MathError> {
        let mut shown = vec![];
        for factor in factors {
            match self.math(factor)? {
                Math::Number(one) if one == "1" && factors.len() > 1 => {}
                Math::Product(inner) => shown.extend(inner),
                math => shown.push(math.into_term()),
            }
        }
        Ok(Math::product(shown))
    }

    fn between(&mut self, pair: &[Written; 2], operator: Operator) -> Result<Math, MathError> {
        let [left, right] = [self.math(&pair[0])?, self.math(&pair[1])?];
        Ok(Math::Row(vec![left.into_term(), Math::Operator(operator), right.into_term()]))
    }

    fn integral(&mut self, of: &Written, over: &Symbol, limits: &[Expr; 2]) -> Result<Math, MathError> {
        let of = self.term(of)?;
        let limits = Box::new([self.scalar(&limits[0])?, self.scalar(&limits[1])?]);
        let over = Box::new(self.notation.symbol(&over.name));
        Ok(Math::Integral { of: Box::new(of), over, limits })
    }
}

/// Whether there is a plus or minus in a row, or before it.
fn is_sum(math: &Math) -> bool {
    let is_sign =
        |part: &Math| matches!(part, Math::Operator(Operator::Plus | Operator::Minus | Operator::Negative));
    matches!(math, Math::Row(parts) if parts.iter().any(is_sign))
}
