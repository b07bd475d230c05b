//! Contacts that rounding says much of: light bodies below heavy ones, corners that are come to far from the origin, contacts that end together.

use super::ask::{Scene, are, scene};

const G: f64 = 9.81;

/// A box of so many kg on a plank of 1 kg, pushed along x with so much for each kg of the box.
fn on_a_plank(mass: f64, push: f64, [upper, lower]: [f64; 2]) -> Scene {
    let sections = format!(
        r#"
[body.box]
box = {{ width = "0.4 m", height = "0.2 m" }}
mass = "{mass} kg"
start = {{ at = [0, "0.2 m"] }}

[body.plank]
box = {{ width = "1 m", height = "0.1 m" }}
mass = "1 kg"
start = {{ at = [0, "0.05 m"] }}

[contact.pair]
between = ["box", "plank"]
rigid = {{ restitution = 0, friction = {upper} }}

[surface.floor]
through = [0, 0]
rigid = {{ restitution = 0, friction = {lower} }}

[force.push]
on = "box"
at = "box.cm"
force = ["{} N", 0]
"#,
        push * mass
    );
    scene(&sections).heavy().until("0.3 s")
}

/// Forces on the plank balance to some parts in 1e16 of the weight of the box, which is much beside its own.
#[test]
fn a_plank_below_a_heavy_box_holds_it() {
    for mass in [1.0, 1e3, 1e6, 1e9] {
        let found = on_a_plank(mass, 2.0, [0.6, 0.3]).ask(["plank.vx", "floor.normal", "floor.friction"]);
        found[0].is(0.0, 1e-12);
        // Of the weight of the box they know as much as its mass is more than that of the plank.
        found[1].is((mass + 1.0) * G, 1e-13 * mass * mass * G);
        found[2].is(-2.0 * mass, 1e-13 * mass * mass * G);
    }
}

/// Where a double does not hold both masses the responses of the contacts seem to depend on each other: that is no paradox of friction.
#[test]
fn a_plank_below_a_box_that_is_too_heavy_is_refused() {
    let refusal = on_a_plank(1e12, 2.0, [0.6, 0.3]).refusal();
    assert!(refusal.contains("masses of `box`, `plank` differ by a factor of 1"), "{refusal}");
}

/// Both go on together, or the box alone.
#[test]
fn a_heavy_box_takes_a_plank_along_or_slides_on_it() {
    for mass in [1e2, 1e3] {
        let together = (5.0 * mass - 0.3 * (mass + 1.0) * G) / (mass + 1.0);
        on_a_plank(mass, 5.0, [0.6, 0.3]).ask(["box.vx"])[0].is(0.3 * together, 1e-7);
        let pushed = on_a_plank(mass, 7.0, [0.3, 0.6]);
        are(&pushed.ask(["box.vx", "plank.vx"]), [0.3 * (7.0 - 0.3 * G), 0.0], 1e-7);
    }
}

/// A disk that rolls over the corner of a ledge loses no digits but those of its place.
#[test]
fn a_ledge_far_from_the_origin() {
    let ledge = |x: f64, y: f64| {
        let [left, right, low] = [x - 1.0, x + 0.3, y - 1.0];
        scene(&format!(
            r#"
[body.ball]
disk = {{ radius = "0.1 m" }}
mass = "1 kg"
start = {{ at = ["{x} m", "{y} m + 0.1 m"], velocity = ["0.5 m/s", 0], omega = "-5 rad/s" }}

[surface.ledge]
polygon = [["{left} m", "{low} m"], ["{right} m", "{low} m"], ["{right} m", "{y} m"], ["{left} m", "{y} m"]]
rigid = {{ restitution = 0, friction = 0.9 }}
"#
        ))
        .heavy()
        .until("1.2 s")
    };
    let [rate] = ledge(0.0, 0.0).ask(["ball.omega"]);
    for (x, y) in [(100.0, -30.0), (1000.0, 500.0), (-1000.0, 0.0), (1e5, 0.0)] {
        ledge(x, y).ask(["ball.omega"])[0].is(rate.value, 1e-11 * x.abs());
    }
}

