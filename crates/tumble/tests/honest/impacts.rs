//! What happens at one instant: impacts of several points, of held bodies, and between surfaces that close.

use std::f64::consts::{FRAC_PI_3, FRAC_PI_6};

use tumble::FindResult;

use super::ask::{Found, are, scene, walls};

/// Bodies with the height of their centres where they lie flat, m.
const FLAT: [(&str, f64); 3] = [
    ("rod = { from = [\"-0.5 m\", 0], to = [\"0.5 m\", 0] }", 0.0),
    ("rod = { from = [0, 0], to = [\"1 m\", 0] }", 0.0),
    ("box = { width = \"1 m\", height = \"0.4 m\" }", 0.2),
];

fn dropped(shape: &str, height: f64, restitution: f64) -> String {
    format!(
        "[body.p]\n{shape}\nmass = \"1 kg\"\nstart = {{ at = [0, \"{height} m\"] }}\n\
         [surface.floor]\nthrough = [0, 0]\nrigid = {{ restitution = {restitution} }}\n"
    )
}

/// Both ends strike at one instant, and nothing turns, now or later.
#[test]
fn what_falls_flat_stays_level() {
    for (shape, centre) in FLAT {
        for restitution in [0.5, 0.7, 0.9] {
            for height in [2.0, 1.0, 0.3, 1.7, 12.345] {
                let scene = scene(&dropped(shape, height, restitution)).heavy().until("4 s");
                let case = scene.run(&["floor.contact[1].start"]);
                let states =
                    case.run.trajectory().events.iter().flat_map(|event| [&event.before, &event.after]);
                // x, y, vx, vy, angle and omega.
                let turned = states.filter(|states| states[4] != 0.0 || states[5] != 0.0).count();
                assert_eq!(turned, 0, "{shape} from {height} m, {restitution}");
                Found::of(&case.finds[0]).is((2.0 * (height - centre) / 9.81).sqrt(), 1e-13);
            }
        }
    }
}

const HINGED: &str = r#"
[body.p]
rod = { from = [0, 0], to = [0, "-1 m"] }
mass = "1 kg"
start = { omega = "1 rad/s" }
[pivot.hinge]
body = "p"
point = [0, 0]
world = [0, 0]
[surface.right]
through = ["0.5 m", 0]
normal = [-1, 0]
rigid = { restitution = RESTITUTION }
[surface.left]
through = ["-0.5 m", 0]
normal = [1, 0]
rigid = { restitution = RESTITUTION }
"#;

/// It turns evenly by 60 degrees from wall to wall.
#[test]
fn a_hinged_rod_strikes_walls() {
    for restitution in [1.0, 0.8, 0.5] {
        let scene = scene(&HINGED.replace("RESTITUTION", &restitution.to_string()));
        let found = scene.ask([
            "right.contact[1].start",
            "p.omega at right.contact[1].start",
            "p.angle at right.contact[1].start",
            "left.contact[1].start",
            "p.omega at left.contact[1].start",
        ]);
        let turns = FRAC_PI_3 / restitution;
        let truth = [FRAC_PI_6, -restitution, FRAC_PI_6, FRAC_PI_6 + turns, restitution * restitution];
        are(&found, truth, 1e-13);
    }
}

/// The right wall comes at 0.25 m/s: it is struck at 0.4 s, and the left one at 1 s.
fn closing() -> String {
    let walls = walls("0 m", "1 m - t*(0.25 m/s)");
    format!(
        "[body.p]\npoint = {{}}\nmass = \"1 kg\"\nstart = {{ at = [\"0.5 m\", 0], velocity = [\"1 m/s\", 0] }}\n{walls}"
    )
}

#[test]
fn between_walls_that_close_at_the_very_time_of_an_impact() {
    let scene = scene(&closing()).until("2 s");
    let found = scene.ask(["p.vx at 0.4 s", "p.x at 0.4 s", "p.vx at 1 s", "p.x at 1 s", "p.vx at 0.9 s"]);
    are(&found, [-1.5, 0.9, 1.5, 0.0, -1.5], 1e-12);
    let found = scene.ask(["p.vx at right.contact[1].start", "t at left.contact[1].start"]);
    are(&found, [-1.5, 1.0], 1e-12);
}

#[test]
fn before_an_impact_the_velocity_is_that_before_it() {
    let before = "[find.before]\nthat = \"p.vx\"\nat = \"0.4 s\"\nside = \"before\"\n";
    let case = scene(&format!("{}{before}", closing())).until("2 s").run(&[]);
    Found::of(&case.finds[0]).is(1.0, 1e-12);
}

