//! Compliant contact of bodies with circles, polygons and each other, against closed forms.

use crate::common::{at, balanced, close, disk, model, motion, place, plate, rod, run, start};
use tumble_expr::units::{M, N, S};
use tumble_expr::{Exponent, Expr};
use tumble_mech::{
    BodyContact, Change, ContactLaw, ContributionKind, Equations, Friction, Happening, Model, Release, Run,
    Surface,
};

const G: f64 = 9.81;
const PI: f64 = std::f64::consts::PI;

fn spring(stiffness: f64, damping: f64) -> ContactLaw {
    let release = Release::AtZeroForce;
    ContactLaw::Spring { stiffness: stiffness * N / M, damping: damping * N * S / M, release }
}

fn hertz(stiffness: f64, damping: f64) -> ContactLaw {
    let root = (1 * M).powr(Exponent::new(3, 2));
    ContactLaw::Hertz { stiffness: stiffness * N / root, damping: damping * S / M }
}

fn happened(run: &Run) -> Vec<String> {
    let events = run.events().flat_map(|event| event.record.happened.clone());
    events.map(|happening| run.equations.name_of(&happening)).collect()
}

/// Two disks of 10 cm and 20 cm, 1 kg and 3 kg, that meet head on along a slanted line with 2 m/s.
fn head_on(law: ContactLaw) -> Model {
    let (along, gap) = ([0.6, 0.8], 0.05);
    let at = |part: f64| along.map(|x| part * x);
    let mut model = model(
        0.0,
        vec![
            (disk("a", 0.1, 1.0), start(at(-0.3 - gap), 0.0, at(1.5), 0.0)),
            (disk("b", 0.2, 3.0), start([0.0, 0.0], 0.0, at(-0.5), 0.0)),
        ],
    );
    model.contact(BodyContact::compliant("hit", law));
    model
}

const REDUCED: f64 = 0.75;
const SPEED: f64 = 2.0;

/// Contact time, and the speed with which the two part.
fn collision(law: ContactLaw) -> (f64, f64, Run) {
    let run = run(head_on(law), 0.4, 1e-13);
    let contacts = run.contacts();
    assert_eq!(contacts.len(), 1);
    let [a, b] = [0, 1].map(|body| motion(&run, body, 0.4));
    (contacts[0].end - contacts[0].start, (b[3] - a[3]) * 0.6 + (b[4] - a[4]) * 0.8, run)
}

/// `pi sqrt(m/k)` with the reduced mass, at any angle; the momentum is kept to the last digits, and nothing turns.
#[test]
fn two_disks_on_a_spring() {
    for stiffness in [1e3, 1e5, 1e7] {
        let (time, speed, run) = collision(spring(stiffness, 0.0));
        close(time * (stiffness / REDUCED).sqrt(), PI, 1e-11);
        close(speed, SPEED, 1e-12);
        for t in [0.025, 0.03, 0.4] {
            let [a, b] = [0, 1].map(|body| motion(&run, body, t));
            for (axis, along) in [(3, 0.6), (4, 0.8)] {
                close(a[axis] + 3.0 * b[axis], (1.5 - 1.5) * along, 1e-14);
            }
            assert!(a[5].abs() < 1e-13 && b[5].abs() < 1e-13);
        }
    }
}

/// Let go where `k d + c d' = 0`; with the damping ratio z the speed that is left is `exp(-z/sqrt(1 - z^2) (pi - atan2(..)))` of it.
#[test]
fn two_disks_on_a_damped_spring() {
    for ratio in [0.05, 0.4, 0.9_f64] {
        let stiffness = 1e4;
        let w0 = (stiffness / REDUCED).sqrt();
        let w = w0 * (1.0 - ratio * ratio).sqrt();
        let (time, speed, run) = collision(spring(stiffness, 2.0 * ratio * w0 * REDUCED));
        let phase = (2.0 * ratio * w0 * w).atan2((2.0 * ratio * ratio - 1.0) * w0 * w0);
        close(time * w, phase, 1e-11);
        close(speed, SPEED * (-ratio * w0 * time).exp(), 1e-12);
        assert_eq!(run.contacts().len(), 1);
    }
}

