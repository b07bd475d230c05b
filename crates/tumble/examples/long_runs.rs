//! Linkages over a thousand seconds: `cargo run --release -p tumble --example long_runs [-- SECONDS]`.
//!
//! A four-bar linkage that swings, and parallelograms of one loop and of two, whose third crank follows from the others, that swing or
//! turn round through their flat poses. Cranks and rocker are on pivots. Printed are, along the whole run, the largest distance of points that are joined, the largest
//! change of the energy in parts of what there is of it above rest, how many singular configurations were passed, and the time it took.
//! The motion is looked at where steps end and between. What turns round for so long has angles of ten thousand radians, whose doubles
//! are 2e-12 rad apart.

use std::time::Instant;

use tumble_expr::Expr;
use tumble_expr::units::{KG, M, S};
use tumble_mech::{Anchor, Body, Gravity, Happening, Joint, Model, Run, Start};
use tumble_ode::{Accuracy, Side};

/// s, unless it is said.
const SECONDS: f64 = 1000.0;
/// m/s^2
const G: f64 = 9.81;
/// Places within each step that are looked at, and its end.
const WITHIN: usize = 4;

fn main() {
    let seconds = std::env::args().nth(1).map_or(Ok(SECONDS), |word| word.parse());
    let seconds = seconds.expect("a number of seconds");
    println!(
        "{:<34} {:>9} {:>8} {:>12} {:>10} {:>8}",
        "linkage", "end s", "steps", "closure m", "energy", "passed"
    );
    tell("four-bar, swinging", four_bar(), seconds);
    tell("parallelogram, swinging", parallelogram(2, -1.0, 0.0), seconds);
    tell("parallelogram, turning", parallelogram(2, 1.7, 8.0), seconds);
    tell("two loops, swinging", parallelogram(3, -1.0, 0.0), seconds);
    tell("two loops, turning", parallelogram(3, 1.7, 8.0), seconds);
}

fn tell(name: &str, model: Model, seconds: f64) {
    let began = Instant::now();
    let accuracy = Accuracy::new(1e-12).expect("an accuracy");
    let run = match model.simulate_to(&[], seconds * S, accuracy) {
        Ok(run) => run,
        Err(error) => return println!("{name:<34} {error}"),
    };
    let took = began.elapsed().as_secs_f64();
    let (closure, energy) = worst(&run);
    let steps: usize = run.tracks().map(|track| track.pieces.len()).sum();
    let passed = run.events().filter(|event| event.record.happened.contains(&Happening::Singular)).count();
    println!("{name:<34} {seconds:>9} {steps:>8} {closure:>12.2e} {energy:>10.1e} {passed:>8}   {took:.1} s");
}

/// The largest distance of joined points, m, and the largest change of the energy in parts of its kinetic part's largest value.
fn worst(run: &Run) -> (f64, f64) {
    let model = run.equations.model();
    let bodies = || model.bodies.iter();
    let sum = |of: &dyn Fn(&Body) -> Expr| bodies().map(of).reduce(|sum, own| sum + own).expect("bodies");
    let kinetic = sum(&Body::kinetic_energy);
    let potential = sum(&|body| body.potential_energy(&model.gravity));
    let gaps = model.joints.iter().flat_map(|joint| {
        let [a, b] = joint.ends.clone().map(|end| match end {
            Anchor::Material(point) => point.position(),
            Anchor::World(place) => place,
        });
        let gap = a - b;
        [gap.x().clone(), gap.y().clone()]
    });
    let formulas: Vec<Expr> = [&kinetic + &potential, kinetic].into_iter().chain(gaps).collect();
    let mut observer = run.observe(&formulas).expect("formulas of the motion");
    let (mut first, mut change, mut most, mut closure) = (None, 0.0_f64, 0.0_f64, 0.0_f64);
    let pieces = run.tracks().flat_map(|track| &track.pieces);
    let times = pieces.flat_map(|piece| {
        (0..=WITHIN).map(|at| piece.start + (piece.end - piece.start) * at as f64 / WITHIN as f64)
    });
    for time in times {
        let values = observer.at(time, Side::Before).expect("within");
        let start = *first.get_or_insert(values[0]);
        change = change.max((values[0] - start).abs());
        most = most.max(values[1]);
        values[2..].chunks(2).for_each(|gap| closure = closure.max(gap[0].hypot(gap[1])));
    }
    (closure, change / most)
}

fn named(body: &Body, point: &str) -> Anchor {
    Anchor::Material(body.named_point(point).expect("given"))
}

fn bar(model: &mut Model, name: &str, length: f64) -> Body {
    let bar = Body::rod(name, [0 * M, 0 * M], [length * M, 0 * M]).mass(2.0 * length * KG);
    model.add(bar.with_point("start", [0 * M, 0 * M]).with_point("end", [length * M, 0 * M]))
}

fn vertical() -> Model {
    Model { gravity: Gravity::Vertical(G * M / (S * S)), ..Model::new() }
}

fn pin(model: &mut Model, name: &str, ends: [Anchor; 2]) {
    model.join(Joint { assemble: true, ..Joint::pin(name, ends) });
}

/// Crank, coupler, rocker and base of 0.2, 0.5, 0.4 and 0.5 m, let go at rest.
fn four_bar() -> Model {
    let mut model = vertical();
    let bars = [("crank", 0.2, 1.36), ("coupler", 0.5, 0.35), ("rocker", 0.4, 1.6)];
    let [crank, coupler, rocker] = bars.map(|(name, length, angle)| {
        model.starts.push((name.into(), Start::default().angle(Expr::from(angle))));
        bar(&mut model, name, length)
    });
    model.pivot_at("A0", &crank, [0 * M, 0 * M], [0 * M, 0 * M]);
    model.pivot_at("B0", &rocker, [0 * M, 0 * M], [0.5 * M, 0 * M]);
    pin(&mut model, "A", [named(&crank, "end"), named(&coupler, "start")]);
    pin(&mut model, "B", [named(&coupler, "end"), named(&rocker, "end")]);
    model
}

/// Parallel cranks of 0.3 m, 0.5 m apart, with one coupler, at an angle and a rate.
fn parallelogram(cranks: usize, angle: f64, omega: f64) -> Model {
    let (length, apart) = (0.3, 0.5);
    let mut model = vertical();
    let reach = apart * (cranks - 1) as f64;
    let mut coupler = Body::rod("coupler", [0 * M, 0 * M], [reach * M, 0 * M]).mass(1 * KG);
    for index in 0..cranks {
        coupler = coupler.with_point(format!("p{index}"), [apart * index as f64 * M, 0 * M]);
    }
    let (x, y) = (length * angle.cos(), length * angle.sin());
    let start = Start::default().at([(x + reach / 2.0) * M, y * M]).angle(Expr::from(0.0));
    model.starts.push(("coupler".into(), start.velocity([-y * omega * M / S, x * omega * M / S])));
    for index in 0..cranks {
        let crank = bar(&mut model, &format!("crank{index}"), length);
        model.starts.push((crank.name.clone(), Start::default().angle(Expr::from(angle)).omega(omega / S)));
        model.pivot_at(format!("A{index}"), &crank, [0 * M, 0 * M], [apart * index as f64 * M, 0 * M]);
        pin(&mut model, &format!("B{index}"), [named(&crank, "end"), named(&coupler, &format!("p{index}"))]);
    }
    model.add(coupler);
    model
}
