//! What events have left: impulses and counts have no more digits than the events; and what is greatest on one side of an event.

use super::ask::scene;

/// An elastic rod that tumbles off a floor again and again: neighbouring motions part, and its digits end before the run does.
#[test]
fn what_came_after_the_digits_is_not_known() {
    let rod = "[body.rod]\nrod = { from = [\"-0.5 m\", 0], to = [\"0.5 m\", 0] }\nmass = \"1 kg\"\n\
               start = { at = [0, \"1 m\"], angle = \"0.3 rad\", omega = \"3 rad/s\" }\n\
               [surface.floor]\nthrough = [0, 0]\nrigid = { restitution = 1 }\n\
               [event.top]\nwhen = \"rod.vy falls through 0 m/s\"\n";
    let asked = ["floor.contact[1].impulse.y", "floor.contact[40].impulse.y", "floor.contacts", "top.count"];
    let found = |accuracy: f64| scene(rod).heavy().until("25 s").accuracy(accuracy).run(&asked).finds;
    let (rough, fine) = (found(1e-6), found(1e-12));
    assert!(rough.iter().skip(1).all(|find| find.error.is_none()), "{rough:?}");
    let [first, better] =
        [&rough, &fine].map(|finds| (finds[0].value, finds[0].error.expect("a known impulse")));
    assert!((first.0 - better.0).abs() <= first.1 + better.1, "{first:?} {better:?}");
    assert!(first.1 < 1e-3, "{first:?}");
}

/// Of infinitely many bounces the first are followed.
#[test]
fn nobody_counts_to_infinity() {
    let ball = "[body.ball]\nball = { radius = \"5 cm\" }\nmass = \"1 kg\"\nstart = { at = [0, \"1 m\"] }\n\
                [surface.floor]\nthrough = [0, 0]\nrigid = { restitution = 0.5 }\n\
                [event.down]\nwhen = \"ball.vy falls through 0 m/s\"\n\
                [event.fast]\nwhen = \"ball.vy falls through -1 m/s\"\n";
    let found = scene(ball).heavy().until("3 s").run(&["floor.contacts", "down.count", "fast.count"]).finds;
    assert!(found[0].error.is_none() && found[1].error.is_none(), "{found:?}");
    assert_eq!(found[2].value, 3.0, "only the first falls are as fast");
    assert!(found[2].error.is_some_and(|error| error < 1e-12), "{found:?}");
}

/// Where bounces are followed no more, there is one impulse of all that are left, and what comes after them has no number.
#[test]
fn an_impulse_of_bounces_that_are_not_followed_is_not_that_of_one() {
    let ball = "[body.ball]\nball = { radius = \"10 cm\" }\nmass = \"1 kg\"\nstart = { at = [0, \"1.35 m\"] }\n\
                [surface.floor]\nthrough = [0, 0]\nrigid = { restitution = 0.5 }\n";
    let asked = [25, 26, 27].map(|number| format!("floor.contact[{number}].impulse.y"));
    let asked: Vec<&str> =
        asked.iter().map(String::as_str).chain(["floor.contact[last].impulse.y"]).collect();
    let found = scene(ball).heavy().until("3 s").run(&asked).finds;
    let truth = 1.5 * 0.5_f64.powi(24) * (2.0 * 9.81 * 1.25_f64).sqrt();
    assert!((found[0].value - truth).abs() <= found[0].error.expect("known"), "{found:?}");
    assert!(found[1].error.is_none() && found[2].error.is_none(), "{found:?}");
    assert_eq!((found[3].value, found[3].error), (0.0, Some(0.0)), "what lasts begins without an impact");
}

/// Friction of a ball that rolls up a compliant wall is greatest as it ceases to slide, and jumps there.
#[test]
fn the_greatest_friction_before_it_sticks() {
    let ring = "[body.ring]\nring = { radius = \"0.217 m\" }\nmass = \"0.193 kg\"\n\
                start = { at = [\"0.395 m\", \"0.346 m\"], velocity = [\"-0.097 m/s\", \"0.258 m/s\"], omega = \"3.647 rad/s\" }\n\
                [surface.floor]\nthrough = [0, 0]\nrigid = { restitution = 0 }\n\
                [surface.wall]\nthrough = [\"1.721 m\", 0]\nnormal = [-1, 0]\n\
                hertz = { stiffness = \"2.73e6 N/m^(3/2)\", damping = 0, friction = { static = 0.484, kinetic = 0.31 } }\n\
                [force.f]\non = \"ring\"\nat = \"ring.cm\"\nforce = [\"(1.392 N)*sin((2.714 rad/s)*t)\", 0]\n";
    let extra = "[find.greatest]\nthat = \"floor.normal\"\nat = \"its greatest\"\n\
                 [find.before]\nthat = \"floor.normal\"\nat = \"wall.ring.rolls\"\nside = \"before\"\n";
    let found = scene(&format!("{ring}{extra}")).heavy().until("2.298 s").run(&[]).finds;
    let [greatest, before] = [0, 1].map(|index: usize| found[index].value);
    assert!((greatest - before).abs() <= 1e-9 * before, "{greatest} {before}");
    assert!(before > 10.0, "{before}");
}

/// A block that a spring pulls up a slope and that is not at rest on it by some ulps at first, so that not every run begins with an impulse.
#[test]
fn a_work_is_known_beside_impulses_that_only_some_runs_have() {
    let block = "[parameters]\nslope = \"-6 deg\"\nhalf = \"3.1223e4 m\"\nanchor = \"-1773.73 m\"\n\
                 [body.p]\nbox = { width = \"40*half\", height = \"2*half\" }\nmass = \"2.934e5 kg\"\n\
                 [body.p.start]\nangle = \"slope\"\nat = [\"-half*sin(slope)\", \"half*cos(slope)\"]\n\
                 [surface.floor]\nthrough = [0, 0]\nslope = \"slope\"\n\
                 rigid = { restitution = 0, friction = { static = \"1.37*0.056\", kinetic = 0.056 } }\n\
                 [spring.cord]\nbetween = [\"p.cm\", { world = [\"-half*sin(slope) + anchor*cos(slope)\", \"half*cos(slope) + anchor*sin(slope)\"] }]\n\
                 stiffness = \"8.99e5 N/m\"\nrest_length = 0\n";
    let (slope, mass, gravity) = (-6.0_f64.to_radians(), 2.934e5, 2e4);
    let held = 0.056 * mass * gravity * slope.cos() / 8.99e5;
    let middle = -1773.73 - mass * gravity * slope.sin() / 8.99e5;
    let path = 2.0 * (middle.abs() - held);
    let found = scene(block).gravity("2e4 m/s^2").until("2.6701 s");
    found.ask(["floor.work"])[0].is(-8.99e5 * held * path, 1.0);
}
