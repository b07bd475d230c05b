//! Dry friction of contacts that last: stops, break-away, rolling, belts; against closed forms.

mod common;

use common::{at, close, rigid, run};
use tumble_expr::units::{KG, M, N, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{Body, Change, Friction, Gravity, Happening, Model, Run, Shape, Start, Surface, time};

const G: f64 = 9.81;

/// One body in gravity on a slope that rises to the right by `slope`, through the origin.
fn on_slope(body: Body, start: Start, slope: f64, restitution: f64, friction: Friction) -> Model {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(G * M / (S * S));
    model.starts.push((body.name.clone(), start));
    model.add(body);
    let surface = Surface::sloping("floor", [0 * M, 0 * M], &Expr::from(slope), rigid(restitution));
    model.surface(surface.with_friction(friction));
    model
}

fn plate(width: f64, height: f64, mass: f64) -> Body {
    let centre = Vector::planar(0 * M, 0 * M);
    Body::of_shape("box", Shape::Box { centre, width: width * M, height: height * M }).mass(mass * KG)
}

/// A box that stands on the slope with its middle above the origin and moves up along it.
fn block(slope: f64, speed: f64, friction: Friction) -> Model {
    let (sin, cos) = slope.sin_cos();
    let start = Start::default().at([-0.1 * sin * M, 0.1 * cos * M]).angle(Expr::from(slope));
    let start = start.velocity([speed * cos * M / S, speed * sin * M / S]);
    on_slope(plate(0.4, 0.2, 2.0), start, slope, 0.0, friction)
}

/// x, y, vx, vy, angle, omega of the first body.
fn state(run: &Run, time: f64) -> [f64; 6] {
    let body = run.equations.model().bodies[0].kinematics();
    let (c, v) = (body.position(), body.velocity());
    at(run, time, [c.x().clone(), c.y().clone(), v.x().clone(), v.y().clone(), body.angle(), body.omega()])
}

/// Along the slope from where a body on it began.
fn along(run: &Run, slope: f64, time: f64) -> [f64; 2] {
    let ([x0, y0, ..], [x, y, vx, vy, ..]) = (state(run, 0.0), state(run, time));
    let (sin, cos) = slope.sin_cos();
    [cos * (x - x0) + sin * (y - y0), cos * vx + sin * vy]
}

/// Times of a change of any contact.
fn times(run: &Run, change: Change) -> Vec<f64> {
    let is_it =
        |happening: &Happening| matches!(happening, Happening::Contact { change: own, .. } if *own == change);
    run.events().filter(|event| event.record.happened.iter().any(is_it)).map(|event| event.time).collect()
}

/// Normal and friction force of all contacts together, N.
fn forces(run: &Run, time: f64) -> [f64; 2] {
    let pairs = run.equations.pairs();
    let sum =
        |of: &dyn Fn(&tumble_mech::Pair) -> Expr| pairs.iter().map(of).reduce(|a, b| a + b).expect("pairs");
    at(run, time, [sum(&|pair| pair.force_symbol().into()), sum(&|pair| pair.friction_symbol().into())])
}

/// `t = v/(mu g)` and `x = v^2/(2 mu g)`, and from there on nothing moves at all.
#[test]
fn a_block_stops() {
    let (mu, speed) = (0.3, 3.0);
    let run = run(block(0.0, speed, Friction::new(Expr::from(mu))), 10.0, 1e-13);
    let (stop, way) = (speed / (mu * G), speed * speed / (2.0 * mu * G));
    assert_eq!(times(&run, Change::Slides), [0.0]);
    let sticks = times(&run, Change::Sticks);
    assert_eq!(sticks.len(), 1);
    close(sticks[0], stop, 1e-14);
    close(state(&run, 0.5)[2], speed - mu * G * 0.5, 1e-14);
    close(forces(&run, 0.5)[1], -mu * 2.0 * G, 1e-12);
    let still = state(&run, 5.0);
    close(still[0], way, 1e-14);
    assert_eq!(still[2..4], [0.0, 0.0]);
    assert_eq!(still, state(&run, 10.0));
    assert_eq!(forces(&run, 5.0)[1], 0.0);
}

/// Up a slope that is too steep to hold it: it turns round and comes down, friction always against it.
#[test]
fn a_block_turns_round_on_a_steep_slope() {
    let (slope, mu, speed) = (0.6_f64, 0.25, 4.0);
    let run = run(block(slope, speed, Friction::new(Expr::from(mu))), 3.0, 1e-13);
    let (up, down) = (G * (slope.sin() + mu * slope.cos()), G * (slope.sin() - mu * slope.cos()));
    let turns = times(&run, Change::Slides);
    assert_eq!(turns.len(), 2);
    close(turns[1], speed / up, 1e-14);
    let [x, v] = along(&run, slope, 3.0);
    let fallen = 3.0 - speed / up;
    close(v, -down * fallen, 1e-13);
    close(x, speed * speed / (2.0 * up) - 0.5 * down * fallen * fallen, 1e-13);
    assert!(times(&run, Change::Sticks).is_empty());
}

/// Up a slope that holds it: there it stays, with friction `m g sin`, and does not creep by the least.
#[test]
fn a_block_stays_on_a_slope_that_holds_it() {
    let (slope, mu, speed) = (0.3_f64, 0.4, 4.0);
    let run = run(block(slope, speed, Friction::new(Expr::from(mu))), 1000.0, 1e-13);
    let up = G * (slope.sin() + mu * slope.cos());
    close(times(&run, Change::Sticks)[0], speed / up, 1e-14);
    close(along(&run, slope, 900.0)[0], speed * speed / (2.0 * up), 1e-14);
    assert_eq!(state(&run, 2.0), state(&run, 1000.0));
    close(forces(&run, 7.0)[0], 2.0 * G * slope.cos(), 1e-13);
    close(forces(&run, 7.0)[1], 2.0 * G * slope.sin(), 1e-13);
    assert!(run.trajectory().events.len() <= 3, "{}", run.trajectory().events.len());
}

/// On both sides of `tan = mu` by a millionth.
#[test]
fn the_angle_of_repose() {
    for mu in [0.1_f64, 0.5, 1.7] {
        for off in [-1e-6, 1e-6] {
            let slope = mu.atan() * (1.0 + off);
            let run = run(block(slope, 0.0, Friction::new(Expr::from(mu))), 10.0, 1e-13);
            let [x, _] = along(&run, slope, 10.0);
            let acceleration = G * (slope.sin() - mu * slope.cos());
            match off < 0.0 {
                true => assert_eq!(x, 0.0),
                false => close(x, -50.0 * acceleration, 1e-13),
            }
        }
    }
}

/// A force that grows evenly: it holds until `k t = mu_s m g`, then `m v' = k t - mu_k m g`; with one coefficient it begins to slip
/// without a jump of its acceleration.
#[test]
fn a_block_breaks_away() {
    for (of_rest, kinetic) in [(0.5, 0.5), (0.5, 0.3)] {
        let friction = Friction::new(Expr::from(of_rest)).kinetic(Expr::from(kinetic));
        let mut model = block(0.0, 0.0, friction);
        let (rope, force) = (1.5, Vector::planar(1.5 * N / S * time(), 0 * N));
        let centre = model.bodies[0].cm();
        model.force("rope", &centre, force);
        let run = run(model, 10.0, 1e-13);
        let breaks = of_rest * 2.0 * G / rope;
        let slides = times(&run, Change::Slides);
        assert_eq!(slides.len(), 1);
        close(slides[0], breaks, 1e-14);
        assert_eq!(state(&run, breaks * 0.99)[2], 0.0);
        let speed =
            |t: f64| (0.5 * rope * (t * t - breaks * breaks) - kinetic * 2.0 * G * (t - breaks)) / 2.0;
        close(state(&run, 10.0)[2], speed(10.0), 1e-13);
        close(forces(&run, 0.5 * breaks)[1], -rope * 0.5 * breaks, 1e-13);
    }
}

/// Hoop, disk and ball, with moments of inertia `c m r^2`.
fn round() -> [(Shape, f64); 3] {
    let (centre, radius) = (Vector::planar(0 * M, 0 * M), 0.2 * M);
    [
        (Shape::Ring { centre: centre.clone(), radius: radius.clone() }, 1.0),
        (Shape::Disk { centre: centre.clone(), radius: radius.clone() }, 0.5),
        (Shape::Ball { centre, radius }, 0.4),
    ]
}

/// Pushed forward with backspin: it slips for `s/(mu g (1 + 1/c))`, s the slip at first, and then rolls with `v - s c/(1 + c)`, which
/// is back where it came from if the spin was enough.
#[test]
fn backspin_returns() {
    for (shape, c) in round() {
        for spin in [0.0, 12.0, 60.0] {
            let (mu, speed, radius) = (0.2, 2.0, 0.2);
            let body = Body::of_shape("ball", shape.clone()).mass(3 * KG);
            let start = Start::default().at([0 * M, radius * M]).velocity([speed * M / S, 0 * M / S]);
            let model = on_slope(body, start.omega(spin / S), 0.0, 0.0, Friction::new(Expr::from(mu)));
            let run = run(model, 20.0, 1e-13);
            let slip = speed + spin * radius;
            let (when, rolls) = (slip / (mu * G * (1.0 + 1.0 / c)), speed - slip * c / (1.0 + c));
            let found = times(&run, Change::Rolls);
            assert_eq!(found.len(), 1);
            close(found[0], when, 1e-14);
            let [x, y, vx, vy, _, omega] = state(&run, 20.0);
            close(vx, rolls, 1e-14);
            close(omega, -rolls / radius, 1e-14);
            close(x, speed * when - 0.5 * mu * G * when * when + rolls * (20.0 - when), 1e-13);
            close(y, radius, 1e-15);
            close(vy, 0.0, 1e-15);
            assert_eq!(rolls < 0.0, spin > speed / (c * radius));
            assert!(forces(&run, 19.0)[1].abs() < 1e-14);
        }
    }
}

/// Down a slope: it rolls with `g sin / (1 + c)` if `mu >= tan c/(1 + c)`, else it slips; a millionth on both sides.
#[test]
fn thresholds_of_rolling() {
    let slope = 0.7_f64;
    for (shape, c) in round() {
        let least = slope.tan() * c / (1.0 + c);
        for off in [-1e-6, 1e-6] {
            let mu = least * (1.0 + off);
            let body = Body::of_shape("ball", shape.clone()).mass(3 * KG);
            let (sin, cos) = slope.sin_cos();
            let start = Start::default().at([-0.2 * sin * M, 0.2 * cos * M]);
            let model = on_slope(body, start, slope, 0.0, Friction::new(Expr::from(mu)));
            let run = run(model, 4.0, 1e-13);
            let rolls = off > 0.0;
            assert_eq!(times(&run, Change::Rolls).len(), usize::from(rolls));
            assert_eq!(times(&run, Change::Slides).len(), usize::from(!rolls));
            let acceleration = if rolls { G * sin / (1.0 + c) } else { G * (sin - mu * cos) };
            let [_, v] = along(&run, slope, 4.0);
            close(v, -4.0 * acceleration, 1e-13);
            let turns = if rolls { 4.0 * acceleration / 0.2 } else { 4.0 * mu * G * cos / (c * 0.2) };
            close(state(&run, 4.0)[5], turns, 1e-13);
        }
    }
}

/// A block that is put on a moving belt is carried along: after `u/(mu g)` it goes with the belt, without slip from there on.
#[test]
fn a_belt_takes_a_block_along() {
    let (mu, belt) = (0.4, 1.5);
    let mut model = block(0.0, 0.0, Friction::new(Expr::from(mu)));
    model.surfaces[0].through = Vector::planar(belt * M / S * time(), 0 * M);
    let run = run(model, 5.0, 1e-13);
    let taken = belt / (mu * G);
    close(times(&run, Change::Sticks)[0], taken, 1e-14);
    close(state(&run, 0.5 * taken)[2], 0.5 * belt, 1e-14);
    let [x, _, vx, ..] = state(&run, 5.0);
    close(vx, belt, 1e-15);
    close(x, belt * (5.0 - 0.5 * taken), 1e-14);
    assert!(forces(&run, 4.0)[1].abs() < 1e-13);
}

/// On a shaken floor, `x = A sin(w t)`, it holds while `A w^2 |sin| <= mu g`: it breaks away where that ends.
#[test]
fn a_shaken_floor_breaks_away() {
    let (mu, amplitude, w) = (0.3, 0.05, 9.0);
    let mut model = block(0.0, 0.0, Friction::new(Expr::from(mu)));
    let path = amplitude * M * (1 - (w / S * time()).cos());
    model.surfaces[0].through = Vector::planar(path, 0 * M);
    let run = run(model, 3.0, 1e-12);
    // The floor accelerates by A w^2 cos(w t): it is too much at once.
    assert!(amplitude * w * w > mu * G);
    assert_eq!(times(&run, Change::Slides)[0], 0.0);
    close(state(&run, 0.01)[2], mu * G * 0.01, 1e-13);
    // It goes with the floor where their speeds meet, if the floor's acceleration is small then, and leaves it where that is mu g.
    let stick = times(&run, Change::Sticks)[0];
    close(state(&run, stick)[2], amplitude * w * (w * stick).sin(), 1e-11);
    let slide = times(&run, Change::Slides)[1];
    close((amplitude * w * w * (w * slide).cos()).abs(), mu * G, 1e-10);
}
