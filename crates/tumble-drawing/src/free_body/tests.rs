//! Tests of whole sheets.

use crate::outline::{Outline, Plane, Pose};
use crate::rect::Rect;
use crate::svg::Excerpt;
use crate::text::Label;

use super::panel::Drawing;
use super::sheet::Layout;
use super::strokes::LEAST_LENGTH;
use super::*;

fn rod() -> Outline {
    Outline::Segment { from: [-0.5, 0.0], to: [0.5, 0.0] }
}

fn force(kind: ArrowKind, symbol: &str, point: [f64; 2], vector: [f64; 2]) -> Arrow {
    Arrow::new(kind, Label::symbol(symbol), point, vector)
}

/// A rod with its lower end on the floor, pushed by `push` newtons.
fn bounce(push: f64, angle: f64) -> FreeBodyDiagram {
    let pose = Pose { t: 0.0, x: 3.0, y: 0.5 * angle.sin(), angle };
    FreeBodyDiagram::new(Label::plain("rod"), pose, vec![rod()])
        .heading(Label::plain("an instant"))
        .surface(Ground::new([0.0, 0.0], [0.0, 1.0], Label::plain("floor")))
        .force(force(ArrowKind::Weight, "W", pose.centre(), [0.0, -4.905]))
        .force(force(ArrowKind::Contact, "N", pose.world([-0.5, 0.0]), [0.0, push]))
        .angle(AngleMark::horizontal(Label::symbol("theta"), angle))
}

fn sheet(title: Label, panels: Vec<FreeBodyDiagram>) -> FreeBodySheet {
    FreeBodySheet { title, panels, ..FreeBodySheet::default() }
}

fn sheet_of(body: FreeBodyDiagram) -> FreeBodySheet {
    sheet(Label::default(), vec![body])
}

fn five() -> FreeBodySheet {
    let pushes = [0.0, 170.0, 560.0, 170.0, 0.0];
    sheet(Label::plain("bounce"), pushes.map(|push| bounce(push, 0.6)).to_vec())
}

/// Numbers in (-1, 1) that look random and are the same on every run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn pair(&mut self, size: f64) -> [f64; 2] {
        [size * self.next(), size * self.next()]
    }

    fn scene(&mut self) -> FreeBodyDiagram {
        let kinds =
            [ArrowKind::Weight, ArrowKind::Contact, ArrowKind::Air, ArrowKind::Applied, ArrowKind::Spring];
        let pose = Pose { t: 0.0, x: 5.0 * self.next(), y: self.next(), angle: 3.0 * self.next() };
        let box_corners = vec![[-0.5, -0.2], [0.5, -0.2], [0.5, 0.2], [-0.5, 0.2]];
        let outline = if self.next() > 0.0 { rod() } else { Outline::Polygon(box_corners) };
        let body = FreeBodyDiagram::new(Label::plain("body"), pose, vec![outline]);
        let body = kinds.into_iter().fold(body, |body, kind| {
            let point = pose.world([0.5 * self.next(), 0.2 * self.next()]);
            body.force(force(kind, "F1", point, self.pair(20.0)))
        });
        body.couple(Couple::new(ArrowKind::Air, Label::symbol("tau"), self.next()))
    }
}

fn drawings<'a>(layout: &'a Layout<'_>) -> impl Iterator<Item = &'a Drawing> {
    layout.panels.iter().flat_map(|panel| std::iter::once(&panel.main).chain(&panel.side))
}

fn assert_clear(drawing: &Drawing) {
    for (i, label) in drawing.labels.iter().enumerate() {
        let text = label.label.to_plain();
        assert!(drawing.area.encloses(&label.place), "{text} leaves the panel");
        for other in &drawing.labels[..i] {
            assert_eq!(label.place.overlap(&other.place), 0.0, "{text} on {}", other.label.to_plain());
        }
        for stroke in &drawing.strokes {
            assert!(!label.place.meets_line(stroke.start, stroke.head), "{text} on an arrow");
        }
    }
    for stroke in &drawing.strokes {
        let ends = Rect::around([stroke.tail, stroke.head]).expect("finite ends");
        assert!(drawing.area.encloses(&ends), "an arrow leaves the panel");
    }
}

#[test]
fn labels_keep_clear_of_arrows_and_each_other() {
    drawings(&Layout::new(&five())).for_each(assert_clear);
    let mut random = Random(7);
    for _ in 0..25 {
        let sheet = sheet_of(random.scene());
        drawings(&Layout::new(&sheet)).for_each(assert_clear);
    }
    let sheet = sheet(Label::default(), (0..6).map(|_| random.scene()).collect());
    drawings(&Layout::new(&sheet)).for_each(assert_clear);
}

