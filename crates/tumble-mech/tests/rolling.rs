//! Rolling resistance against closed forms. With `k = I/(m R^2)` a body that rolls on a floor is slowed down by `(d/R) g/(1 + k)`.

use crate::common::{at, close, rigid, run};
use tumble_expr::units::{KG, M, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{
    Body, BodyContact, Change, Equations, Friction, Gravity, Happening, Model, Run, RunBalance, Shape, Start,
    Surface,
};

const G: f64 = 9.81;
const R: f64 = 0.2;

/// Disk, ring and ball of the radius R, with their k.
fn round() -> [(Shape, f64); 3] {
    let centre = || Vector::planar(0 * M, 0 * M);
    [
        (Shape::Disk { centre: centre(), radius: R * M }, 0.5),
        (Shape::Ring { centre: centre(), radius: R * M }, 1.0),
        (Shape::Ball { centre: centre(), radius: R * M }, 0.4),
    ]
}

/// On a slope through the origin that rises to the right, with a speed up along it and a spin.
fn wheel(shape: Shape, slope: f64, speed: f64, omega: f64, friction: Friction) -> Model {
    let (sin, cos) = slope.sin_cos();
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(G * M / (S * S));
    let start = Start::default().at([-R * sin * M, R * cos * M]);
    let start = start.velocity([speed * cos * M / S, speed * sin * M / S]).omega(omega / S);
    model.starts.push(("wheel".into(), start));
    model.add(Body::of_shape("wheel", shape).mass(2 * KG));
    let surface = Surface::sloping("floor", [0 * M, 0 * M], &Expr::from(slope), rigid(0.0));
    model.surface(surface.with_friction(friction));
    model
}

/// x, y, vx, vy, omega of the first body.
fn state(run: &Run, time: f64) -> [f64; 5] {
    let body = run.equations.model().bodies[0].kinematics();
    let (c, v) = (body.position(), body.velocity());
    at(run, time, [c.x().clone(), c.y().clone(), v.x().clone(), v.y().clone(), body.omega()])
}

fn times(run: &Run, change: Change) -> Vec<f64> {
    let is_it =
        |happening: &Happening| matches!(happening, Happening::Contact { change: own, .. } if *own == change);
    run.events().filter(|event| event.record.happened.iter().any(is_it)).map(|event| event.time).collect()
}

/// It stops after `v^2/(2 a)`, and from there on nothing moves at all.
#[test]
fn what_rolls_stops() {
    let (d, speed) = (0.004, 1.5);
    for (shape, k) in round() {
        let friction = Friction::new(0.3).rolling(d * M);
        let run = run(wheel(shape, 0.0, speed, -speed / R, friction), 20.0, 1e-13);
        let a = d / R * G / (1.0 + k);
        let stops = times(&run, Change::Stops);
        assert_eq!(stops.len(), 1, "{k}");
        close(stops[0], speed / a, 1e-13);
        close(state(&run, 2.0)[2], speed - a * 2.0, 1e-13);
        close(state(&run, 2.0)[4], -(speed - a * 2.0) / R, 1e-13);
        let still = state(&run, 0.5 * (20.0 + stops[0]));
        close(still[0], speed * speed / (2.0 * a), 1e-13);
        assert_eq!(still[2..], [0.0; 3]);
        assert_eq!(still, state(&run, 20.0));
    }
}

/// At rest on a slope it stays as long as `tan(slope) <= d/R`, and rolls down with what is left above.
#[test]
fn thresholds_of_a_slope() {
    let d = 0.03;
    for (shape, k) in round() {
        for (part, holds) in [(1.0 - 1e-6, true), (1.0 + 1e-6, false), (0.3, true), (2.0, false)] {
            let slope = (part * d / R).atan();
            let friction = Friction::new(0.9).rolling(d * M);
            let run = run(wheel(shape.clone(), slope, 0.0, 0.0, friction), 3.0, 1e-13);
            let [before, after] = [0.0, 3.0].map(|time| state(&run, time));
            let speed = 3.0 * G * (slope.sin() - d / R * slope.cos()) / (1.0 + k);
            match holds {
                true => assert_eq!(before, after, "{part}"),
                false => {
                    close(-(after[2].hypot(after[3])), -speed, 1e-11);
                    assert!(after[2] < 0.0 && speed > 0.0, "{part}");
                    assert!((after[4] - speed / R).abs() < 1e-11, "{part}");
                }
            }
        }
    }
}

/// Up a slope that is too steep to hold it: it turns round, and the resistance with it.
#[test]
fn up_a_slope_and_down_again() {
    let (d, slope, speed, k) = (0.01, 0.2_f64, 2.0, 0.5);
    let friction = Friction::new(0.9).rolling(d * M);
    let [(shape, _), ..] = round();
    let run = run(wheel(shape, slope, speed, -speed / R, friction), 4.0, 1e-13);
    let [up, down] = [1.0, -1.0].map(|sign| G * (slope.sin() + sign * d / R * slope.cos()) / (1.0 + k));
    let top = speed / up;
    assert_eq!(times(&run, Change::Stops), Vec::<f64>::new());
    let turns = times(&run, Change::Turns);
    close(*turns.last().expect("it turns"), top, 1e-13);
    let after = state(&run, 4.0);
    close(after[2], -down * (4.0 - top) * slope.cos(), 1e-12);
}

/// Backspin: it slides and turns against the way it goes, then slides and turns the other way, then rolls, then stops.
#[test]
fn backspin_with_resistance() {
    let (mu, d, v0, w0, k) = (0.2, 0.01, 3.0, 8.0, 0.4);
    let friction = Friction::new(mu).rolling(d * M);
    let [.., (shape, _)] = round();
    let run = run(wheel(shape, 0.0, v0, w0, friction), 30.0, 1e-13);
    let inertia = k * R * R;
    let [first, then] = [-(mu * R + d), -(mu * R - d)].map(|arm| arm * G / inertia);
    let turned = -w0 / first;
    close(times(&run, Change::Turns)[1], turned, 1e-13);
    // v - mu g t + R then (t - turned) = 0
    let rolls = (v0 - R * then * turned) / (mu * G - R * then);
    close(times(&run, Change::Rolls)[0], rolls, 1e-13);
    let speed = v0 - mu * G * rolls;
    close(state(&run, rolls)[2], speed, 1e-12);
    close(times(&run, Change::Stops)[0], rolls + speed / (d / R * G / (1.0 + k)), 1e-12);
}

/// What turns on a smooth floor is slowed down too, and does not move.
#[test]
fn on_a_smooth_floor_it_turns_less() {
    let (d, k) = (0.005, 0.5);
    let [(shape, _), ..] = round();
    let run = run(wheel(shape, 0.0, 0.0, 10.0, Friction::new(0.0).rolling(d * M)), 20.0, 1e-13);
    close(times(&run, Change::Stops)[0], 10.0 * k * R * R / (d * G), 1e-13);
    assert_eq!(state(&run, 20.0)[0], 0.0);
    assert_eq!(state(&run, 20.0)[4], 0.0);
}

/// The work of the resistance is `-d N` times the angle.
#[test]
fn its_work() {
    let (d, speed) = (0.004, 1.5);
    let [(shape, k), ..] = round();
    let run = run(wheel(shape, 0.0, speed, -speed / R, Friction::new(0.3).rolling(d * M)), 20.0, 1e-13);
    let balance = RunBalance::of(&run, [0.0, 0.0]).expect("a balance");
    let own = balance.contributions.iter().filter(|own| own.load == "floor.wheel.rim.rolling");
    let work: f64 = own.map(|own| own.work).sum();
    assert!(balance.energy.relative() < 1e-12);
    close(work, -0.5 * 2.0 * (1.0 + k) * speed * speed, 1e-12);
}

/// On a fixed cylinder, beside its top: it stays where `tan(phi) <= d/R`, with R its own radius.
#[test]
fn on_a_cylinder() {
    let phi: f64 = 0.1;
    for (part, holds) in [(1.0 + 1e-6, true), (1.0 - 1e-6, false)] {
        let mut model = Model::new();
        model.gravity = Gravity::Vertical(G * M / (S * S));
        let [(shape, _), ..] = round();
        model.add(Body::of_shape("wheel", shape).mass(1 * KG));
        let place = [3.0 * R * phi.sin(), 3.0 * R * phi.cos()];
        model.starts.push(("wheel".into(), Start::default().at(place.map(|x| x * M))));
        let friction = Friction::new(0.9).rolling(part * phi.tan() * R * M);
        let log = Surface::circle("log", [0 * M, 0 * M], 2.0 * R * M, rigid(0.0));
        model.surface(log.with_friction(friction));
        let run = run(model, 1.0, 1e-12);
        assert_eq!(state(&run, 1.0)[0] == place[0], holds, "{part}");
        assert!(state(&run, 1.0)[0] >= place[0]);
    }
}

/// On a plank that is free to slide: it is slowed down against that by `(d/R) g (1 + m/M)/(1 + k (1 + m/M))`, and goes on with it.
#[test]
fn on_a_plank() {
    let (m, big, d, speed, k) = (2.0, 5.0, 0.004, 1.0, 0.5);
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(G * M / (S * S));
    let [(shape, _), ..] = round();
    model.add(Body::of_shape("wheel", shape).mass(m * KG));
    let start = Start::default().at([0 * M, R * M]).velocity([speed * M / S, 0 * M / S]);
    model.starts.push(("wheel".into(), start.omega(-speed / R / S)));
    let centre = Vector::planar(0 * M, 0 * M);
    model.add(Body::of_shape("plank", Shape::Box { centre, width: 20 * M, height: 0.1 * M }).mass(big * KG));
    model.starts.push(("plank".into(), Start::default().at([0 * M, -0.05 * M])));
    let contact = BodyContact::new("top", ["wheel", "plank"], 0.0);
    model.contact(contact.with_friction(Friction::new(0.5).rolling(d * M)));
    model.surface(Surface { on: Some(vec!["plank".into()]), ..Surface::floor("ice", -0.1 * M, rigid(0.0)) });
    let run = run(model, 40.0, 1e-13);
    let a = d / R * G * (1.0 + m / big) / (1.0 + k * (1.0 + m / big));
    close(times(&run, Change::Stops)[0], speed / a, 1e-12);
    let after = state(&run, 40.0);
    close(after[2], speed * m / (m + big), 1e-12);
    close(after[4], 0.0, 1e-13);
}

#[test]
fn what_cannot_be_is_refused() {
    let [(shape, _), ..] = round();
    let model = wheel(shape.clone(), 0.0, 0.0, 0.0, Friction::new(0.3).rolling(-0.1 * M));
    let parameters = model.parameters.clone();
    let said =
        Equations::new(model).expect("sound names").check(&parameters).map(drop).expect_err("a mistake");
    assert!(said.to_string().contains("rolling resistance of `floor`"), "{said}");
    let model = wheel(shape, 0.0, 0.0, 0.0, Friction::new(0.3).rolling(0.1));
    let said = Equations::new(model).map(drop).expect_err("a length");
    assert!(said.to_string().contains("rolling resistance of `floor`"), "{said}");
}
