//! Outlines of bodies, and how a body in some pose is drawn.

use crate::geometry::{arc, length, minus, plus, times, turned, unit};
use crate::scale::drawable;
use crate::svg::{Element, PathData, circle, line};
use crate::theme::{HAIRLINE, Rgb};

/// Thickness of a rod as a part of its length, and at least in pixels.
const ROD_THICKNESS: f64 = 0.025;
const THINNEST_ROD: f64 = 3.0;
/// Rods drawn very long look like beams beyond this, in pixels.
const THICKEST_ROD: f64 = 9.0;
/// Thickness of outlines in pixels.
const OUTLINE: f64 = 1.3;
/// Thickness of strings in pixels.
const CORD: f64 = 0.8;
/// Radius of a body without size, in pixels.
const POINT_RADIUS: f64 = 3.5;
/// Spokes by which labels see a circle.
const SPOKES: u32 = 12;
/// How strong the colour of faces is, compared with their outline.
const FACE_STRENGTH: f64 = 0.14;

/// A part of a body's outline, in metres, in the axes of the body at angle
/// zero, with the centre of mass at the origin.
#[derive(Clone, Debug, PartialEq)]
pub enum Outline {
    /// A thin rod between two points.
    Segment {
        /// One end.
        from: [f64; 2],
        /// The other end.
        to: [f64; 2],
    },
    /// A disk, ball or ring; a radius is drawn in it so that turning is seen.
    Circle {
        /// Centre.
        centre: [f64; 2],
        /// Radius in metres.
        radius: f64,
        /// Whether it is a ring, with nothing in it.
        is_hollow: bool,
    },
    /// What holds a body at a place beside it, without a mass: a string.
    Cord {
        /// One end.
        from: [f64; 2],
        /// The other end.
        to: [f64; 2],
    },
    /// A closed outline through its corners.
    Polygon(Vec<[f64; 2]>),
    /// A point.
    Point([f64; 2]),
}

/// Where a body is at one instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose {
    /// Time in seconds.
    pub t: f64,
    /// Centre of mass, to the right, in metres.
    pub x: f64,
    /// Centre of mass, upwards, in metres.
    pub y: f64,
    /// Angle in radians, counter-clockwise.
    pub angle: f64,
}

impl Pose {
    /// Centre of mass `[x, y]` in metres.
    pub fn centre(&self) -> [f64; 2] {
        [self.x, self.y]
    }

    /// World coordinates of a point given in body coordinates.
    pub fn world(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = self.angle.sin_cos();
        [self.x + cos * x - sin * y, self.y + sin * x + cos * y]
    }

    /// Whether all its numbers can be drawn.
    pub fn is_drawable(&self) -> bool {
        [self.t, self.x, self.y, self.angle].into_iter().all(drawable)
    }
}

/// A map from the plane of motion to the page that keeps shapes.
pub trait Plane {
    /// Pixels `[x, y]` (y down) of a world point in metres.
    fn pixel(&self, point: [f64; 2]) -> [f64; 2];

    /// Pixels per metre.
    fn density(&self) -> f64;
}

/// How a body is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pen {
    /// Colour of outlines and rods.
    pub colour: Rgb,
    /// Rods as an outline instead of a full bar.
    pub hollow: bool,
}

impl Outline {
    /// Greatest distance of the outline from the centre of mass, in metres.
    pub fn reach(&self) -> f64 {
        let radius = if let Outline::Circle { radius, .. } = self { *radius } else { 0.0 };
        self.points().into_iter().map(length).fold(0.0, f64::max) + radius
    }

    /// The points that it is given by, in the axes of the body.
    pub fn points(&self) -> Vec<[f64; 2]> {
        match self {
            Outline::Segment { from, to } | Outline::Cord { from, to } => vec![*from, *to],
            Outline::Circle { centre, .. } => vec![*centre],
            Outline::Polygon(corners) => corners.clone(),
            Outline::Point(at) => vec![*at],
        }
    }

    /// World points that bound the outline in a pose.
    pub fn extent(&self, pose: &Pose) -> Vec<[f64; 2]> {
        if let Outline::Circle { centre, radius, .. } = self {
            let [x, y] = pose.world(*centre);
            return vec![[x - radius, y - radius], [x + radius, y + radius]];
        }
        self.points().into_iter().map(|p| pose.world(p)).collect()
    }

    /// Where something long ends, in world coordinates.
    pub(crate) fn ends(&self, pose: &Pose) -> Vec<[f64; 2]> {
        if matches!(self, Outline::Segment { .. }) { self.extent(pose) } else { vec![] }
    }

    /// Lines (world points) that cover the outline well enough to keep labels off it.
    pub fn spokes(&self, pose: &Pose) -> Vec<[f64; 2]> {
        let rim = match self {
            Outline::Circle { centre: [x, y], radius, .. } => circle_points([*x, *y], *radius),
            Outline::Polygon(corners) => corners.clone(),
            Outline::Segment { .. } | Outline::Cord { .. } | Outline::Point(_) => return self.extent(pose),
        };
        let there_and_back = rim.iter().zip(rim.iter().cycle().skip(1)).flat_map(|(a, b)| [*a, *b, [0.0; 2]]);
        there_and_back.map(|p| pose.world(p)).collect()
    }

    /// Lines on the page that labels keep clear of; a rod has its two sides.
    pub(crate) fn lines(&self, pose: &Pose, plane: &impl Plane) -> Vec<Vec<[f64; 2]>> {
        let pixels: Vec<[f64; 2]> = self.spokes(pose).into_iter().map(|point| plane.pixel(point)).collect();
        let (Outline::Segment { .. }, [from, to]) = (self, &pixels[..]) else { return vec![pixels] };
        let Some(sides) = rod_sides([*from, *to]) else { return vec![pixels] };
        sides.map(Vec::from).into()
    }

