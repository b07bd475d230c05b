//! Pins and welds between bodies: motions against references, reactions against both laws of motion of each body.

use tumble_expr::Expr;
use tumble_expr::units::{KG, M, S};
use tumble_mech::{Anchor, Body, Gravity, Joint, Model, Start};
use tumble_ode::Accuracy;

fn g() -> Gravity {
    Gravity::Vertical(9.81 * M / (S * S))
}

fn quarter_turn() -> Expr {
    Expr::from(std::f64::consts::FRAC_PI_2)
}

/// The motion, or why there is none in few words.
fn motion(found: Result<tumble_mech::Run, tumble_mech::RunError>) -> tumble_mech::Run {
    found.unwrap_or_else(|error| panic!("{error}"))
}

/// A point mass at the end of a massless rod of 1 m that hangs from its point `top`.
fn bob(name: &str) -> Body {
    Body::point(name).mass(1 * KG).with_point("top", [0 * M, 1 * M]).with_point("bob", [0 * M, 0 * M])
}

/// Two point masses on massless rods, both horizontal at the start: public reference values of the second stage's design.
#[test]
fn a_double_pendulum_of_point_masses() {
    let mut model = Model::new();
    model.gravity = g();
    // A massless rod has no moment of inertia of its own, and its angle would be undetermined: the masses are joined as points of
    // bodies that have one, of which the second carries none of the motion.
    let upper = model.add(bob("upper"));
    let lower = model.add(bob("lower"));
    model.pivot(&upper, [0 * M, 1 * M]);
    let ends = [
        Anchor::Material(upper.named_point("bob").expect("given")),
        Anchor::Material(lower.named_point("top").expect("given")),
    ];
    model.join(Joint::pin("elbow", ends));
    let starts = [&upper, &lower].map(|body| (body, Start::default().angle(quarter_turn())));
    let run = motion(model.simulate_to(&starts, 10 * S, Accuracy::new(1e-13).expect("positive")));
    let end = run.at(10.0).expect("within");
    let angles = [end.angle(&upper).expect("finite"), end.angle(&lower).expect("finite")];
    println!("{angles:?}");
    for (found, known) in angles.iter().zip([-0.568_474_664_015_950_2, -0.526_393_727_932_404_3]) {
        let wrapped = found - std::f64::consts::TAU * (found / std::f64::consts::TAU).round();
        assert!((wrapped - known).abs() < 1e-11, "{found} {wrapped} {known}");
    }
}

fn named(body: &Body, point: &str) -> Anchor {
    Anchor::Material(body.named_point(point).expect("given"))
}

fn uniform_rod(name: &str) -> Body {
    let rod = Body::rod(name, [0 * M, 0 * M], [0 * M, -1 * M]).mass(1 * KG);
    rod.with_point("top", [0 * M, 0 * M]).with_point("tip", [0 * M, -1 * M])
}

/// A chain of uniform rods that hangs from the origin, each at its angle.
fn chain(angles: &[f64]) -> (Model, Vec<Body>) {
    let mut model = Model::new();
    model.gravity = g();
    let mut bodies: Vec<Body> = vec![];
    for (index, angle) in angles.iter().enumerate() {
        let body = model.add(uniform_rod(&format!("rod{index}")));
        match bodies.last() {
            None => model.pivot(&body, [0 * M, 0 * M]),
            Some(above) => {
                model.join(Joint::pin(format!("joint{index}"), [named(above, "tip"), named(&body, "top")]));
            }
        }
        model.starts.push((body.name.clone(), Start::default().angle(Expr::from(*angle))));
        bodies.push(body);
    }
    (model, bodies)
}

/// Forces of joints and pivots, weights and inertias of each body close both laws of motion, at any time.
#[test]
fn reactions_close_both_laws_of_each_body() {
    let (model, bodies) = chain(&[1.2, -0.4, 2.0]);
    let run = motion(model.simulate(&[], 3 * S));
    let mut forces = tumble_mech::Forces::of(&run);
    for time in [0.0, 0.77, 1.9, 3.0] {
        let all = forces.at(time, tumble_ode::Side::After).expect("finite");
        for (index, body) in bodies.iter().enumerate() {
            let own = all.iter().filter(|force| force.body == index);
            let sum = own.clone().fold([0.0, 0.0, 0.0], |[x, y, torque], force| {
                [x + force.force[0], y + force.force[1], torque + force.torque()]
            });
            let motion = body.kinematics();
            let acceleration = motion.acceleration();
            let formulas = [acceleration.x().clone(), acceleration.y().clone(), motion.alpha()];
            let mut observer = run.observe(&formulas).expect("formulas");
            let found = observer
                .at(time, tumble_ode::Side::Before)
                .or_else(|| observer.at(time, tumble_ode::Side::After));
            let found = found.expect("within");
            let expected = [found[0], found[1], found[2] / 12.0];
            for (sum, expected) in sum.iter().zip(expected) {
                assert!((sum - expected).abs() < 1e-11, "{time} {index} {sum} {expected}");
            }
        }
    }
}

