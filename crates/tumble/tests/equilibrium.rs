//! `[equilibrium]` of a scene: what is found, and what is told where nothing is.

use tumble::pipeline::run_text;
use tumble_mech::Stability;

const PENDULUM: &str = r#"
    version = 1
    world.gravity = "9.81 m/s^2"
    run.until = "1 s"

    [body.rod]
    rod = { from = [0, 0], to = [0, "-1 m"] }
    mass = "2 kg"
    start = { angle = "20 deg" }

    [pivot.hinge]
    body = "rod"
    point = [0, 0]
    world = [0, "3 m"]

    [equilibrium]
"#;

#[test]
fn a_pendulum_hangs_down() {
    let cases = run_text("pendulum", PENDULUM).expect("a scene without mistakes");
    let found = cases[0].equilibrium.as_ref().expect("an equilibrium");
    assert_eq!(found.small_motions.stability(), Stability::Stable);
    assert!((found.small_motions.frequencies[0] - (1.5_f64 * 9.81).sqrt()).abs() < 1e-12);
    assert!((found.poses[0].at[1] - 2.5).abs() < 1e-12);
    assert!((found.reactions[0].force[1] - 19.62).abs() < 1e-10);
}

#[test]
fn what_falls_is_told_to_have_none() {
    let (above, _) = PENDULUM.split_once("[pivot.hinge]").expect("a pivot");
    let cases = run_text("stone", &format!("{above}\n[equilibrium]")).expect("a scene without mistakes");
    assert!(cases[0].equilibrium.is_none());
    let said: Vec<&str> = cases[0].said.list.iter().map(|said| said.code.as_str()).collect();
    assert_eq!(said, ["W0607"]);
    assert!(cases[0].said.list[0].message.contains("9.810e0 m/s^2"), "{}", cases[0].said.list[0].message);
}
