//! The forces that diagrams show are all that act: they sum to M A, and their torques to I alpha.

use std::path::Path;

use crate::common::scenes;
use tumble::Case;
use tumble::pipeline::{self, Options};
use tumble_mech::{Forces, Run, joined};
use tumble_ode::Side;
use tumble_scene::Study;

/// Instants of a run at which the sums are taken.
const INSTANTS: usize = 200;
/// Rounding of a sum, relative to its largest term.
const ROUNDING: f64 = 1e-11;

fn run(scene: &Path) -> (Study, Vec<Case>) {
    pipeline::motions(scene, &Options::default()).expect("a motion")
}

#[test]
fn every_diagram_closes() {
    for (name, scene) in scenes() {
        let (study, cases) = run(&scene);
        for case in &cases {
            for body in 0..study.model.bodies.len() {
                closes(&name, &case.run, body);
            }
        }
    }
}

fn closes(scene: &str, run: &Run, body: usize) {
    let kinematics = run.equations.model().bodies[body].kinematics();
    let mass = run.equations.mass_properties(body);
    let a = kinematics.acceleration();
    let formulas = [&mass.mass * a.x(), &mass.mass * a.y(), &mass.inertia * kinematics.alpha()];
    let mut needed = run.observe(&formulas).expect("formulas of the motion");
    let mut forces = Forces::of(run);
    let end = run.trajectory().end().expect("a motion");
    for index in 0..=INSTANTS {
        let time = (end * index as f64 / INSTANTS as f64).min(end);
        let needed = needed.at(time, Side::After).expect("within the run");
        let all = joined(&forces.at(time, Side::After).expect("forces of the motion"));
        let own: Vec<_> = all.iter().filter(|force| force.body == body).collect();
        let terms = |of: &dyn Fn(&tumble_mech::Force) -> f64| -> (f64, f64) {
            own.iter().fold((0.0, 0.0), |(sum, largest), force| {
                let term = of(force);
                (sum + term, f64::max(largest, term.abs()))
            })
        };
        let sums = [
            terms(&|force| force.force[0]),
            terms(&|force| force.force[1]),
            terms(&tumble_mech::Force::torque),
        ];
        let arms =
            own.iter().map(|f| f.arm[0].hypot(f.arm[1]) * f.force[0].hypot(f.force[1])).fold(0.0, f64::max);
        for (axis, ((sum, largest), needed)) in sums.into_iter().zip(needed).enumerate() {
            let scale = largest.max(if axis == 2 { arms } else { 0.0 }).max(needed.abs());
            assert!(
                (sum - needed).abs() <= ROUNDING * scale,
                "{scene} at {time} s, component {axis}: {sum} is not {needed}"
            );
        }
    }
}