/// A bullet of 10 g at 300 m/s sticks in a rod of 2 kg and 1 m that hangs at rest, 0.8 m below its pivot: angular momentum about the
/// pivot is kept, `m v d = (M L^2/3 + m d^2) omega`, and 1 - that share of the energy is lost.
#[test]
fn a_bullet_sticks_in_a_hanging_rod() {
    let mut model = Model::new();
    model.gravity = g();
    let rod = Body::rod("rod", [0 * M, 0 * M], [0 * M, -1 * M]).mass(2 * KG);
    let rod = model.add(rod);
    let bullet = model.add(Body::point("bullet").mass(0.01 * KG));
    model.pivot(&rod, [0 * M, 0 * M]);
    model.gravity = Gravity::None;
    model.events.push(tumble_mech::Event {
        name: "hit".into(),
        when: bullet.kinematics().position().x().clone(),
        direction: tumble_ode::Direction::Rising,
        action: tumble_mech::Action::Record,
    });
    let cm = Anchor::Material(bullet.cm());
    let stick = Joint::weld("stick", [cm.clone(), cm]).seated_on(&rod.kinematics()).from("hit");
    model.join(stick);
    let start = Start::default().at([-1.5 * M, -0.8 * M]).velocity([300 * M / S, 0 * M / S]);
    let run = motion(model.simulate(&[(&bullet, start)], 0.02 * S));
    let end = run.at(0.02).expect("within");
    let omega = 0.01 * 300.0 * 0.8 / (2.0 / 3.0 + 0.01 * 0.64);
    let found = end.omega(&rod).expect("finite");
    assert!((found / omega - 1.0).abs() < 1e-13, "{found} {omega}");
    // It turns with the rod, 0.8 m from the pivot.
    let place = end.position(&bullet.cm()).expect("finite");
    let angle = 0.015 * omega;
    assert!(
        (place[0] - 0.8 * angle.sin()).abs() < 1e-12 && (place[1] + 0.8 * angle.cos()).abs() < 1e-12,
        "{place:?}"
    );
    let balance = tumble_mech::RunBalance::of(&run, [0.0, 0.0]).expect("a balance");
    assert!(balance.relative() < 1e-12, "{}", balance.relative());
    let lost = balance.energy.end / balance.energy.start;
    assert!((lost - 0.01 * 0.64 / (2.0 / 3.0 + 0.01 * 0.64)).abs() < 1e-13, "{lost}");
}

/// Released where it hangs straight down and is fastest, the lower end of a pendulum flies off along x.
#[test]
fn a_released_body_flies_on() {
    let mut model = Model::new();
    model.gravity = g();
    let ball = model.add(bob("ball"));
    model.events.push(tumble_mech::Event {
        name: "lowest".into(),
        when: ball.kinematics().angle(),
        direction: tumble_ode::Direction::Falling,
        action: tumble_mech::Action::Record,
    });
    let place = Anchor::World(tumble_expr::Vector::planar(0 * M, 1 * M));
    model.join(Joint::pin("string", [named(&ball, "top"), place]).until("lowest"));
    let run = motion(model.simulate(&[(&ball, Start::default().angle(quarter_turn()))], 1 * S));
    let event = &run.trajectory().events[0];
    let end = run.at(1.0).expect("within");
    let velocity = end.velocity(&ball.cm()).expect("finite");
    let fastest = (2.0 * 9.81f64).sqrt();
    // It swings to the left when it falls from the right.
    assert!((velocity[0] + fastest).abs() < 1e-12, "{velocity:?}");
    assert!((velocity[1] + 9.81 * (1.0 - event.time)).abs() < 1e-12, "{velocity:?}");
    assert!((event.time - 2.367_841_947_576_237 / 4.0).abs() < 1e-13, "{}", event.time);
}

