//! Writes a report from made-up data as a page, as Markdown and as a moving picture into a directory:
//! `cargo run -p tumble-report --example report -- DIR`.

use std::error::Error;
use std::f64::consts::{FRAC_PI_2, TAU};
use std::fs;
use std::path::PathBuf;

use tumble_report::free_body::{AngleMark, Arrow, FreeBody, Kind, NamedPoint, Sheet, Surface};
use tumble_report::report::{
    Analyze, Animation, Balance, Block, BodyModel, BodyRow, Case, Check, Column, Definition, ForceRow,
    Identify, Math, Mode, Model, Motion, MovingBody, MovingForce, MovingLink, Phase, Picture, Plot, Quantity,
    Report, Solve, Table, Text,
};
use tumble_report::{
    Axis, CurveFigure, Label, Mark, Outline, Pose, SceneBody, SceneDrawing, Stroboscope, Track, animation_gif,
};

const G: f64 = 9.81;
/// Half the length of the bouncing rod and of the pendulum, in metres.
const HALF: f64 = 0.5;
const MASS: f64 = 0.5;
const PIVOT: [f64; 2] = [-1.2, 2.2];
const DURATION: f64 = 3.0;
const STEPS: usize = 3000;
const CASES: [f64; 2] = [1.0, 0.7];

fn main() -> Result<(), Box<dyn Error>> {
    let directory = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "report".to_owned()));
    fs::create_dir_all(&directory)?;
    let report = report();
    fs::write(directory.join("report.html"), report.html())?;
    fs::write(directory.join("report.md"), report.markdown())?;
    let animation = report.analyze.animation.as_ref().ok_or("the report has a motion")?;
    fs::write(directory.join("motion.gif"), animation_gif(animation, 1, 560, 20.0)?)?;
    Ok(())
}

/// One run: states of rod and pendulum, and the impacts of the rod.
struct Run {
    restitution: f64,
    samples: Vec<Sample>,
    impacts: Vec<Impact>,
}

#[derive(Clone, Copy)]
struct Sample {
    rod: Pose,
    velocity: [f64; 2],
    rate: f64,
    pendulum: Pose,
    swing: f64,
}

#[derive(Clone, Copy)]
struct Impact {
    at: f64,
    left: bool,
    impulse: f64,
}

/// Free flight and impacts without friction; a small-angle pendulum beside it. Made up, not integrated.
fn run(restitution: f64) -> Run {
    let mut rod = Pose { t: 0.0, x: 0.0, y: 2.0, angle: 0.6 };
    let ([vx, mut vy], mut rate) = ([0.9, 0.0], 2.0);
    let (mut samples, mut impacts) = (Vec::new(), Vec::new());
    let h = DURATION / STEPS as f64;
    for i in 0..=STEPS {
        let t = i as f64 * h;
        rod.t = t;
        let swing = 0.5 * (3.836 * t).cos();
        let hang = [PIVOT[0] + HALF * swing.sin(), PIVOT[1] - HALF * swing.cos()];
        let pendulum = Pose { t, x: hang[0], y: hang[1], angle: swing - FRAC_PI_2 };
        samples.push(Sample { rod, velocity: [vx, vy], rate, pendulum, swing });
        rod = Pose { t, x: rod.x + h * vx, y: rod.y + h * vy - 0.5 * G * h * h, angle: rod.angle + h * rate };
        vy -= G * h;
        for side in [-1.0, 1.0] {
            let end = [side * HALF * rod.angle.cos(), side * HALF * rod.angle.sin()];
            let sinking = vy + rate * end[0];
            if rod.y + end[1] < 0.0 && sinking < 0.0 {
                let inertia = MASS * HALF * HALF / 3.0;
                let impulse = -(1.0 + restitution) * sinking / (1.0 / MASS + end[0] * end[0] / inertia);
                vy += impulse / MASS;
                rate += end[0] * impulse / inertia;
                impacts.push(Impact { at: t + h, left: side * end[0] < 0.0, impulse });
            }
        }
    }
    Run { restitution, samples, impacts }
}

