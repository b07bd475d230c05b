//! More mistakes, of what people write in haste.

use crate::rows::Row;

pub(crate) const NUMBERS: &[Row] = &[
    ("mass = \"m\"\npoints", "mass = \"1,5 kg\"\npoints", "E0107 1,5", "write `1.5`"),
    ("mass = \"m\"\npoints", "mass = \"1.5.2 kg\"\npoints", "E0105 1.5.2", "two decimal points"),
    ("mass = \"m\"\npoints", "mass = \"1e kg\"\npoints", "E0105 1e", "write `1e3`"),
    ("mass = \"m\"\npoints", "mass = \"1e400 kg\"\npoints", "E0106 1e400", "the limit is about 1.8e308"),
    ("mass = \"m\"\npoints", "mass = 1.5.2\npoints", "E0501 .2", "quantities and formulas stand in quotes"),
    ("mass = \"m\"\npoints", "mass = \"-1 kg\"\npoints", "E0530 \"-1 kg\"", "must be positive"),
    ("mass = \"m\"\npoints", "mass = \"1 kg/0\"\npoints", "E0408 1 kg | 0", "divides by zero"),
    ("mass = \"m\"\npoints", "mass = \"1 kgs\"\npoints", "E0201 kgs", "did you mean `kg`?"),
    ("mass = \"m\"\npoints", "mass = \"1 кg\"\npoints", "E0201 кg", "no Latin letter"),
    ("half = \"L/2\"", "half = \"L·2\"", "E0104 ·", "write `*`"),
    ("half = \"L/2\"", "half = \"L/2)\"", "E0108 )", ""),
    ("half = \"L/2\"", "half = \"sqrt(L, L)\"", "E0303 sqrt(L, L)", ""),
    ("half = \"L/2\"", "half = \"max()\"", "E0303 max()", ""),
    (
        "half = \"L/2\"",
        "half = \"1e300*L*1e300\"",
        "E0517 \"1e300*L*1e300\"",
        "parameter `half` is inf: it must be a finite number",
    ),
    (
        "half = \"L/2\"",
        "half = \"L*sin(2e15)\"",
        "E0530 \"L*sin(2e15)\"",
        "at most 1e15 rad are possible here",
    ),
    ("\"w(t)\" = \"2", "\"w(t)\" = \"w(t)*2", "E0304 w(t) | w(t)", "calls itself"),
];

pub(crate) const MOTIONS: &[Row] = &[
    (
        "to = [0, \"-L\"] }",
        "to = [0, \"-L\"], end_radius = \"-1 mm\" }",
        "E0530 \"-1 mm\"",
        "end radius of `rod` is -0.001 m: it must not be negative",
    ),
    ("rod = { from = [0, 0], to = [0, \"-L\"] }", "point = {}", "E0544 hinge", "nothing says how it turns"),
    (
        "[output]",
        "[surface.floor]\nthrough = [0, \"-9 m\"]\nnormal = [0, 0]\nrigid = { restitution = 1 }\n[output]",
        "E0543 [0, 0]",
        "a vector of any length but zero",
    ),
    (
        "[output]",
        "[event.e]\nwhen = \"rod.x rises through 1 m\"\naction = { set = { T = \"-T\" } }\n\
         [damper.oil]\nbetween = [\"rod.tip\", \"ball.cm\"]\ndamping = \"m/T\"\n[output]",
        "E0530 { T = \"-T\" } | \"m/T\"",
        "after the event `e`: damping of `oil` is -0.5 kg/s: it must not be negative",
    ),
    ("angle = \"10 deg\"", "angle = \"1e300 rad\"", "E0530 start", "points nowhere"),
    (
        "start = { angle = \"10 deg\", omega = 0 }",
        "start = { at = [0, \"1 m\"] }",
        "E0537 start",
        "its pivot says where it is",
    ),
    ("during = [0, \"T\"]", "during = [0, \"T\"]\nmass = \"1 kg\"", "E0511 mass", "the keys are"),
    (
        "[output]",
        "[event.w]\nwhen = \"rod.x rises\"\n[output]",
        "E0523 w | w && E0529 \"rod.x rises\"",
        "how it passes",
    ),
    (
        "[output]",
        "[event.e]\nwhen = \"rod.x rises through 1 s\"\n[output]",
        "E0404 1 s",
        "expected a length (m), found a time (s)",
    ),
    (
        "[output]",
        "[surface.floor]\nthrough = [0, 0]\nrigid = { restitution = 1.5 }\n[output]",
        "E0530 1.5",
        "from 0 to 1",
    ),
    (
        "[output]",
        "[surface.floor]\nthrough = [0, \"1 m\"]\nrigid = { restitution = 1 }\non = \"ball\"\n[output]",
        "E0539 start",
        "farther out",
    ),
    (
        "[output]",
        "[spring.s]\nbetween = [\"rod.tip\", \"rod.cm\"]\nstiffness = \"1 N/m\"\nrest_length = 0\n[output]",
        "E0519 [\"rod.tip\", \"rod.cm\"]",
        "one rigid body",
    ),
    (
        "ball = { radius = \"0.1 m\" }",
        "ball = { radius = \"0.1 m\" }\ncentre = [0, 0]\ninertia = \"-1 kg*m^2\"",
        "E0530 \"-1 kg*m^2\"",
        "",
    ),
];

