//! Mistakes in the sections of laws, events, tables and sweeps.

#[path = "common/beside.rs"]
mod beside;
#[path = "common/rows.rs"]
mod rows;

use beside::Beside;
use rows::{Row, table};
use tumble_scene::read_in;

const SCENE: &str = r#"version = 1
plane = "vertical"

[parameters]
M = "1 kg"
D = "0.02 kg/m"
c = "0.02 kg/m^2"
T = "2 s"
tilt = "10 deg"
x = "3 m"

[table.gust]
file = "gust.csv"
columns = ["t [ms]", "w [km/h]"]
interpolation = "linear"
outside = "hold"

[functions]
"shifted(s)" = "gust(s - T)*(x/(3 m))"

[world]
gravity = "9.81 m/s^2"
wind = ["shifted(t)*exp(y/(10 m))", "gust(t)"]

[body.rod]
rod = { from = [0, 0], to = [0, "-1 m"] }
mass = "M"
points.tip = [0, "-1 m"]
start = { angle = "tilt" }

[body.ball]
ball = { radius = "0.1 m" }
mass = "M"
start = { at = ["2 m", 0], velocity = ["1 m/s", "5 m/s"] }

[pivot.hinge]
body = "rod"
point = [0, 0]
world = ["0.1 m*sin(t/(0.1 s))", 0]

[event.apex]
when = "ball.vy falls through 0 m/s"
action = { set = { D = "2*D" } }

[event.level]
when = "rod.angle passes through 45 deg"

[force.push]
on = "ball"
at = "ball.cm"
force = ["1 N", 0]
during = ["apex", "4 s"]

[drag.point]
at = "rod.tip"
quadratic = "D"
component = "normal"

[drag.line]
along = "rod"
quadratic = "c"

[drag.round]
on = "ball"
density = "1.2 kg/m^3"
coefficient = 0.47

[lift.up]
on = "ball"
factor = "0.01 kg"

[spring.band]
between = ["rod.tip", "ball.cm"]
stiffness = "10 N/m"
rest_length = "1 m"

[damper.oil]
between = ["ball.cm", { world = ["0.1 m*sin(t/T)", "-5 m"] }]
damping = "0.1 kg/s"

[torsion.wire]
on = "rod"
stiffness = "0.5 N*m/rad"
rest_angle = 0

[run]
until = "5 s"

[sweep]
T = ["1 s", "2 s"]
tilt = { from = "0 deg", to = "30 deg", count = 4 }

[check.top]
that = "ball.vy"
equals = 0
at = "apex"
within = "1e-9 m/s"
"#;

