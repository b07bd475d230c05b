//! The numbers of an island's contacts along their surfaces at an instant.

use nalgebra::{DMatrix, DVector};
use tumble_expr::{Expr, Symbol};

use crate::contact::pair::Pair;
use crate::equations::Definitions;

/// While a contact slips, friction may take this part of what a push at it would move, and no more: where it comes to take all, no
/// force holds the body up. Closer to that the force has grown a million times.
pub(crate) const WEDGED: f64 = 1e-6;

/// Outputs before a row of the Jacobian: rate, acceleration, both coefficients.
const BEFORE_ROW: usize = 4;

/// Contacts with friction, by their order among an island's own.
pub(crate) struct Slips {
    /// Position of each among the island's pairs.
    pub(crate) of: Vec<usize>,
    /// m/s
    pub(crate) rate: DVector<f64>,
    /// Rounding in a rate is relative to this, m/s.
    pub(crate) speed: DVector<f64>,
    /// Accelerations without lasting contacts of the island, m/s^2.
    pub(crate) free: DVector<f64>,
    /// Static and kinetic coefficient.
    pub(crate) friction: Vec<[f64; 2]>,
}

impl Slips {
    /// Those of these positions, from their outputs one after the other, and the rows of the Jacobian.
    pub(crate) fn read(of: &[usize], dofs: usize, value: impl Fn(usize) -> f64) -> (Self, DMatrix<f64>) {
        let own = |slip: usize, which: usize| value(slip * (BEFORE_ROW + dofs) + which);
        let column = |which: usize| DVector::from_fn(of.len(), |slip, _| own(slip, which));
        let slips = Self {
            of: of.to_vec(),
            rate: column(0),
            speed: column(0),
            free: column(1),
            friction: (0..of.len()).map(|slip| [own(slip, 2), own(slip, 3)]).collect(),
        };
        (slips, DMatrix::from_fn(of.len(), dofs, |slip, dof| own(slip, BEFORE_ROW + dof)))
    }

    /// Index of a position among them.
    pub(crate) fn at(&self, position: usize) -> Option<usize> {
        self.of.iter().position(|known| *known == position)
    }
}

impl Pair {
    /// What [`Slips::read`] reads of a pair with friction.
    pub(super) fn slip_outputs(&self, definitions: &Definitions, velocities: &[Symbol]) -> Vec<Expr> {
        let rate = definitions.apply(&self.slip_rate());
        let coefficients = self.friction.iter().flat_map(|friction| [&friction.of_rest, &friction.kinetic]);
        let coefficients = coefficients.map(|coefficient| definitions.apply(coefficient));
        let slopes = velocities.iter().map(|velocity| rate.derivative(velocity));
        let acceleration = definitions.apply(&self.slip_acceleration());
        [rate.clone(), acceleration].into_iter().chain(coefficients).chain(slopes).collect()
    }
}
