//! Loads that depend on forces of contacts and joints otherwise than linearly; against closed forms and independent integrations.

use crate::common;

use crate::common::{at, close, number, rigid, run};
use tumble_expr::units::{KG, M, N, S};
use tumble_expr::{Binary, Expr, Unary, Vector};
use tumble_mech::{
    Action, Anchor, Body, Event, Gravity, Joint, Load, Model, Place, Run, RunBalance, RunError, Shape, Start,
    Surface, time,
};
use tumble_ode::{Accuracy, Direction};

const G: f64 = 9.81;

/// The force of `hinge`.
fn size(forces: [Expr; 2]) -> Expr {
    Expr::norm(forces.to_vec())
}

/// A body held at its point (0, 0) by a pivot or by a pin, with a torque that depends on what that does.
fn hinged(body: Body, by_pivot: bool, start: Start, torque: impl Fn(&Body, Expr) -> Expr) -> (Model, Body) {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(G * M / (S * S));
    let body = model.add(body.with_point("top", [0 * M, 0 * M]));
    let place = [0 * M, 0 * M];
    let forces = if by_pivot {
        model.pivot_at("hinge", &body, place.clone(), place);
        model.pivots[0].force_symbols().to_vec()
    } else {
        let top = Anchor::Material(body.named_point("top").expect("given"));
        let world = Anchor::World(Vector::planar(0 * M, 0 * M));
        let joint = Joint { assemble: true, ..Joint::pin("hinge", [top, world]) };
        let forces = joint.multipliers();
        model.join(joint);
        forces
    };
    let force = size([forces[0].clone().into(), forces[1].clone().into()]);
    model.torque("rub", &body, torque(&body, force));
    model.starts.push((body.name.clone(), start));
    (model, body)
}

fn rubs(body: &Body, force: Expr, arm: f64) -> Expr {
    -arm * M * force * body.kinematics().omega().sign()
}

/// A disk of 2 kg and 0.3 m on its axle bears m g, and its friction of radius mu r stops it after `omega I/(mu r m g)`, for good.
#[test]
fn a_disk_on_its_axle_spins_down() {
    let (mass, radius, arm, omega) = (2.0, 0.3, 0.004, 5.0);
    let inertia = 0.5 * mass * radius * radius;
    let stop = omega * inertia / (arm * mass * G);
    for by_pivot in [true, false] {
        for way in [1.0, -1.0] {
            let disk = Shape::Disk { centre: Vector::planar(0 * M, 0 * M), radius: radius * M };
            let start = Start::default().omega(way * omega / S);
            let (model, disk) =
                hinged(Body::of_shape("disk", disk).mass(mass * KG), by_pivot, start, |body, force| {
                    rubs(body, force, arm)
                });
            let run = run(model, 2.0 * stop, 1e-13);
            let motion = [disk.kinematics().omega(), disk.kinematics().angle()];
            let t = 0.6 * stop;
            let found = at(&run, t, motion.clone());
            close(found[0], way * omega * 0.4, 1e-14);
            close(found[1], way * (omega * t - 0.5 * omega / stop * t * t), 1e-13);
            let found = at(&run, 1.9 * stop, motion);
            assert_eq!(found[0], 0.0);
            close(found[1], way * 0.5 * omega * stop, 1e-13);
        }
    }
}

/// Fourth-order steps of angle and rate until a time.
fn stepped(mut now: [f64; 2], until: f64, alpha: impl Fn(f64, [f64; 2]) -> f64) -> [f64; 2] {
    const STEPS: usize = 20_000;
    let h = until / STEPS as f64;
    for step in 0..STEPS {
        let t = h * step as f64;
        let rates = |t: f64, now: [f64; 2]| [now[1], alpha(t, now)];
        let moved = |[a, b]: [f64; 2], by: f64| [now[0] + by * a, now[1] + by * b];
        let first = rates(t, now);
        let second = rates(t + h / 2.0, moved(first, h / 2.0));
        let third = rates(t + h / 2.0, moved(second, h / 2.0));
        let fourth = rates(t + h, moved(third, h));
        now = std::array::from_fn(|i| {
            now[i] + h / 6.0 * (first[i] + 2.0 * second[i] + 2.0 * third[i] + fourth[i])
        });
    }
    now
}

