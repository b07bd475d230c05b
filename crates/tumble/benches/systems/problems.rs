//! The systems: as models, as plain right-hand sides for the peer, and their references at 34 digits.

use std::ops::ControlFlow;

use tumble::prelude::*;
use tumble_mech::{Component, ContactLaw, Drag, DragPlace, Equations, Release, Surface, Trust};
use tumble_ode::{Solver, Start as NumericStart};

/// A system with its answer.
pub(crate) struct Problem {
    pub(crate) name: &'static str,
    model: Model,
    until: f64,
    /// States at the end, in the model's order.
    reference: Vec<f64>,
    /// What the peer comes to, where it is given another system.
    peer_reference: Option<Vec<f64>>,
    /// What the peer starts from, and its rates.
    pub(crate) start: [f64; 6],
    pub(crate) rates: fn(&[f64; 6]) -> [f64; 6],
    /// States of the peer in the model's order.
    pub(crate) order: &'static [usize],
}

impl Problem {
    pub(crate) fn run(&self, accuracy: f64) -> Run {
        let accuracy = Accuracy::new(accuracy).expect("allowed");
        Run::new(
            self.equations(),
            &self.model.parameters,
            self.until,
            accuracy,
            |_| ControlFlow::Continue(()),
        )
        .expect("smooth")
    }

    /// States at the end of the motion alone, from equations that are built, with the enclosures of every step or without: what
    /// they cost.
    pub(crate) fn states(&self, equations: &Equations, accuracy: f64, is_proved: bool) -> Vec<f64> {
        let start = equations.start(&self.model.parameters).expect("sound");
        let accuracy = Accuracy::new(accuracy).expect("allowed");
        let mut solver = Solver::new(equations, NumericStart { is_proved, ..start }, self.until, accuracy);
        while !solver.is_done() {
            solver.advance().expect("smooth");
        }
        solver.finish().last_states().expect("ran")
    }

    pub(crate) fn equations(&self) -> Equations {
        Equations::new(self.model.clone()).expect("sound")
    }

    /// The whole answer: the motion with its check runs.
    pub(crate) fn trusted(&self, accuracy: f64) -> (Run, Trust) {
        let accuracy = Accuracy::new(accuracy).expect("allowed");
        Run::trusted(&self.model, &self.model.parameters, self.until, accuracy, |_| ControlFlow::Continue(()))
            .expect("smooth")
    }

    pub(crate) fn error(&self, run: &Run) -> f64 {
        distance(&run.trajectory.last_states().expect("ran"), &self.reference)
    }

    /// Error of the peer's states at the end.
    pub(crate) fn peer_error(&self, states: &[f64]) -> f64 {
        distance(states, self.peer_reference.as_ref().unwrap_or(&self.reference))
    }

    pub(crate) fn until(&self) -> f64 {
        self.until
    }
}

fn distance(states: &[f64], reference: &[f64]) -> f64 {
    states.iter().zip(reference).map(|(a, b)| (a - b).abs() / b.abs().max(1.0)).fold(0.0, f64::max)
}

pub(crate) fn all() -> Vec<Problem> {
    vec![wind_pendulum(), thrown_rod(), rod_on_a_spring(), rigid_rod()]
}

/// Wind on the tip, T = 1 s, 20 s.
fn wind_pendulum() -> Problem {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(9.81 * M / (S * S));
    let rod = model.add(Body::rod("rod", [0 * M, 0 * M], [0 * M, -1 * M]).mass(1 * KG));
    model.pivot(&rod, [0 * M, 0 * M]);
    let wind = 10 * M / S * (1 + cos(2 * pi() * t() / (1 * S)));
    let u = wind * cos(rod.kinematics().angle()) - 1 * M * rod.kinematics().omega();
    model.torque("air", &rod, 0.03 * KG * (abs(u.clone()) * u));
    // The time is the third state: the peer is given systems without an explicit time only.
    fn rates(y: &[f64; 6]) -> [f64; 6] {
        let u = 10.0 * (1.0 + (std::f64::consts::TAU * y[2]).cos()) * y[0].cos() - y[1];
        let torque = 0.03 * u.abs() * u - 9.81 * 0.5 * y[0].sin();
        [y[1], 3.0 * torque, 1.0, 0.0, 0.0, 0.0]
    }
    let reference = vec![0.316_338_211_194_662_67, 1.832_319_409_834_266_4];
    Problem {
        name: "pendulum in the wind",
        model,
        until: 20.0,
        reference,
        peer_reference: None,
        start: [0.0; 6],
        rates,
        order: &[0, 1],
    }
}

