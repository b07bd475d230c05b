//! Friction on compliant surfaces, where what presses is known: slip, true stick and break-away against closed forms.

use crate::common;

use crate::common::{at, balanced, close, run};
use tumble_expr::units::{KG, M, N, S};
use tumble_expr::{Exponent, Expr, Vector};
use tumble_mech::{
    Application, AppliedImpulse, Body, Change, ContactLaw, ContributionKind, Event, Frame, Friction, Gravity,
    Happening, Model, Place, Release, Run, RunBalance, Shape, Start, Surface, time,
};
use tumble_ode::Side;

const G: f64 = 9.81;
const MASS: f64 = 2.0;
const RADIUS: f64 = 0.2;

fn spring(stiffness: f64, damping: f64) -> ContactLaw {
    let release = Release::AtZeroForce;
    ContactLaw::Spring { stiffness: stiffness * N / M, damping: damping * N * S / M, release }
}

/// With so much damping that it comes to rest in hundredths of a second.
fn damped() -> ContactLaw {
    spring(1e4, 2.0 * (1e4 * MASS).sqrt())
}

fn hertz(stiffness: f64, damping: f64) -> ContactLaw {
    let root = (1 * M).powr(Exponent::new(3, 2));
    ContactLaw::Hertz { stiffness: stiffness * N / root, damping: damping * S / M }
}

fn mu(friction: f64) -> Friction {
    Friction::new(Expr::from(friction))
}

/// One body on a floor, in gravity.
fn on_floor(body: Body, start: Start, law: ContactLaw, friction: Friction) -> Model {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(G * M / (S * S));
    model.starts.push((body.name.clone(), start));
    model.add(body.mass(MASS * KG));
    model.surface(Surface::floor("floor", 0 * M, law).with_friction(friction));
    model
}

fn point() -> Body {
    Body::point("box")
}

/// A uniform ball.
fn ball() -> Body {
    Body::ball("ball", RADIUS * M)
}

/// At a height, with a velocity along the floor and across it.
fn start(height: f64, [vx, vy]: [f64; 2]) -> Start {
    Start::default().at([0 * M, height * M]).velocity([vx * M / S, vy * M / S])
}

/// x, y, vx, vy, angle, omega of the first body.
fn state(run: &Run, time: f64) -> [f64; 6] {
    let body = run.equations.model().bodies[0].kinematics();
    let (c, v) = (body.position(), body.velocity());
    at(run, time, [c.x().clone(), c.y().clone(), v.x().clone(), v.y().clone(), body.angle(), body.omega()])
}

/// Times of a change of any contact.
fn times(run: &Run, change: Change) -> Vec<f64> {
    let is_it =
        |happening: &Happening| matches!(happening, Happening::Contact { change: own, .. } if *own == change);
    run.events().filter(|event| event.record.happened.iter().any(is_it)).map(|event| event.time).collect()
}

fn happened(run: &Run) -> Vec<String> {
    let events = run.events().flat_map(|event| event.record.happened.clone());
    events.map(|happening| run.equations.name_of(&happening)).collect()
}

/// Normal force and friction of all contacts together, N.
fn forces(run: &Run, time: f64) -> [f64; 2] {
    let pairs = run.equations.pairs();
    let sum =
        |of: &dyn Fn(&tumble_mech::Pair) -> Expr| pairs.iter().map(of).reduce(|a, b| a + b).expect("pairs");
    at(run, time, [sum(&|pair| pair.force_symbol().into()), sum(&|pair| pair.friction_symbol().into())])
}

/// A push along the floor at a time, kg m/s.
fn push(model: &mut Model, time_of_it: f64, push: f64) {
    let name = model.bodies[0].name.clone();
    model.events.push(Event {
        name: "push".into(),
        when: time() - time_of_it * S,
        direction: tumble_ode::Direction::Rising,
        action: tumble_mech::Action::Record,
    });
    let at = Place::Material(model.bodies[0].cm());
    let force = Vector::planar(push * N * S, 0 * N * S);
    let application = Application::Force { at, force, frame: Frame::World };
    model.impulses.push(AppliedImpulse { name: "kick".into(), body: name, when: "push".into(), application });
}

