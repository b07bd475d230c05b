//! Painleve's configuration, of a rod alone and where others hold it too: refused by its name, with the coefficient from which on no force holds it up,
//! against closed forms.

use crate::common::{at, close, rigid};
use tumble_expr::Expr;
use tumble_expr::Vector;
use tumble_expr::units::{KG, M, S};
use tumble_mech::{
    Anchor, Body, BodyContact, Friction, Gravity, Joint, Model, Painleve, Run, Shape, Start, Surface,
};
use tumble_ode::{Accuracy, Side};

const G: f64 = 9.81;

/// A rod of 1 m that leans to the right, with its foot at the origin.
fn add(model: &mut Model, tan: f64, [vx, vy, omega]: [f64; 3]) {
    let (sin, cos) = tan.atan().sin_cos();
    let start = Start::default().at([0.5 * cos * M, 0.5 * sin * M]).angle(Expr::from(tan.atan()));
    model.starts.push(("rod".into(), start.velocity([vx * M / S, vy * M / S]).omega(omega / S)));
    model.add(Body::rod("rod", [0 * M, 0 * M], [1 * M, 0 * M]).mass(1 * KG));
}

fn world() -> Model {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(G * M / (S * S));
    model
}

fn floor(model: &mut Model, mu: f64) {
    model.surface(Surface::floor("floor", 0 * M, rigid(0.0)).with_friction(Friction::new(mu)));
}

fn comes_to(model: Model) -> Result<Option<f64>, String> {
    let accuracy = Accuracy::new(1e-12).expect("an accuracy");
    model.simulate_to(&[], 0.1 * S, accuracy).map(|run| run.end()).map_err(|error| error.to_string())
}

/// From which coefficient on a rod that nothing else holds is refused: `(4 + tan^2)/(3 tan)`.
fn alone(tan: f64) -> f64 {
    (4.0 + tan * tan) / (3.0 * tan)
}

/// Refused just above this coefficient, which it names; not just below, nor the other way round.
fn check(least: f64, of: impl Fn(f64, f64) -> Model) {
    let refused = comes_to(of(least * (1.0 + 1e-5), -1.0)).expect_err("it is wedged");
    assert!(refused.contains("Painleve") && refused.contains(" rad: from "), "{refused}");
    let from = refused.split("from ").nth(1).and_then(|rest| rest.split(' ').next());
    close(from.and_then(|number| number.parse().ok()).expect("a coefficient"), least, 1e-12);
    for (mu, speed) in [(least * (1.0 - 1e-5), -1.0), (least * (1.0 + 1e-5), 1.0)] {
        assert_eq!(comes_to(of(mu, speed)), Ok(Some(0.1)), "{mu} {speed}");
    }
}

/// A rod whose top slides down a smooth wall while its foot is ahead: `2 (1 + tan^2)/(3 tan)` with the wall, and `(4 + tan^2)/(3 tan)`
/// without. From the lesser of the two on there may be no forces, or several.
#[test]
fn between_a_floor_and_a_wall() {
    for tan in [1.1_f64, 1.3, 2.0] {
        let (with, without) = (2.0 * (1.0 + tan * tan) / (3.0 * tan), alone(tan));
        check(with.min(without), |mu, speed| {
            let mut model = world();
            let (sin, cos) = tan.atan().sin_cos();
            // The foot goes along the floor and the top along the wall.
            let omega = speed / sin;
            add(&mut model, tan, [0.5 * speed, 0.5 * omega * cos, omega]);
            floor(&mut model, mu);
            model.surfaces[0].on = Some(vec!["rod.from".into()]);
            let wall = Surface::new("wall", [cos * M, 0 * M], [-1 * Expr::one(), Expr::zero()], rigid(0.0));
            model.surface(Surface { on: Some(vec!["rod.to".into()]), ..wall });
            model
        });
    }
}

#[test]
fn of_a_rod_alone() {
    for tan in [1.5_f64, 2.0, 2.5] {
        check(alone(tan), |mu, speed| {
            let mut model = world();
            add(&mut model, tan, [speed, 0.0, 0.0]);
            floor(&mut model, mu);
            model
        });
    }
}

