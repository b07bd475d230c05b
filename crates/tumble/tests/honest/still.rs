//! What is at rest is watched while it rests: loads that change with the time break it away, lift it and turn it over, however long the run is.

use tumble::FindResult;

use super::ask::{Scene, are, scene};

const G: f64 = 9.81;

/// A surface along x with friction.
fn floor(friction: &str) -> String {
    format!("[surface.floor]\nthrough = [0, 0]\nrigid = {{ restitution = 0, friction = {friction} }}\n")
}

fn push(on: &str, along_x: &str) -> String {
    format!("[force.push]\non = \"{on}\"\nat = \"{on}.cm\"\nforce = [\"{along_x}\", 0]\n")
}

/// A box of 2 kg on a floor with friction 0.4, pushed.
fn pushed(along_x: &str, until: &str) -> Scene {
    let body = "[body.b]\nbox = { width = \"60 cm\", height = \"10 cm\" }\nmass = \"2 kg\"\nstart.at = [0, \"5 cm\"]\n";
    scene(&[body, &floor("0.4"), &push("b", along_x)].concat()).heavy().until(until)
}

/// A spring swings a block to and fro on a rough floor until it stays: from then on it has no velocity but for rounding, however roughly
/// it was followed.
#[test]
fn what_stays_has_no_velocity() {
    let block = "[body.b]\nbox = { width = \"60 cm\", height = \"10 cm\" }\nmass = \"2 kg\"\nstart = { at = [\"1.37 m\", \"5 cm\"] }\n";
    let spring = "[spring.s]\nbetween = [\"b.cm\", { world = [0, \"5 cm\"] }]\nstiffness = \"53 N/m\"\nrest_length = 0\n";
    let swung = scene(&[block, spring, &floor("0.31")].concat()).heavy().until("20 s").accuracy(1e-6);
    let found = swung.run(&["b.vx", "b.vy", "b.omega", "b.x"]).finds;
    let is_still = |find: &FindResult| find.value == 0.0 && find.error.is_some_and(|error| error < 1e-14);
    assert!(found.iter().take(3).all(is_still), "{found:?}");
    assert!(
        found[3].error.is_some_and(|error| error > 1e-14),
        "it is not known to all digits where: {found:?}"
    );
}

#[test]
fn an_event_of_the_time_alone_is_met() {
    let event =
        "[body.b]\npoint = {}\nmass = \"2 kg\"\n[event.e]\nwhen = \"sin((2.7 rad/s)*t) rises through 0.5\"\n";
    for until in ["3 s", "25 s", "100 s"] {
        are(&scene(event).until(until).ask(["e[1]"]), [0.5_f64.asin() / 2.7], 1e-12);
    }
}

#[test]
fn pushes_break_away_whatever_they_are_like() {
    let most = 0.4 * 2.0 * G;
    for (push, when) in [
        ("(13 N)*sin((2.7 rad/s)*t)", (most / 13.0).asin() / 2.7),
        ("(8 N)*sin((5 rad/s)*t)^2", (most / 8.0).sqrt().asin() / 5.0),
        ("(13 N)*exp(-((t - 3 s)/(1 s))^2)", 3.0 - (13.0 / most).ln().sqrt()),
        ("(13 N)*exp(-((t - 3 s)/(0.2 s))^2)", 3.0 - 0.2 * (13.0 / most).ln().sqrt()),
        ("(1.3 N)*exp(t/(1 s))", (most / 1.3).ln()),
    ] {
        for until in ["6 s", "7.7 s", "20 s"] {
            are(&pushed(push, until).ask(["floor.slides[1]"]), [when], 1e-11);
        }
    }
}

#[test]
fn a_brake_a_pivot_and_corners_let_go() {
    let rod = "[body.r]\nrod = { from = [0, 0], to = [0, \"-1 m\"] }\nmass = \"1 kg\"\n";
    let pivot = |y: &str| format!("[pivot.h]\nbody = \"r\"\npoint = [0, 0]\nworld = [0, \"{y}\"]\n");
    let brake = "[force.rub]\non = \"r\"\ntorque = \"-(2 N*m)*sign(r.omega)\"\n[force.shake]\non = \"r\"\ntorque = \"(3 N*m)*sin((2.7 rad/s)*t)\"\n";
    let braked = scene(&[rod, &pivot("0 m"), brake].concat()).heavy().until("30 s");
    are(&braked.ask(["rub.slides[1]"]), [(2.0_f64 / 3.0).asin() / 2.7], 1e-12);
    let slack = "[event.slack]\nwhen = \"h.fy falls through 0 N\"\n";
    let shaken = scene(&[rod, &pivot("(30 cm)*sin((7 rad/s)*t)"), slack].concat()).heavy().until("30 s");
    are(&shaken.ask(["slack[1]"]), [(G / 14.7).asin() / 7.0], 1e-12);
    let tall = "[body.b]\nbox = { width = \"10 cm\", height = \"40 cm\" }\nmass = \"1 kg\"\nstart.at = [0, \"20 cm\"]\n";
    let tall = scene(&[tall, &floor("0.9"), &push("b", "(4 N)*sin((1.7 rad/s)*t)^2")].concat()).heavy();
    let tips = (G / 16.0_f64).sqrt().asin() / 1.7;
    are(&tall.until("30 s").ask(["floor.b.corner1.contact[1].end"]), [tips], 1e-12);
}

