//! From the normal form to mathematics on paper.

use std::collections::BTreeMap;

use num_traits::{One, Signed, Zero};
use tumble_expr::{Binary, Exponent, Relation, Unary};

use crate::algebra::{Algebra, Base, Factor, Form, Function, Id};
use crate::layers::Layers;
use crate::layout::{Math, Operator};
use crate::numbers;
use crate::order::{self, Class};
use crate::rational::{self, Rational};
use crate::spelling::{exponent, is_named, name, unit_text};
use crate::symbol::Identifier;

/// Turns parts into mathematics.
pub(crate) struct Printer<'a> {
    pub(crate) algebra: &'a Algebra,
    /// What each leaf shows, by its index.
    shown: Vec<Math>,
    /// The leaf by whose powers sums are ordered.
    time: Option<Id>,
    /// Which definitions are made of more than parameters.
    varying: Vec<bool>,
}

impl<'a> Printer<'a> {
    pub(crate) fn new(algebra: &'a Algebra, shown: Vec<Math>, time: Option<Id>) -> Self {
        let mut printer = Self { algebra, shown, time, varying: vec![] };
        // A definition is made of earlier ones only.
        for definition in &algebra.definitions {
            let changes = |id: &Id| match algebra.form(*id) {
                Form::Symbol(_) => printer.class(*id) > Class::Parameter,
                _ => false,
            };
            let varies = algebra.parts_first(&[definition.body]).iter().any(changes);
            printer.varying.push(varies);
        }
        printer
    }

    /// A part on its own.
    pub(crate) fn print(&self, id: Id) -> Math {
        match self.algebra.form(id) {
            Form::Sum(terms) => self.sum(terms, false),
            _ => {
                let (minus, math) = self.signed(id);
                if minus { math.negative() } else { math }
            }
        }
    }

    /// A part that is no sum without its sign, and whether that is a minus.
    fn signed(&self, id: Id) -> (bool, Math) {
        match self.algebra.form(id) {
            Form::Number(value) => (value.is_negative(), self.product(&value.abs(), &[], None)),
            Form::Product(by, factors) => self.signed_product(by, factors),
            _ => (false, self.product(&Rational::one(), &[(id, Exponent::one())], None)),
        }
    }

    /// `by * id`, without its sign.
    fn term(&self, id: Id, by: &Rational) -> (bool, Math) {
        match self.algebra.form(id) {
            Form::Number(_) => (by.is_negative(), self.product(&by.abs(), &[], None)),
            Form::Product(_, factors) => self.signed_product(by, factors),
            _ => self.signed_product(by, &[(id, Exponent::one())]),
        }
    }

    /// A minus sign goes into a difference among the factors, if there is one: b - a for -(a - b).
    fn signed_product(&self, by: &Rational, factors: &[Factor]) -> (bool, Math) {
        let flips = |(id, exponent): &Factor| rational::is_odd(exponent) && self.is_difference(*id);
        let turned = if by.is_negative() { factors.iter().position(flips) } else { None };
        (by.is_negative() && turned.is_none(), self.product(&by.abs(), factors, turned))
    }

    fn is_difference(&self, id: Id) -> bool {
        match self.algebra.form(id) {
            Form::Sum(terms) => {
                let minus = terms.iter().filter(|(_, by)| by.is_negative()).count();
                minus > 0 && minus < terms.len()
            }
            _ => false,
        }
    }

    /// Terms in order: powers of the time rise, positive terms come first.
    fn sum(&self, terms: &[(Id, Rational)], turned: bool) -> Math {
        let mut printed: Vec<(Exponent, bool, Id, Math)> = terms
            .iter()
            .map(|(id, by)| {
                let by = if turned { -by } else { by.clone() };
                let (minus, math) = self.term(*id, &by);
                let degree = self.time.map_or(Exponent::new(0, 1), |time| self.algebra.power_of(*id, time));
                (degree, minus, *id, math)
            })
            .collect();
        printed.sort_by_key(|(degree, minus, id, _)| (*degree, *minus, *id));
        if let Some(first) = printed.iter().position(|(_, minus, ..)| !minus) {
            let positive = printed.remove(first);
            printed.insert(0, positive);
        }
        Math::Row(Math::terms(printed.into_iter().map(|(_, minus, _, math)| (minus, math))))
    }

