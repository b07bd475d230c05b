//! What there is at one instant: energies, momenta and angular momenta.

use tumble_expr::{Branches, Expr, Jets, Vector};
use tumble_ode::Reason;

use crate::equations::Equations;
use crate::mode::Mode;
use crate::potential::Potential;

/// The motion of one body.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Motion {
    /// J
    pub(super) kinetic: f64,
    /// N s
    pub(super) momentum: [f64; 2],
    /// About the balance's point, N m s.
    pub(super) angular: f64,
    /// About the centre of mass, N m s.
    pub(super) spin: f64,
    /// m/s
    pub(super) velocity: [f64; 2],
    /// rad/s
    pub(super) omega: f64,
    /// From the balance's point to the centre of mass, m.
    pub(super) place: [f64; 2],
}

/// All bodies and all potential energies, J, at one instant.
#[derive(Clone, Debug)]
pub(super) struct Stored {
    /// In the order of the run's bodies.
    pub(super) bodies: Vec<Motion>,
    pub(super) potentials: Vec<f64>,
}

impl Stored {
    pub(super) fn kinetic(&self) -> f64 {
        self.bodies.iter().map(|body| body.kinetic).sum()
    }

    pub(super) fn potential(&self) -> f64 {
        self.potentials.iter().sum()
    }

    pub(super) fn momentum(&self, axis: usize) -> f64 {
        self.bodies.iter().map(|body| body.momentum[axis]).sum()
    }

    pub(super) fn angular(&self) -> f64 {
        self.bodies.iter().map(|body| body.angular).sum()
    }

    /// What the energy is a sum of, without signs.
    pub(super) fn size(&self) -> f64 {
        self.kinetic() + self.potentials.iter().map(|energy| energy.abs()).sum::<f64>()
    }
}

/// Evaluates what is stored in one mode.
pub(super) struct StoredEvaluator {
    jets: Jets<f64>,
    bodies: usize,
}

/// Outputs a body: velocity, angular rate, place, mass, moment of inertia.
const OUTPUTS: usize = 7;

impl StoredEvaluator {
    pub(super) fn new(
        equations: &Equations,
        potentials: &[Potential],
        mode: &Mode,
        inputs: &[f64],
        about: &Vector,
    ) -> Result<Self, Reason> {
        let mut outputs: Vec<Expr> = vec![];
        for &index in &mode.bodies {
            let motion = equations.model().bodies[index].kinematics();
            let mass = equations.mass_properties(index);
            outputs.extend_from_slice(motion.velocity().components());
            outputs.push(motion.omega());
            outputs.extend_from_slice((motion.position() - about).components());
            outputs.extend([mass.mass.clone(), mass.inertia.clone()]);
        }
        let energy = |known: &Potential| if known.is_in(mode) { known.energy.clone() } else { Expr::zero() };
        outputs.extend(potentials.iter().map(energy));
        let bodies = mode.bodies.len();
        Ok(Self { jets: equations.evaluator(mode, &outputs, inputs)?, bodies })
    }

    pub(super) fn take(&mut self, time: f64, states: &[f64]) -> Stored {
        self.jets.start(time, states, Branches::Free);
        let outputs = self.jets.tape().outputs().len();
        let first = self.bodies * OUTPUTS;
        Stored {
            bodies: (0..self.bodies).map(|body| self.motion(body)).collect(),
            potentials: (first..outputs).map(|index| self.jets.value_of(index)).collect(),
        }
    }

    fn motion(&self, body: usize) -> Motion {
        let [vx, vy, omega, x, y, mass, inertia] =
            std::array::from_fn(|which| self.jets.value_of(body * OUTPUTS + which));
        let spin = inertia * omega;
        Motion {
            kinetic: 0.5 * (mass * (vx * vx + vy * vy) + spin * omega),
            momentum: [mass * vx, mass * vy],
            angular: mass * (x * vy - y * vx) + spin,
            spin,
            velocity: [vx, vy],
            omega,
            place: [x, y],
        }
    }
}
