//! The systems: as models, as plain right-hand sides for the peer, and their references at 34 digits.

use tumble::prelude::*;
use tumble_mech::{Component, Drag, DragPlace};

/// A system with its answer.
pub(crate) struct Problem {
    pub(crate) name: &'static str,
    model: Model,
    until: f64,
    /// States at the end, in the model's order.
    reference: Vec<f64>,
    /// What the peer starts from, and its rates.
    pub(crate) start: [f64; 6],
    pub(crate) rates: fn(&[f64; 6]) -> [f64; 6],
    /// States of the peer in the model's order.
    pub(crate) order: &'static [usize],
}

impl Problem {
    pub(crate) fn run(&self, accuracy: f64) -> Run {
        let accuracy = Accuracy::new(accuracy).expect("allowed");
        let equations = tumble_mech::Equations::new(self.model.clone()).expect("sound");
        Run::new(equations, &self.model.parameters, self.until, accuracy, |_| ()).expect("smooth")
    }

    pub(crate) fn error(&self, run: &Run) -> f64 {
        self.distance(&run.trajectory.last_states().expect("ran"))
    }

    pub(crate) fn distance(&self, states: &[f64]) -> f64 {
        states.iter().zip(&self.reference).map(|(a, b)| (a - b).abs() / b.abs().max(1.0)).fold(0.0, f64::max)
    }

    pub(crate) fn until(&self) -> f64 {
        self.until
    }
}

pub(crate) fn all() -> Vec<Problem> {
    vec![wind_pendulum(), thrown_rod()]
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
        start,
        rates,
        order: &[0, 1, 2, 3, 4, 5],
    }
}