    /// A positive number times powers; the sum at place `turned` is printed with its sign turned.
    fn product(&self, by: &Rational, factors: &[Factor], turned: Option<usize>) -> Math {
        if let Some((by, inside)) = self.under_one_root(by, factors) {
            return Math::Root(Box::new(self.product(&by, &inside, None)));
        }
        let mut layers = Layers { digits_below: true, ..Layers::default() };
        self.number_into(&mut layers, by, factors);
        let mut ordered: Vec<(usize, &Factor)> =
            factors.iter().enumerate().filter(|(_, (id, _))| self.unit(*id).is_none()).collect();
        ordered.sort_by_key(|(_, factor)| self.key(factor));
        let alone = factors.len() == 1 && by.is_one();
        // Where a sum follows, `sin x (a + b)` could be read as the sine of all of it.
        let is_sum = |(_, factor): &(usize, &Factor)| self.class(factor.0) == Class::Sum;
        let has_sum = ordered.iter().any(is_sum);
        let roots = self.common_root(factors);
        for (place, (id, exponent)) in ordered {
            if !roots.is_empty() && is_square_root(exponent) {
                continue;
            }
            let class = self.class(*id);
            let power = exponent.abs();
            let context = Context { turned: turned == Some(place), bare: !has_sum, alone, power };
            let math = self.raised(*id, &context);
            if exponent.is_negative() {
                layers.below.push(math);
                layers.digits_below = false;
            } else if class <= Class::Time {
                layers.above.push(math);
            } else {
                layers.long |= class >= Class::Function;
                layers.behind.push(math);
            }
        }
        if !roots.is_empty() {
            layers.long = true;
            let (by, roots) = self.numbers_of(&roots);
            layers.behind.push(Math::Root(Box::new(self.product(&by, &roots, None))));
        }
        layers.joined()
    }

    /// The product of the numbers among factors, and the others; a product that was under a root of its own is its factors.
    fn numbers_of(&self, factors: &[Factor]) -> (Rational, Vec<Factor>) {
        let (mut by, mut others) = (Rational::one(), BTreeMap::new());
        for (id, exponent) in factors {
            let own = match self.algebra.form(*id) {
                Form::Number(value) if exponent.is_one() => {
                    by *= value.clone();
                    continue;
                }
                Form::Product(own, inside) if exponent.is_one() && own.is_positive() => {
                    by *= own.clone();
                    inside.clone()
                }
                _ => vec![(*id, *exponent)],
            };
            own.into_iter().for_each(|(id, power)| *others.entry(id).or_insert_with(Exponent::zero) += power);
        }
        (by, others.into_iter().collect())
    }

    /// What is under the root of `√((10/7) x)`, as which `(1/7) √(70 x)` is read: a fraction that is before a root because its
    /// denominator is no square.
    fn under_one_root(&self, by: &Rational, factors: &[Factor]) -> Option<(Rational, Vec<Factor>)> {
        if !by.numer().is_one() || by.denom().is_one() || !factors.iter().all(|(_, own)| is_square_root(own))
        {
            return None;
        }
        let inside: Vec<Factor> = factors.iter().map(|(id, own)| (*id, own + own)).collect();
        let (number, inside) = self.numbers_of(&inside);
        let whole = &number * by;
        (whole.is_integer() && !inside.is_empty()).then(|| (whole * by, inside))
    }

    /// What stands under one root sign where several square roots are multiplied; nothing where there is at most one.
    fn common_root(&self, factors: &[Factor]) -> Vec<Factor> {
        let roots = factors.iter().filter(|(_, exponent)| is_square_root(exponent));
        let inside: Vec<Factor> = roots.map(|(id, exponent)| (*id, exponent + exponent)).collect();
        let several = inside.len() > 1 && inside.iter().any(|(_, exponent)| exponent.is_positive());
        if several { inside } else { vec![] }
    }