fn math(mathml: &str, latex: &str, text: &str) -> Math {
    let mathml = format!("<math xmlns=\"http://www.w3.org/1998/Math/MathML\"><mrow>{mathml}</mrow></math>");
    Math { mathml, latex: latex.to_owned(), text: text.to_owned() }
}

fn symbol(head: &str, latex: &str) -> Math {
    math(&format!("<mi>{head}</mi>"), latex, head)
}

fn weight() -> Math {
    math("<mi>m</mi><mo>&#x2062;</mo><mi>g</mi>", "m g", "m g")
}

fn report() -> Report {
    let runs = CASES.map(run);
    Report {
        lesson: None,
        title: "A rod that bounces beside a pendulum".to_owned(),
        language: "en".to_owned(),
        intro: vec!["A rod falls turning onto a floor without friction and bounces. A pendulum with a spring swings beside it. How do the impacts depend on the restitution?".into()],
        meta: vec![("Program".into(), "tumble 0.1.0, example with made-up data".into()), ("Scene".into(), "bouncing-rod.toml".into())],
        math_font_css: None,
        identify: identify(),
        model: model(),
        solve: solve(&runs),
        analyze: analyze(&runs),
    }
}

fn rod_shape() -> Vec<Outline> {
    vec![Outline::Segment { from: [-HALF, 0.0], to: [HALF, 0.0] }]
}

fn floor() -> Surface {
    Surface::new([0.0, 0.0], [0.0, 1.0], Label::plain("floor"))
}

fn scene() -> SceneDrawing {
    let start = run(1.0).samples[0];
    let rod = SceneBody {
        name: Label::plain("rod"),
        pose: start.rod,
        outlines: rod_shape(),
        velocity: Some((start.velocity, Label::equation("v0", "0.9", "m/s"))),
        rate: Some((start.rate, Label::equation("omega0", "2", "rad/s"))),
    };
    let pendulum = SceneBody {
        name: Label::plain("pendulum"),
        pose: start.pendulum,
        outlines: rod_shape(),
        ..SceneBody::default()
    };
    SceneDrawing {
        title: Label::plain("The scene at the start"),
        bodies: vec![rod, pendulum],
        surfaces: vec![floor()],
        pivots: vec![NamedPoint { name: Label::symbol("A"), at: PIVOT }],
        points: vec![NamedPoint { name: Label::symbol("B"), at: start.rod.world([-HALF, 0.0]) }],
        links: vec![tumble_report::SceneLink {
            name: Label::symbol("k"),
            ends: [[-2.0, 1.2], start.pendulum.world([HALF, 0.0])],
            ..Default::default()
        }],
        angles: vec![AngleMark::horizontal(Label::symbol("theta0"), start.rod.angle)],
        gravity: Some(([0.0, -G], Label::symbol("g"))),
        wind: Some(([2.0, 0.0], Label::equation("w", "2", "m/s"))),
    }
}

fn identify() -> Identify {
    let inertia = math(
        "<mi>I</mi><mo>=</mo><mfrac><mrow><mi>m</mi><msup><mi>L</mi><mn>2</mn></msup></mrow><mn>12</mn></mfrac>",
        "I = \\frac{m L^2}{12}",
        "I = m L^2 / 12",
    );
    let middle = math("<mi>L</mi><mo>/</mo><mn>2</mn>", "L/2", "L/2");
    let body = |name: &str| BodyRow {
        name: name.into(),
        shape: "uniform slender rod".into(),
        properties: vec![
            Quantity::number("mass", "m", MASS, "kg"),
            Quantity::number("centre of mass from the end", "c", HALF, "m").by(middle.clone()),
            Quantity::number("moment of inertia", "I", MASS / 12.0, "kg*m^2").by(inertia.clone()),
        ],
    };
    Identify {
        intro: vec![
            Text::words("Two rods of one metre. One is free, the other hangs in the pivot ")
                .and(Text::symbol("A"))
                .and(" and is held by a spring."),
        ],
        scene: Some(Picture::new(scene().svg(), "The scene at the start, to scale.").stored("scene.svg")),
        bodies: vec![body("rod"), body("pendulum")],
        parameters: vec![
            Quantity::number("length of the rods", "L", 2.0 * HALF, "m"),
            Quantity::number("acceleration of gravity", "g", G, "m/s^2"),
            Quantity::number("stiffness of the spring", "k", 12_500.0, "N/m"),
            Quantity {
                name: "restitution".into(),
                symbol: Text::symbol("epsilon"),
                value: "1 and 0.7".into(),
                note: "one case each".into(),
                ..Quantity::default()
            },
        ],
        initial: vec![
            Quantity::number("height of the rod's centre", "y0", 2.0, "m"),
            Quantity::number("angle of the rod", "theta0", 0.6, "rad")
                .noted("counter-clockwise from the x axis"),
            Quantity::number("speed of the rod's centre", "v0", 0.9, "m/s"),
            Quantity::number("angular velocity", "omega0", 2.0, "rad/s"),
        ],
        sought: vec![
            "the times of the impacts".into(),
            Text::words("the energy that is lost, as a function of ").and(Text::symbol("epsilon")),
        ],
    }
}

