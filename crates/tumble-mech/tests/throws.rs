//! Random throws onto floors and walls: hits against a dense search on the exact flight, what never grows, what stays.

use crate::common::at;
use tumble_expr::Expr;
use tumble_expr::units::{KG, M, S};
use tumble_mech::{Body, ContactLaw, Equations, Gravity, Model, Run, Shape, Start, Surface};
use tumble_ode::{Accuracy, Side, solve};

const G: f64 = 9.81;
/// Throws in an ordinary run of the tests.
const THROWS: u32 = 1_000;
/// How far from its left wall the right one is, m.
const ROOM: f64 = 8.0;

/// Numbers that are the same on every machine.
struct Dice(u64);

impl Dice {
    /// In [0, 1): Steele, Lea and Flood's mixing of a counter.
    fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.roll()
    }
}

/// A kind of body with its touching points: body coordinates and radius.
struct Thrown {
    equations: Equations,
    points: Vec<([f64; 2], f64)>,
}

/// A body of 1 kg in a room with a floor and two walls; the restitution is a parameter.
fn thrown(body: Body, points: Vec<([f64; 2], f64)>) -> Thrown {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(G * M / (S * S));
    let e = model.parameters.set("e", Expr::one()).expect("a number");
    let start = Start::default().at([0.5 * ROOM * M, 5 * M]);
    model.starts.push((body.name.clone(), start));
    model.add(body.mass(1 * KG));
    let law = ContactLaw::Rigid { restitution: e.clone() };
    model.surface(Surface::floor("floor", 0 * M, law.clone()));
    for (name, x, towards) in [("left", 0.0, 1.0), ("right", ROOM, -1.0)] {
        let normal = [Expr::from(towards), Expr::zero()];
        model.surface(Surface::new(name, [x * M, 0 * M], normal, law.clone()));
    }
    Thrown { equations: Equations::new(model).expect("sound"), points }
}

fn kinds() -> Vec<Thrown> {
    let plate =
        Shape::Box { centre: tumble_expr::Vector::planar(0 * M, 0 * M), width: 0.6 * M, height: 0.3 * M };
    let corners = [[-0.3, -0.15], [0.3, -0.15], [0.3, 0.15], [-0.3, 0.15]];
    vec![
        thrown(
            Body::rod("rod", [-0.5 * M, 0 * M], [0.5 * M, 0 * M]),
            vec![([-0.5, 0.0], 0.0), ([0.5, 0.0], 0.0)],
        ),
        thrown(Body::of_shape("box", plate), corners.map(|corner| (corner, 0.0)).to_vec()),
        thrown(Body::ball("ball", 0.2 * M), vec![([0.0, 0.0], 0.2)]),
    ]
}

impl Thrown {
    fn throw(&self, values: &[f64; 7], until: f64, accuracy: f64) -> Run {
        let mut start = self.equations.start(&self.equations.model().parameters).expect("a start in the air");
        start.states = values[..6].to_vec();
        start.inputs = vec![values[6]];
        let accuracy = Accuracy::new(accuracy).expect("allowed");
        let inputs = start.inputs.clone();
        let trajectory = solve(&self.equations, start, until, accuracy);
        let trajectory = trajectory.map_err(|stopped| format!("{values:?}: {stopped}")).expect("a motion");
        Run::of(self.equations.clone(), trajectory, inputs)
    }

    /// Gaps of all pairs in the equations' order: by surface, then by point.
    fn gaps(&self, [x, y, _, _, angle, _]: [f64; 6]) -> Vec<f64> {
        let (sin, cos) = angle.sin_cos();
        let place = |([px, py], r): &([f64; 2], f64)| [x + cos * px - sin * py, y + sin * px + cos * py, *r];
        let places: Vec<[f64; 3]> = self.points.iter().map(place).collect();
        let floor = places.iter().map(|[_, y, r]| y - r);
        let left = places.iter().map(|[x, _, r]| x - r);
        let right = places.iter().map(|[x, _, r]| ROOM - x - r);
        floor.chain(left).chain(right).collect()
    }

