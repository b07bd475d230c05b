//! Bodies at random that meet each other, a polygon and walls: they do not get into each other, and their energy does not grow.

use std::cell::Cell;
use std::num::NonZero;
use std::ops::ControlFlow;
use std::sync::Mutex;

use tumble_expr::units::{KG, M, N, S};
use tumble_expr::{Expr, Vector};
use tumble_ode::{Accuracy, Side};

use tumble_mech::{
    Body, BodyContact, ContactLaw, Contribution, ContributionKind, Friction, Gravity, Model, Observer,
    Parameters, Release, Run, RunBalance, Shape, Start, Surface,
};

const G: f64 = 9.81;
/// Asked for.
const ACCURACY: f64 = 1e-10;
/// Half the width of the room, m.
const ROOM: f64 = 1.0;
/// Corners of a block on its floor, m.
const BLOCK: [[f64; 2]; 4] = [[-0.3, 0.0], [0.2, 0.0], [0.1, 0.25], [-0.3, 0.2]];

/// Numbers from 0 to 1 in an order of their own (Knuth's linear congruential generator).
struct Draw(u64);

impl Draw {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }
}

fn place(x: f64, y: f64) -> Vector {
    Vector::planar(x * M, y * M)
}

/// A figure within 15 cm of its middle.
fn shape(draw: &mut Draw) -> Shape {
    let size = draw.between(0.05, 0.1);
    match (draw.next() * 4.0) as usize {
        0 => Shape::Disk { centre: place(0.0, 0.0), radius: size * M },
        1 => Shape::Box {
            centre: place(0.0, 0.0),
            width: 2.0 * size * M,
            height: draw.between(0.02, 0.1) * 2.0 * M,
        },
        2 => Shape::Rod {
            from: place(-size, 0.0),
            to: place(size, 0.0),
            end_radius: draw.between(0.005, 0.03) * M,
        },
        _ => {
            let count = 3 + (draw.next() * 4.0) as usize;
            let corner = |index: usize| {
                let angle = std::f64::consts::TAU * index as f64 / count as f64;
                place(size * angle.cos(), size * angle.sin())
            };
            Shape::Polygon { corners: (0..count).map(corner).collect() }
        }
    }
}

/// What the bodies of a scene do where they meet.
#[derive(Clone, Copy)]
enum Law {
    Rigid,
    /// A spring of this stiffness, N/m, and of half the scenes with a damper.
    Spring(f64),
}

/// A room with a block on its floor, and bodies above each other in columns.
fn scene(draw: &mut Draw, bodies: usize, law: Law) -> Model {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(G * M / (S * S));
    let e = if draw.next() < 0.3 { 0.0 } else { draw.between(0.1, 1.0) };
    let friction = (draw.next() < 0.5).then(|| Friction::new(Expr::from(draw.between(0.05, 0.6))));
    let damping = if e > 0.5 { 0.0 } else { 40.0 };
    let rigid = || match law {
        Law::Rigid => ContactLaw::Rigid { restitution: Expr::from(e) },
        Law::Spring(stiffness) => ContactLaw::Spring {
            stiffness: stiffness * N / M,
            damping: damping * N * S / M,
            release: Release::AtZeroForce,
        },
    };
    let walls = [([0.0, 0.0], [0.0, 1.0]), ([-ROOM, 0.0], [1.0, 0.0]), ([ROOM, 0.0], [-1.0, 0.0])];
    let planes = walls.iter().enumerate().map(|(index, (through, normal))| {
        Surface::new(
            format!("wall{index}"),
            through.map(|x| x * M),
            normal.map(|x: f64| Expr::from(x)),
            rigid(),
        )
    });
    let block = BLOCK.map(|[x, y]| place(x, y));
    let block = Surface::polygon("block", block.to_vec(), rigid());
    for surface in planes.chain([block]) {
        model.surface(Surface { friction: friction.clone(), ..surface });
    }
    for index in 0..bodies {
        let (column, row) = (index % 4, index / 4);
        let name = format!("b{index}");
        let at = [-0.6 + 0.4 * column as f64 + draw.between(-0.03, 0.03), 0.5 + 0.35 * row as f64];
        let start = Start::default().at(at.map(|x| x * M)).angle(Expr::from(draw.between(0.0, 6.0)));
        let velocity = [draw.between(-2.0, 2.0), draw.between(-2.0, 0.0)];
        let start = start.velocity(velocity.map(|v| v * M / S)).omega(draw.between(-8.0, 8.0) / S);
        model.starts.push((name.clone(), start));
        model.add(Body::of_shape(name, shape(draw)).mass(draw.between(0.2, 2.0) * KG));
    }
    let contact = match law {
        Law::Rigid => BodyContact::of_all("hit", Expr::from(e)),
        Law::Spring(_) => BodyContact::compliant("hit", rigid()),
    };
    model.contact(BodyContact { friction, ..contact });
    model
}