/// Put down on a spring without damping, `N = m g (1 - cos w t)`, so `v = v_0 - mu g (t - sin(w t)/w)`: it stops where that is zero, and
/// does not creep from there on while it goes up and down.
#[test]
fn it_stops_while_it_goes_up_and_down() {
    let (friction, speed, stiffness) = (0.3, 1.0, 1e4_f64);
    let run =
        run(on_floor(point(), start(0.0, [speed, 0.0]), spring(stiffness, 0.0), mu(friction)), 0.7, 1e-13);
    let w = (stiffness / MASS).sqrt();
    let left = |t: f64| speed - friction * G * (t - (w * t).sin() / w);
    assert_eq!(times(&run, Change::Slides), [0.0]);
    let sticks = times(&run, Change::Sticks);
    assert_eq!(sticks.len(), 1);
    close(left(sticks[0]), 0.0, 1e-13);
    for t in [0.01, 0.1, 0.3] {
        close(state(&run, t)[2], left(t), 1e-13);
        let normal = MASS * G * (1.0 - (w * t).cos());
        close(forces(&run, t)[0], normal, 1e-11);
        close(forces(&run, t)[1], -friction * normal, 1e-11);
    }
    let [x, y, vx, ..] = state(&run, 0.5);
    let [later, higher, ..] = state(&run, 0.66);
    assert_eq!((vx, x), (0.0, later));
    assert!((y - higher).abs() > 1e-4);
    assert_eq!(forces(&run, 0.5)[1], 0.0);
}

/// `t = v/(mu g)` where `N = m g`, exactly, and from there on nothing moves at all.
#[test]
fn a_block_stops() {
    for law in [damped(), spring(1e7, 2.0 * (1e7 * MASS).sqrt())] {
        let (friction, speed) = (0.3, 2.0);
        let mut model = on_floor(point(), start(0.0, [0.0, 0.0]), law, mu(friction));
        push(&mut model, 2.0, speed * MASS);
        let run = run(model, 50.0, 1e-13);
        let stops = times(&run, Change::Sticks);
        close(stops[stops.len() - 1], 2.0 + speed / (friction * G), 1e-14);
        close(state(&run, 10.0)[0], speed * speed / (2.0 * friction * G), 1e-13);
        close(forces(&run, 2.1)[1], -friction * MASS * G, 1e-12);
        let ([x, _, vx, ..], [later, ..]) = (state(&run, 5.0), state(&run, 50.0));
        assert_eq!((x, vx), (later, 0.0));
    }
}

/// A force that grows evenly: it holds until `k t = mu_s m g`, then `m v' = k t - mu_k m g`.
#[test]
fn a_block_breaks_away() {
    for (of_rest, kinetic) in [(0.5, 0.5), (0.5, 0.3)] {
        let friction = mu(of_rest).kinetic(Expr::from(kinetic));
        let mut model = on_floor(point(), start(0.0, [0.0, 0.0]), damped(), friction);
        let rope = 1.5;
        let centre = model.bodies[0].cm();
        model.force("rope", &centre, Vector::planar(rope * N / S * time(), 0 * N));
        let run = run(model, 10.0, 1e-13);
        let breaks = of_rest * MASS * G / rope;
        let slides = times(&run, Change::Slides);
        close(slides[slides.len() - 1], breaks, 1e-13);
        assert_eq!(state(&run, 1.0)[0], state(&run, breaks * 0.99)[0]);
        let speed =
            |t: f64| (0.5 * rope * (t * t - breaks * breaks) - kinetic * MASS * G * (t - breaks)) / MASS;
        close(state(&run, 10.0)[2], speed(10.0), 1e-12);
        close(forces(&run, 0.5 * breaks)[1], -rope * 0.5 * breaks, 1e-13);
    }
}

/// Backspin on a floor that gives: it slips until the impulse of friction is `m s/(1 + 1/c)`, s the slip at first, and then rolls with
/// `v - s c/(1 + c)`.
#[test]
fn backspin_returns() {
    let (friction, speed, spin, c, stiffness) = (0.2, 2.0, 60.0, 0.4, 3e4_f64);
    let begin = start(RADIUS, [speed, 0.0]).omega(spin / S);
    let run = run(on_floor(ball(), begin, spring(stiffness, 0.0), mu(friction)), 4.0, 1e-13);
    let (slip, w) = (speed + spin * RADIUS, (stiffness / MASS).sqrt());
    let rolls = times(&run, Change::Rolls)[0];
    let rubbed = friction * G * (rolls - (w * rolls).sin() / w);
    close(rubbed, slip / (1.0 + 1.0 / c), 1e-12);
    let [_, _, vx, _, _, omega] = state(&run, 4.0);
    close(vx, speed - slip * c / (1.0 + c), 1e-12);
    close(omega, -vx / RADIUS, 1e-12);
    assert!(vx < 0.0);
}