/// The same rod of two halves that a weld holds together: what a push moves is then what the joint lets it.
#[test]
fn of_two_halves_with_a_weld() {
    let tan = 2.0_f64;
    check(alone(tan), |mu, speed| {
        let mut model = world();
        let (sin, cos) = tan.atan().sin_cos();
        let ends = [("lower", 0.25, 0.5), ("upper", 0.75, 0.0)].map(|(name, place, middle)| {
            let start = Start::default().at([place * cos * M, place * sin * M]).angle(Expr::from(tan.atan()));
            model.starts.push((name.into(), start.velocity([speed * M / S, 0 * M / S])));
            let half = Body::rod(name, [0 * M, 0 * M], [0.5 * M, 0 * M]).mass(0.5 * KG);
            let half = model.add(half.with_point("middle", [middle * M, 0 * M]));
            Anchor::Material(half.named_point("middle").expect("given"))
        });
        model.join(Joint::weld("middle", ends));
        floor(&mut model, mu);
        model
    });
}

/// A rod under a smooth ceiling, against which its turning presses it: `N = m g/(2 - mu tan)`, and from `mu = 2/tan` on it is jammed,
/// if it would not be without the ceiling before.
#[test]
fn between_a_floor_and_a_ceiling() {
    for tan in [1.2_f64, 2.0, 3.0] {
        let pushed = |mu: f64, speed: f64| {
            let mut model = world();
            add(&mut model, tan, [speed, 0.0, 0.0]);
            floor(&mut model, mu);
            let through = [0 * M, tan.atan().sin() * M];
            model.surface(Surface::new("ceiling", through, [Expr::zero(), -1 * Expr::one()], rigid(0.0)));
            model
        };
        check(alone(tan).min(2.0 / tan), pushed);
        let mu = 1.8 / tan;
        let run = pushed(mu, -1.0).simulate(&[], 0.001 * S).expect("it slips");
        let normal = run.equations.pairs()[0].force_symbol();
        close(at(&run, 0.0, [normal.into()])[0], G / (2.0 - mu * tan), 1e-9);
    }
}

/// Where no push moves a body away it is no paradox: what presses it there is not determined.
#[test]
fn a_wheel_whose_axle_is_as_high_as_its_radius_is_refused_for_what_it_is() {
    let mut model = world();
    let centre = Vector::planar(0 * M, 0 * M);
    let wheel = model.add(Body::of_shape("wheel", Shape::Disk { centre, radius: 0.1 * M }).mass(2 * KG));
    model.pivot_at("axle", &wheel, [0 * M, 0 * M], [0 * M, 0.1 * M]);
    model.starts.push(("wheel".into(), Start::default().omega(10 / S)));
    floor(&mut model, 0.3);
    let refused = comes_to(model).expect_err("it is not determined");
    assert!(refused.contains("not determined") && !refused.contains("NaN"), "{refused}");
}

/// The rod's velocity just after some time, m/s, and its omega, rad/s.
fn velocity(run: &Run, time: f64) -> [f64; 3] {
    let motion = run.equations.model().bodies[0].kinematics();
    let formulas = [motion.velocity().x().clone(), motion.velocity().y().clone(), motion.omega()];
    let found = run.observe(&formulas).expect("velocities").at(time, Side::After).expect("within the run");
    found.try_into().expect("three")
}

fn after_an_impact(mut model: Model) -> Run {
    model.painleve = Painleve::Impact;
    model.simulate_to(&[], 0.1 * S, Accuracy::new(1e-12).expect("an accuracy")).expect("a motion")
}