/// A convex figure in its body's axes: the hull of some corners, thickened by a radius, m.
struct Figure {
    corners: Vec<[f64; 2]>,
    radius: f64,
}

fn number(formula: &Expr) -> f64 {
    Parameters::default().evaluate(std::slice::from_ref(formula)).expect("a number")[0]
}

fn figure(body: &Body) -> Figure {
    let centre = body.mass_properties().centre;
    let corner = |at: &Vector| [0, 1].map(|axis| number(&(&at[axis] - &centre[axis])));
    let figure =
        |corners: Vec<Vector>, radius: f64| Figure { corners: corners.iter().map(corner).collect(), radius };
    match &body.parts[0].shape {
        Shape::Disk { centre, radius } => figure(vec![centre.clone()], number(radius)),
        Shape::Rod { from, to, end_radius } => figure(vec![from.clone(), to.clone()], number(end_radius)),
        shape => figure(shape.edges().into_iter().map(|[corner, _]| corner).collect(), 0.0),
    }
}

impl Figure {
    fn at(&self, [x, y, angle]: [f64; 3]) -> Self {
        let (c, s) = (angle.cos(), angle.sin());
        let corners = self.corners.iter().map(|[a, b]| [x + c * a - s * b, y + s * a + c * b]).collect();
        Self { corners, radius: self.radius }
    }

    /// How deep it is in another, m: the least over all directions of how far one has to go along it to be clear (separating axes). Directions
    /// are the normals of edges, and those from corner to corner.
    fn depth_in(&self, other: &Self) -> f64 {
        let edges = |corners: &[[f64; 2]]| {
            let next = corners.iter().cycle().skip(1);
            corners.iter().zip(next).map(|(a, b)| [b[1] - a[1], a[0] - b[0]]).collect::<Vec<_>>()
        };
        let between =
            self.corners.iter().flat_map(|a| other.corners.iter().map(move |b| [b[0] - a[0], b[1] - a[1]]));
        let all = edges(&self.corners).into_iter().chain(edges(&other.corners)).chain(between);
        let gap = all.filter(|[x, y]| x.hypot(*y) > 0.0).flat_map(|[x, y]| {
            let size = x.hypot(y);
            [[x / size, y / size], [-x / size, -y / size]]
        });
        let gap = gap.map(|axis| {
            let along = |corner: &[f64; 2]| axis[0] * corner[0] + axis[1] * corner[1];
            let far = self.corners.iter().map(along).fold(f64::NEG_INFINITY, f64::max);
            other.corners.iter().map(along).fold(f64::INFINITY, f64::min) - far
        });
        self.radius + other.radius - gap.fold(f64::NEG_INFINITY, f64::max)
    }

    /// How deep it is below the floor or behind the walls of the room, m.
    fn depth_in_room(&self) -> f64 {
        let depth = |[x, y]: &[f64; 2]| (-y).max(-ROOM - x).max(x - ROOM) + self.radius;
        self.corners.iter().map(depth).fold(f64::NEG_INFINITY, f64::max)
    }
}

/// What is looked at of a motion.
struct Look {
    observer: Observer,
    figures: Vec<Figure>,
}

impl Look {
    fn new(run: &Run) -> Self {
        let bodies = &run.equations.model().bodies;
        let pose = |body: &Body| {
            let motion = body.kinematics();
            [motion.position().x().clone(), motion.position().y().clone(), motion.angle()]
        };
        let mut formulas: Vec<Expr> = bodies.iter().flat_map(pose).collect();
        formulas.push(energy(run));
        let observer =
            run.observe(&formulas).map_err(|error| error.to_string()).expect("formulas of the motion");
        Self { observer, figures: bodies.iter().map(figure).collect() }
    }

