//! A scene in words, for those who cannot see it.

use super::{SceneBody, SceneDrawing};
use crate::scene_drawing::LinkKind;
use crate::text::Label;

/// Digits of numbers in words.
const DIGITS: usize = 4;

/// Everything in the scene, in the order in which it was given.
pub(super) fn describe(scene: &SceneDrawing) -> String {
    let mut parts: Vec<String> = scene.bodies.iter().map(body).collect();
    parts.extend(scene.pivots.iter().map(|p| format!("Pivot {} at {}.", p.name.to_plain(), place(p.at))));
    parts.extend(scene.points.iter().map(|p| format!("Point {} at {}.", p.name.to_plain(), place(p.at))));
    parts.extend(scene.surfaces.iter().map(|surface| {
        let (at, normal) = (place(surface.point), pair(surface.normal));
        if let Some(round) = surface.round {
            let what = if round.hollow { "Round hollow" } else { "Circle" };
            return format!("{what} {} about {at}, radius {} m.", surface.name.to_plain(), round.radius);
        }
        format!("Ground {} through {at}, its normal {normal}.", surface.name.to_plain())
    }));
    parts.extend(scene.links.iter().map(|link| {
        let kind = match link.kind {
            LinkKind::Spring => "Spring",
            LinkKind::Damper => "Damper",
        };
        format!("{kind} {} from {} to {}.", link.name.to_plain(), place(link.ends[0]), place(link.ends[1]))
    }));
    parts.extend(scene.forces.iter().map(|force| {
        let (name, vector) = (force.name().to_plain(), pair(force.vector));
        format!("Force {name} {vector} N at {}.", place(force.point))
    }));
    parts.extend(
        scene.gravity.iter().map(|(g, label)| format!("Gravity {} {} m/s².", label.to_plain(), pair(*g))),
    );
    parts.extend(scene.wind.iter().map(|(w, label)| format!("Wind {} {} m/s.", label.to_plain(), pair(*w))));
    parts.join(" ").replace("  ", " ").replace(" .", ".")
}

fn body(body: &SceneBody) -> String {
    let mut words = format!(
        "{} with its centre of mass at {}, turned by {} degrees",
        body.name.to_plain_or("A body"),
        place(body.pose.centre()),
        number(body.pose.angle.to_degrees())
    );
    if let Some((v, label)) = &body.velocity {
        words += &format!(", velocity {} {} m/s", label.to_plain(), pair(*v));
    }
    if let Some((rate, label)) = &body.rate {
        words += &format!(", angular velocity {} {} rad/s", label.to_plain(), number(*rate));
    }
    words + "."
}

fn number(value: f64) -> String {
    Label::number(value, DIGITS).to_plain()
}

fn pair([x, y]: [f64; 2]) -> String {
    format!("({}, {})", number(x), number(y))
}

fn place(at: [f64; 2]) -> String {
    format!("{} m", pair(at))
}
