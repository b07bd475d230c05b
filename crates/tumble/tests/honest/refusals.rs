//! What cannot be integrated to its end is refused, and does not hang.

use super::ask::{flight, force, scene};

/// Its signs change without end before 5 s.
#[test]
fn signs_that_change_ever_faster() {
    let parameter = "[parameters]\nend = \"5 s\"\n";
    let said = flight(&format!("{parameter}{}", force("(1 N)*sign(sin((1 s)/(end - t)))"))).refusal();
    assert!(said.contains("stopped at t = 4.99"), "{said}");
    assert!(said.contains("of memory") && said.contains("`sin(1/(end - t))`"), "{said}");
}

#[test]
#[ignore = "takes half a minute"]
fn a_spring_that_is_too_stiff() {
    let cord = "[spring.cord]\nbetween = [\"p.cm\", { world = [0, 0] }]\nstiffness = \"1e18 N/m\"\nrest_length = 0\n";
    let said = flight(cord).refusal();
    assert!(said.contains("of memory") && said.contains("ask for a shorter run"), "{said}");
}

#[test]
#[ignore = "takes half a minute"]
fn bounces_that_hardly_end() {
    let ball = "[body.p]\npoint = {}\nmass = \"1 kg\"\nstart = { at = [0, \"1 m\"] }\n\
                [surface.floor]\nthrough = [0, 0]\nrigid = { restitution = 0.99999 }\n";
    let said = scene(ball).heavy().until("2e5 s").refusal();
    assert!(said.contains("of memory") && said.contains("`event floor.p.point.gap`"), "{said}");
}

/// What comes to an infinite force at the very instant at which it touches a Hertzian floor, whose root of the depth is one more state than
/// those of the last step.
#[test]
fn an_end_where_there_are_more_states_than_before() {
    let ball = "[parameters]\nq = 1\n\
                [body.ball]\nball = { radius = \"0.18 m\" }\nmass = \"3 kg\"\nstart = { at = [0, \"0.4 m\"] }\n\
                [surface.floor]\nthrough = [0, 0]\nhertz = { stiffness = \"4e6 N/m^(3/2)\", damping = 0 }\n\
                [event.touch]\nwhen = \"ball.y falls through 0.18 m\"\naction = { set = { q = \"0\" } }\n\
                [force.f]\non = \"ball\"\nat = \"ball.cm\"\nforce = [\"(1 N)/q\", 0]\n";
    let said = scene(ball).heavy().until("1 s").refusal();
    assert!(said.contains("stopped at t = 0.2117"), "{said}");
}
