//! The rod that bounces on a floor without friction: `bouncing_rod` of `reference/systems.json`.

use crate::common::{at, bouncing_rod, number, reference, rigid, run, spring};
use tumble_mech::Run;

fn state(run: &Run, time: f64) -> [f64; 6] {
    let rod = run.equations.model().bodies[0].kinematics();
    let (c, v) = (rod.position(), rod.velocity());
    let formulas = [c.x().clone(), c.y().clone(), v.x().clone(), v.y().clone(), rod.angle(), rod.omega()];
    at(run, time, formulas)
}

#[track_caller]
fn same_state(run: &Run, time: f64, expected: &serde_json::Value, tolerance: f64) {
    for (found, expected) in state(run, time).into_iter().zip(expected.as_array().expect("a state")) {
        let error = (found - number(expected)).abs();
        println!("t = {time}: {found} error {error:e}");
        assert!(error < tolerance, "{found} is not {expected} at {time} s");
    }
}

/// Names of the ends and times at which contacts begin.
#[track_caller]
fn same_hits(run: &Run, expected: &serde_json::Value, tolerance: impl Fn(usize) -> f64) {
    let contacts = run.contacts();
    for (index, hit) in expected.as_array().expect("hits").iter().enumerate() {
        let found = &contacts[index];
        let end = if hit[1] == "-" { "floor.rod.minus" } else { "floor.rod.plus" };
        let error = (found.start - number(&hit[0])).abs();
        println!("{end} {} error {error:e}", found.start);
        assert_eq!(run.equations.pairs()[found.pair].name, end, "hit {index}");
        assert!(error < tolerance(index), "{} is not {} (hit {index})", found.start, hit[0]);
    }
}

#[test]
fn on_a_spring() {
    let expected = &reference("bouncing_rod")["spring_1e4_lossless"];
    let run = run(bouncing_rod(spring()), 5.0, 1e-13);
    println!("{:?}", run.trajectory().work);
    same_hits(&run, &expected["touchdowns"], |_| 1e-10);
    assert_eq!(run.contacts().len(), 8);
    for (contact, end) in run.contacts().iter().zip(expected["liftoffs"].as_array().expect("ends")) {
        assert!((contact.end - number(&end[0])).abs() < 1e-10);
    }
    same_state(&run, 1.0, &expected["state_t1"], 1e-12);
    same_state(&run, 2.5, &expected["state_t2.5"], 1e-11);
    same_state(&run, 5.0, &expected["state_t5"], 1e-9);
}

#[test]
fn elastic() {
    let expected = &reference("bouncing_rod")["rigid_e1"];
    let run = run(bouncing_rod(rigid(1.0)), 5.0, 1e-13);
    println!("{:?}", run.trajectory().work);
    // Perturbations grow to 1e9 times themselves within the run.
    same_hits(&run, &expected["hits"], |hit| 1e-14 * 10_f64.powi(hit as i32));
    assert_eq!(run.contacts().len(), 9);
    same_state(&run, 1.0, &expected["state_t1"], 1e-13);
    same_state(&run, 2.5, &expected["state_t2.5"], 1e-11);
    same_state(&run, 5.0, &expected["state"], 1e-5);
}

#[test]
fn with_losses_until_it_lies_flat() {
    let expected = &reference("bouncing_rod")["rigid_e0.7"];
    let run = run(bouncing_rod(rigid(0.7)), 5.0, 1e-13);
    println!("{:?}", run.trajectory().work);
    same_hits(&run, &expected["hits"], |_| 1e-12);
    same_state(&run, 1.0, &expected["state_t1"], 1e-13);
    same_state(&run, 2.5, &expected["state_t2.5"], 1e-12);
    let rest: Vec<_> = run.contacts().into_iter().filter(|contact| !contact.is_impact).collect();
    println!("{rest:?} {}", run.zeno_sequences());
    assert_eq!((rest.len(), run.zeno_sequences()), (2, 1));
    let limit = number(&expected["accumulation_time"]);
    for contact in rest {
        println!("error of the limit {:e}", contact.start - limit);
        assert!((contact.start - limit).abs() < 1e-12);
    }
    // The reference stops 1.2e-12 rad/s short of the limit.
    same_state(&run, limit, &expected["state"], 2e-12);
    // It lies and slides.
    let [_, y, vx, vy, angle, omega] = state(&run, 5.0);
    assert!(y.abs() < 1e-14 && vy.abs() < 1e-14 && omega.abs() < 1e-14, "{y} {vy} {omega}");
    assert!((vx - 2.0).abs() < 1e-15 && (angle - std::f64::consts::TAU).abs() < 1e-14);
}