/// An impulse stops the foot though nothing closes: friction presses it down until its slip is zero, and from there on it is pushed out. With e = 0 the rod goes on
/// about its foot with `3 v sin/(2 L)`, as in the limit of less friction; with more it leaves with e times what it was pressed by.
#[test]
fn an_impact_without_collision_stops_what_slips() {
    for (tan, more, e) in [(2.0_f64, 1.05, 0.0), (2.0, 1.3, 0.5), (1.4, 1.1, 0.0), (2.6, 1.2, 0.8)] {
        let (sin, cos) = tan.atan().sin_cos();
        let (mu, v) = (more * alone(tan), 1.7);
        let mut model = world();
        add(&mut model, tan, [-v, 0.0, 0.0]);
        model.surface(Surface::floor("floor", 0 * M, rigid(e)).with_friction(Friction::new(mu)));
        let run = after_an_impact(model);
        let [tt, tn, nn] = [1.0 + 3.0 * sin * sin, -3.0 * sin * cos, 1.0 + 3.0 * cos * cos];
        let until_stop = v / (tn + mu * tt);
        let out = nn - tn * tn / tt;
        let compression = until_stop - (nn + mu * tn) * until_stop / out;
        let p = (1.0 + e) * compression;
        let along = mu * until_stop - tn / tt * (p - until_stop);
        let omega = 12.0 * 0.5 * (sin * along - cos * p);
        let found = velocity(&run, 0.0);
        for (found, known) in found.into_iter().zip([along - v, p, omega]) {
            close(found, known, 1e-12);
        }
        if e == 0.0 {
            close(omega, 1.5 * v * sin, 1e-12);
        }
        assert_eq!(run.end(), Some(0.1));
    }
}

/// Rods that slide and turn at any angle under much friction: they gain no energy and do not sink, whatever they come to on the way. Some have more
/// than one motion, which is refused as before.
#[test]
fn rods_gain_nothing_by_impacts_without_collision() {
    let (mut whole, mut refused) = (0, 0);
    for index in 0..60_u32 {
        let part = |step: f64| (step * f64::from(index)).fract();
        let (tan, mu) = (1.0 + 2.0 * part(0.618), 1.2 + 1.5 * part(0.414));
        let (sin, cos) = tan.atan().sin_cos();
        let (v, omega) = (0.3 + 3.0 * part(0.732), 4.0 * part(0.236) - 2.0);
        let mut model = world();
        add(&mut model, tan, [-v - 0.5 * sin * omega, 0.5 * cos * omega, omega]);
        let e = 0.9 * part(0.303);
        model.surface(Surface::floor("floor", 0 * M, rigid(e)).with_friction(Friction::new(mu)));
        model.painleve = Painleve::Impact;
        let found = model.simulate_to(&[], 0.4 * S, Accuracy::new(1e-11).expect("an accuracy"));
        let run = match found {
            Ok(run) => run,
            Err(error) => {
                let text = error.to_string();
                assert!(text.contains("motions are possible") || text.contains("not determined"), "{text}");
                refused += 1;
                continue;
            }
        };
        whole += 1;
        let body = &run.equations.model().bodies[0];
        let energy = body.kinetic_energy() + body.potential_energy(&model.gravity);
        let formulas = [energy, run.equations.pairs()[0].gap(), run.equations.pairs()[1].gap()];
        let mut before = f64::INFINITY;
        for sample in 0..=200 {
            let found = at(&run, 0.002 * f64::from(sample), formulas.clone());
            assert!(found[0] <= before + 1e-11, "{index}: {} of {before}", found[0] - before);
            assert!(found[1..].iter().all(|gap| *gap > -1e-12), "{index}: {found:?}");
            before = found[0];
        }
    }
    println!("{whole} whole, {refused} refused");
    assert!(whole > 40, "{whole}");
}

/// The same with its top on a smooth wall: it cannot go on about its foot, and stays.
#[test]
fn an_impact_without_collision_of_several_contacts() {
    let tan = 1.3_f64;
    let (sin, cos) = tan.atan().sin_cos();
    let mut model = world();
    let omega = -1.0 / sin;
    add(&mut model, tan, [-0.5, 0.5 * omega * cos, omega]);
    floor(&mut model, 1.1 * alone(tan).max(2.0 * (1.0 + tan * tan) / (3.0 * tan)));
    model.surfaces[0].on = Some(vec!["rod.from".into()]);
    let wall = Surface::new("wall", [cos * M, 0 * M], [-1 * Expr::one(), Expr::zero()], rigid(0.0));
    model.surface(Surface { on: Some(vec!["rod.to".into()]), ..wall });
    assert!(comes_to(model.clone()).expect_err("no forces").contains("Painleve"));
    let run = after_an_impact(model);
    for time in [0.0, 0.1] {
        assert!(velocity(&run, time).iter().all(|rate| rate.abs() < 1e-14), "{:?}", velocity(&run, time));
    }
}