/// A rod at rest and free is struck across its end: the centre moves with J/m, and it turns with 6 J/(m L).
#[test]
fn an_impulse_of_an_event_pushes_and_turns() {
    let mut model = Model::new();
    let rod = model.add(uniform_rod("rod"));
    model.events.push(tumble_mech::Event {
        name: "strike".into(),
        when: tumble_mech::time() - 0.5 * S,
        direction: tumble_ode::Direction::Rising,
        action: tumble_mech::Action::Record,
    });
    let at = tumble_mech::Place::Material(rod.named_point("tip").expect("given"));
    let impulse = tumble_expr::Vector::planar(3 * (KG * M / S), 0 * (KG * M / S));
    model.impulses.push(tumble_mech::AppliedImpulse {
        name: "kick".into(),
        body: "rod".into(),
        when: "strike".into(),
        application: tumble_mech::Application::Force { at, force: impulse, frame: tumble_mech::Frame::World },
    });
    let run = motion(model.simulate(&[], 1 * S));
    let end = run.at(1.0).expect("within");
    assert!((end.velocity(&rod.cm()).expect("finite")[0] - 3.0).abs() < 1e-15);
    assert!((end.omega(&rod).expect("finite") - 18.0).abs() < 1e-13);
    let balance = tumble_mech::RunBalance::of(&run, [0.0, 0.0]).expect("a balance");
    assert!(balance.relative() < 1e-14, "{}", balance.relative());
}

/// Equal cranks carry a coupler: with any number of parallel cranks it is a pendulum, whose period is that of one coordinate.
#[test]
fn a_parallelogram_of_two_loops_swings() {
    let mut model = Model::new();
    model.gravity = g();
    let coupler = Body::rod("coupler", [0 * M, 0 * M], [2 * M, 0 * M]).mass(1 * KG);
    let coupler = coupler
        .with_point("p0", [0 * M, 0 * M])
        .with_point("p1", [1 * M, 0 * M])
        .with_point("p2", [2 * M, 0 * M]);
    let mut starts = vec![];
    for index in 0..3 {
        let crank = model.add(uniform_rod(&format!("crank{index}")));
        model.pivot_at(format!("pivot{index}"), &crank, [0 * M, 0 * M], [f64::from(index) * M, 0 * M]);
        model.join(Joint::pin(
            format!("pin{index}"),
            [named(&crank, "tip"), named(&coupler, &format!("p{index}"))],
        ));
        starts.push((crank, Start::default().angle(Expr::from(0.3)).omega(3 / S)));
    }
    let coupler = model.add(coupler);
    let starts: Vec<(&Body, Start)> = starts.iter().map(|(body, start)| (body, start.clone())).collect();
    let run = motion(model.simulate(&starts, 5 * S));
    let end = run.at(5.0).expect("within");
    let angles: Vec<f64> = starts.iter().map(|(body, _)| end.angle(body).expect("finite")).collect();
    println!("{angles:?} {:?}", end.angle(&coupler));
    // I_1 theta'' = -m_1 g sin(theta), of three rods and the coupler: 3/3 + 1 kg m^2 and (3/2 + 1) kg m.
    let energy = |theta: f64, omega: f64| 0.5 * 2.0 * omega * omega - 2.5 * 9.81 * theta.cos();
    let omega = end.omega(starts[0].0).expect("finite");
    assert!((energy(angles[0], omega) - energy(0.3, 3.0)).abs() < 1e-11);
    assert!(angles.iter().all(|angle| (angle - angles[0]).abs() < 1e-10));
}

