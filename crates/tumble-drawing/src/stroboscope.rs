//! Stroboscopic pictures: bodies at equal time steps, to scale, with the
//! paths of their centres.

use crate::axes::{Axes, Axis, clipped};
use crate::curves::no_data;
use crate::free_body::Ground;
use crate::free_body::layout::View;
use crate::geometry::{minus, plus, times};
use crate::heading::Heading;
use crate::legend::Legend;
use crate::outline::{Pen, Plane, Pose};
use crate::placing::{Occupancy, Tag, about_point, draw_placed, placed};
use crate::rect::Rect;
use crate::scale::Range;
use crate::svg::{Element, Excerpt, PathData, Svg, circle};
use crate::text::Label;
use crate::theme::{GAP, HAIRLINE, INK, LineStyle, MARGIN, NARROW, PAPER, Rgb, SMALL};
use crate::thin::{pieces, simplified, thinned};
use crate::track::BodyPath;

/// Width of a picture, unless the motion is tall, its least width, and the greatest height of its plotting area, in pixels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Size {
    width: f64,
    least_width: f64,
    pub(crate) greatest_height: f64,
}

/// A picture of its own.
pub(crate) const ALONE: Size = Size { width: 680.0, least_width: 400.0, greatest_height: 520.0 };
/// On a narrow page.
const ON_PHONE: Size = Size { width: NARROW, least_width: 260.0, greatest_height: 520.0 };
/// One beside something else on a sheet of paper: its letters are not made smaller there.
const BESIDE: Size = Size { width: 430.0, least_width: 260.0, greatest_height: 250.0 };
/// Least height of the plotting area.
const LEAST_HEIGHT: f64 = 120.0;
/// Room around the motion, as a part of the larger side, for the labels of instants.
const PADDING: f64 = 0.06;
/// Strength of the colour of the first instant, compared with the last.
const FIRST_STRENGTH: f64 = 0.4;
/// Dashes of the paths of centres, one after the other for overlaid runs.
const TRACE_DASHES: [&str; 4] = ["1.6 2.8", "7 3", "7 2.5 1.6 2.5", "12 3"];
/// Thickness of the paths of centres.
const TRACE: f64 = 1.1;
/// Columns of a path thinner than this hold only its extremes, in pixels.
const COLUMN: f64 = 0.5;
/// How far a simplified path may lie beside the true one, in pixels.
const TOLERANCE: f64 = 0.04;
/// Radius of the dot at each centre of mass.
const CENTRE_DOT: f64 = 2.1;
/// Least distance of labels from the frame: ticks are as long.
const EDGE: f64 = 6.0;
/// Distance of a label from its body.
const LABEL_DISTANCE: f64 = 3.0;
/// Part of the width that a legend may take: letters of other fonts are wider.
const LEGEND: f64 = 0.9;
/// What it costs that a label of an instant is led to its body by a line: less than to cover something.
const FAR_COST: f64 = 25.0;
/// Where along a surface its name may stand, best first.
const NAME_PARTS: [f64; 5] = [0.5, 0.3, 0.7, 0.12, 0.88];
/// So many bodies or more tell their common times once.
const SEVERAL: usize = 3;
/// Least distance of a label as a part of the body's reach: there may be room beside a rod's middle.
const LABEL_REACH: f64 = 0.5;

/// A stroboscopic picture with equal scales along both axes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StroboscopicPicture {
    /// Title above the picture; may be empty.
    pub title: Label,
    /// Bodies and runs, drawn over each other in order.
    pub tracks: Vec<BodyPath>,
    /// Half-planes of material, drawn hatched below the bodies.
    pub surfaces: Vec<Ground>,
}

impl StroboscopicPicture {
    /// The drawing. Without poses and paths it is an empty frame that says so.
    pub fn svg(&self) -> Svg {
        let mut svg = Scene::new(self, ALONE).svg();
        if svg.width > NARROW {
            svg.parts = vec![Excerpt::Drawn(Box::new(Scene::new(self, ON_PHONE).svg()))];
        }
        svg
    }

