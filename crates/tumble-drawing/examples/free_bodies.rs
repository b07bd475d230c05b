//! Draws free-body diagrams of varied scenes into a directory, as SVG and as PNG:
//! `cargo run -p tumble-report --example free_bodies -- DIR`.

use std::error::Error;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_6};
use std::fs;
use std::path::PathBuf;

use tumble_drawing::free_body::{
    AngleMark, Arrow, Couple, FreeBodyDiagram, Kind, Scaling, Sheet, SideView, Surface, Velocity,
};
use tumble_drawing::{Label, Outline, Pose, Svg, png};

const PIXELS: f64 = 2.0;
const G: f64 = 9.81;

fn main() -> Result<(), Box<dyn Error>> {
    let directory = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "figures".to_owned()));
    fs::create_dir_all(&directory)?;
    for (name, svg) in all_figures() {
        fs::write(directory.join(format!("{name}.svg")), svg.to_string())?;
        fs::write(directory.join(format!("{name}.png")), png(&svg, PIXELS)?)?;
    }
    Ok(())
}

fn all_figures() -> Vec<(String, Svg)> {
    let mut figures = vec![
        ("bounce".to_owned(), bounce().svg()),
        ("pendulum".to_owned(), pendulum().svg()),
        ("kick".to_owned(), kick().svg()),
        ("impulse".to_owned(), impulse().svg()),
        ("slope".to_owned(), slope().svg()),
        ("crowd".to_owned(), crowd(30).svg()),
        ("extremes".to_owned(), extremes().svg()),
        ("panel-scales".to_owned(), Sheet { scaling: Scaling::PanelForces, ..bounce() }.svg()),
        ("empty".to_owned(), Sheet::default().svg()),
    ];
    figures.extend([2, 3, 4, 6, 7, 12].map(|n| (format!("many-{n}"), many(n).svg())));
    figures
}

fn weight(mass: f64, centre: [f64; 2]) -> Arrow {
    Arrow::new(Kind::Weight, Label::markup("$m$ $g$"), centre, [0.0, -mass * G])
}

fn floor() -> Surface {
    Surface::new([0.0, 0.0], [0.0, 1.0], Label::default())
}

fn rod(length: f64) -> Outline {
    Outline::Segment { from: [-length / 2.0, 0.0], to: [length / 2.0, 0.0] }
}

/// A rod at some instant of its bounce; `push` is the force of the floor in N.
fn rod_at(words: &str, t: f64, gap: f64, angle: f64, push: f64) -> FreeBodyDiagram {
    let y = 0.5 * angle.sin() + gap;
    let pose = Pose { t, x: 2.0 * t, y, angle };
    let end = pose.world([-0.5, 0.0]);
    FreeBodyDiagram::new(Label::plain("rod"), pose, vec![rod(1.0)])
        .heading(Label::plain(words))
        .heading(Label::equation("t", &format!("{t:.4}"), "s"))
        .surface(floor())
        .force(weight(0.5, pose.centre()))
        .force(Arrow::new(Kind::Contact, Label::symbol("N"), end, [0.0, push]))
        .angle(AngleMark::horizontal(Label::symbol("theta"), angle))
}

fn bounce() -> Sheet {
    let panels = vec![
        rod_at("before the contact", 0.5350, 0.11, 0.610, 0.0),
        rod_at("10 % of the contact", 0.5559, -0.001, 0.640, 170.0),
        rod_at("50 % of the contact", 0.5580, -0.004, 0.641, 560.0),
        rod_at("90 % of the contact", 0.5601, -0.001, 0.636, 170.0),
        rod_at("after the contact", 0.5810, 0.06, 0.530, 0.0),
    ];
    Sheet::new(Label::plain("A rod bounces on a floor"), panels)
}