/// Two rods at a right angle, welded, and one body of the same two parts bounce off a floor alike: impulses of contacts act through the
/// weld.
#[test]
fn welded_rods_bounce_as_one_body() {
    let floor = || {
        let law = tumble_mech::ContactLaw::Rigid { restitution: Expr::from(0.7) };
        tumble_mech::Surface::floor("floor", 0 * M, law)
    };
    let (across, up) = ([[0 * M, 0 * M], [1.2 * M, 0 * M]], [[1.2 * M, 0 * M], [1.2 * M, 0.8 * M]]);
    let rod = |[from, to]: [[Expr; 2]; 2], mass: f64| {
        let [from, to] = [from, to].map(|[x, y]| tumble_expr::Vector::planar(x, y));
        tumble_mech::Part { shape: tumble_mech::Shape::Rod { from, to, end_radius: 0 * M }, mass: mass * KG }
    };
    let mut one = Model::new();
    one.gravity = g();
    let whole = Body::from_parts("whole", vec![rod(across.clone(), 1.5), rod(up.clone(), 0.7)]);
    let whole = one.add(whole.with_point("corner", [1.2 * M, 0 * M]));
    one.surface(floor());
    let start = Start::default().at([0 * M, 2 * M]).angle(Expr::from(0.4)).omega(-1.3 / S);
    let first = motion(one.simulate(&[(&whole, start)], 2 * S));

    let mut two = Model::new();
    two.gravity = g();
    let part = |name: &str, ends, mass| {
        Body::from_parts(name, vec![rod(ends, mass)]).with_point("corner", [1.2 * M, 0 * M])
    };
    let flat = two.add(part("flat", across, 1.5));
    let upright = two.add(part("upright", up, 0.7));
    two.join(Joint::weld("corner", [named(&flat, "corner"), named(&upright, "corner")]));
    two.surface(floor());
    // Where the first of the two parts is, and how fast, when the whole starts so.
    let arm = [0.6 - (1.5 * 0.6 + 0.7 * 1.2) / 2.2, -0.7 * 0.4 / 2.2];
    let (sin, cos) = 0.4_f64.sin_cos();
    let turned = [cos * arm[0] - sin * arm[1], sin * arm[0] + cos * arm[1]];
    let start = Start::default()
        .at([turned[0] * M, (2.0 + turned[1]) * M])
        .velocity([1.3 * turned[1] * M / S, -1.3 * turned[0] * M / S])
        .angle(Expr::from(0.4))
        .omega(-1.3 / S);
    let second = motion(two.simulate(&[(&flat, start)], 2 * S));

    let impacts = first.contacts().len();
    assert!(impacts > 3 && second.contacts().len() == impacts, "{impacts}");
    let (a, b) = (first.at(2.0).expect("within"), second.at(2.0).expect("within"));
    let corners = [
        a.position(&whole.named_point("corner").expect("given")),
        b.position(&flat.named_point("corner").expect("given")),
    ];
    let [there, here] = corners.map(|place| place.expect("finite"));
    let angles = [a.angle(&whole), b.angle(&upright)].map(|angle| angle.expect("finite"));
    println!("{there:?} {here:?} {angles:?} {impacts}");
    assert!((there[0] - here[0]).abs() < 1e-9 && (there[1] - here[1]).abs() < 1e-9, "{there:?} {here:?}");
    assert!((angles[0] - angles[1]).abs() < 1e-9, "{angles:?}");
    let balance = tumble_mech::RunBalance::of(&second, [0.0, 0.0]).expect("a balance");
    assert!(balance.relative() < 1e-10, "{}", balance.relative());
}

/// Thrown up again whenever it has come to its top: the impulse takes the function of its own event away from zero, and it comes
/// again 0.1 s later.
#[test]
fn an_impulse_that_takes_its_event_back_is_applied_again() {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(10 * M / (S * S));
    let ball = model.add(Body::point("ball").mass(1 * KG));
    let rate = ball.kinematics().velocity().y().clone();
    for (name, direction) in [("top", tumble_ode::Direction::Falling), ("any", tumble_ode::Direction::Both)] {
        let when = rate.clone();
        model.events = vec![tumble_mech::Event {
            name: name.into(),
            when,
            direction,
            action: tumble_mech::Action::Record,
        }];
        let kick = tumble_expr::Vector::planar(0 * KG * M / S, 1 * KG * M / S);
        let at = tumble_mech::Place::FromCentre(tumble_expr::Vector::planar(0 * M, 0 * M));
        model.impulses = vec![tumble_mech::AppliedImpulse {
            name: "kick".into(),
            body: "ball".into(),
            when: name.into(),
            application: tumble_mech::Application::Force {
                at,
                force: kick,
                frame: tumble_mech::Frame::World,
            },
        }];
        let start = Start::default().velocity([0 * M / S, 1 * M / S]);
        let run = motion(model.simulate(&[(&ball, start)], 1.05 * S));
        let times: Vec<f64> = run.trajectory().events.iter().map(|event| event.time).collect();
        assert_eq!(times.len(), 10, "{name}: {times:?}");
        let exact = (1..=10).map(|count| 0.1 * f64::from(count));
        assert!(times.iter().zip(exact).all(|(time, exact)| (time - exact).abs() < 1e-14), "{times:?}");
    }
}
