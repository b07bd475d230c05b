//! What bodies cost that nothing couples: `cargo bench -p tumble --bench balls`.
//!
//! Balls are dropped from different heights beside each other and bounce for three seconds. For each number of balls: how long the
//! equations take, the motion alone, and the motion with its check runs and errors; each by the ball, and of the last by how much one
//! more ball costs. None of that is to grow with their number.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use tumble_expr::units::{KG, M, S};
use tumble_mech::{Body, ContactLaw, Equations, Gravity, Model, Run, Start, Surface};
use tumble_ode::Accuracy;

const BALLS: [usize; 7] = [1, 3, 10, 30, 100, 300, 1000];
/// s
const UNTIL: f64 = 3.0;
/// Few balls are measured so often that all take about as long: the least time is the one least disturbed.
const BALLS_MEASURED: usize = 2000;

fn main() {
    println!(
        "{:>6} {:>12} {:>11} {:>12} {:>18}",
        "balls", "building us", "motion us", "trusted us", "one more ball us"
    );
    let mut before: Option<(usize, Duration)> = None;
    for balls in BALLS {
        let measured = (0..(BALLS_MEASURED / balls).clamp(1, 50)).map(|_| measure(balls));
        let least = measured.reduce(|a, b| [0, 1, 2].map(|which: usize| a[which].min(b[which])));
        let Some([building, motion, trusted]) = least else { continue };
        let each = |time: Duration| 1e6 * time.as_secs_f64() / balls as f64;
        let more = before.map_or(f64::NAN, |(fewer, time)| {
            1e6 * (trusted.as_secs_f64() - time.as_secs_f64()) / (balls - fewer) as f64
        });
        println!(
            "{balls:>6} {:>12.1} {:>11.1} {:>12.1} {more:>18.1}",
            each(building),
            each(motion),
            each(trusted)
        );
        before = Some((balls, trusted));
    }
}

/// Building the equations, a first motion with them, and then one with its check runs and errors.
fn measure(balls: usize) -> [Duration; 3] {
    let model = dropped(balls);
    let go = |_| ControlFlow::Continue(());
    let began = Instant::now();
    let equations = Equations::new(model).expect("a model");
    let building = began.elapsed();
    let parameters = &equations.model().parameters;
    let began = Instant::now();
    Run::refined_of(&equations, parameters, UNTIL, Accuracy::DEFAULT, go).expect("a motion");
    let motion = began.elapsed();
    let began = Instant::now();
    Run::trusted_of(&equations, parameters, UNTIL, Accuracy::DEFAULT, go).expect("a motion");
    [building, motion, began.elapsed()]
}

/// Balls over a floor, 0.2 m from each other.
fn dropped(balls: usize) -> Model {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(9.81 * M / (S * S));
    for ball in 0..balls {
        let name = format!("ball{ball}");
        model.add(Body::point(&name).mass(1 * KG));
        // 7919 is prime to 100: neighbours fall from heights that have nothing to do with each other.
        let height = 1.0 + 0.0037 * ((ball * 7919) % 100) as f64;
        model.starts.push((name, Start::default().at([0.2 * ball as f64 * M, height * M])));
    }
    model.surface(Surface::floor("floor", 0 * M, ContactLaw::Rigid { restitution: 0.8.into() }));
    model
}
