//! Draws a set of varied figures into a directory, as SVG and as PNG:
//! `cargo run -p tumble-drawing --example figures -- DIR`.

use std::error::Error;
use std::f64::consts::{PI, TAU};
use std::fs;
use std::path::{Path, PathBuf};

use tumble_drawing::{
    Axis, BodyPath, CurveFigure, Instants, Label, Outline, Pose, Reference, StroboscopicPicture, Svg, png,
};

const PIXELS: f64 = 2.0;

fn main() -> Result<(), Box<dyn Error>> {
    let directory = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "figures".to_owned()));
    fs::create_dir_all(&directory)?;
    for (name, svg) in all_figures() {
        write_figure(&directory, name, &svg)?;
    }
    Ok(())
}

fn write_figure(directory: &Path, name: &str, svg: &Svg) -> Result<(), Box<dyn Error>> {
    fs::write(directory.join(format!("{name}.svg")), svg.to_string())?;
    fs::write(directory.join(format!("{name}.png")), png(svg, PIXELS)?)?;
    Ok(())
}

fn all_figures() -> Vec<(&'static str, Svg)> {
    vec![
        ("wind", pendulum_in_wind().svg()),
        ("constant", constant().svg()),
        ("tiny", tiny().svg()),
        ("offset", offset().svg()),
        ("phase", phase().svg()),
        ("many", many_series().svg()),
        ("bounces", bounces().svg()),
        ("noise", noise().svg()),
        ("empty", CurveFigure::new(Label::plain("Nothing yet"), time(), angle()).svg()),
        ("flight", thrown_rod().svg()),
        ("flight-numbered", numbered_rod().svg()),
        ("ball", kicked_ball().svg()),
        ("tall", falling_block().svg()),
    ]
}

fn time() -> Axis {
    Axis::new(Label::symbol("t"), "s")
}

fn angle() -> Axis {
    Axis::new(Label::symbol("theta"), "rad")
}