/// A rod of 1 kg and 1 m under a torque: its angular acceleration with the friction of its pin, found by trying forces until nothing changes.
fn alpha_of_rod(arm: f64, way: f64, torque: f64, [angle, omega]: [f64; 2]) -> f64 {
    let (sin, cos) = angle.sin_cos();
    let mut alpha = 0.0;
    for _ in 0..60 {
        let across = 0.5 * (cos * alpha - sin * omega * omega);
        let upward = G + 0.5 * (sin * alpha + cos * omega * omega);
        alpha = 3.0 * (torque - 0.5 * G * sin - arm * way * across.hypot(upward));
    }
    alpha
}

fn rod() -> Body {
    Body::rod("rod", [0 * M, 0 * M], [0 * M, -1 * M]).mass(1 * KG)
}

#[test]
fn a_rod_with_friction_in_its_pin_swings_down() {
    let arm = 0.05;
    let expected = stepped([1.2, 0.0], 0.7, |_, now| alpha_of_rod(arm, -1.0, 0.0, now));
    for by_pivot in [true, false] {
        let start = Start::default().angle(Expr::from(1.2));
        let (model, rod) = hinged(rod(), by_pivot, start, |body, force| rubs(body, force, arm));
        let run = run(model, 0.7, 1e-13);
        let found = at(&run, 0.7, [rod.kinematics().angle(), rod.kinematics().omega()]);
        found.iter().zip(expected).for_each(|(found, expected)| close(*found, expected, 2e-12));
    }
}

/// It comes to rest for good, where gravity no longer overcomes what the pin holds, and all its energy has become the work of friction.
#[test]
fn a_rod_with_friction_in_its_pin_comes_to_rest() {
    let arm = 0.05;
    for by_pivot in [true, false] {
        let start = Start::default().angle(Expr::from(1.2));
        let (model, rod) = hinged(rod(), by_pivot, start, |body, force| rubs(body, force, arm));
        let run = run(model, 12.0, 1e-12);
        let found = at(&run, 12.0, [rod.kinematics().omega(), rod.kinematics().angle()]);
        assert_eq!(found[0], 0.0);
        assert!((0.5 * found[1].sin()).abs() < arm, "{}", found[1]);
        let balance = RunBalance::of(&run, [0.3, -0.2]).expect("a balance");
        assert!(balance.energy.relative() < 1e-12 && balance.relative() < 1e-12, "{:?}", balance.energy);
        let work: f64 =
            balance.contributions.iter().filter(|own| own.load == "rub").map(|own| own.work).sum();
        close(work, -0.5 * G * (found[1].cos() - 1.2_f64.cos()), 1e-11);
    }
}