#[test]
fn a_surface_without_damping_lets_go_for_good_at_zero_force() {
    let (g, speed) = (56.38, 0.5);
    for number in 0..24 {
        let height = 5.54e-4 + 1e-5 * f64::from(number);
        let bouncing = format!(
            "[parameters]\ndamping = \"0 kg/s\"\n\
             [body.p]\nball = {{ radius = \"0.44812 mm\" }}\nmass = \"2.78348 kg\"\n\
             start = {{ at = [0, \"0.44812 mm + {height} m\"], velocity = [0, \"-{speed} m/s\"] }}\n\
             [surface.floor]\nthrough = [0, 0]\n\
             spring = {{ stiffness = \"0.010639 t/us^2\", damping = \"damping\", release = \"at zero force\" }}\n"
        );
        let scene = scene(&bouncing).gravity(&format!("{g} m/s^2")).until("70 ms").accuracy(3.6e-12);
        let [found] = scene.ask(["p.vy at floor.contact[3].end"]);
        found.is((2.0 * g * height + speed * speed).sqrt(), 1e-8);
    }
}

/// Two pinned rods on a rough floor: their bounces push each other and lead to no end of a kind that arithmetic finds at once. Each
/// attempt at that is given up, and they come to lie.
#[test]
fn rough_bounces_of_pinned_rods_come_to_an_end() {
    let rod = |name: &str, length: f64, mass: u32, at: [f64; 2], velocity: [f64; 2], turn: [f64; 2]| {
        format!(
            "[body.{name}]\nrod = {{ from = [0, 0], to = [\"{length} m\", 0] }}\nmass = \"{mass} kg\"\npoints.end = [0, 0]\n\
             start = {{ at = [\"{} m\", \"{} m\"], velocity = [\"{} m/s\", \"{} m/s\"], angle = \"{} deg\", omega = \"{} rad/s\" }}\n",
            at[0], at[1], velocity[0], velocity[1], turn[0], turn[1]
        )
    };
    let first = rod(
        "a",
        0.7304745875009395,
        1,
        [-0.3102692755398064, 1.3940113923041542],
        [-1.580481774328006, 0.4763079557018781],
        [-148.15738604050128, -1.535143803308264],
    );
    let second = rod(
        "b",
        0.40541220788254334,
        2,
        [-0.1567598307137557, 1.4581910605598796],
        [-1.5662470156184125, 0.3434642829843923],
        [-140.65436803260647, -2.1910222881750867],
    );
    let rest = "[pin.P]\nbetween = [\"a.end\", \"b.end\"]\nassemble = true\n\
                [surface.floor]\nthrough = [0, 0]\nrigid = { restitution = 0.5, friction = 0.6 }\n";
    let case = scene(&format!("{first}{second}{rest}"))
        .heavy()
        .until("1.2 s")
        .run(&["a.energy + b.energy", "b.omega"]);
    assert_eq!(case.run.end(), Some(1.2));
    let [energy, omega] = [0, 1].map(|index: usize| case.finds[index].value);
    assert!((0.0..40.0).contains(&energy), "{energy}");
    assert!(omega.abs() < 1e-9, "{omega}");
}

/// A row of free balls of equal mass whose impacts follow each other ever faster, until they all but go on together: with the mean of their velocities.
/// From some impact on, gaps are smaller than rounding.
#[test]
fn impacts_too_close_to_be_told_apart() {
    let two = [("0.1 m", "1 m/s"), ("0.4 m", "0.1 m/s"), ("0.65 m", "-0.93 m/s")];
    let three = [
        ("0 m", "0.9362 m/s"),
        ("0.4361 m", "0.2474 m/s"),
        ("0.6756 m", "-0.162 m/s"),
        ("0.9562 m", "-0.7062 m/s"),
    ];
    for (row, restitution, mean) in
        [(&two[..], 0.0719, 0.17 / 3.0), (&two, 0.07, 0.17 / 3.0), (&three, 0.1697, 0.07885)]
    {
        let ball = |(index, (at, velocity)): (usize, &(&str, &str))| {
            format!(
                "[body.b{index}]\nball = {{ radius = \"0.1 m\" }}\nmass = \"1 kg\"\nstart = {{ at = [\"{at}\", 0], velocity = [\"{velocity}\", 0] }}\n"
            )
        };
        let balls: String = row.iter().enumerate().map(ball).collect();
        let row_of =
            format!("{balls}[contact.row]\nbetween = \"all\"\nrigid = {{ restitution = {restitution} }}\n");
        let asked = ["b0.vx", "b1.vx", "b2.vx", "b3.vx"];
        let found = scene(&row_of).until("3 s").accuracy(1e-12).run(&asked[..row.len()]).finds;
        let covers = |find: &FindResult| find.error.is_none_or(|error| (find.value - mean).abs() <= error);
        assert!(found.iter().all(covers), "{restitution}: {found:?}");
    }
}

