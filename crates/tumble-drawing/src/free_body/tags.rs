//! Which labels a panel has, and what they must keep clear of.

use crate::outline::{Outline, Plane};
use crate::placing::Occupancy;
use crate::rect::Rect;
use crate::text::Label;
use crate::theme::{INK, Rgb};

use super::body::FreeBodyDiagram;
use super::circular_arrow::{CircularArrow, ring_labels};
use super::cone::Cone;
use super::draw::{CENTRE_RADIUS, HEAD_WIDTH};
use super::layout::{ARC_RADIUS, View, angle_arms, angle_vertex, faces};
use super::strokes::{Stroke, arms, equation, spreads, stroke_labels};
use crate::geometry::{Point, along, arc, corners, minus, unit};
use crate::placing::{Candidate, Tag, about_arc, about_arrow, about_line};

/// Leaders point at an arrow beyond this part of it: near tails many arrows may meet.
const LEADER_PART: f64 = 0.4;
/// And at an arm between these parts of it: at its ends it is one with what else is there.
const ARM_PARTS: [f64; 2] = [0.3, 0.8];
/// Longest label as a part of the panel's width; longer ones are cut.
const LONGEST: f64 = 0.9;

/// What a panel shows, on the page.
pub(super) struct Shown<'a> {
    pub(super) body: &'a FreeBodyDiagram,
    pub(super) view: &'a View,
    pub(super) area: &'a Rect,
    pub(super) strokes: &'a [Stroke],
    pub(super) cones: &'a [Cone],
    pub(super) rings: &'a [CircularArrow],
    /// Size of the labels in pixels.
    pub(super) size: f64,
}