/// `T = (4/5) B(2/5, 1/2) d/v` with the largest depth `d = (5 m v^2/(4 k))^(2/5)`.
#[test]
fn two_disks_after_hertz() {
    for stiffness in [1e4, 1e6, 1e9] {
        let (time, speed, _) = collision(hertz(stiffness, 0.0));
        let depth = (5.0 * REDUCED * SPEED * SPEED / (4.0 * stiffness)).powf(0.4);
        let expected = 2.943_275_184_324_704_7 * depth / SPEED;
        assert!((time / expected - 1.0).abs() < 1e-12, "{time} is not {expected}");
        close(speed, SPEED, 1e-13);
    }
}

/// With Hunt and Crossley's damping the speeds of approach and of parting have one value of `v + ln(1 - c v)/c`: `c v_1 - ln(1 + c v_1)`
/// before is `-c v_2 - ln(1 - c v_2)` after.
#[test]
fn two_disks_after_hunt_and_crossley() {
    for damping in [0.05, 0.3, 1.5] {
        let (_, left, _) = collision(hertz(1e6, damping));
        let before = damping * SPEED - (1.0 + damping * SPEED).ln();
        let after = -damping * left - (1.0 - damping * left).ln();
        close(after, before, 1e-11);
        assert!(left < SPEED);
    }
}

/// A disk of 10 cm and 2 kg.
fn disk_on(surface: Surface, place: [f64; 2], velocity: [f64; 2], omega: f64) -> Model {
    let mut model = model(G, vec![(disk("disk", 0.1, 2.0), start(place, 0.0, velocity, omega))]);
    model.surface(surface);
    model
}

fn bowl(law: ContactLaw) -> Surface {
    Surface::bowl("bowl", [0 * M, 0 * M], 1 * M, law)
}

/// Put down in the middle of a bowl it swings about `m g/k` below; with damping that is where it comes to rest.
#[test]
fn a_disk_sinks_into_a_bowl() {
    let stiffness = 1e4_f64;
    let (w, depth) = ((stiffness / 2.0).sqrt(), 2.0 * G / stiffness);
    let swings = run(disk_on(bowl(spring(stiffness, 0.0)), [0.0, -0.9], [0.0, 0.0], 0.0), 1.0, 1e-13);
    for t in [0.01, 0.5, 0.99] {
        close(motion(&swings, 0, t)[1], -0.9 - depth * (1.0 - (w * t).cos()), 1e-13);
    }
    let rests = run(disk_on(bowl(spring(stiffness, 200.0)), [0.0, -0.9], [0.0, 0.0], 0.0), 1.0, 1e-13);
    close(motion(&rests, 0, 1.0)[1], -0.9 - depth, 1e-14);
    let [normal] = at(&rests, 1.0, [rests.equations.pairs()[0].force_symbol().into()]);
    close(normal, 2.0 * G, 1e-12);
}

/// About that place it swings to the sides as a pendulum of the length `R - r + m g/k`, and up and down with `sqrt(k/m)`.
#[test]
fn a_disk_swings_in_a_bowl() {
    let stiffness = 1e4_f64;
    let depth = 2.0 * G / stiffness;
    let model = disk_on(bowl(spring(stiffness, 0.0)), [0.0, -0.9], [0.0, 0.0], 0.0);
    let found = Equations::new(model.clone()).expect("a model").equilibrium(&model.parameters);
    let found = found.expect("an equilibrium");
    close(found.poses[0].at[1], -0.9 - depth, 1e-14);
    let expected = [(G / (0.9 + depth)).sqrt(), (stiffness / 2.0).sqrt()];
    for (found, expected) in found.small_motions.frequencies.iter().zip(expected) {
        close(*found, expected, 1e-12);
    }
}