const AIR: &[Row] = &[
    ("wind = [\"shifted(t)*exp(y/(10 m))\"", "wind = [\"D\"", "E0404 D", "`wind` is a speed"),
    ("\"gust(t)\"]\n", "\"ball.vx\"]\n", "E0525 ball.vx", "`ball.vx` follows from the motion"),
    ("\"gust(t)\"]\n", "\"gust(y)\"]\n", "E0410 y", "was measured over a time (s), not over a length (m)"),
    ("\"gust(t)\"]\n", "\"gust\"]\n", "E0307 gust", "write `gust(t)`"),
    ("\"gust(t)\"]\n", "\"gust(t, 2)\"]\n", "E0303 gust(t, 2)", "gust takes 1 argument, not 2"),
    ("\"gust(t)\"]\n", "\"gustt(t)\"]\n", "E0302 gustt", "did you mean `gust`?"),
    ("quadratic = \"D\"", "quadratic = \"c\"", "E0404 c", "along` a body, both are per metre of its edges"),
    ("quadratic = \"c\"", "quadratic = \"D\"", "E0404 D", "quadratic` in kg/m;"),
    (
        "quadratic = \"c\"",
        "quadratic = 2",
        "E0516 2",
        "write \"2 kg/m^2\", in quotes and with its unit; `at`",
    ),
    ("quadratic = \"D\"\n", "", "E0513 point", "add `quadratic = \"0.02 kg/m\"`"),
    ("quadratic = \"D\"", "quadratic = \"-D\"", "E0530 \"-D\"", "must not be negative"),
    ("component = \"normal\"", "component = \"across\"", "E0518 \"across\"", "write \"full\" or \"normal\""),
    (
        "at = \"rod.tip\"\n",
        "at = \"ball.cm\"\n",
        "E0542 \"normal\"",
        "`ball` has 0 rods: normal to which line?",
    ),
    ("at = \"rod.tip\"\n", "at = \"rod.tpi\"\n", "E0521 \"rod.tpi\"", "did you mean \"rod.tip\"?"),
    ("at = \"rod.tip\"\n", "at = \"tip\"\n", "E0521 \"tip\"", "there is no point \"tip\""),
    ("at = \"rod.tip\"\n", "at = \"rod.tip\"\non = \"rod\"\n", "E0519 on | at", "names the body already"),
    ("along = \"rod\"", "along = \"rod\"\nat = \"rod.cm\"", "E0519 along | at", "make them two sections"),
    ("along = \"rod\"", "along = \"ball\"", "E0542 \"ball\"", "`ball` has no straight line"),
    ("along = \"rod\"", "along = \"rob\"", "E0520 \"rob\"", "did you mean \"rod\"?"),
    (
        "on = \"ball\"\ndensity",
        "on = \"rod\"\ndensity",
        "E0542 \"rod\"",
        "neither one `ball` nor one `shell`",
    ),
    ("coefficient = 0.47", "coefficient = -1", "E0530 -1", "must not be negative"),
    ("coefficient = 0.47", "", "E0513 round", "add `coefficient = 0.47`"),
    (
        "coefficient = 0.47",
        "coefficient = 0.47\nquadratic = \"D\"",
        "E0519 quadratic",
        "does not go with `on`",
    ),
    ("along = \"rod\"", "along = \"rod\"\ndensity = 1", "E0519 density", "describe a ball: write `on"),
    ("[drag.line]", "[drag.apex]", "E0523 apex | apex", "the name of a drag and of an event"),
    ("factor = \"0.01 kg\"", "factor = \"0.01 kg/m\"", "E0404 0.01 kg/m", "`factor` is a mass (kg)"),
    ("factor = \"0.01 kg\"", "", "E0513 up", "does not say how strong it is"),
    ("factor = \"0.01 kg\"", "slope = 1", "E0513 slope", "only one of `density` and `slope`"),
    ("factor = \"0.01 kg\"", "factor = \"0.01 kg\"\nslope = 1", "E0519 slope", "states its factor twice"),
];

const SPRINGS: &[Row] = &[
    (
        "[\"rod.tip\", \"ball.cm\"]",
        "[\"rod.tip\", \"rod.cm\"]",
        "E0519 [\"rod.tip\", \"rod.cm\"]",
        "one rigid body",
    ),
    ("[\"rod.tip\", \"ball.cm\"]", "[\"rod.tip\"]", "E0515 [\"rod.tip\"]", "[one end, the other end]"),
    ("[\"rod.tip\", \"ball.cm\"]", "[\"rod.tip\", [0, 0]]", "E0514 [0, 0]", "or { world = [..] }"),
    (
        "[\"rod.tip\", \"ball.cm\"]",
        "[\"rod.tip\", { wrld = [0, 0] }]",
        "E0513 { wrld = [0, 0] } && E0511 wrld",
        "did you mean `world`?",
    ),
    (
        "[\"rod.tip\", \"ball.cm\"]",
        "[{ world = [0, 0] }, { world = [0, 0] }]",
        "E0519 [{ world = [0, 0] }, { world = [0, 0] }]",
        "both ends belong to the world",
    ),
    ("[\"0.1 m*sin(t/T)\", \"-5 m\"]", "[\"ball.x\", 0]", "E0525 ball.x", "use the time `t`"),
    ("stiffness = \"10 N/m\"", "stiffness = \"10 N\"", "E0404 10 N", "`stiffness` is a stiffness"),
    ("stiffness = \"10 N/m\"", "stiffness = \"-1 N/m\"", "E0530 \"-1 N/m\"", "stiffness of `band` is -1 N/m"),
    ("rest_length = \"1 m\"\n", "", "E0513 band", "without a length of its own `rest_length = 0`"),
    ("damping = \"0.1 kg/s\"", "", "E0513 oil", "add `damping = \"0.5 kg/s\"`"),
    ("damping = \"0.1 kg/s\"", "damping = \"0.1 kg\"", "E0404 0.1 kg", "`damping` is a damping"),
    ("rest_angle = 0\n", "rest_angle = \"1\"\n", "E0204 1", "does not state its unit"),
    ("rest_angle = 0\n", "", "E0513 wire", "`rest_angle = 0`"),
    ("[\"0.1 m*sin(t/(0.1 s))\", 0]", "[\"rod.x\", 0]", "E0525 rod.x", "given before the run starts"),
];

