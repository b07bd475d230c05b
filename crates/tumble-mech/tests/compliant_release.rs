//! Where damped compliant contacts let go because what they touch is taken away faster than they follow; closed forms, and no energy gained.

use crate::common::{at, balanced, close, run};
use tumble_expr::units::{KG, M, N, S};
use tumble_expr::{Exponent, Expr, Vector};
use tumble_mech::{
    Action, Application, AppliedImpulse, Body, Change, ContactLaw, Event, Frame, Friction, Gravity,
    Happening, Load, Model, Place, Release, Run, Start, Surface, time,
};
use tumble_ode::Direction;

const MASS: f64 = 0.5;
const SPEED: f64 = 2.0;
const STIFFNESS: f64 = 1e5;

fn hertz(damping: f64) -> ContactLaw {
    let root = (1 * M).powr(Exponent::new(3, 2));
    ContactLaw::Hertz { stiffness: STIFFNESS * N / root, damping: damping * S / M }
}

fn spring(damping: f64) -> ContactLaw {
    let release = Release::AtZeroForce;
    ContactLaw::Spring { stiffness: STIFFNESS * N / M, damping: damping * N * S / M, release }
}

/// A ball that comes to touch the floor with 2 m/s at 0.01 s, without weight.
fn coming(law: ContactLaw) -> (Model, Body) {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(0 * M / (S * S));
    let ball = model.add(Body::ball("ball", 0.1 * M).mass(MASS * KG));
    let start = Start::default().at([0 * M, (0.1 + 0.01 * SPEED) * M]).velocity([0 * M / S, -SPEED * M / S]);
    model.starts.push(("ball".into(), start));
    model.surface(Surface::floor("floor", 0 * M, law));
    (model, ball)
}

/// Depth and velocity out of the floor.
fn motion(run: &Run, time: f64) -> [f64; 2] {
    let pair = &run.equations.pairs()[0];
    at(run, time, [-pair.gap(), pair.gap_rate()])
}

fn force(run: &Run, time: f64) -> f64 {
    at(run, time, [run.equations.pairs()[0].force_symbol().into()])[0]
}

fn times(run: &Run, change: Change) -> Vec<f64> {
    let is_it =
        |happening: &Happening| matches!(happening, Happening::Contact { change: own, .. } if *own == change);
    run.events().filter(|event| event.record.happened.iter().any(is_it)).map(|event| event.time).collect()
}

/// A force out of the floor, N, in a time.
fn pull(model: &mut Model, ball: &Body, name: &str, force: Expr, [from, to]: [f64; 2]) {
    let force = Vector::planar(0 * N, force);
    model.loads.push(Load::force(name, "ball", Place::Material(ball.cm()), force).during(from * S, to * S));
}

/// A blow out of the floor, N s, at a time.
fn kick(model: &mut Model, ball: &Body, when: f64, impulse: f64) {
    let (name, when) = ("kick".to_owned(), time() - when * S);
    model.events.push(Event {
        name: name.clone(),
        when,
        direction: Direction::Rising,
        action: Action::Record,
    });
    let force = Vector::planar(0 * N * S, impulse * N * S);
    let application = Application::Force { at: Place::Material(ball.cm()), force, frame: Frame::World };
    model.impulses.push(AppliedImpulse { name: "blow".into(), body: "ball".into(), when: name, application });
}

/// What the floor does is taken away by a load that reads its force, so that the ball comes in and goes out evenly accelerated: with c that force
/// ends at the speed 1/c, though it is still in, and from there on there is none. Where the ball is never so fast it ends at the surface.
#[test]
fn hunt_and_crossley_let_go_at_the_speed_that_ends_the_force() {
    let (out, gap) = (200.0, 0.02);
    for damping in [0.4, 0.8, 3.0] {
        let (mut model, ball) = coming(hertz(damping));
        let first = -(SPEED * SPEED + 2.0 * out * gap).sqrt();
        model.starts[0].1.velocity = Some(Vector::planar(0 * M / S, first * M / S));
        let normal: Expr = model.pairs()[0].force_symbol().into();
        pull(&mut model, &ball, "pull", MASS * out * N - normal, [0.0, 1.0]);
        let run = run(model, 0.1, 1e-13);
        let begin = (-first - SPEED) / out;
        let clear = begin + 2.0 * SPEED / out;
        let since = (SPEED + 1.0 / damping) / out;
        if 1.0 / damping > SPEED {
            assert!(times(&run, Change::Clear).is_empty());
            close(times(&run, Change::End)[0], clear, 1e-13);
            continue;
        }
        close(times(&run, Change::End)[0], begin + since, 1e-13);
        close(times(&run, Change::Clear)[0], clear, 1e-13);
        let depth = |t: f64| SPEED * t - 0.5 * out * t * t;
        for (part, pushes) in [(0.3, true), (0.9, true), (1.01, false), (1.1, false)] {
            let t = part * since;
            let [found, rate] = motion(&run, begin + t);
            close(found, depth(t), 1e-14);
            let expected = STIFFNESS * depth(t).powf(1.5) * (1.0 - damping * rate);
            close(force(&run, begin + t), if pushes { expected } else { 0.0 }, 1e-10);
        }
        balanced(&run, 1e-12);
    }
}

