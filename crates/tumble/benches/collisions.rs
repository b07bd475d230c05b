//! What a collision costs among more and more bodies: `cargo bench -p tumble --bench collisions`.
//!
//! A gas of equal disks without weight, elastic or not, that fills a part of a box and collides a few times each. For each number of disks: how
//! many collisions there are, of disks with each other and with walls, what one of them costs of the motion alone and of the motion with its check
//! runs and errors, and by how much that has grown since the number before, as a power of the number of disks. Disks that are far apart have
//! nothing to do with each other, so the power is to stay near zero.
//!
//! `cargo bench -p tumble --bench collisions -- 100` goes no further than so many disks.

use std::ops::ControlFlow;
use std::time::Instant;

use tumble_expr::units::{KG, M, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{Body, BodyContact, ContactLaw, Equations, Happening, Model, Run, Shape, Start, Surface};
use tumble_ode::Accuracy;

const DISKS: [usize; 7] = [10, 20, 50, 100, 200, 500, 1000];
/// m
const RADIUS: f64 = 0.05;
/// Distance of places on the grid that disks begin on, in radii: about a fifth of the area is theirs.
const APART: f64 = 4.0;
/// m/s
const SPEED: f64 = 1.0;
/// So long that each disk collides about once, s.
const UNTIL: f64 = 0.2;
/// The least of so many is told where there are few disks.
const TIMES: usize = 3;
const FEW: usize = 100;

fn main() {
    let most = std::env::args().filter_map(|word| word.parse().ok()).next().unwrap_or(usize::MAX);
    for restitution in [1.0, 0.8] {
        println!("restitution {restitution}");
        println!(
            "{:>6} {:>11} {:>14} {:>10} {:>15} {:>7}",
            "disks", "collisions", "of a motion us", "growth", "with errors us", "growth"
        );
        let mut before: Option<(usize, [f64; 2])> = None;
        for disks in DISKS.into_iter().filter(|disks| *disks <= most) {
            let (collisions, costs) = measure(disks, restitution);
            let growth = |which: usize| {
                before.map_or(f64::NAN, |(fewer, least): (usize, [f64; 2])| {
                    (costs[which] / least[which]).ln() / (disks as f64 / fewer as f64).ln()
                })
            };
            let [alone, trusted] = costs.map(|cost| 1e6 * cost);
            println!(
                "{disks:>6} {collisions:>11} {alone:>14.1} {:>10.2} {trusted:>15.1} {:>7.2}",
                growth(0),
                growth(1)
            );
            before = Some((disks, costs));
        }
    }
}

/// Collisions, and s for each of them: of a motion, and of a motion with its check runs.
fn measure(disks: usize, restitution: f64) -> (usize, [f64; 2]) {
    let equations = Equations::new(gas(disks, restitution)).expect("a model");
    let parameters = &equations.model().parameters;
    let go = |_| ControlFlow::Continue(());
    let (mut collisions, mut least) = (0, [f64::INFINITY; 2]);
    for _ in 0..if disks <= FEW { TIMES } else { 1 } {
        let began = Instant::now();
        let run = Run::refined_of(&equations, parameters, UNTIL, Accuracy::DEFAULT, go).expect("a motion");
        least[0] = least[0].min(began.elapsed().as_secs_f64());
        collisions = run.events().map(|event| struck(&event.record.happened)).sum();
        let began = Instant::now();
        Run::trusted_of(&equations, parameters, UNTIL, Accuracy::DEFAULT, go).expect("a motion");
        least[1] = least[1].min(began.elapsed().as_secs_f64());
    }
    (collisions, least.map(|time| time / collisions as f64))
}

fn struck(happened: &[Happening]) -> usize {
    happened.iter().filter(|what| matches!(what, Happening::Contact { .. })).count()
}

/// Disks on a square grid in a box of four walls, with speeds that have nothing to do with each other.
fn gas(disks: usize, restitution: f64) -> Model {
    let mut model = Model::new();
    let side = (disks as f64).sqrt().ceil();
    let length = side * APART * RADIUS;
    for disk in 0..disks {
        let place =
            [disk as f64 % side, (disk as f64 / side).floor()].map(|place| (place + 0.5) * APART * RADIUS);
        // The golden angle: neighbours go different ways.
        let (sine, cosine) = (2.399_963 * disk as f64).sin_cos();
        let speed = SPEED * (0.5 + 0.0037 * ((disk * 7919) % 271) as f64);
        let name = format!("d{disk}");
        let shape = Shape::Disk { centre: Vector::planar(0 * M, 0 * M), radius: RADIUS * M };
        model.add(Body::of_shape(&name, shape).mass(1 * KG));
        let start = Start::default().at(place.map(|part| part * M));
        model.starts.push((name, start.velocity([speed * cosine * M / S, speed * sine * M / S])));
    }
    let law = || ContactLaw::Rigid { restitution: restitution.into() };
    for (name, [x, y], [nx, ny]) in [
        ("left", [0.0, 0.0], [1, 0]),
        ("right", [length, 0.0], [-1, 0]),
        ("floor", [0.0, 0.0], [0, 1]),
        ("top", [0.0, length], [0, -1]),
    ] {
        model.surface(Surface::new(name, [x * M, y * M], [Expr::from(nx), Expr::from(ny)], law()));
    }
    model.contact(BodyContact::of_all("hit", Expr::from(restitution)));
    model
}