const EVENTS: &[Row] = &[
    (
        "\"ball.vy falls through 0 m/s\"",
        "\"ball.vy > 0\"",
        "E0529 \"ball.vy > 0\"",
        "write `when = \"rod.vy falls",
    ),
    ("\"ball.vy falls through 0 m/s\"", "\"ball.vy falls through 0 m\"", "E0404 0 m", "expected a speed"),
    (
        "\"ball.vy falls through 0 m/s\"",
        "\"ball.vz falls through 0 m/s\"",
        "E0301 ball.vz",
        "did you mean `ball.v",
    ),
    ("\"ball.vy falls through 0 m/s\"", "\" falls through 0 m/s\"", "E0101  ", "no formula"),
    ("through 45 deg\"", "through 45\"", "E0204 45", "does not state its unit"),
    ("when = \"rod.angle passes through 45 deg\"", "", "E0513 level", "add `when = "),
    ("{ set = { D = \"2*D\" } }", "\"halt\"", "E0518 \"halt\"", "write \"record\" or \"stop\""),
    ("{ set = { D = \"2*D\" } }", "3", "E0514 3", "\"record\", \"stop\" or { set = { .. } }"),
    ("{ D = \"2*D\" }", "{ DD = \"2*D\" }", "E0540 DD", "did you mean \"D\"?"),
    ("{ D = \"2*D\" }", "{ D = \"2*c\" }", "E0404 2*c", "expected a mass per length"),
    ("{ D = \"2*D\" }", "{ D = \"D*t/T\" }", "E0525 t", "fixed before the run starts"),
    ("[\"apex\", \"4 s\"]", "[\"apx\", \"4 s\"]", "E0301 apx", "unknown name"),
    ("[\"apex\", \"4 s\"]", "[\"apex + 1 s\", \"4 s\"]", "E0528 apex", "an event stands alone"),
    ("at = \"apex\"\n", "at = \"apex[0]\"\n", "E0530 apex[0]", "events are counted from 1"),
    ("[event.level]", "[event.ball]", "E0523 ball | ball", "the name of an event and of a body"),
];

const TABLES: &[Row] = &[
    ("\"gust.csv\"", "\"/etc/gust.csv\"", "E0550 \"/etc/gust.csv\"", "leads out of the scene's folder"),
    ("\"gust.csv\"", "\"../gust.csv\"", "E0550 \"../gust.csv\"", "put the file beside the scene"),
    ("\"gust.csv\"", "\"none.csv\"", "E0551 \"none.csv\"", "there is no such file"),
    ("\"gust.csv\"", "3", "E0514 3", "a text in quotes"),
    ("\"gust.csv\"", "\"latin.csv\"", "E0503 \"latin.csv\"", "see its line 2"),
    ("\"gust.csv\"", "\"semicolons.csv\"", "E0552 \"semicolons.csv\"", "separated by commas"),
    ("\"gust.csv\"", "\"uneven.csv\"", "E0552 \"uneven.csv\"", "has 1 cells in line 3, and 2 in its header"),
    ("\"w [km/h]\"", "\"w [km]\"", "E0553 \"w [km]\"", "did you mean \"w [km/h]\"?"),
    ("\"w [km/h]\"", "\"n\"", "E0554 \"n\"", "`n [1]` for a pure number"),
    ("[\"t [ms]\", \"w [km/h]\"]", "[\"t [ms]\"]", "E0515 [\"t [ms]\"]", "[variable, value]"),
    (
        "\"gust.csv\"\ncolumns = [\"t [ms]\", \"w [km/h]\"]",
        "\"units.csv\"\ncolumns = [\"t [sek]\", \"w [m / s]\"]",
        "E0554 \"t [sek]\" && E0554 \"w [m / s]\"",
        "without spaces",
    ),
    (
        "\"gust.csv\"\ncolumns = [\"t [ms]\", \"w [km/h]\"]",
        "\"words.csv\"\ncolumns = [\"t [s]\", \"w [m/s]\"]",
        "E0555 fast",
        "line 3: `fast` in the column \"w [m/s]\"",
    ),
    (
        "\"gust.csv\"\ncolumns = [\"t [ms]\", \"w [km/h]\"]",
        "\"infinite.csv\"\ncolumns = [\"t [s]\", \"w [m/s]\"]",
        "E0555 inf",
        "not a finite number",
    ),
    (
        "\"gust.csv\"\ncolumns = [\"t [ms]\", \"w [km/h]\"]",
        "\"order.csv\"\ncolumns = [\"t [s]\", \"w [m/s]\"]",
        "E0555 1",
        "does not increase in line 4",
    ),
    (
        "\"gust.csv\"\ncolumns = [\"t [ms]\", \"w [km/h]\"]",
        "\"short.csv\"\ncolumns = [\"t [s]\", \"w [m/s]\"]",
        "E0552",
        "two rows or more",
    ),
    ("interpolation = \"linear\"\n", "", "E0513 gust", "add `interpolation = \"linear\"`"),
    (
        "interpolation = \"linear\"\n",
        "interpolation = \"spline\"\n",
        "E0518 \"spline\"",
        "\"linear\" or \"cubic\"",
    ),
    ("outside = \"hold\"\n", "", "E0513 gust", "add `outside = \"hold\"`"),
];

