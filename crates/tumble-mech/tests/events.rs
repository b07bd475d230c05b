//! Declared events: none is missed, each is where an independent search finds it, and their actions follow.

use crate::common::{at, close, run};
use proptest::prelude::*;
use tumble_expr::units::{KG, M, N, RAD, S};
use tumble_expr::{Expr, Relation, Vector};
use tumble_mech::{
    Action, Body, ContactLaw, Event, Gravity, Happening, Load, Model, Moment, Place, Start, Surface, time,
};
use tumble_ode::Direction;

/// What the runs are asked for, and so what an event's function may be off by at its event: it is of size 1.
const ACCURACY: f64 = 1e-9;
/// Points of the dense search in a run.
const DENSE: usize = 200_000;

/// A pendulum with a ball on a spring of its own, both in gusts, with a few numbers drawn at random.
fn random_model([angle, omega, drag, wind, period, stiffness]: [f64; 6]) -> (Model, Body) {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(9.81 * M / (S * S));
    let rod = model.add(Body::rod("rod", [0 * M, 0 * M], [0 * M, -1 * M]).mass(1 * KG));
    model.pivot(&rod, [0 * M, 0 * M]);
    let gust = wind * M / S * (2 * Expr::pi() * time() / (period * S)).sin();
    let u = gust * rod.kinematics().angle().cos() - 1 * M * rod.kinematics().omega();
    model.torque("air", &rod, drag * KG * (u.abs() * u));
    let spring = stiffness * KG * M * M / (S * S);
    model.torque("wire", &rod, -(spring * rod.kinematics().angle()));
    model.starts.push(("rod".into(), Start::default().angle(angle * RAD).omega(omega * RAD / S)));
    (model, rod)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    /// Zeros of three functions of the motion, against all changes of sign on a grid of two hundred thousand points.
    #[test]
    fn no_event_is_missed(
        start in (-3.0f64..3.0, -6.0f64..6.0),
        air in (0.0f64..0.05, 0.0f64..20.0, 0.3f64..4.0),
        stiffness in 0.0f64..20.0,
        level in -1.0f64..1.0,
    ) {
        let (mut model, rod) = random_model([start.0, start.1, air.0, air.1, air.2, stiffness]);
        let k = rod.kinematics();
        let watched = [
            k.angle() - level,
            k.omega() * S_INVERSE - level,
            (k.angle() * 3).sin() - 0.9 * (7 * time() / (1 * S)).cos(),
        ];
        for (index, when) in watched.iter().enumerate() {
            let name = format!("e{index}");
            let (when, direction) = (when.clone(), Direction::Both);
            model.events.push(Event { name, when, direction, action: Action::Record });
        }
        let until = 10.0;
        let run = run(model, until, ACCURACY);
        let mut observer = run.observe(&watched).expect("typed");
        let values: Vec<Vec<f64>> = (0..=DENSE)
            .map(|i| observer.at(until * i as f64 / DENSE as f64, tumble_ode::Side::After).expect("inside"))
            .collect();
        for index in 0..watched.len() {
            let dense: Vec<usize> =
                (0..DENSE).filter(|i| values[*i][index] * values[i + 1][index] < 0.0).collect();
            let name = format!("e{index}");
            let named = run.trajectory().events.iter().filter(|event| event.record.happened.contains(&Happening::Event(index)));
            let found: Vec<f64> = named.map(|event| event.time).collect();
            // Two zeros within a cell of the grid are the located ones' to find, not the grid's.
            let cell = |t: f64| (t / until * DENSE as f64) as usize;
            for i in &dense {
                prop_assert!(found.iter().any(|t| cell(*t).abs_diff(*i) <= 1), "{} at cell {}", name, i);
            }
            for t in &found {
                let near = at(&run, *t, [watched[index].clone()])[0];
                prop_assert!(near.abs() < ACCURACY, "{} is {:e} at its event", name, near);
            }
            prop_assert!(found.len() >= dense.len());
            prop_assert_eq!((found.len() - dense.len()) % 2, 0);
        }
    }
}

/// A unit that makes an angular rate a pure number.
const S_INVERSE: tumble_expr::Unit = S;

/// A ball thrown up at 10 m/s; the apex is where vy falls through zero.
fn thrown(action: Action) -> (Model, Body) {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(10 * M / (S * S));
    let ball = model.add(Body::point("ball").mass(1 * KG));
    let when = ball.kinematics().velocity()[1].clone();
    model.events.push(Event { name: "apex".into(), when, direction: Direction::Falling, action });
    let start = Start::default().at([0 * M, 0 * M]).velocity([2 * M / S, 10 * M / S]);
    model.starts.push(("ball".into(), start));
    (model, ball)
}