/// Classical Runge-Kutta steps from `state`, `steps` of length `h`; returns all states with their times.
fn march<const N: usize>(
    mut state: [f64; N],
    h: f64,
    steps: usize,
    rate: impl Fn(f64, [f64; N]) -> [f64; N],
) -> Vec<(f64, [f64; N])> {
    let add = |a: [f64; N], b: [f64; N], s: f64| std::array::from_fn(|i| a[i] + s * b[i]);
    let mut states = vec![(0.0, state)];
    for i in 0..steps {
        let t = i as f64 * h;
        let k1 = rate(t, state);
        let k2 = rate(t + h / 2.0, add(state, k1, h / 2.0));
        let k3 = rate(t + h / 2.0, add(state, k2, h / 2.0));
        let k4 = rate(t + h, add(state, k3, h));
        state = std::array::from_fn(|i| state[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
        states.push((t + h, state));
    }
    states
}

/// A uniform rod of 1 m and 1 kg in a wind of period `period`; returns (t, theta).
fn rod_in_wind(period: f64) -> Vec<[f64; 2]> {
    let rate = |t: f64, [theta, omega]: [f64; 2]| {
        let wind = 10.0 * (1.0 + (TAU * t / period).cos());
        let u = [wind - 0.5 * omega * theta.cos(), -0.5 * omega * theta.sin()];
        let drag = 0.02 * u[0].hypot(u[1]);
        let torque = 0.5 * drag * (u[0] * theta.cos() + u[1] * theta.sin()) - 4.905 * theta.sin();
        [omega, 3.0 * torque]
    };
    march([0.0, 0.0], 0.005, 4000, rate).into_iter().map(|(t, s)| [t, s[0]]).collect()
}

fn pendulum_in_wind() -> CurveFigure {
    let figure = CurveFigure::new(Label::plain("Pendulum in a periodic wind"), time(), angle());
    [("0.5", 0.5), ("1", 1.0), ("2", 2.0), ("4", 4.0)].into_iter().fold(figure, |figure, (text, period)| {
        figure.series(Label::equation("T", text, "s"), rod_in_wind(period))
    })
}

fn constant() -> CurveFigure {
    let points = (0..=100).map(|i| [f64::from(i) / 10.0, 9.81 + 1e-15 * f64::from(i % 3)]).collect();
    let y = Axis::new(Label::symbol("a_y"), "m/s^2");
    CurveFigure::new(Label::plain("A constant acceleration"), time(), y).series(Label::default(), points)
}

fn tiny() -> CurveFigure {
    let drift = |i: i32| [f64::from(i), 1.1e-12 * f64::from(i).sqrt() * (1.0 + 0.2 * f64::from(i).sin())];
    let y = Axis::new(Label::symbol("E").then(Label::plain(" − ")).then(Label::symbol("E0")), "J");
    CurveFigure::new(Label::plain("Drift of the energy"), time(), y)
        .series(Label::default(), (0..=1000).map(drift).collect())
}

fn offset() -> CurveFigure {
    let wave = |i: i32| [f64::from(i) / 50.0, 1e6 + 1e-3 * (f64::from(i) / 20.0).sin()];
    let y = Axis::new(Label::symbol("x"), "m");
    CurveFigure::new(Label::plain("A small motion far away"), time(), y)
        .series(Label::default(), (0..=500).map(wave).collect())
}

fn phase() -> CurveFigure {
    let omega = Axis::new(Label::symbol("omega"), "rad/s");
    let figure = CurveFigure::new(Label::plain("Phase plane of a pendulum"), angle().in_pi(), omega);
    [0.5, 1.5, 2.5, 3.1].into_iter().fold(figure, |figure, start: f64| {
        let states = march([start, 0.0], 0.005, 3000, |_, [q, v]| [v, -9.81 * q.sin()]);
        let label = Label::symbol("theta0").then(Label::plain(&format!(" = {start} rad")));
        figure.series(label, states.into_iter().map(|(_, s)| s).collect())
    })
}

fn many_series() -> CurveFigure {
    let title = "Twenty pendulums of different lengths, released together from the same angle and not seen to meet again";
    let figure = CurveFigure::new(Label::plain(title), time(), angle().in_pi());
    (0..20).fold(figure, |figure, i| {
        let omega = 3.0 / (1.0 + 0.02 * f64::from(i));
        let points = (0..=1500).map(|k| [f64::from(k) / 100.0, (omega * f64::from(k) / 100.0).cos()]);
        figure
            .series(Label::equation("L", &format!("{:.2}", 1.0 + 0.04 * f64::from(i)), "m"), points.collect())
    })
}

fn bounces() -> CurveFigure {
    let y = Axis::new(Label::symbol("y"), "m");
    let mut figure = CurveFigure::new(Label::markup("A ball that bounces with $e$ = 0.8"), time(), y);
    let (mut start, mut speed, mut points) = (0.0, 5.0, Vec::new());
    for n in 1..=9 {
        let duration = 2.0 * speed / 9.81;
        let at = |i: i32| duration * f64::from(i) / 50.0;
        points.extend((0..=50).map(|i| [start + at(i), speed * at(i) - 4.905 * at(i) * at(i)]));
        start += duration;
        speed *= 0.8;
        figure = figure.mark(start, Label::symbol("t").with(&n.to_string(), Default::default(), SUBSCRIPT));
    }
    points.push([f64::NAN, 0.0]);
    points.extend([[start + 0.3, 0.5], [start + 0.6, 0.7]]);
    figure.series(Label::plain("height of the centre"), points)
}

const SUBSCRIPT: tumble_drawing::text::Level = tumble_drawing::text::Level::Subscript;

/// A million points.
fn noise() -> CurveFigure {
    let wave = |i: i32| {
        let t = f64::from(i) * 2e-5;
        [t, (1.0 + 0.5 * (0.6 * t).sin()) * (300.0 * t).sin()]
    };
    let y = Axis::new(Label::symbol("F_x"), "kN");
    CurveFigure::new(Label::plain("A million points"), time(), y)
        .series(Label::plain("fast"), (0..1_000_000).map(wave).collect())
        .series(
            Label::plain("slow"),
            (0..=100).map(|i| [f64::from(i) / 5.0, f64::from(i) / 50.0 - 1.0]).collect(),
        )
}

/// The rod of the thrown-rod scene with drag `d` at its centre.
fn rod_flight(label: Label, d: f64, every: usize) -> BodyPath {
    let rate = |_: f64, [_, _, _, vx, vy, w]: [f64; 6]| {
        let drag = d * vx.hypot(vy);
        [vx, vy, w, -drag * vx, -9.81 - drag * vy, -0.3 * w * d * 10.0]
    };
    let states = march([0.0, 1.0, 0.5, 8.5, 7.0, 6.0], 0.005, 310, rate);
    let pose = |(t, s): &(f64, [f64; 6])| Pose { t: *t, x: s[0], y: s[1], angle: s[2] };
    let in_air = |pose: &Pose| pose.y > 0.5 * pose.angle.sin().abs();
    let flight: Vec<_> = states.iter().map(pose).take_while(in_air).collect();
    let poses = flight.iter().step_by(every).copied().collect();
    let trace = flight.iter().map(Pose::centre).collect();
    BodyPath { label, shapes: vec![Outline::Segment { from: [-0.5, 0.0], to: [0.5, 0.0] }], poses, trace }
}

fn thrown_rod() -> StroboscopicPicture {
    StroboscopicPicture {
        title: Label::plain("A thrown rod, every 0.1 s"),
        tracks: vec![
            rod_flight(Label::plain("without air"), 0.0, 20),
            rod_flight(Label::plain("with air resistance"), 0.05, 20),
        ],
        ground: Some(0.0),
        ..StroboscopicPicture::default()
    }
}

fn numbered_rod() -> StroboscopicPicture {
    StroboscopicPicture {
        title: Label::plain("A thrown rod, numbered instants"),
        tracks: vec![rod_flight(Label::default(), 0.02, 30)],
        reference: Reference::ScaleBar,
        instants: Instants::Numbered,
        ..StroboscopicPicture::default()
    }
}

fn kicked_ball() -> StroboscopicPicture {
    let pose = |i: i32| {
        let t = 0.1 * f64::from(i);
        Pose { t, x: 4.65 * t, y: 0.0, angle: -28.8 * t }
    };
    let poses: Vec<_> = (0..=9).map(pose).collect();
    let trace = vec![[0.0, 0.0], [poses[9].x, 0.0]];
    let ball = Outline::Circle { centre: [0.0, 0.0], radius: 0.11 };
    let track = BodyPath { label: Label::default(), shapes: vec![ball], poses, trace };
    StroboscopicPicture {
        title: Label::plain("A kicked ball seen from above"),
        tracks: vec![track],
        ..StroboscopicPicture::default()
    }
}

fn falling_block() -> StroboscopicPicture {
    let pose = |i: i32| {
        let t = 0.2 * f64::from(i);
        Pose { t, x: 0.4 * t, y: 20.0 - 4.905 * t * t, angle: PI * 0.3 * t }
    };
    let poses: Vec<_> = (0..=9).map(pose).collect();
    let trace = poses.iter().map(Pose::centre).collect();
    let block = Outline::Polygon(vec![[-0.6, -0.4], [0.6, -0.4], [0.6, 0.4], [-0.6, 0.4]]);
    let track = BodyPath { label: Label::default(), shapes: vec![block], poses, trace };
    StroboscopicPicture {
        title: Label::plain("A falling block"),
        tracks: vec![track],
        ..StroboscopicPicture::default()
    }
}
