//! Names of functions, exponents and units as they are printed.

use std::collections::{BTreeMap, HashMap};

use tumble_expr::{Binary, Dimension, Exponent, Unary};

use crate::algebra::{Algebra, Base, Function};
use crate::layout::{Math, Operator};
use crate::symbol::Identifier;

/// Whether a function is printed as a name with arguments, so that its power can stand at the name.
pub(crate) fn is_named(function: &Function) -> bool {
    match function {
        Function::Unary(op) => !matches!(op, Unary::Abs | Unary::Exp),
        Function::Binary(op) => matches!(op, Binary::Atan2 | Binary::Min | Binary::Max),
        Function::Table(_) => true,
        _ => false,
    }
}

pub(crate) fn name(function: &Function) -> Identifier {
    let known = match function {
        Function::Table(table) => return Identifier::parse(&table.0.name),
        Function::Unary(op) => match op {
            Unary::Sin => "sin",
            Unary::Cos => "cos",
            Unary::Tan => "tan",
            Unary::Asin => "arcsin",
            Unary::Acos => "arccos",
            Unary::Atan => "arctan",
            Unary::Sinh => "sinh",
            Unary::Cosh => "cosh",
            Unary::Tanh => "tanh",
            Unary::Exp => "exp",
            Unary::Log => "ln",
            Unary::Sign => "sgn",
            Unary::Step => "step",
            Unary::Abs | Unary::Neg | Unary::Sqrt => "",
        },
        Function::Binary(op) => match op {
            Binary::Atan2 => "atan2",
            Binary::Min => "min",
            Binary::Max => "max",
            _ => "",
        },
        Function::Compare(_)
        | Function::Select
        | Function::Norm
        | Function::System
        | Function::Unknown(_) => "",
    };
    Identifier::upright(known)
}

/// An exponent other than 1, positive.
pub(crate) fn exponent(numerator: i32, denominator: i32) -> Math {
    if denominator == 1 {
        return Math::digits(numerator);
    }
    Math::Row(vec![Math::digits(numerator), Math::Operator(Operator::Over), Math::digits(denominator)])
}

/// Units as words, such as `kg·m²/s²`.
pub(crate) fn unit_text(units: &[(Base, Exponent)]) -> String {
    let mut dimension = Dimension::NONE;
    for (base, exponent) in units {
        match base {
            Base::Metre => dimension.length = *exponent,
            Base::Kilogram => dimension.mass = *exponent,
            Base::Second => dimension.time = *exponent,
        }
    }
    dimension.to_string().replace('*', "·").replace("^2", "²").replace("^3", "³")
}

/// What leaves show, by their index.
pub(crate) fn shown_leaves(
    algebra: &Algebra,
    names: &BTreeMap<String, String>,
    automatic: &HashMap<usize, String>,
) -> Vec<Math> {
    let show = |leaf: &crate::algebra::Leaf| match leaf.definition {
        Some(index) => {
            let own = algebra.definitions[index].name.as_ref().or_else(|| automatic.get(&index));
            Math::symbol(own.map_or("u", String::as_str))
        }
        None => Math::symbol(names.get(&leaf.name).unwrap_or(&leaf.name)),
    };
    algebra.symbols.iter().map(show).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_in_equations_are_written_as_in_tables() {
        let units = [(Base::Kilogram, Exponent::from(1)), (Base::Metre, Exponent::from(2))];
        assert_eq!(unit_text(&units), "kg·m²");
        assert_eq!(
            unit_text(&[(Base::Metre, Exponent::from(1)), (Base::Second, Exponent::from(-2))]),
            "m/s²"
        );
    }
}