    /// What it covers on the page, as a closed outline; a rod has its thickness.
    pub(crate) fn face(&self, pose: &Pose, plane: &impl Plane) -> Option<Vec<[f64; 2]>> {
        let pixel = |p: &[f64; 2]| plane.pixel(pose.world(*p));
        match self {
            Outline::Polygon(corners) => Some(corners.iter().map(pixel).collect()),
            Outline::Circle { centre, radius, .. } => {
                Some(arc(pixel(centre), radius * plane.density(), 0.0, std::f64::consts::TAU))
            }
            Outline::Segment { from, to } => {
                let ends = [from, to].map(pixel);
                let [[a, b], [c, d]] = rod_sides(ends).unwrap_or([ends; 2]);
                Some(vec![a, b, d, c])
            }
            Outline::Point(_) | Outline::Cord { .. } => None,
        }
    }

    /// The outline on the page.
    pub fn draw(&self, pose: &Pose, plane: &impl Plane, pen: Pen) -> Vec<Element> {
        let pixel = |p: &[f64; 2]| plane.pixel(pose.world(*p));
        match self {
            Outline::Segment { from, to } => draw_rod(pixel(from), pixel(to), pen),
            Outline::Cord { from, to } => {
                let [from, to] = [from, to].map(pixel);
                vec![line(from, to).stroked(pen.colour, CORD)]
            }
            Outline::Circle { centre, radius, is_hollow } => {
                let rim = pixel(&[centre[0] + radius, centre[1]]);
                draw_round(pixel(centre), rim, (radius * plane.density(), *is_hollow), pen)
            }
            Outline::Polygon(corners) => {
                let corners: Vec<_> = corners.iter().map(pixel).collect();
                let face = PathData::polygon(&corners).fill(pen.colour.strength(FACE_STRENGTH));
                vec![outlined(face, pen).attr("stroke-linejoin", "round")]
            }
            Outline::Point(at) => vec![circle(pixel(at), POINT_RADIUS).attr("fill", pen.colour)],
        }
    }
}

fn circle_points([x, y]: [f64; 2], radius: f64) -> Vec<[f64; 2]> {
    let angle = |i: u32| std::f64::consts::TAU * f64::from(i) / f64::from(SPOKES);
    (0..SPOKES).map(angle).map(|a| [x + radius * a.cos(), y + radius * a.sin()]).collect()
}

fn outlined(element: Element, pen: Pen) -> Element {
    element.stroked(pen.colour, OUTLINE)
}

/// The two sides of a rod between two points of the page; `None` if it has no length.
pub(crate) fn rod_sides(ends: [[f64; 2]; 2]) -> Option<[[[f64; 2]; 2]; 2]> {
    let along = minus(ends[1], ends[0]);
    let across = unit(turned(along))?;
    let half = rod_thickness(length(along)) / 2.0;
    Some([half, -half].map(|side| ends.map(|end| plus(end, times(across, side)))))
}

/// Thickness of a rod `length` pixels long.
pub(crate) fn rod_thickness(length: f64) -> f64 {
    (ROD_THICKNESS * length).clamp(THINNEST_ROD, THICKEST_ROD).min(length)
}

/// A bar with round ends that is just as long as the rod.
fn draw_rod(a: [f64; 2], b: [f64; 2], pen: Pen) -> Vec<Element> {
    let way = minus(b, a);
    let length = length(way).max(f64::MIN_POSITIVE);
    let thickness = rod_thickness(length);
    let inset = way.map(|d| d / length * thickness / 2.0);
    let ends = (plus(a, inset), minus(b, inset));
    let bar =
        |colour: Rgb, width: f64| line(ends.0, ends.1).stroked(colour, width).attr("stroke-linecap", "round");
    let full = bar(pen.colour, thickness);
    let hole = pen.hollow.then(|| bar(crate::theme::PAPER, thickness - 2.0 * HAIRLINE));
    std::iter::once(full).chain(hole).collect()
}

fn draw_round(centre: [f64; 2], rim: [f64; 2], (radius, is_hollow): (f64, bool), pen: Pen) -> Vec<Element> {
    let disk = circle(centre, radius);
    let disk = match is_hollow {
        true => disk.attr("fill", "none"),
        false => disk.attr("fill", pen.colour.strength(FACE_STRENGTH)),
    };
    vec![outlined(disk, pen), outlined(line(centre, rim), pen)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn poses_turn_counter_clockwise() {
        let pose = Pose { x: 1.0, y: 2.0, angle: std::f64::consts::FRAC_PI_2, t: 0.0 };
        let [x, y] = pose.world([1.0, 0.0]);
        assert!((x - 1.0).abs() < 1e-15 && (y - 3.0).abs() < 1e-15);
    }

    #[test]
    fn extents_bound_the_outline() {
        let ball = Outline::Circle { centre: [0.0, 0.0], radius: 0.5, is_hollow: false };
        assert_eq!(ball.extent(&Pose::default()), [[-0.5, -0.5], [0.5, 0.5]]);
        assert_eq!(ball.reach(), 0.5);
        assert_eq!(Outline::Segment { from: [0.0, 3.0], to: [4.0, 0.0] }.reach(), 4.0);
    }

    #[test]
    fn a_rod_of_no_length_is_drawn_without_numbers_that_are_none() {
        let pen = Pen { colour: crate::theme::INK, hollow: false };
        let drawn = draw_rod([1.0, 1.0], [1.0, 1.0], pen);
        assert!(!drawn[0].to_string().contains("NaN"));
    }
}
