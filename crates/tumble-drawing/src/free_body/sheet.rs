//! A sheet of free-body diagrams at common scales.

use std::collections::BTreeSet;

use crate::curves::no_data;
use crate::heading::Heading;
use crate::outline::Plane;
use crate::rect::Rect;
use crate::svg::{Excerpt, Svg};
use crate::text::Label;
use crate::theme::{GAP, MARGIN, NARROW, SMALL};

use super::arrow::{ArrowKind, ArrowUnit};
use super::body::FreeBodyDiagram;
use super::describe::describe;
use super::fit::{Room, scales};
use super::grid::{Grid, rooms};
use super::key::{Entry, Key};
use super::layout::{Scales, View, about_centre, body_size};
use super::panel::{Drawing, INSET, Panel, Source, Trim, centred_in, room, split};
use crate::geometry::{Point, minus, plus};

/// Height of a sheet without panels, in pixels.
const BLANK_HEIGHT: f64 = 100.0;
/// Panels need a legend from this many kinds of forces on.
const KINDS: usize = 2;

/// Free-body diagrams in a grid.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FreeBodySheet {
    /// Title above the panels; may be empty.
    pub title: Label,
    /// The panels, row by row.
    pub panels: Vec<FreeBodyDiagram>,
    /// Captions below the panels.
    pub captions: Vec<Label>,
}

impl FreeBodySheet {
    /// The drawing. Without panels it is an empty page with the title.
    pub fn svg(&self) -> Svg {
        Layout::new(self).svg()
    }

    /// The title, or the name that all panels share.
    fn shown_title(&self) -> Label {
        match self.panels.first() {
            Some(first) if self.title.is_empty() && !self.names_differ() => first.name.clone(),
            _ => self.title.clone(),
        }
    }

    fn names_differ(&self) -> bool {
        self.panels.windows(2).any(|pair| pair[0].name != pair[1].name)
    }

    fn description(&self) -> String {
        self.panels.iter().map(describe).collect::<Vec<_>>().join(" ")
    }
}

/// A sheet, laid out.
pub(super) struct Layout<'a> {
    sheet: &'a FreeBodySheet,
    heading: Heading,
    pub(super) panels: Vec<Panel>,
    /// Scales of each panel.
    scales: Vec<Scales>,
    key: Key,
    key_at: Point,
    size: [f64; 2],
}

impl<'a> Layout<'a> {
    pub(super) fn new(sheet: &'a FreeBodySheet) -> Self {
        let with_name = sheet.names_differ();
        let sources: Vec<_> = sheet.panels.iter().map(|body| Source::new(body, with_name)).collect();
        let grid = Grid::best(&sources);
        let width = grid.extent()[0].max(grid.size[0]) + 2.0 * MARGIN;
        let heading = Heading::new(&sheet.shown_title(), width);
        let corner = [MARGIN, heading.bottom()];
        let scales = all_scales(&sources, &grid);
        let panels = panels(&sources, &grid, corner, &scales);
        let mut layout = Self {
            sheet,
            heading,
            panels,
            scales,
            key: Key::new(&[], &[], width),
            key_at: corner,
            size: [width, 0.0],
        };
        layout.add_key(&grid, corner);
        layout
    }

    /// The key goes into an empty place of the grid if it fits there, else below the panels.
    fn add_key(&mut self, grid: &Grid, corner: Point) {
        let (groups, captions) = (self.groups(), self.captions());
        let bottom = corner[1] + if self.panels.is_empty() { BLANK_HEIGHT } else { grid.extent()[1] };
        let rest = grid.rest(corner).map(|rest| rest.grown(-2.0 * INSET));
        let inside = rest.map(|rest| (rest, Key::new(&groups, &captions, rest.width)));
        match inside.filter(|(rest, key)| key.height <= rest.height) {
            Some((rest, key)) => {
                self.key_at = [rest.x, rest.centre()[1] - key.height / 2.0];
                self.key = key;
                self.size[1] = bottom + MARGIN;
            }
            None => {
                self.key = Key::new(&groups, &captions, self.size[0] - 2.0 * (MARGIN + INSET));
                self.key_at = [MARGIN + INSET, bottom + GAP];
                self.size[1] = bottom + GAP + self.key.height + MARGIN;
            }
        }
    }

