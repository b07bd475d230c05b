//! What entering a mode costs: `cargo bench -p tumble --bench modes`.
//!
//! For each change: how long the program of the scene's first mode takes, that of the mode after one such change, and that of a mode
//! of two, each of which has been entered alone: then all parts of it are known. Each is the least of many, in microseconds.

#[path = "../../tumble-mech/tests/common/chain.rs"]
mod chain;

use std::time::{Duration, Instant};

use chain::chain;
use tumble_expr::units::{KG, M, S};
use tumble_mech::{Body, ContactLaw, ContactMode, Equations, Gravity, Mode, Model, Start, Surface};
use tumble_ode::Hybrid;

/// Programs of many bodies are built less often, so that all take about as long: the least time is the one least disturbed.
const BODIES_MEASURED: usize = 500;

fn main() {
    println!("{:>34} {:>10} {:>10} {:>12}", "", "first us", "one us", "two known us");
    print("a ball's contact, of two balls", 2, balls(2), |ball| touching(&[ball]));
    for links in [10, 100] {
        let (near, far) = (links / 3, 2 * links / 3);
        let ends = move |which: usize| [near, far][which];
        let name = |what: &str| format!("{what}, {links} links");
        print(&name("a link's contact"), links, over_floor(links), move |which| touching(&[ends(which)]));
        print(&name("a joint released"), links, over_floor(links), move |which| released(&[ends(which)]));
    }
}

/// A change of a mode.
type Change = Box<dyn Fn(&Equations, &mut Mode)>;

fn touching(pairs: &[usize]) -> Change {
    let pairs = pairs.to_vec();
    Box::new(move |_, mode| {
        mode.contacts.extend(pairs.iter().map(|pair| (*pair, ContactMode::Resting)));
        mode.contacts.sort_unstable();
    })
}

fn released(joints: &[usize]) -> Change {
    let joints = joints.to_vec();
    Box::new(move |_, mode| mode.switched.extend(&joints))
}

fn print(name: &str, bodies: usize, model: Model, change: impl Fn(usize) -> Change) {
    let measured = (0..(BODIES_MEASURED / bodies).max(5)).map(|_| measure(&model, &[change(0), change(1)]));
    let least = measured.reduce(|a, b| std::array::from_fn(|which| a[which].min(b[which])));
    let [first, one, two] = least.unwrap_or_default().map(|time| 1e6 * time.as_secs_f64());
    println!("{name:>34} {first:>10.1} {one:>10.1} {two:>12.1}");
}

/// Of equations that are new: the first mode's program, one after one of the changes, one after both when each is known.
fn measure(model: &Model, changes: &[Change; 2]) -> [Duration; 3] {
    let equations = Equations::new(model.clone()).expect("a model");
    let first = Mode { bodies: (0..model.bodies.len()).collect(), ..Mode::default() };
    let timed = |changes: &[&Change]| {
        let mut mode = first.clone();
        changes.iter().for_each(|change| change(&equations, &mut mode));
        let began = Instant::now();
        equations.program(&mode).expect("a program");
        began.elapsed()
    };
    let [one, other] = changes;
    let times = [timed(&[]), timed(&[one])];
    timed(&[other]);
    [times[0], times[1], timed(&[one, other])]
}

/// Balls over a floor beside each other.
fn balls(balls: usize) -> Model {
    let mut model = falling();
    for ball in 0..balls {
        let name = format!("ball{ball}");
        model.add(Body::point(&name).mass(1 * KG));
        model.starts.push((name, Start::default().at([0.2 * ball as f64 * M, 1 * M])));
    }
    model.surface(floor());
    model
}

/// A chain over a floor that each link may touch with its tip.
fn over_floor(links: usize) -> Model {
    let (mut model, _) = chain(std::iter::repeat_n(1.0, links), |_| 1);
    model.surface(floor());
    model
}

fn falling() -> Model {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(9.81 * M / (S * S));
    model
}

fn floor() -> Surface {
    Surface::floor("floor", -200 * M, ContactLaw::Rigid { restitution: 0.8.into() })
}