fn diagram() -> Picture {
    let flying = Pose { t: 0.3, x: 0.3, y: 1.5, angle: 1.2 };
    let touching = Pose { t: 0.55, x: 0.5, y: 0.42, angle: 1.0 };
    let free = |pose: Pose, heading: &str| {
        let force = Arrow::new(Kind::Weight, Label::markup("$m$ $g$"), pose.centre(), [0.0, -MASS * G]);
        FreeBody::new(Label::plain("rod"), pose, rod_shape()).heading(Label::plain(heading)).force(force)
    };
    let normal = Arrow::new(Kind::Contact, Label::symbol("N"), touching.world([-HALF, 0.0]), [0.0, 38.0]);
    let panels = vec![free(flying, "in flight"), free(touching, "touching").surface(floor()).force(normal)];
    Picture::new(
        Sheet::new(Label::plain("Free-body diagrams of the rod"), panels).svg(),
        "Forces on the rod with their points of action.",
    )
    .stored("free-body.svg")
}

fn forces() -> Vec<ForceRow> {
    vec![
        ForceRow {
            name: "weight".into(),
            symbol: symbol("W", "W"),
            law: vec![weight()],
            point: "centre of mass".into(),
            torque: vec![symbol("0", "0")],
        },
        ForceRow {
            name: "normal force of the floor".into(),
            symbol: symbol("N", "N"),
            law: vec![math("<mi>N</mi><mo>≥</mo><mn>0</mn>", "N \\ge 0", "N >= 0")],
            point: "lower end".into(),
            torque: vec![math(
                "<mo>−</mo><mfrac><mi>L</mi><mn>2</mn></mfrac><mi>N</mi><mi>cos</mi><mi>θ</mi>",
                "-\\frac{L}{2} N \\cos\\theta",
                "- L/2 N cos theta",
            )],
        },
    ]
}

fn second_law() -> Math {
    math(
        "<mi>m</mi><mo>&#x2062;</mo><mover accent=\"true\"><mi>y</mi><mo>¨</mo></mover><mo>=</mo><mi>N</mi><mo>−</mo><mi>m</mi><mo>&#x2062;</mo><mi>g</mi>",
        "m \\ddot y = N - m g",
        "m y'' = N - m g",
    )
}

fn turning_law() -> Math {
    math(
        "<mi>I</mi><mo>&#x2062;</mo><mover accent=\"true\"><mi>θ</mi><mo>¨</mo></mover><mo>=</mo><mo>−</mo><mfrac><mi>L</mi><mn>2</mn></mfrac><mo>&#x2062;</mo><mi>N</mi><mo>&#x2062;</mo><mi>cos</mi><mo>&#x2061;</mo><mi>θ</mi>",
        "I \\ddot\\theta = -\\frac{L}{2} N \\cos\\theta",
        "I theta'' = - L/2 N cos theta",
    )
}