    /// The first time after this at which the exact flight brings a gap to zero, with its pair.
    fn first_hit(&self, start: [f64; 6], until: f64) -> Option<(f64, usize)> {
        let lever = self.points.iter().map(|([x, y], _)| x.hypot(*y)).fold(0.0, f64::max);
        let curvature = G + lever * start[5] * start[5];
        let gap = |t: f64, pair: usize| self.gaps(flight(start, t))[pair];
        let pairs = 3 * self.points.len();
        let steps = (until / STEP).ceil() as usize;
        (0..steps).find_map(|step| {
            let [from, to] = [step, step + 1].map(|step| (step as f64 * STEP).min(until));
            let hit = |pair: usize| Some((first_zero(&|t| gap(t, pair), from, to, curvature)?, pair));
            (0..pairs).filter_map(hit).min_by(|a, b| a.0.total_cmp(&b.0))
        })
    }
}

/// Steps of the dense search, s; it divides them where a gap might close within.
const STEP: f64 = 1e-2;
/// A dip into a surface that is shorter than this, s, is a graze.
const SHORTEST: f64 = 1e-7;
/// Rounding of a gap that has just been closed, m.
const TOUCHES: f64 = 1e-14;
/// Arcs shorter than this, s, are so low that only rounding says when they end.
const SHORT_ARC: f64 = 1e-3;

/// The first time between two at which a function goes below zero by more than rounding; its second derivative is at
/// most `curvature`.
fn first_zero(gap: &dyn Fn(f64) -> f64, from: f64, to: f64, curvature: f64) -> Option<f64> {
    let (before, after, length) = (gap(from), gap(to), to - from);
    // Between its ends a function sags by no more than that.
    if before.min(after) > curvature * length * length / 8.0 {
        return None;
    }
    if length > SHORTEST {
        let middle = 0.5 * (from + to);
        let first = first_zero(gap, from, middle, curvature);
        return first.or_else(|| first_zero(gap, middle, to, curvature));
    }
    (after < -TOUCHES && before >= -TOUCHES).then(|| bisected(from, to, gap))
}

fn flight([x, y, vx, vy, angle, omega]: [f64; 6], t: f64) -> [f64; 6] {
    [x + vx * t, y + vy * t - 0.5 * G * t * t, vx, vy - G * t, angle + omega * t, omega]
}