/// Floors that a ball bounces from, and which part of its speed it leaves them with, without weight.
fn bouncy() -> Vec<(ContactLaw, Option<f64>)> {
    let (stiffness, damping) = (1e4, 30.0);
    let half = damping / (2.0 * MASS);
    let w = (stiffness / MASS - half * half).sqrt();
    let time = (damping * w).atan2(half * damping - stiffness) / w;
    let e = -(-half * time).exp() * ((w * time).cos() - half / w * (w * time).sin());
    vec![
        (spring(stiffness, 0.0), Some(1.0)),
        (spring(stiffness, damping), Some(e)),
        (hertz(1e6, 0.0), Some(1.0)),
        (hertz(1e6, 0.1), None),
    ]
}

/// A ball that bounces with spin. Friction is mu times the normal force all the way, and so are their impulses: the speed along the floor
/// changes by `mu (1 + e) v_n`. With enough friction it comes to roll on the way, and keeps `v - s c/(1 + c)`.
#[test]
fn a_ball_bounces_with_spin() {
    let (speed, spin, down, c) = (1.0, 30.0, 3.0, 0.4);
    for (law, e) in bouncy() {
        for friction in [0.1, 0.9] {
            let begin = start(RADIUS + 0.1, [speed, -down]).omega(spin / S);
            let mut model = on_floor(ball(), begin, law.clone(), mu(friction));
            model.gravity = Gravity::Vertical(0 * M / (S * S));
            let run = run(model, 0.5, 1e-13);
            let [_, _, vx, vy, _, omega] = state(&run, 0.5);
            if let Some(e) = e {
                close(vy, e * down, 1e-12);
            }
            let slip = speed + spin * RADIUS;
            let (slides, rolls) = (friction * (down + vy), slip * c / (1.0 + c));
            let lost = slides.min(rolls);
            close(vx, speed - lost, 1e-12);
            close(omega, spin - lost / (c * RADIUS), 1e-11);
            assert_eq!(times(&run, Change::Rolls).len(), usize::from(rolls < slides));
            let ends = run.contacts()[0].end;
            assert!(run.events().all(|event| event.time <= ends || event.record.happened.len() == 1));
        }
    }
}

/// A rod that comes down on its end without slip: it sticks at once if `mu > 3 sin cos/(1 + 3 sin^2)` by its angle to the floor, and else
/// slips from the start, with friction mu times the normal force until it leaves.
#[test]
fn a_rod_that_lands_slips_from_the_start_or_not_at_all() {
    let angle = 0.8_f64;
    let (sin, cos) = angle.sin_cos();
    let least = 3.0 * sin * cos / (1.0 + 3.0 * sin * sin);
    for law in [spring(1e8, 0.0), spring(1e8, 10.0), hertz(1e10, 0.0)] {
        for off in [-1e-2, 1e-2] {
            let friction = least * (1.0 + off);
            let rod = Body::rod("rod", [-0.5 * M, 0 * M], [0.5 * M, 0 * M]);
            let begin = start(0.5 * sin + 0.001, [0.0, -1.0]).angle(Expr::from(angle));
            let mut model = on_floor(rod, begin, law.clone(), mu(friction));
            model.gravity = Gravity::Vertical(0 * M / (S * S));
            let run = run(model, 0.002, 1e-12);
            let happened = happened(&run);
            let first = if off < 0.0 { "floor.rod.from.slides" } else { "floor.rod.from.sticks" };
            assert_eq!(happened[..2], ["floor.rod.from.start".to_owned(), first.to_owned()]);
            if off < 0.0 {
                let [_, _, vx, vy, ..] = state(&run, 0.002);
                close(vx.abs(), friction * (vy + 1.0), 1e-11);
            }
        }
    }
}

