//! Disks that meet each other and walls at random: no energy is gained, nothing passes through anything, and instants come to an end.
//!
//! Piles of many disks that bounce on each other for long take minutes: of the ignored tests' scenes, some end by patience only.

use std::cell::Cell;
use std::collections::HashMap;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use crate::common::{as_one, at, rigid};
use tumble_expr::units::{KG, M, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{
    At, Body, BodyContact, Force, Forces, Friction, Gravity, Model, MultipleImpacts, Painleve, Run, RunError,
    Shape, Start, Surface,
};
use tumble_ode::{Accuracy, Side};

/// Half the side of the box, m.
const SIDE: f64 = 1.0;
/// What a gap may be below zero, in parts of the side.
const DEEP: f64 = 1e-12;
/// A force that is none, of bodies of some kg, N: rounding.
const PULL: f64 = 1e-8;
/// What energy may grow by, in parts of it.
const GAIN: f64 = 1e-11;

/// A generator of numbers from 0 to 1, always the same for a seed.
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.next()
    }

    fn is(&mut self, chance: f64) -> bool {
        self.next() < chance
    }
}

/// Two to eight disks in a box of four walls, some with gravity, and some with friction where that is asked for.
fn scene(seed: u64, is_rough: bool) -> Model {
    let mut dice = Dice(seed);
    let mut model = Model::new();
    if dice.is(0.5) {
        model.gravity = Gravity::Vertical(9.81 * M / (S * S));
    }
    if dice.is(0.3) {
        model.multiple_impacts = MultipleImpacts::Sequential;
    }
    let count = 2 + (dice.next() * 7.0) as usize;
    let mut placed: Vec<[f64; 3]> = vec![];
    while placed.len() < count {
        let r = dice.between(0.05, 0.2);
        let [x, y] = [0; 2].map(|_| dice.between(-SIDE + r, SIDE - r));
        let is_free = |other: &[f64; 3]| (x - other[0]).hypot(y - other[1]) > r + other[2];
        if !placed.iter().all(is_free) {
            continue;
        }
        let name = format!("d{}", placed.len());
        let start = Start::default().at([x * M, y * M]).omega(dice.between(-5.0, 5.0) / S);
        let velocity = [0; 2].map(|_| dice.between(-2.0, 2.0) * M / S);
        model.starts.push((name.clone(), start.velocity(velocity)));
        let shape = Shape::Disk { centre: Vector::planar(0 * M, 0 * M), radius: r * M };
        model.add(Body::of_shape(name, shape).mass(dice.between(0.1, 3.0) * KG));
        placed.push([x, y, r]);
    }
    let friction =
        dice.is(0.5).then(|| Friction::new(Expr::from(dice.between(0.05, 0.8)))).filter(|_| is_rough);
    let e = if dice.is(0.2) { 1.0 } else { dice.between(0.0, 0.9) };
    for (name, x, y) in [("left", 1, 0), ("right", -1, 0), ("floor", 0, 1), ("top", 0, -1)] {
        let through = [-SIDE * f64::from(x) * M, -SIDE * f64::from(y) * M];
        let wall = Surface::new(name, through, [Expr::from(x), Expr::from(y)], rigid(e));
        model.surface(Surface { friction: friction.clone(), ..wall });
    }
    model.contact(BodyContact { friction, ..BodyContact::of_all("hit", Expr::from(e)) });
    model
}

fn energy(run: &Run, time: f64) -> f64 {
    let model = run.equations.model();
    let all = model.bodies.iter().map(|body| body.kinetic_energy() + body.potential_energy(&model.gravity));
    at(run, time, [all.reduce(|a, b| a + b).expect("bodies")])[0]
}

fn deepest(run: &Run, time: f64) -> f64 {
    // All at once: each set of formulas is a tape of its own.
    let gaps: Vec<Expr> = run.equations.pairs().iter().map(|pair| pair.gap()).collect();
    let gaps = run.observe(&gaps).expect("gaps").at(time, Side::After).expect("within the run");
    gaps.into_iter().fold(f64::INFINITY, f64::min)
}

/// A force that pulls at a disk where it touches, if there is one: friction along the rim has no part in it.
fn pulls(run: &Run, time: f64) -> Option<String> {
    let forces = Forces::of(run).at(time, Side::After).expect("forces");
    let outward = |force: &Force| {
        let [arm, push] = [force.arm, force.force];
        (arm[0] * push[0] + arm[1] * push[1]) / arm[0].hypot(arm[1])
    };
    let mut contacts = forces.iter().filter(|force| force.arm != [0.0; 2]);
    let pull = contacts.find(|force| outward(force) > PULL)?;
    Some(format!("`{}` pulls with {} N", pull.load, outward(pull)))
}