fn model() -> Model {
    let laws = Block {
        title: "Newton's second law and its counterpart for turning".into(),
        lines: vec![second_law(), turning_law()],
        definitions: vec![
            Definition { symbol: symbol("N", "N"), meaning: "normal force at the lower end, N".into() },
            Definition {
                symbol: symbol("θ", "\\theta"),
                meaning: "angle of the rod from the x axis, rad".into(),
            },
        ],
    };
    let flight = Block {
        lines: vec![math(
            "<mover accent=\"true\"><mi>y</mi><mo>¨</mo></mover><mo>=</mo><mo>−</mo><mi>g</mi><mo>,</mo><mspace width=\"1em\"/><mover accent=\"true\"><mi>θ</mi><mo>¨</mo></mover><mo>=</mo><mn>0</mn>",
            "\\ddot y = -g,\\quad \\ddot\\theta = 0",
            "y'' = -g, theta'' = 0",
        )],
        ..Block::default()
    };
    Model {
        intro: vec!["Each body is set free from the others.".into()],
        assumptions: vec![
            "The floor is smooth: it pushes along its normal only.".into(),
            "Impacts take no time.".into(),
        ],
        bodies: vec![BodyModel {
            name: "Rod".into(),
            diagrams: vec![diagram()],
            forces: forces(),
            laws: vec![laws.clone()],
        }],
        modes: vec![
            Mode {
                name: "Flight".into(),
                holds: "while both ends are above the floor".into(),
                equations: vec![flight],
            },
            Mode {
                name: "Left end on the floor".into(),
                holds: Text::words("while ").and(math("<mi>N</mi><mo>&gt;</mo><mn>0</mn>", "N > 0", "N > 0")),
                equations: vec![Block { definitions: Vec::new(), title: Text::default(), ..laws }],
            },
        ],
    }
}

fn solve(runs: &[Run]) -> Solve {
    let closed = math(
        "<mi>y</mi><mo>(</mo><mi>t</mi><mo>)</mo><mo>=</mo><msub><mi>y</mi><mn>0</mn></msub><mo>−</mo><mfrac><mn>1</mn><mn>2</mn></mfrac><mi>g</mi><msup><mi>t</mi><mn>2</mn></msup>",
        "y(t) = y_0 - \\frac12 g t^2",
        "y(t) = y0 - 1/2 g t^2",
    );
    let numbers = math(
        "<mi>y</mi><mo>=</mo><mn>2</mn><mo>−</mo><mn>4.905</mn><msup><mi>t</mi><mn>2</mn></msup>",
        "y = 2 - 4.905\\,t^2",
        "y = 2 - 4.905 t^2",
    );
    let block = |line: Math| vec![Block { lines: vec![line], ..Block::default() }];
    Solve {
        intro: vec!["Between impacts the rod flies freely, which has a closed form. The rest was integrated by Taylor steps.".into()],
        phases: vec![Phase { name: "First flight".into(), span: "from 0 to the first impact".into(), symbols: block(closed), numbers: block(numbers) }],
        method: [("accuracy asked for", "10⁻⁹"), ("order", "18"), ("steps", "212"), ("rejected steps", "0"), ("impacts in case 1", &runs[0].impacts.len().to_string())].map(|(a, b)| (a.into(), b.into())).to_vec(),
        tables: runs.iter().map(events).collect(),
    }
}

fn events(run: &Run) -> Table {
    let columns = vec![
        Column::numbers("No."),
        Column::numbers("t (s)"),
        Column::words("end"),
        Column::numbers("impulse (N s)"),
        Column::words("mode after"),
    ];
    let caption = Text::words("Impacts for ").and(name(run));
    let row = |(i, impact): (usize, &Impact)| {
        let end = if impact.left { "left" } else { "right" };
        let cells = [
            (i + 1).to_string(),
            format!("{:.4}", impact.at),
            end.to_owned(),
            format!("{:.4}", impact.impulse),
            "flight".to_owned(),
        ];
        cells.map(Text::from).to_vec()
    };
    // Repeated, to see a long table.
    let rows = run.impacts.iter().cycle().take(4 * run.impacts.len()).enumerate().map(row);
    Table {
        rows: rows.collect(),
        notes: vec!["Times are those of the impacts' beginnings.".into()],
        ..Table::new(caption, columns)
    }
}

fn name(run: &Run) -> Label {
    Label::equation("epsilon", &run.restitution.to_string(), "")
}

