//! Every mistake: its code, the words it underlines, and part of what it says.

#[path = "common/bad_rows.rs"]
mod bad_rows;
#[path = "common/beside.rs"]
mod beside;
#[path = "common/book.rs"]
mod book;
#[path = "common/rows.rs"]
mod rows;

use rows::{Row, difference, table};
use tumble_scene::{Diagnostics, Override, read, read_bytes};

const SCENE: &str = r#"version = 1
title = "Test"
plane = "vertical"

[parameters]
m = "1 kg"
L = "1 m"
T = "2 s"
half = "L/2"

[functions]
"w(t)" = "2*cos(2*pi*t/T)"

[world]
gravity = "9.81 m/s^2"

[body.rod]
rod = { from = [0, 0], to = [0, "-L"] }
mass = "m"
points.tip = [0, "-L"]
start = { angle = "10 deg", omega = 0 }

[body.ball]
ball = { radius = "0.1 m" }
mass = "m"
start = { at = ["2 m", 0], velocity = ["1 m/s", 0] }

[pivot.hinge]
body = "rod"
point = [0, 0]
world = [0, 0]

[force.push]
on = "rod"
at = "rod.tip"
force = ["w(t)*1 N", 0]
during = [0, "T"]

[force.twist]
on = "ball"
torque = "0.1 N*m"

[run]
until = "5 s"
accuracy = 1e-9

[output]
every = "10 ms"

[plot.angle]
y = "rod.angle"

[stroboscope.all]
every = "0.5 s"

[check.end]
that = "rod.angle"
equals = "0 rad"
within = "10 rad"

[symbols]
"rod.angle" = "theta"
"#;

const TOML: &[Row] = &[
    ("mass = \"m\"\npoints", "mass = 1 kg\npoints", "E0501 1 kg", "write `mass = \"1 kg\"`"),
    ("[world]", "[world", "E0501 ", "not TOML"),
    ("L = \"1 m\"", "L = \"1 m\"\nL = \"2 m\"", "E0502 L | L", "given twice"),
    ("[body.ball]", "[body.rod]\n[body.ball]", "E0502 rod | rod", "`rod` is given twice"),
    ("from = [0, 0]", "from = [0, 0], from = [1, 1]", "E0502 from | from", "first here"),
    (
        "points.tip = [0, \"-L\"]",
        "points.tip = [0, \"-L\"]\npoints.tip = [0, 0]",
        "E0502 tip | tip",
        "again here",
    ),
];