/// Of a time, the velocities of each body that moves and how they change, m/s, rad/s, m/s^2 and rad/s^2.
fn moving(run: &Run, time: f64) -> Vec<(String, [Vec<f64>; 2])> {
    let observed = |vector: &Vector, rate: Expr| {
        let formulas = [vector.components(), &[rate]].concat();
        run.observe(&formulas).expect("velocities").at(time, Side::After).expect("within the run")
    };
    let rates = |body: &Body| {
        let motion = body.kinematics();
        [observed(&motion.velocity(), motion.omega()), observed(&motion.acceleration(), motion.alpha())]
    };
    let bodies = run.equations.model().bodies.iter().map(|body| (body.name.clone(), rates(body)));
    bodies.filter(|(_, rates)| rates.iter().flatten().any(|rate| rate.abs() > STILL)).collect()
}

/// Why a scene failed, if it did.
fn attack(seed: u64, is_rough: bool, until: f64) -> Result<(), String> {
    let accuracy = Accuracy::new(1e-10).expect("an accuracy");
    let run =
        scene(seed, is_rough).simulate_to(&[], until * S, accuracy).map_err(|error| error.to_string())?;
    if run.end() != Some(until) {
        return Err(format!("ends at {:?}", run.end()));
    }
    let samples = 60;
    let mut before = energy(&run, 0.0);
    let largest = before.abs() + 9.81 * 24.0;
    for sample in 1..=samples {
        let time = until * f64::from(sample) / f64::from(samples);
        let now = energy(&run, time);
        if now > before + GAIN * largest {
            return Err(format!("energy grows by {} before {time} s", now - before));
        }
        before = now;
        let depth = deepest(&run, time);
        if depth < -DEEP * SIDE {
            return Err(format!("a gap is {depth} at {time} s"));
        }
        if let Some(pull) = pulls(&run, time) {
            return Err(format!("{pull} at {time} s"));
        }
    }
    Ok(())
}

fn attack_all(seeds: std::ops::Range<u64>, is_rough: bool) {
    let failed: Vec<(u64, String)> =
        seeds.clone().filter_map(|seed| Some((seed, attack(seed, is_rough, 3.0).err()?))).collect();
    assert!(failed.is_empty(), "{} of {} scenes: {failed:#?}", failed.len(), seeds.end - seeds.start);
}

/// Where bodies that are motions of their own while they are apart are not where they are as one motion, within the errors stated of both.
fn differences(seed: u64, is_rough: bool, until: f64) -> Vec<String> {
    let go = |_| ControlFlow::Continue(());
    let model = scene(seed, is_rough);
    let both = [as_one(&model), model].map(|model| {
        Run::trusted(&model, &model.parameters, until, Accuracy::DEFAULT, go).expect("a motion")
    });
    assert!(both[0].0.tracks().len() == 1 && both[1].0.tracks().len() > 1, "{seed}");
    let mut found = vec![];
    for body in &both[0].0.equations.model().bodies {
        let known = body.kinematics();
        let (place, velocity) = (known.position(), known.velocity());
        let formulas = [place.x(), place.y(), velocity.x(), velocity.y()].map(Expr::clone);
        for formula in formulas.into_iter().chain([known.omega()]) {
            for time in [0.3 * until, 0.7 * until, until] {
                let instant = At { time, side: Side::Before, off: 0.0 };
                let known = both.each_ref().map(|(run, trust)| {
                    let error = trust.error_at(run, &formula, instant).expect("an error")?;
                    Some((at(run, time, [formula.clone()])[0], error))
                });
                // Where either has no digits nothing is said.
                let [Some((one, b)), Some((apart, a))] = known else { continue };
                if (apart - one).abs() > a + b {
                    found.push(format!(
                        "{seed}: {formula:?} at {time} s is {apart} +- {a:e}, as one {one} +- {b:e}"
                    ));
                }
            }
        }
    }
    found
}

/// A number from the environment.
fn asked(name: &str, otherwise: u64) -> u64 {
    std::env::var(name).ok().and_then(|number| number.parse().ok()).unwrap_or(otherwise)
}

#[test]
fn random_disks_gain_nothing_and_pass_through_nothing() {
    attack_all(0..6, false);
}

/// As one disk rolls over another that nothing holds beside it, the forces between several of them come to zero together, and none goes on beyond it.
#[test]
fn where_forces_come_to_zero_together_nothing_pulls() {
    assert_eq!(attack(5029, true, 3.0), Ok(()));
}

#[test]
fn random_rough_disks_gain_nothing_and_pass_through_nothing() {
    attack_all(0..4, true);
}

#[test]
fn disks_apart_move_as_in_one_motion() {
    let found: Vec<String> = (0..8).flat_map(|seed| differences(seed, seed % 2 == 1, 0.6)).collect();
    assert!(found.is_empty(), "{found:#?}");
}