/// The force that presses a box against a wall goes down to zero, and both corners leave it: neither takes over from the other for no time.
#[test]
fn corners_leave_a_wall_together() {
    for (push, floor, wall, at) in
        [("cos(om*t)", 0.0, 0.0, "0"), ("(1 - om*t)", 0.0, 0.2, "h/4"), ("cos(om*t)", 0.1, 0.2, "-h/4")]
    {
        let pushed = scene(&format!(
            r#"
[parameters]
h = "0.37 m"
w = "0.43 m"
om = "4.3 Hz"

[body.box]
box = {{ width = "w", height = "h" }}
mass = "1.7 kg"
points.p = ["w/2", "{at}"]
start = {{ at = ["0.37 m - w/2", "h/2"] }}

[surface.floor]
through = [0, 0]
rigid = {{ restitution = 0, friction = {floor} }}

[surface.wall]
through = ["0.37 m", 0]
normal = [-1, 0]
rigid = {{ restitution = 0, friction = {wall} }}

[force.push]
on = "box"
at = "box.p"
force = ["(9 N)*{push}", 0]
"#
        ));
        let found = pushed.heavy().until("0.5 s").ask(["wall.contacts", "floor.contacts"]);
        are(&found, [2.0, 2.0], 1e-9);
    }
}

/// A disk that fits between two walls is pressed against one, then against the other.
#[test]
fn a_disk_that_fits_between_walls() {
    for (radius, place, slope) in [(0.1882, 4.6, 20.0_f64), (0.0936, 3.539, 0.0), (0.387, 1.28, -33.0)] {
        let fits = scene(&format!(
            r#"
[parameters]
R = "{radius} m"
a = "{place} m"
s = "{slope} deg"

[body.ball]
disk = {{ radius = "R" }}
mass = "1.3 kg"
start = {{ at = ["a*cos(s) - R*sin(s)", "a*sin(s) + R*cos(s)"], velocity = ["(0.7 m/s)*cos(s)", "(0.7 m/s)*sin(s)"] }}

[surface.left]
through = ["a*cos(s)", "a*sin(s)"]
slope = "s"
rigid = {{ restitution = 0.5 }}

[surface.right]
through = ["a*cos(s) - 2*R*sin(s)", "a*sin(s) + 2*R*cos(s)"]
slope = "s + 180 deg"
rigid = {{ restitution = 0.5 }}

[force.push]
on = "ball"
at = "ball.cm"
force = ["-(20 N)*cos((3.7 rad/s)*t)*sin(s)", "(20 N)*cos((3.7 rad/s)*t)*cos(s)"]
"#
        ));
        let found = fits.heavy().until("0.6 s").ask(["ball.x*cos(s) + ball.y*sin(s)"]);
        found[0].is(place + 0.7 * 0.6 - G * slope.to_radians().sin() * 0.18, 1e-12);
    }
}

/// Of a ladder that is rough at both ends and nearly at its limit, forces may be shared in few ways: digits that they have in common are stated.
#[test]
fn a_ladder_near_its_limit() {
    for spare in [1e-12, 1e-10, 1e-9, 1.0001e-9] {
        let ladder = scene(&format!(
            r#"
[parameters]
tilt = "60 deg"
mu = "(1 + {spare:e})*(sqrt(tan(tilt)^2 + 1) - tan(tilt))"

[body.ladder]
rod = {{ from = [0, 0], to = ["2 m", 0] }}
mass = "5 kg"
start = {{ at = ["-cos(tilt)*(1 m)", "sin(tilt)*(1 m)"], angle = "tilt" }}

[surface.floor]
through = [0, 0]
rigid = {{ restitution = 0, friction = "mu" }}

[surface.wall]
through = [0, 0]
normal = [-1, 0]
rigid = {{ restitution = 0, friction = "mu" }}
"#
        ));
        let [found] = ladder.heavy().until("1 s").ask(["wall.normal"]);
        // At the limit both ends have all the friction that they can have, and mu is tan(15 deg); the other end of what is possible is as far off.
        let most = 5.0 * G * 15.0_f64.to_radians().tan() / (1.0 + 15.0_f64.to_radians().tan().powi(2));
        let apart = (found.value - most).abs();
        assert!(apart <= found.error && found.error < 1e-7, "{spare:e}: {apart:e} {:e}", found.error);
    }
}

/// Bounces that are not followed after the first are as much of the velocity as the restitution says.
#[test]
fn what_bounces_leave_out_is_small() {
    for e in [1e-9, 1e-8, 1e-10] {
        let thrown = scene(&format!(
            r#"
[body.p]
point = {{}}
mass = "2 kg"
start = {{ at = [0, "1 m"], velocity = ["3 m/s", 0] }}

[surface.floor]
through = [0, 0]
rigid = {{ restitution = {e:e}, friction = 0.3 }}
"#
        ));
        let down = (2.0 * G).sqrt();
        let found = thrown.heavy().until("1 s").ask([
            "p.vx at floor.contact[1].start",
            "p.vy at floor.contact[1].start",
            "floor.work at floor.contact[1].start",
        ]);
        let along = 3.0 - 0.3 * (1.0 + e) * down;
        found[0].is(along, 2e-7);
        found[1].is(e * down, 2e-7);
        found[2].is(along * along + (e * down).powi(2) - 9.0 - 2.0 * G, 1e-5);
    }
}