    /// The deepest that two are in each other, m, and the energy, J.
    fn at(&mut self, time: f64) -> [f64; 2] {
        let values = self.observer.at(time, Side::After).expect("within the run");
        let poses = values.chunks_exact(3).map(|pose| [pose[0], pose[1], pose[2]]);
        let mut placed: Vec<Figure> =
            self.figures.iter().zip(poses).map(|(figure, pose)| figure.at(pose)).collect();
        let in_room = placed.iter().map(Figure::depth_in_room).fold(f64::NEG_INFINITY, f64::max);
        placed.push(Figure { corners: BLOCK.to_vec(), radius: 0.0 });
        let each = placed.iter().enumerate();
        let couples = each.flat_map(|(index, one)| placed[index + 1..].iter().map(move |other| (one, other)));
        let deepest = couples.map(|(one, other)| one.depth_in(other)).fold(in_room, f64::max);
        [deepest, values[values.len() - 1]]
    }
}

fn energy(run: &Run) -> Expr {
    let of = |(index, body): (usize, &Body)| {
        let mass = run.equations.mass_properties(index);
        let motion = body.kinematics();
        let (v, omega) = (motion.velocity(), motion.omega());
        let kinetic = 0.5 * (&mass.mass * (v.x() * v.x() + v.y() * v.y()) + &mass.inertia * &omega * &omega);
        kinetic + &mass.mass * (G * M / (S * S)) * motion.position().y()
    };
    let all = run.equations.model().bodies.iter().enumerate().map(of);
    all.reduce(|sum, next| sum + next).expect("bodies")
}

/// Steps that a scene may take: half of them take about a hundred, and one in a hundred takes more than a thousand.
const MOST_STEPS: usize = 100_000;

