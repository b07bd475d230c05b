//! Dry friction as a user writes it, `-mu N sign(v)`: stops, holds and gives way at exact times; against closed forms and the friction
//! that surfaces have.

use crate::common;

use crate::common::{at, close, rigid, run};
use tumble_expr::units::{KG, M, N, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{
    Action, Application, AppliedImpulse, Body, Change, ContactLaw, Event, Forces, Friction, Gravity, Load,
    Model, Place, Release, Run, Shape, Start, Surface, time,
};
use tumble_ode::{Direction, Side};

const G: f64 = 9.81;

fn in_gravity() -> Model {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(G * M / (S * S));
    model
}

/// Names and times of all that happens.
fn told(run: &Run) -> Vec<(String, f64)> {
    let of = |event: &tumble_ode::Occurrence<tumble_mech::Record>| {
        run.equations.names_of(&event.record).into_iter().map(|name| (name, event.time)).collect::<Vec<_>>()
    };
    run.events().flat_map(of).collect()
}

fn times(run: &Run, name: &str) -> Vec<f64> {
    told(run).into_iter().filter(|(known, _)| known == name).map(|(_, time)| time).collect()
}

/// x and vx of a body.
fn motion(run: &Run, body: usize, time: f64) -> [f64; 2] {
    let motion = run.equations.model().bodies[body].kinematics();
    at(run, time, [motion.position().x().clone(), motion.velocity().x().clone()])
}

/// Force of a load at a time.
fn force(run: &Run, load: &str, time: f64) -> [f64; 2] {
    let all = Forces::of(run).at(time, Side::After).expect("numbers");
    let own = all.into_iter().filter(|force| force.load == load);
    own.fold([0.0; 2], |sum, force| [sum[0] + force.force[0], sum[1] + force.force[1]])
}

fn speed(model: &Model, body: usize) -> Expr {
    model.bodies[body].kinematics().velocity().x().clone()
}

fn normal(model: &Model) -> Expr {
    let all = model.pairs().into_iter().map(|pair| Expr::from(pair.force_symbol()));
    all.reduce(|a, b| a + b).expect("a surface")
}

/// A point that moves to the right, without gravity.
fn point(mass: f64, speed: f64) -> Model {
    let mut model = Model::new();
    let name = format!("p{}", model.bodies.len());
    model
        .starts
        .push((name.clone(), Start::default().at([0 * M, 0 * M]).velocity([speed * M / S, 0 * M / S])));
    model.add(Body::point(name).mass(mass * KG));
    model
}

fn push(model: &mut Model, name: &str, body: usize, force: Expr) {
    let place = model.bodies[body].cm();
    model.force(name, &place, Vector::planar(force, 0 * N));
}

/// It stops at `m v/F`, and from there on nothing of it moves.
#[test]
fn what_is_braked_by_a_constant_force_stops_and_stays() {
    let mut model = point(1.0, 6.0);
    let v = speed(&model, 0);
    push(&mut model, "friction", 0, -(3 * N) * v.sign());
    let run = run(model, 1000.0, 1e-13);
    assert_eq!(told(&run), [("friction.sticks".to_owned(), 2.0)]);
    close(motion(&run, 0, 1.5)[0], 6.0 * 1.5 - 1.5 * 1.5 * 1.5, 1e-15);
    assert_eq!(motion(&run, 0, 1000.0), [6.0, 0.0]);
    assert_eq!(force(&run, "friction", 500.0), [0.0, 0.0]);
}

/// A box of 2 kg on a floor, pulled at an angle by a force that grows, and rubbed by `-mu N` at its foot.
fn pulled(speed_at_start: f64, pull: Expr, angle: f64, mu: f64, built_in: bool) -> Model {
    let mut model = in_gravity();
    let centre = Vector::planar(0 * M, 0 * M);
    let shape = Shape::Box { centre, width: 0.4 * M, height: 0.2 * M };
    let block = model.add(Body::of_shape("block", shape).mass(2 * KG));
    let start = Start::default().at([0 * M, 0.1 * M]).velocity([speed_at_start * M / S, 0 * M / S]);
    model.starts.push(("block".into(), start));
    let floor = Surface::floor("floor", 0 * M, rigid(0.0));
    model.surface(if built_in { floor.with_friction(Friction::new(Expr::from(mu))) } else { floor });
    let (sin, cos) = angle.sin_cos();
    model.force("pull", &block.cm(), Vector::planar(cos * &pull, sin * &pull));
    if !built_in {
        let rub = -mu * normal(&model) * speed(&model, 0).sign();
        let foot = Place::FromCentre(Vector::planar(0 * M, -0.1 * M));
        model.loads.push(Load::force("rub", "block", foot, Vector::planar(rub, 0 * N)));
    }
    model
}

/// It stops where the pull does not keep it going, holds with what that takes, and gives way at
/// `k t cos = mu (m g - k t sin)`.
#[test]
fn a_block_stops_holds_and_breaks_away() {
    let (k, angle, mu) = (4.0, 0.4_f64, 0.3);
    let (sin, cos) = angle.sin_cos();
    let run = run(pulled(0.0, k * N / S * time(), angle, mu, false), 4.0, 1e-13);
    let breaks = mu * 2.0 * G / (k * (cos + mu * sin));
    assert_eq!(times(&run, "rub.slides").len(), 1, "{:?}", told(&run));
    close(times(&run, "rub.slides")[0], breaks, 1e-14);
    assert_eq!(motion(&run, 0, 0.9 * breaks), [0.0, 0.0]);
    close(force(&run, "rub", 1.0)[0], -k * cos, 1e-13);
    let rate = k * (cos + mu * sin) / 2.0;
    let expected = |t: f64| {
        let d = t - breaks;
        [rate * d * d * d / 6.0, rate * d * d / 2.0]
    };
    for (found, expected) in motion(&run, 0, 4.0).into_iter().zip(expected(4.0)) {
        close(found, expected, 1e-13);
    }
}

/// The same in all with the friction of surfaces: stop, hold, break-away, and stop again after a pull that swings.
#[test]
fn it_is_the_friction_of_surfaces() {
    let pull = || 12 * N * (3 * time() / S).sin();
    for (first, angle) in [(1.0, 0.5), (0.0, -0.3), (-2.0, 0.0)] {
        let [own, built_in] =
            [false, true].map(|built_in| run(pulled(first, pull(), angle, 0.35, built_in), 6.0, 1e-13));
        let changes = |run: &Run, word: &str| {
            let all = told(run).into_iter();
            let own = all.filter(|(name, time)| *time > 0.0 && name.ends_with(word));
            own.map(|(_, time)| time).collect::<Vec<_>>()
        };
        for word in [Change::Sticks.word(), Change::Slides.word()] {
            let [own, built_in] = [&own, &built_in].map(|run| changes(run, word));
            println!("{word} {own:?} {built_in:?}");
            assert!(own.len() >= 2 && own.len() == built_in.len(), "{word} {own:?} {built_in:?}");
            own.iter().zip(&built_in).for_each(|(own, built_in)| close(*own, *built_in, 1e-12));
        }
        for t in [0.5, 1.7, 3.0, 4.4, 5.9] {
            let found = motion(&own, 0, t).into_iter().zip(motion(&built_in, 0, t));
            found.for_each(|(own, built_in)| close(own, built_in, 1e-12));
        }
    }
}

/// On both sides of `tan = mu` by a millionth, written along the slope.
#[test]
fn the_angle_of_repose() {
    let mu = 0.5_f64;
    for off in [-0.1, -1e-6, 1e-6] {
        let slope = mu.atan() * (1.0 + off);
        let (sin, cos) = slope.sin_cos();
        let mut model = in_gravity();
        let ball = Body::point("p").mass(2 * KG);
        let start = Start::default().at([0 * M, 0 * M]);
        model.starts.push(("p".into(), start));
        let place = model.add(ball).cm();
        model.surface(Surface::sloping("floor", [0 * M, 0 * M], &Expr::from(slope), rigid(0.0)));
        let velocity = place.velocity();
        let along = cos * velocity.x() + sin * velocity.y();
        let rub = -mu * normal(&model) * along.sign();
        model.force("rub", &place, Vector::planar(cos * &rub, sin * &rub));
        let run = run(model, 10.0, 1e-13);
        let [_, v] = motion(&run, 0, 10.0);
        let expected = if off > 0.0 { -10.0 * G * (sin - mu * cos) * cos } else { 0.0 };
        close(v, expected, 1e-13);
        assert!((v != 0.0) == (off > 0.0), "{v:e}");
    }
}

/// A spring's amplitude falls by `2 F/k` each half swing, until it cannot pull the block away any more.
#[test]
fn an_oscillator_with_dry_friction_comes_to_rest() {
    let (k, mass, friction, first) = (20.0, 0.5, 1.7, 1.0);
    let mut model = point(mass, 0.0);
    let body = model.bodies[0].clone();
    model.starts[0].1 = Start::default().at([first * M, 0 * M]);
    let x = body.kinematics().position().x().clone();
    push(&mut model, "spring", 0, -k * N / M * x);
    let v = speed(&model, 0);
    push(&mut model, "friction", 0, -friction * N * v.sign());
    let run = run(model, 20.0, 1e-13);
    let half = std::f64::consts::PI * f64::sqrt(mass / k);
    let (mut turns, mut place) = (0, first);
    while place.abs() > friction / k {
        place = -place.signum() * (place.abs() - 2.0 * friction / k);
        turns += 1;
    }
    assert_eq!(times(&run, "friction.slides").len(), turns - 1);
    let stops = times(&run, "friction.sticks");
    assert_eq!(stops.len(), 1, "{:?}", told(&run));
    close(stops[0], turns as f64 * half, 1e-13);
    let [x, v] = motion(&run, 0, 19.0);
    close(x, place, 1e-12);
    assert_eq!(v, 0.0);
    close(force(&run, "friction", 19.0)[0], k * place, 1e-12);
}

/// A block rubs on a cart that it moves: they come to one velocity and keep it, and a pull on the cart takes both along as long as
/// friction holds.
#[test]
fn a_rate_between_two_bodies() {
    let (masses, friction, first) = ([1.0, 3.0], 2.0, 4.0);
    let mut model = point(masses[0], first);
    model.starts.push(("cart".into(), Start::default().at([0 * M, 0 * M])));
    model.add(Body::point("cart").mass(masses[1] * KG));
    let slip = speed(&model, 0) - speed(&model, 1);
    push(&mut model, "rub", 0, -friction * N * slip.sign());
    push(&mut model, "back", 1, friction * N * slip.sign());
    push(&mut model, "pull", 1, 1 * N / S * time());
    let run = run(model, 10.0, 1e-13);
    // With the pull t: v0 - F t/m0 = (F t + t^2/2)/m1.
    let (a, b, c): (f64, f64, f64) = (0.5 / masses[1], friction / masses[0] + friction / masses[1], -first);
    let meet = (-b + (b * b - 4.0 * a * c).sqrt()) / (2.0 * a);
    close(times(&run, "rub.sticks")[0], meet, 1e-14);
    // Together t/(m0 + m1), which friction gives the block up to F.
    let breaks = friction / masses[0] * (masses[0] + masses[1]);
    assert_eq!(times(&run, "rub.slides").len(), 1, "{:?}", told(&run));
    close(times(&run, "rub.slides")[0], breaks, 1e-13);
    let [block, cart] = [0, 1].map(|body| motion(&run, body, 0.5 * (meet + breaks))[1]);
    close(block, cart, 1e-15);
    let total = masses[0] * first + 0.5 * breaks * breaks;
    close(motion(&run, 0, breaks)[1], total / (masses[0] + masses[1]), 1e-14);
}

/// A rod in a hinge that rubs by the force with which it bears the weight holds it up to `sin = c/r`.
#[test]
fn friction_of_a_hinge_holds_up_to_an_angle() {
    let (c, r) = (0.05, 0.5);
    for (off, holds) in [(-1e-6, true), (1e-6, false), (-0.5, true)] {
        let (mut model, rod) = common::hinged_rod();
        let [_, fy] = model.pivots[0].force_symbols();
        let omega = rod.kinematics().omega();
        model.torque("rub", &rod, -c * M * Expr::from(fy) * omega.sign());
        let angle = f64::asin(c / r) * (1.0 + off);
        model.starts.push(("rod".into(), Start::default().angle(Expr::from(angle))));
        let run = run(model, 5.0, 1e-13);
        let [found, rate] = at(&run, 0.3, [rod.kinematics().angle(), rod.kinematics().omega()]);
        assert_eq!(found == angle && rate == 0.0, holds, "{found} {rate}");
    }
}

/// What drives instead of braking is left as it is.
#[test]
fn a_force_along_the_motion_is_no_brake() {
    let mut model = point(2.0, 0.5);
    let v = speed(&model, 0);
    push(&mut model, "drive", 0, 3 * N * v.sign());
    let run = run(model, 2.0, 1e-13);
    close(motion(&run, 0, 2.0)[1], 0.5 + 3.0, 1e-14);
    assert!(told(&run).is_empty());
}

/// Struck while it holds, it slides and stops again; so it does once more in the other way.
#[test]
fn an_impulse_moves_what_holds() {
    let mut model = point(1.0, 2.0);
    let v = speed(&model, 0);
    push(&mut model, "friction", 0, -(4 * N) * v.sign());
    for (index, impulse) in [3.0, -5.0].into_iter().enumerate() {
        let name = format!("at{index}");
        model.events.push(Event {
            name: name.clone(),
            when: time() - (2.0 + 3.0 * index as f64) * S,
            direction: Direction::Rising,
            action: Action::Record,
        });
        let at = Place::Material(model.bodies[0].cm());
        let force = Vector::planar(impulse * N * S, 0 * N * S);
        model.impulses.push(AppliedImpulse {
            name: format!("kick{index}"),
            body: "p0".into(),
            when: name,
            application: Application::Force { at, force, frame: tumble_mech::Frame::World },
        });
    }
    let run = run(model, 10.0, 1e-13);
    let stops = times(&run, "friction.sticks");
    for (found, expected) in stops.iter().zip([0.5, 2.75, 6.25]) {
        close(*found, expected, 1e-14);
    }
    assert_eq!(stops.len(), 3);
    close(motion(&run, 0, 9.0)[0], 0.5 + 9.0 / 8.0 - 25.0 / 8.0, 1e-13);
    assert_eq!(motion(&run, 0, 9.0)[1], 0.0);
}

/// It holds while it acts, and no longer.
#[test]
fn a_brake_in_a_window() {
    let mut model = point(1.0, 0.0);
    let v = speed(&model, 0);
    push(&mut model, "pull", 0, 2 * N);
    push(&mut model, "friction", 0, -(3 * N) * v.sign());
    model.loads[1] = model.loads[1].clone().during(1 * S, 3 * S);
    let run = run(model, 4.0, 1e-13);
    // 2 m/s at 1 s, less 1 m/s each second: at rest at 3 s, just when it ends.
    close(motion(&run, 0, 2.0)[1], 1.0, 1e-14);
    close(motion(&run, 0, 4.0)[1], 2.0, 1e-13);
    let mut model = point(1.0, 1.0);
    let v = speed(&model, 0);
    push(&mut model, "pull", 0, 2 * N);
    push(&mut model, "friction", 0, -(3 * N) * v.sign());
    model.loads[1] = model.loads[1].clone().during(0 * S, 3 * S);
    let run = common::run(model, 4.0, 1e-13);
    assert_eq!(motion(&run, 0, 2.9), [0.5, 0.0]);
    close(motion(&run, 0, 4.0)[1], 2.0, 1e-14);
}

/// On a spring from a wall, with friction counted from a normal force that a second spring changes with the place.
#[test]
fn friction_by_a_force_that_changes_with_the_place() {
    let mut model = pulled(0.0, 0 * N, 0.0, 0.2, false);
    let block = model.bodies[0].clone();
    model.starts[0].1 = Start::default().at([1 * M, 0.1 * M]);
    let x = block.kinematics().position().x().clone();
    // Along, -k x; upwards, c x: N = m g - c x.
    let (k, c) = (30.0, 4.0);
    model.force("spring", &block.cm(), Vector::planar(-k * N / M * &x, c * N / M * &x));
    let run = run(model, 20.0, 1e-13);
    let stops = times(&run, "rub.sticks");
    assert_eq!(stops.len(), 1, "{:?}", told(&run));
    let [x, v] = motion(&run, 0, 19.0);
    assert!(v == 0.0 && k * x.abs() <= 0.2 * (2.0 * G - c * x), "{x} {v}");
    close(force(&run, "rub", 19.0)[0], k * x, 1e-12);
}

/// On a floor that yields, where the normal force follows from the depth: `v = v0 - mu (vy + g t)`, whatever that force does, until it
/// stops.
#[test]
fn on_a_compliant_floor() {
    let mu = 0.3;
    let mut model = in_gravity();
    let ball = model.add(Body::ball("ball", 0.1 * M).mass(2 * KG));
    let start = Start::default().at([0 * M, 0.1 * M]).velocity([1 * M / S, -0.01 * M / S]);
    model.starts.push(("ball".into(), start));
    let law =
        ContactLaw::Spring { stiffness: 2e4 * N / M, damping: 60 * N * S / M, release: Release::AtZeroForce };
    model.surface(Surface::floor("floor", 0 * M, law));
    let rub = -mu * normal(&model) * speed(&model, 0).sign();
    model.force("rub", &ball.cm(), Vector::planar(rub, 0 * N));
    let run = run(model, 2.0, 1e-12);
    let vy = ball.kinematics().velocity().y().clone();
    let lost = |t: f64| mu * (at(&run, t, [vy.clone()])[0] + 0.01 + G * t);
    for t in [0.01, 0.1, 0.3] {
        close(motion(&run, 0, t)[1], 1.0 - lost(t), 1e-12);
    }
    let stops = times(&run, "rub.sticks");
    assert_eq!(stops.len(), 1, "{:?}", told(&run));
    close(lost(stops[0]), 1.0, 1e-12);
    assert_eq!(motion(&run, 0, 2.0)[1], 0.0);
}