pub(crate) const SWEEPS: &[Row] = &[
    (
        "[output]",
        "[sweep]\nT = [\"1 s\", \"1 s\"]\n[output]",
        "E0523 \"1 s\" | \"1 s\"",
        "take each value once",
    ),
    (
        "[output]",
        "[sweep]\nT = [{ value = \"1 s\", label = \"a\" }, { value = \"2 s\", label = \"a\" }]\n[output]",
        "E0523 { value = \"2 s\", label = \"a\" } | { value = \"1 s\", label = \"a\" }",
        "are called \"a\"",
    ),
    (
        "[output]",
        "[sweep]\nT = { from = \"1 s\", to = \"2 s\", count = 1000000 }\n[output]",
        "E0532 1000000",
        "from 2 to 10000 values",
    ),
    (
        "[output]",
        "[sweep]\nT = { from = \"1 s\", to = \"2 s\", count = 1000 }\nm = { from = \"1 kg\", to = \"2 kg\", count = 1000 }\n[output]",
        "E0532 sweep",
        "1000000 runs",
    ),
    ("[output]", "[sweep]\nTT = [\"1 s\"]\n[output]", "E0540 TT", "did you mean \"T\"?"),
    ("[output]", "[sweep]\naccuracy = [1e-6, 1]\n[output]", "E0534 1", "between 1e-14 and 1e-3"),
    (
        "[output]",
        "[sweep]\naccuracy = { from = 1e-16, to = 1e-6, count = 3, spacing = \"log\" }\n[output]",
        "E0534 { from = 1e-16, to = 1e-6, count = 3, spacing = \"log\" }",
        "out of range",
    ),
    ("[output]", "[sweep]\naccuracy = [\"1e-6 m\"]\n[output]", "E0404 1e-6 m", "a pure number"),
    ("[output]", "[sweep]\nT = []\n[output]", "E0515 []", "no value"),
];