    /// The drawing in half the width of a sheet of paper.
    pub fn small_svg(&self) -> Svg {
        Scene::new(self, BESIDE).svg()
    }

    /// Ranges of x and y that hold everything drawn.
    fn ranges(&self) -> Option<[Range; 2]> {
        let mut points: Vec<_> = self.tracks.iter().flat_map(BodyPath::extent).collect();
        let feet = self.surfaces.iter().filter_map(|surface| surface.foot_of_lowest(&points));
        let feet: Vec<_> = feet.collect();
        points.extend(feet);
        let [x, y] = Range::of_points(&points)?;
        let room = 2.0 * PADDING * x.span().max(y.span());
        Some([x, y].map(|r| r.widened(r.span() + room).opened()))
    }
}

/// A picture with its axes laid out.
struct Scene<'a> {
    picture: &'a StroboscopicPicture,
    heading: Heading,
    axes: Axes,
    legend: Option<Legend>,
    empty: bool,
}

impl<'a> Scene<'a> {
    fn new(picture: &'a StroboscopicPicture, size: Size) -> Self {
        let ranges = picture.ranges();
        let wanted = ranges.unwrap_or_default();
        let width = picture_width(wanted, size);
        let heading = Heading::new(&picture.title, width);
        let legend = legend(&picture.tracks).map(|legend| legend.spread(LEGEND * (width - 2.0 * MARGIN)));
        let above = legend.as_ref().map_or(0.0, |legend| legend.size()[1] + GAP);
        let axes = equal_axes(wanted, (width, size.greatest_height), heading.bottom() + above);
        Self { picture, heading, axes, legend, empty: ranges.is_none() }
    }

    fn svg(&self) -> Svg {
        let [width, height] = self.axes.end();
        let mut svg = Svg::on_paper(width, height, self.picture.title.to_plain());
        svg.push(self.heading.draw());
        let legend = self.legend.iter();
        svg.children.extend(legend.map(|legend| legend.draw([MARGIN, self.heading.bottom()])));
        svg.push(clipped(self.axes.area, self.motion()));
        svg.children.extend(self.empty.then(|| no_data(&self.axes.area)));
        svg.push(self.axes.draw());
        svg
    }

    fn motion(&self) -> Vec<Element> {
        let tracks = || self.picture.tracks.iter().enumerate();
        let bodies = tracks().map(|(i, track)| self.draw_bodies(i, track));
        let traces = tracks().map(|(i, track)| self.draw_trace(i, track));
        let view = View::of(&self.axes);
        let surfaces = self.surfaces().filter_map(|surface| surface.draw(&view, &self.axes.area));
        surfaces.chain(bodies).chain(traces).chain([self.draw_labels()]).collect()
    }

    fn surfaces(&self) -> impl Iterator<Item = &Ground> {
        self.picture.surfaces.iter().filter(|surface| surface.is_drawable())
    }

    fn draw_bodies(&self, index: usize, track: &BodyPath) -> Element {
        let last = track.poses.len().saturating_sub(1).max(1) as f64;
        let body = |(i, pose): (usize, &Pose)| {
            let strength = FIRST_STRENGTH + (1.0 - FIRST_STRENGTH) * i as f64 / last;
            let pen = Pen { colour: style(index).colour.strength(strength), hollow: index % 2 == 1 };
            track.shapes.iter().flat_map(|shape| shape.draw(pose, &self.axes, pen)).collect::<Vec<_>>()
        };
        Element::new("g").children(track.numbered().flat_map(body))
    }