/// Kinetic energy, momenta along x and y, and angular momentum about the origin of all bodies, with what contacts store.
fn kept(run: &Run, time: f64) -> [f64; 4] {
    let equations = &run.equations;
    let mut sums = [Expr::zero(), Expr::zero(), Expr::zero(), Expr::zero()];
    for body in &equations.model().bodies {
        let (mass, motion) = (body.mass_properties(), body.kinematics());
        let (p, v) = (motion.position(), motion.velocity());
        let own = [
            body.kinetic_energy() + body.potential_energy(&equations.model().gravity),
            &mass.mass * &v[0],
            &mass.mass * &v[1],
            &mass.mass * (&p[0] * &v[1] - &p[1] * &v[0]) + &mass.inertia * motion.omega(),
        ];
        sums = std::array::from_fn(|which| &sums[which] + &own[which]);
    }
    at(run, time, sums)
}

/// What all contacts of a model with one law store, J, by depth.
fn stored(run: &Run, time: f64, energy: impl Fn(f64) -> f64) -> f64 {
    let gaps = run.equations.pairs().iter().map(|pair| {
        let limits = pair.within();
        let holds = limits.into_iter().all(|limit| at(run, time, [limit])[0] >= 0.0);
        let [gap] = at(run, time, [pair.gap()]);
        // What is further in is behind the other sides.
        if holds && gap > -0.02 { energy((-gap).max(0.0)) } else { 0.0 }
    });
    gaps.sum()
}

/// Two disks that meet off the line of their centres and do not slip where they touch first: they stick as long as friction can hold them,
/// which takes no energy, and the forces on both act along one line.
#[test]
fn what_does_not_slip_keeps_its_energy() {
    let stiffness = 1e6;
    for (law, energy) in both(stiffness) {
        let mut model = model(
            0.0,
            vec![
                (disk("a", 0.1, 1.0), start([-0.5, 0.15], 0.0, [3.0, 0.2], 2.0)),
                (disk("b", 0.2, 3.0), start([0.0, 0.0], 0.0, [-0.5, 0.1], -4.0)),
            ],
        );
        model.contact(BodyContact::compliant("hit", law.clone()));
        let meets = run(model.clone(), 1.0, 1e-13).contacts()[0].start;
        // With so much spin of the first that it rolls where they touch.
        let free = run(model.clone(), meets, 1e-13);
        let [a, b] = [0, 1].map(|body| motion(&free, body, meets));
        let (dx, dy) = (a[0] - b[0], a[1] - b[1]);
        let (nx, ny) = (dx / dx.hypot(dy), dy / dx.hypot(dy));
        let along = (a[3] - b[3]) * ny - (a[4] - b[4]) * nx;
        let spin = (0.2 * -4.0 + along) / -0.1;
        model.starts[0].1 = start([-0.5, 0.15], 0.0, [3.0, 0.2], spin);
        let contact = model.contacts[0].clone().with_friction(Friction::new(Expr::from(3.0)));
        model.contacts[0] = contact;
        let run = run(model, 1.0, 1e-13);
        let stretch =
            [Change::Rolls, Change::Slides].map(|change| *times(&run, change).last().expect("both"));
        assert!(stretch[1] - stretch[0] > 0.5 * (run.contacts()[0].end - run.contacts()[0].start));
        let first = kept(&run, 0.0);
        let energy = |t: f64| kept(&run, t)[0] + stored(&run, t, &energy);
        let at_first = energy(stretch[0]);
        // Before anything presses it, it slips for a moment.
        assert!(at_first < first[0]);
        for part in [0.01, 0.2, 0.5, 0.8, 0.99] {
            let t = stretch[0] + part * (stretch[1] - stretch[0]);
            close(energy(t) / at_first, 1.0, 1e-12);
            let pair = &run.equations.pairs()[0];
            let [slip, friction] = at(&run, t, [pair.slip_rate(), pair.friction_symbol().into()]);
            assert!(slip.abs() < 1e-13 && friction.abs() > 1e-3, "{slip} {friction}");
        }
        for t in [0.5 * (stretch[0] + stretch[1]), 1.0] {
            for (found, expected) in kept(&run, t).into_iter().zip(first).skip(1) {
                close(found, expected, 1e-13);
            }
        }
        balanced(&run, 1e-12);
    }
}