fn time() -> Axis {
    Axis::new(Label::symbol("t"), "s")
}

fn curve(run: &Run, of: impl Fn(&Sample) -> f64) -> Vec<[f64; 2]> {
    run.samples.iter().step_by(3).map(|s| [s.rod.t, of(s)]).collect()
}

fn overlay(runs: &[Run], title: &str, y: Axis, of: impl Fn(&Sample) -> f64 + Copy) -> CurveFigure {
    let figure = CurveFigure::new(Label::plain(title), time(), y);
    runs.iter().fold(figure, |figure, run| figure.series(name(run), curve(run, of)))
}

fn analyze(runs: &[Run]) -> Analyze {
    let height = overlay(runs, "Height of the rod's centre", Axis::new(Label::symbol("y"), "m"), |s| s.rod.y);
    let angle =
        overlay(runs, "Angle of the rod", Axis::new(Label::symbol("theta"), "rad").in_pi(), |s| s.rod.angle);
    let phase = CurveFigure::new(
        Label::plain("Phase plane of the pendulum"),
        Axis::new(Label::symbol("phi"), "rad"),
        Axis::new(Label::symbol("omega_phi"), "rad/s"),
    )
    .series(
        Label::default(),
        runs[0].samples.iter().map(|s| [s.swing, -0.5 * 3.836 * (3.836 * s.rod.t).sin()]).collect(),
    );
    Analyze {
        intro: vec![],
        animation: Some(animation(runs)),
        plots: vec![
            Plot::over_time(height, "Both cases fall alike until the first impact.").stored("height.svg"),
            Plot::over_time(angle, "Each impact changes the rate of turning.").stored("angle.svg"),
            Plot::new(phase, "The pendulum does not care.").stored("phase.svg"),
        ],
        pictures: vec![Picture::new(strobe(runs).svg(), "Every quarter of a second.").stored("path.svg")],
        comparison: Some(comparison(runs)),
        cases: runs.iter().map(case).collect(),
        checks: vec![check("first impact does not depend on ε", "0.5539 s", "0.5540 s", true)],
        findings: vec![
            Text::words("With ")
                .and(name(&runs[1]))
                .and(" the rod has lost most of its energy after three impacts."),
            "Without loss the heights of the bounces follow no order.".into(),
        ],
    }
}

fn check(what: &str, expected: &str, found: &str, passed: bool) -> Check {
    Check {
        what: what.into(),
        expected: expected.into(),
        found: found.into(),
        within: "0.001".into(),
        passed,
    }
}

fn comparison(runs: &[Run]) -> Table {
    let mut columns = vec![Column::words("Result")];
    columns.extend(runs.iter().map(|run| Column::numbers(name(run))));
    let row = |what: &str, of: &dyn Fn(&Run) -> String| {
        std::iter::once(what.into()).chain(runs.iter().map(|run| of(run).into())).collect()
    };
    Table::new("What the restitution changes", columns)
        .row(row("impacts", &|run| run.impacts.len().to_string()))
        .row(row("energy lost (J)", &|run| {
            format!("{:.3}", energy(&run.samples[0]) - energy(&run.samples[STEPS]))
        }))
        .row(row("angle at the end (rad)", &|run| format!("{:.3}", run.samples[STEPS].rod.angle)))
}

fn energy(s: &Sample) -> f64 {
    let [vx, vy] = s.velocity;
    0.5 * MASS * (vx * vx + vy * vy) + MASS * G * s.rod.y + MASS / 24.0 * s.rate * s.rate
}

fn strobe(runs: &[Run]) -> Stroboscope {
    let track = |run: &Run| Track {
        label: name(run),
        shapes: rod_shape(),
        poses: run.samples.iter().step_by(250).map(|s| s.rod).collect(),
        trace: run.samples.iter().map(|s| s.rod.centre()).collect(),
    };
    Stroboscope {
        title: Label::plain("Paths of the rod"),
        tracks: runs.iter().map(track).collect(),
        surfaces: vec![floor()],
        ..Stroboscope::default()
    }
}