/// Work of friction on a run.
fn rubbed(balance: &RunBalance) -> f64 {
    let own = balance
        .contributions
        .iter()
        .filter(|part| part.load.ends_with(".friction") && part.kind == ContributionKind::Work);
    own.map(|part| part.work).sum()
}

/// What friction takes is the kinetic energy that is lost: of a block all of it, of a ball that comes to roll what its slip had,
/// `m s^2/(2 (1 + 1/c))`.
#[test]
fn the_balance_closes() {
    for (law, _) in bouncy() {
        let begin = start(RADIUS + 0.1, [1.0, 0.0]).omega(30.0 / S);
        let run = run(on_floor(ball(), begin, law, mu(0.5)), 2.0, 1e-13);
        let balance = balanced(&run, 1e-12);
        let slip = 1.0 + 30.0 * RADIUS;
        close(rubbed(&balance), -MASS * slip * slip / (2.0 * (1.0 + 1.0 / 0.4)), 1e-11);
    }
    let run = run(on_floor(point(), start(0.0, [1.0, 0.0]), spring(1e4, 0.0), mu(0.3)), 0.7, 1e-13);
    close(rubbed(&balanced(&run, 1e-12)), -0.5 * MASS, 1e-12);
}

/// A box that stands on its two corners.
fn plate() -> Body {
    let centre = Vector::planar(0 * M, 0 * M);
    Body::of_shape("box", Shape::Box { centre, width: 0.4 * M, height: 0.2 * M })
}

fn on_slope(slope: f64, law: ContactLaw, friction: f64) -> Model {
    let (sin, cos) = slope.sin_cos();
    let begin = Start::default().at([-0.1 * sin * M, 0.1 * cos * M]).angle(Expr::from(slope));
    let mut model = on_floor(plate(), begin, law.clone(), mu(friction));
    model.surfaces[0] =
        Surface::sloping("floor", [0 * M, 0 * M], &Expr::from(slope), law).with_friction(mu(friction));
    model
}

/// On a slope that holds it a box comes to stand, with friction `m g sin` and the normal force `m g cos`, and does not creep.
#[test]
fn a_box_stays_on_a_slope_that_holds_it() {
    let slope = 0.3_f64;
    let run = run(on_slope(slope, spring(1e4, 200.0), 0.4), 100.0, 1e-12);
    let [normal, along] = forces(&run, 10.0);
    close(normal, MASS * G * slope.cos(), 1e-12);
    close(along, MASS * G * slope.sin(), 1e-12);
    let (early, late) = (state(&run, 5.0), state(&run, 100.0));
    for (early, late) in early.into_iter().zip(late).take(2) {
        assert!((early - late).abs() < 1e-15, "{early} {late}");
    }
    assert!(run.trajectory().events.len() < 6, "{:?}", happened(&run));
}

/// What each corner of it bears along the slope is open within both cones, their sum is not.
#[test]
fn corners_of_a_box_share_friction_within_their_cones() {
    let (slope, friction) = (0.3_f64, 0.4);
    let run = run(on_slope(slope, spring(1e4, 200.0), friction), 10.0, 1e-12);
    let pairs = run.equations.pairs();
    let normal: Vec<f64> = pairs.iter().map(|pair| at(&run, 9.0, [pair.force_symbol().into()])[0]).collect();
    let held: Vec<usize> = (0..pairs.len()).filter(|pair| normal[*pair] > 0.0).collect();
    let along: Vec<Expr> = held.iter().map(|pair| pairs[*pair].friction_symbol().into()).collect();
    let [all] = at(&run, 9.0, [&along[0] + &along[1]]);
    close(all.abs(), MASS * G * slope.sin(), 1e-11);
    let spreads =
        |formulas: &[Expr]| run.spreads(formulas, 9.0, Side::After).expect("formulas of the motion");
    assert_eq!(spreads(&[&along[0] + &along[1]]), [None]);
    for (own, other) in [(0, 1), (1, 0)] {
        let [most, others] = [own, other].map(|index| friction * normal[held[index]]);
        let found = spreads(&along[own..=own])[0].expect("it is open");
        close(found.least, (-most).max(all - others), 1e-11);
        close(found.greatest, most.min(all + others), 1e-11);
    }
}