pub(crate) const FIGURES: &[Row] = &[
    ("every = \"10 ms\"", "every = \"5 ns\"", "E0532 \"5 ns\"", "about 1e9 samples"),
    ("every = \"10 ms\"", "every = \"6 s\"", "E0533 \"6 s\"", "longer than the run"),
    ("within = \"10 rad\"", "within = \"10 rad\"\nat = \"-1 s\"", "E0533 \"-1 s\"", "outside of the run"),
    ("[plot.angle]", "[plot.\"../angle\"]", "E0522 \"../angle\"", "is not a name"),
    ("[stroboscope.all]", "[stroboscope.angle]", "E0523 angle | angle", "figures become files"),
    (
        "[stroboscope.all]",
        "[stroboscope.Angle]",
        "E0523 Angle | angle",
        "the figures `angle` and `Angle` are one file on some systems",
    ),
    ("[plot.angle]", "[plot.-rf]", "E0556 -rf", "begins with a hyphen"),
    ("[plot.angle]", "[plot.Aux]", "E0556 Aux", "some systems keep it"),
    ("[plot.angle]", "[plot.com1]", "E0556 com1", "give the figure another name"),
    (
        "[plot.angle]",
        "[plot.an_angle_which_is_shown_in_a_figure_whose_name_has_been_made_so_long_that_it_is_no_name_but_a_sentence]",
        "E0556 an_angle_which_is_shown_in_a_figure_whose_name_has_been_made_so_long_that_it_is_no_name_but_a_sentence",
        "it has more than 100 letters",
    ),
    (
        "y = \"rod.angle\"",
        "y = \"rod.angle\"\ntitle = \"a\\u001b[2Jb\"",
        "E0507 \"a\\u001b[2Jb\"",
        "the character U+001B",
    ),
    ("y = \"rod.angle\"", "y = \"rod.angle\"\ntitle = \"a\\nb\"", "E0507 \"a\\nb\"", "write it in one line"),
    (
        "\"rod.angle\" = \"theta\"",
        "\"rod.angle\" = \"\\u202eatteht\"",
        "E0507 \"\\u202eatteht\"",
        "which is not shown",
    ),
    ("y = \"rod.angle\"", "y = \"rod.angle in degrees\"", "E0518 degrees", "a unit alone"),
    ("y = \"rod.angle\"", "y = \"rod.angle in m\"", "E0204 m", "angle"),
    ("y = \"rod.angle\"", "y = \"rod.x in kg\"", "E0404 kg", "a length (m)"),
    ("y = \"rod.angle\"", "y = \"rod.x in m + m\"", "E0518 m + m", "a unit alone"),
    (
        "y = \"rod.angle\"",
        "y = [\"rod.x in cm\", \"rod.y\"]",
        "E0527 \"rod.y\" | \"rod.x in cm\"",
        "write the same `in UNIT` behind each formula",
    ),
    (
        "that = \"rod.angle\"\nequals = \"0 rad\"",
        "that = \"rod.angle in deg\"\nequals = 30",
        "E0516 30",
        "which unit",
    ),
    ("that = \"rod.angle\"", "side = \"left\"\nthat = \"rod.angle\"", "E0518 \"left\"", "\"before\""),
    (
        "[symbols]",
        "[find.a]\nat = \"its least\"\nside = \"before\"\nthat = \"rod.x\"\n[symbols]",
        "E0519 side",
        "leave `side` out",
    ),
    (
        "[symbols]",
        "[find.a]\nequals = \"1 m\"\nthat = \"rod.x\"\n[symbols]",
        "E0511 equals",
        "a claim, `[check.NAME]`",
    ),
    ("[symbols]", "[find.a]\n[symbols]", "E0513 a", "add `that"),
    (
        "y = \"rod.angle\"",
        "y = \"rod.angle\"\nduring = [\"2 s\", \"1 s\"]",
        "E0531 [\"2 s\", \"1 s\"]",
        "there is nothing from",
    ),
    (
        "y = \"rod.angle\"",
        "y = \"rod.angle\"\nduring = [\"6 s\", \"7 s\"]",
        "E0533 [\"6 s\", \"7 s\"]",
        "outside of the run",
    ),
    (
        "y = \"rod.angle\"",
        "y = \"rod.angle\"\nduring = [0, \"flor.contact[1].end\"]\n[surface.floor]\nthrough = [0, \"-9 m\"]\nrigid = { restitution = 1 }\n[plot.other]\ny = \"rod.x\"",
        "E0521 flor.contact[1].end",
        "did you mean \"floor\"?",
    ),
    (
        "within = \"10 rad\"",
        "within = \"10 rad\"\nat = \"apx\"\n[event.apex]\nwhen = \"rod.vx rises through 0 m/s\"",
        "E0301 apx",
        "did you mean the event \"apex\"?",
    ),
];

pub(crate) const FILES: &[Row] = &[
    (
        "[output]",
        "[table.g]\nfile = \"../gust.csv\"\ncolumns = [\"t\", \"w\"]\ninterpolation = \"linear\"\noutside = \"hold\"\n[output]",
        "E0550 \"../gust.csv\"",
        "beside the scene",
    ),
    (
        "[output]",
        "[table.g]\nfile = \"/etc/passwd\"\ncolumns = [\"t\", \"w\"]\ninterpolation = \"linear\"\noutside = \"hold\"\n[output]",
        "E0550 \"/etc/passwd\"",
        "leads out of the scene's folder",
    ),
    (
        "[output]",
        "[table.g]\nfile = \"none.csv\"\ncolumns = [\"t\", \"w\"]\ninterpolation = \"linear\"\noutside = \"hold\"\n[output]",
        "E0551 \"none.csv\"",
        "cannot be read",
    ),
];
