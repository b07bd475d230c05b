//! Contacts whose force is zero: what stays, and what is let go of.

use crate::common::{at, close, rigid, run};
use tumble_expr::units::{KG, M, N, S};
use tumble_expr::{Expr, Relation, Vector};
use tumble_mech::{
    Action, Anchor, Body, Event, Extreme, Gravity, Model, Run, Shape, Spring, Start, Surface, time,
};
use tumble_ode::{Direction, Side};

/// A box of 1 kg on a floor, lifted by a force in units of its weight, 10 N, for 1 s.
fn lifted(force: Expr) -> (Run, Body) {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(10 * M / (S * S));
    let shape = Shape::Box { centre: Vector::planar(0 * M, 0 * M), width: 2 * M, height: 1 * M };
    let body = model.add(Body::of_shape("box", shape).mass(1 * KG));
    model.starts.push(("box".into(), Start::default().at([0 * M, 0.5 * M])));
    model.force("lift", &body.cm(), Vector::planar(Expr::zero(), force * 10 * N));
    model.surface(Surface::floor("floor", 0 * M, rigid(0.5)));
    (run(model, 1.0, 1e-9), body)
}

fn height(run: &Run, body: &Body) -> f64 {
    let [height] = at(run, 1.0, [body.kinematics().position().y() - 0.5 * M]);
    height
}

/// It leaves the floor at once, whatever the first power of the time by which the force falls below zero: a floor does not
/// pull.
#[test]
fn a_floor_lets_go_of_what_is_lifted_from_no_force() {
    for power in 1..=4 {
        let (run, body) = lifted(1 + (time() / S).powi(power));
        close(height(&run, &body), 10.0 / f64::from((power + 1) * (power + 2)), 1e-12);
        assert!(run.contacts().iter().all(|contact| contact.end == 0.0), "{power}: {:?}", run.contacts());
    }
}

/// The other way round it is pressed on.
#[test]
fn a_floor_holds_what_is_pressed_on_it_from_no_force() {
    for power in 1..=4 {
        let (run, body) = lifted(1 - (time() / S).powi(power));
        close(height(&run, &body), 0.0, 1e-15);
        assert!(run.contacts().iter().all(|contact| contact.is_open), "{power}: {:?}", run.contacts());
    }
}

/// The force jumps to zero and falls from there, at an instant that is also the end of a step, and at another.
#[test]
fn a_floor_lets_go_where_its_force_jumps_to_zero() {
    for (half, held) in [(0.5, 0.9), (0.3, 0.9), (0.5, 1.0), (0.3, 1.0)] {
        let before = Expr::compare(Relation::Less, time() / S, Expr::from(half));
        let force = Expr::select(before, Expr::from(held), 1 + (time() / S - half));
        let (run, body) = lifted(force);
        close(height(&run, &body), 10.0 * (1.0_f64 - half).powi(3) / 6.0, 1e-12);
    }
}

/// A force that jumps and lifts the box off the floor: just before, the floor pushed by what is left of the weight.
#[test]
fn both_sides_of_a_jump_are_told() {
    let before = Expr::compare(Relation::Less, time() / S, Expr::from(0.5));
    let (run, _) = lifted(Expr::select(before, Expr::from(0.75), Expr::from(2)));
    let pairs = run.equations.pairs();
    let push = Expr::from(pairs[0].force_symbol()) + Expr::from(pairs[1].force_symbol());
    let mut observer = run.observe(std::slice::from_ref(&push)).expect("a formula of the motion");
    let mut at = |time: f64, side: Side| observer.at(time, side).expect("within the motion")[0];
    close(at(0.5, Side::Before), 2.5, 1e-14);
    close(at(0.5, Side::After), 0.0, 1e-14);
    close(at(0.0, Side::After), 2.5, 1e-14);
    let least = run.extreme(&push, Extreme::Least, [0.0, 1.0]).ok().flatten().expect("a value");
    close(least.value, 0.0, 1e-14);
    let event = run.trajectory().events.len() - 1;
    let sides = observer.at_event(event).expect("an event");
    close(sides[0][0], 2.5, 1e-14);
    close(sides[1][0], 0.0, 1e-14);
}

/// What falls on the floor at the very start is fast before it.
#[test]
fn before_an_impact_at_the_start_there_is_the_start() {
    let mut model = Model::new();
    model.starts.push(("ball".into(), Start::default().velocity([0 * M / S, -2 * M / S])));
    let ball = model.add(Body::point("ball").mass(1 * KG));
    model.surface(Surface::floor("floor", 0 * M, rigid(0.5)));
    let run = run(model, 1.0, 1e-9);
    let mut observer = run.observe(&[ball.kinematics().velocity().y().clone()]).expect("a formula");
    assert_eq!(observer.at(0.0, Side::Before), Some(vec![-2.0]));
    assert_eq!(observer.at(0.0, Side::After), Some(vec![1.0]));
}

/// From no force the floor's would jump to a pull.
#[test]
fn a_floor_lets_go_where_its_force_would_jump_from_zero_to_a_pull() {
    for half in [0.5, 0.3] {
        let before = Expr::compare(Relation::Less, time() / S, Expr::from(half));
        let (run, body) = lifted(Expr::select(before, Expr::from(1), Expr::from(2)));
        close(height(&run, &body), 5.0 * (1.0_f64 - half).powi(2), 1e-12);
    }
}

