//! From formulas to the normal form.

use std::collections::HashMap;

use num_rational::BigRational;
use tumble_expr::{Dimension, Exponent, Expr, Kind, Node};

use super::{Algebra, Base, Factor, Form, Function, Id, Leaf};
use crate::MathError;

/// Parts of all formulas together beyond which nothing is shown: nobody reads a thousandth of it, and the time it takes
/// stays within a second or two.
pub(crate) const MOST_PARTS: usize = 20_000;

/// Forms tried on the way, beyond which a formula is given up: about a second's work.
const MOST_FORMS: usize = 200_000;

/// What was imported, by the address of its node; the formulas are kept so that no address is used twice.
#[derive(Debug, Default)]
pub(crate) struct Imported {
    ids: HashMap<*const Node, Id>,
    kept: Vec<Expr>,
}

impl Imported {
    /// The next time, this formula is looked at again: it has a name by now.
    pub(crate) fn forget(&mut self, formula: &Expr) {
        self.ids.remove(&std::ptr::from_ref(formula.node()));
    }
}

impl Algebra {
    /// Adds a formula; shared parts are visited once, and the depth of the formula is not bounded by the stack.
    pub(crate) fn import(&mut self, imported: &mut Imported, formula: &Expr) -> Result<Id, MathError> {
        formula.kind()?;
        imported.kept.push(formula.clone());
        let mut pending: Vec<&Expr> = vec![formula];
        while let Some(next) = pending.last().copied() {
            let missing = |part: &&Expr| !imported.ids.contains_key(&std::ptr::from_ref(part.node()));
            let parts: Vec<&Expr> = next.children().into_iter().filter(missing).collect();
            if !parts.is_empty() {
                // The left part is looked at first, so that it stands first.
                pending.extend(parts.into_iter().rev());
                continue;
            }
            pending.pop();
            if imported.ids.contains_key(&std::ptr::from_ref(next.node())) {
                continue;
            }
            if imported.ids.len() >= MOST_PARTS {
                return Err(MathError::TooLarge { limit: MOST_PARTS });
            }
            let made = self.made_of(next, |part| imported.ids[&std::ptr::from_ref(part.node())]);
            let id = self.named(made);
            let id = self.cut(id);
            self.check()?;
            if self.forms.len() > MOST_FORMS {
                return Err(MathError::TooLarge { limit: MOST_PARTS });
            }
            imported.ids.insert(std::ptr::from_ref(next.node()), id);
        }
        Ok(imported.ids[&std::ptr::from_ref(formula.node())])
    }

    fn made_of(&mut self, formula: &Expr, id: impl Fn(&Expr) -> Id) -> Id {
        match formula.node() {
            Node::Number(value) => self.quantity(value, formula.kind().ok()),
            Node::Pi => self.intern(Form::Pi),
            Node::Symbol(symbol) => self.leaf(Leaf {
                name: symbol.name.to_string(),
                dimension: symbol.dimension,
                positive: false,
                definition: None,
            }),
            Node::Unary(op, a) => self.unary(*op, id(a)),
            Node::Binary(op, a, b) => self.binary(*op, id(a), id(b)),
            Node::Compare(relation, a, b) => {
                self.intern(Form::Call(Function::Compare(*relation), vec![id(a), id(b)]))
            }
            Node::Select(a, b, c) => self.select(id(a), id(b), id(c)),
            Node::Norm(parts) => {
                let parts: Vec<Id> = parts.iter().map(id).collect();
                self.norm(&parts)
            }
            Node::Table(table, a) => self.intern(Form::Call(Function::Table(table.clone()), vec![id(a)])),
            Node::System(shape, parts) => {
                let parts: Vec<Id> = parts.iter().map(id).collect();
                let (entries, right) = parts.split_at(shape.entries());
                let mut all = vec![self.zero(); shape.size() * shape.size()];
                for row in 0..shape.size() {
                    let own = shape.entries_of(row);
                    own.for_each(|(entry, column)| all[row * shape.size() + column] = entries[entry]);
                }
                all.extend_from_slice(right);
                self.intern(Form::Call(Function::System, all))
            }
            Node::Unknown(system, row) => {
                let parts = self.parts(id(system));
                self.intern(Form::Call(Function::Unknown(*row), parts))
            }
        }
    }

    /// A number with the units of its dimension, so that what is made of it has its dimension too.
    fn quantity(&mut self, value: &BigRational, kind: Option<Kind>) -> Id {
        let dimension = match kind {
            Some(Kind::Quantity(dimension)) => dimension,
            _ => Dimension::NONE,
        };
        let units: Vec<Factor> = units(dimension)
            .into_iter()
            .map(|(base, exponent)| (self.intern(Form::Unit(base)), exponent))
            .collect();
        self.raw_product(value.clone(), &units)
    }
}

/// The base units of a dimension.
pub(crate) fn units(dimension: Dimension) -> Vec<(Base, Exponent)> {
    let all =
        [(Base::Metre, dimension.length), (Base::Kilogram, dimension.mass), (Base::Second, dimension.time)];
    all.into_iter().filter(|(_, exponent)| *exponent.numer() != 0).collect()
}

impl Base {
    /// Its dimension.
    pub(crate) fn dimension(self) -> Dimension {
        match self {
            Self::Metre => Dimension::LENGTH,
            Self::Kilogram => Dimension::MASS,
            Self::Second => Dimension::TIME,
        }
    }
}

impl Function {
    /// Whether a formula of this function has a value that is a number: comparisons and systems have none.
    pub(crate) fn is_number(&self) -> bool {
        !matches!(self, Self::Compare(_) | Self::System)
    }
}
