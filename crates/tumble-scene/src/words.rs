//! Words that people try, and what the language has for them: one table for sections, one for keys.

mod keys;

use keys::KEYS;

/// A row: words, and what to use in their place.
type Row = (&'static [&'static str], &'static str);

/// Help for those who have a third component.
pub(crate) const IN_SPACE: &str =
    "bodies move in a plane, x to the right and y upwards; there are no bodies in space yet";

/// What to use in the place of a section that there is not.
pub(crate) fn section(word: &str) -> Option<&'static str> {
    meaning(SECTIONS, word).or_else(|| meaning(MISSING, word))
}

/// What to use in the place of a key that a section, by the first word of its title, does not have.
pub(crate) fn key(title: &str, word: &str) -> Option<&'static str> {
    let kind = title.trim_matches(['[', ']']).split('.').next().unwrap_or_default();
    let own = KEYS.iter().filter(|(section, _)| *section == kind);
    own.into_iter().find_map(|(_, rows)| meaning(rows, word)).or_else(|| meaning(MISSING, word))
}

/// Upper and lower case, and how parts of a word are joined, make no difference.
fn meaning(rows: &[Row], word: &str) -> Option<&'static str> {
    let plain = word.to_lowercase().replace(['-', ' '], "_");
    let single = plain.strip_suffix('s').unwrap_or(&plain);
    let has = |words: &[&str]| words.contains(&plain.as_str()) || words.contains(&single);
    rows.iter().find(|(words, _)| has(words)).map(|(_, meaning)| *meaning)
}