    fn draw_trace(&self, index: usize, track: &BodyPath) -> Element {
        let mut path = PathData::default();
        self.trace_pieces(track).iter().for_each(|piece| path.add_polyline(piece));
        let line =
            (!path.is_empty()).then(|| path.stroke(self.colour(index), TRACE).dashed(style(index).dashes));
        let dot = |at| circle(at, CENTRE_DOT).attr("fill", INK).stroked(PAPER, HAIRLINE);
        let dots = track.poses().map(|pose| dot(self.axes.pixel(pose.centre())));
        Element::new("g").children(line).children(dots)
    }

    /// Colour of the path and the labels of a track.
    fn colour(&self, index: usize) -> Rgb {
        if self.picture.tracks.len() > 1 { style(index).colour } else { INK }
    }

    fn trace_pieces(&self, track: &BodyPath) -> Vec<Vec<[f64; 2]>> {
        let pixels = pieces(track.trace.iter().map(|p| self.axes.pixel(*p)));
        pixels.iter().map(|piece| simplified(&thinned(piece, COLUMN), TOLERANCE)).collect()
    }

    /// Where labels may stand: on no tick of the frame.
    fn room(&self) -> Rect {
        self.axes.area.grown(-EDGE)
    }

    /// What labels must keep clear of.
    fn occupancy(&self) -> Occupancy {
        let area = self.axes.area;
        let mut drawn = Occupancy::new(self.room());
        let view = View::of(&self.axes);
        for strip in self.surfaces().flat_map(|surface| surface.strip(&view, &area)) {
            drawn.add_line(strip.to_vec());
        }
        for track in &self.picture.tracks {
            self.trace_pieces(track).into_iter().for_each(|piece| drawn.add_line(piece));
            for pose in track.poses() {
                let centre = self.axes.pixel(pose.centre());
                drawn.add_line(vec![centre]);
                for shape in &track.shapes {
                    shape.lines(pose, &self.axes).into_iter().for_each(|line| drawn.add_line(line));
                }
            }
        }
        drawn
    }

    fn draw_labels(&self) -> Element {
        let mut tags: Vec<Tag> = self.notes().iter().map(|note| self.tag(note)).collect();
        tags.extend(self.surface_names());
        Element::new("g").children(draw_placed(&placed(&tags, &self.occupancy(), &self.room())))
    }

    /// What bodies cover.
    fn faces(&self) -> Vec<Vec<[f64; 2]>> {
        let of_track = |track: &BodyPath| {
            let of_pose =
                |pose: &Pose| track.shapes.iter().filter_map(|s| s.face(pose, &self.axes)).collect();
            track.poses().flat_map(|pose| -> Vec<_> { of_pose(pose) }).collect::<Vec<_>>()
        };
        self.picture.tracks.iter().flat_map(of_track).collect()
    }

    fn surface_names(&self) -> impl Iterator<Item = Tag> {
        let view = View::of(&self.axes);
        let area = self.axes.area;
        let off = self.faces();
        self.surfaces().filter_map(move |surface| {
            let [a, b] = surface.visible(&view, &area)?;
            let size = Tag::extent(&surface.name, SMALL);
            let at = |part: f64| plus(a, times(minus(b, a), part));
            let near = NAME_PARTS.into_iter().flat_map(|part| about_point(at(part), LABEL_DISTANCE, size));
            let tag = || Tag::new(surface.name.clone(), INK, vec![a, b], near.collect());
            (!surface.name.is_empty()).then(|| Tag { off: off.clone(), ..tag() })
        })
    }

