//! The systems: as models, as plain right-hand sides for the peer, and their references at 34 digits.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use tumble::prelude::*;
use tumble_mech::{Component, ContactLaw, Drag, DragPlace, Equations, Release, Surface, Trust};
use tumble_ode::{InitialState, Occurrence, Solver};

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

/// A motion that was found, and when each of its steps was done.
pub(crate) struct Motion {
    /// States at the end.
    pub(crate) states: Vec<f64>,
    pub(crate) steps: u64,
    pub(crate) order: usize,
    /// Time of the motion that was reached, s, and how long that took since the one before.
    laps: Vec<(f64, Duration)>,
    /// Times of the motion at which a mode was entered for the first time, s: its tape was built in that lap.
    entered: Vec<f64>,
}

impl Motion {
    /// How long its steps took, without building: laps that build count as much as the others do on average.
    pub(crate) fn steps_alone(&self) -> Duration {
        let is_step = |index: usize, reached: f64| index > 0 && !self.entered.contains(&reached);
        let laps = self.laps.iter().enumerate();
        let steps: Vec<Duration> = laps
            .filter(|(index, (reached, _))| is_step(*index, *reached))
            .map(|(_, (_, time))| *time)
            .collect();
        let sum: Duration = steps.iter().sum();
        sum.mul_f64(self.laps.len() as f64 / steps.len().max(1) as f64)
    }
}

impl Problem {
    /// The motion alone, from equations that are built, with the enclosures of every step or without.
    pub(crate) fn motion(&self, equations: &Equations, accuracy: f64, is_proved: bool) -> Motion {
        let start = equations.start(&self.model.parameters).expect("sound");
        let accuracy = Accuracy::new(accuracy).expect("allowed");
        let mut solver = Solver::new(equations, InitialState { is_proved, ..start }, self.until, accuracy);
        let (mut laps, mut last) = (Vec::with_capacity(1024), Instant::now());
        while !solver.is_done() {
            solver.advance().expect("smooth");
            let now = Instant::now();
            laps.push((solver.time(), now - last));
            last = now;
        }
        let trajectory = solver.finish();
        Motion {
            states: trajectory.last_states().expect("ran"),
            steps: trajectory.work.steps,
            order: trajectory.order,
            laps,
            entered: first_entries(&trajectory.events),
        }
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

    /// Error of our states at the end.
    pub(crate) fn error(&self, states: &[f64]) -> f64 {
        distance(states, &self.reference)
    }

    /// Error of the peer's states at the end.
    pub(crate) fn peer_error(&self, states: &[f64]) -> f64 {
        distance(states, self.peer_reference.as_ref().unwrap_or(&self.reference))
    }

    pub(crate) fn until(&self) -> f64 {
        self.until
    }
}

/// Modes are counted in the order in which they are entered, so a new one is greater than all before.
fn first_entries<R>(events: &[Occurrence<R>]) -> Vec<f64> {
    let mut known = 0;
    let mut found = vec![];
    for event in events.iter().filter(|event| event.mode_before != event.mode_after) {
        if event.mode_after > known {
            found.push(event.time);
            known = event.mode_after;
        }
    }
    found
}

fn distance(states: &[f64], reference: &[f64]) -> f64 {
    states.iter().zip(reference).map(|(a, b)| (a - b).abs() / b.abs().max(1.0)).fold(0.0, f64::max)
}

/// The systems; the pendulum with other periods, too, where there is time.
pub(crate) fn all(is_long: bool) -> Vec<Problem> {
    let others = [wind_pendulum_of::<5>, wind_pendulum_of::<20>, wind_pendulum_of::<40>];
    let others = others.into_iter().filter(|_| is_long).map(|problem| problem());
    [wind_pendulum()]
        .into_iter()
        .chain(others)
        .chain([thrown_rod(), rod_on_a_spring(), rigid_rod()])
        .collect()
}

/// Wind on the tip, across the rod, with gusts every second, 20 s.
pub(crate) fn wind_pendulum() -> Problem {
    wind_pendulum_of::<10>()
}

/// The same with a period in tenths of a second.
fn wind_pendulum_of<const TENTHS: u32>() -> Problem {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(9.81 * M / (S * S));
    let rod = model.add(Body::rod("rod", [0 * M, 0 * M], [0 * M, -1 * M]).mass(1 * KG));
    model.pivot(&rod, [0 * M, 0 * M]);
    let period = f64::from(TENTHS) / 10.0;
    let wind = 10 * M / S * (1 + cos(2 * pi() * t() / (period * S)));
    let u = wind * cos(rod.kinematics().angle()) - 1 * M * rod.kinematics().omega();
    model.torque("air", &rod, 0.03 * KG * (abs(u.clone()) * u));
    let (name, reference) = match TENTHS {
        5 => ("pendulum, gusts of 0.5 s", [0.574_474_270_911_238_7, 0.200_525_154_242_957]),
        20 => ("pendulum, gusts of 2 s", [1.419_619_501_631_581, 5.624_813_989_322_898]),
        40 => ("pendulum, gusts of 4 s", [0.985_232_932_833_97, -0.521_658_537_949_117]),
        _ => ("pendulum in the wind", [0.316_338_211_194_662_67, 1.832_319_409_834_266_4]),
    };
    Problem {
        name,
        model,
        until: 20.0,
        reference: reference.to_vec(),
        peer_reference: None,
        start: [0.0; 6],
        rates: pendulum_rates::<TENTHS>,
        order: &[0, 1],
    }
}

/// The time is the third state: the peer is given systems without an explicit time only.
fn pendulum_rates<const TENTHS: u32>(y: &[f64; 6]) -> [f64; 6] {
    let turns = const { std::f64::consts::TAU * 10.0 / TENTHS as f64 };
    let u = 10.0 * (1.0 + (turns * y[2]).cos()) * y[0].cos() - y[1];
    let torque = 0.03 * u.abs() * u - 9.81 * 0.5 * y[0].sin();
    [y[1], 3.0 * torque, 1.0, 0.0, 0.0, 0.0]
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
    run.trajectory().last_states().expect("ran")
}