/// Sections that are called otherwise here.
const SECTIONS: &[Row] = &[
    (
        &["joint", "hinge", "revolute", "axle", "axi", "bearing", "constraint", "connection", "link"],
        "`[pin.NAME]` lets two bodies turn about a common point, `[weld.NAME]` holds them together rigidly, and \
         `[pivot.NAME]` holds a point of one body at a place",
    ),
    (
        &["fixed", "fixture", "glue", "bond", "attach", "attachment", "clamp", "bolt", "nail", "screw"],
        "`[weld.NAME]` holds two bodies together rigidly, or a body at a place",
    ),
    (
        &["held", "hang", "hanger", "suspension", "support", "anchor", "nailed"],
        "`[pivot.NAME]` holds a point of a body at a place, and `[pin.NAME]` at a point of another body",
    ),
    (
        &["gravity", "g", "environment", "scene", "weight"],
        "gravity stands in the world: `[world]` with `gravity = \"9.81 m/s^2\"`",
    ),
    (
        &[
            "ball",
            "rod",
            "bar",
            "stick",
            "beam",
            "disk",
            "disc",
            "ring",
            "hoop",
            "shell",
            "sphere",
            "box",
            "block",
            "brick",
            "cube",
            "cylinder",
            "wheel",
            "plate",
            "polygon",
            "point",
            "object",
            "particle",
            "mass",
            "masse",
            "bodie",
            "rigid_body",
            "rigidbody",
            "pendulum",
            "shape",
            "part",
            "bob",
            "bead",
        ],
        "every body is a `[body.NAME]` with a shape in it: `point`, `rod`, `disk`, `ring`, `ball`, `shell`, `box` or \
         `polygon`",
    ),
    (
        &[
            "wall",
            "floor",
            "ground",
            "ceiling",
            "ramp",
            "slope",
            "incline",
            "inclined_plane",
            "table_top",
            "obstacle",
            "barrier",
            "impact",
            "restitution",
            "boundary",
            "terrain",
            "bounce",
        ],
        "a floor, a wall, a slope or a bowl is a `[surface.NAME]`; bodies meet each other by a `[contact.NAME]`",
    ),
    (
        &["air", "wind", "resistance", "air_resistance", "aerodynamic", "atmosphere", "fluid", "damping"],
        "`[drag.NAME]` resists the motion through the air, `[damper.NAME]` that of two points apart, and `wind` is a \
         key of `[world]`",
    ),
    (
        &["magnu", "magnus", "spin"],
        "`[lift.NAME]` is the lift on a spinning body; a spin is `start = { omega = \"..\" }`",
    ),
    (
        &["kick", "hit", "blow", "strike", "shot", "bat", "knock"],
        "`[impulse.NAME]` changes velocities at once, when an event happens; a force with `during` acts for a while",
    ),
    (
        &[
            "load", "push", "pull", "thrust", "action", "moment", "torque", "wrench", "buoyancy", "magnet",
            "charge", "tension",
        ],
        "`[force.NAME]` is a force or a torque of your own, by formula",
    ),
    (&["dashpot", "shock", "shock_absorber"], "`[damper.NAME]` resists the change of a distance"),
    (
        &["elastic", "elasticity", "bungee", "rubber", "rubber_band"],
        "`[spring.NAME]` pulls two points together",
    ),
    (
        &["torsion_spring", "torsional_spring", "spiral_spring"],
        "`[torsion.NAME]` turns a body back to an angle",
    ),
    (
        &[
            "constant",
            "const",
            "param",
            "params",
            "parameter",
            "variable",
            "var",
            "vars",
            "value",
            "define",
            "definition",
            "let",
        ],
        "`[parameters]` has named quantities: `L = \"1 m\"`",
    ),
    (
        &[
            "time",
            "duration",
            "simulation",
            "simulate",
            "sim",
            "solver",
            "solve",
            "integrator",
            "integration",
            "setting",
            "option",
            "config",
            "configuration",
            "end",
            "until",
        ],
        "`[run]` says how long and how accurately: `until = \"10 s\"`",
    ),
    (
        &["graph", "chart", "figure", "diagram", "curve", "draw"],
        "`[plot.NAME]` draws curves: `y = \"rod.angle\"`",
    ),
    (
        &["animation", "animate", "video", "movie", "gif", "film"],
        "no section is needed: `tumble animate SCENE` makes an animation of every scene",
    ),
    (
        &["picture", "snapshot", "strobe", "frame", "image"],
        "`[stroboscope.NAME]` shows bodies at equal steps of time",
    ),
    (&["freebody", "fbd", "free_body_diagram"], "`[free_body.NAME]` draws the forces on a body"),
    (&["energy", "energie", "work", "book", "power"], "`[balance.NAME]` draws energies and works"),
    (
        &["assert", "assertion", "test", "expect", "claim", "verify", "validate"],
        "`[check.NAME]` holds a claim against the motion",
    ),
    (
        &[
            "query",
            "measure",
            "measurement",
            "ask",
            "question",
            "result",
            "probe",
            "sensor",
            "observe",
            "max",
            "min",
            "bind",
        ],
        "`[find.NAME]` asks for a value: `that = \"rod.angle\"`, `at = \"1 s\"`",
    ),
    (
        &["trigger", "when", "condition", "stop", "if", "on", "switch", "callback"],
        "`[event.NAME]` is what happens each time a formula passes a value: `when = \"rod.y falls through 0 m\"`",
    ),
    (
        &["def", "func", "fn", "formula", "expression", "macro"],
        "`[functions]` has formulas with arguments: `\"w(t)\" = \"..\"`",
    ),
    (
        &["csv", "data", "file", "dataset", "interpolation", "lookup"],
        "`[table.NAME]` is a function that was measured, from a CSV file",
    ),
    (
        &["initial", "init", "start", "initial_condition", "initial_state", "state", "velocity", "position"],
        "what a body starts from stands with it: `start = { at = [..], velocity = [..] }` in `[body.NAME]`",
    ),
    (
        &[
            "static",
            "statics",
            "rest_pose",
            "stability",
            "eigenvalue",
            "mode",
            "frequencie",
            "frequency",
            "linearise",
        ],
        "`[equilibrium]` finds the pose near the start in which nothing accelerates, and whether it is stable",
    ),
    (
        &["scan", "study", "parameter_study", "batch", "case", "variation", "range"],
        "`[sweep]` gives parameters several values, one run each",
    ),
    (&["unit"], "a unit stands beside its number: `\"9.81 m/s^2\"`"),
    (&["label", "notation", "greek"], "`[symbols]` says how names are written: `\"rod.angle\" = \"theta\"`"),
    (
        &["export", "save", "sampling", "samples", "table_output"],
        "`[output]` says how dense the tables are: `every = \"10 ms\"`",
    ),
];

