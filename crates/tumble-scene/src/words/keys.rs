//! Keys that are called otherwise here.

use super::Row;

/// By section, or by the key of an inline table.
pub(super) const KEYS: &[(&str, &[Row])] = &[
    (
        "body",
        &[
            (&["weight", "m", "density"], "write `mass = \"1 kg\"`"),
            (
                &["position", "po", "pos", "at", "x", "y", "place", "origin", "location"],
                "write `start = { at = [0, \"2 m\"] }`, the place of the centre of mass",
            ),
            (&["velocity", "speed", "v", "vx", "vy"], "write `start = { velocity = [\"1 m/s\", 0] }`"),
            (&["angle", "rotation", "orientation", "theta"], "write `start = { angle = \"30 deg\" }`"),
            (&["omega", "spin", "angular_velocity", "rate"], "write `start = { omega = \"2 rad/s\" }`"),
            (&["initial", "init", "initial_condition"], "write `start = { at = [..], velocity = [..] }`"),
            (
                &["moment", "moment_of_inertia", "i", "j"],
                "it is computed; with `centre` it may be stated as `inertia`",
            ),
            (
                &[
                    "shape", "type", "kind", "geometry", "form", "radius", "length", "width", "height",
                    "size", "corner",
                ],
                "the shape is a key with its sizes: `disk = { radius = \"10 cm\" }`",
            ),
            (
                &["bounce", "bounciness", "elasticity", "e"],
                "write `restitution = 0.8`, of impacts on rigid surfaces",
            ),
            (
                &["mu", "friction_coefficient", "roughness", "static_friction", "kinetic_friction"],
                "write `friction = 0.3`, or `friction = { static = 0.4, kinetic = 0.3 }`",
            ),
            (
                &["fixed", "static", "immovable", "ground"],
                "what never moves is no body: use a `[surface.NAME]`",
            ),
            (&["color", "colour", "style", "fill"], "figures choose their colours"),
        ],
    ),
    (
        "start",
        &[
            (
                &["position", "po", "pos", "x", "y", "place", "location"],
                "write `at = [0, \"2 m\"]`, the place of the centre of mass",
            ),
            (&["speed", "v", "vx", "vy"], "write `velocity = [\"1 m/s\", 0]`"),
            (&["theta", "phi", "rotation", "orientation"], "write `angle = \"30 deg\"`"),
            (&["spin", "w", "rate", "angular_velocity", "angular_speed"], "write `omega = \"2 rad/s\"`"),
        ],
    ),
    (
        "run",
        &[
            (
                &["time", "duration", "end", "stop", "t", "t_end", "tmax", "t_max", "end_time", "length"],
                "write `until = \"10 s\"`",
            ),
            (
                &["dt", "step", "timestep", "time_step", "h", "method", "solver", "integrator"],
                "steps are chosen by the program; `accuracy = 1e-9` is what to ask for, and `every` in `[output]` is the \
                 distance of lines in the tables",
            ),
            (&["tolerance", "tol", "rtol", "atol", "precision", "error"], "write `accuracy = 1e-9`"),
        ],
    ),
    (
        "world",
        &[
            (&["g", "gravitation", "gravitational_acceleration"], "write `gravity = \"9.81 m/s^2\"`"),
            (&["air", "density", "drag", "air_resistance"], "resistance of the air is a `[drag.NAME]`"),
        ],
    ),
    (
        "surface",
        &[
            (
                &["point", "at", "position", "origin", "y", "x", "height", "level"],
                "write `through = [0, 0]`, a point of it",
            ),
            (&["angle", "incline", "inclination", "tilt"], "write `slope = \"30 deg\"`"),
            (&["restitution", "bounce", "e", "elasticity"], "write `rigid = { restitution = 0.8 }`"),
            (&["stiffness", "k", "damping"], "write `spring = { stiffness = \"1e4 N/m\", damping = 0 }`"),
            (&["body", "bodie", "for"], "write `on = \"rod\"`, the bodies that it meets"),
            (
                &["bowl", "round", "radius", "arc"],
                "write `circle = { centre = [0, 0], radius = \"1 m\", inside = true }`",
            ),
            (
                &["corners", "points", "box", "step", "rail"],
                "write `polygon = [[0, 0], [\"1 m\", 0], [\"1 m\", \"0.5 m\"]]`, corners counter-clockwise",
            ),
        ],
    ),
    (
        "contact",
        &[
            (
                &["bodie", "body", "on", "of", "pair", "with"],
                "write `between = [\"red\", \"white\"]`, or `between = \"all\"`",
            ),
            (
                &["restitution", "bounce", "e", "friction", "mu", "law"],
                "write `rigid = { restitution = 0.9, friction = 0.2 }`",
            ),
        ],
    ),
    ("circle", &[(&["center", "at", "through", "position"], "write `centre = [0, 0]`")]),
    (
        "rigid",
        &[
            (&["e", "bounce", "coefficient"], "write `restitution = 0.8`"),
            (&["rolling_resistance", "rolling_friction"], "write `rolling = \"1 mm\"`, a length"),
            (
                &[
                    "mu",
                    "static_friction",
                    "kinetic_friction",
                    "static",
                    "kinetic",
                    "coulomb",
                    "rough",
                    "grip",
                ],
                "write `friction = 0.3`, or `friction = { static = 0.4, kinetic = 0.3 }`",
            ),
        ],
    ),
    (
        "friction",
        &[
            (&["mu_s", "rest", "sticking", "stick"], "write `static = 0.4`"),
            (&["mu_k", "mu", "sliding", "dynamic", "slip"], "write `kinetic = 0.3`"),
        ],
    ),
    ("spring", SPRING),
    ("damper", SPRING),
    (
        "torsion",
        &[
            (&["body", "between"], "write `on = \"rod\"`"),
            (&["k", "constant", "spring_constant"], "write `stiffness = \"1 N*m/rad\"`"),
            (&["angle", "rest", "rest_length"], "write `rest_angle = 0`"),
        ],
    ),
    (
        "drag",
        &[
            (&["cd", "c", "c_d", "drag_coefficient"], "write `coefficient = 0.47`, with `on` and `density`"),
            (&["rho", "air_density"], "write `density = \"1.2 kg/m^3\"`, with `on` and `coefficient`"),
            (&["body"], "write `on` for a ball, `along` for rods and edges, or `at` for a point"),
        ],
    ),
    (
        "force",
        &[
            (&["body"], "write `on = \"rod\"`"),
            (&["point", "where", "position", "place"], "write `at = \"rod.tip\"`"),
            (&["value", "vector", "f", "fx", "fy", "x", "y", "component"], "write `force = [\"1 N\", 0]`"),
            (&["moment", "couple"], "write `torque = \"1 N*m\"`"),
            (&["from", "until", "start", "end", "when", "time"], "write `during = [\"1 s\", \"2 s\"]`"),
        ],
    ),
    ("pin", JOINT),
    ("weld", JOINT),
    (
        "pivot",
        &[(
            &["at", "place", "position", "anchor", "to"],
            "write `world = [0, 0]`, the place where the point is held",
        )],
    ),
    (
        "event",
        &[
            (&["condition", "trigger", "if", "at"], "write `when = \"rod.y falls through 0 m\"`"),
            (
                &["then", "do", "effect", "set", "stop"],
                "write `action = \"stop\"`, or `action = { set = { .. } }`",
            ),
        ],
    ),
    (
        "output",
        &[
            (&["dt", "step", "interval", "rate", "sampling"], "write `every = \"10 ms\"`"),
            (
                &["folder", "dir", "path", "out", "file"],
                "where results go is said on the command line: `--out FOLDER`",
            ),
        ],
    ),
    ("find", FIND),
    ("check", CHECK),
    (
        "plot",
        &[
            (&["curve", "quantity", "quantitie", "of", "that", "value"], "write `y = \"rod.angle\"`"),
            (&["time", "from", "range"], "write `during = [\"1 s\", \"2 s\"]`"),
        ],
    ),
];