    fn svg(&self) -> Svg {
        let [width, height] = self.size;
        let title = self.sheet.shown_title().to_plain_or("Free-body diagram");
        let mut svg = Svg::on_paper(width, height, title).described(self.sheet.description());
        svg.push(self.heading.draw());
        let framed = self.panels.len() > 1;
        svg.children.extend(self.panels.iter().map(|panel| panel.draw(framed)));
        svg.push(self.key.draw(self.key_at));
        svg.children.extend(self.panels.is_empty().then(|| no_data(&self.blank())));
        if width > NARROW {
            svg.parts = self.parts();
        }
        svg
    }

    /// The title, the panels and the key below each other.
    fn parts(&self) -> Vec<Excerpt> {
        let part = |height: f64, content| {
            let mut part = Svg::on_paper(NARROW, height, "");
            part.push(content);
            Excerpt::Drawn(Box::new(part))
        };
        let heading = Heading::new(&self.sheet.shown_title(), NARROW);
        let key = Key::new(&self.groups(), &self.captions(), NARROW - 2.0 * (MARGIN + INSET));
        let panels = self.panels.iter().map(|panel| Excerpt::Cut(panel.frame.grown(INSET / 2.0)));
        std::iter::once(part(heading.bottom(), heading.draw()))
            .chain(panels)
            .chain([part(key.height + MARGIN, key.draw([MARGIN + INSET, 0.0]))])
            .collect()
    }

    /// The space in which a sheet without panels says so.
    fn blank(&self) -> Rect {
        Rect::new(MARGIN, self.heading.bottom(), self.size[0] - 2.0 * MARGIN, BLANK_HEIGHT)
    }

    fn groups(&self) -> Vec<Vec<Entry>> {
        let kinds = self.kinds();
        let wanted = kinds.len() >= KINDS;
        let kinds = kinds.into_iter().filter(|_| wanted).map(Entry::ArrowKind).collect();
        let cones = self.has_cones().then_some(Entry::Cone).into_iter().collect();
        vec![kinds, cones, self.bars()]
    }

    fn drawings(&self) -> impl Iterator<Item = &Drawing> {
        self.panels.iter().flat_map(|panel| std::iter::once(&panel.main).chain(&panel.side))
    }

    /// What lies within cones of friction.
    fn in_cones(&self) -> &'static str {
        let with_cones = self.drawings().filter(|drawing| !drawing.cones.is_empty());
        let are_impulses: Vec<bool> =
            with_cones.map(|drawing| drawing.body.unit == ArrowUnit::impulse()).collect();
        match (are_impulses.contains(&false), are_impulses.contains(&true)) {
            (false, true) => "the impulses of normal force and friction",
            (true, true) => "normal force and friction, or of their impulses,",
            _ => "normal force and friction",
        }
    }

    fn has_cones(&self) -> bool {
        self.drawings().any(|drawing| !drawing.cones.is_empty())
    }

    fn kinds(&self) -> BTreeSet<ArrowKind> {
        let bodies = self.drawings().map(|drawing| &drawing.body);
        bodies
            .flat_map(|body| {
                let arrows = body.forces.iter().chain(&body.resultant).map(|force| force.kind);
                arrows.chain(body.couples.iter().map(|couple| couple.kind))
            })
            .collect()
    }

    /// A bar for every unit of arrows and one for lengths.
    fn bars(&self) -> Vec<Entry> {
        let (mut bars, mut units): (Vec<Entry>, Vec<&ArrowUnit>) = (vec![], vec![]);
        for (panel, scales) in self.panels.iter().zip(&self.scales) {
            let unit = &panel.main.body.unit;
            if scales.largest > 0.0 && !units.contains(&unit) {
                units.push(unit);
                bars.extend(Entry::bar(scales.arrow / scales.largest, &unit.arrow));
            }
        }
        bars.extend(self.length_bar());
        bars
    }

    fn length_bar(&self) -> Option<Entry> {
        let sized =
            self.panels.iter().any(|panel| body_size(&panel.main.body).iter().any(|side| *side > 0.0));
        self.scales.first().filter(|_| sized).and_then(|scales| Entry::bar(scales.density, "m"))
    }

    fn captions(&self) -> Vec<Label> {
        let mut captions = self.sheet.captions.clone();
        if self.drawings().any(|drawing| drawing.strokes.iter().any(|stroke| stroke.broken)) {
            captions.push(Label::plain("An arrow with a break (//) is drawn longer than its scale."));
        }
        if self.has_cones() {
            captions.push(Label::plain(&format!(
                "The sum (dashed) of {} lies within the cone of friction, and on its edge where the contact slides.",
                self.in_cones()
            )));
        }
        if self.drawings().any(|drawing| !drawing.rings.is_empty()) {
            captions.push(Label::plain("Circular arrows are not to scale."));
        }
        captions
    }
}