/// More of the same.
#[test]
#[ignore = "takes minutes"]
fn many_disks_apart_move_as_in_one_motion() {
    let from = asked("FROM", 100);
    let seeds = from..from + asked("COUNT", 100);
    let found: Vec<String> = seeds.flat_map(|seed| differences(seed, seed % 2 == 1, 0.8)).collect();
    assert!(found.is_empty(), "{found:#?}");
}

/// Two disks part by next to nothing while one of them comes to rest on the floor under a third: what is zero and opens is not taken for
/// closing, and bounces that are too low to be followed end though others go on.
#[test]
fn a_pile_does_not_switch_without_end() {
    assert_eq!(attack(1020, false, 1.04), Ok(()));
}

/// Slips so slow that friction stops them before they have gone as far as a bounce is high do not let what they hold fall, stick, let it fall
/// again, without end.
#[test]
fn a_rough_pile_does_not_rattle_without_end() {
    assert_eq!(attack(11, true, 1.05), Ok(()));
}

/// More of the same.
#[test]
#[ignore = "takes minutes"]
fn many_random_disks_gain_nothing_and_pass_through_nothing() {
    let from = asked("FROM", 1000);
    attack_all(from..from + asked("COUNT", 200), false);
}

#[test]
#[ignore = "takes minutes"]
fn many_random_rough_disks_gain_nothing_and_pass_through_nothing() {
    let from = asked("FROM", 0);
    attack_all(from..from + asked("COUNT", 40), true);
}

/// A speed or an acceleration that is none: rounding.
const STILL: f64 = 1e-9;

/// Disks in a box, with their radii, m.
struct Fallen {
    model: Model,
    radii: Vec<f64>,
}

/// Disks of many sizes that fall in a box, with friction 0.3 and restitution 0.5, from a grid in which they are a little aside.
fn pile(count: usize, seed: u64) -> Fallen {
    let columns = (count as f64).sqrt().ceil();
    fallen((count, seed), columns, [0.3, 0.45], Friction::new(Expr::from(0.3)))
}

/// The same in a box so wide that they lie beside each other in the end, with rolling resistance: else what rolls alone would not stop.
fn layer(count: usize, seed: u64) -> Fallen {
    let columns = (count as f64 / 2.0).ceil();
    let rolling = Some(Expr::from(0.005 * 2.0 * SIDE / columns) * M);
    fallen((count, seed), columns, [0.2, 0.25], Friction { rolling, ..Friction::new(Expr::from(0.3)) })
}

/// Disks that fall from a grid of so many columns, with radii from one part of its width to another.
fn fallen((count, seed): (usize, u64), columns: f64, [least, most]: [f64; 2], friction: Friction) -> Fallen {
    let (mut dice, mut radii) = (Dice(seed), vec![]);
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(9.81 * M / (S * S));
    let grid = 2.0 * SIDE / columns;
    for index in 0..count {
        let r = grid * dice.between(least, most);
        radii.push(r);
        let (column, row) = (index as f64 % columns, (index as f64 / columns).floor());
        let aside = dice.between(-1.0, 1.0) * (0.5 * grid - r);
        let place = [(column + 0.5) * grid - SIDE + aside, (row + 0.5) * grid - SIDE];
        let name = format!("d{index}");
        model.starts.push((name.clone(), Start::default().at(place.map(|part| part * M))));
        let shape = Shape::Disk { centre: Vector::planar(0 * M, 0 * M), radius: r * M };
        model.add(Body::of_shape(name, shape).mass((r / grid).powi(2) * KG));
    }
    let friction = Some(friction);
    for (name, x, y) in [("left", 1, 0), ("right", -1, 0), ("floor", 0, 1)] {
        let through = [-SIDE * f64::from(x) * M, -SIDE * f64::from(y) * M];
        let wall = Surface::new(name, through, [Expr::from(x), Expr::from(y)], rigid(0.5));
        model.surface(Surface { friction: friction.clone(), ..wall });
    }
    model.contact(BodyContact { friction, ..BodyContact::of_all("hit", Expr::from(0.5)) });
    // Among many that slide and roll some are wedged.
    model.painleve = Painleve::Impact;
    model.stops_at_rest = true;
    Fallen { model, radii }
}

/// `COUNT` disks by `SEED`, 200 of them if nothing else is said, fall until all of them rest, for at most `UNTIL` s and `SECONDS` of this test.
#[test]
#[ignore = "takes minutes"]
fn many_disks_come_to_rest_beside_each_other() {
    let patience = Duration::from_secs(asked("SECONDS", 3600));
    come_to_rest(
        &layer(asked("COUNT", 200) as usize, asked("SEED", 17)),
        asked("UNTIL", 20) as f64,
        patience,
    );
}

