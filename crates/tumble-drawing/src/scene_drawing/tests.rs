use super::*;
use crate::free_body::ArrowKind;
use crate::outline::Plane;
use crate::text::Label;

fn scene() -> SceneDrawing {
    let rod = Outline::Segment { from: [-0.5, 0.0], to: [0.5, 0.0] };
    let body = SceneBody {
        name: Label::plain("rod"),
        pose: Pose { t: 0.0, x: 0.3, y: 2.0, angle: 0.6 },
        outlines: vec![rod],
        velocity: Some(([2.0, 0.0], Label::equation("v0", "2", "m/s"))),
        rate: Some((-2.0, Label::equation("omega0", "-2", "rad/s"))),
    };
    SceneDrawing {
        title: Label::plain("Start"),
        bodies: vec![body],
        surfaces: vec![Ground::new([0.0, 0.0], [0.0, 1.0], Label::plain("floor"))],
        pivots: vec![NamedPoint { name: Label::symbol("A"), at: [-1.0, 2.5] }],
        points: vec![NamedPoint { name: Label::symbol("P"), at: [0.7, 2.3] }],
        links: vec![SceneLink {
            name: Label::plain("spring"),
            kind: LinkKind::Spring,
            ends: [[-1.0, 2.5], [-0.1, 1.7]],
        }],
        forces: vec![Arrow::new(ArrowKind::Applied, Label::symbol("F"), [0.7, 2.3], [0.0, 5.0])],
        gravity: Some(([0.0, -9.81], Label::symbol("g"))),
        wind: Some(([3.0, 0.0], Label::symbol("w"))),
    }
}

#[test]
fn everything_is_drawn_and_said() {
    let svg = scene().svg();
    let drawn = svg.to_string();
    for word in ["rod", "floor", "spring", "−2\u{a0}rad/s"] {
        assert!(drawn.contains(word), "{word}");
    }
    let said = "Ground floor through (0, 0) m, its normal (0, 1). Spring spring from (−1, 2.5) m";
    assert!(svg.description.contains(said), "{}", svg.description);
    assert!(svg.description.contains("Force F (0, 5) N at (0.7, 2.3) m."), "{}", svg.description);
    assert_eq!(drawn, scene().svg().to_string());
}

#[test]
fn labels_do_not_cover_each_other() {
    let layout = Layout::new(scene());
    let labels = layout.labels();
    assert_eq!(labels.len(), 8, "names of body, floor, pivot, point, spring, and three symbols");
    for (i, a) in labels.iter().enumerate() {
        assert!(layout.axes.area.encloses(&a.place), "{:?}", a.label);
        assert!(labels[..i].iter().all(|b| a.place.overlap(&b.place) == 0.0), "{:?}", a.label);
    }
}

#[test]
fn what_cannot_be_drawn_is_left_out() {
    let mut scene = scene();
    scene.bodies[0].pose.x = f64::NAN;
    scene.surfaces[0].normal = [0.0, 0.0];
    scene.links[0].ends[0][0] = f64::INFINITY;
    scene.gravity = Some(([f64::NAN, 0.0], Label::symbol("g")));
    let drawn = scene.svg().to_string();
    assert!(!drawn.contains("NaN") && !drawn.contains("inf\""));
    assert!(SceneDrawing::default().svg().to_string().contains("no data"));
}

#[test]
fn markup_in_names_is_shown() {
    let mut scene = scene();
    let hostile = Label::plain("</svg><script>");
    scene.title = hostile.clone();
    scene.bodies[0].name = hostile.clone();
    scene.surfaces[0].name = hostile.clone();
    scene.pivots[0].name = hostile.clone();
    scene.gravity = Some(([0.0, -1.0], hostile));
    assert!(!scene.svg().to_string().contains("<script"));
}

#[test]
fn labels_stay_off_bodies_and_springs() {
    let layout = Layout::new(scene());
    let lines = [
        layout.scene.bodies[0].outlines[0].extent(&layout.scene.bodies[0].pose),
        layout.scene.links[0].ends.to_vec(),
    ];
    for label in layout.labels() {
        for line in &lines {
            let [a, b] = [line[0], line[1]].map(|p| layout.view.pixel(p));
            assert!(!label.place.meets_line(a, b), "{:?}", label.label);
        }
    }
}

#[test]
fn names_keep_clear_of_the_thickness_of_rods() {
    let upright = Pose { t: 0.0, x: 0.0, y: 0.0, angle: std::f64::consts::FRAC_PI_2 };
    let rod = Outline::Segment { from: [-0.5, 0.0], to: [0.5, 0.0] };
    let body = SceneBody {
        name: Label::plain("rod"),
        pose: upright,
        outlines: vec![rod],
        velocity: None,
        rate: None,
    };
    let layout = Layout::new(SceneDrawing { bodies: vec![body], ..SceneDrawing::default() });
    let [name] = &layout.labels()[..] else { panic!("one name") };
    let [bottom, top] = [[0.0, -0.5], [0.0, 0.5]].map(|end| layout.axes.pixel(end));
    let half =
        crate::outline::rod_thickness(crate::geometry::length(crate::geometry::minus(top, bottom))) / 2.0;
    let [left, right] = [bottom[0] - half, bottom[0] + half];
    let bar = crate::rect::Rect::new(left, top[1], right - left, bottom[1] - top[1]);
    assert!(half > 3.0 && name.place.overlap(&bar) == 0.0, "{:?} over {bar:?}", name.place);
}

#[test]
fn the_name_of_a_surface_stands_on_no_body() {
    let (sin, cos) = 20.0_f64.to_radians().sin_cos();
    let block = Outline::Polygon(vec![[-0.25, -0.12], [0.25, -0.12], [0.25, 0.12], [-0.25, 0.12]]);
    let body = SceneBody {
        pose: Pose { x: -0.12 * sin, y: 0.12 * cos, angle: 20.0_f64.to_radians(), ..Pose::default() },
        outlines: vec![block],
        velocity: Some(([1.0, 0.4], Label::symbol("v"))),
        ..SceneBody::default()
    };
    let incline = Ground::new([0.0, 0.0], [-sin, cos], Label::plain("incline"));
    let gravity = Some(([0.0, -9.81], Label::symbol("g")));
    let scene =
        SceneDrawing { bodies: vec![body], surfaces: vec![incline], gravity, ..SceneDrawing::default() };
    let layout = Layout::new(scene);
    let body = &layout.scene.bodies[0];
    let face = body.outlines[0].face(&body.pose, &layout.view).expect("a block has one");
    let labels = layout.labels();
    let name = labels.iter().find(|one| one.label.to_plain() == "incline").expect("its name");
    assert!(!crate::placing::covers(&face, &name.place), "{:?}", name.place);
}