    /// The number in front, with units if it is a written quantity.
    fn number_into(&self, layers: &mut Layers, by: &Rational, factors: &[Factor]) {
        let units: Vec<(Base, Exponent)> =
            factors.iter().filter_map(|(id, exponent)| Some((self.unit(*id)?, *exponent))).collect();
        if !units.is_empty() {
            let quantity = Math::Product(vec![numbers::decimal(by), Math::Text(unit_text(&units))]);
            // Where more follows, the unit could be read as a part of it.
            let is_alone = units.len() == factors.len();
            layers.above.push(if is_alone { quantity } else { quantity.bracketed() });
            return;
        }
        let shape = numbers::shape(by);
        layers.numerator = shape.above.is_some();
        layers.above.extend(shape.above);
        layers.below.extend(shape.below);
    }

    fn unit(&self, id: Id) -> Option<Base> {
        match self.algebra.form(id) {
            Form::Unit(base) => Some(*base),
            _ => None,
        }
    }

    fn key(&self, (id, _): &Factor) -> (Class, u8, (String, String), Id) {
        let (rank, name) = match self.algebra.form(*id) {
            Form::Symbol(index) => {
                let leaf = &self.algebra.symbols[*index];
                let own = leaf.definition.and_then(|index| self.algebra.definitions[index].name.as_ref());
                (order::rank(leaf.dimension), order::alphabetical(own.unwrap_or(&leaf.name)))
            }
            _ => (0, Default::default()),
        };
        (self.class(*id), rank, name, *id)
    }

    fn class(&self, id: Id) -> Class {
        match self.algebra.form(id) {
            Form::Number(_) | Form::Pi | Form::Unit(_) => Class::Constant,
            Form::Symbol(index) => self.class_of_leaf(*index, id),
            Form::Call(Function::Unary(Unary::Abs), _) => Class::Bars,
            Form::Call(..) => Class::Function,
            Form::Sum(_) | Form::Product(..) => Class::Sum,
        }
    }

    fn class_of_leaf(&self, index: usize, id: Id) -> Class {
        let leaf = &self.algebra.symbols[index];
        match &self.shown[index] {
            _ if self.time == Some(id) => Class::Time,
            Math::Bars(_) => Class::Bars,
            // The state of a body, such as `rod.omega`.
            _ if leaf.name.contains('.') => Class::Variable,
            _ if leaf.definition.is_some_and(|index| self.varying.get(index) == Some(&true)) => {
                Class::Variable
            }
            _ => Class::Parameter,
        }
    }

    /// A base with its exponent, which is positive here.
    fn raised(&self, id: Id, context: &Context) -> Math {
        let (numerator, denominator) = (*context.power.numer(), *context.power.denom());
        match (numerator, denominator) {
            (1, 1) => self.base(id, context),
            (1, 2) => Math::Root(Box::new(self.inside(id, context.turned))),
            _ => {
                let exponent = exponent(numerator, denominator);
                match self.algebra.form(id) {
                    Form::Call(function, parts) if is_named(function) => {
                        self.call(function, parts, Some(exponent), context)
                    }
                    Form::Call(function, _) if !matches!(function, Function::Unary(Unary::Abs)) => {
                        self.base(id, context).bracketed().raised_to(exponent)
                    }
                    Form::Product(..) => self.inside(id, false).bracketed().raised_to(exponent),
                    _ => self.base(id, context).raised_to(exponent),
                }
            }
        }
    }

    /// A part as a factor.
    fn base(&self, id: Id, context: &Context) -> Math {
        match self.algebra.form(id) {
            Form::Number(value) if value.is_negative() => self.print(id).bracketed(),
            Form::Number(value) => numbers::decimal(value),
            Form::Pi => Math::symbol("pi"),
            Form::Unit(base) => Math::Text(unit_text(&[(*base, Exponent::one())])),
            Form::Symbol(index) => self.shown[*index].clone(),
            Form::Sum(_) | Form::Product(..) => self.inside(id, context.turned).bracketed(),
            Form::Call(function, parts) => self.call(function, parts, None, context),
        }
    }

    /// A part where nothing else is.
    fn inside(&self, id: Id, turned: bool) -> Math {
        match self.algebra.form(id) {
            Form::Sum(terms) => self.sum(terms, turned),
            _ => self.print(id),
        }
    }