    /// The labels of all tracks; one that runs share, as at a common start, stands once.
    fn notes(&self) -> Vec<Note<'_>> {
        let mut notes: Vec<Note<'_>> = Vec::new();
        let times =
            |track: &BodyPath| -> Vec<Label> { track.labels().into_iter().map(|(_, label)| label).collect() };
        let tracks = &self.picture.tracks;
        // Of several bodies with the same times one tells them.
        let is_told = |i: usize| {
            tracks.len() >= SEVERAL && tracks[..i].iter().any(|other| times(other) == times(&tracks[i]))
        };
        for (i, track) in tracks.iter().enumerate().filter(|(i, _)| !is_told(*i)) {
            for (pose, label) in track.labels() {
                let same = |note: &&mut Note<'_>| note.label == label && note.pose.centre() == pose.centre();
                match notes.iter_mut().find(same) {
                    Some(note) => note.colour = INK,
                    None => notes.push(Note { track, pose, label, colour: self.colour(i) }),
                }
            }
        }
        notes
    }

    fn tag(&self, note: &Note<'_>) -> Tag {
        let size = Tag::extent(&note.label, SMALL);
        // By its ends, where it has some, and else beside its middle.
        let ends = note.track.shapes.iter().flat_map(|shape| shape.ends(note.pose));
        let ends: Vec<[f64; 2]> = ends.map(|end| self.axes.pixel(end)).collect();
        let distance = note.track.reach() * self.axes.x.density() * LABEL_REACH + LABEL_DISTANCE;
        let centre = self.axes.pixel(note.pose.centre());
        let by_ends = ends.iter().flat_map(|end| about_point(*end, LABEL_DISTANCE, size));
        let near = by_ends.chain(about_point(centre, distance, size)).collect();
        let rim = || note.track.shapes.iter().flat_map(|shape| shape.spokes(note.pose));
        let owner = if ends.is_empty() {
            rim().map(|p| self.axes.pixel(p)).chain([centre]).collect()
        } else {
            ends.clone()
        };
        Tag { far: Some(FAR_COST), ..Tag::new(note.label.clone(), note.colour.for_text(), owner, near) }
    }
}

/// A label of an instant.
struct Note<'a> {
    track: &'a BodyPath,
    pose: &'a Pose,
    label: Label,
    colour: Rgb,
}

fn style(index: usize) -> LineStyle {
    LineStyle { dashes: TRACE_DASHES[index % TRACE_DASHES.len()], ..LineStyle::of(index) }
}

fn legend(tracks: &[BodyPath]) -> Option<Legend> {
    let labelled = tracks.iter().enumerate().filter(|(_, track)| !track.label.is_empty());
    Legend::column(labelled.map(|(i, track)| (track.label.clone(), style(i))).collect())
}

/// Pictures of tall motions are narrow.
pub(crate) fn picture_width([x, y]: [Range; 2], size: Size) -> f64 {
    let width = x.span() / y.span() * size.greatest_height;
    (width + size.width / 8.0).clamp(size.least_width, size.width)
}