/// Loads that begin at zero: which contacts bear them and which slip is seen as they grow.
#[test]
fn loads_that_begin_at_zero_find_who_bears_them() {
    let ball = |name: &str, mass: &str, x: &str| {
        format!(
            "[body.{name}]\nball = {{ radius = \"10 cm\" }}\nmass = \"{mass}\"\nstart.at = [\"{x}\", \"10 cm\"]\n"
        )
    };
    let row = "[contact.balls]\nbetween = [\"a\", \"b\"]\nrigid = { restitution = 0.3, friction = 0.2 }\n";
    let balls = [
        &ball("a", "1 kg", "0 m"),
        &ball("b", "1.5 kg", "20 cm"),
        &floor("0.4"),
        row,
        &push("a", "(0.9 N/s)*t"),
    ];
    let pushes = scene(&balls.concat()).heavy().until("2 s");
    are(&pushes.ask(["a.vx", "b.vx"]), [1.8 / (1.4 + 1.4 * 1.5 * 1.2 / 0.8); 2], 1e-11);
    let wall = "[surface.wall]\nthrough = [\"-10 cm\", 0]\nnormal = [1, 0]\nrigid = { restitution = 0, friction = 0.4 }\n";
    let corner = |load: &str| scene(&[&ball("a", "1 kg", "0 m"), &floor("0.4"), wall, load].concat()).heavy();
    let pulled = corner(&push("a", "(0.9 N/s)*t")).until("2 s");
    are(&pulled.ask(["a.vx", "wall.normal"]), [1.8 / 1.4, 0.0], 1e-11);
    let pressed = corner(&push("a", "-(0.9 N/s)*t")).until("2 s");
    are(&pressed.ask(["a.vx", "a.ax"]), [0.0; 2], 1e-11);
    // Friction at the floor and at the wall holds the ball until both have all they can have.
    let turned = corner("[force.motor]\non = \"a\"\ntorque = \"(0.2 N*m/s)*t\"\n").until("6 s");
    are(&turned.ask(["floor.a.slides[1]"]), [0.4 * 0.1 * G * 1.4 / (1.16 * 0.2)], 1e-11);
}

/// Where more feet bear than are needed nothing slips before all have the friction they can have.
#[test]
fn joined_boxes_slip_together() {
    let truck = |name: &str, mass: &str, x: &str, hook: &str| {
        format!(
            "[body.{name}]\nbox = {{ width = \"20 cm\", height = \"10 cm\" }}\nmass = \"{mass}\"\npoints.hook = [\"{hook}\", 0]\n\
             start.at = [\"{x}\", \"5 cm\"]\n"
        )
    };
    let slips: f64 = 0.42 * 4.3 * G / 3.3;
    for joint in ["pin", "weld"] {
        let joint = format!("[{joint}.c]\nbetween = [\"a.hook\", \"b.hook\"]\n");
        let [a, b] = [truck("a", "1.4 kg", "0 m", "20 cm"), truck("b", "2.9 kg", "40 cm", "-20 cm")];
        let train = [a, b, joint, floor("{ static = 0.42, kinetic = 0.33 }"), push("b", "(3.3 N/s)*t")];
        let train = scene(&train.concat()).heavy().until("7 s");
        let speed = 3.3 * (49.0 - slips * slips) / (2.0 * 4.3) - 0.33 * G * (7.0 - slips);
        are(&train.ask(["floor.slides[1]", "b.vx"]), [slips, speed], 1e-9);
    }
}

/// A point does not turn: contact and friction hold it, and what they hold does not move at all.
#[test]
fn points_stay_where_friction_holds_them() {
    let point = |name: &str, x: &str| {
        format!("[body.{name}]\npoint = {{}}\nmass = \"2.9 kg\"\nstart.at = [\"{x}\", 0]\n")
    };
    let one = [point("b", "1 m"), floor("0.42"), push("b", "(3.3 N/s)*t")].concat();
    let found = scene(&one).heavy().until("3 s").ask(["b.x", "b.vx"]);
    are(&found, [1.0, 0.0], 1e-14);
    let spring =
        "[spring.s]\nbetween = [\"a.cm\", \"b.cm\"]\nstiffness = \"55 N/m\"\nrest_length = \"40 cm\"\n";
    let two = [point("a", "0 m"), point("b", "40 cm"), floor("0.42"), spring.to_owned()].concat();
    are(&scene(&two).heavy().until("3 s").ask(["a.x", "b.x"]), [0.0, 0.4], 1e-14);
}

const POINT: &str = "[body.p]\npoint = {}\nmass = \"2 kg\"\nstart = { velocity = [0, \"1 m/s\"] }\n";

fn wall(law: &str) -> String {
    format!("[surface.wall]\nthrough = [0, 0]\nnormal = [1, 0]\n{law}\n")
}

