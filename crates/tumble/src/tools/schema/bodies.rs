//! Bodies, their shapes, and what holds or stops them.

use serde_json::{Value, json};

use super::parts::{Key, choice, closed, each, may, must, named, open};

/// `[surface.NAME]`, `[contact.NAME]`, `[body.NAME]`, `[pivot.NAME]`, `[pin.NAME]` and `[weld.NAME]`.
pub(super) fn sections() -> Vec<Key> {
    vec![
        may(
            "surface",
            each(surface()),
            "Floors, walls, slopes and bowls, and what they do to what touches them.",
        ),
        may("contact", each(contact()), "Bodies that meet each other."),
        must("body", each(body()), "Bodies: a shape with its mass, parts, or stated mass properties."),
        may("pivot", each(pivot()), "Points of bodies that are held at a place in the world."),
        may("pin", each(joint("[pin.NAME]")), "Joints about which bodies turn, without friction."),
        may("weld", each(joint("[weld.NAME]")), "Joints that leave nothing free."),
    ]
}

fn body() -> Value {
    let own = [
        may("mass", named("quantity"), "Spread evenly over the shape."),
        may(
            "parts",
            json!({ "type": "array", "minItems": 1, "items": part() }),
            "Shapes with their masses, joined rigidly.",
        ),
        may("centre", named("vector"), "Centre of mass, stated instead of computed; with `inertia`."),
        may("inertia", named("quantity"), "Moment of inertia about the centre of mass; with `centre`."),
        may(
            "restitution",
            named("formula"),
            "How much of its speed an impact leaves, where it is not the surface's.",
        ),
        may("points", open(named("vector")), "Named points `[x, y]` in body coordinates."),
        may("start", start(), "What it starts from; as drawn and at rest without it."),
    ];
    let keys: Vec<_> = shapes().into_iter().chain(own).collect();
    let mut body = closed("[body.NAME]", &keys);
    body["anyOf"] = json!([{ "required": ["mass"] }, { "required": ["parts"] }]);
    body
}

fn part() -> Value {
    let mass = must("mass", named("quantity"), "Spread evenly over the shape.");
    closed("part of a body", &shapes().into_iter().chain([mass]).collect::<Vec<_>>())
}

fn start() -> Value {
    closed(
        "start",
        &[
            may("at", named("vector"), "Place of the centre of mass."),
            may("velocity", named("vector"), "Velocity of the centre of mass."),
            may("angle", named("quantity"), "Counter-clockwise: \"30 deg\"."),
            may("omega", named("quantity"), "Angular velocity: \"2 rad/s\", \"30 rpm\"."),
        ],
    )
}

fn shapes() -> Vec<Key> {
    let origin = |key| may(key, named("vector"), "The origin of the body's coordinates without it.");
    let length = |key| must(key, named("quantity"), "A length.");
    let round = |name| closed(name, &[length("radius"), origin("centre")]);
    let corners = json!({ "type": "array", "minItems": 3, "items": named("vector") });
    let rod = closed(
        "rod",
        &[
            must("from", named("vector"), "One end."),
            must("to", named("vector"), "The other end."),
            may("end_radius", named("quantity"), "Of its rounded ends; 0 without it."),
        ],
    );
    let rectangle = closed("box", &[length("width"), length("height"), origin("centre")]);
    vec![
        may("point", closed("point", &[origin("at")]), "A point with a mass and no extent."),
        may("rod", rod, "A thin rod."),
        may("disk", round("disk"), "A full disk."),
        may("ring", round("ring"), "A thin ring."),
        may("ball", round("ball"), "A solid ball."),
        may("shell", round("shell"), "A thin spherical shell."),
        may("box", rectangle, "A rectangle."),
        may(
            "polygon",
            closed("polygon", &[must("corners", corners, "Three or more, in order.")]),
            "A polygon.",
        ),
    ]
}

fn pivot() -> Value {
    let point = json!({ "anyOf": [named("text"), named("vector")] });
    closed(
        "[pivot.NAME]",
        &[
            must("body", named("text"), "Name of the body."),
            must("point", point, "Its point: \"rod.tip\", or `[x, y]` in body coordinates."),
            must("world", named("vector"), "Where that point is held; it may depend on the time."),
        ],
    )
}