#[test]
fn an_event_is_recorded_and_changes_nothing() {
    let (model, ball) = thrown(Action::Record);
    let run = run(model, 3.0, 1e-9);
    let event = &run.trajectory().events[0];
    assert_eq!((event.time, &event.record.happened[..]), (1.0, &[Happening::Event(0)][..]));
    assert_eq!(event.before, event.after);
    close(at(&run, 3.0, [ball.kinematics().position()[1].clone()])[0], -15.0, 1e-15);
}

/// Steps of a motion that nothing is known of are an eighth of it: what happens at their ends is seen, and once.
#[test]
fn what_happens_at_the_end_of_a_step_is_an_event() {
    for accuracy in [1e-6, 1e-9, 1e-12] {
        let mut model = Model::new();
        let ball = model.add(Body::point("ball").mass(1 * KG));
        model.starts.push(("ball".into(), Start::default().velocity([1 * M / S, 0 * M / S])));
        // A force that keeps the motion from being a polynomial, and has no limit to the reach of a step.
        let late = Expr::compare(Relation::Less, time() / S, Expr::from(0.6));
        let force = Expr::select(late, Expr::zero(), (time() / S).sin()) * N;
        model.force("late", &ball.cm(), Vector::planar(Expr::zero(), force));
        let x = ball.kinematics().position()[0].clone();
        for place in [0.125, 0.25, 0.3, 0.375, 0.5, 1.0] {
            let when = &x - place * M;
            let action = Action::Record;
            model.events.push(Event { name: place.to_string(), when, direction: Direction::Rising, action });
        }
        let run = run(model, 1.0, accuracy);
        let times: Vec<f64> = run.trajectory().events.iter().map(|event| event.time).collect();
        assert_eq!(times, [0.125, 0.25, 0.3, 0.375, 0.5, 1.0], "{accuracy}");
    }
}

/// What begins at a value has not passed it, also where it stayed there for a while.
#[test]
fn what_leaves_a_value_has_not_passed_it() {
    for push in [1.0, -1.0] {
        let mut model = Model::new();
        let ball = model.add(Body::point("ball").mass(1 * KG));
        let late = Expr::compare(Relation::Less, time() / S, Expr::from(0.75));
        let force = Expr::select(late, Expr::zero(), push * (time() / S).cos()) * N;
        model.force("late", &ball.cm(), Vector::planar(force, 0 * N));
        let when = ball.kinematics().velocity()[0].clone();
        let (direction, action) = (Direction::Both, Action::Record);
        model.events.push(Event { name: "moves".into(), when, direction, action });
        assert!(run(model, 1.0, 1e-9).trajectory().events.is_empty(), "{push}");
    }
}

/// A formula with a branch jumps over zero without crossing it, or touches it and turns back.
#[test]
fn a_jump_is_an_event_and_a_touch_is_none() {
    let fires = |when: fn(Expr) -> Expr, direction| {
        let (mut model, ball) = thrown(Action::Record);
        let when = when(ball.kinematics().velocity()[1].clone());
        model.events = vec![Event { name: "e".into(), when, direction, action: Action::Record }];
        let run = run(model, 3.0, 1e-9);
        run.trajectory().events.iter().map(|event| event.time).collect::<Vec<f64>>()
    };
    assert_eq!(fires(|v| v.sign(), Direction::Falling), [1.0]);
    assert_eq!(fires(|v| v.sign(), Direction::Rising), [] as [f64; 0]);
    assert_eq!(fires(|v| v.step() - 0.5, Direction::Both), [1.0]);
    assert_eq!(fires(|v| v.abs(), Direction::Both), [] as [f64; 0]);
    assert_eq!(fires(|v| &v * &v, Direction::Both), [] as [f64; 0]);
    assert_eq!(fires(|v| v.abs() * &v, Direction::Falling), [1.0]);
}