/// Full drag on eight nodes, 1.2 s.
fn thrown_rod() -> Problem {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(9.81 * M / (S * S));
    let rod = model.add(Body::rod("rod", [-0.5 * M, 0 * M], [0.5 * M, 0 * M]).mass(0.5 * KG));
    let ends = [-0.5, 0.5].map(|x| rod.at(&vector([x * M, 0 * M])));
    let on = DragPlace::Lines { lines: vec![ends], component: Component::Full };
    model.interact(Drag { name: "air".into(), on, linear: None, quadratic: Some(0.02 * KG / (M * M)) });
    let start = Start::default().at([0 * M, 1 * M]).velocity([8 * M / S, 6 * M / S]);
    model.starts.push(("rod".into(), start.angle(0.5 * RAD).omega(6 * RAD / S)));
    fn rates(y: &[f64; 6]) -> [f64; 6] {
        const NODES: [(f64, f64); 4] = [
            (0.183_434_642_495_649_8, 0.362_683_783_378_361_96),
            (0.525_532_409_916_329, 0.313_706_645_877_887_27),
            (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
            (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
        ];
        let [_, _, vx, vy, angle, omega] = *y;
        let (sin, cos) = angle.sin_cos();
        let (mut fx, mut fy, mut torque) = (0.0, 0.0, 0.0);
        for (node, weight) in NODES.iter().flat_map(|(s, w)| [(*s, *w), (-*s, *w)]) {
            let s = 0.5 * node;
            let (ux, uy) = (vx - omega * s * sin, vy + omega * s * cos);
            let size = -0.02 * 0.5 * weight * ux.hypot(uy);
            fx += size * ux;
            fy += size * uy;
            torque += s * (cos * size * uy - sin * size * ux);
        }
        [vx, vy, fx / 0.5, fy / 0.5 - 9.81, omega, torque * 12.0 / 0.5]
    }
    let reference = vec![
        7.974_372_217_915_818,
        0.680_499_979_081_271_7,
        5.548_041_060_184_967,
        -5.765_935_057_260_183,
        6.030_432_261_768_108,
        3.573_413_371_611_466_5,
    ];
    let start = [0.0, 1.0, 8.0, 6.0, 0.5, 6.0];
    Problem {
        name: "thrown rod, eight nodes",
        model,
        until: 1.2,
        reference,
        peer_reference: None,
        start,
        rates,
        order: &[0, 1, 2, 3, 4, 5],
    }
}

/// Bounces of a rod on a floor without friction, to 3 s.
fn bouncing_rod(law: ContactLaw) -> Model {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(9.81 * M / (S * S));
    model.add(Body::rod("rod", [-0.5 * M, 0 * M], [0.5 * M, 0 * M]).mass(0.5 * KG));
    let start = Start::default().at([0 * M, 2 * M]).velocity([2 * M / S, 0 * M / S]);
    model.starts.push(("rod".into(), start.angle(0.6 * RAD).omega(2 * RAD / S)));
    model.surface(Surface::floor("floor", 0 * M, law));
    model
}

const BOUNCING_START: [f64; 6] = [0.0, 2.0, 2.0, 0.0, 0.6, 2.0];

/// Ends pressed into a spring of 1e4 N/m: the peer integrates the one-sided force without looking for its beginnings.
fn rod_on_a_spring() -> Problem {
    let law =
        ContactLaw::Spring { stiffness: 1e4 * N / M, damping: 0 * N * S / M, release: Release::AtZeroForce };
    let model = bouncing_rod(law);
    let reference = finest(&model);
    Problem {
        name: "rod on a spring floor",
        model,
        until: 3.0,
        reference,
        peer_reference: None,
        start: BOUNCING_START,
        rates: on_springs,
        order: &[0, 1, 2, 3, 4, 5],
    }
}

/// The same rod on a rigid elastic floor. The peer, which knows no impacts, is given the spring: the ratio compares two
/// ways to make the same rod bounce, at equal error of each against its own answer.
fn rigid_rod() -> Problem {
    let model = bouncing_rod(ContactLaw::Rigid { restitution: tumble_expr::Expr::one() });
    let reference = finest(&model);
    let spring = rod_on_a_spring();
    let peer_reference = Some(spring.reference.clone());
    Problem { name: "rod on a rigid floor", model, reference, peer_reference, ..spring }
}

fn on_springs(y: &[f64; 6]) -> [f64; 6] {
    let [_, height, vx, vy, angle, omega] = *y;
    let (sin, cos) = angle.sin_cos();
    let (mut fy, mut torque) = (0.0, 0.0);
    for end in [-0.5, 0.5] {
        let force = 1e4 * (-(height + end * sin)).max(0.0);
        fy += force;
        torque += end * cos * force;
    }
    [vx, vy, 0.0, fy / 0.5 - 9.81, omega, torque * 12.0 / 0.5]
}

/// The states at the end at the finest accuracy; `tests/bouncing_rod.rs` compares those with more digits.
fn finest(model: &Model) -> Vec<f64> {
    let accuracy = Accuracy::new(1e-14).expect("allowed");
    let run = model.simulate_to(&[], 3 * S, accuracy).expect("smooth");
    run.trajectory.last_states().expect("ran")
}
