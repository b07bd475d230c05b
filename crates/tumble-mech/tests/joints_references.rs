//! Chains of links against an independent integration of Lagrange's equations in their angles, `references/chains.py`.

use tumble_expr::Expr;
use tumble_expr::units::{KG, M, S};
use tumble_mech::{Anchor, Body, Gravity, Joint, Model, Run, Start};
use tumble_ode::Accuracy;

/// What is known of one chain: angles at the start, and times with angles and rates.
struct Reference {
    kind: String,
    start: Vec<f64>,
    samples: Vec<(f64, [Vec<f64>; 2])>,
}

fn reference(name: &str) -> Reference {
    let text = include_str!("../../tumble/tests/reference/chains.json");
    let json: serde_json::Value = serde_json::from_str(text).expect("valid JSON");
    let number =
        |value: &serde_json::Value| value.as_str().expect("a string").parse::<f64>().expect("a number");
    let numbers =
        |value: &serde_json::Value| value.as_array().expect("a list").iter().map(number).collect::<Vec<_>>();
    let chains = json["chains"].as_array().expect("a list");
    let chain = chains.iter().find(|chain| chain["name"] == name).expect("there is such a chain");
    let samples = chain["samples"].as_array().expect("a list");
    let sample =
        |row: &serde_json::Value| (number(&row["t"]), ["theta", "omega"].map(|key| numbers(&row[key])));
    Reference {
        kind: chain["kind"].as_str().expect("a string").to_owned(),
        start: numbers(&chain["start"]),
        samples: samples.iter().map(sample).collect(),
    }
}

/// A link that hangs down from its `top` at angle zero: a uniform rod, or a mass at the end of a massless one.
fn link(name: &str, kind: &str) -> Body {
    let [top, tip] = [[0 * M, 0 * M], [0 * M, -1 * M]];
    match kind {
        "rods" => Body::rod(name, top, tip).mass(1 * KG).with_point("top", [0 * M, 0 * M]),
        _ => Body::point(name).mass(1 * KG).with_point("top", [0 * M, 1 * M]),
    }
}

/// The chain of a reference, and its motion.
fn motion(reference: &Reference, accuracy: f64) -> (Run, Vec<Body>) {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(9.81 * M / (S * S));
    let is_rods = reference.kind == "rods";
    let below = if is_rods { [0 * M, -1 * M] } else { [0 * M, 0 * M] };
    let mut bodies: Vec<Body> = vec![];
    for (index, angle) in reference.start.iter().enumerate() {
        let body = model.add(link(&format!("link{index}"), &reference.kind).with_point("tip", below.clone()));
        match bodies.last() {
            None => model.pivot(&body, if is_rods { [0 * M, 0 * M] } else { [0 * M, 1 * M] }),
            Some(above) => {
                let end = |body: &Body, point| Anchor::Material(body.named_point(point).expect("given"));
                model.join(Joint::pin(format!("joint{index}"), [end(above, "tip"), end(&body, "top")]));
            }
        }
        model.starts.push((body.name.clone(), Start::default().angle(Expr::from(*angle))));
        bodies.push(body);
    }
    let end = reference.samples.last().expect("samples").0;
    let run = model.simulate_to(&[], end * S, Accuracy::new(accuracy).expect("positive"));
    (run.unwrap_or_else(|error| panic!("{error}")), bodies)
}

/// The largest difference to the reference, of angles and of rates relative to the largest rate.
fn largest_difference(name: &str) -> f64 {
    let reference = reference(name);
    let (run, bodies) = motion(&reference, 1e-13);
    let mut worst = 0.0_f64;
    for (time, [theta, omega]) in &reference.samples {
        let found = run.at(*time).expect("within");
        let fastest = omega.iter().fold(1.0_f64, |most, rate| most.max(rate.abs()));
        for (body, (theta, omega)) in bodies.iter().zip(theta.iter().zip(omega)) {
            let angle = (found.angle(body).expect("finite") - theta).abs();
            let rate = (found.omega(body).expect("finite") - omega).abs() / fastest;
            println!("{name} {time} {}: {angle:e} {rate:e}", body.name);
            worst = worst.max(angle).max(rate);
        }
    }
    worst
}

#[test]
fn a_double_pendulum_of_masses() {
    assert!(largest_difference("double pendulum of masses") < 1e-12);
}

#[test]
fn a_double_pendulum_of_rods() {
    assert!(largest_difference("double pendulum of rods") < 1e-12);
}

/// Its end cracks as a whip does.
#[test]
fn five_rods_released_flat() {
    assert!(largest_difference("five rods released flat") < 1e-13);
}

#[test]
fn a_hanging_chain_let_go() {
    assert!(largest_difference("hanging chain let go") < 1e-13);
}