/// Pulled out by a force that does not end it goes on from where it is let go with that force alone: `v^2 = 1/c^2 + 2 F d/m` at the surface.
#[test]
fn what_is_let_go_of_is_pulled_on_by_others_alone() {
    let (damping, out) = (2.0, 4000.0);
    let (mut model, ball) = coming(hertz(damping));
    pull(&mut model, &ball, "pull", MASS * out * N, [0.011, 1.0]);
    let run = run(model, 0.1, 1e-13);
    let [released, clear] = [Change::End, Change::Clear].map(|change| {
        let times = times(&run, change);
        assert_eq!(times.len(), 1, "{times:?}");
        times[0]
    });
    let ([depth, rate], [_, end]) = (motion(&run, released), motion(&run, clear));
    close(rate, 1.0 / damping, 1e-13);
    assert!(depth > 1e-4, "{depth}");
    close(end * end, rate * rate + 2.0 * out * depth, 1e-12);
    balanced(&run, 1e-12);
}

/// Held up again while it is still in, the floor pushes from where it parts slower than 1/c. No energy comes of it: with what the floor would
/// store at that depth it only falls.
#[test]
fn what_is_slower_again_is_pushed_again_and_gains_nothing() {
    let (damping, out) = (2.0, 4000.0);
    let (mut model, ball) = coming(hertz(damping));
    pull(&mut model, &ball, "pull", MASS * out * N, [0.011, 0.01165]);
    pull(&mut model, &ball, "back", -0.8 * MASS * out * N, [0.01165, 0.0118]);
    let run = run(model, 0.1, 1e-13);
    let [released, again] = [Change::End, Change::Start].map(|change| times(&run, change));
    assert!(again.len() == 2 && released.len() == 2, "{released:?} {again:?}");
    close(motion(&run, again[1])[1], 1.0 / damping, 1e-12);
    let energy = |t: f64| {
        let [depth, rate] = motion(&run, t);
        0.5 * MASS * rate * rate + 0.4 * STIFFNESS * depth.max(0.0).powf(2.5)
    };
    let free: Vec<f64> = (0..200).map(|step| 0.0118 + 1e-5 * f64::from(step)).map(energy).collect();
    assert!(free.windows(2).all(|pair| pair[1] <= pair[0] * (1.0 + 1e-13)), "{free:?}");
    balanced(&run, 1e-12);
}

/// A blow that sends it out faster than the floor can follow ends the force at once, with any damped law; one that sends it in again while
/// it is in begins it.
#[test]
fn a_blow_ends_and_begins_a_force_at_once() {
    for (law, rubs) in
        [(hertz(2.0), false), (hertz(2.0), true), (spring(300.0), false), (spring(300.0), true)]
    {
        let (mut model, ball) = coming(law);
        if rubs {
            let floor = model.surfaces[0].clone();
            model.surfaces[0] = floor.with_friction(Friction::new(0.3));
            model.starts[0].1.velocity = Some(Vector::planar(0.7 * M / S, -SPEED * M / S));
        }
        kick(&mut model, &ball, 0.011, MASS * 8.0);
        let run = run(model, 0.1, 1e-13);
        let speed = motion(&run, 0.011)[1];
        assert_eq!(times(&run, Change::End), [0.011]);
        assert!(motion(&run, 0.0111)[0] > 0.0 && force(&run, 0.0111) == 0.0);
        close(motion(&run, 0.1)[1], speed, 1e-14);
        balanced(&run, 1e-12);
    }
}