/// Where nothing but the load itself presses, all that is left of it at the zero of the force is rounding: what is not pressed any more is let
/// go.
#[test]
fn what_a_load_alone_presses_is_let_go_at_its_zero() {
    for friction in ["", ", friction = 0.1"] {
        let wall = wall(&format!("rigid = {{ restitution = 0{friction} }}"));
        for (load, until, speed) in [
            ("-(2 N)*sin(t/(1 s))", 4.0, 1.0 + 4.0_f64.cos()),
            ("-(2 N)*sin(t/(1 s) + 0.3)", 4.0, 1.0 + 4.3_f64.cos()),
            ("-(3 N) + (2 N/s)*t", 3.1, 0.5 * (1.6_f64 * 1.6)),
        ] {
            let pushed = scene(&[POINT, &wall, &push("p", load)].concat()).until(&format!("{until} s"));
            are(&pushed.ask(["p.vx", "wall.normal"]), [speed, 0.0], 1e-11);
        }
    }
    let disk = |name: &str, x: &str| {
        format!("[body.{name}]\ndisk = {{ radius = \"0.1 m\" }}\nmass = \"2 kg\"\nstart.at = [\"{x}\", 0]\n")
    };
    let row = "[contact.c]\nbetween = [\"a\", \"b\"]\nrigid = { restitution = 0 }\n";
    let two =
        [disk("a", "0 m"), disk("b", "0.2 m"), row.to_owned(), push("a", "(2 N)*sin(t/(1 s))")].concat();
    let apart = 1.0 - (1.0 + 4.0_f64.cos());
    are(&scene(&two).until("4 s").ask(["a.vx", "b.vx"]), [apart, 1.0], 1e-11);
}

/// A disk in a groove, turned and pressed by loads that begin at zero: neither wall is dropped, whatever they rub.
#[test]
fn a_groove_holds_what_begins_to_be_pressed() {
    for mu in [0.0, 0.3] {
        let disk =
            "[body.d]\ndisk = { radius = \"0.1 m\" }\nmass = \"2 kg\"\nstart.at = [0, \"(0.1 m)*sqrt(2)\"]\n";
        let side = |name: &str, x: i32| {
            format!(
                "[surface.{name}]\nthrough = [0, 0]\nnormal = [{x}, 1]\nrigid = {{ restitution = 0, friction = {mu} }}\n"
            )
        };
        let loads = "[force.q]\non = \"d\"\ntorque = \"(1 N*m/s)*t\"\n[force.p]\non = \"d\"\nat = \"d.cm\"\nforce = [0, \"-(10 N/s)*t\"]\n";
        let groove = scene(&[disk, &side("l", 1), &side("r", -1), loads].concat()).until("2 s");
        let rubs = 0.1 * mu * 10.0 * 2.0_f64.sqrt() / (1.0 + mu * mu);
        let height = 0.1 * 2.0_f64.sqrt();
        are(&groove.ask(["d.omega", "d.x", "d.y"]), [(1.0 - rubs) * 2.0 / 0.01, 0.0, height], 1e-10);
    }
}

/// A spring that is touched without speed or force is pressed as soon as a load begins, at the start or later.
#[test]
fn springs_are_pressed_by_loads_that_begin() {
    let rest = "[body.p]\npoint = {}\nmass = \"2 kg\"\n";
    let w = 500.0_f64.sqrt();
    let ramp = |t: f64| -t / (w * w) + (w * t).sin() / (w * w * w);
    for (load, until) in [("-(2 N/s)*t", 1.0), ("-(2 N/s)*max(t - 1 s, 0 s)", 2.0)] {
        let spring = wall("spring = { stiffness = \"1000 N/m\", damping = 0 }");
        let pushed = scene(&[rest, &spring, &push("p", load)].concat()).until(&format!("{until} s"));
        are(&pushed.ask(["p.x"]), [ramp(1.0)], 1e-11);
    }
}

/// Far up a slope that yields the normal force is known to some digits, and the friction that holds the body to all: how hard it is pressed goes out.
#[test]
fn friction_that_holds_is_known_better_than_what_presses() {
    let weight = 1.3_f64 * 7.9;
    for number in 1..40 {
        let slope = -0.3 + 0.013 * f64::from(number);
        let held = format!(
            "[parameters]\nslope = \"{slope} rad\"\nhigh = \"1e-9 m\"\nalong = \"10.9 m\"\n\
             [body.p]\npoint = {{}}\nmass = \"1.3 kg\"\n[body.p.start]\nat = [\"along*cos(slope) - high*sin(slope)\", \"along*sin(slope) + high*cos(slope)\"]\n\
             [surface.floor]\nthrough = [0, 0]\nslope = \"slope\"\n\
             spring = {{ stiffness = \"2.1e7 N/m\", damping = \"9.1e3 N*s/m\", friction = 0.4 }}\n"
        );
        let [normal, friction] = scene(&held)
            .gravity("7.9 m/s^2")
            .until("3 s")
            .accuracy(1e-10)
            .ask(["floor.normal", "floor.friction"]);
        normal.is(weight * slope.cos(), 1e-5);
        friction.is(weight * slope.sin(), 1e-13);
    }
}
