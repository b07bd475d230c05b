//! What the values of a model must be: at the start, and after every event that sets parameters.

use tumble_expr::units::{KG, M, N, RAD, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{
    Action, Anchor, Body, ContactLaw, Equations, Event, Kinematics, Model, ModelErrors, Part, RunError,
    Shape, Spring, Start, Surface, Torsion, time,
};
use tumble_ode::Direction;

fn place(x: Expr, y: Expr) -> Vector {
    Vector::planar(x, y)
}

/// All that is said of the values of a model at its start.
fn said(model: Model) -> String {
    let equations = match Equations::new(model) {
        Ok(equations) => equations,
        Err(mistakes) => return mistakes.to_string(),
    };
    let outcome: Result<_, ModelErrors> = equations.check(&equations.model().parameters);
    outcome.map_or_else(|mistakes| mistakes.to_string(), |_| String::new())
}

fn with(change: impl FnOnce(&mut Model, &Body)) -> String {
    let mut model = Model::new();
    let ball = model.add(Body::ball("ball", 0.1 * M).mass(1 * KG));
    change(&mut model, &ball);
    said(model)
}

fn spring(name: &str, ball: &Body, stiffness: Expr, to: Vector) -> Spring {
    Spring {
        name: name.into(),
        ends: [Anchor::Material(ball.cm()), Anchor::World(to)],
        stiffness,
        rest_length: 1 * M,
        damping: Expr::zero(),
    }
}

/// Sets parameters once the ball is a metre to the right.
fn passing(name: &str, ball: &Body, settings: Vec<(String, Expr)>) -> Event {
    let when = ball.kinematics().position().x() - 1 * M;
    Event { name: name.into(), when, direction: Direction::Rising, action: Action::Set(settings) }
}

#[test]
fn a_radius_of_ends_is_not_negative() {
    let rod = Shape::Rod { from: place(0 * M, 0 * M), to: place(1 * M, 0 * M), end_radius: -0.1 * M };
    let mut model = Model::new();
    model.add(Body::from_parts("rod", vec![Part { shape: rod, mass: 1 * KG }]));
    assert_eq!(said(model), "end radius of `rod` is -0.1 m: it must not be negative");
}

#[test]
fn what_an_event_sets_meets_the_same_conditions() {
    let found = with(|model, ball| {
        let [k, m, e] = [("k", 1 * N / M), ("m", 1 * KG), ("e", Expr::from(0.5))]
            .map(|(name, value)| model.parameters.set(name, value).expect("a dimension"));
        model.bodies[0] = Body::ball("ball", 0.1 * M).mass(m);
        model.interact(spring("cord", ball, k, place(0 * M, 2 * M)));
        let law = ContactLaw::Rigid { restitution: e };
        model.surface(Surface::floor("floor", -9 * M, law));
        model.events.push(passing("a", ball, vec![("k".into(), -2 * N / M), ("e".into(), Expr::from(1.5))]));
        model.events.push(passing("b", ball, vec![("m".into(), 0 * KG)]));
        model.events.push(passing("c", ball, vec![("k".into(), 2 * N / M)]));
    });
    assert_eq!(
        found,
        "after the event `a`: stiffness of `cord` is -2 N/m: it must not be negative; \
         after the event `a`: restitution of `floor` is 1.5: it must lie between 0 and 1; \
         after the event `b`: mass of `ball` is 0 kg: it must be positive"
    );
}

#[test]
fn what_is_wrong_before_an_event_is_not_told_again_after_it() {
    let found = with(|model, ball| {
        let k = model.parameters.set("k", -1 * N / M).expect("a dimension");
        model.interact(spring("cord", ball, k, place(0 * M, 2 * M)));
        model.events.push(passing("a", ball, vec![("k".into(), -2 * N / M)]));
    });
    assert_eq!(found, "stiffness of `cord` is -1 N/m: it must not be negative");
}

/// Each event alone leaves a stiffness of at least 1 N/m, both together one of -1 N/m.
#[test]
fn events_that_break_a_condition_together_stop_the_motion() {
    let mut model = Model::new();
    let ball = model.add(Body::ball("ball", 0.1 * M).mass(1 * KG));
    let [a, b] = ["a", "b"].map(|name| model.parameters.set(name, 2 * N / M).expect("a dimension"));
    model.interact(spring("cord", &ball, a + b - 1 * N / M, place(0 * M, 3 * M)));
    for (name, at) in [("a", 1.0), ("b", 2.0)] {
        let settings = vec![(name.to_owned(), 0 * (N / M))];
        let when = time() - at * S;
        let action = Action::Set(settings);
        model.events.push(Event { name: format!("less {name}"), when, direction: Direction::Rising, action });
    }
    let start = Start::default().at([0 * M, 2.5 * M]);
    let error = model.simulate(&[(&ball, start)], 5 * S).expect_err("stiffness of -1 N/m");
    let RunError::Refused { refusal, partial } = error else { panic!("{error}") };
    assert_eq!(refusal.time, 2.0);
    let expected = "after `less a`, `less b`: stiffness of `cord` is -1 N/m: it must not be negative";
    assert_eq!(refusal.reason.to_string(), expected);
    assert_eq!(partial.trajectory().end(), Some(2.0));
}

#[test]
fn what_points_has_a_length() {
    let rigid = || ContactLaw::Rigid { restitution: Expr::one() };
    let found = with(|model, _| {
        model.surface(Surface::new("wall", [-1 * M, 0 * M], [Expr::zero(), Expr::zero()], rigid()));
    });
    assert_eq!(found, "normal of `wall` has no length, and so no direction");
    let far = Expr::from(1e300);
    let found =
        with(|model, _| model.surface(Surface::new("wall", [-1 * M, 0 * M], [far, Expr::zero()], rigid())));
    assert_eq!(found, "");
}

#[test]
fn a_point_held_at_its_own_place_does_not_turn() {
    let held = |at: f64| {
        let mut model = Model::new();
        let point = model.add(Body::point("bob").mass(1 * KG));
        model.pivot_at("nail", &point, [at * M, 0 * M], [0 * M, 0 * M]);
        said(model)
    };
    let message = "pivot `nail` holds a body without moment of inertia about it: nothing says how it turns";
    assert_eq!(held(0.0), message);
    assert_eq!(held(0.1), "");
    // A lever that rounding has left of none.
    let mut model = Model::new();
    let at = |x: Expr| place(x, 0 * M);
    let sum = model.parameters.set("sum", 0.1 * M + 0.2 * M).expect("a length");
    let part = Part { shape: Shape::Point { at: at(sum * 3 - 0.6 * M) }, mass: 1 * KG };
    let bob = model.add(Body::from_parts("bob", vec![part]));
    model.pivot_at("nail", &bob, [0.3 * M, 0 * M], [0 * M, 0 * M]);
    assert_eq!(said(model), message);
}

#[test]
fn what_overflows_is_named() {
    let huge = Expr::from(1e300);
    let found = with(|model, ball| {
        model.force("push", &ball.cm(), place(&huge * &huge * (1 * N) * time().step(), 0 * N));
    });
    assert_eq!(found, "force of `push` is inf: it must be a finite number");
    let found = with(|model, ball| {
        let start = Start::default().at([&huge * &huge * (1 * M), 0 * M]);
        model.starts.push((ball.name.clone(), start));
    });
    assert_eq!(found, "start of `ball` is inf: it must be a finite number");
    let tiny = Expr::from(1e-200);
    let found = with(|model, _| model.bodies[0] = Body::ball("ball", 1 * M).mass(&tiny * &tiny * KG));
    assert_eq!(found, "mass of `ball` is 0 kg: it must be positive");
    let found = with(|model, _| model.bodies[0] = Body::ball("ball", 1 * M).mass(5e-324 * KG));
    assert_eq!(found, "mass of `ball` is 5e-324 kg: numbers below 2.3e-308 have lost digits");
}

/// A number that only a branch which is never taken would need.
#[test]
fn what_a_condition_leaves_out_need_not_be_finite() {
    let found = with(|model, ball| {
        let zero = model.parameters.set("zero", 1 * S - 1 * S).expect("a time");
        let is_positive = Expr::compare(tumble_expr::Relation::Less, Expr::zero(), zero.clone());
        let rate = Expr::select(is_positive, time() / &zero, Expr::zero());
        model.force("push", &ball.cm(), place(rate * (1 * N), 0 * N));
    });
    assert_eq!(found, "");
}

#[test]
fn every_parameter_without_a_value_is_named_and_none_that_follows_from_one() {
    let found = with(|model, _| {
        let parameters = &mut model.parameters;
        let long = parameters.set("long", Expr::from(1e300) * M).expect("a length");
        let area = parameters.set("area", &long * &long).expect("an area");
        parameters.set("twice", &area * 2).expect("an area");
        parameters.set("root", (0 * M - &long).sqrt()).expect("typed");
    });
    assert_eq!(
        found,
        "parameter `area` is inf: it must be a finite number; parameter `root` is NaN: it must be a finite number"
    );
}

#[test]
fn angles_have_digits() {
    let sine = |argument: f64| {
        with(|model, _| {
            let angle = model.parameters.set("angle", Expr::from(argument)).expect("a number");
            model.parameters.set("part", angle.sin()).expect("a number");
        })
    };
    assert_eq!(sine(1e15), "");
    assert!(sine(1.1e15).starts_with("parameter `part`: an angle of 1.1e15 rad points nowhere"));
    let wire = |rest_angle: f64| {
        with(|model, ball| {
            let zero = || 0 * N * M;
            let body = Kinematics::new(&ball.name);
            let (rest_angle, damping) = (rest_angle * RAD, zero() * (1 * S));
            model.interact(Torsion { name: "wire".into(), body, stiffness: zero(), rest_angle, damping });
        })
    };
    assert_eq!(wire(1e9), "");
    assert!(wire(2e9).starts_with("rest angle of `wire`: an angle of 2e9 rad points nowhere"));
}

#[test]
fn loads_without_a_value_at_the_start_are_named() {
    let found = with(|model, ball| {
        model.interact(spring("cord", ball, 1 * N / M, place(0 * M, 0 * M)));
        model.force("push", &ball.cm(), place(1 * N * S / time(), 0 * N));
        model.interact(spring("long cord", ball, 1 * N / M, place(0 * M, 1 * M)));
    });
    assert_eq!(
        found,
        "`push` is inf at the start: a force must be a finite number; the ends of `cord` are at one place at the \
         start: the direction in which it pulls is undefined"
    );
}

/// A run that nobody has checked before names them too.
#[test]
fn a_run_that_cannot_begin_names_its_load() {
    let mut model = Model::new();
    let ball = model.add(Body::ball("ball", 0.1 * M).mass(1 * KG));
    model.interact(spring("cord", &ball, 1 * N / M, place(0 * M, 0 * M)));
    let error = model.simulate(&[], 1 * S).expect_err("no direction");
    assert!(matches!(&error, RunError::Model(_)), "{error}");
    assert!(error.to_string().contains("`cord`"), "{error}");
}

#[test]
fn what_is_possible_and_most_often_a_slip_is_a_warning() {
    let warnings = |speed: f64, omega: f64, mass: f64| {
        let mut model = Model::new();
        let ball = model.add(Body::ball("ball", 0.1 * M).mass(1 * KG));
        model.add(Body::point("moon").mass(mass * KG));
        let start = Start::default().velocity([0 * M / S, speed * M / S]).omega(omega / S);
        model.starts.push((ball.name, start));
        model.starts.push(("moon".into(), Start::default().at([9 * M, 0 * M])));
        let equations = Equations::new(model).expect("a model");
        let start = equations.check(&equations.model().parameters).expect("a start");
        let warnings = equations.warnings(&start).expect("values");
        warnings.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
    };
    assert_eq!(warnings(9e7, 9e7, 9e14), "");
    let fast = |speed: &str| {
        format!("`ball` starts at up to {speed} m/s, and mechanics here knows no speed of light")
    };
    assert_eq!(warnings(2e8, 0.0, 1.0), fast("2e8"));
    assert_eq!(warnings(9e7, 2e8, 1.0), fast("1.1e8"));
    let unlike = "the mass of `moon` is 2e15 times that of `ball`, more than a number has digits for";
    assert_eq!(warnings(0.0, 0.0, 2e15), unlike);
}