/// A weight without size, so that nothing but its rounding tells a length, is drawn off the floor by a spring that is drawn out at its top: with m
/// y'' = k (u t - y) - m g it leaves at t1 = m g/(k u), with y = u (s - sin(w s)/w) from then on, w^2 = k/m.
#[test]
fn what_has_no_size_stands_until_a_spring_lifts_it() {
    let (m, k, u, g) = (1.3, 21.0, 0.3, 9.81);
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(g * M / (S * S));
    let weight = model.add(Body::point("weight").mass(m * KG));
    let top = Vector::planar(0 * M, 1 * M + u * M / S * time());
    model.interact(Spring {
        name: "spring".into(),
        ends: [Anchor::Material(weight.cm()), Anchor::World(top)],
        stiffness: k * N / M,
        rest_length: 1 * M,
        damping: 0 * KG / S,
    });
    model.surface(Surface::floor("floor", 0 * M, rigid(0.5)));
    let run = run(model, 3.0, 1e-12);
    let left = m * g / (k * u);
    assert!(run.contacts().iter().all(|contact| (contact.end - left).abs() < 1e-12), "{:?}", run.contacts());
    let (w, after) = ((k / m).sqrt(), 3.0 - left);
    let [height] = at(&run, 3.0, [weight.kinematics().position().y().clone()]);
    close(height, u * (after - (w * after).sin() / w), 1e-12);
    let steps = run.trajectory().pieces.len();
    assert!(steps < 50, "{steps} steps");
}

/// A spring between two presses one of them on a wall until it has its length, and draws it off from then on: there its force, its speed and its acceleration
/// are all zero.
#[test]
fn a_wall_lets_go_of_what_a_spring_draws_off_it() {
    let (mut model, mut on) = (Model::new(), vec![]);
    for (name, mass, x) in [("a", 1.0, 0.0), ("b", 2.0, 0.9)] {
        on.push(model.add(Body::point(name).mass(mass * KG)));
        model.starts.push((name.into(), Start::default().at([x * M, 0 * M])));
    }
    model.interact(Spring {
        name: "spring".into(),
        ends: [Anchor::Material(on[0].cm()), Anchor::Material(on[1].cm())],
        stiffness: 100 * N / M,
        rest_length: 1 * M,
        damping: 0 * KG / S,
    });
    let wall = Surface::new("wall", [0 * M, 0 * M], [1.into(), 0.into()], rigid(0.5));
    model.surface(Surface { on: Some(vec!["a".into()]), ..wall });
    // Of both the centre goes on at 2/3 of the speed of b, and they swing about it.
    let left = std::f64::consts::FRAC_PI_2 * 0.02_f64.sqrt();
    let speed = 0.1 * 50.0_f64.sqrt();
    let expected = 2.0 / 3.0 * speed * (1.0 - (150.0_f64.sqrt() * (1.0 - left)).cos());
    for digits in 5..=13 {
        let accuracy = 10_f64.powi(-digits);
        let run = run(model.clone(), 1.0, accuracy);
        let [velocity] = at(&run, 1.0, [on[0].kinematics().velocity().x().clone()]);
        close(velocity, expected, 10.0 * accuracy);
        for contact in run.contacts() {
            close(contact.end, left, 10.0 * accuracy);
        }
    }
}

/// What an impact at the very start makes happen stops the motion there, before any step.
#[test]
fn a_motion_may_stop_where_it_starts() {
    let mut model = Model::new();
    model.starts.push(("ball".into(), Start::default().velocity([0 * M / S, -2 * M / S])));
    let ball = model.add(Body::point("ball").mass(1 * KG));
    model.surface(Surface::floor("floor", 0 * M, rigid(0.5)));
    let when = ball.kinematics().velocity().y().clone();
    let (direction, action) = (Direction::Rising, Action::Stop);
    model.events.push(Event { name: "up".into(), when: when.clone(), direction, action });
    let run = run(model, 1.0, 1e-9);
    assert_eq!((run.trajectory().end(), run.trajectory().pieces.len()), (Some(0.0), 0));
    let mut observer = run.observe(&[when]).expect("a formula");
    assert_eq!(observer.at(0.0, Side::Before), Some(vec![-2.0]));
    assert_eq!(observer.at(0.0, Side::After), Some(vec![1.0]));
}

/// A ball that just fits between two walls is pressed on one of them and then on the other, again and again, and moves freely between them.
#[test]
fn what_fits_between_two_walls_passes_from_one_to_the_other() {
    for gravity in [0.0, 9.81] {
        let mut model = Model::new();
        model.gravity = Gravity::Vertical(gravity * M / (S * S));
        let disk = model.add(Body::ball("ball", 0.5 * M).mass(1.3 * KG));
        model.starts.push(("ball".into(), Start::default().at([0.5 * M, 0.5 * M])));
        let push = [7 * N * (3.1 * time() / S).sin(), 0.3 * N * (2 * time() / S).cos()];
        model.force("push", &disk.cm(), Vector::planar(push[0].clone(), push[1].clone()));
        for (name, x, way) in [("left", 0.0, 1.0), ("right", 1.0, -1.0)] {
            model.surface(Surface::new(name, [x * M, 0 * M], [way.into(), 0.into()], rigid(0.5)));
        }
        let run = run(model, 5.0, 1e-9);
        let [x, fallen] = at(
            &run,
            5.0,
            [disk.kinematics().position().x().clone(), disk.kinematics().velocity().y().clone()],
        );
        close(x, 0.5, 1e-14);
        close(fallen, 0.3 / (2.0 * 1.3) * 10.0_f64.sin() - 5.0 * gravity, 1e-12);
        assert!(run.events().count() < 10, "{} events", run.events().count());
    }
}