/// Down a slope that does not hold it, on both sides of `tan = mu` by a thousandth: it comes to stand or slides on for good.
#[test]
fn the_angle_of_repose() {
    let friction = 0.4_f64;
    for off in [-1e-3, 1e-3] {
        let slope = (friction * (1.0 + off)).atan();
        let run = run(on_slope(slope, spring(1e4, 400.0), friction), 10.0, 1e-12);
        let [_, _, vx, vy, ..] = state(&run, 10.0);
        let speed = vx * slope.cos() + vy * slope.sin();
        match off < 0.0 {
            true => assert!(speed.abs() < 1e-16, "{speed}"),
            false => {
                let [_, _, vx, vy, ..] = state(&run, 5.0);
                let before = vx * slope.cos() + vy * slope.sin();
                close(speed - before, -5.0 * G * (slope.sin() - friction * slope.cos()), 1e-10);
            }
        }
    }
}

/// A body in all that is watched: it never gains energy, friction keeps to its cone and is against the slip, and holds or is all there.
#[track_caller]
fn obeys(run: &Run, [of_rest, kinetic]: [f64; 2], until: f64) {
    let balance = RunBalance::of(run, [0.3, -0.2]).expect("a balance");
    assert!(balance.energy.relative() < 1e-11, "{:e}", balance.energy.relative());
    let pairs = run.equations.pairs().to_vec();
    for step in 0..1000 {
        let t = until * (f64::from(step) + 0.5) / 1000.0;
        let mut sums = [0.0; 3];
        for pair in &pairs {
            let [gap, slip, normal, along] = at(
                run,
                t,
                [pair.gap(), pair.slip_rate(), pair.force_symbol().into(), pair.friction_symbol().into()],
            );
            assert!(normal >= -1e-9, "{normal} {gap} at {t}");
            assert!(normal == 0.0 || gap <= 1e-12, "{gap} at {t}");
            assert!(along * slip <= 1e-9, "{along} {slip} at {t}");
            if normal > 0.0 && slip.abs() > 1e-9 {
                close(along, -kinetic * normal * slip.signum(), 1e-9);
            }
            sums = [sums[0] + normal, sums[1] + along, if normal > 0.0 { slip } else { sums[2] }];
        }
        assert!(sums[1].abs() <= of_rest * sums[0] * (1.0 + 1e-9) + 1e-9, "{sums:?} at {t}");
    }
}

/// Rods and boxes that are thrown onto compliant floors.
#[test]
fn what_is_thrown_obeys_coulomb() {
    for (index, law) in
        [spring(1e4, 0.0), spring(1e4, 60.0), hertz(1e6, 0.0), hertz(1e6, 0.2)].into_iter().enumerate()
    {
        for (of_rest, kinetic) in [(0.1, 0.1), (0.5, 0.3), (1.5, 1.2)] {
            let friction = mu(of_rest).kinetic(Expr::from(kinetic));
            let rod = Body::rod("rod", [-0.5 * M, 0 * M], [0.5 * M, 0 * M]);
            for body in [rod, plate()] {
                let begin = start(1.0, [2.0, 0.0]).angle(Expr::from(0.5 + 0.1 * index as f64)).omega(2 / S);
                let model = on_floor(body, begin, law.clone(), friction.clone());
                let run = run(model, 3.0, 1e-11);
                let happened = happened(&run);
                assert!(happened.len() > 10, "{happened:?}");
                obeys(&run, [of_rest, kinetic], 3.0);
            }
        }
    }
}

/// What is put on a belt that gives is carried along, and goes with the belt from then on.
#[test]
fn a_belt_takes_it_along() {
    let (friction, belt, stiffness) = (0.4, 1.5, 1e4_f64);
    let mut model = on_floor(point(), start(0.0, [0.0, 0.0]), spring(stiffness, 0.0), mu(friction));
    model.surfaces[0].through = Vector::planar(belt * M / S * time(), 0 * M);
    let run = run(model, 0.8, 1e-13);
    let w = (stiffness / MASS).sqrt();
    let taken = times(&run, Change::Sticks)[0];
    close(friction * G * (taken - (w * taken).sin() / w), belt, 1e-13);
    close(state(&run, 0.7)[2], belt, 1e-15);
    assert_eq!(forces(&run, 0.7)[1], 0.0);
}

