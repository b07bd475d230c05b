//! Physical dimensions with rational exponents.

use std::fmt;

use num_rational::Ratio;

/// A rational exponent of a base dimension.
pub type Exponent = Ratio<i32>;

/// A product of powers of length, mass and time.
///
/// Angles are dimensionless: the radian is one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Dimension {
    /// Exponent of the metre.
    pub length: Exponent,
    /// Exponent of the kilogram.
    pub mass: Exponent,
    /// Exponent of the second.
    pub time: Exponent,
}

impl Dimension {
    /// A pure number, angles included.
    pub const NONE: Self = Self::new(0, 0, 0);
    /// m
    pub const LENGTH: Self = Self::new(1, 0, 0);
    /// kg
    pub const MASS: Self = Self::new(0, 1, 0);
    /// s
    pub const TIME: Self = Self::new(0, 0, 1);
    /// m/s
    pub const SPEED: Self = Self::new(1, 0, -1);
    /// m/s^2
    pub const ACCELERATION: Self = Self::new(1, 0, -2);
    /// rad/s
    pub const ANGULAR_RATE: Self = Self::new(0, 0, -1);
    /// rad/s^2
    pub const ANGULAR_ACCELERATION: Self = Self::new(0, 0, -2);
    /// N
    pub const FORCE: Self = Self::new(1, 1, -2);
    /// N m, and J
    pub const TORQUE: Self = Self::new(2, 1, -2);
    /// kg m^2
    pub const INERTIA: Self = Self::new(2, 1, 0);
    /// kg m/s, and N s
    pub const MOMENTUM: Self = Self::new(1, 1, -1);

    /// The dimension m^`length` kg^`mass` s^`time`.
    pub const fn new(length: i32, mass: i32, time: i32) -> Self {
        Self {
            length: Ratio::new_raw(length, 1),
            mass: Ratio::new_raw(mass, 1),
            time: Ratio::new_raw(time, 1),
        }
    }

    /// Dimension of a product, or `None` where an exponent overflows.
    pub fn times(self, other: Self) -> Option<Self> {
        self.combine(other, num_traits::CheckedAdd::checked_add)
    }

    /// Dimension of a quotient, or `None` where an exponent overflows.
    pub fn over(self, other: Self) -> Option<Self> {
        self.combine(other, num_traits::CheckedSub::checked_sub)
    }

    /// Dimension of a power, or `None` where an exponent overflows.
    pub fn power(self, exponent: Exponent) -> Option<Self> {
        let scaled = Self { length: exponent, mass: exponent, time: exponent };
        self.combine(scaled, num_traits::CheckedMul::checked_mul)
    }

    fn combine(self, other: Self, op: fn(&Exponent, &Exponent) -> Option<Exponent>) -> Option<Self> {
        Some(Self {
            length: op(&self.length, &other.length)?,
            mass: op(&self.mass, &other.mass)?,
            time: op(&self.time, &other.time)?,
        })
    }

    /// The everyday name with its article ("a length"), where there is one.
    pub fn name(self) -> Option<&'static str> {
        NAMES.iter().find(|(dimension, _)| *dimension == self).map(|(_, name)| *name)
    }

    /// How a diagnostic speaks of it: "a force (kg*m/s^2)", or the bare units where it has no name.
    pub fn describe(self) -> String {
        match self.name() {
            Some(name) if self == Self::NONE => name.to_owned(),
            Some(name) => format!("{name} ({self})"),
            None => format!("a quantity in {self}"),
        }
    }
}

const NAMES: &[(Dimension, &str)] = &[
    (Dimension::NONE, "a pure number"),
    (Dimension::LENGTH, "a length"),
    (Dimension::new(2, 0, 0), "an area"),
    (Dimension::new(3, 0, 0), "a volume"),
    (Dimension::MASS, "a mass"),
    (Dimension::TIME, "a time"),
    (Dimension::SPEED, "a speed"),
    (Dimension::ACCELERATION, "an acceleration"),
    (Dimension::ANGULAR_RATE, "an angular rate"),
    (Dimension::ANGULAR_ACCELERATION, "an angular acceleration"),
    (Dimension::FORCE, "a force"),
    (Dimension::TORQUE, "a torque or energy"),
    (Dimension::new(2, 1, -3), "a power"),
    (Dimension::new(-1, 1, -2), "a pressure"),
    (Dimension::INERTIA, "a moment of inertia"),
    (Dimension::MOMENTUM, "a momentum"),
    (Dimension::new(2, 1, -1), "an angular momentum"),
    (Dimension::new(0, 1, -2), "a stiffness"),
    (Dimension::new(0, 1, -1), "a damping"),
    (Dimension::new(-1, 1, 0), "a mass per length"),
    (Dimension::new(-3, 1, 0), "a density"),
];

/// Units in the usual order, as formulas are written with them, such as `kg*m/s^2` or `m^(1/2)`; `1` for a pure number.
impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let bases = [(self.mass, "kg"), (self.length, "m"), (self.time, "s")];
        let zero = Exponent::from_integer(0);
        let above: Vec<_> = bases.iter().filter(|(e, _)| *e > zero).map(|(e, u)| factor(*e, u)).collect();
        let below: Vec<_> = bases.iter().filter(|(e, _)| *e < zero).map(|(e, u)| factor(-*e, u)).collect();
        let numerator = if above.is_empty() { "1".to_owned() } else { above.join("*") };
        match below.len() {
            0 => write!(f, "{numerator}"),
            1 => write!(f, "{numerator}/{}", below[0]),
            _ => write!(f, "{numerator}/({})", below.join("*")),
        }
    }
}

fn factor(exponent: Exponent, unit: &str) -> String {
    if exponent == Exponent::from_integer(1) {
        unit.to_owned()
    } else if exponent.is_integer() {
        format!("{unit}^{exponent}")
    } else {
        format!("{unit}^({exponent})")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prints_in_the_usual_order() {
        assert_eq!(Dimension::FORCE.to_string(), "kg*m/s^2");
        assert_eq!(Dimension::NONE.to_string(), "1");
        assert_eq!(Dimension::ANGULAR_RATE.to_string(), "1/s");
        assert_eq!(Dimension::new(-1, 1, -2).to_string(), "kg/(m*s^2)");
        let half = Dimension::LENGTH.power(Exponent::new(1, 2)).expect("small exponent");
        assert_eq!(half.to_string(), "m^(1/2)");
    }

    #[test]
    fn overflowing_exponents_are_refused() {
        let huge = Dimension::LENGTH.power(Exponent::from_integer(i32::MAX)).expect("fits");
        assert_eq!(huge.times(Dimension::LENGTH), None);
    }
}