/// The motion of a scene of rigid bodies, or why it was refused.
fn motion(seed: u64, bodies: usize, until: f64) -> Result<Run, String> {
    let mut draw = Draw(seed);
    (0..4).for_each(|_| _ = draw.next());
    let model = scene(&mut draw, bodies, Law::Rigid);
    let accuracy = Accuracy::new(ACCURACY).expect("an accuracy");
    let steps = Cell::new(0);
    let patient = |_| {
        steps.set(steps.get() + 1);
        if steps.get() > MOST_STEPS { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let run = Run::refined(model.clone(), &model.parameters, until, accuracy, patient);
    run.map_err(|error| error.to_string())
}

/// Depth and growth of energy of a scene, in parts of the room and of the energy; or why it was refused.
fn outcome(seed: u64, bodies: usize, until: f64) -> Result<[f64; 2], String> {
    let run = motion(seed, bodies, until)?;
    let mut times: Vec<f64> = (0..=200).map(|index| until * f64::from(index) / 200.0).collect();
    times.extend(run.events().map(|event| event.time));
    times.sort_by(f64::total_cmp);
    let mut look = Look::new(&run);
    let found: Vec<[f64; 2]> = times.into_iter().map(|time| look.at(time)).collect();
    let deep = found.iter().map(|[deep, _]| *deep).fold(f64::NEG_INFINITY, f64::max);
    let growth = found.windows(2).map(|pair| pair[1][1] - pair[0][1]).fold(0.0, f64::max);
    Ok([deep / ROOM, growth / found[0][1]])
}

/// A sum of rounding errors, and what the accuracy asked for allows of a motion with friction.
const GROWTH: f64 = 10.0 * ACCURACY;

/// Seeds of scenes that failed, with the reason; on all processors there are.
fn failed(seeds: impl Iterator<Item = u64> + Send) -> Vec<(u64, String)> {
    let fault = |seed: u64| {
        let [deep, growth] = outcome(seed, 2 + (seed as usize % 5), 1.0)?;
        println!("scene {seed}: {deep:e} deep, energy grows by {growth:e}");
        let is_sound = deep < 1e-12 && growth < GROWTH;
        if is_sound { Ok(()) } else { Err(format!("{deep:e} deep, energy grows by {growth:e}")) }
    };
    let (seeds, failed) = (Mutex::new(seeds), Mutex::new(vec![]));
    let next = || seeds.lock().expect("seeds").next();
    let look = || {
        while let Some(seed) = next() {
            let fault = fault(seed).err().map(|reason| (seed, reason));
            failed.lock().expect("what failed").extend(fault);
        }
    };
    let workers = std::thread::available_parallelism().map_or(1, NonZero::get);
    std::thread::scope(|scope| (0..workers).for_each(|_| _ = scope.spawn(look)));
    failed.into_inner().expect("what failed")
}

#[test]
fn nothing_gets_into_each_other_or_gains_energy() {
    // 9 gained energy once, 17 went through the block; 94, 156, 167 and four of six digits went around a circle of modes, in 110277 friction
    // drew a box along that had stopped, 120822 fell through the floor, and in 14, 100289, 120558 and 121003 edges came flush unseen.
    // In 110083 what others made stand had turned a contact round unseen; in 101533 and 131038 friction of impacts too
    // low to be followed pushed on what slides; in 720108 a disk in a corner turned against friction that pushed it on.
    let circles = [94, 156, 167, 100_157, 100_998, 101_119, 101_638];
    // 800424 and 802391 slid against friction with the wrong sign; in 801389, 804463 and 810539 what one instant holds came to no end; in 801210 corners
    // met a hair above their common floor; in 810597 a step was taken to the zero of a slip that is rounding, and in 820007
    // bounces were to end after 1e19 s. In 822088 three corners slid off each other in one point; in 821718 what bounces were to press in the end
    // closed meanwhile; in 4100294 forces that lacked friction let go what they hold with it. In 20009033 only friction of what slides makes contacts
    // independent whose bounces end; in 20003388 one choice of six contacts holds. In 20009597 a body stuck so near an inner corner that
    // rounding told two rows apart that are one; in 20006279 a corner slid off another one, and the edge that it had left pushed again and again; in
    // 31000234 a disk rolled under one that leans on a wall, whose force is none where it is right below. In 47000084, 47000192, 47000529 and 47000629 a
    // force came to zero while what turns was turned faster or slower: without that the contact seemed to press a moment later.
    // In 47000153, 47000198 and 52001074 nothing pressed a moment later either, but for rounding; in 47000763 what closed after an impact of several was rounding of
    // the fastest; in 52005853 what a contact bore was to pass to others beside it, and all of it was rounding; in 52008499 what was to open fell
    // while sliding contacts lacked friction, struck, and lacked it again; in 47000094 impacts ended at once made another contact close, whose impact set them going again, and so on.
    let later = [800_424, 801_210, 801_389, 802_391, 804_463, 810_539, 810_597, 820_007];
    let last = [821_718, 822_088, 4_100_294, 20_003_388, 20_009_033];
    let stuck = [20_006_279, 20_009_597, 31_000_234];
    let turned = [47_000_084, 47_000_192, 47_000_529, 47_000_629];
    let endless = [47_000_094, 47_000_153, 47_000_198, 47_000_763, 52_001_074, 52_005_853, 52_008_499];
    let others = [14, 100_289, 101_533, 110_083, 110_277, 120_558, 120_822, 121_003, 131_038, 720_108];
    let seeds = [1, 2, 5, 7, 9, 10, 12, 15, 17, 20, 21]
        .into_iter()
        .chain(circles)
        .chain(others)
        .chain(later)
        .chain(last)
        .chain(stuck)
        .chain(turned)
        .chain(endless);
    let failed = failed(seeds);
    assert!(failed.is_empty(), "{failed:#?}");
}

/// Each contact of this heap could be held, and all of them together cannot.
#[test]
fn painleves_paradox_of_several_contacts_is_named() {
    let refused = outcome(806_719, 6, 1.0).expect_err("no forces hold it");
    assert!(refused.contains("Painleve's paradox, of several contacts"), "{refused}");
    assert!(refused.contains("slides with the kinetic coefficient"), "{refused}");
}

/// Whatever else is built with it, and on whatever processor: the features of libraries differ between the tests of this package and those of
/// the workspace. What changes arithmetic on purpose changes this number, in both alike.
#[test]
fn a_motion_has_the_same_bits_in_every_build() {
    const BITS: u64 = 0x5007_4640_5caa_aa16;
    let run = motion(804_463, 5, 1.0).expect("a motion");
    let add = |bits: u64, time: f64| bits.rotate_left(5).wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ time.to_bits();
    let bits = run.events().map(|event| event.time).fold(run.events().count() as u64, add);
    assert_eq!(bits, BITS, "{bits:#x}");
}

/// Takes minutes: `cargo test -p tumble-mech --test mech random_scenes:: -- --ignored --nocapture`, perhaps with `SEED=100 COUNT=10`.
#[test]
#[ignore = "takes minutes"]
fn many_scenes() {
    // Of rigid bodies some have no motion, or several: 139 is Painleve's paradox, and in 59 a wedge is pressed by what nobody knows.
    let is_open = |reason: &str| reason.contains("Painleve") || reason.contains("motions are possible");
    let failed: Vec<_> = failed(asked_for()).into_iter().filter(|(_, reason)| !is_open(reason)).collect();
    assert!(failed.is_empty(), "{failed:#?}");
}

/// Seeds from `SEED` on, `COUNT` of them.
fn asked_for() -> std::ops::Range<u64> {
    let asked = |name: &str, otherwise: u64| {
        std::env::var(name).map_or(otherwise, |number| number.parse().expect("a number"))
    };
    let first = asked("SEED", 1);
    first..first + asked("COUNT", 100)
}

/// N/m: bodies that fall on each other are pressed in by millimetres.
const STIFFNESS: f64 = 1e5;

/// The same where all is compliant: what goes into each other is bounded by the energy that it takes, and where nothing touches all the energy is
/// there again that no damper and no friction has taken; the balance closes.
fn compliant(seed: u64) -> Result<(), String> {
    let mut draw = Draw(seed);
    (0..4).for_each(|_| _ = draw.next());
    let model = scene(&mut draw, 2 + (seed as usize % 5), Law::Spring(STIFFNESS));
    let takes = |law: &ContactLaw| matches!(law, ContactLaw::Spring { damping, .. } if number(&(damping / (1 * N * S / M))) > 0.0);
    let loses = takes(&model.surfaces[0].law) || model.surfaces[0].friction.is_some();
    let accuracy = Accuracy::new(ACCURACY).expect("an accuracy");
    let run = model.simulate_to(&[], 1 * S, accuracy).map_err(|error| error.to_string())?;
    let mut look = Look::new(&run);
    let [_, whole] = look.at(0.0);
    let most = (2.0 * whole / STIFFNESS).sqrt();
    let contacts = run.contacts();
    // What leaves an edge at its end while it is pressed in deeper than what takes over leaves the rest behind: it is accounted for.
    let balance = RunBalance::of(&run, [0.0, 0.0]).expect("a balance");
    let left_behind = |of: &&Contribution| of.kind == ContributionKind::Release;
    let released: f64 = balance.contributions.iter().filter(left_behind).map(|of| of.work).sum();
    assert!(released <= GROWTH * whole, "scene {seed}: {released} J out of nothing");
    let is_free = |t: f64| contacts.iter().all(|contact| t < contact.start || t > contact.end);
    for part in 0..=400 {
        let time = f64::from(part) / 400.0;
        let [deep, energy] = look.at(time);
        assert!(deep < most, "scene {seed}: {deep:e} deep at {time}");
        assert!(energy < whole * (1.0 + GROWTH), "scene {seed}: {energy} J of {whole} at {time}");
        assert!(
            loses || !is_free(time) || energy > whole * (1.0 - GROWTH) + released,
            "scene {seed}: {energy} of {whole} at {time}"
        );
    }
    println!("scene {seed}: {} contacts, loses: {loses}, {:e}", contacts.len(), balance.relative());
    assert!(
        balance.relative() < GROWTH && balance.energy.relative() < GROWTH,
        "scene {seed}: {:e}",
        balance.relative()
    );
    Ok(())
}

fn refused_compliant(seeds: impl Iterator<Item = u64>) -> Vec<(u64, String)> {
    seeds.filter_map(|seed| Some((seed, compliant(seed).err()?))).collect()
}

#[test]
fn compliant_bodies_keep_account() {
    // In 4, 10 and 11 ends of rods and corners came into each other unseen.
    let refused = refused_compliant([1, 4, 10, 11].into_iter());
    assert!(refused.is_empty(), "{refused:#?}");
}

/// Takes minutes, as [`many_scenes`] does.
#[test]
#[ignore = "takes minutes"]
fn many_compliant_scenes() {
    let refused = refused_compliant(asked_for());
    assert!(refused.is_empty(), "{refused:#?}");
}
