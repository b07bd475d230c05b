//! What is in balance costs nothing, however the forces are rounded that balance each other.

use super::ask::{Scene, are, force, scene};

/// Steps of a motion that is at rest.
const FEW: usize = 3;

fn point(name: &str, at: &str) -> String {
    format!("[body.{name}]\npoint = {{}}\nmass = \"1 kg\"\nstart = {{ at = {at} }}\n")
}

fn spring(between: &str, stiffness: &str, rest_length: &str) -> String {
    format!(
        "[spring.cord]\nbetween = {between}\nstiffness = \"{stiffness}\"\nrest_length = \"{rest_length}\"\n"
    )
}

/// The rest is one step or a few, and the check runs, which begin some ulps off, take no more than a swing does.
#[track_caller]
fn rests(what: &str, rest: &Scene, swing: &Scene) {
    let [rest, swing] = [rest, swing].map(Scene::steps);
    println!("{what}: {rest:?}, in motion {swing:?}");
    assert!(rest.motion <= FEW, "{what}: {rest:?}");
    assert!(rest.all <= swing.all, "{what}: {rest:?}, in motion {swing:?}");
}

#[test]
fn a_mass_that_hangs_at_rest() {
    for stiffness in ["30 N/m", "7 N/m", "1e3 N/m"] {
        for rest_length in ["0 m", "1 m", "0.3 m"] {
            let hung = |down: &str| {
                let at = format!("[0, \"-({rest_length}) - 9.81 N/({stiffness}) - ({down})\"]");
                let cord = spring("[\"p.cm\", { world = [0, 0] }]", stiffness, rest_length);
                scene(&(point("p", &at) + &cord)).heavy().until("100 s")
            };
            rests(&format!("{stiffness}, {rest_length}"), &hung("0 m"), &hung("1 mm"));
        }
    }
}

#[test]
fn two_bodies_at_the_length_of_their_spring() {
    for length in ["1 m", "0.3 m", "0.7 m"] {
        let apart = |drawn: &str| {
            let other = format!("[\"0.1 m + 0.6*({length}) + {drawn}\", \"0.2 m + 0.8*({length})\"]");
            let bodies = point("p", "[\"0.1 m\", \"0.2 m\"]") + &point("q", &other);
            scene(&(bodies + &spring("[\"p.cm\", \"q.cm\"]", "10 N/m", length))).until("100 s")
        };
        rests(length, &apart("0"), &apart("1 mm"));
    }
}

#[test]
fn forces_that_leave_a_rounding_error_beside_a_spring() {
    let sum = force("0.1 N + 0.2 N - 0.3 N");
    let one_by_one: String = ["0.1 N", "0.2 N", "-0.3 N"]
        .into_iter()
        .zip(["first", "second", "third"])
        .map(|(along_x, name)| force(along_x).replace("force.push", &format!("force.{name}")))
        .collect();
    for forces in [sum, one_by_one] {
        let held = |at: &str| {
            let cord = spring("[\"p.cm\", { world = [0, 0] }]", "10 N/m", "1 m");
            scene(&[point("p", at), forces.clone(), cord].concat()).until("100 s")
        };
        let rest = held("[\"1 m\", 0]");
        rests("a sum", &rest, &held("[\"1.001 m\", 0]"));
        are(&rest.ask(["p.x", "p.vx"]), [1.0, 0.0], 1e-12);
    }
}

/// A swing of 1 mm, which is 1e8 times what a double tells apart there.
#[test]
fn a_small_swing_far_away_takes_the_steps_of_one_that_is_near() {
    let swing = |centre: &str| {
        let at = format!("[\"{centre} + 1 mm\", 0]");
        scene(&(point("p", &at) + &force(&format!("-(10 N/m)*(p.x - ({centre}))")))).until("100 s")
    };
    let [near, far] = ["0 m", "1e5 m"].map(|centre| swing(centre).steps());
    println!("near {near:?}, far away {far:?}");
    assert!(far.all <= 2 * near.all, "near {near:?}, far away {far:?}");
    let pace = 10.0_f64.sqrt();
    let truth = [1e-3 * (100.0 * pace).cos(), -1e-3 * pace * (100.0 * pace).sin()];
    let [place, speed] = swing("1e5 m").ask(["p.x - 1e5 m", "p.vx"]);
    place.is(truth[0], 1e-8);
    speed.is(truth[1], 1e-8 * pace);
}