#[test]
fn side_views_are_laid_out_like_panels() {
    let ball = Outline::Circle { centre: [0.0; 2], radius: 0.11, is_hollow: false };
    let (weight, normal) = ((Label::symbol("W"), 4.2), (Label::symbol("N"), 4.2));
    let side = SideView::resting(vec![ball.clone()], 0.11, weight, normal);
    let body = FreeBodyDiagram::new(Label::plain("ball"), Pose::default(), vec![ball]);
    let body = body.force(force(ArrowKind::Applied, "F", [-0.1, 0.04], [200.0, 0.0]));
    let body = FreeBodyDiagram { side: Some(side), ..body };
    let sheet = sheet_of(body);
    let layout = Layout::new(&sheet);
    assert_eq!(drawings(&layout).count(), 2);
    drawings(&layout).for_each(assert_clear);
    let svg = sheet.svg();
    assert!(svg.to_string().contains("seen from above"));
    assert!(svg.description.contains("out of the plane, contact force N = 4.2 N"), "{}", svg.description);
}

/// Whether its sheet says that impulses lie in cones, and what it says of the cone to those who do not see it.
fn cone_of(body: FreeBodyDiagram) -> (bool, String) {
    let normal = force(ArrowKind::Contact, "N", [0.0; 2], [0.0, 4.0]);
    let cone =
        FrictionCone { point: [0.0; 2], normal: normal.vector, friction: [1.0, 0.0], coefficient: 1.0 };
    let none = FrictionCone { coefficient: 0.0, ..cone.clone() };
    let svg = sheet_of(FreeBodyDiagram { cones: vec![cone, none], ..body.force(normal) }).svg();
    let text = svg.to_string();
    assert_eq!(text.matches("class=\"cone\"").count(), 2, "one, and one in the key");
    (text.contains("impulses of normal force"), svg.description)
}

#[test]
fn cones_of_friction_are_drawn_and_told() {
    let ball = Outline::Circle { centre: [0.0, 0.2], radius: 0.2, is_hollow: false };
    let body = FreeBodyDiagram::new(Label::plain("ball"), Pose::default(), vec![ball]);
    let (are_impulses, told) = cone_of(body.clone());
    assert!(!are_impulses && told.contains("cone of friction at (0, 0) m, 45° to both sides"), "{told}");
    assert!(cone_of(body.impulses()).0);
}

#[test]
fn arrows_start_at_their_points_and_compare_between_panels() {
    let sheet = five();
    let layout = Layout::new(&sheet);
    let push = |i: usize| &layout.panels[i].main.strokes[1];
    assert!((push(2).length() / push(1).length() - 560.0 / 170.0).abs() < 1e-9);
    let main = &layout.panels[2].main;
    assert_eq!(push(2).tail, main.view.pixel(main.body.forces[1].point));
}

#[test]
fn short_arrows_and_only_they_have_a_break() {
    let svg = five().svg().to_string();
    assert_eq!(svg.matches("class=\"break\"").count(), 5, "the weight beside 560 N");
    let layout_of = five();
    let layout = Layout::new(&layout_of);
    let weight = &layout.panels[2].main.strokes[0];
    assert!(weight.broken && (weight.length() - LEAST_LENGTH).abs() < 1e-9);
    assert!(svg.contains("arrow with a break"));
    let even = sheet_of(bounce(5.0, 0.6)).svg().to_string();
    assert!(!even.contains("class=\"break\"") && !even.contains("arrow with a break"));
}

#[test]
fn zeros_are_listed_and_not_drawn() {
    let sheet = sheet_of(bounce(0.0, 0.6));
    assert_eq!(Layout::new(&sheet).panels[0].main.strokes.len(), 1);
    assert_eq!(Layout::new(&sheet).panels[0].listed[0].to_plain().replace('\u{a0}', " "), "N = 0");
    assert!(sheet.svg().description.contains("N = 0"));
}

#[test]
fn descriptions_list_every_force_with_components_and_point() {
    let description = five().svg().description;
    assert_eq!(
        description.matches("weight force W = 4.91 N, components (0, −4.91) N, at (3, 0.282) m").count(),
        5
    );
    assert!(description.contains("contact force N = 560 N, components (0, 560) N, at (2.59, 0) m"));
    let impulse = sheet_of(bounce(1.5, 0.6).impulses()).svg();
    assert!(impulse.description.contains("contact impulse N = 1.5 N·s"), "{}", impulse.description);
    assert!(impulse.to_string().contains("N·s") && impulse.to_string().contains("<desc>"));
}

#[test]
fn pages_are_about_eight_to_five() {
    for count in 2..=12 {
        let panels = vec![bounce(30.0, 0.6); count];
        let svg = sheet(Label::plain("sheet"), panels).svg();
        let shape = svg.width / svg.height;
        assert!((1.1..2.3).contains(&shape), "{count} panels: {shape}");
    }
}