const STRUCTURE: &[Row] = &[
    ("version = 1\n", "", "E0513", "add, for example,\nversion = 1"),
    ("version = 1\n", "version = 2\n", "E0506 2", "reads version 1"),
    ("version = 1\n", "version = \"1\"\n", "E0514 \"1\"", "the number 1, not a text in quotes"),
    ("title = \"Test\"", "title = 3", "E0514 3", "a text in quotes, not a number"),
    ("title = \"Test\"", "titel = \"Test\"", "E0511 titel", "did you mean `title`?"),
    ("\"vertical\"", "\"vertikal\"", "E0518 \"vertikal\"", "write \"vertical\" or \"horizontal\""),
    ("[world]\ngravity = \"9.81 m/s^2\"", "", "E0512", "there is no section `[world]`"),
    ("gravity = \"9.81 m/s^2\"", "", "E0513 world", "without gravity `gravity = \"0 m/s^2\"`"),
    ("[run]\nuntil = \"5 s\"\naccuracy = 1e-9", "", "E0512", "until = \"10 s\""),
    ("[output]", "[outputs]", "E0510 outputs", "did you mean `output`?"),
    ("[output]", "[quux]\na = 1\n[output]", "E0510 quux", "a scene is made of `version`, `title`"),
    ("[output]", "[friction]\nmu = 0.3\n[output]", "E0510 friction", "surfaces have friction: "),
    ("[output]", "[joint.hinge]\na = 1\n[output]", "E0510 joint", "`[pin.NAME]` lets two bodies turn"),
    ("[output]", "[wind]\na = 1\n[output]", "E0510 wind", "`wind` is a key of `[world]`"),
    ("[output]", "[kind]\na = 1\n[output]", "E0510 kind", "a scene is made of `version`, `title`"),
    ("[output]", "[rope.long]\na = 1\n[output]", "E0510 rope", "there are no ropes yet"),
    ("until = \"5 s\"", "until = \"5 s\"\ndt = \"1 ms\"", "E0511 dt", "steps are chosen by the program"),
    ("from = [0, 0]", "from = [0, 0, 0]", "E0515 [0, 0, 0]", "no bodies in space yet"),
    ("[output]", "[drag.air]\nquadratic = 1\n[output]", "E0513 air", "does not say where it acts"),
    ("until = \"5 s\"", "until = \"5 s\"\nutnil = \"6 s\"", "E0511 utnil", "did you mean `until`?"),
    ("until = \"5 s\"", "until = \"5 s\"\ntitle = \"a\"", "E0511 title", "stands at the top level"),
    (
        "until = \"5 s\"",
        "until = \"5 s\"\nzork = \"a\"",
        "E0511 zork",
        "the keys are `until`, `accuracy` and `text`",
    ),
    ("until = \"5 s\"", "until = { rest = true }", "E0513 until", "add `at_most = \"60 s\"`"),
    (
        "until = \"5 s\"",
        "until = { rest = false, at_most = \"5 s\" }",
        "E0519 false",
        "write `until = \"60 s\"`, or `rest = true`",
    ),
    ("until = \"5 s\"", "until = { rest = true, at_most = 5 }", "E0516 5", "write \"5 s\""),
    ("until = \"5 s\"", "", "E0513 run", "add `until = \"10 s\"`"),
    ("[force.twist]\n", "[[force.twist]]\n", "E0514 twist", "write `[force.twist]`"),
    ("[plot.angle]\n", "[plot]\n", "E0514 y", "give the plot a name: `[plot.NAME]`"),
    ("mass = \"m\"\npoints", "points", "E0513 rod", "add `mass = \"1 kg\"`"),
    (
        "mass = \"m\"\npoints",
        "mass = [\"m\"]\npoints",
        "E0514 [\"m\"]",
        "one formula in quotes, not a list of 1",
    ),
    ("mass = \"m\"\npoints", "mass = true\npoints", "E0514 true", "a formula in quotes, not `true`"),
    ("mass = \"m\"\npoints", "mass = 1.5\npoints", "E0516 1.5", "write \"1.5 kg\""),
    ("mass = \"m\"\npoints", "mass = nan\npoints", "E0517 nan", "not a finite number"),
    ("mass = \"m\"\npoints", "mass = -inf\npoints", "E0517 -inf", "not a finite number"),
    ("mass = \"m\"\npoints", "mass = 0xff\npoints", "E0514 0xff", "not decimal"),
    ("from = [0, 0]", "from = [0, 0, 0]", "E0515 [0, 0, 0]", "a list of two, [x, y], not of 3"),
    ("from = [0, 0]", "from = \"[0, 0]\"", "E0514 \"[0, 0]\"", "a list of two, [x, y], not a text in quotes"),
    ("from = [0, 0]", "from = [0, 1]", "E0516 1", "write \"1 m\""),
    ("from = [0, 0], ", "", "E0513 rod", "add `from = [0, 0]`"),
    ("angle = \"10 deg\"", "angle = 10", "E0516 10", "write \"10 deg\" or \"10 rad\""),
    ("during = [0, \"T\"]", "during = \"T\"", "E0514 \"T\"", "[start, end]"),
    ("accuracy = 1e-9", "accuracy = \"1e-9\"", "E0514 \"1e-9\"", "a number without quotes"),
    ("accuracy = 1e-9", "accuracy = 1", "E0534 1", "write `accuracy = 1e-9`"),
    ("every = \"0.5 s\"", "every = \"0.5 s\"\ntrace = \"yes\"", "E0514 \"yes\"", "`true` or `false`"),
    ("y = \"rod.angle\"", "y = []", "E0515 []", "no curve"),
    ("within = \"10 rad\"", "", "E0513 end", "add `within = \"1e-9 rad\"`"),
];