const SPRING: &[Row] = &[
    (
        &["from", "to", "a", "b", "body", "bodie", "end", "on", "at", "point"],
        "write `between = [\"rod.tip\", { world = [0, 0] }]`",
    ),
    (&["k", "constant", "spring_constant", "rate"], "write `stiffness = \"100 N/m\"`"),
    (&["c", "damping_coefficient", "viscosity"], "write `damping = \"1 kg/s\"`"),
    (&["length", "l0", "l", "natural_length", "rest", "equilibrium_length"], "write `rest_length = \"1 m\"`"),
];

const JOINT: &[Row] = &[
    (
        &["body", "bodie", "a", "b", "to", "point", "end", "on", "at", "world"],
        "write `between = [\"upper.tip\", \"lower.top\"]`; an end in the world is `{ world = [0, 0] }`",
    ),
    (
        &["break", "release", "breaks_at", "when"],
        "write `until = \"EVENT\"`, the name of an event that releases it",
    ),
];

const THAT: Row = (&["quantity", "what", "value", "of", "formula", "y"], "write `that = \"rod.angle\"`");
const AT: Row = (&["time", "when", "t"], "write `at = \"1 s\"`, or the name of an event");

const FIND: &[Row] = &[
    THAT,
    AT,
    (&["equals", "expected", "within", "tolerance"], "what a value must be is a claim, `[check.NAME]`"),
];

const CHECK: &[Row] = &[
    THAT,
    AT,
    (&["expected", "equal", "expect", "be", "is", "target"], "write `equals = \"1 m\"`"),
    (&["tolerance", "tol", "error", "accuracy", "epsilon"], "write `within = \"1e-9 m\"`"),
];
