//! Bodies that an event reads together, or acts on, and nothing else couples: each is a motion of its own while no such event is near,
//! and what happens is what happens to them as one.

use std::ops::ControlFlow;

use crate::common::as_one;
use tumble_expr::units::{KG, M, N, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{
    Action, Anchor, Application, AppliedImpulse, Body, ContactLaw, Event, Frame, Gravity, Joint, Load, Model,
    Moment, Place, Run, Start, Surface, Trust,
};
use tumble_ode::{Accuracy, Direction, Side};

const GRAVITY: f64 = 10.0;

fn ball(model: &mut Model, name: &str, height: f64, velocity: [f64; 2]) -> Body {
    let ball = model.add(Body::point(name).mass(1 * KG));
    let velocity = velocity.map(|component| component * M / S);
    model.starts.push((name.into(), Start::default().at([0 * M, height * M]).velocity(velocity)));
    ball
}

/// Balls that bounce.
fn bouncing(heights: &[f64], restitution: f64) -> (Model, Vec<Body>) {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(GRAVITY * M / (S * S));
    let balls = heights.iter().enumerate();
    let balls = balls.map(|(index, height)| ball(&mut model, &format!("ball{index}"), *height, [0.0, 0.0]));
    let balls = balls.collect();
    model.surface(Surface::floor("floor", 0 * M, ContactLaw::Rigid { restitution: restitution.into() }));
    (model, balls)
}

fn event(model: &mut Model, name: &str, when: Expr, direction: Direction, action: Action) {
    model.events.push(Event { name: name.into(), when, direction, action });
}

fn height(body: &Body) -> Expr {
    body.kinematics().position().y().clone()
}

fn rate(body: &Body) -> Expr {
    body.kinematics().velocity().y().clone()
}

fn trusted(model: &Model, until: f64) -> (Run, Trust) {
    let go = |_| ControlFlow::Continue(());
    Run::trusted(model, &model.parameters, until, Accuracy::DEFAULT, go)
        .unwrap_or_else(|error| panic!("{error}"))
}

fn told(run: &Run) -> Vec<(f64, Vec<String>)> {
    let mut all: Vec<(f64, Vec<String>)> = vec![];
    for event in run.events() {
        let names = run.equations.names_of(&event.record);
        match all.last_mut() {
            // What a jump of one makes happen is told of with it.
            Some((time, known)) if *time == event.time => known.extend(names),
            _ => all.push((event.time, names)),
        }
    }
    all.iter_mut().for_each(|(_, names)| names.sort());
    all
}

/// Runs a model in islands and as one; both must tell the same, within what is stated.
fn both(model: &Model, until: f64) -> [(Run, Trust); 2] {
    let [apart, whole] = [trusted(model, until), trusted(&as_one(model), until)];
    let [first, second] = [told(&apart.0), told(&whole.0)];
    assert_eq!(first.len(), second.len(), "{first:?}\n{second:?}");
    for ((time, names), (other, same)) in first.iter().zip(&second) {
        assert_eq!(names, same, "at {time} s and {other} s");
        let error = |(run, trust): &(Run, Trust), time: f64| trust.event_error(run, time).expect("known");
        let stated = error(&apart, *time) + error(&whole, *other);
        assert!((time - other).abs() <= stated, "{names:?}: {time} {other} {stated}");
    }
    for body in 0..model.bodies.len() {
        let kinematics = model.bodies[body].kinematics();
        let place = kinematics.position();
        for formula in [place.x(), place.y(), &kinematics.angle()] {
            for time in [0.3, 0.7, 1.0].map(|part| part * until) {
                let at = tumble_mech::At { time, side: Side::Before, off: 0.0 };
                let [(here, error), (there, other)] = [&apart, &whole].map(|(run, trust)| {
                    let value =
                        run.observe(std::slice::from_ref(formula)).expect("a formula").at(time, Side::Before);
                    let error = trust.error_at(run, formula, at).expect("a formula");
                    (value.map(|value| value[0]), error)
                });
                let (Some(here), Some(there)) = (here, there) else { continue };
                let stated = error.expect("known") + other.expect("known");
                assert!((here - there).abs() <= stated, "body {body} at {time} s: {here} {there} {stated}");
            }
        }
    }
    [apart, whole]
}

#[test]
fn an_event_of_two_is_located_as_in_one_motion() {
    let (mut model, balls) = bouncing(&[1.0, 0.6], 0.9);
    let difference = height(&balls[0]) - height(&balls[1]);
    event(&mut model, "passes", difference, Direction::Both, Action::Record);
    let [(run, _), _] = both(&model, 3.0);
    assert!(run.tracks().len() > 4, "{}", run.tracks().len());
    // The upper one passes the lower one, which comes up: h - g t^2/2 = e g t_1 (t - t_1) - g (t - t_1)^2/2.
    let first = (2.0 * 0.6 / GRAVITY).sqrt();
    let up = 0.9 * GRAVITY * first;
    let meet = (1.0 + up * first + GRAVITY * first * first / 2.0) / (up + GRAVITY * first);
    let passes = told(&run).into_iter().find(|(_, names)| names.iter().any(|name| name == "passes"));
    assert!((passes.expect("they pass").0 - meet).abs() < 1e-14);
}

#[test]
fn bodies_that_stay_on_an_edge_are_one_motion() {
    // The function is zero all along, and along the first fall.
    for heights in [[0.8, 0.8], [0.8, 0.8 + 1e-15]] {
        let (mut model, balls) = bouncing(&heights, 0.8);
        event(&mut model, "passes", height(&balls[0]) - height(&balls[1]), Direction::Both, Action::Record);
        let (run, _) = trusted(&model, 1.0);
        assert_eq!(run.end(), Some(1.0));
    }
}

#[test]
fn a_jump_of_one_carries_what_reads_both_across_zero() {
    let (mut model, balls) = bouncing(&[1.0, 0.5], 0.8);
    // At one velocity all the way the function would be zero before the first bounce.
    model.starts[0].1 = Start::default().at([0 * M, 1 * M]).velocity([0 * M / S, 1 * M / S]);
    for name in ["turned", "again"] {
        event(&mut model, name, rate(&balls[0]) - rate(&balls[1]), Direction::Both, Action::Record);
    }
    let [(run, _), _] = both(&model, 1.2);
    let bounce = (2.0 * 0.5 / GRAVITY).sqrt();
    let first = told(&run).into_iter().next().expect("a bounce");
    assert!((first.0 - bounce).abs() < 1e-15);
    assert!(["turned", "again"].iter().all(|name| first.1.contains(&(*name).to_owned())), "{first:?}");
}

#[test]
fn what_events_do_to_others_is_done() {
    let (mut model, balls) = bouncing(&[1.0, 0.5, 2.0], 0.7);
    let low = height(&balls[0]) - 0.25 * M;
    event(&mut model, "low", low, Direction::Falling, Action::Record);
    let at = Place::FromCentre(Vector::planar(0 * M, 0 * M));
    let kick = Vector::planar(0 * N * S, rate(&balls[0]) * (0.5 * KG));
    model.impulses.push(AppliedImpulse {
        name: "kick".into(),
        body: "ball1".into(),
        when: "low".into(),
        application: Application::Force { at: at.clone(), force: kick, frame: Frame::World },
    });
    let lift = Load::force("lift", "ball2", at, Vector::planar(0 * N, 14 * N));
    model.loads.push(lift.during(Moment::Event("low".into()), Moment::Time(1.3 * S)));
    both(&model, 2.0);
}

#[test]
fn parameters_that_an_event_sets_are_set_for_all() {
    let (mut model, balls) = bouncing(&[1.0, 0.5, 0.7], 0.8);
    let push = model.parameters.set("push", 1 * N).expect("a force");
    for (index, ball) in balls.iter().enumerate() {
        model.force(format!("push{index}"), &ball.cm(), Vector::planar(push.clone(), 0 * N));
    }
    let set = Action::Set(vec![("push".into(), 3 * N)]);
    event(&mut model, "low", height(&balls[1]) - 0.2 * M, Direction::Falling, set);
    let [(run, _), _] = both(&model, 1.5);
    assert!(run.tracks().len() > 3);
}

/// A bullet sticks in a hanging rod, and flies off again where the rod has turned back.
#[test]
fn a_capture_joins_and_a_release_parts() {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(GRAVITY * M / (S * S));
    let rod = model.add(Body::rod("rod", [0 * M, 0 * M], [0 * M, -1 * M]).mass(2 * KG));
    model.pivot(&rod, [0 * M, 0 * M]);
    let bullet = model.add(Body::point("bullet").mass(0.02 * KG));
    let fly = Start::default().at([-1 * M, -0.7 * M]).velocity([80 * M / S, 0.1 * M / S]);
    model.starts.push(("bullet".into(), fly));
    let place = bullet.kinematics().position();
    let angle = rod.kinematics().angle();
    event(&mut model, "hit", place.x().clone(), Direction::Rising, Action::Record);
    event(&mut model, "back", angle - 0.1, Direction::Falling, Action::Record);
    let cm = Anchor::Material(bullet.cm());
    let stick = Joint::weld("stick", [cm.clone(), cm]).seated_on(&rod.kinematics());
    model.join(stick.from("hit").until("back"));
    let [(run, _), _] = both(&model, 1.5);
    let joints = told(&run).into_iter().filter(|(_, names)| names.iter().any(|name| name.contains("stick")));
    assert_eq!(joints.count(), 2);
    let balance = tumble_mech::RunBalance::of(&run, [0.0; 2]).expect("a balance");
    assert!(balance.relative() < 1e-12, "{}", balance.relative());
}

#[test]
fn one_of_them_may_end_all_or_be_refused() {
    let (mut model, balls) = bouncing(&[1.0, 0.6], 0.9);
    let meet = height(&balls[0]) - height(&balls[1]);
    event(&mut model, "passes", meet, Direction::Falling, Action::Stop);
    let [(run, _), _] = both(&model, 3.0);
    assert!(run.end().expect("an end") < 1.0 && run.ends_at_event());

    let (mut model, balls) = bouncing(&[1.0, 0.6], 0.9);
    event(&mut model, "passes", height(&balls[0]) - height(&balls[1]), Direction::Both, Action::Record);
    let force = ((height(&balls[1]) / (1 * M)) - 0.1).log() * 1e-3 * N;
    model.force("pull", &balls[1].cm(), Vector::planar(force, 0 * N));
    match model.simulate(&[], 3 * S) {
        Err(tumble_mech::RunError::Refused { refusal, partial }) => {
            assert!(refusal.to_string().contains("ball1"), "{refusal}");
            let fall = (2.0 * (0.6 - 0.1) / GRAVITY).sqrt();
            assert!((refusal.time - fall).abs() < 1e-3 && partial.end() <= Some(refusal.time));
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn all_come_to_rest() {
    let (mut model, balls) = bouncing(&[1.0, 0.6, 0.3], 0.5);
    event(&mut model, "passes", height(&balls[0]) - height(&balls[1]), Direction::Both, Action::Record);
    model.stops_at_rest = true;
    let (run, trust) = trusted(&model, 20.0);
    // From the fall and all bounces: sqrt(2 h/g) (1 + e)/(1 - e).
    let rest = 3.0 * (2.0 * 1.0 / GRAVITY).sqrt();
    assert!((run.end().expect("an end") - rest).abs() < 1e-14, "{:?}", run.end());
    assert!(trust.horizon.is_none());
}

/// A ball is tossed about by a force that no digits survive; another, whose height an event compares with its, keeps its own.
#[test]
fn digits_end_body_by_body() {
    let (mut model, balls) = bouncing(&[1.0, 0.6], 0.9);
    // Over hills that shake: the motion is chaotic.
    let (place, shake) =
        (balls[1].kinematics().position().x() / (0.1 * M), 80 * tumble_mech::time() / (1 * S));
    let force = 2500 * N * place.sin() + 1000 * N * shake.sin();
    model.force("hills", &balls[1].cm(), Vector::planar(force, 0 * N));
    let passes = height(&balls[0]) - height(&balls[1]);
    event(&mut model, "passes", passes, Direction::Both, Action::Record);
    let (run, trust) = trusted(&model, 3.0);
    let horizon = trust.horizon.clone().expect("digits end");
    assert!(horizon.time < 2.0, "{horizon:?}");
    let error = |formula: Expr| {
        let at = tumble_mech::At { time: 2.9, side: Side::Before, off: 0.0 };
        trust.error_at(&run, &formula, at).expect("a formula")
    };
    assert!(error(height(&balls[0])).is_some_and(|error| error < 1e-12));
    let lost = balls[1].kinematics().position().x().clone();
    assert_eq!(error(lost.clone()), None);
    assert_eq!(error(lost - height(&balls[0])), None);
}

/// Whatever the islands of others are doing then, joining or parting, all motions are known up to where an event of one ends all.
#[test]
fn an_end_comes_to_islands_that_part() {
    for part in 1..60 {
        let stop = 0.05 * f64::from(part) + 1e-3;
        let (mut model, balls) = bouncing(&[1.0, 0.6, 5.0], 0.9);
        event(&mut model, "passes", height(&balls[0]) - height(&balls[1]), Direction::Both, Action::Record);
        let fallen = 5.0 - GRAVITY / 2.0 * stop * stop;
        if fallen > 0.0 {
            event(&mut model, "low", height(&balls[2]) - fallen * M, Direction::Falling, Action::Stop);
        }
        let run = model.simulate(&[], 3 * S).unwrap_or_else(|error| panic!("{error}"));
        let end = if fallen > 0.0 { stop } else { 3.0 };
        assert!((run.end().expect("an end") - end).abs() < 1e-14, "{stop}: {:?}", run.end());
        let places: Vec<Expr> = balls.iter().map(height).collect();
        assert!(run.observe(&places).expect("formulas").at(0.999 * end, Side::Before).is_some());
    }
}

/// Two that come to one instant: what stops the motion counts, and what the second takes back has not happened.
#[test]
fn jumps_at_one_instant_are_all_seen() {
    let (mut model, balls) = bouncing(&[0.8, 0.8], 0.5);
    // One mass counts twice, so that what the first bounce carries across zero the second does not take back.
    let sum = 2 * rate(&balls[0]) + rate(&balls[1]) + 1 * M / S;
    event(&mut model, "turned", sum, Direction::Rising, Action::Record);
    let back = rate(&balls[0]) - rate(&balls[1]) - 0.5 * M / S;
    event(&mut model, "never", back, Direction::Both, Action::Record);
    event(&mut model, "down", rate(&balls[1]) - 1 * M / S, Direction::Rising, Action::Stop);
    let [(run, _), _] = both(&model, 2.0);
    let fall = (2.0 * 0.8 / GRAVITY).sqrt();
    assert!((run.end().expect("an end") - fall).abs() < 1e-15, "{:?}", run.end());
    let all: Vec<String> = told(&run).into_iter().flat_map(|(_, names)| names).collect();
    assert!(all.contains(&"turned".to_owned()) && !all.contains(&"never".to_owned()), "{all:?}");
}