const BODIES: &[Row] = &[
    ("ball = { radius = \"0.1 m\" }\n", "", "E0513 ball", "has no shape"),
    (
        "ball = { radius",
        "disk = { radius = \"1 m\" }\nball = { radius",
        "E0519 ball | disk",
        "both `disk` and `ball`",
    ),
    (
        "ball = { radius",
        "ball = { diameter",
        "E0513 ball && E0511 diameter",
        "the keys are `radius` and `centre`",
    ),
    (
        "ball = { radius = \"0.1 m\" }",
        "ball = { radius = \"0.1 m\", center = [0, 0] }",
        "E0511 center",
        "did you mean `centre`?",
    ),
    (
        "ball = { radius = \"0.1 m\" }",
        "polygon = { corners = [[0, 0], [\"1 m\", 0]] }",
        "E0515 [[0, 0], [\"1 m\", 0]]",
        "3 corners or more",
    ),
    (
        "mass = \"m\"\npoints",
        "mass = \"m\"\ninertia = \"1 kg*m^2\"\npoints",
        "E0513 inertia",
        "state `centre` too",
    ),
    ("mass = \"m\"\npoints", "mass = \"m\"\ncentre = [0, 0]\npoints", "E0513 centre", "state `inertia` too"),
    (
        "ball = { radius = \"0.1 m\" }",
        "parts = [{ point = {}, mass = \"1 kg\" }]",
        "E0519 mass | parts",
        "belongs into one of the parts",
    ),
    ("ball = { radius = \"0.1 m\" }\nmass = \"m\"", "parts = []", "E0514 []", "a list of tables"),
    (
        "ball = { radius = \"0.1 m\" }\nmass = \"m\"",
        "parts = [{ point = {} }]",
        "E0513 { point = {} }",
        "`mass` is missing in `parts`",
    ),
    ("points.tip", "points.x", "E0523 x && E0521 \"rod.tip\"", "every body has its own `x`"),
    ("points.tip", "points.\"a b\"", "E0522 \"a b\" && E0521 \"rod.tip\"", "names begin with a letter"),
    ("on = \"ball\"", "on = \"bal\"", "E0520 \"bal\"", "did you mean \"ball\"?"),
    ("on = \"ball\"", "on = \"zork\"", "E0520 \"zork\"", "the bodies are `rod` and `ball`"),
    ("at = \"rod.tip\"", "at = \"tip\"", "E0521 \"tip\"", "write \"rod.tip\""),
    ("at = \"rod.tip\"", "at = \"rod.top\"", "E0521 \"rod.top\"", "did you mean \"rod.tip\"?"),
    ("at = \"rod.tip\"", "at = \"ball.cm\"", "E0521 \"ball.cm\"", "`rod` has no point \"ball.cm\""),
    ("at = \"rod.tip\"", "at = { from_center = [0, 0] }", "E0511 from_center", "did you mean `from_centre`?"),
    ("at = \"rod.tip\"", "at = {}", "E0519 {}", "not 0 of them"),
    ("at = \"rod.tip\"", "at = [0, 0]", "E0514 [0, 0]", "{ from_centre = [..] }"),
    ("at = \"rod.tip\"\n", "", "E0513 push", "add `at = \"rod.cm\"`"),
    ("torque = \"0.1 N*m\"", "torque = \"0.1 N*m\"\nforce = [0, 0]", "E0519 torque | force", "two sections"),
    ("torque = \"0.1 N*m\"", "torque = \"0.1 N*m\"\nat = \"ball.cm\"", "E0519 at", "only for a force"),
    ("torque = \"0.1 N*m\"", "", "E0513 twist", "neither `force` nor `torque`"),
    ("during = [0, \"T\"]", "frame = \"rod\"", "E0518 \"rod\"", "\"world\" or \"body\""),
    (
        "[pivot.hinge]\nbody = \"rod\"",
        "[pivot.hinge]\nbody = \"ball\"",
        "E0537 start",
        "its pivot says where it is",
    ),
    (
        "world = [0, 0]\n",
        "world = [0, 0]\n[pivot.other]\nbody = \"rod\"\npoint = \"rod.tip\"\nworld = [0, 0]\n",
        "E0535 other | hinge",
        "held by `hinge` and by `other`",
    ),
    ("ball = { radius = \"0.1 m\" }", "point = {}", "E0536 twist", "no moment of inertia"),
];

