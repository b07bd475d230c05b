//! Joints, from the scene's text: what is asked for at the instant at which one begins to hold, and on which body its force is.

use super::ask::scene;

const HIT: &str = r#"
[body.rod]
rod = { from = [0, 0], to = [0, "-1 m"] }
mass = "2 kg"
[body.bullet]
point = {}
mass = "10 g"
start = { at = ["-1 m", "-0.8 m"], velocity = ["10 m/s", 0] }
[pin.hinge]
between = [{ world = [0, 0] }, "rod.top"]
[body.rod.points]
top = [0, 0]
[weld.wood]
between = ["bullet.cm", "rod"]
from = "hit"
[event.hit]
when = "bullet.x rises through 0 m"
[find.now]
that = "rod.omega"
at = "hit"
[find.most]
that = "rod.omega"
at = "its greatest"
"#;

/// The joint brings states of its own: what was before it has fewer.
#[test]
fn at_the_instant_of_a_joint() {
    let case = scene(HIT).until("1 s").run(&["rod.omega"]);
    let expected = 0.01 * 10.0 * 0.8 / (2.0 / 3.0 + 0.01 * 0.64);
    let now = case.finds.iter().find(|find| find.name == "now").expect("asked for");
    let error = now.error.expect("known");
    assert!((now.value - expected).abs() <= error && error < 1e-12, "{} {expected} {error:e}", now.value);
}
