//! One panel: a heading, the body with its arrows, and what is zero.

use crate::font::Face;
use crate::heading::wrapped;
use crate::outline::{Pen, Plane};
use crate::rect::Rect;
use crate::svg::{Element, PathData};
use crate::text::{Label, PlacedText, TextAnchor};
use crate::theme::{BODY, GREY, HAIRLINE, INK, LEADING, SMALL};

use super::body::FreeBodyDiagram;
use super::circular_arrow::{CircularArrow, rings};
use super::cone::Cone;
use super::draw;
use super::fit::{Room, fit, scales};
use super::layout::{Scales, View, about_centre, angle_arms, cones};
use super::strokes::{Stroke, arms, spreads, strokes};
use super::tags::Shown;
use crate::geometry::{Point, length, minus};
use crate::placing::{Placed, draw_placed, placed};

/// Distance between the frame of a panel and its texts.
pub(super) const INSET: f64 = 8.0;
/// Room for labels at the sides of a panel, as a part of its width, and above and below.
const SIDE_ROOM: f64 = 0.1;
const ABOVE_ROOM: f64 = 15.0;
/// The side view's part of the width of a panel.
const SIDE_PART: f64 = 0.34;

/// What a panel is made from.
pub(super) struct Source {
    /// Only what can be drawn.
    pub(super) body: FreeBodyDiagram,
    pub(super) heading: Vec<Label>,
    /// What is zero or no number.
    pub(super) listed: Vec<Label>,
    pub(super) side: Option<FreeBodyDiagram>,
}

impl Source {
    pub(super) fn new(body: &FreeBodyDiagram, with_name: bool) -> Self {
        let name = (with_name && !body.name.is_empty()).then(|| body.name.clone());
        let heading = name.into_iter().chain(body.heading.clone()).collect();
        let side = body.side.as_ref().map(|side| side.as_body(&body.unit));
        let mut listed = body.listed();
        listed.extend(side.iter().flat_map(FreeBodyDiagram::listed));
        Self { body: body.drawable(), heading, listed, side: side.map(|side| side.drawable()) }
    }

    /// The heading in lines that fit a panel; the first one in bold.
    pub(super) fn heading_lines(&self, width: f64) -> Vec<Label> {
        // Symbols have no bold face, and half a line in bold looks like a slip.
        let bold = |i: usize, line: &Label| i == 0 && line.runs.iter().all(|run| run.face == Face::Regular);
        let style =
            |(i, line): (usize, &Label)| if bold(i, line) { line.clone().bold() } else { line.clone() };
        let lines = self.heading.iter().enumerate().map(style);
        lines.flat_map(|line| wrapped(&line, SMALL, width - 2.0 * INSET)).collect()
    }

    /// The list of zeros in lines that fit a panel.
    pub(super) fn listed_lines(&self, width: f64) -> Vec<Label> {
        let joined =
            self.listed.iter().cloned().map(unbroken).reduce(|a, b| a.then(Label::plain(", ")).then(b));
        wrapped(&joined.unwrap_or_default(), SMALL, width - 2.0 * INSET)
    }
}

/// The label with blanks at which no line ends.
fn unbroken(mut label: Label) -> Label {
    for run in &mut label.runs {
        run.text = run.text.replace(' ', "\u{a0}");
    }
    label
}

/// Heights of the text above and below the drawings of a sheet, in pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Trim {
    pub(super) above: f64,
    pub(super) below: f64,
}

impl Trim {
    /// Enough for every panel `width` pixels wide.
    pub(super) fn new(sources: &[Source], width: f64) -> Self {
        let most = |lines: &dyn Fn(&Source) -> usize| sources.iter().map(lines).max().unwrap_or(0) as f64;
        let above = most(&|source| source.heading_lines(width).len()) * SMALL * LEADING;
        let below = most(&|source| source.listed_lines(width).len()) * SMALL * LEADING;
        Self { above: above + INSET, below: below + INSET }
    }

    /// The part of a panel that is left for drawing.
    pub(super) fn area(&self, frame: &Rect) -> Rect {
        let height = (frame.height - self.above - self.below).max(1.0);
        Rect::new(frame.x + 1.0, frame.y + self.above, frame.width - 2.0, height)
    }
}

/// The places of the main view and of the side view.
pub(super) fn split(source: &Source, area: &Rect) -> (Rect, Option<Rect>) {
    if source.side.is_none() {
        return (*area, None);
    }
    let caption = SMALL * LEADING;
    let width = SIDE_PART * area.width;
    let main = Rect::new(area.x, area.y + caption, area.width - width, area.height - caption);
    let side = Rect::new(main.right(), main.y, width - INSET, main.height);
    (main, Some(side))
}

/// Width and height that arrows and bodies may take.
pub(super) fn room(area: &Rect) -> [f64; 2] {
    let [side, above] = [SIDE_ROOM * area.width, ABOVE_ROOM];
    [(area.width - 2.0 * side).max(1.0), (area.height - 2.0 * above).max(1.0)]
}

/// A body with its arrows and labels, laid out.
pub(super) struct Drawing {
    pub(super) body: FreeBodyDiagram,
    pub(super) area: Rect,
    pub(super) view: View,
    pub(super) strokes: Vec<Stroke>,
    pub(super) cones: Vec<Cone>,
    pub(super) rings: Vec<CircularArrow>,
    pub(super) angle_arc: Option<Vec<Point>>,
    pub(super) labels: Vec<Placed>,
}