const FORMULAS: &[Row] = &[
    ("half = \"L/2\"", "half = \"L/2 + m\"", "E0401 L/2 | m", "adds a length (m) and a mass (kg)"),
    ("points.tip = [0, \"-L\"]", "points.tip = [0, \"-LL\"]", "E0301 LL", "did you mean `L`?"),
    ("half = \"L/2\"", "half = \"LL/2\"", "E0301 LL", "did you mean `L`?"),
    ("half = \"L/2\"", "half = \"[L, L]\"", "E0406 [L, L]", "expected a number, found a vector"),
    ("half = \"L/2\"", "half = \"\"", "E0101 ", "no formula"),
    ("half = \"L/2\"", "half = \"\\u004C + m\"", "E0401 \"\\u004C + m\" | \"\\u004C + m\"", "a length"),
    ("half = \"L/2\"", "half = '''L + m'''", "E0401 L | m", "a length"),
    ("mass = \"m\"\npoints", "mass = \"L\"\npoints", "E0404 L", "expected a mass (kg), found a length (m)"),
    ("mass = \"m\"\npoints", "mass = \"2\"\npoints", "E0404 2", "write \"2 kg\", with the unit"),
    ("mass = \"m\"\npoints", "mass = \"m*t/T\"\npoints", "E0525 t", "`t` changes during the run"),
    ("mass = \"m\"\npoints", "mass = \"m*ball.x/L\"\npoints", "E0525 ball.x", "numbers and parameters only"),
    ("half = \"L/2\"", "half = \"rod.tip.y\"", "E0525 rod.tip.y", "fixed before the run starts"),
    ("angle = \"10 deg\"", "angle = \"10\"", "E0204 10", "does not state its unit"),
    ("omega = 0", "omega = \"2 Hz\"", "E0205 2 Hz", "write `2 rev/s`"),
    (
        "force = [\"w(t)*1 N\", 0]",
        "force = [\"m*ball.ax\", 0]",
        "E0526 ball.ax",
        "a force cannot depend on an acceleration",
    ),
    (
        "force = [\"w(t)*1 N\", 0]",
        "force = [\"m*ball.alpha*L\", 0]",
        "E0526 ball.alpha",
        "accelerations follow from the forces",
    ),
    (
        "torque = \"0.1 N*m\"",
        "torque = \"if(t < T, 0.1, 0.2)*hinge.force*L\"",
        "E0562 \"if(t < T, 0.1, 0.2)*hinge.force*L\"",
        "may jump between events",
    ),
    ("torque = \"0.1 N*m\"", "torque = \"hinge.fx\"", "E0404 hinge.fx", "found a force"),
    (
        "at = \"rod.tip\"\nforce",
        "at = { world = [\"hinge.fx/(1 N)*L\", 0] }\nforce",
        "E0525 hinge.fx",
        "no place and no impulse",
    ),
    ("force = [\"w(t)*1 N\", 0]", "force = [\"w(t)\", 0]", "E0404 w(t)", "found a pure number"),
    (
        "force = [\"w(t)*1 N\", 0]",
        "force = [\"w(L)*1 N\", 0]",
        "E0402 2*pi*t/T | w(L)",
        "a pure number or an angle",
    ),
    ("2*pi*t/T)\"", "2*pi*t/TT)\"", "E0301 TT | w(t)", "did you mean `T`?"),
    ("\"w(t)\" =", "\"v(t)\" = \"2*foo + bar(t)\"\n\"w(t)\" =", "E0301 foo && E0302 bar", "unknown"),
    ("\"w(t)\" =", "\"v(t\" = \"2\"\n\"w(t)\" =", "E0116 v(t", "write `w(t)`"),
    ("\"w(t)\" =", "\"v(s)\" = \"2*(\"\n\"w(t)\" =", "E0108 ( && E0109  | (", "value"),
    ("L = \"1 m\"", "L = \"K\"\nK = \"half\"", "E0524 \"K\" | \"half\" | \"L/2\"", "L -> K -> half -> L"),
    ("L = \"1 m\"", "L = \"L\"", "E0524 \"L\"", "in a circle: L -> L"),
    ("m = \"1 kg\"", "m = \"1 kg\"\nt = \"1 s\"", "E0523 t", "`t` is the time"),
    ("m = \"1 kg\"", "m = \"1 kg\"\naccuracy = 3", "E0523 accuracy", "`accuracy` is the accuracy of the run"),
    ("m = \"1 kg\"", "m = \"1 kg\"\npi = 3", "E0523 pi", "every formula knows"),
    ("m = \"1 kg\"", "m = \"1 kg\"\n\"a.b\" = 3", "E0522 \"a.b\"", "is not a name"),
    ("m = \"1 kg\"", "m = \"1 kg\"\nball = 3", "E0523 ball | ball", "the name of a body and of a parameter"),
    ("m = \"1 kg\"", "m = \"1 kg\"\nw = 3", "E0523 w | w", "the name of a parameter and of a function"),
    (
        "y = \"rod.angle\"",
        "y = [\"rod.angle\", \"rod.omega\"]",
        "E0527 \"rod.omega\" | \"rod.angle\"",
        "on one axis",
    ),
    ("y = \"rod.angle\"", "y = \"rod.angel\"", "E0301 rod.angel", "did you mean `rod.angle`?"),
    (
        "y = \"rod.angle\"",
        "y = \"rod.angle\"\nx = \"rod.tipp.x\"",
        "E0301 rod.tipp.x",
        "did you mean `rod.tip.x`?",
    ),
    ("equals = \"0 rad\"", "equals = \"1 m\"", "E0204 1 m", "not one of an angle"),
    ("within = \"10 rad\"", "within = 1", "E0516 1", "\"1 rad\", in quotes"),
    (
        "\"rod.angle\" = \"theta\"",
        "\"rod.angel\" = \"theta\"",
        "E0511 \"rod.angel\"",
        "did you mean \"rod.angle\"?",
    ),
    ("\"rod.angle\" = \"theta\"", "rod.angle = 3", "E0514 3", "a text in quotes"),
];