/// On a floor that is shaken to and fro, `x = A (1 - cos w t)`, it breaks away where the floor's acceleration is `mu g`.
#[test]
fn a_shaken_floor_breaks_away() {
    let (friction, amplitude, w) = (0.3, 0.05, 4.0_f64);
    let mut model = on_floor(point(), start(0.0, [0.0, 0.0]), damped(), mu(friction));
    // Faster and faster, from rest.
    let way = amplitude * M * (1 - (w / S * time()).cos()) * time() / (1 * S);
    model.surfaces[0].through = Vector::planar(way, 0 * M);
    let run = run(model, 4.0, 1e-12);
    let acceleration = |t: f64| amplitude * (2.0 * w * (w * t).sin() + t * w * w * (w * t).cos());
    let slides: Vec<f64> = times(&run, Change::Slides).into_iter().filter(|time| *time > 1.0).collect();
    close(acceleration(slides[0]).abs(), friction * G, 1e-9);
    let slip = run.equations.pairs()[0].slip_rate();
    assert!(at(&run, 0.99 * slides[0], [slip])[0].abs() < 1e-15);
}

/// A force that begins at an instant is looked at then: with less than the cone it holds, with more it slips at once.
#[test]
fn a_force_that_begins_is_looked_at() {
    for part in [0.99, 1.01] {
        let friction = 0.5;
        let mut model = on_floor(point(), start(0.0, [0.0, 0.0]), damped(), mu(friction));
        let pull = Vector::planar(part * friction * MASS * G * N, 0 * N);
        let load = tumble_mech::Load::force("pull", "box", Place::Material(model.bodies[0].cm()), pull);
        model.loads.push(load.during(2 * S, 3 * S));
        let run = run(model, 2.9, 1e-12);
        let [_, _, vx, ..] = state(&run, 2.9);
        match part < 1.0 {
            true => assert_eq!(vx, 0.0),
            false => {
                close(vx, 0.9 * friction * G * (part - 1.0), 1e-12);
                assert_eq!(times(&run, Change::Slides).last(), Some(&2.0));
            }
        }
    }
}

/// One end on a rigid floor and one on a mat, both rough: a rod that slides is slowed down by mu g, whatever each of them bears, and stops.
#[test]
fn rigid_and_compliant_contacts_hold_one_body() {
    let friction = 0.3;
    let rod = Body::rod("rod", [-0.5 * M, 0 * M], [0.5 * M, 0 * M]);
    let mut model = on_floor(rod, start(0.0, [0.0, 0.0]), common::rigid(0.0), mu(friction));
    model.surfaces[0].on = Some(vec!["rod.from".into()]);
    let mat = Surface::floor("mat", 0 * M, spring(1e5, 300.0)).with_friction(mu(friction));
    model.surface(Surface { on: Some(vec!["rod.to".into()]), ..mat });
    push(&mut model, 2.0, MASS);
    let run = run(model, 4.0, 1e-12);
    assert_eq!(run.trajectory().events.iter().filter(|event| event.time < 2.0).count(), 1);
    let [normal, along] = forces(&run, 1.9);
    close(normal, MASS * G, 1e-10);
    close(along, 0.0, 1e-10);
    let stops = *times(&run, Change::Sticks).last().expect("it stops");
    close(state(&run, stops)[0], 0.5 / (friction * G), 1e-3);
    let [x, ..] = state(&run, stops + 0.5);
    assert!((state(&run, 4.0)[0] - x).abs() < 1e-9);
    obeys_somewhere(&run);
}

/// Each contact keeps to its own cone.
fn obeys_somewhere(run: &Run) {
    for step in 0..400 {
        let t = 4.0 * (f64::from(step) + 0.5) / 400.0;
        let balance = run.equations.pairs().iter().map(|pair| {
            at(run, t, [pair.slip_rate(), pair.force_symbol().into(), pair.friction_symbol().into()])
        });
        for [slip, normal, along] in balance {
            assert!(normal >= -1e-9 && along * slip <= 1e-9, "{normal} {along} {slip} at {t}");
            assert!(
                slip.abs() < 1e-7 || (along.abs() - 0.3 * normal).abs() < 1e-9,
                "{normal} {along} {slip} {t}"
            );
        }
    }
}

