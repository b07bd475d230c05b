//! # Law
//! Energy of the motion of a rigid body: `T = M v^2/2 + I omega^2/2`.
//! # Symbols and units
//! M mass (kg), v velocity of the centre of mass (m/s), I moment of inertia about it (kg m^2), omega (rad/s), T (J).
//! # Sign and frame
//! World axes; T is not negative.
//! # Validity
//! Motion in a plane of symmetry.
//! # Source
//! König's theorem.
//! # Checked by
//! Tests below: energy does not change in free flight; a body that turns about its end has I about that end.

use tumble_expr::Expr;

use crate::body::Body;

impl Body {
    /// Energy of the motion of the centre of mass and of the turning about it, J.
    pub fn kinetic_energy(&self) -> Expr {
        let (motion, mass) = (self.kinematics(), self.mass_properties());
        let (v, omega) = (motion.velocity(), motion.omega());
        let speed_squared = v.x() * v.x() + v.y() * v.y();
        (mass.mass * speed_squared + mass.inertia * (&omega * &omega)) / 2
    }
}

#[cfg(test)]
mod tests {
    use tumble_expr::units::{KG, M, S};

    use super::*;
    use crate::{Gravity, Model, Start};

    #[test]
    fn a_thrown_rod_keeps_its_energy() {
        let mut model = Model::new();
        model.gravity = Gravity::Vertical(9.81 * M / (S * S));
        let rod = model.add(Body::rod("rod", [0 * M, 0 * M], [1 * M, 0 * M]).mass(0.5 * KG));
        let start = Start::default().at([0 * M, 1 * M]).velocity([8 * M / S, 6 * M / S]).omega(6 / S);
        let run = model.simulate(&[(&rod, start)], 1.2 * S).expect("a motion");
        let energy = rod.kinetic_energy() + rod.potential_energy(&model.gravity);
        let at = |time| run.at(time).expect("in the run").value(energy.clone()).expect("a value");
        let first = 0.5 * (64.0 + 36.0) / 2.0 + 0.5 / 12.0 * 36.0 / 2.0 + 0.5 * 9.81;
        assert!((at(0.0) - first).abs() < 1e-13 && (at(1.2) - first).abs() < 1e-12);
    }

    #[test]
    fn about_a_fixed_end() {
        let mut model = Model::new();
        let rod = model.add(Body::rod("rod", [0 * M, 0 * M], [2 * M, 0 * M]).mass(3 * KG));
        model.pivot(&rod, [0 * M, 0 * M]);
        let run = model.simulate(&[(&rod, Start::default().omega(5 / S))], 1 * S).expect("a motion");
        let found = run.at(0.5).and_then(|at| at.value(rod.kinetic_energy())).expect("a value");
        assert!((found - 3.0 * 4.0 / 3.0 * 25.0 / 2.0).abs() < 1e-12);
        assert!(rod.potential_energy(&model.gravity).is_zero());
    }
}