const VALUES: &[Row] = &[
    ("m = \"1 kg\"", "m = \"0 kg\"", "E0530 \"m\" && E0530 \"m\"", "must be positive"),
    ("radius = \"0.1 m\"", "radius = \"-0.1 m\"", "E0530 \"-0.1 m\"", "radius of `ball` is -0.1 m"),
    ("to = [0, \"-L\"]", "to = [0, 0]", "E0530 rod", "length of `rod` is 0 m"),
    ("half = \"L/2\"", "half = \"sqrt(-L)\"", "E0517 \"sqrt(-L)\"", "parameter `half`"),
    ("during = [0, \"T\"]", "during = [\"T\", 0]", "E0531 [\"T\", 0]", "ends before it begins"),
    ("until = \"5 s\"", "until = \"0 s\"", "E0530 \"0 s\"", "must end later"),
    ("every = \"10 ms\"", "every = \"0 s\"", "E0530 \"0 s\"", "must be positive"),
    ("every = \"10 ms\"", "every = \"1 us\"", "E0532 \"1 us\"", "about 5e6 samples"),
    ("every = \"0.5 s\"", "every = \"-1 s\"", "E0530 \"-1 s\"", "must be positive"),
    ("within = \"10 rad\"", "within = \"10 rad\"\nat = \"6 s\"", "E0533 \"6 s\"", "from 0 to 5 s"),
    ("within = \"10 rad\"", "within = \"-1 rad\"", "E0530 \"-1 rad\"", "must not be negative"),
];

#[track_caller]
fn expect(mistakes: &Diagnostics, underlined: &str, says: &str) {
    let found = difference(mistakes, underlined, says);
    assert!(found.is_none(), "{}", found.unwrap_or_default());
}