/// Times of a change of any contact.
fn times(run: &Run, change: Change) -> Vec<f64> {
    let is_it =
        |happening: &Happening| matches!(happening, Happening::Contact { change: own, .. } if *own == change);
    run.events().filter(|event| event.record.happened.iter().any(is_it)).map(|event| event.time).collect()
}

fn step(corners: &[[f64; 2]], law: ContactLaw) -> Surface {
    Surface::polygon("step", corners.iter().map(|corner| place(*corner)).collect(), law)
}

/// A disk that slides off a step goes on about its corner with the depth that it has: no energy is lost, whatever the law.
#[test]
fn a_disk_passes_from_an_edge_to_a_corner() {
    let stiffness = 2e4;
    for (law, energy) in both(stiffness) {
        let block = step(&[[-2.0, -1.0], [0.0, -1.0], [0.0, 0.0], [-2.0, 0.0]], law);
        let run = run(disk_on(block, [-0.2, 0.1 + 1e-3], [0.3, 0.0], 0.0), 1.5, 1e-13);
        assert!(passes(&run, "step.disk.rim.side3", "step.disk.rim.corner3"));
        let whole = kept(&run, 0.0)[0];
        for part in 0..150 {
            let t = 0.01 * f64::from(part);
            close(kept(&run, t)[0] + stored(&run, t, &energy), whole, 1e-12);
        }
        assert!(motion(&run, 0, 1.5)[1] < -0.5);
        balanced(&run, 1e-12);
    }
}

/// The same with a disk that rolls off, and slips when friction cannot hold it any more.
#[test]
fn a_disk_rolls_over_a_corner() {
    let block = step(&[[-2.0, -1.0], [0.0, -1.0], [0.0, 0.0], [-2.0, 0.0]], spring(2e4, 100.0));
    let block = block.with_friction(Friction::new(Expr::from(0.8)));
    let run = run(disk_on(block, [-0.3, 0.1], [0.3, 0.0], -3.0), 1.7, 1e-13);
    println!("{:?}", run.events().map(|e| (e.time, run.equations.names_of(&e.record))).collect::<Vec<_>>());
    balanced(&run, 1e-12);
}

/// A box with its corners on both ends of a step, one end of it lower than the other: it rocks on them.
#[test]
fn a_box_on_a_step() {
    let stiffness = 2e4;
    let block = step(&[[-2.0, -1.0], [2.0, -1.0], [2.0, 0.0], [-2.0, 0.0]], spring(stiffness, 0.0));
    let mut model = model(G, vec![(plate("box", [0.4, 0.2], 2.0), start([0.0, 0.15], 0.1, [0.2, 0.0], 0.0))]);
    model.surface(block);
    let run = run(model, 1.0, 1e-13);
    println!("{:?}", run.events().map(|e| (e.time, run.equations.names_of(&e.record))).collect::<Vec<_>>());
    let whole = kept(&run, 0.0)[0];
    let energy = |d: f64| 0.5 * stiffness * d * d;
    for part in 0..100 {
        let t = 0.01 * f64::from(part);
        close(kept(&run, t)[0] + stored(&run, t, energy), whole, 1e-12);
    }
    balanced(&run, 1e-12);
}

/// A box that slides off a step: where its corner passes the end of the edge the corner of the step takes over the depth, whichever way the
/// box leans, and no energy is lost.
#[test]
fn a_box_slides_off_a_step() {
    for (law, energy) in both(2e4) {
        let block = step(&[[-2.0, -1.0], [0.0, -1.0], [0.0, 0.0], [-2.0, 0.0]], law);
        let mut model =
            model(G, vec![(plate("box", [0.4, 0.2], 2.0), start([-0.3, 0.102], 0.0, [1.0, 0.0], 0.01))]);
        model.surface(block);
        let run = run(model, 0.9, 1e-13);
        println!(
            "{:?}",
            run.events().map(|e| (e.time, run.equations.names_of(&e.record))).collect::<Vec<_>>()
        );
        assert!(passes(&run, "step.box.corner2.side3", "step.box.side1.corner3"));
        let balance = balanced(&run, 1e-12);
        assert!(balance.contributions.iter().all(|part| part.kind != ContributionKind::Release));
        let whole = kept(&run, 0.0)[0];
        for part in 0..90 {
            let t = 0.01 * f64::from(part);
            close(kept(&run, t)[0] + stored(&run, t, &energy), whole, 1e-12);
        }
    }
}