/// A block on a smooth floor drags a hinged rod that leans against its motion: from `mu = cot(steepness)` on no force holds the tip. Compression ends where the tip
/// neither closes nor slips, which stops both; restitution gives back e of the normal impulse, and the tip sticks meanwhile.
#[test]
fn an_impact_without_collision_between_bodies() {
    for (degrees, more, e, mass, speed) in
        [(50.0_f64, 1.01, 0.2, 2.0, 2.0), (60.0, 1.5, 0.7, 0.6, 3.1), (40.0, 1.2, 0.45, 5.0, 0.7)]
    {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let mu = more * cos / sin;
        let mut model = world();
        let rod = model.add(Body::rod("rod", [0 * M, 0 * M], [1 * M, 0 * M]).mass(1 * KG));
        model.pivot_at("hinge", &rod, [0 * M, 0 * M], [0 * M, 0 * M]);
        model.starts.push(("rod".into(), Start::default().angle(Expr::from(-degrees.to_radians()))));
        let shape = Shape::Box { centre: Vector::planar(0 * M, 0 * M), width: 8 * M, height: 0.2 * M };
        model.add(Body::of_shape("block", shape).mass(mass * KG));
        let start = Start::default().at([0 * M, (-sin - 0.1) * M]).velocity([-speed * M / S, 0 * M / S]);
        model.starts.push(("block".into(), start));
        let mut floor = Surface::floor("floor", (-sin - 0.2) * M, rigid(0.0));
        floor.on = Some(vec!["block".into()]);
        model.surface(floor);
        let friction = Some(Friction::new(mu));
        model.contact(BodyContact { friction, ..BodyContact::new("drag", ["rod", "block"], e) });
        assert!(comes_to(model.clone()).expect_err("no forces").contains("Painleve"));
        let run = after_an_impact(model);
        // Of the tip against the block: along the floor, and up.
        let inertia = 1.0 / 3.0;
        let [tt, tn, nn] = [sin * sin / inertia + 1.0 / mass, sin * cos / inertia, cos * cos / inertia];
        let determinant = tt * nn - tn * tn;
        let (along, across) = (-speed * nn / determinant, speed * tn / determinant);
        let across_in_all = (1.0 + e) * across;
        let along_in_all = along - tn / tt * e * across;
        assert!(tn / tt <= mu);
        let omega = (cos * across_in_all + sin * along_in_all) / inertia;
        let [_, _, found] = velocity(&run, 0.0);
        close(found, omega, 1e-11);
        let block = run.equations.model().bodies[1].kinematics();
        let [found] = at(&run, 0.0, [block.velocity().x().clone()]);
        close(found, -speed - along_in_all / mass, 1e-11);
    }
}

/// Beyond the deciding coefficient, with `A = g - l omega^2 sin` and `B = 1 + 3 cos (cos - mu sin) < 0` (Genot and Brogliato 1999): while A > 0 what presses the
/// foot is `A/B < 0`, and no motion is possible; while A < 0 the foot lifts off, or slides on under the force `A/B > 0`.
#[test]
fn the_possible_motions_are_listed() {
    let (tan, mu) = (2.0_f64, 1.6);
    let (sin, cos) = tan.atan().sin_cos();
    let b = 1.0 + 3.0 * cos * (cos - mu * sin);
    for omega in [0.0, 6.0] {
        let a = G - 0.5 * omega * omega * sin;
        let mut model = world();
        add(&mut model, tan, [-1.0 - 0.5 * sin * omega, 0.5 * cos * omega, omega]);
        floor(&mut model, mu);
        let text = comes_to(model).expect_err("it is wedged");
        println!("{text}");
        if a > 0.0 {
            assert!(text.contains("No motion without an impact is possible"), "{text}");
            continue;
        }
        assert!(text.contains("2 motions are possible") && text.contains("slides backward"), "{text}");
        let number = |before: &str| {
            let rest = text.split(before).nth(1).and_then(|rest| rest.split(' ').next());
            rest.and_then(|number| number.parse::<f64>().ok()).expect("a number")
        };
        close(number("the normal force "), a / b, 1e-9);
        close(number("opens with "), -a, 1e-9);
    }
}