#[test]
fn the_scene_without_mistakes() {
    read("scene.toml", SCENE, &[]).unwrap_or_else(|mistakes| panic!("{}", mistakes.render(false, 100)));
}

#[test]
fn mistakes_of_toml() {
    table(SCENE, TOML);
}

#[test]
fn mistakes_of_structure() {
    table(SCENE, STRUCTURE);
}

#[test]
fn mistakes_of_bodies_and_loads() {
    table(SCENE, BODIES);
}

#[test]
fn mistakes_of_formulas() {
    table(SCENE, FORMULAS);
}

#[test]
fn mistakes_of_values() {
    table(SCENE, VALUES);
}

#[test]
fn mistakes_of_haste() {
    let all = [bad_rows::NUMBERS, bad_rows::MOTIONS, bad_rows::SWEEPS, bad_rows::FIGURES, bad_rows::FILES];
    table(SCENE, &all.concat());
}

#[test]
fn the_book_lists_these_mistakes() {
    let chapters = [
        ("The file as TOML", TOML),
        ("Sections and keys", STRUCTURE),
        ("Bodies and loads", BODIES),
        ("Numbers and their signs", bad_rows::NUMBERS),
        ("Formulas", FORMULAS),
        ("Values", VALUES),
        ("Motions", bad_rows::MOTIONS),
        ("Sweeps", bad_rows::SWEEPS),
        ("Figures and checks", bad_rows::FIGURES),
        ("Files", bad_rows::FILES),
    ];
    book::same_page(SCENE, &chapters);
}

#[test]
fn mistakes_of_settings() {
    let rows = [
        ("TT", "2s", "E0540 TT", "did you mean \"T\"?"),
        ("T", "2m", "E0404 2m", "expected a time (s), found a length (m)"),
        ("T", "2", "E0404 2", "write \"2 s\", with the unit"),
        ("T", "", "E0101 ", "no formula"),
        ("T", "2*", "E0109  | *", "value"),
        ("T", "t", "E0525 t", "changes during the run"),
        ("T", "T", "E0524 \"2 s\"", "in a circle"),
        ("ball", "2", "E0540 ball", "there is no parameter `ball`"),
        ("accuracy", "1", "E0534 1", "between 1e-14 and 1e-3"),
        ("accuracy", "nan", "E0534 nan", "out of range"),
        ("accuracy", "high", "E0514 high", "`accuracy` is a number, not `high`"),
        ("acuracy", "1e-6", "E0540 acuracy", "did you mean \"accuracy\"?"),
    ];
    for (name, text, underlined, says) in rows {
        let set = Override { name: name.into(), text: text.into() };
        let mistakes = read("scene.toml", SCENE, &[set]).expect_err(text);
        expect(&mistakes, underlined, says);
    }
}

#[test]
fn mistakes_of_the_file() {
    let mistakes = read("scene.toml", "", &[]).expect_err("empty");
    expect(&mistakes, "E0505", "a short scene is");
    let mistakes = read_bytes("scene.toml", b"title = \"a\"\nm = \"\xff\"\n", &[]).expect_err("no UTF-8");
    expect(&mistakes, "E0503 ", "line 2 holds the byte 0xff");
    let mistakes =
        read_bytes("scene.toml", &vec![b' '; tumble_scene::MAX_BYTES + 1], &[]).expect_err("too large");
    expect(&mistakes, "E0504", "at most");
}

#[test]
fn all_mistakes_are_told_at_once_and_in_order() {
    let scene = SCENE
        .replace("m = \"1 kg\"", "m = \"1 kgg\"")
        .replace("plane = \"vertical\"", "plane = \"tilted\"")
        .replace("on = \"ball\"", "on = \"bal\"")
        .replace("until = \"5 s\"", "until = 5");
    let mistakes = read("scene.toml", &scene, &[]).expect_err("four mistakes");
    expect(&mistakes, "E0518 \"tilted\" && E0201 kgg && E0520 \"bal\" && E0516 5", "did you mean `kg`?");
    assert!(
        mistakes
            .to_string()
            .starts_with("scene.toml:3:9: E0518: `plane` cannot be \"tilted\"\nscene.toml:6:")
    );
}
