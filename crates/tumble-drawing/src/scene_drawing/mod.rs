//! The scene at one instant: bodies, surfaces, pivots, springs, applied forces,
//! gravity and wind, to scale, with names.

mod describe;
mod layout;
pub(crate) mod marks;
mod tags;
#[cfg(test)]
mod tests;

use layout::Layout;

use crate::free_body::{Arrow, Ground, NamedPoint};
use crate::outline::{Outline, Pose};
use crate::scale::drawable;
use crate::svg::Svg;
use crate::text::Label;

/// A scene with equal scales along both axes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneDrawing {
    /// Title above the picture; may be empty.
    pub title: Label,
    /// The bodies.
    pub bodies: Vec<SceneBody>,
    /// Half-planes of material.
    pub surfaces: Vec<Ground>,
    /// Points that hold a body to the world.
    pub pivots: Vec<NamedPoint>,
    /// Other points with names.
    pub points: Vec<NamedPoint>,
    /// Springs and dampers.
    pub links: Vec<SceneLink>,
    /// Forces from outside, longer for larger ones.
    pub forces: Vec<Arrow>,
    /// Acceleration of gravity (m/s^2, x to the right, y up) and what stands beside its arrow.
    pub gravity: Option<([f64; 2], Label)>,
    /// Velocity of the air (m/s) and what stands beside its arrows.
    pub wind: Option<([f64; 2], Label)>,
}

/// A body of a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneBody {
    /// Its name.
    pub name: Label,
    /// Where it is.
    pub pose: Pose,
    /// Its outlines about the centre of mass, metres.
    pub outlines: Vec<Outline>,
    /// Velocity of the centre of mass (m/s) and what stands beside its arrow.
    pub velocity: Option<([f64; 2], Label)>,
    /// Angular velocity (rad/s, counter-clockwise) and what stands beside its arrow.
    pub rate: Option<(f64, Label)>,
}

/// What a link looks like.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LinkKind {
    /// A zigzag.
    #[default]
    Spring,
    /// A cylinder with a piston.
    Damper,
}

/// Something between two points of a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneLink {
    /// Its name.
    pub name: Label,
    /// Its looks.
    pub kind: LinkKind,
    /// Its ends in world coordinates, metres.
    pub ends: [[f64; 2]; 2],
}

impl SceneDrawing {
    /// The drawing, with everything in it in words. Without anything it is an empty frame that says so.
    pub fn svg(&self) -> Svg {
        Layout::new(self.drawable()).svg(describe::describe(self))
    }

    /// The part of it that can be drawn.
    fn drawable(&self) -> Self {
        let mut scene = self.clone();
        let seen = |p: &[f64; 2]| p.iter().copied().all(drawable);
        scene.bodies.retain(|body| body.pose.is_drawable());
        for body in &mut scene.bodies {
            let pose = body.pose;
            body.outlines.retain(|outline| outline.extent(&pose).iter().all(seen));
            body.velocity = body.velocity.take().filter(|(v, _)| seen(v));
            body.rate = body.rate.take().filter(|(rate, _)| drawable(*rate) && *rate != 0.0);
        }
        scene.surfaces.retain(Ground::is_drawable);
        scene.pivots.retain(|point| seen(&point.at));
        scene.points.retain(|point| seen(&point.at));
        scene.links.retain(|link| link.ends.iter().all(seen));
        scene.forces.retain(Arrow::is_drawable);
        scene.gravity = scene.gravity.filter(|(v, _)| seen(v));
        scene.wind = scene.wind.filter(|(v, _)| seen(v));
        scene
    }
}