/// Every turn in time, and where, until it stands still for good, with the work of friction; from `references/pin_friction.py`.
#[test]
fn a_rod_with_friction_in_its_pin_decays_as_independent_numbers_say() {
    let text = include_str!("../../tumble/tests/reference/pin_friction.json");
    let json: serde_json::Value = serde_json::from_str(text).expect("valid JSON");
    for (name, case) in json["cases"].as_object().expect("cases") {
        let [arm, angle, rate] = ["arm", "angle", "rate"].map(|key| number(&case[key]));
        let turns: Vec<[f64; 3]> = (case["turns"].as_array().expect("turns").iter())
            .map(|turn| ["t", "angle", "work"].map(|key| number(&turn[key])))
            .collect();
        let [stop, rests, rubbed] = turns[turns.len() - 1];
        for by_pivot in [true, false] {
            let start = Start::default().angle(Expr::from(angle)).omega(rate / S);
            let (model, rod) = hinged(rod(), by_pivot, start, |body, force| rubs(body, force, arm));
            let run = run(model, stop + 1.0, 1e-13);
            let motion = [rod.kinematics().angle(), rod.kinematics().omega()];
            for [time, angle, _] in &turns {
                let found = at(&run, *time, motion.clone());
                close(found[0], *angle, 1e-13);
                close(found[1], 0.0, 1e-12);
            }
            let last = run.events().last().expect("it stops").time;
            close(last, stop, 1e-13);
            assert_eq!(at(&run, stop + 1.0, motion), [at(&run, last, [rod.kinematics().angle()])[0], 0.0]);
            close(at(&run, stop + 1.0, [rod.kinematics().angle()])[0], rests, 1e-13);
            let balance = RunBalance::of(&run, [0.0, 0.0]).expect("a balance");
            let work = balance.contributions.iter().filter(|own| own.load == "rub").map(|own| own.work);
            close(work.sum(), rubbed, 1e-12);
            println!("{name}: {} turns", turns.len());
        }
    }
}

/// At rest it is held up to `sin = mu r/(L/2)`, without any creep, and not beyond.
#[test]
fn a_pin_holds_a_rod_up_to_its_angle_of_friction() {
    let (arm, part) = (0.1, 1e-9);
    let most = (arm / 0.5_f64).asin();
    for by_pivot in [true, false] {
        for (angle, holds) in [(most * (1.0 - part), true), (most * (1.0 + part), false)] {
            let start = Start::default().angle(Expr::from(angle));
            let (model, rod) = hinged(rod(), by_pivot, start, |body, force| rubs(body, force, arm));
            let run = run(model, 5.0, 1e-12);
            let [found] = at(&run, 5.0, [rod.kinematics().angle()]);
            assert_eq!(found == angle, holds, "{angle} {found}");
        }
    }
}

/// A torque that grows as `k t` turns a hanging rod from `k t = mu r m g` on, and from there on it moves as its equation says.
#[test]
fn a_pin_gives_way_at_its_time() {
    let (arm, k) = (0.1, 0.7);
    let yields = arm * G / k;
    for by_pivot in [true, false] {
        let (mut model, rod) =
            hinged(rod(), by_pivot, Start::default(), |body, force| rubs(body, force, arm));
        model.torque("twist", &rod, k * N * M / S * time());
        let run = run(model, yields + 1.0, 1e-12);
        let motion = [rod.kinematics().angle(), rod.kinematics().omega()];
        assert_eq!(at(&run, yields * (1.0 - 1e-12), motion.clone()), [0.0, 0.0]);
        let found = at(&run, yields + 1.0, motion);
        let torque = |after: f64| k * (yields + after);
        let expected = stepped([0.0, 0.0], 1.0, |after, now| alpha_of_rod(arm, 1.0, torque(after), now));
        found.iter().zip(expected).for_each(|(found, expected)| close(*found, expected, 1e-10));
    }
}

fn tried(model: &Model, until: f64) -> Result<Run, RunError> {
    model.simulate_to(&[], until * S, Accuracy::new(1e-12).expect("an accuracy"))
}

/// Blocks of 1 kg on a floor, each pressed down by what `press` makes of the forces on both.
fn pressed(press: impl Fn([&Expr; 2]) -> Expr) -> (Model, [Expr; 2]) {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(G * M / (S * S));
    for (name, x) in [("a", 0.0), ("b", 3.0)] {
        let centre = Vector::planar(0 * M, 0 * M);
        let shape = Shape::Box { centre, width: 0.4 * M, height: 0.2 * M };
        model.add(Body::of_shape(name, shape).mass(1 * KG));
        model.starts.push((name.into(), Start::default().at([x * M, 0.1 * M])));
    }
    model.surface(Surface::new("floor", [0 * M, 0 * M], [0.into(), 1.into()], rigid(0.0)));
    let forces = ["a", "b"].map(|name| {
        let place = format!("floor.{name}.");
        let own = model.pairs().into_iter().filter(|pair| pair.name.starts_with(&place));
        own.map(|pair| Expr::from(pair.force_symbol())).reduce(|a, b| a + b).expect("they may touch")
    });
    for (name, body) in ["on a", "on b"].into_iter().zip(model.bodies.clone()) {
        model.force(name, &body.cm(), Vector::planar(0 * N, -press([&forces[0], &forces[1]])));
    }
    (model, forces)
}