#[test]
fn nothing_makes_a_drawing_without_numbers() {
    let values = [0.0, -0.0, 1e-320, 1e-12, 1.0, 1e9, 1e200, 1e308, f64::NAN, f64::INFINITY];
    let outlines = |size: f64| {
        vec![
            Outline::Circle { centre: [0.0; 2], radius: size, is_hollow: false },
            Outline::Point([size, 0.0]),
            rod(),
        ]
    };
    for (i, a) in values.into_iter().enumerate() {
        for b in values.into_iter().skip(i) {
            let pose = Pose { x: a, y: b, angle: a, t: b };
            let body = FreeBodyDiagram::new(Label::plain("<a> & \"b\" ]]>"), pose, outlines(b))
                .force(force(ArrowKind::Weight, "W", [a, b], [b, a]))
                .force(force(ArrowKind::Air, "<b>", [0.0, 0.0], [1e-12, 0.0]))
                .force(force(ArrowKind::Spring, "", [b, 0.0], [a, 0.0]))
                .couple(Couple::new(ArrowKind::Applied, Label::default(), a))
                .surface(Ground::new([a, b], [b, a], Label::plain("floor")))
                .angle(AngleMark::horizontal(Label::symbol("theta"), b));
            let body = FreeBodyDiagram { rate: Some(a), ..body.velocity(Velocity::new("V", [b, a], [a, b])) };
            let svg = sheet(Label::default(), vec![body, FreeBodyDiagram::default()]).svg().to_string();
            assert!(!svg.contains("NaN") && !svg.contains("inf") && !svg.contains("<b>"), "{a} {b}");
        }
    }
}

#[test]
fn thirty_forces_at_one_point_are_all_labelled() {
    let body = FreeBodyDiagram::new(Label::plain("crate"), Pose::default(), vec![rod()]);
    let body = (0..30).fold(body, |body, i| {
        let angle = 2.4 * f64::from(i);
        body.force(force(ArrowKind::Applied, &format!("F{i}"), [0.5, 0.0], [angle.cos(), angle.sin()]))
    });
    let sheet = sheet_of(body);
    let layout = Layout::new(&sheet);
    let labels = &layout.panels[0].main.labels;
    assert_eq!(labels.len(), 30);
    for (i, label) in labels.iter().enumerate() {
        assert!(labels[..i].iter().all(|other| other.place.overlap(&label.place) == 0.0));
    }
}

#[test]
fn sheets_without_panels_and_bodies_without_anything_are_drawn() {
    let nothing = FreeBodySheet::default().svg().to_string();
    assert!(nothing.contains("Free-body diagram") && nothing.contains("no data"));
    let svg = sheet_of(FreeBodyDiagram::default()).svg();
    assert!(svg.description.contains("no force") && svg.width > 0.0 && svg.height > 0.0);
}

#[test]
fn equal_input_gives_equal_bytes() {
    assert_eq!(five().svg().to_string(), five().svg().to_string());
}

#[test]
fn an_arm_has_its_symbol_also_where_an_arrow_covers_it() {
    let centre = [0.0, 1.0];
    let pose = Pose { t: 0.0, x: centre[0], y: centre[1], angle: 0.0 };
    let ball = Outline::Circle { centre: [0.0, 0.0], radius: 1.0, is_hollow: false };
    let body = FreeBodyDiagram::new(Label::plain("ball"), pose, vec![ball])
        .surface(Ground::new([0.0, 0.0], [0.0, 1.0], Label::plain("floor")))
        .force(force(ArrowKind::Weight, "W", centre, [0.0, -1.96]))
        .force(force(ArrowKind::Contact, "N", [0.0, 0.0], [0.0, 1.96]))
        .arm(Label::symbol("r_rim"), [0.0, 0.0]);
    assert!(sheet_of(body).svg().to_string().contains("rim"));
}

/// A narrow page shows the title, every panel whole, and the key.
#[test]
fn broad_sheets_have_parts_that_fit_a_phone() {
    let sheet = five();
    let (layout, svg) = (Layout::new(&sheet), sheet.svg());
    assert!(svg.width > 444.0 && svg.parts.len() == layout.panels.len() + 2);
    let cuts: Vec<Rect> = svg
        .parts
        .iter()
        .filter_map(|part| if let Excerpt::Cut(area) = part { Some(*area) } else { None })
        .collect();
    for (cut, panel) in cuts.iter().zip(&layout.panels) {
        assert!(cut.width <= 444.0 && cut.x < panel.frame.x && cut.right() > panel.frame.right());
        assert!(cut.y < panel.frame.y && cut.bottom() > panel.frame.bottom());
    }
    let page = svg.inline("figure-7");
    assert_eq!(page.matches("<use href=\"#figure-7-drawing\"").count(), layout.panels.len());
    assert_eq!(page.matches("<g id=\"figure-7-drawing\">").count(), 1);
    // One panel is narrow enough.
    assert!(sheet_of(bounce(3.0, 0.4)).svg().parts.is_empty());
}