/// Whether one contact ends where another begins.
fn passes(run: &Run, from: &str, to: &str) -> bool {
    let two = [format!("{from}.end"), format!("{to}.start")];
    let names = |event| run.equations.names_of(event);
    run.events().any(|event| names(&event.record).windows(2).any(|own| own == two))
}

type Energy = Box<dyn Fn(f64) -> f64>;

/// Laws without damping, each with the energy that a depth has, J.
fn both(stiffness: f64) -> [(ContactLaw, Energy); 2] {
    [
        (spring(stiffness, 0.0), Box::new(move |d: f64| 0.5 * stiffness * d * d)),
        (hertz(stiffness, 0.0), Box::new(move |d: f64| 0.4 * stiffness * d * d * d.sqrt())),
    ]
}

/// A ball meets others at rest that touch: springs in a row, solved in pieces by its normal modes with 30 digits in mpmath; which ball
/// leaves the others first is found there too.
#[test]
fn a_cradle_that_yields() {
    let gap = 0.1;
    let at = |x: f64, speed: f64| start([x, 0.0], 0.0, [speed, 0.0], 0.0);
    let bodies = vec![
        (disk("a", 0.05, 1.0), at(-0.1 - gap, 1.0)),
        (disk("b", 0.05, 1.0), at(0.0, 0.0)),
        (disk("c", 0.05, 1.0), at(0.1, 0.0)),
    ];
    let mut model = model(0.0, bodies);
    model.contact(BodyContact::compliant("hit", spring(1e5, 0.0)));
    let run = run(model, 0.3, 1e-13);
    let expected = [-0.130_261_695_064_521_05, 0.150_229_569_434_774_1, 0.980_032_125_629_747];
    for (body, speed) in expected.into_iter().enumerate() {
        close(motion(&run, body, 0.29)[3], speed, 1e-12);
    }
    let ends = run.contacts().iter().map(|contact| contact.end - 0.1).collect::<Vec<_>>();
    let root = 1e5_f64.sqrt();
    close(ends[0] * root, 2.554_812_911_197_490_3, 1e-11);
    close(ends[1] * root, 2.554_812_911_197_490_3 + 0.872_163_339_249_687, 1e-11);
}

/// Balls in a row that touch, after Hertz: to ten digits by `scipy`'s DOP853 at a tolerance of 1e-13 in steps of 0.5 us, the first as Herrmann
/// and Schmälzle found them, Simple explanation of a well-known collision experiment, 1981.
#[test]
fn a_cradle_after_hertz() {
    let three = [-0.070_952_353_651, 0.076_403_039_071, 0.994_549_314_580];
    let ten = [
        -0.071_085_017_086,
        -0.030_273_789_364,
        -0.015_833_397_158,
        -0.008_885_695_175,
        -0.005_126_583_159,
        -0.002_985_978_199,
        -0.001_737_668_417,
        0.002_671_954_940,
        0.147_390_307_203,
        0.985_865_866_416,
    ];
    for expected in [&three[..], &ten[..]] {
        let ball = |index: usize| {
            let (x, speed) = if index == 0 { (-0.1, 1.0) } else { (0.1 * index as f64, 0.0) };
            (disk(&format!("b{index}"), 0.05, 1.0), start([x, 0.0], 0.0, [speed, 0.0], 0.0))
        };
        let mut model = model(0.0, (0..expected.len()).map(ball).collect());
        model.contact(BodyContact::compliant("hit", hertz(1e9, 0.0)));
        let run = run(model, 0.2, 1e-12);
        for (body, speed) in expected.iter().enumerate() {
            close(motion(&run, body, 0.2)[3], *speed, 2e-11);
        }
        // They part one after the other, and each contact is told once.
        assert_eq!(run.contacts().len(), expected.len() - 1);
        assert!(run.events().all(|event| !event.record.happened.is_empty()));
    }
}