    fn call(&self, function: &Function, parts: &[Id], power: Option<Math>, context: &Context) -> Math {
        match function {
            Function::Unary(Unary::Abs) => Math::Bars(Box::new(self.print(parts[0]))),
            Function::Unary(Unary::Exp) => {
                Math::Identifier(Identifier::upright("e")).raised_to(self.print(parts[0]))
            }
            Function::Norm => self.norm(parts),
            Function::Binary(Binary::Pow) => self.general_power(parts),
            Function::Binary(Binary::Div) => self.print(parts[0]).over(self.print(parts[1])),
            Function::Binary(Binary::SquareOver) => {
                let square = self.atom(parts[0]).raised_to(Math::digits(2));
                square.over(self.print(parts[1]))
            }
            Function::Compare(relation) => {
                let sign = match relation {
                    Relation::Less => Operator::Less,
                    Relation::LessEqual => Operator::LessEqual,
                };
                Math::Row(vec![self.print(parts[0]), Math::Operator(sign), self.print(parts[1])])
            }
            Function::Select => Math::Cases(vec![
                (self.print(parts[1]), Some(self.print(parts[0]))),
                (self.print(parts[2]), None),
            ])
            .bracketed_unless(context.alone),
            Function::Unknown(row) => self.unknown(*row, parts),
            _ => self.named_call(function, parts, power, context.bare),
        }
    }

    fn named_call(&self, function: &Function, parts: &[Id], power: Option<Math>, bare: bool) -> Math {
        let short = matches!(function, Function::Unary(op) if *op != Unary::Sign && *op != Unary::Step)
            && matches!(self.algebra.form(parts[0]), Form::Pi | Form::Symbol(_));
        Math::Call {
            function: name(function),
            power: power.map(Box::new),
            arguments: parts.iter().map(|id| self.print(*id)).collect(),
            bare: bare && short,
        }
    }

    /// The length of a vector by its components.
    fn norm(&self, parts: &[Id]) -> Math {
        let squares = parts.iter().map(|id| (false, self.square(*id)));
        Math::Root(Box::new(Math::Row(Math::terms(squares))))
    }

    /// A square; the sign and the brackets of a single symbol are not needed.
    fn square(&self, id: Id) -> Math {
        let two = Exponent::from_integer(2);
        match self.algebra.form(id) {
            Form::Product(by, factors) => {
                let squares: Vec<Factor> = factors.iter().map(|(id, own)| (*id, own * two)).collect();
                self.product(&(by * by), &squares, None)
            }
            Form::Number(value) => self.product(&(value * value), &[], None),
            _ => self.product(&Rational::one(), &[(id, two)], None),
        }
    }

    /// A component of the inverse matrix times the right sides.
    fn unknown(&self, row: u32, entries: &[Id]) -> Math {
        let n = entries.len().isqrt();
        let (matrix, right) = entries.split_at(n * n);
        let rows = |entries: &[Id], width: usize| -> Math {
            let row = |row: &[Id]| row.iter().map(|id| self.print(*id)).collect();
            Math::Matrix(entries.chunks(width.max(1)).map(row).collect())
        };
        let inverse = rows(matrix, n).raised_to(numbers::signed(-1));
        Math::Component(Box::new(Math::Product(vec![inverse, rows(right, 1)])), row + 1)
    }

    fn general_power(&self, parts: &[Id]) -> Math {
        self.atom(parts[0]).raised_to(self.print(parts[1]))
    }

    /// A part as the base of a power.
    fn atom(&self, id: Id) -> Math {
        match self.algebra.form(id) {
            Form::Symbol(_) | Form::Pi => self.print(id),
            Form::Number(value) if value.is_integer() && !value.is_negative() => self.print(id),
            _ => self.print(id).bracketed(),
        }
    }
}

/// How a factor stands among others.
struct Context {
    /// With its sign turned.
    turned: bool,
    /// Functions of a letter need no brackets.
    bare: bool,
    /// There are no others.
    alone: bool,
    power: Exponent,
}

impl Math {
    fn bracketed_unless(self, bare: bool) -> Self {
        if bare { self } else { self.bracketed() }
    }
}

fn is_square_root(exponent: &Exponent) -> bool {
    exponent.abs() == Exponent::new(1, 2)
}