/// A wall that gives back next to nothing gives back that: to a ball, to both corners of a box that falls flat, to a rod on a pivot.
#[test]
fn the_least_rebound_is_one() {
    let flight = "start = { velocity = [\"0.3 m/s\", \"1 m/s\"] }\n";
    let bodies = [
        (format!("ball = {{ radius = \"0.1 m\" }}\n{flight}"), "b.vy"),
        (format!("box = {{ width = \"0.4 m\", height = \"0.2 m\" }}\n{flight}"), "b.vy"),
        (
            "rod = { from = [0, 0], to = [\"1 m\", 0] }\nstart = { omega = \"1 rad/s\" }\n\
             [pivot.p]\nbody = \"b\"\npoint = [\"-0.5 m\", 0]\nworld = [0, 0]\n"
                .to_owned(),
            "b.omega",
        ),
    ];
    for (body, speed) in bodies {
        for restitution in [1e-15, 5e-15, 1e-14, 1e-13, 1e-12, 1e-11] {
            let wall = format!(
                "[surface.wall]\nthrough = [0, \"0.5 m\"]\nnormal = [0, -1]\nrigid = {{ restitution = {restitution:e} }}\n"
            );
            let case =
                scene(&format!("[body.b]\nmass = \"1 kg\"\n{body}{wall}")).until("2 s").accuracy(1e-12);
            let found = case.run(&[speed]).finds;
            let error = found[0].error.expect("a known velocity");
            assert!(
                (found[0].value + restitution).abs() <= error && error < 1e-14,
                "{restitution}: {found:?}"
            );
        }
    }
}

/// One ball strikes a row of others that touch, one after the other: infinitely many impacts at one instant, after which all go on together.
#[test]
fn infinitely_many_impacts_at_one_instant_come_to_their_limit() {
    for count in [3, 4, 5] {
        for restitution in [0.0, 0.01, 0.05] {
            let ball = |index: usize| {
                let (at, velocity) = if index == 0 { (-0.5, 1) } else { (0.2 * (index - 1) as f64, 0) };
                format!(
                    "[body.b{index}]\nball = {{ radius = \"0.1 m\" }}\nmass = \"1 kg\"\n\
                     start = {{ at = [\"{at:.1} m\", 0], velocity = [\"{velocity} m/s\", 0] }}\n"
                )
            };
            let balls: String = (0..count).map(ball).collect();
            let row = format!(
                "world.impacts = \"sequential\"\n{balls}[contact.row]\nbetween = \"all\"\nrigid = {{ restitution = {restitution} }}\n"
            );
            let asked = ["b0.vx", "b1.vx", "b2.vx", "b3.vx", "b4.vx"];
            let found = scene(&row).until("2 s").accuracy(1e-12).run(&asked[..count]).finds;
            let mean = 1.0 / count as f64;
            let covers = |find: &FindResult| {
                find.error.is_some_and(|error| (find.value - mean).abs() <= error && error < 1e-14)
            };
            assert!(found.iter().all(covers), "{count} {restitution}: {found:?}");
        }
    }
}

/// How fast it moves along the floor takes no part in what the floor does to it.
#[test]
fn the_work_of_a_floor_is_known_as_well_of_what_is_thrown_far() {
    for speed in [0.0, 3e3, -7.1e6] {
        let ball = format!(
            "[body.p]\npoint = {{}}\nmass = \"1 kg\"\nstart = {{ at = [0, \"2 m\"], velocity = [\"{speed:e} m/s\", 0] }}\n\
             [surface.floor]\nthrough = [0, 0]\nrigid = {{ restitution = 0.6 }}\n"
        );
        scene(&ball).heavy().ask(["floor.work"])[0].is(-2.0 * 9.81, 2e-12);
    }
}