/// Axes with the same scale in both directions; the shorter range is widened to fill the area.
pub(crate) fn equal_axes(ranges: [Range; 2], (width, tallest): (f64, f64), top: f64) -> Axes {
    let (x, y) = (Axis::new(Label::symbol("x"), "m"), Axis::new(Label::symbol("y"), "m"));
    let fitted = |height| Axes::fitted([&x, &y], ranges, width, top, height);
    let height = fitted(LEAST_HEIGHT).area.width * ranges[1].span() / ranges[0].span();
    let area = fitted(height.clamp(LEAST_HEIGHT, tallest)).area;
    let metres = (ranges[0].span() / area.width).max(ranges[1].span() / area.height);
    let ranges = [ranges[0].widened(metres * area.width), ranges[1].widened(metres * area.height)];
    Axes::new([&x, &y], ranges, area)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outline::Outline;

    fn flight() -> StroboscopicPicture {
        let pose = |i: i32| {
            let t = 0.1 * f64::from(i);
            Pose { t, x: 8.0 * t, y: 2.0 + 4.0 * t - 4.9 * t * t, angle: 3.0 * t }
        };
        let poses: Vec<_> = (0..12).map(pose).collect();
        let trace = poses.iter().map(Pose::centre).collect();
        let rod = Outline::Segment { from: [-0.5, 0.0], to: [0.5, 0.0] };
        let track = BodyPath { label: Label::default(), shapes: vec![rod], poses, trace };
        StroboscopicPicture { tracks: vec![track], ..StroboscopicPicture::default() }
    }

    #[test]
    fn scales_are_equal() {
        for ranges in [[(0.0, 12.0), (0.0, 3.0)], [(0.0, 4.0), (0.0, 0.2)], [(0.0, 1.0), (0.0, 50.0)]] {
            let ranges = ranges.map(|(low, high)| Range::new(low, high));
            let axes = equal_axes(ranges, (picture_width(ranges, ALONE), ALONE.greatest_height), 40.0);
            assert!((axes.x.density() / axes.y.density() - 1.0).abs() < 1e-9);
            assert!(axes.x.range.contains(ranges[0].high) && axes.y.range.contains(ranges[1].high));
        }
    }

    #[test]
    fn a_narrow_page_has_all_of_a_broad_picture() {
        let svg = flight().svg();
        let [Excerpt::Drawn(part)] = &svg.parts[..] else { panic!("one part") };
        assert!(svg.width > NARROW && part.width <= NARROW, "{} of {}", part.width, svg.width);
        let dots =
            |svg: &Svg| svg.children.iter().map(|one| one.to_string().matches("<circle").count()).sum();
        let [all, of_part]: [usize; 2] = [dots(&svg), dots(part)];
        assert_eq!(all, of_part);
    }

    #[test]
    fn equal_input_gives_equal_bytes() {
        assert_eq!(flight().svg().to_string(), flight().svg().to_string());
    }

    #[test]
    fn every_pose_has_a_dot_and_the_ends_have_times() {
        let svg = flight().svg().to_string();
        assert_eq!(svg.matches("<circle").count(), 12);
        assert!(svg.contains("1.1\u{a0}s"));
    }

    #[test]
    fn a_common_start_is_labelled_once() {
        let mut picture = flight();
        picture.tracks.push(picture.tracks[0].clone());
        picture.tracks[1].poses.truncate(8);
        assert_eq!(Scene::new(&picture, ALONE).notes().len(), 3);
    }

    #[test]
    fn surfaces_are_seen_below_the_bodies() {
        let mut picture = flight();
        let bare = picture.svg().to_string();
        picture.surfaces = vec![
            Ground::new([0.0, -3.0], [0.0, 2.0], Label::plain("floor")),
            Ground::new([0.0, 0.0], [0.0, 0.0], Label::default()),
        ];
        let drawn = picture.svg().to_string();
        let lowest = |picture: &StroboscopicPicture| picture.ranges().expect("poses")[1].low;
        assert!(lowest(&picture) < -3.0, "the floor is in the picture");
        assert!(drawn.len() > bare.len() && drawn.contains("floor") && !drawn.contains("NaN"));
        assert!(drawn.find("floor") > drawn.find("<circle"), "names stand over bodies");
    }

    #[test]
    fn labels_of_instants_stand_on_no_tick() {
        for turned in 0..20 {
            let mut picture = flight();
            let poses = &mut picture.tracks[0].poses;
            poses.iter_mut().for_each(|pose| pose.angle += 0.3 * f64::from(turned));
            let scene = Scene::new(&picture, ALONE);
            let tags: Vec<Tag> = scene.notes().iter().map(|note| scene.tag(note)).collect();
            let labels = placed(&tags, &scene.occupancy(), &scene.room());
            assert_eq!(labels.len(), 2);
            for label in labels {
                assert!(scene.axes.area.grown(-EDGE).encloses(&label.place), "{turned}: {:?}", label.place);
            }
        }
    }

    #[test]
    fn nothing_finite_is_an_empty_frame() {
        let mut picture = flight();
        picture.tracks[0].trace.clear();
        picture.tracks[0].poses.iter_mut().for_each(|pose| pose.angle = f64::NAN);
        let svg = picture.svg().to_string();
        assert!(svg.contains("no data") && !svg.contains("NaN"));
    }
}