/// What there is no law of is refused.
#[test]
fn what_has_no_law_is_refused() {
    let refused = |change: &dyn Fn(&mut Model)| {
        let mut model = on_floor(ball(), start(1.0, [0.0, 0.0]), damped(), mu(0.3));
        change(&mut model);
        model.check().map(|()| String::new()).unwrap_or_else(|mistakes| mistakes.to_string())
    };
    let rolling = || mu(0.3).rolling(0.001 * M);
    assert_eq!(refused(&|_| {}), "");
    let told = refused(&|model| model.surfaces[0].friction = Some(rolling()));
    assert!(told.contains("only what is rigid resists rolling"), "{told}");
    let told = refused(&|model| model.bodies[0].friction = Some(rolling()));
    assert!(told.contains("only what is rigid resists rolling"), "{told}");
    let pulling = |damping: f64| ContactLaw::Spring {
        stiffness: 1e4 * N / M,
        damping: damping * N * S / M,
        release: Release::AtSurface,
    };
    let told = refused(&|model| model.surfaces[0].law = pulling(1.0));
    assert!(told.contains("there is no friction of what pulls"), "{told}");
    assert_eq!(refused(&|model| model.surfaces[0].law = pulling(0.0)), "");
    for law in [damped(), hertz(1e6, 0.0)] {
        for (friction, told) in [
            (mu(-0.1), "friction of `floor` is -0.1: it must not be negative"),
            (mu(0.3).kinetic(Expr::from(0.4)), "static friction of `floor` is less than the kinetic one"),
        ] {
            let model = on_floor(ball(), start(1.0, [0.0, 0.0]), law.clone(), friction);
            let mistakes = model.value_mistakes(&model.parameters);
            assert!(mistakes[0].to_string().contains(told), "{mistakes:?}");
        }
    }
}

/// A box with one foot on rigid ice and the other on a rough mat, which slides: the friction of the mat, at a lever, loads the ice, which holds
/// its foot by as much as that takes.
#[test]
fn friction_of_a_mat_loads_a_rigid_foot() {
    let begin = start(0.1, [2.0, 0.0]);
    let mut model = on_floor(plate(), begin, common::rigid(0.0), mu(0.0));
    model.surfaces[0].on = Some(vec!["box.corner1".into()]);
    let mat = Surface::floor("mat", 0 * M, spring(1e5, 600.0)).with_friction(mu(0.3));
    model.surface(Surface { on: Some(vec!["box.corner2".into()]), ..mat });
    let run = run(model, 0.5, 1e-12);
    let pairs = run.equations.pairs().to_vec();
    let [gap, ice, load, along] = at(
        &run,
        0.4,
        [
            pairs[0].gap(),
            pairs[0].force_symbol().into(),
            pairs[1].force_symbol().into(),
            pairs[1].friction_symbol().into(),
        ],
    );
    assert!(gap.abs() < 1e-14, "{gap}");
    close(along, -0.3 * load, 1e-12);
    // At rest but for the way it slides, torques about the centre balance: half the width and half the height, but for the depth.
    close(ice + load, MASS * G, 1e-4);
    close(0.2 * (load - ice) + 0.1 * along, 0.0, 1e-2);
    balanced(&run, 1e-11);
}

/// Whatever accuracy is asked for, a slip comes to zero once, where it is seen to: a rod that is thrown on a floor stops sliding many times. What is found
/// with few digits is what is found with many.
#[test]
fn a_slip_ends_at_any_accuracy() {
    for index in 0..24_u8 {
        let angle = 0.15 * f64::from(index) - 1.7;
        let rod = Body::rod("rod", [-0.11 * M, 0 * M], [0.11 * M, 0 * M]);
        let begins =
            start(0.3, [3.4 - 0.3 * f64::from(index), 2.9]).angle(Expr::from(angle)).omega(3.3 / (1 * S));
        let law = if index % 2 == 0 { hertz(6.5e5, 0.0) } else { spring(4.5e4, 0.0) };
        let model = on_floor(rod, begins, law, mu(0.445));
        let [many, few] = [1e-9, 1e-5].map(|accuracy| state(&run(model.clone(), 0.75, accuracy), 0.75));
        for (many, few) in many.into_iter().zip(few) {
            close(few, many, 1e-4);
        }
    }
}