fn joint(title: &str) -> Value {
    let world =
        closed("end of a joint", &[must("world", named("vector"), "A place; it may depend on the time.")]);
    let end = json!({ "anyOf": [named("text"), world] });
    let between = "Two points such as \"upper.tip\", or a point and a place; of a joint that an event makes also a \
                   point and a body.";
    closed(
        title,
        &[
            must("between", super::parts::pair(end), between),
            may(
                "from",
                named("text"),
                "Name of the event that makes it; it holds from the start without it.",
            ),
            may("until", named("text"), "Name of the event that releases it."),
            may(
                "assemble",
                json!({ "type": "boolean" }),
                "Whether bodies that do not fit at the start are brought together.",
            ),
        ],
    )
}

fn surface() -> Value {
    let names = json!({ "type": "array", "items": named("text") });
    closed(
        "[surface.NAME]",
        &[
            may(
                "through",
                named("vector"),
                "A point of a plane; it may depend on the time; this, `circle` or `polygon`.",
            ),
            may("circle", circle(), "A circle instead of a plane."),
            may(
                "polygon",
                json!({ "type": "array", "minItems": 3, "items": named("vector") }),
                "Corners of a convex polygon instead of a plane, counter-clockwise.",
            ),
            may("normal", direction(), "Direction out of the solid; this or `slope`."),
            may("slope", named("quantity"), "Angle of the surface, counter-clockwise; level without it."),
            may(
                "on",
                json!({ "anyOf": [named("text"), names] }),
                "A body, a point of one such as \"rod.tip\", or a list of such; all without it.",
            ),
            may("rigid", rigid(), "Not compliant; this, `spring` or `hertz`."),
            may("spring", spring(), "Compliant, in proportion to the force."),
            may("hertz", hertz(), "Compliant, as one elastic body pressed against another."),
        ],
    )
}

fn circle() -> Value {
    closed(
        "circle",
        &[
            must("centre", named("vector"), "Its centre; it may depend on the time."),
            must("radius", named("quantity"), "A length."),
            may("inside", json!({ "type": "boolean" }), "Whether it is met from inside, as a bowl is."),
        ],
    )
}

fn contact() -> Value {
    let names = json!({ "type": "array", "minItems": 2, "items": named("text") });
    let own = |mut keys: Value| {
        keys.as_object_mut().map(|keys| keys.remove("required"));
        keys
    };
    closed(
        "[contact.NAME]",
        &[
            must(
                "between",
                json!({ "anyOf": [choice(&["all"]), names] }),
                "Bodies of which every two meet, or \"all\" that no joint connects.",
            ),
            may(
                "rigid",
                own(rigid()),
                "What happens where they touch; the lesser of their own restitutions without one here.",
            ),
        ],
    )
}

fn direction() -> Value {
    super::parts::pair(named("formula"))
}

fn rigid() -> Value {
    let both = closed(
        "friction",
        &[
            must("static", named("formula"), "Greatest friction over the normal force while nothing slips."),
            must("kinetic", named("formula"), "Friction over the normal force while it slips; not greater."),
        ],
    );
    closed(
        "rigid",
        &[
            must("restitution", named("formula"), "How much of its speed an impact leaves, from 0 to 1."),
            may(
                "friction",
                json!({ "anyOf": [named("formula"), both] }),
                "Dry friction: one coefficient, or a static and a kinetic one; none without it.",
            ),
            may(
                "law",
                choice(&["poisson", "stronge", "newton"]),
                "What the restitution is the ratio of in an impact with friction: impulses, works or speeds; impulses without it.",
            ),
        ],
    )
}

fn spring() -> Value {
    closed(
        "spring of a surface",
        &[
            must("stiffness", named("quantity"), "N/m"),
            must("damping", named("quantity"), "kg/s"),
            may(
                "release",
                choice(&["at zero force", "at the surface"]),
                "When it lets go; at zero force without it.",
            ),
        ],
    )
}

fn hertz() -> Value {
    closed(
        "hertz",
        &[must("stiffness", named("quantity"), "N/m^(3/2)"), must("damping", named("quantity"), "s/m")],
    )
}