/// What is not there yet, wherever it is asked for, with what can be done in its place.
const MISSING: &[Row] = &[
    (
        &[
            "friction",
            "mu",
            "static_friction",
            "kinetic_friction",
            "coulomb",
            "sliding",
            "grip",
            "stick_slip",
            "rough",
            "roughness",
        ],
        "surfaces have friction: `rigid = { restitution = 0.5, friction = 0.3 }` in `[surface.NAME]`, and so in `spring` and `hertz`; \
         joints and pivots have none yet",
    ),
    (
        &["rolling", "roll", "tyre", "tire"],
        "what is round rolls where friction holds it: `rigid = { restitution = 0.5, friction = 0.3 }` in `[surface.NAME]`",
    ),
    (
        &["rolling_friction", "rolling_resistance"],
        "rigid surfaces may resist rolling: `rigid = { restitution = 0.5, friction = 0.3, rolling = \"1 mm\" }` in `[surface.NAME]`",
    ),
    (
        &["rope", "string", "cable", "chain", "cord", "thread", "wire", "line", "tether"],
        "there are no ropes yet; a stiff `[spring.NAME]` also pushes, a light rod between two pins keeps a distance, and \
         rods joined by pins are a chain",
    ),
    (
        &["motor", "engine", "drive", "actuator", "servo", "controller"],
        "there are no motors yet; a `torque` by formula in `[force.NAME]` turns a body",
    ),
    (
        &["gear", "pulley", "belt", "rack", "winch", "transmission", "crank"],
        "there are no gears, belts or pulleys yet; torques of your own in `[force.NAME]` may act on both bodies",
    ),
    (
        &["slider", "rail", "slot", "prismatic", "guide", "track", "groove", "linear_joint", "cam", "path"],
        "there are no rails or slots yet; a force of your own may hold a point on a line: `force = [0, \"-(1e4 N/m)*cart.y\"]`",
    ),
    (
        &["collision", "collide", "collision_pair", "body_contact", "billiard", "collider"],
        "bodies meet by a `[contact.NAME]`: `between = [\"red\", \"white\"]` or `between = \"all\"`, and `rigid = { restitution = 0.9 }`",
    ),
    (
        &["z", "space", "3d", "three_dimension", "dimension", "quaternion", "rotation_axi", "vz", "depth"],
        IN_SPACE,
    ),
    (
        &["soft", "flexible", "deformable", "cloth", "young", "youngs_modulus"],
        "all bodies are rigid; several of them joined by pins and `[torsion.NAME]` bend",
    ),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_have_one_meaning_and_are_no_sections() {
        let mut seen = std::collections::BTreeSet::new();
        for word in SECTIONS.iter().chain(MISSING).flat_map(|(words, _)| *words) {
            assert!(seen.insert(*word), "{word} twice");
            assert!(crate::keys::of_scene().all(|known| known.name != *word), "{word} is a section");
        }
        for (section, rows) in KEYS {
            let words = rows.iter().flat_map(|(words, _)| *words);
            let mut seen = std::collections::BTreeSet::new();
            words.for_each(|word| assert!(seen.insert(*word), "{word} twice in {section}"));
        }
    }

    #[test]
    fn case_joints_and_plurals_make_no_difference() {
        assert_eq!(section("Joints"), section("joint"));
        assert_eq!(section("Air-Resistance"), section("air_resistance"));
        assert!(section("rope").is_some_and(|help| help.contains("no ropes yet")));
        assert_eq!(key("[run]", "dt"), key("[run]", "step"));
        assert!(key("[surface.floor]", "friction").is_some_and(|help| help.contains("friction = 0.3")));
        assert_eq!(key("start", "quux"), None);
    }
}