/// What an impact or the start of a force carries across zero has crossed it; what it leaves at zero has not.
#[test]
fn a_jump_of_the_motion_is_an_event() {
    let times = |e: f64, when: fn(&Body) -> Expr, direction| {
        let mut model = Model::new();
        model.gravity = Gravity::Vertical(10 * M / (S * S));
        let ball = model.add(Body::point("ball").mass(1 * KG));
        model.starts.push(("ball".into(), Start::default().at([0 * M, 5 * M])));
        model.surface(Surface::floor("floor", 0 * M, ContactLaw::Rigid { restitution: e.into() }));
        let push = Vector::planar(2 * N, 0 * N);
        let gust = Load::force("gust", "ball", Place::Material(ball.cm()), push);
        model.loads.push(gust.during(Moment::Time(0.5 * S), Moment::Time(0.6 * S)));
        model.events = vec![Event { name: "e".into(), when: when(&ball), direction, action: Action::Record }];
        let run = run(model, 3.5, 1e-9);
        let own = run
            .trajectory()
            .events
            .iter()
            .filter(|event| event.record.happened.contains(&Happening::Event(0)));
        own.map(|event| (event.time * 1e6).round() / 1e6).collect::<Vec<f64>>()
    };
    let vy = |ball: &Body| ball.kinematics().velocity().y().clone();
    // It falls for 1 s, bounces to a quarter of the height, which takes 1 s, and to a sixteenth, which takes half of it.
    assert_eq!(times(0.5, vy, Direction::Rising)[..3], [1.0, 2.0, 2.5]);
    assert_eq!(times(0.5, vy, Direction::Falling)[..2], [1.5, 2.25]);
    assert_eq!(times(0.0, vy, Direction::Both), [] as [f64; 0]);
    let ax = |ball: &Body| ball.kinematics().acceleration().x() - 1 * M / (S * S);
    assert_eq!(times(1.0, ax, Direction::Rising), [0.5]);
    assert_eq!(times(1.0, ax, Direction::Falling), [0.6]);
}

/// A watched formula that has no value beyond some instant ends the run there, by name, and does not hang it.
#[test]
fn a_singular_event_is_refused() {
    for when in [|y: Expr| 1 / y, |y: Expr| (y / M).log(), |y: Expr| (y / M).sqrt()] {
        let mut model = Model::new();
        let ball = model.add(Body::point("ball").mass(1 * KG));
        let when = when(ball.kinematics().position()[1].clone());
        model.events.push(Event {
            name: "e".into(),
            when,
            direction: Direction::Falling,
            action: Action::Record,
        });
        let start = Start::default().at([0 * M, 1 * M]).velocity([0 * M / S, -1 * M / S]);
        model.starts.push(("ball".into(), start));
        let error = model.simulate(&[], 2 * S).map(|_| ()).map_err(|error| error.to_string());
        let text = error.expect_err("singular at 1 s");
        assert!(text.contains("stopped at t = ") && text.contains("event e"), "{text}");
    }
}

#[test]
fn an_event_stops_the_motion() {
    let (model, _) = thrown(Action::Stop);
    let run = run(model, 3.0, 1e-9);
    assert_eq!(run.trajectory().end(), Some(1.0));
    assert_eq!(run.trajectory().events.len(), 1);
}

#[test]
fn an_event_changes_a_parameter() {
    let (mut model, ball) = thrown(Action::Set(vec![("g".into(), 2 * M / (S * S))]));
    let g = model.parameters.set("g", 10 * M / (S * S)).expect("typed");
    model.gravity = Gravity::Vertical(g);
    let run = run(model, 3.0, 1e-9);
    let [y, vy] =
        at(&run, 3.0, [ball.kinematics().position()[1].clone(), ball.kinematics().velocity()[1].clone()]);
    // Up 5 m in 1 s, then down 2 m/s^2 for 2 s.
    close(y, 5.0 - 4.0, 1e-15);
    close(vy, -4.0, 1e-15);
    assert_eq!(run.trajectory().work.exact_steps, 2);
}

#[test]
fn a_window_opens_and_closes_at_events() {
    let (mut model, ball) = thrown(Action::Record);
    let when = ball.kinematics().position()[0].clone() - 4 * M;
    let direction = Direction::Rising;
    model.events.push(Event { name: "far".into(), when, direction, action: Action::Record });
    let push = Load::force("push", "ball", Place::Material(ball.cm()), Vector::planar(Expr::zero(), 10 * N));
    model.loads.push(push.during(Moment::Event("apex".into()), Moment::Event("far".into())));
    let run = run(model, 3.0, 1e-9);
    let events = run.trajectory().events.iter();
    let names: Vec<String> = events.flat_map(|event| run.equations.names_of(&event.record)).collect();
    assert_eq!(names, ["apex", "push.start", "far", "push.end"]);
    // Weightless from 1 s to 2 s, at the height of 5 m.
    let [y] = at(&run, 3.0, [ball.kinematics().position()[1].clone()]);
    close(y, 0.0, 1e-14);
}