impl Shown<'_> {
    /// All labels of the panel.
    pub(super) fn tags(&self) -> Vec<Tag> {
        let mut tags = self.arrow_tags();
        tags.extend(self.ring_tags());
        tags.extend(self.angle_tag());
        tags.extend(self.arm_tags());
        tags.extend(self.surface_tags());
        tags.retain(|tag| !tag.label.is_empty());
        tags
    }

    fn tag(
        &self,
        label: &Label,
        colour: Rgb,
        owner: Vec<Point>,
        near: impl Fn([f64; 2]) -> Vec<Candidate>,
    ) -> Tag {
        let label = label.fitted(self.size, LONGEST * self.area.width);
        let near = near(Tag::extent(&label, self.size));
        Tag { size: self.size, far: Some(0.0), ..Tag::new(label, colour, owner, near) }
    }

    fn arrow_tags(&self) -> Vec<Tag> {
        let labels = stroke_labels(self.body);
        let tag = |(stroke, label): (&Stroke, Label)| {
            let ends = [stroke.tail, stroke.head];
            let owner = vec![stroke.at(LEADER_PART), stroke.head];
            let near = |size| about_arrow(ends, size);
            Tag { owner, ..self.tag(&label, stroke.style.colour, ends.to_vec(), near) }
        };
        self.strokes.iter().zip(labels).map(tag).collect()
    }

    /// Symbols of arms; where there is no room beside one a leader ends at its middle.
    fn arm_tags(&self) -> Vec<Tag> {
        let tag = |(arm, label): (Stroke, Label)| {
            let ends = [arm.tail, arm.head];
            let owner = ARM_PARTS.map(|part| arm.at(part)).to_vec();
            Tag { owner, ..self.tag(&label, INK, ends.to_vec(), |size| about_arrow(ends, size)) }
        };
        arms(self.body, self.view).into_iter().map(tag).collect()
    }

    fn ring_tags(&self) -> Vec<Tag> {
        let labels = ring_labels(self.body);
        let tag = |(ring, label): (&CircularArrow, Label)| {
            let points = ring.points();
            let near = |size| about_arc(ring.centre, &points, size);
            self.tag(&label, ring.style.colour, points.clone(), near)
        };
        self.rings.iter().zip(labels).map(tag).collect()
    }

    fn angle_tag(&self) -> Option<Tag> {
        let angle = self.body.angle.as_ref()?;
        let vertex = angle_vertex(self.body, self.view)?;
        let points = self.angle_arc()?;
        let label = equation(&angle.symbol, angle.value.to_degrees(), "deg");
        Some(self.tag(&label, INK, points.clone(), |size| about_arc(vertex, &points, size)))
    }

    /// The arc of the marked angle.
    pub(super) fn angle_arc(&self) -> Option<Vec<Point>> {
        let angle = self.body.angle.as_ref()?;
        let sweep = angle.value % std::f64::consts::TAU;
        Some(arc(angle_vertex(self.body, self.view)?, ARC_RADIUS, angle.reference, sweep))
    }

    fn surface_tags(&self) -> impl Iterator<Item = Tag> {
        self.body.surfaces.iter().filter_map(|surface| {
            let line = surface.visible(self.view, self.area)?;
            let near = |size| {
                let mut near = about_line(surface.below(line), size);
                near.retain(|candidate| self.area.encloses(&candidate.place));
                near
            };
            let off = faces(self.body, self.view);
            Some(Tag { far: None, off, ..self.tag(&surface.name, INK, line.to_vec(), near) })
        })
    }

    /// What labels must keep clear of.
    pub(super) fn occupancy(&self) -> Occupancy {
        let mut drawn = Occupancy::new(*self.area);
        self.add_body(&mut drawn);
        for stroke in self.strokes {
            drawn.add_arrow([stroke.tail, stroke.head]);
            drawn.add_line(head_outline(stroke));
        }
        for (arm, _) in arms(self.body, self.view) {
            drawn.add_line(vec![arm.tail, arm.head]);
        }
        for (_, arrows) in spreads(self.body, self.view) {
            drawn.add_line(arrows.iter().map(|[_, head]| *head).collect());
            arrows.into_iter().for_each(|arrow| drawn.add_line(arrow.to_vec()));
        }
        let cones = self.cones.iter().flat_map(Cone::lines);
        cones.for_each(|line| drawn.add_line(line.to_vec()));
        for ring in self.rings {
            drawn.add_bent_arrow(ring.points());
        }
        for surface in &self.body.surfaces {
            let strip = surface.strip(self.view, self.area);
            strip.into_iter().for_each(|line| drawn.add_line(line.to_vec()));
        }
        angle_arms(self.body, self.view).into_iter().for_each(|arm| drawn.add_line(arm.to_vec()));
        self.angle_arc().into_iter().for_each(|arc| drawn.add_line(arc));
        drawn
    }

    fn add_body(&self, drawn: &mut Occupancy) {
        for face in faces(self.body, self.view) {
            let mut rim = face.clone();
            rim.extend(face.first());
            drawn.add_line(rim);
            drawn.add_face(face);
        }
        for outline in &self.body.outlines {
            if let Outline::Circle { centre: [x, y], radius, .. } = *outline {
                let spoke = [[x, y], [x + radius, y]];
                drawn.add_line(spoke.map(|p| self.view.pixel(self.body.pose.world(p))).to_vec());
            }
        }
        let mark = self.view.pixel(self.body.pose.centre());
        let mark = Rect::centred(mark, 2.0 * CENTRE_RADIUS, 2.0 * CENTRE_RADIUS);
        drawn.add_line(corners(&mark).to_vec());
    }
}

/// Across the widest part of an arrowhead.
fn head_outline(stroke: &Stroke) -> Vec<Point> {
    let side = crate::geometry::turned(unit(minus(stroke.head, stroke.tail)).unwrap_or([1.0, 0.0]));
    let back = along(stroke.head, stroke.direction(), -super::draw::HEAD_LENGTH);
    vec![along(back, side, HEAD_WIDTH), stroke.head, along(back, side, -HEAD_WIDTH)]
}
