//! Bodies at random that meet each other, a polygon and walls: they do not get into each other, and their energy does not grow.

use tumble_expr::units::{KG, M, S};
use tumble_expr::{Expr, Vector};
use tumble_ode::{Accuracy, Side};

use crate::contact::depth::{Hull, depth};
use crate::contact::start::{Outlines, Whose};
use crate::{Body, BodyContact, ContactLaw, Friction, Gravity, Model, Observer, Run, Shape, Start, Surface};

const G: f64 = 9.81;
/// m
const ROOM: f64 = 1.0;

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
                place(size * libm::cos(angle), size * libm::sin(angle))
            };
            Shape::Polygon { corners: (0..count).map(corner).collect() }
        }
    }
}

/// A room with a block on its floor, and bodies above each other in columns.
fn scene(draw: &mut Draw, bodies: usize) -> Model {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(G * M / (S * S));
    let e = if draw.next() < 0.3 { 0.0 } else { draw.between(0.1, 1.0) };
    let friction = (draw.next() < 0.5).then(|| Friction::new(Expr::from(draw.between(0.05, 0.6))));
    let rigid = || ContactLaw::Rigid { restitution: Expr::from(e) };
    let number = |x: f64| Expr::from(x);
    let walls = [([0.0, 0.0], [0.0, 1.0]), ([-ROOM, 0.0], [1.0, 0.0]), ([ROOM, 0.0], [-1.0, 0.0])];
    let planes = walls.iter().enumerate().map(|(index, (through, normal))| {
        Surface::new(format!("wall{index}"), through.map(|x| x * M), normal.map(number), rigid())
    });
    let block = [[-0.3, 0.0], [0.2, 0.0], [0.1, 0.25], [-0.3, 0.2]].map(|[x, y]| place(x, y));
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
    let contact = BodyContact::of_all("hit", Expr::from(e));
    model.contact(BodyContact { friction, ..contact });
    model
}

/// What is looked at of a motion.
struct Look {
    observer: Observer,
    outlines: Outlines,
    of: Vec<Whose>,
}

impl Look {
    fn new(run: &Run) -> Self {
        let model = run.equations.model();
        let mut outlines = Outlines::default();
        // The block is the last surface.
        let block = Whose::Surface(model.surfaces.len() - 1);
        let of: Vec<Whose> = (0..model.bodies.len()).map(Whose::Body).chain([block]).collect();
        of.iter().for_each(|whose| outlines.add(*whose, model));
        let formulas = [&outlines.formulas[..], &[energy(run)]].concat();
        let observer =
            run.observe(&formulas).map_err(|error| error.to_string()).expect("formulas of the motion");
        Self { observer, outlines, of }
    }

    /// The deepest that two are in each other, m, and the energy, J.
    fn at(&mut self, time: f64) -> [f64; 2] {
        let values = self.observer.at(time, Side::After).expect("within the run");
        let hulls: Vec<Vec<Hull>> =
            self.of.iter().map(|whose| self.outlines.hulls(*whose, &values)).collect();
        let couples = hulls
            .iter()
            .enumerate()
            .flat_map(|(index, one)| hulls[index + 1..].iter().map(move |other| (one, other)));
        let depths =
            couples.flat_map(|(one, other)| one.iter().flat_map(|a| other.iter().map(|b| depth(a, b))));
        [depths.fold(f64::NEG_INFINITY, f64::max), values[values.len() - 1]]
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

/// Depth and growth of energy of a scene, in parts of the room and of the energy; or why it was refused.
fn outcome(seed: u64, bodies: usize, until: f64) -> Result<[f64; 2], String> {
    let mut draw = Draw(seed);
    (0..4).for_each(|_| _ = draw.next());
    let model = scene(&mut draw, bodies);
    let accuracy = Accuracy::new(1e-10).expect("an accuracy");
    let run = model.simulate_to(&[], until * S, accuracy).map_err(|error| error.to_string())?;
    let mut times: Vec<f64> = (0..=200).map(|index| until * f64::from(index) / 200.0).collect();
    times.extend(run.events().map(|event| event.time));
    times.sort_by(f64::total_cmp);
    let mut look = Look::new(&run);
    let found: Vec<[f64; 2]> = times.iter().map(|time| look.at(*time)).collect();
    let all = times;
    if std::env::var("TELL").is_ok() {
        let mut first = true;
        for (pair, t) in found.windows(2).zip(all.windows(2)) {
            if pair[1][0] > 1e-12 && first {
                first = false;
                println!("deep {:e} {:e} between {:e} and {:e}", pair[0][0], pair[1][0], t[0], t[1]);
                let mut hulls = |t: f64| {
                    let values = look.observer.at(t, Side::After).unwrap();
                    look.of.iter().map(|whose| look.outlines.hulls(*whose, &values)).collect::<Vec<_>>()
                };
                for t in t {
                    for h in hulls(*t) {
                        println!("   {h:?}")
                    }
                }
                for event in run.events().filter(|event| (event.time - t[1]).abs() < 2e-2) {
                    let told: Vec<_> = event
                        .record
                        .happened
                        .iter()
                        .map(|h| match h {
                            crate::Happening::Contact { pair, change } => {
                                format!("{} {change:?}", run.equations.pairs()[*pair].name)
                            }
                            o => format!("{o:?}"),
                        })
                        .collect();
                    println!("  {:e} {told:?}", event.time);
                }
            }
        }
        let scale = found[0][1];
        for (pair, t) in found.windows(2).zip(all.windows(2)) {
            if pair[1][1] - pair[0][1] > 1e-11 * scale {
                println!("grows {:e} between {:e} and {:e}", (pair[1][1] - pair[0][1]) / scale, t[0], t[1]);
                for event in run.events().filter(|event| (event.time - t[1]).abs() < 1e-3) {
                    let told: Vec<_> = event
                        .record
                        .happened
                        .iter()
                        .map(|h| match h {
                            crate::Happening::Contact { pair, change } => {
                                format!("{} {change:?}", run.equations.pairs()[*pair].name)
                            }
                            o => format!("{o:?}"),
                        })
                        .collect();
                    println!("  {:e} {told:?} {:?}", event.time, event.record.impulses);
                }
            }
        }
    }
    let deep = found.iter().map(|[deep, _]| *deep).fold(f64::NEG_INFINITY, f64::max);
    let growth = found.windows(2).map(|pair| pair[1][1] - pair[0][1]).fold(0.0, f64::max);
    Ok([deep / ROOM, growth / found[0][1]])
}

#[test]
fn nothing_gets_into_each_other_or_gains_energy() {
    let until = std::env::var("UNTIL").map_or(1.0, |until| until.parse().expect("a number"));
    let count = std::env::var("SCENES").map_or(20, |count| count.parse().expect("a number"));
    let first = std::env::var("SEED").map_or(1, |seed| seed.parse().expect("a number"));
    let mut refused = vec![];
    for seed in first..first + count {
        let start = std::time::Instant::now();
        match outcome(seed, 2 + (seed as usize % 5), until) {
            Ok([deep, growth]) => {
                println!("{seed}: {deep:e} {growth:e} {:?}", start.elapsed());
                assert!(deep < 1e-12, "scene {seed}: {deep:e} deep");
                assert!(growth < 1e-10, "scene {seed}: energy grows by {growth:e}");
            }
            Err(reason) => {
                println!("{seed} {reason} {:?}", start.elapsed());
                refused.push((seed, reason))
            }
        }
    }
    assert!(refused.is_empty(), "{refused:#?}");
}
