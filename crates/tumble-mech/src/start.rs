//! What a body starts from.

use tumble_expr::{Expr, Vector};

/// Initial values of one body, as formulas of the parameters.
#[derive(Clone, Debug, Default)]
pub struct Start {
    /// Position of the centre of mass, m; not for a pivoted body, whose pivot says where it is.
    pub at: Option<Vector>,
    /// Velocity of the centre of mass, m/s; zero where not given; not for a pivoted body.
    pub velocity: Option<Vector>,
    /// rad; zero where not given
    pub angle: Option<Expr>,
    /// rad/s; zero where not given
    pub omega: Option<Expr>,
}

impl Start {
    /// Turned by that angle, rad.
    #[must_use]
    pub fn angle(mut self, angle: Expr) -> Self {
        self.angle = Some(angle);
        self
    }

    /// Turning at that rate, rad/s.
    #[must_use]
    pub fn omega(mut self, omega: Expr) -> Self {
        self.omega = Some(omega);
        self
    }

    /// With the centre of mass at that place, m.
    #[must_use]
    pub fn at(mut self, [x, y]: [Expr; 2]) -> Self {
        self.at = Some(Vector::planar(x, y));
        self
    }

    /// With the centre of mass moving at that velocity, m/s.
    #[must_use]
    pub fn velocity(mut self, [x, y]: [Expr; 2]) -> Self {
        self.velocity = Some(Vector::planar(x, y));
        self
    }
}