impl Drawing {
    pub(super) fn new(body: &FreeBodyDiagram, area: Rect, at: Point, scales: &Scales, size: f64) -> Self {
        let view = View { centre: body.pose.centre(), at, density: scales.density };
        let strokes = strokes(body, &view, scales);
        let rings = rings(body, &view, &strokes);
        let cones = cones(body, &view, scales);
        let shown =
            Shown { body, view: &view, area: &area, strokes: &strokes, cones: &cones, rings: &rings, size };
        let labels = placed(&shown.tags(), &shown.occupancy(), &area);
        let angle_arc = shown.angle_arc();
        Self { body: body.clone(), area, view, strokes, cones, rings, angle_arc, labels }
    }

    /// A drawing with scales of its own, in the middle of `area`.
    pub(super) fn alone(body: &FreeBodyDiagram, area: Rect, size: f64) -> Self {
        let rooms = [Room { body, size: room(&area) }];
        let best = fit(&rooms);
        let scales = scales(&rooms, body, best.density, best.arrow);
        let at = centred_in(&area, &about_centre(body, &scales));
        Self::new(body, area, at, &scales, size)
    }

    pub(super) fn draw(&self) -> Element {
        let view = &self.view;
        let surfaces = self.body.surfaces.iter().filter_map(|surface| surface.draw(view, &self.area));
        let pen = Pen { colour: BODY, hollow: false };
        let outlines = self.body.outlines.iter().flat_map(|shape| shape.draw(&self.body.pose, view, pen));
        let arms = angle_arms(&self.body, view).into_iter().map(|arm| draw::dashed(&arm));
        let group = Element::new("g").children(surfaces).children(arms).children(outlines);
        let group = group.children(self.cones.iter().map(Cone::draw));
        group.children(self.draw_arc()).children(self.draw_arrows()).children(draw_placed(&self.labels))
    }

    fn draw_arc(&self) -> Option<Element> {
        Some(PathData::polyline(self.angle_arc.as_ref()?).stroke(INK, 1.0))
    }

    fn draw_arrows(&self) -> Vec<Element> {
        let spreads = spreads(&self.body, &self.view).into_iter();
        let spreads = spreads.map(|(style, arrows)| draw::spread(style, &arrows));
        let arms = arms(&self.body, &self.view).into_iter().map(|(arm, _)| draw::arrow(&arm));
        let rings = self.rings.iter().map(draw::ring);
        let arrows = self.strokes.iter().map(draw::arrow);
        let centre = [draw::centre_mark(self.view.pixel(self.body.pose.centre()))];
        let dots = self.strokes.iter().filter(|stroke| !self.starts_at_centre(stroke));
        let dots = dots.map(|stroke| draw::dot(stroke.point, stroke.style));
        // A thin arm is seen on a thick arrow.
        spreads.chain(rings).chain(centre).chain(arrows).chain(arms).chain(dots).collect()
    }

    fn starts_at_centre(&self, stroke: &Stroke) -> bool {
        let centre = self.view.pixel(self.body.pose.centre());
        length(minus(centre, stroke.point)) < draw::CENTRE_RADIUS
    }
}

/// Where the centre of mass must be for `taken` to be in the middle of `area`.
pub(super) fn centred_in(area: &Rect, taken: &Rect) -> Point {
    minus(area.centre(), taken.centre())
}

/// A panel, laid out.
pub(super) struct Panel {
    pub(super) frame: Rect,
    pub(super) heading: Vec<Label>,
    pub(super) listed: Vec<Label>,
    pub(super) main: Drawing,
    pub(super) side: Option<Drawing>,
}

impl Panel {
    /// The panel with everything in it; `framed` draws its edge.
    pub(super) fn draw(&self, framed: bool) -> Element {
        let edge = framed.then(|| edge(&self.frame));
        let group = Element::new("g").children(edge).child(self.main.draw());
        group.children(self.draw_heading()).children(self.draw_listed()).children(self.draw_side())
    }

    fn draw_heading(&self) -> Vec<Element> {
        let line = |(i, label): (usize, &Label)| {
            let y = self.frame.y + INSET + SMALL * (0.9 + LEADING * i as f64);
            PlacedText::new(label, [self.frame.x + INSET, y], SMALL, TextAnchor::Start).element()
        };
        self.heading.iter().enumerate().map(line).collect()
    }

    fn draw_listed(&self) -> Vec<Element> {
        let line = |(i, label): (usize, &Label)| {
            let y = self.frame.bottom() - INSET - SMALL * LEADING * i as f64;
            PlacedText::new(label, [self.frame.x + INSET, y], SMALL, TextAnchor::Start).colour(INK).element()
        };
        self.listed.iter().rev().enumerate().map(line).collect()
    }

    fn draw_side(&self) -> Option<Element> {
        let side = self.side.as_ref()?;
        let caption = |text: &str, area: &Rect| {
            let at = [area.centre()[0], area.y - 0.35 * SMALL];
            PlacedText::new(&Label::plain(text), at, SMALL, TextAnchor::Middle).element()
        };
        let captions =
            [caption("seen from above", &self.main.area), caption("side view, own scale", &side.area)];
        Some(Element::new("g").children(captions).child(edge(&side.area)).child(side.draw()))
    }
}

/// A pale frame.
pub(super) fn edge(frame: &Rect) -> Element {
    frame.element("rect").attr("fill", "none").stroked(GREY.strength(0.5), HAIRLINE)
}