/// `N_a = m g + c N_a N_b` and the same of b: `N = (1 - sqrt(1 - 4 c m g))/(2 c)`, the lesser of two, until c has grown to `1/(4 m g)`,
/// where the two are one.
#[test]
fn a_product_of_two_forces() {
    let k = 0.01;
    let (model, forces) = pressed(|[a, b]| k / N / S * time() * a * b);
    let ends = 1.0 / (4.0 * k * G);
    for t in [0.5 * ends, 0.99 * ends] {
        let run = tried(&model, t).map_err(|error| error.to_string()).expect("a motion");
        let c = k * t;
        let expected = (1.0 - (1.0 - 4.0 * c * G).sqrt()) / (2.0 * c);
        at(&run, t, forces.clone()).into_iter().for_each(|found| close(found, expected, 1e-11));
    }
    let (time, text) = common::refused(tried(&model, 2.0 * ends));
    close(time, ends, 1e-9);
    assert!(text.contains("is not determined") && text.contains("`on a`"), "{text}");
    // From a start with two solutions on, of which the greater is no force that keeps a body.
    let (model, forces) = pressed(|[a, b]| 0.02 / N * a * b);
    let run = tried(&model, 0.1).map_err(|error| error.to_string()).expect("a motion");
    let expected = (1.0 - (1.0 - 4.0 * 0.02 * G).sqrt()) / (2.0 * 0.02);
    at(&run, 0.1, forces).into_iter().for_each(|found| close(found, expected, 1e-12));
    let (model, _) = pressed(|[a, b]| 0.03 / N * a * b);
    let (time, text) = common::refused(tried(&model, 1.0));
    assert!(time == 0.0 && text.contains("no value of") && text.contains("`on a`"), "{text}");
}

/// `N = m g + F tanh((N - N_0)/w)` has three solutions, of which the middle one is no force that keeps a body.
#[test]
fn several_forces_are_refused_with_their_values() {
    let (model, _) = pressed(|[own, _]| 8 * N * Expr::unary(Unary::Tanh, (own - 10 * N) / (1 * N)));
    let (time, text) = common::refused(tried(&model, 1.0));
    assert_eq!(time, 0.0);
    let low = (0..200).fold(0.0, |n: f64, _| G + 8.0 * (n - 10.0).tanh());
    let high = (0..200).fold(30.0, |n: f64, _| G + 8.0 * (n - 10.0).tanh());
    assert!(text.contains("several values") && text.matches("; or ").count() >= 1, "{text}");
    for value in [low, high] {
        // Two corners bear it.
        assert!(text.contains(&(0.5 * value).to_string()[..8]), "{value} {text}");
    }
}

/// What a load makes of roots, powers, and the larger of two forces.
#[test]
fn any_formula_of_forces() {
    type Case = (fn(&Expr) -> Expr, fn(f64) -> f64);
    let cases: [Case; 4] = [
        (|n| (n * (1 * N)).sqrt(), |n| n.sqrt()),
        (|n| n.abs() * 0.5, |n| 0.5 * n),
        (|n| n.powi(3) / (1000 * N * N), |n| n * n * n / 1000.0),
        (|n| Expr::binary(Binary::Max, n * 2, 12 * N), |n| (2.0 * n).max(12.0)),
    ];
    for (load, expected) in cases {
        let (mut model, forces) = pressed(|_| 0 * N);
        model.loads.clear();
        let block = model.bodies[0].clone();
        model.force("drive", &block.cm(), Vector::planar(load(&forces[0]), 0 * N));
        let run = run(model, 0.5, 1e-13);
        let speed = block.kinematics().velocity().x().clone();
        close(at(&run, 0.5, [speed])[0], 0.5 * expected(G), 1e-13);
    }
}

