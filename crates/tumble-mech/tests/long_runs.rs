//! Long runs: a route to chaos, period by period.

use crate::common::{at, run};
use tumble_expr::units::{KG, M, RAD, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{Body, Gravity, Model, Start, time};

/// phi'' + 2 beta phi' + w0^2 sin phi = gamma w0^2 cos(w t), w = 2 pi, w0 = 1.5 w, beta = w0 / 4: a point on a rod of
/// length g / w0^2, with a damping torque and a driving torque.
fn driven(gamma: f64) -> (Model, Body) {
    let w0 = 1.5 * std::f64::consts::TAU;
    let beta = w0 / 4.0;
    let mut model = Model::new();
    let length = 9.81 / (w0 * w0);
    model.gravity = Gravity::Vertical(9.81 * M / (S * S));
    let ball = model.add(Body::rod("ball", [0 * M, 0 * M], [0 * M, -length * M]).mass(1 * KG));
    // A point mass at the end: stated, so that the rod is only drawn.
    let body = &mut model.bodies[0];
    body.stated = Some(tumble_mech::MassProperties {
        mass: 1 * KG,
        centre: Vector::planar(0 * M, -length * M),
        inertia: 0 * KG * M * M,
    });
    let ball = tumble_mech::Body { stated: body.stated.clone(), ..ball };
    model.pivot(&ball, [0 * M, 0 * M]);
    let inertia = length * length * KG * M * M;
    let drive = gamma * w0 * w0 / (S * S) * (2 * Expr::pi() * time() / (1 * S)).cos();
    let damping = 2.0 * beta / S * ball.kinematics().omega();
    model.torque("drive", &ball, &inertia * drive);
    model.torque("damping", &ball, -(inertia * damping));
    model.starts.push(("ball".into(), Start::default().angle(-std::f64::consts::FRAC_PI_2 * RAD)));
    (model, ball)
}

/// How many drive periods pass before the motion repeats, after its transient has died.
fn period(gamma: f64) -> Option<u32> {
    let (model, ball) = driven(gamma);
    let (settled, until) = (800, 832);
    let run = run(model, f64::from(until), 1e-12);
    let angle = |n: u32| at(&run, f64::from(n), [ball.kinematics().angle()])[0];
    let repeats = |p: &u32| (settled..until - 16).all(|n| (angle(n) - angle(n + p)).abs() < 1e-5);
    [1, 2, 4, 8, 16].into_iter().find(repeats)
}

/// The thresholds are known to ten digits; halfway between them the period is 1, 2, 4 and 8 drive periods.
#[test]
fn the_driven_pendulum_doubles_its_period() {
    let thresholds = [1.066_372_862_5, 1.079_313_905_9, 1.082_084_384_3, 1.082_678_352_7];
    assert_eq!(period(1.06), Some(1));
    for (index, pair) in thresholds.windows(2).enumerate() {
        let expected = 2_u32.pow(index as u32 + 1);
        assert_eq!(period(0.5 * (pair[0] + pair[1])), Some(expected), "between {pair:?}");
    }
}
