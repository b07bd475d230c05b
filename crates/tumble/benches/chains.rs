//! What chains cost by their links: `cargo bench -p tumble --bench chains`.
//!
//! Uniform rods of 1 m hang from a hook, each pinned to the one before, all held out flat and let go. For each number of links: how long
//! the equations take from the model to the program of the mode, the start with its rows and gaps, and a step; how many steps a
//! fifth of a second takes. All but the number of steps is to grow with the links and no faster.

#[path = "../../tumble-mech/tests/common/chain.rs"]
mod chain;

use std::cell::RefCell;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use chain::chain;
use tumble_mech::{Equations, Run};
use tumble_ode::{Accuracy, Hybrid};

const LINKS: [usize; 7] = [1, 3, 10, 30, 100, 300, 1000];
/// s
const UNTIL: f64 = 0.2;
/// Short chains are measured so often that all take about as long: the least time is the one least disturbed.
const LINKS_MEASURED: usize = 1000;

fn main() {
    println!(
        "{:>6} {:>12} {:>10} {:>6} {:>10} {:>18}",
        "links", "building ms", "start ms", "steps", "step ms", "us a step and link"
    );
    for links in LINKS {
        let runs = (LINKS_MEASURED / links).clamp(1, 20);
        let measured = (0..runs).map(|_| measure(links));
        let least = measured.reduce(|a, b| Costs {
            building: a.building.min(b.building),
            start: a.start.min(b.start),
            running: a.running.min(b.running),
            ..a
        });
        let Some(Costs { building, start, running, steps }) = least else { continue };
        let step = millis(running) / (steps - 1).max(1) as f64;
        println!(
            "{links:>6} {:>12.2} {:>10.2} {steps:>6} {step:>10.3} {:>18.2}",
            millis(building),
            millis(start),
            1e3 * step / links as f64
        );
    }
}

struct Costs {
    building: Duration,
    start: Duration,
    running: Duration,
    steps: usize,
}

fn measure(links: usize) -> Costs {
    let flat = std::iter::repeat_n(std::f64::consts::FRAC_PI_2, links);
    let (model, _) = chain(flat, |_| 1);
    let began = Instant::now();
    let equations = Equations::new(model).expect("a model");
    let parameters = &equations.model().parameters;
    let equations_built = began.elapsed();
    let began = Instant::now();
    let start = equations.start(parameters).expect("a start");
    let starting = began.elapsed();
    let began = Instant::now();
    equations.program(&start.mode).expect("a program");
    let building = equations_built + began.elapsed();
    // From the end of the first step to that of the last: before it the mode is entered.
    let ends = RefCell::new(vec![]);
    let go_on = |_| {
        ends.borrow_mut().push(Instant::now());
        ControlFlow::Continue(())
    };
    Run::refined_of(&equations, parameters, UNTIL, Accuracy::DEFAULT, go_on).expect("a motion");
    let ends = ends.into_inner();
    let running = ends.last().zip(ends.first()).map_or(Duration::ZERO, |(last, first)| *last - *first);
    Costs { building, start: starting, running, steps: ends.len() }
}

fn millis(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}