fn bisected(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if f(middle) > 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

fn six(states: &[f64]) -> [f64; 6] {
    states.try_into().expect("six states")
}

fn random_start(dice: &mut Dice) -> [f64; 7] {
    // A tenth of the throws are elastic, a tenth plastic; some do not turn, some fall flat.
    let e = match dice.roll() {
        r if r < 0.1 => 0.0,
        r if r < 0.2 => 1.0,
        r => (r - 0.2) / 0.8,
    };
    let omega = if dice.roll() < 0.1 { 0.0 } else { dice.between(-12.0, 12.0) };
    let angle = if dice.roll() < 0.1 { 0.0 } else { dice.between(-7.0, 7.0) };
    let place = [dice.between(1.0, ROOM - 1.0), dice.between(0.8, 2.0)];
    [place[0], place[1], dice.between(-5.0, 5.0), dice.between(-4.0, 3.0), angle, omega, e]
}

fn energy([_, y, vx, vy, _, omega]: [f64; 6], inertia: f64) -> f64 {
    0.5 * (vx * vx + vy * vy + inertia * omega * omega) + G * y
}

/// Throws of all kinds: everything that holds of each.
fn throws(count: u32, seed: u64) {
    let mut dice = Dice(seed);
    let kinds = kinds();
    let inertias = [1.0 / 12.0, (0.36 + 0.09) / 12.0, 0.4 * 0.04];
    let (mut hits, mut rests, mut zeno_sequences) = (0, 0, 0);
    for number in 0..count {
        let which = number as usize % kinds.len();
        let kind = &kinds[which];
        let start = random_start(&mut dice);
        let run = kind.throw(&start, 1.5, 1e-12);
        hits += compare_hits(kind, &run, &start, 3);
        never_inside(kind, &run, &start);
        losses(&run, inertias[which], start[6]);
        zeno_sequences += run.zeno_sequences();
        rests += run.contacts().iter().filter(|contact| !contact.is_impact).count();
    }
    println!(
        "{count} throws, {hits} hits compared, {rests} lasting contacts, {zeno_sequences} Zeno sequences"
    );
    assert!(hits > count as usize && rests > 0);
}

/// Each of the first hits is where the exact flight since the one before ends.
fn compare_hits(kind: &Thrown, run: &Run, start: &[f64; 7], most: usize) -> usize {
    let mut compared = 0;
    let mut from = (0.0, six(&start[..6]));
    for event in run.trajectory().events.iter().take(most) {
        if event.time - from.0 < SHORT_ARC {
            return compared;
        }
        let Some((after, pair)) = kind.first_hit(from.1, event.time - from.0 + SHORT_ARC) else {
            panic!("{start:?}: no hit is found where the run has one at {} s", event.time);
        };
        let fall = {
            let d = 1e-7;
            let gap = |t: f64| kind.gaps(flight(from.1, t))[pair];
            (gap(after - d) - gap(after + d)) / (2.0 * d)
        };
        // A gap is known to a few ulps of the lengths; a graze knows its time to the root of that.
        let blur = (1e-14 / fall.abs().max(1e-9)).min(1e-6) + 1e-14;
        let error = (from.0 + after - event.time).abs();
        assert!(error < blur, "{start:?}: hit at {} s and not at {}", event.time, from.0 + after);
        compared += 1;
        let touches = run.trajectory().modes[event.mode_after].contacts.is_empty();
        if !touches {
            return compared;
        }
        from = (event.time, six(&event.after));
    }
    // What the search finds before the first event would be a hit that was missed.
    if let Some(event) = run.trajectory().events.first()
        && let Some((after, _)) = kind.first_hit(six(&start[..6]), event.time - 1e-7)
    {
        panic!("{start:?}: the run misses a hit at {after} s");
    }
    compared
}

/// No point is ever inside a surface.
fn never_inside(kind: &Thrown, run: &Run, start: &[f64; 7]) {
    for piece in &run.trajectory().pieces {
        for part in 0..=32 {
            let time = piece.start + (piece.end - piece.start) * f64::from(part) / 32.0;
            let gaps = kind.gaps(six(&piece.states_at(time)));
            let least = gaps.iter().copied().fold(f64::INFINITY, f64::min);
            assert!(least > -1e-12, "{start:?}: {least:e} at {time} s");
        }
    }
}

/// The energy never grows; elastic impacts keep it. A floor does not push along itself.
fn losses(run: &Run, inertia: f64, e: f64) {
    for event in &run.trajectory().events {
        let [before, after] = [&event.before, &event.after].map(|states| energy(six(states), inertia));
        assert!(after <= before + 1e-14 * before.abs(), "energy grows from {before} to {after}");
        if e == 1.0 {
            assert!((after - before).abs() < 1e-13 * before, "{before} {after}");
        }
        let is_wall = |name: &str| name.starts_with("left") || name.starts_with("right");
        let lasting =
            [event.mode_before, event.mode_after].map(|mode| &run.trajectory().modes[mode].contacts);
        let mut lasting = lasting.into_iter().flatten().map(|(pair, _)| &run.equations.pairs()[*pair]);
        if !run.equations.names_of(&event.record).iter().any(|name| is_wall(name))
            && !lasting.any(|pair| is_wall(&pair.name))
        {
            assert_eq!(event.before[2], event.after[2], "a floor pushes along itself");
        }
    }
}

#[test]
fn many_throws() {
    throws(THROWS, 1);
}

/// `cargo test --release -p tumble-mech --test mech throws:: -- --ignored`
#[test]
#[ignore = "takes minutes"]
fn a_hundred_thousand_throws() {
    throws(100_000, 2);
}

/// A corner that dips into the floor for less than half a millisecond.
#[test]
fn a_short_dip_is_a_hit() {
    let start = [
        1.8862582304399043,
        1.5574774781716372,
        2.323355791989364,
        -3.804535667370158,
        6.243316366718197,
        6.780268868233211,
        0.48583187650249776,
    ];
    let plate = &kinds()[1];
    assert_eq!(compare_hits(plate, &plate.throw(&start, 1.5, 1e-12), &start, 3), 3);
}

/// A box that turns by more than half a circle in its arc: the terms of its gap's series are larger than their sum.
#[test]
fn a_long_turn_ends_where_the_corner_touches() {
    let start = [
        4.346292056680474,
        1.9270421901082109,
        0.9027843061818306,
        -2.060729853268083,
        -1.8937726788258544,
        1.9181254912018595,
        0.6174164618993925,
    ];
    let plate = &kinds()[1];
    assert_eq!(compare_hits(plate, &plate.throw(&start, 1.5, 1e-12), &start, 3), 3);
}

/// Impulses and rates afterwards are complementary: what pushes more than it must has stopped, what opens faster than
/// its restitution says was not pushed.
#[test]
fn impulses_are_complementary() {
    let mut dice = Dice(3);
    let kinds = kinds();
    for number in 0..300 {
        let kind = &kinds[number % 2];
        let mut start = random_start(&mut dice);
        if number % 4 < 2 {
            (start[4], start[5]) = (0.0, 0.0);
        }
        let run = kind.throw(&start, 1.0, 1e-12);
        for event in run.trajectory().events.iter().take(4) {
            for impulse in &event.record.impulses {
                let outward = match run.equations.source_name(impulse.source) {
                    load if load.starts_with("floor") => impulse.impulse[1],
                    load if load.starts_with("left") => impulse.impulse[0],
                    _ => -impulse.impulse[0],
                };
                assert!(outward > 0.0, "{impulse:?}");
                let rate = |states: &[f64]| {
                    let [.., vx, vy, _, omega] = six(states);
                    let v = [vx - omega * impulse.arm[1], vy + omega * impulse.arm[0]];
                    (v[0] * impulse.impulse[0] + v[1] * impulse.impulse[1]) / outward
                };
                let (before, after) = (rate(&event.before), rate(&event.after));
                assert!(after >= -1e-12, "{before} {after}");
            }
        }
    }
}

/// An elastic rod bounces for a thousand seconds.
#[test]
fn an_elastic_rod_keeps_its_energy() {
    let rod = &kinds()[0];
    let start = [4.0, 2.0, 0.0, 0.0, 0.6, 2.0, 1.0];
    let run = rod.throw(&start, 1000.0, 1e-12);
    let before = energy(six(&start[..6]), 1.0 / 12.0);
    let after = energy(six(&run.trajectory().last_states().expect("ran")), 1.0 / 12.0);
    println!("{} hits, drift {:e}", run.contacts().len(), after / before - 1.0);
    assert!((after / before - 1.0).abs() < 1e-13, "{after} is not {before}");
    assert!(run.contacts().len() > 1000);
    never_inside(rod, &run, &start);
    let body = run.equations.model().bodies[0].kinematics();
    let [x, vx] = at(&run, 1000.0, [body.position().x().clone(), body.velocity().x().clone()]);
    assert_eq!((x, vx), (4.0, 0.0));
    assert!(run.trajectory().states_at(1000.0, Side::Before).is_some());
}

/// A rod comes to stand upright at a wall and slides away at its foot: the wall holds it from then on, though rounding of the angle
/// may have its force begin below zero.
#[test]
fn a_rod_that_begins_to_lean_on_a_wall_stays_on_it() {
    let start = [
        6.698803229822248,
        1.4590575173779785,
        3.225989150737222,
        -1.54863005462061,
        -5.033411614952675,
        -0.08199737723269607,
        0.17753602329508003,
    ];
    let rod = &kinds()[0];
    let run = rod.throw(&start, 1.5, 1e-12);
    never_inside(rod, &run, &start);
    let last = run.trajectory().pieces.last().expect("pieces");
    assert_eq!(run.trajectory().modes[last.mode].contacts.len(), 2);
}