/// An own friction by `abs(N)` slides, stops and holds as that by N does, with the forces of the floor falling as a pull grows.
#[test]
fn own_friction_by_a_size() {
    let (mu, speed) = (0.3, 2.0);
    let (mut model, forces) = pressed(|_| 0 * N);
    model.loads.clear();
    let block = model.bodies[0].clone();
    let velocity = block.kinematics().velocity().x().clone();
    model.starts[0].1 = Start::default().at([0 * M, 0.1 * M]).velocity([speed * M / S, 0 * M / S]);
    let foot = Place::FromCentre(Vector::planar(0 * M, -0.1 * M));
    let rub = Vector::planar(-mu * forces[0].abs() * velocity.sign(), 0 * N);
    model.loads.push(Load::force("rub", "a", foot, rub));
    let pull = 0.5 * N / S * time();
    model.force("pull", &block.cm(), Vector::planar(pull, 0 * N));
    let stop = {
        // v = speed - mu g t + t^2/4
        let (b, c) = (mu * G, speed);
        2.0 * (b - (b * b - c).sqrt())
    };
    let yields = mu * G / 0.5;
    let run = run(model, yields + 1.0, 1e-13);
    let found = |t: f64| at(&run, t, [velocity.clone()])[0];
    close(found(0.5 * stop), speed - mu * G * 0.5 * stop + 0.0625 * stop * stop, 1e-14);
    assert_eq!([found(stop * (1.0 + 1e-9)), found(yields * (1.0 - 1e-12))], [0.0, 0.0]);
    close(found(yields + 1.0), 0.25, 1e-12);
}

/// A jump of another load would be one of these forces between events.
#[test]
fn jumps_of_loads_are_refused() {
    let (mut model, rod) =
        hinged(rod(), true, Start::default().angle(Expr::from(1.2)), |body, force| rubs(body, force, 0.05));
    model.torque("twist", &rod, 0.1 * N * M * rod.kinematics().angle().sin().sign());
    let text = common::refused(tried(&model, 1.0)).1;
    assert!(text.contains("`twist` may jump") && text.contains("`hinge.fx`, `hinge.fy`"), "{text}");
}

/// Without weight nothing loads the axle of a balanced disk, and it spins on.
#[test]
fn an_axle_that_bears_nothing_does_not_rub() {
    let disk = Shape::Disk { centre: Vector::planar(0 * M, 0 * M), radius: 0.3 * M };
    let start = Start::default().omega(5 / S);
    let (mut model, disk) = hinged(Body::of_shape("disk", disk).mass(2 * KG), true, start, |body, force| {
        rubs(body, force, 0.004)
    });
    model.gravity = Gravity::None;
    let run = run(model, 3.0, 1e-12);
    assert_eq!(at(&run, 3.0, [disk.kinematics().omega()]), [5.0]);
}

/// The load grows to where there are two solutions: the one goes on that was there, also through an event.
#[test]
fn the_force_that_was_there_goes_on() {
    let (mut model, forces) =
        pressed(|[own, _]| 8 * N / S * time() * Expr::unary(Unary::Tanh, (own - 13 * N) / (1 * N)));
    model.events.push(Event {
        name: "mark".into(),
        when: time() - 1 * S,
        direction: Direction::Rising,
        action: Action::Record,
    });
    let solved = |from: f64, t: f64| (0..2000).fold(from, |n: f64, _| G + 8.0 * t * (n - 13.0).tanh());
    let run = run(model, 1.2, 1e-12);
    for t in [0.9, 1.2] {
        let (low, high) = (solved(-30.0, t), solved(60.0, t));
        assert!(high - low > 10.0, "there is one");
        close(at(&run, t, [forces[0].clone()])[0], low, 1e-11);
    }
}