/// Three balls of which the outer ones meet the middle one at once, from both sides: it stays, and they go back as they came.
#[test]
fn from_both_sides_at_once() {
    let at = |x: f64, speed: f64| start([x, 0.0], 0.0, [speed, 0.0], 0.0);
    let bodies = vec![
        (disk("a", 0.05, 1.0), at(-0.2, 1.0)),
        (disk("b", 0.05, 2.0), at(0.0, 0.0)),
        (disk("c", 0.05, 1.0), at(0.2, -1.0)),
    ];
    let mut model = model(0.0, bodies);
    model.contact(BodyContact::compliant("hit", hertz(1e8, 0.0)));
    let run = run(model, 0.3, 1e-12);
    for (body, speed) in [-1.0, 0.0, 1.0].into_iter().enumerate() {
        close(motion(&run, body, 0.3)[3], speed, 1e-11);
    }
}

/// A box on a post sinks in by `m g/k`, and its lower edge is met by the post.
#[test]
fn a_box_rests_on_a_post() {
    let (mass, stiffness) = (2.0, 5e4);
    let post = Surface::circle("post", [0 * M, 0 * M], 0.3 * M, spring(stiffness, 300.0));
    let mut model =
        model(G, vec![(plate("box", [0.4, 0.1], mass), start([0.0, 0.35], 0.0, [0.0, 0.0], 0.0))]);
    model.surface(post.with_friction(Friction::new(Expr::from(0.5))));
    let run = run(model, 2.0, 1e-13);
    let [x, y, angle, ..] = motion(&run, 0, 2.0);
    close(y, 0.35 - mass * G / stiffness, 1e-13);
    assert!(x.abs() < 1e-12 && angle.abs() < 1e-12, "{x} {angle}");
    assert_eq!(happened(&run)[0], "post.box.side1.start");
}

/// A rod with round ends lies on a block that stands on a slope: all of it comes to rest, each on its own contacts, and nothing creeps. Each
/// presses what is below it by its weight.
#[test]
fn what_sticks_on_a_body_does_not_creep() {
    let slope = 0.3_f64;
    let up = |along: f64, across: f64| {
        [along * slope.cos() - across * slope.sin(), along * slope.sin() + across * slope.cos()]
    };
    let law = || spring(1e5, 600.0);
    let mut model = model(
        G,
        vec![
            (plate("block", [0.6, 0.2], 3.0), start(up(0.0, 0.1), slope, [0.0, 0.0], 0.0)),
            (rod("rod", 0.3, 0.02, 1.0), start(up(0.05, 0.22), slope, [0.0, 0.0], 0.0)),
        ],
    );
    let rough = || Friction::new(Expr::from(0.6));
    let floor = Surface::sloping("floor", [0 * M, 0 * M], &Expr::from(slope), law());
    model.surface(Surface { on: Some(vec!["block".into()]), ..floor.with_friction(rough()) });
    model.contact(BodyContact::compliant("pads", law()).with_friction(rough()));
    let run = run(model, 3.0, 1e-12);
    let [early, late] = [2.0, 3.0].map(|t| [0, 1].map(|body| motion(&run, body, t)));
    for (early, late) in early.iter().flatten().zip(late.iter().flatten()) {
        assert!((early - late).abs() < 1e-12, "{early} {late}");
    }
    let forces = run.equations.pairs().iter().filter(|pair| pair.other.is_some());
    let sums = forces.map(|pair| at(&run, 3.0, [pair.force_symbol().into(), pair.friction_symbol().into()]));
    let sum = sums.fold([0.0, 0.0], |sum, own| [sum[0] + own[0].abs(), sum[1] + own[1]]);
    close(sum[0], G * slope.cos(), 1e-3);
    close(sum[1].abs(), G * slope.sin(), 1e-3);
}
