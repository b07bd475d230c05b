//! Which unit a formula states, for places where an angle must say that it is one.

use num_traits::Zero;

use super::Formula;
use super::error::{Code, FormulaError};
use super::quantity::tags;
use super::syntax::{BinaryOperator, Syntax};
use super::units::UnitTag;

/// The unit a formula states.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum StatedUnit {
    /// A bare zero, which has every unit.
    Zero,
    /// Only numbers without units, such as `35` or `1/2`.
    Bare,
    /// A quantity with an angle in its unit, such as `35 deg` or `20 rpm`.
    Angle,
    /// A frequency, such as `2 Hz`.
    Frequency,
    /// A quantity with another unit.
    Other,
    /// A formula in which names, functions or several units stand for the unit.
    Formula,
}

pub(super) fn stated_unit(formula: &Formula) -> StatedUnit {
    let nodes = &formula.tree().nodes;
    let is_bare = |syntax: &Syntax| match syntax {
        Syntax::Quantity { chain, .. } => chain.is_none(),
        Syntax::Sign { .. } => true,
        Syntax::Infix(operator, ..) => !operator.compares() && *operator != BinaryOperator::Power,
        _ => false,
    };
    let mut unsigned = nodes.iter().map(|node| &node.syntax).filter(|s| !matches!(s, Syntax::Sign { .. }));
    match (unsigned.next(), unsigned.next()) {
        (Some(Syntax::Quantity { value, chain: None, .. }), None) if value.is_zero() => StatedUnit::Zero,
        (Some(Syntax::Quantity { chain: Some(chain), .. }), None) => of_tags(&tags(formula.text(), chain)),
        _ if nodes.iter().all(|node| is_bare(&node.syntax)) => StatedUnit::Bare,
        _ => StatedUnit::Formula,
    }
}

fn of_tags(tags: &[UnitTag]) -> StatedUnit {
    if tags.contains(&UnitTag::Angle) {
        StatedUnit::Angle
    } else if tags.contains(&UnitTag::Frequency) {
        StatedUnit::Frequency
    } else {
        StatedUnit::Other
    }
}

/// The mistake of an angle, or an angle per time, that does not say in which unit it is.
pub(super) fn demand_angle(formula: &Formula) -> Result<(), FormulaError> {
    let text = formula.text();
    let written = text.trim();
    let span = text.len() - text.trim_start().len()..text.trim_end().len();
    match stated_unit(formula) {
        StatedUnit::Zero | StatedUnit::Angle | StatedUnit::Formula => Ok(()),
        StatedUnit::Bare => {
            Err(FormulaError::new(Code::AngleUnit, span, "this angle does not state its unit")
                .label("radians, degrees or revolutions?")
                .help(format!("write `{written} deg` or `{written} rad`, per time `{written} rad/s`")))
        }
        StatedUnit::Frequency => {
            let turns = written.replace("Hz", "rev/s");
            Err(FormulaError::new(Code::Hertz, span, "a frequency in hertz is no angular velocity")
                .label("cycles per second, not an angle per second")
                .help(format!("write `{turns}` for so many revolutions per second, or rad/s")))
        }
        StatedUnit::Other => {
            Err(FormulaError::new(Code::AngleUnit, span, "this unit is not one of an angle")
                .label("expected rad, mrad, deg, rev or rpm in the unit")
                .help("write `35 deg`, `2 rad/s` or `20 rpm`"))
        }
    }
}