const SWEEPS: &[Row] = &[
    ("T = [\"1 s\", \"2 s\"]", "TT = [\"1 s\", \"2 s\"]", "E0540 TT", "did you mean \"T\"?"),
    ("T = [\"1 s\", \"2 s\"]", "T = [\"1 s\", \"2 m\"]", "E0404 2 m", "expected a time (s)"),
    ("T = [\"1 s\", \"2 s\"]", "T = [1, 2]", "E0516 1 && E0516 2", "write \"1 s\""),
    ("T = [\"1 s\", \"2 s\"]", "T = []", "E0515 []", "has no value"),
    ("T = [\"1 s\", \"2 s\"]", "T = \"1 s\"", "E0514 \"1 s\"", "a list of values, or { from"),
    (
        "T = [\"1 s\", \"2 s\"]",
        "T = [{ value = \"1 s\" }]",
        "E0513 { value = \"1 s\" }",
        "`label` is missing",
    ),
    (
        "T = [\"1 s\", \"2 s\"]",
        "T = [\"tilt*1 s\"]",
        "E0541 [\"tilt*1 s\"]",
        "depends on `tilt`, which is swept",
    ),
    (
        "T = [\"1 s\", \"2 s\"]",
        "T = [\"1 s\"]\nM = [\"1 kg\", \"0 kg\"]",
        "E0530 \"M\" && E0530 \"M\"",
        "in the run `M = 0 kg`: mass",
    ),
    ("count = 4", "count = 1", "E0532 1", "from 2 to 10000 values"),
    ("count = 4", "count = \"4\"", "E0514 \"4\"", "a whole number without quotes"),
    ("count = 4", "count = 6000", "E0532 sweep", "this sweep has 12000 runs, more than 10000"),
    (
        "count = 4",
        "count = 4, spacing = \"log\"",
        "E0530 { from = \"0 deg\", to = \"30 deg\", count = 4, spacing = \"log\" }",
        "touches or crosses zero",
    ),
    ("from = \"0 deg\", ", "", "E0513 { to = \"30 deg\", count = 4 }", "`from` is missing"),
    ("to = \"30 deg\"", "to = \"30\"", "E0204 30", "does not state its unit"),
];

#[test]
fn the_scene_without_mistakes() {
    let study = read_in("scene.toml", SCENE, &[], &Beside)
        .unwrap_or_else(|mistakes| panic!("{}", mistakes.render(false, 100)));
    let labels: Vec<_> = study.sweep[1].values.iter().map(|value| value.label).collect();
    assert_eq!(labels, ["tilt = 0 deg", "tilt = 10 deg", "tilt = 20 deg", "tilt = 30 deg"]);
    assert_eq!((study.model.interactions.len(), study.model.events.len()), (7, 2));
}

#[test]
fn mistakes_of_air() {
    table(SCENE, AIR);
}

#[test]
fn mistakes_of_springs() {
    table(SCENE, SPRINGS);
}

#[test]
fn mistakes_of_events() {
    table(SCENE, EVENTS);
}

#[test]
fn mistakes_of_tables() {
    table(SCENE, TABLES);
}

#[test]
fn mistakes_of_sweeps() {
    table(SCENE, SWEEPS);
}
