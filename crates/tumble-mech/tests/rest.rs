//! Motions that end where all bodies have come to rest for good: closed forms, and motions that never do.

use crate::common::{at, close, run};
use tumble_expr::units::{KG, M, N, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{
    Action, Anchor, Body, ContactLaw, Event, Friction, Gravity, Happening, Joint, Load, Model, Place, Run,
    Spring, Start, Surface, time,
};
use tumble_ode::Direction;

/// Of a fall from 1 m in 9.8 m/s^2, s.
const FALL: f64 = 0.451_753_951_452_625_9;

fn floor(e: f64) -> Surface {
    Surface::floor("floor", 0 * M, ContactLaw::Rigid { restitution: Expr::from(e) })
}

fn world() -> Model {
    let gravity = Gravity::Vertical(9.8 * M / (S * S));
    Model { gravity, stops_at_rest: true, ..Model::new() }
}

/// A ball 1 m above the floor.
fn falling(model: &mut Model, name: &str, x: f64, along: f64) {
    let ball = model.add(Body::ball(name, 0.1 * M).mass(2 * KG));
    let start = Start::default().at([x * M, 1.1 * M]).velocity([along * M / S, 0 * M / S]);
    model.starts.push((ball.name, start));
}

fn ends_at_rest(run: &Run) -> bool {
    run.trajectory().events.last().is_some_and(|event| event.record.happened.contains(&Happening::Rest))
}

#[test]
fn bounces_end_where_their_sum_does() {
    let mut model = world();
    falling(&mut model, "ball", 0.0, 0.0);
    model.surface(floor(0.5));
    let run = run(model, 60.0, 1e-12);
    assert!(ends_at_rest(&run));
    close(run.trajectory().end().expect("a motion"), 3.0 * FALL, 1e-14);
    assert_eq!(run.rest_of(0).expect("a value"), run.trajectory().end());
    assert_eq!(
        run.equations
            .names_of(&run.trajectory().events.last().expect("an end").record)
            .last()
            .map(String::as_str),
        Some("rest")
    );
}

#[test]
fn what_rests_first_is_known_beside_what_rests_last() {
    let mut model = world();
    falling(&mut model, "dull", 0.0, 0.0);
    falling(&mut model, "lively", 3.0, 0.0);
    model.bodies[0].restitution = Some(Expr::zero());
    model.surface(floor(0.5));
    let run = run(model, 60.0, 1e-12);
    close(run.rest_of(0).expect("a value").expect("rest"), FALL, 1e-14);
    close(run.rest().expect("a value").expect("rest"), 3.0 * FALL, 1e-14);
    assert!(ends_at_rest(&run));
}

#[test]
fn what_slides_goes_on() {
    let mut model = world();
    falling(&mut model, "ball", 0.0, 1e-3);
    model.surface(floor(0.0));
    let run = run(model, 5.0, 1e-12);
    assert_eq!((run.trajectory().end(), run.rest().expect("a value")), (Some(5.0), None));
}

#[test]
fn a_rod_that_falls_flat_comes_to_rest() {
    let mut model = world();
    let rod = model.add(Body::rod("rod", [-1 * M, 0 * M], [1 * M, 0 * M]).mass(1 * KG));
    model.starts.push((rod.name, Start { angle: Some(0.3.into()), ..Start::default().at([0 * M, 2 * M]) }));
    model.surface(floor(0.2));
    let run = run(model, 60.0, 1e-10);
    assert!(ends_at_rest(&run), "{:?}", run.trajectory().end());
}

/// Forty time constants: what is left is less than rounding, and no instant has taken it.
#[test]
fn what_is_damped_never_rests() {
    let mut model = Model { gravity: Gravity::None, ..world() };
    let ball = model.add(Body::ball("ball", 0.1 * M).mass(1 * KG));
    model.starts.push((ball.name.clone(), Start::default().at([1 * M, 0 * M])));
    let ends = [Anchor::Material(ball.cm()), Anchor::World(Vector::planar(-3 * M, 0 * M))];
    model.interact(Spring {
        name: "spring".into(),
        ends,
        stiffness: 4 * N / M,
        rest_length: 3 * M,
        damping: 2 * KG / S,
    });
    let run = run(model, 40.0, 1e-9);
    assert_eq!((run.trajectory().end(), run.rest().expect("a value")), (Some(40.0), None));
}

#[test]
fn a_force_to_come_ends_no_motion_before_it() {
    let mut model = world();
    falling(&mut model, "ball", 0.0, 0.0);
    model.surface(floor(0.0));
    let ball = model.bodies[0].clone();
    let late = tumble_expr::Expr::from(40) * N * time() / S - 80 * N;
    model.force("lift", &ball.cm(), Vector::planar(0 * N, late));
    let run = run(model, 4.0, 1e-12);
    assert!(!ends_at_rest(&run));
    assert_eq!(run.rest().expect("a value"), None);
}

/// A rod that turns about its centre is caught by a weld.
#[test]
fn a_joint_can_bring_to_rest() {
    let mut model = Model { gravity: Gravity::None, ..world() };
    let rod = model.add(Body::rod("rod", [-1 * M, 0 * M], [1 * M, 0 * M]).mass(1 * KG));
    model.starts.push((rod.name.clone(), Start { omega: Some(2 / (1 * S)), ..Start::default() }));
    model.events.push(Event {
        name: "quarter".into(),
        when: rod.kinematics().angle() - Expr::pi() / 2,
        direction: Direction::Rising,
        action: Action::Record,
    });
    let ends = [Anchor::Material(rod.cm()), Anchor::World(Vector::planar(0 * M, 0 * M))];
    model.join(Joint::weld("catch", ends).from("quarter"));
    let run = run(model, 60.0, 1e-12);
    close(run.trajectory().end().expect("a motion"), std::f64::consts::FRAC_PI_4, 1e-14);
    assert!(ends_at_rest(&run));
}

/// One that lies on the floor from the start, or hangs where nothing pulls, does not put the end off, whichever is named first; and
/// what stops the run before counts.
#[test]
fn what_lies_still_from_the_start_does_not_put_the_end_off() {
    for first in [true, false] {
        let mut model = world();
        let lie = |model: &mut Model| {
            let ball = model.add(Body::ball("lying", 0.1 * M).mass(2 * KG));
            model.starts.push((ball.name, Start::default().at([5 * M, 0.1 * M])));
        };
        if first {
            lie(&mut model);
        }
        falling(&mut model, "ball", 0.0, 0.0);
        if !first {
            lie(&mut model);
        }
        model.surface(floor(0.5));
        let run = run(model, 60.0, 1e-12);
        assert!(run.tracks().len() == 2 && ends_at_rest(&run), "{first}: {:?}", run.end());
        close(run.end().expect("a motion"), 3.0 * FALL, 1e-14);
    }
    let mut model = world();
    falling(&mut model, "ball", 0.0, 0.0);
    falling(&mut model, "other", 3.0, 0.0);
    model.surface(floor(0.5));
    let when = time() - 1 * S;
    model.events.push(Event {
        name: "over".into(),
        when,
        direction: Direction::Rising,
        action: Action::Stop,
    });
    assert_eq!(run(model, 60.0, 1e-12).end(), Some(1.0));
}

/// A mass of 1 kg that 2^20 N press on a floor with mu = 1/2, and 2^19 N pull along it, slips on as it is, however slowly and whatever else happens, and then,
/// with `a` less of the pull, stops after `v/a` and `v^2/(2 a)`. What the load would do to a slip within the shortest
/// step is no measure of it: after two minutes that is 1e-7 m/s.
#[test]
fn a_slow_slip_under_a_large_load_is_no_rest() {
    let [load, less, begins] = [20.0_f64.exp2(), (-33.0_f64).exp2(), 128.0];
    for slip in [-30.0_f64, -34.0, -38.0].map(f64::exp2) {
        let mut model = Model::new();
        let mass = model.add(Body::point("mass").mass(1 * KG));
        model.starts.push(("mass".into(), Start::default().velocity([slip * M / S, 0 * M / S])));
        model.surface(floor(0.0).with_friction(Friction::new(0.5)));
        let mut pushed = |name: &str, force: [f64; 2], [from, to]: [f64; 2]| {
            let force = Vector::planar(force[0] * N, force[1] * N);
            let load = Load::force(name, "mass", Place::Material(mass.cm()), force);
            model.loads.push(load.during(from * S, to * S));
        };
        pushed("press", [0.0, -load], [0.0, 1e3]);
        pushed("pull", [0.5 * load, 0.0], [0.0, 1e3]);
        pushed("drag", [-less, 0.0], [begins, 1e3]);
        let (action, when) = (Action::Record, time() - 64 * S);
        model.events.push(Event { name: "passes".into(), when, direction: Direction::Rising, action });
        let run = run(model, 200.0, 1e-12);
        let motion = mass.kinematics();
        let motion = [motion.position().x().clone(), motion.velocity().x().clone()];
        assert_eq!(at(&run, begins, motion.clone()), [slip * begins, slip]);
        let stop = run.events().last().expect("it stops").time;
        close(stop, begins + slip / less, 1e-15);
        let [place, speed] = at(&run, 200.0, motion);
        close(place / slip, begins + 0.5 * slip / less, 1e-13);
        assert_eq!(speed, 0.0);
    }
}
