//! What acts on bodies.

use serde_json::{Value, json};

use super::parts::{Key, choice, closed, each, may, must, named, pair};

/// `[force.NAME]`, `[drag.NAME]` and the like.
pub(super) fn sections() -> Vec<Key> {
    vec![
        may("force", each(force()), "Forces at points of bodies, and torques."),
        may("impulse", each(impulse()), "Impulses that events apply to bodies."),
        may("drag", each(drag()), "Resistance of the air."),
        may("lift", each(lift()), "Lift on spinning bodies."),
        may("spring", each(spring()), "Springs between two points."),
        may("damper", each(damper()), "Dampers between two points."),
        may("torsion", each(torsion()), "Springs that turn a body back to an angle."),
    ]
}

fn impulse() -> Value {
    closed(
        "[impulse.NAME]",
        &[
            must("on", named("text"), "Name of the body."),
            must("when", named("text"), "Name of the event; at each time that it happens."),
            may("impulse", named("vector"), "Components, N s; this or `angular_impulse`."),
            may("angular_impulse", named("quantity"), "Counter-clockwise, N m s; this or `impulse`."),
            may("at", place(), "Where it acts."),
            may("frame", choice(&["world", "body"]), "What the components refer to; the world without it."),
        ],
    )
}

fn force() -> Value {
    closed(
        "[force.NAME]",
        &[
            must("on", named("text"), "Name of the body."),
            may("force", named("vector"), "Components; this or `torque`."),
            may("torque", named("quantity"), "Counter-clockwise; this or `force`."),
            may("at", place(), "Where the force acts."),
            may(
                "frame",
                choice(&["world", "body"]),
                "Axes of the components; those of the world without it.",
            ),
            may(
                "during",
                pair(named("quantity")),
                "`[start, end]`: times, or names of events; always without it.",
            ),
        ],
    )
}

fn place() -> Value {
    let mut one = closed(
        "place of a force",
        &[
            may("body", named("vector"), "In body coordinates."),
            may("world", named("vector"), "In the world."),
            may("from_centre", named("vector"), "From the centre of mass, in axes of the world."),
        ],
    );
    (one["minProperties"], one["maxProperties"]) = (json!(1), json!(1));
    json!({ "anyOf": [named("text"), one] })
}

fn drag() -> Value {
    closed(
        "[drag.NAME]",
        &[
            may("at", named("text"), "A point, such as \"rod.cm\"; this, `along` or `on`."),
            may("along", named("text"), "A body: its rods, and the edges of its boxes and polygons."),
            may("on", named("text"), "A ball or a shell."),
            may("linear", named("quantity"), "kg/s with `at`, kg/(m*s) with `along`."),
            may("quadratic", named("quantity"), "kg/m with `at`, kg/m^2 with `along`."),
            may(
                "component",
                choice(&["full", "normal"]),
                "Which component of the velocity counts; all of it without it.",
            ),
            may("density", named("quantity"), "Of the air; with `on`."),
            may("coefficient", named("formula"), "A pure number; with `on`."),
        ],
    )
}

fn lift() -> Value {
    closed(
        "[lift.NAME]",
        &[
            must("on", named("text"), "Name of the body."),
            may("factor", named("quantity"), "A mass; this, or `density` and `slope` for a ball."),
            may("density", named("quantity"), "Of the air."),
            may("slope", named("formula"), "Of the lift coefficient over R omega/v, a pure number."),
        ],
    )
}

fn between() -> Key {
    must("between", pair(named("end")), "Two ends: \"rod.tip\", or `{ world = [x, y] }`.")
}

fn spring() -> Value {
    closed(
        "[spring.NAME]",
        &[
            between(),
            must("stiffness", named("quantity"), "N/m"),
            must("rest_length", named("quantity"), "A length; 0 says that it has none."),
            may("damping", named("quantity"), "Of the rate of the distance, kg/s; none without it."),
        ],
    )
}

fn damper() -> Value {
    closed(
        "[damper.NAME]",
        &[between(), must("damping", named("quantity"), "Of the rate of the distance, kg/s.")],
    )
}

fn torsion() -> Value {
    closed(
        "[torsion.NAME]",
        &[
            must("on", named("text"), "Name of the body."),
            must("stiffness", named("quantity"), "Torque for an angle, N*m/rad."),
            must("rest_angle", named("quantity"), "Where it has no torque."),
            may("damping", named("quantity"), "Torque for an angular velocity, N*m*s; none without it."),
        ],
    )
}