fn pendulum() -> Sheet {
    let angle = 0.6;
    let pose = Pose { t: 1.25, x: 0.5 * f64::sin(angle), y: -0.5 * f64::cos(angle), angle };
    let hanging = Outline::Segment { from: [0.0, 0.5], to: [0.0, -0.5] };
    let body = FreeBodyDiagram::new(Label::plain("rod"), pose, vec![hanging])
        .heading(Label::equation("t", "1.250", "s"))
        .point(Label::symbol("P"), [0.0, 0.0])
        .force(weight(1.0, pose.centre()))
        .force(Arrow::new(Kind::Reaction, Label::symbol("R"), [0.0, 0.0], [-3.1, 8.2]))
        .force(Arrow::new(Kind::Air, Label::symbol("F_air"), pose.centre(), [6.4, 0.7]))
        .angle(
            AngleMark { reference: -FRAC_PI_2, ..AngleMark::horizontal(Label::symbol("theta"), angle) }
                .at([0.0, 0.0]),
        );
    Sheet { title: Label::plain("A pendulum in the wind"), ..Sheet::of(body) }
}

fn kick() -> Sheet {
    let ball = Outline::Circle { centre: [0.0, 0.0], radius: 0.11 };
    let pose = Pose { t: 0.004, x: 0.0, y: 0.0, angle: 0.3 };
    let side = SideView::resting(
        vec![ball.clone()],
        0.11,
        (Label::markup("$m$ $g$"), 4.22),
        (Label::symbol("N"), 4.22),
    );
    let body = FreeBodyDiagram::new(Label::plain("ball"), pose, vec![ball])
        .heading(Label::plain("during the kick"))
        .heading(Label::equation("t", "0.004", "s"))
        .force(Arrow::new(Kind::Applied, Label::symbol("F"), [-0.093, 0.06], [200.0, 0.0]))
        .force(Arrow::new(Kind::Air, Label::symbol("F_air"), pose.centre(), [0.0, 0.0]))
        .side(side);
    Sheet {
        title: Label::plain("A kicked ball"),
        ..Sheet::of(FreeBodyDiagram {
            rate: Some(-28.8),
            ..body.velocity(Velocity::new("V", [0.0; 2], [4.6, 0.0]))
        })
    }
}

fn impulse() -> Sheet {
    let angle = 0.52;
    let pose = Pose { t: 0.558, x: 1.0, y: 0.5 * f64::sin(angle), angle };
    let end = pose.world([-0.5, 0.0]);
    let body = FreeBodyDiagram::new(Label::plain("rod"), pose, vec![rod(1.0)])
        .impulses()
        .heading(Label::markup("impulse at $t$ = 0.5580 s"))
        .surface(Surface::new([0.0, 0.0], [0.0, 1.0], Label::plain("floor")))
        .force(Arrow::new(Kind::Contact, Label::symbol("J_n"), end, [0.0, 1.86]))
        .force(Arrow::new(Kind::Contact, Label::symbol("J_t"), end, [-0.42, 0.0]))
        .force(Arrow {
            kind: Kind::Resultant,
            ..Arrow::new(Kind::Resultant, Label::symbol("J"), end, [-0.42, 1.86])
        })
        .point(Label::symbol("A"), end)
        .angle(AngleMark::horizontal(Label::symbol("theta"), angle));
    Sheet { title: Label::plain("The rod hits the floor"), ..Sheet::of(body) }
}

fn slope() -> Sheet {
    let tilt = FRAC_PI_6;
    let normal = [-tilt.sin(), tilt.cos()];
    let pose = Pose { t: 0.0, x: 0.3 * normal[0], y: 0.3 * normal[1], angle: tilt };
    let corners = [[-0.5, -0.3], [0.5, -0.3], [0.5, 0.3], [-0.5, 0.3]];
    let at = |p: [f64; 2]| pose.world(p);
    let along = |size: f64| [size * tilt.cos(), size * tilt.sin()];
    let up = |size: f64| [size * normal[0], size * normal[1]];
    let body = FreeBodyDiagram::new(Label::plain("box"), pose, vec![Outline::Polygon(corners.to_vec())])
        .surface(Surface::new([0.0, 0.0], normal, Label::plain("slope")))
        .force(weight(8.0, pose.centre()))
        .force(Arrow::new(Kind::Contact, Label::symbol("N1"), at(corners[0]), up(52.0)))
        .force(Arrow::new(Kind::Contact, Label::symbol("N2"), at(corners[1]), up(16.0)))
        .force(Arrow::new(Kind::Contact, Label::symbol("f1"), at(corners[0]), along(9.0)))
        .force(Arrow::new(Kind::Contact, Label::symbol("f2"), at(corners[1]), along(2.5)))
        .force(Arrow::new(Kind::Spring, Label::symbol("F_s"), at([0.5, 0.1]), along(44.0)))
        .force(Arrow::new(Kind::Applied, Label::symbol("P"), at([-0.5, 0.2]), [30.0, 0.0]))
        .force(Arrow::new(Kind::Air, Label::symbol("F_air"), pose.centre(), [-0.012, 0.0]))
        .couple(Couple::new(Kind::Applied, Label::symbol("tau"), -3.5))
        .angle(AngleMark::horizontal(Label::symbol("alpha"), tilt).at(at([-0.5, -0.3])));
    Sheet { title: Label::plain("A box on a slope"), ..Sheet::of(body) }
}