fn case(run: &Run) -> Case {
    let kinetic = |s: &Sample| energy(s) - MASS * G * s.rod.y;
    let joule = || Axis::new(Label::symbol("E"), "J");
    let mut energies = CurveFigure::new(Label::plain("Energy"), time(), joule())
        .series(Label::plain("total"), curve(run, energy))
        .series(Label::plain("kinetic"), curve(run, kinetic))
        .series(Label::plain("potential"), curve(run, |s| MASS * G * s.rod.y));
    energies.marks = marks(run);
    let residual = CurveFigure::new(Label::plain("Residual of the balance"), time(), joule())
        .series(Label::default(), curve(run, |s| 1e-13 * (40.0 * s.rod.t).sin() * s.rod.t));
    let columns = vec![
        Column::words("Book"),
        Column::numbers("start"),
        Column::numbers("flowed in"),
        Column::numbers("end"),
        Column::numbers("residual"),
    ];
    let [start, end] = [energy(&run.samples[0]), energy(&run.samples[STEPS])];
    let row = [
        "energy (J)".to_owned(),
        format!("{start:.4}"),
        format!("{:.4}", end - start),
        format!("{end:.4}"),
        "2.1×10⁻¹³".to_owned(),
    ];
    Case {
        name: name(run),
        intro: vec![Text::words(format!("{} impacts in three seconds.", run.impacts.len()))],
        balance: Some(Balance {
            intro: vec![],
            tables: vec![Table::new("Balance over the whole run", columns).row(row.map(Text::from).to_vec())],
            plots: vec![
                Plot::over_time(energies, "Energies; dotted lines are impacts."),
                Plot::over_time(residual, "What the balance does not explain."),
            ],
        }),
        checks: vec![check("energy at the end", "9.81 J", "9.8100 J", run.restitution == 1.0)],
        ..Case::default()
    }
}

fn marks(run: &Run) -> Vec<Mark> {
    run.impacts.iter().map(|impact| Mark { at: impact.at, label: Label::default() }).collect()
}

fn animation(runs: &[Run]) -> Animation {
    Animation {
        title: Label::plain("The motion; click it or press Play."),
        cases: runs.iter().map(motion).collect(),
        speed: 0.5,
        ..Animation::default()
    }
}

fn motion(run: &Run) -> Motion {
    let samples: Vec<Sample> = run.samples.iter().step_by(5).copied().collect();
    let body = |name: &str, trail: bool, of: &dyn Fn(&Sample) -> Pose| MovingBody {
        name: Label::plain(name),
        outlines: rod_shape(),
        poses: samples.iter().map(of).collect(),
        trail,
    };
    let push = |s: &Sample| {
        let hit = run.impacts.iter().find(|impact| (impact.at - s.rod.t).abs() < 0.01);
        let force = hit.map_or(0.0, |impact| impact.impulse / 0.02);
        let side = if s.rod.angle.sin() > 0.0 { -HALF } else { HALF };
        [s.rod.world([side, 0.0]), [0.0, force]]
    };
    let force = |kind, symbol: Label, of: &dyn Fn(&Sample) -> [[f64; 2]; 2]| MovingForce {
        kind,
        symbol,
        samples: samples.iter().map(of).collect(),
    };
    Motion {
        name: name(run),
        times: samples.iter().map(|s| s.rod.t).collect(),
        bodies: vec![body("rod", true, &|s| s.rod), body("pendulum", false, &|s| s.pendulum)],
        links: vec![MovingLink {
            ends: samples.iter().map(|s| [[-2.0, 1.2], s.pendulum.world([HALF, 0.0])]).collect(),
            ..MovingLink::default()
        }],
        forces: vec![
            force(Kind::Weight, Label::markup("$m$ $g$"), &|s| [s.rod.centre(), [0.0, -MASS * G]]),
            force(Kind::Contact, Label::symbol("N"), &push),
            force(Kind::Reaction, Label::symbol("R"), &|s| [PIVOT, [2.0 * (TAU * s.rod.t).sin(), MASS * G]]),
        ],
        surfaces: vec![floor()],
        points: vec![NamedPoint { name: Label::symbol("A"), at: PIVOT }],
        events: marks(run),
    }
}