/// The scales of every panel.
fn all_scales(sources: &[Source], grid: &Grid) -> Vec<Scales> {
    let trim = Trim::new(sources, grid.size[0]);
    let rooms = rooms(sources, grid.size, &trim);
    let own = |room: &Room<'_>| scales(&rooms, room.body, grid.fit.density, grid.fit.arrow);
    rooms.iter().map(own).collect()
}

fn panels(sources: &[Source], grid: &Grid, corner: Point, scales: &[Scales]) -> Vec<Panel> {
    let trim = Trim::new(sources, grid.size[0]);
    let areas: Vec<_> = (0..sources.len()).map(|i| trim.area(&grid.frame(corner, i))).collect();
    let mains: Vec<_> = sources.iter().zip(&areas).map(|(source, area)| split(source, area)).collect();
    let places = centres(sources, &mains.iter().map(|main| main.0).collect::<Vec<_>>(), scales);
    let panel = |(i, source): (usize, &Source)| {
        let (main, side) = mains[i];
        let side = source.side.as_ref().zip(side);
        Panel {
            frame: grid.frame(corner, i),
            heading: source.heading_lines(grid.size[0]),
            listed: source.listed_lines(grid.size[0]),
            main: Drawing::new(&source.body, main, places[i], &scales[i], SMALL),
            side: side.map(|(body, area)| Drawing::alone(body, area, SMALL)),
        }
    };
    sources.iter().enumerate().map(panel).collect()
}

/// Where the centres of mass go: at the same place of the world in every
/// panel, separately to the right and upwards, where there is room for that.
fn centres(sources: &[Source], areas: &[Rect], scales: &[Scales]) -> Vec<Point> {
    let (Some(first), Some(area)) = (sources.first(), areas.first()) else { return Vec::new() };
    let taken: Vec<_> = sources.iter().zip(scales).map(|(source, s)| about_centre(&source.body, s)).collect();
    let offset = |(source, scales): (&Source, &Scales)| {
        let view = View { centre: first.body.pose.centre(), at: [0.0; 2], density: scales.density };
        view.pixel(source.body.pose.centre())
    };
    let offsets: Vec<_> = sources.iter().zip(scales).map(offset).collect();
    let corners = taken.iter().zip(&offsets).flat_map(|(taken, offset)| {
        [plus([taken.x, taken.y], *offset), plus([taken.right(), taken.bottom()], *offset)]
    });
    let union = Rect::around(corners).unwrap_or(*area);
    let same = scales.windows(2).all(|pair| pair[0].density == pair[1].density);
    let room = room(area);
    let shared = [union.width <= room[0] && same, union.height <= room[1] && same];
    let place = |i: usize| {
        let own = centred_in(&areas[i], &taken[i]);
        let common = plus(minus(areas[i].centre(), union.centre()), offsets[i]);
        [0, 1].map(|k| if shared[k] { common[k] } else { own[k] })
    };
    (0..sources.len()).map(place).collect()
}