fn crowd(count: usize) -> Sheet {
    let corners = vec![[-0.2, -0.2], [0.2, -0.2], [0.2, 0.2], [-0.2, 0.2]];
    let body = FreeBodyDiagram::new(Label::plain("crate"), Pose::default(), vec![Outline::Polygon(corners)]);
    let body = (0..count).fold(body, |body, i| {
        let angle = 0.7 + 2.399963 * i as f64;
        let size = 20.0 + 3.0 * i as f64;
        let symbol = Label::symbol(&format!("F{i}"));
        let kind = [Kind::Applied, Kind::Contact, Kind::Spring][i % 3];
        body.force(Arrow::new(kind, symbol, [0.2, 0.2], [size * angle.cos(), size * angle.sin()]))
    });
    Sheet { title: Label::plain("A crowd of forces at one corner"), ..Sheet::of(body) }
}

fn extremes() -> Sheet {
    let body = |x: f64| {
        FreeBodyDiagram::new(Label::plain("a < b & \"c\" ]]>"), Pose { x, ..Pose::default() }, vec![rod(1.0)])
            .heading(Label::plain("a < b & \"c\" ]]>"))
            .force(Arrow::new(Kind::Weight, Label::symbol("m"), [x, 0.0], [0.0, -1e-12]))
            .force(Arrow::new(Kind::Applied, Label::symbol("F"), [x, 0.0], [1e9, 1e9]))
            .force(Arrow::new(Kind::Air, Label::default(), [x, 0.0], [f64::NAN, 0.0]))
            .force(Arrow::new(Kind::Spring, Label::default(), [x, 0.0], [0.0, 0.0]))
            .couple(Couple::new(Kind::Reaction, Label::symbol("M"), 1e-12))
    };
    let point =
        FreeBodyDiagram::new(Label::plain("point"), Pose::default(), vec![Outline::Point([0.0, 0.0])]);
    let none =
        FreeBodyDiagram::new(Label::plain("none"), Pose { x: f64::NAN, ..Pose::default() }, Vec::new());
    let panels = vec![body(0.0), body(1e12), point.clone().force(weight(1.0, [0.0, 0.0])), none];
    Sheet::new(Label::plain("Extremes"), panels)
}

fn many(count: usize) -> Sheet {
    let panel = |i: usize| {
        let angle = 0.5 * i as f64;
        let pose = Pose { t: 0.1 * i as f64, x: 0.8 * i as f64, y: 1.5, angle };
        let drag = [-1.2 - 0.2 * i as f64, 0.6 * angle.sin()];
        FreeBodyDiagram::new(Label::plain("rod"), pose, vec![rod(1.0)])
            .heading(Label::equation("t", &format!("{:.1}", pose.t), "s"))
            .force(weight(0.5, pose.centre()))
            .force(Arrow::new(Kind::Air, Label::symbol("F_air"), pose.centre(), drag))
            .couple(Couple::new(Kind::Air, Label::symbol("tau_air"), -0.2 - 0.01 * i as f64))
            .angle(AngleMark::horizontal(Label::symbol("theta"), angle))
    };
    Sheet::new(Label::plain("A thrown rod"), (0..count).map(panel).collect())
}
