//! What acts out of the plane of a body seen from above.

use crate::outline::{Outline, Pose};
use crate::text::Label;

use super::arrow::{Arrow, ArrowKind, ArrowUnit};
use super::body::FreeBodyDiagram;
use super::surface::Ground;

/// A small view from the side, beside a body seen from above. Its coordinates
/// are one horizontal axis and the height, with scales of its own.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SideView {
    /// Where the body is: x along the view, y its height.
    pub pose: Pose,
    /// Outlines as seen from the side, about the centre of mass, metres.
    pub outlines: Vec<Outline>,
    /// Surfaces near it.
    pub surfaces: Vec<Ground>,
    /// Forces, for instance weight and normal force.
    pub forces: Vec<Arrow>,
}

impl SideView {
    /// A body resting on a level floor, its centre of mass `height` above it
    /// (metres), with its weight at the centre and the normal force below it
    /// (both in N, magnitudes).
    pub fn resting(outlines: Vec<Outline>, height: f64, weight: (Label, f64), normal: (Label, f64)) -> Self {
        let pose = Pose { y: height, ..Pose::default() };
        let floor = Ground::new([0.0; 2], [0.0, 1.0], Label::default());
        let forces = vec![
            Arrow::new(ArrowKind::Weight, weight.0, [0.0, height], [0.0, -weight.1]),
            Arrow::new(ArrowKind::Contact, normal.0, [0.0; 2], [0.0, normal.1]),
        ];
        Self { pose, outlines, surfaces: vec![floor], forces }
    }

    pub(super) fn as_body(&self, unit: &ArrowUnit) -> FreeBodyDiagram {
        FreeBodyDiagram {
            pose: self.pose,
            outlines: self.outlines.clone(),
            surfaces: self.surfaces.clone(),
            forces: self.forces.clone(),
            unit: unit.clone(),
            ..FreeBodyDiagram::default()
        }
    }
}