/// The same on top of each other, where they rest or roll on alone.
#[test]
#[ignore = "takes longer than anybody waits"]
fn a_pile_of_disks_comes_to_rest() {
    let patience = Duration::from_secs(asked("SECONDS", 3600));
    come_to_rest(&pile(asked("COUNT", 200) as usize, asked("SEED", 17)), asked("UNTIL", 20) as f64, patience);
}

#[test]
fn a_few_disks_come_to_rest_on_each_other() {
    // By seed 17 three disks are wedged, and several motions possible.
    for (count, seed) in [(2, 17), (3, 18), (4, 17)] {
        come_to_rest(&pile(count, seed), 8.0, Duration::from_secs(60));
    }
}

#[test]
fn some_disks_come_to_rest_beside_each_other() {
    come_to_rest(&layer(12, 17), 8.0, Duration::from_secs(60));
}

/// Of slips that differ by a thousand times the slowest is the one that no forces allow, and that an impulse without collision stops.
#[test]
fn in_a_pile_the_slowest_slip_is_stopped_without_collision() {
    let run = |painleve: Painleve| {
        let model = Model { painleve, stops_at_rest: false, ..pile(5, 24).model };
        let accuracy = Accuracy::new(1e-9).expect("an accuracy");
        let go = |_| ControlFlow::Continue(());
        Run::refined(model.clone(), &model.parameters, 1.490_24, accuracy, go).map(|run| run.end())
    };
    let refused = run(Painleve::Refused).expect_err("no forces").to_string();
    assert!(refused.contains("Painleve") || refused.contains("no impulses or forces"), "{refused}");
    assert_eq!(run(Painleve::Impact).map_err(|error| error.to_string()), Ok(Some(1.490_24)));
}

/// Friction of low bounces that are ended at once stops slips and does not push them on, past zero, to where no forces hold what presses.
#[test]
fn in_a_pile_low_bounces_end_without_pushing_slips_on() {
    let model = Model { stops_at_rest: false, ..pile(5, 23).model };
    let accuracy = Accuracy::new(1e-9).expect("an accuracy");
    let go = |_| ControlFlow::Continue(());
    let run = Run::refined(model.clone(), &model.parameters, 0.9317, accuracy, go).map(|run| run.end());
    assert_eq!(run.map_err(|error| error.to_string()), Ok(Some(0.9317)));
}

fn come_to_rest(Fallen { model, radii }: &Fallen, until: f64, patience: Duration) {
    let (begun, told) = (Instant::now(), Cell::new(0.0));
    let accuracy = Accuracy::new(1e-9).expect("an accuracy");
    let found = Run::refined(model.clone(), &model.parameters, until, accuracy, |time| {
        if time >= told.get() {
            println!("{time:.4} s after {:.1} s", begun.elapsed().as_secs_f64());
            told.set(time + 0.01);
        }
        if begun.elapsed() > patience { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    let (run, refusal) = match found {
        Ok(run) => (run, None),
        Err(RunError::Refused { refusal, partial }) => (*partial, Some(refusal.to_string())),
        Err(error) => panic!("{error}"),
    };
    let (events, work) = (run.events().count(), run.work());
    println!("{events} events, {work:?} after {:.1} s", begun.elapsed().as_secs_f64());
    assert_eq!(refusal, None);
    let end = run.end().expect("it is not empty");
    // What rolls alone on the level floor has nothing that would stop it.
    let moving = moving(&run, end);
    println!("at {end} s: {moving:?}");
    let rolls_on = |(_, [velocity, change]): &(String, [Vec<f64>; 2])| {
        velocity[1].abs() <= STILL && change.iter().all(|change| change.abs() <= STILL)
    };
    assert!(moving.iter().all(rolls_on), "at {end} s");
    assert!(shallowest(radii, &run) > -DEEP * SIDE);
}

/// Smallest gap at the end between any two disks, or one and the box, m. By their places alone: all gaps as formulas of one motion take more memory
/// than there is.
fn shallowest(radii: &[f64], run: &Run) -> f64 {
    let last: HashMap<String, f64> =
        run.last_states().into_iter().map(|(symbol, value)| (symbol.name.to_string(), value)).collect();
    let disk = |(index, r): (usize, &f64)| [last[&format!("d{index}.x")], last[&format!("d{index}.y")], *r];
    let disks: Vec<[f64; 3]> = radii.iter().enumerate().map(disk).collect();
    let walls = disks.iter().map(|[x, y, r]| (SIDE - x.abs()).min(y + SIDE) - r);
    let each = disks.iter().enumerate();
    let couples = each.flat_map(|(index, one)| disks[..index].iter().map(move |other| [one, other]));
    let apart = couples.map(|[[x, y, r], [u, v, s]]| (x - u).hypot(y - v) - r - s);
    walls.chain(apart).fold(f64::INFINITY, f64::min)
}
