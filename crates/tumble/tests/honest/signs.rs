//! Events at the instant at which a force changes its sign.

use super::ask::{Scene, are, flight};

/// A force brakes the point until an event ends that.
fn braked(force: &str, way: &str, action: &str) -> Scene {
    flight(&format!(
        "[parameters]\nF = \"{force}\"\n\
         [force.brake]\non = \"p\"\nat = \"p.cm\"\nforce = [\"-F*sign(p.vx)\", 0]\n\
         [event.halt]\nwhen = \"p.vx {way} through 0 m/s\"\naction = {action}\n"
    ))
}

/// Decelerations, m/s^2: the times at which they end the motion are doubles, or are not.
const BRAKES: [(&str, f64); 3] = [("1 N", 1.0), ("0.3 N", 0.3), ("0.7 N", 0.7)];

#[test]
fn a_brake_stops_the_motion() {
    for (force, a) in BRAKES {
        for way in ["falls", "passes"] {
            are(&braked(force, way, "\"stop\"").ask(["t", "p.x", "p.vx"]), [1.0 / a, 0.5 / a, 0.0], 1e-12);
        }
    }
}

#[test]
fn a_brake_is_released() {
    for (force, a) in BRAKES {
        let scene = braked(force, "falls", "{ set = { F = \"0 N\" } }");
        are(&scene.ask(["halt", "p.x", "p.vx"]), [1.0 / a, 0.5 / a, 0.0], 1e-12);
        assert_eq!(scene.run(&[]).run.trajectory().events.len(), 1);
    }
}
