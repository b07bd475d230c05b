use crate::report::*;
use tumble_drawing::curves::{CurveFigure, DataSeries, Mark};
use tumble_drawing::free_body::{Ground, NamedPoint};
use tumble_drawing::outline::{Outline, Pose};
use tumble_drawing::svg::Svg;
use tumble_drawing::{Animation, Axis, Label, MovingBody, MovingCase, MovingForce, MovingLink};

/// Ends every kind of context that it could stand in.
const HOSTILE: &str = "</script></style></title></svg></math><script>alert(1)</script><img src=x onerror=alert(1)>\"'><!--\u{2028}]]>";

fn words() -> Text {
    Text::from(HOSTILE).and(Label::plain(HOSTILE)).and(formula())
}

fn label() -> Label {
    Label::plain(HOSTILE)
}

fn formula() -> Typeset {
    let [symbol, text] =
        [tumble_notation::Math::symbol(HOSTILE), tumble_notation::Math::Text(HOSTILE.to_owned())];
    (&tumble_notation::Math::Row(vec![symbol, text])).into()
}

fn picture() -> Picture {
    Picture::new(Svg::new(10.0, 10.0, HOSTILE).described(HOSTILE), words()).stored(HOSTILE)
}

fn curve(label: Label, points: Vec<[f64; 2]>) -> DataSeries {
    DataSeries { label, points, dotted: false }
}

fn plot() -> Chart {
    let axis = || Axis::new(label(), HOSTILE);
    let mut figure = CurveFigure::new(label(), axis(), axis());
    figure.series.push(curve(label(), vec![[0.0, 1.0], [1.0, 2.0]]));
    figure.marks.push(Mark { at: 0.5, label: label() });
    Chart { description: HOSTILE.into(), ..Chart::over_time(figure, words()).stored(HOSTILE) }
}

fn table() -> PrintedTable {
    let row = vec![words(), words()];
    PrintedTable {
        notes: vec![words()],
        ..PrintedTable::new(words(), vec![Column::words(words()), Column::numbers(words())])
    }
    .row(row)
}

fn quantity() -> QuantityRow {
    let (name, symbol, value, note) = (words(), words(), words(), words());
    QuantityRow { name, symbol, value, unit: HOSTILE.into(), formula: Some(formula()), note }
}

fn block() -> Block {
    let definition = Definition { symbol: formula(), meaning: words() };
    Block { title: words(), lines: vec![formula()], definitions: vec![definition] }
}

fn motion() -> MovingCase {
    let body = MovingBody {
        name: label(),
        outlines: vec![Outline::Point([0.0, 0.0])],
        poses: vec![Pose::default(), Pose { x: 1.0, ..Pose::default() }],
        trail: true,
    };
    let force =
        MovingForce { symbol: label(), samples: vec![[[0.0; 2], [1.0, 0.0]]], ..MovingForce::default() };
    MovingCase {
        name: label(),
        values: vec![(HOSTILE.into(), 1.0)],
        times: vec![0.0, 1.0],
        bodies: vec![body],
        links: vec![MovingLink { name: label(), ends: vec![[[0.0; 2], [1.0; 2]]], ..MovingLink::default() }],
        forces: vec![force],
        surfaces: vec![Ground::new([0.0; 2], [0.0, 1.0], label())],
        points: vec![NamedPoint { name: label(), at: [0.0; 2] }],
        events: vec![Mark { at: 0.5, label: label() }],
    }
}

fn check() -> CheckRow {
    CheckRow {
        what: words(),
        expected: words(),
        found: words(),
        within: words(),
        passed: false,
        is_sure: true,
        is_of_other_values: false,
    }
}

fn case() -> RunAnalysis {
    let balance = BalancePart { intro: vec![words()], tables: vec![table()], plots: vec![plot()] };
    RunAnalysis {
        name: label(),
        intro: vec![words()],
        plots: vec![plot()],
        pictures: vec![picture()],
        balance: Some(balance),
        tables: vec![table()],
        checks: vec![check()],
    }
}

/// A report with hostile text in every field.
fn hostile() -> Report {
    let force = ForceRow {
        name: words(),
        symbol: formula(),
        law: vec![formula(), formula()],
        point: words(),
        torque: vec![formula()],
    };
    Report {
        title: HOSTILE.into(),
        lead: words(),
        lesson: Some(HOSTILE.into()),
        language: HOSTILE.into(),
        intro: vec![words()],
        meta: vec![(HOSTILE.into(), HOSTILE.into())],
        lab: Some(Lab {
            engine: b"engine",
            name: HOSTILE.into(),
            scene: HOSTILE.into(),
            files: vec![(HOSTILE.into(), HOSTILE.into())],
            set: vec![(HOSTILE.into(), HOSTILE.into())],
            play: "{}".into(),
            templates: vec![(HOSTILE, HOSTILE)],
        }),
        ways: None,
        identify: Identify {
            intro: vec![words()],
            scene: Some(picture()),
            bodies: vec![BodyRow { name: words(), shape: words(), properties: vec![quantity()] }],
            parameters: vec![quantity()],
            initial: vec![quantity()],
            sought: vec![words()],
        },
        model: ModelPart {
            intro: vec![words()],
            assumptions: vec![words()],
            bodies: vec![BodyModel {
                name: words(),
                diagrams: vec![picture()],
                forces: vec![force.clone()],
                impulses: vec![force],
                laws: vec![block()],
            }],
            modes: vec![ModeEquations { name: words(), holds: words(), equations: vec![block()] }],
            impacts: vec![block()],
        },
        solve: Solve {
            intro: vec![words()],
            phases: vec![Phase {
                name: words(),
                span: words(),
                symbols: vec![block()],
                numbers: vec![block()],
            }],
            method: vec![(words(), words())],
            tables: vec![table()],
        },
        analyze: Analyze {
            intro: vec![words()],
            animation: Some(Animation {
                title: label(),
                description: HOSTILE.into(),
                cases: vec![motion(), motion()],
                speed: f64::NAN,
            }),
            plots: vec![plot()],
            pictures: vec![picture()],
            comparison: Some(table()),
            cases: vec![case(), case()],
            checks: vec![check()],
            findings: vec![words()],
        },
    }
}

/// The page without what is ours: the tags of scripts, of the engine and of their data.
fn foreign(html: &str) -> String {
    const OURS: [&str; 6] = [
        "<script type=\"application/json\" id=\"report-data\">",
        "<script type=\"text/plain\" id=\"lab-engine\">",
        "<script type=\"application/json\" id=\"lab-data\">",
        "<script type=\"text/plain\" id=\"lab-worker\">",
        "<script>\n",
        "<script>\n",
    ];
    let html = OURS.iter().fold(html.to_owned(), |html, tag| html.replacen(tag, "", 1));
    // What a scene says never ends a line in ours.
    html.replacen("</script>\n", "", OURS.len())
}

#[test]
fn nothing_from_a_scene_is_run() {
    let html = foreign(&hostile().html());
    let lower = html.to_ascii_lowercase();
    for tag in ["<script", "</script", "<img", "<!--", "]]>\""] {
        assert!(!lower.contains(tag), "{tag}");
    }
    assert!(html.contains("&lt;script&gt;alert(1)&lt;/script&gt;"), "it is shown");
    assert_eq!(lower.matches("</style").count(), 1);
    assert_eq!(lower.matches("</title").count(), 1 + lower.matches("<title id=").count());
}

#[test]
fn nothing_from_a_scene_is_markup_in_markdown() {
    let shown = hostile().markdown();
    for tag in ["<script", "</script", "<img", "<!--", "\u{2028}"] {
        assert!(!shown.contains(tag), "{tag}");
    }
}

#[test]
fn the_data_is_json_and_complete() {
    let html = hostile().html();
    let start = html.find("id=\"report-data\">").expect("the data") + "id=\"report-data\">".len();
    let data = &html[start..start + html[start..].find("</script>").expect("its end")];
    assert!(!data.contains(['<', '>', '&', '\u{2028}']) && !data.contains("NaN"));
    assert_eq!(data.matches("\"dashes\":\"\",\"dotted\":").count(), 5, "a curve for every plot");
    assert_eq!(data.matches("\"times\":").count(), 2);
}

#[test]
fn the_page_needs_no_network() {
    let html = Report::default().html().replace("http://www.w3.org/2000/svg", "");
    // The font of formulas is in the page.
    let html = html.replace("url(\"data:", "");
    for word in ["http:", "https:", "@import", "url(", "src=", "fetch(", "import("] {
        assert!(!html.contains(word), "{word}");
    }
}

#[test]
fn every_figure_has_a_number_and_a_description() {
    let mut report = Report::default();
    let figure = CurveFigure {
        series: vec![curve(Label::default(), vec![[0.0, 2.0], [1.0, -1.5]])],
        ..CurveFigure::new(
            Label::plain("Height"),
            Axis::new(Label::symbol("t"), "s"),
            Axis::new(Label::symbol("y"), "m"),
        )
    };
    report.analyze.plots = vec![Chart::over_time(figure, ""); 2];
    let html = report.html();
    assert_eq!(html.matches("<figure ").count(), 2);
    assert!(html.contains("aria-labelledby=\"figure-2-title\" aria-describedby=\"figure-2-description\""));
    assert!(html.contains("The curve: from 2 to −1.5, between −1.5 and 2 m."));
    assert!(html.contains("Figure 2."));
}

#[test]
fn long_tables_fold_after_twenty_rows() {
    let row = |i: usize| vec![i.to_string().into()];
    let mut table = PrintedTable::new("Events", vec![Column::numbers("No.")]);
    table.rows = (0..20).map(row).collect();
    let mut report = Report { solve: Solve { tables: vec![table], ..Solve::default() }, ..Report::default() };
    assert!(!report.html().contains("data-long>"));
    report.solve.tables[0].rows.push(row(20));
    assert_eq!(report.html().matches("<tr class=\"more\">").count(), 1);
}

#[test]
fn long_tables_stand_in_columns_on_paper_and_say_where_hundreds_of_rows_are() {
    let page = |count: usize, cell: &str, file: Option<&str>| {
        let mut table = PrintedTable::new("Events", vec![Column::numbers("No."), Column::words("What")]);
        table.rows = (0..count).map(|i| vec![i.to_string().into(), cell.into()]).collect();
        table.file = file.map(str::to_owned);
        Report { solve: Solve { tables: vec![table], ..Solve::default() }, ..Report::default() }.html()
    };
    let sentence = "all are in run-001/events.csv";
    let file = Some("run-001/events.csv");
    assert!(
        page(300, "the tip strikes the floor", file)
            .contains("<div class=\"long\" style=\"--beside:3\">\n<p class=\"caption paper\">")
    );
    assert!(!page(300, "", file).contains(sentence));
    let is_in_columns =
        |count: usize, file: Option<&str>| page(count, "", file).contains("<div class=\"long\"");
    assert!(is_in_columns(9, file) && !is_in_columns(8, file) && !is_in_columns(20, None));
    assert!(page(301, &"long ".repeat(12), file).contains("<div class=\"long filed\" style=\"--beside:2\">"));
    assert!(page(301, "", file).contains(sentence));
    // Nowhere else: paper has them all.
    assert!(page(2000, &"long ".repeat(30), None).contains("<div class=\"long\" style=\"--beside:1\">"));
}

#[test]
fn formulas_speak() {
    let math = Typeset::from(&tumble_notation::Math::symbol("theta"));
    let report = Report { intro: vec![math.into()], ..Report::default() };
    assert!(report.html().contains("<span class=\"math\" role=\"math\" aria-label=\"θ\"><math"));
}

#[test]
fn equal_reports_give_equal_bytes() {
    assert_eq!(hostile().html(), hostile().html());
    assert_eq!(hostile().markdown(), hostile().markdown());
}

#[test]
fn remarks_and_indents_of_scripts_are_not_mailed() {
    let script = "// What it is.\n  /** One. */\n  one(); // here\n";
    assert_eq!(super::page::joined(&[script, "two(\"//\");\n"]), "one(); // here\ntwo(\"//\");\n");
}

#[test]
fn what_is_expected_of_other_values_has_not_failed() {
    let page = |is_of_other_values: bool| {
        let mut report = Report::default();
        report.analyze.checks = vec![CheckRow { is_of_other_values, ..check() }];
        report.html()
    };
    let [own, other] = [false, true].map(page);
    assert!(own.contains("1 of 1 checks failed.") && !own.contains(rows::OF_OTHER_VALUES));
    assert!(!other.contains("checks failed.") && other.contains(rows::OF_OTHER_VALUES));
}

#[test]
fn equations_that_are_explained_may_break() {
    let explained = |symbol: &str| {
        let symbol = Typeset { text: symbol.to_owned(), ..formula() };
        let definitions = vec![Definition { symbol, meaning: "the disk stays on the incline".into() }];
        let block = Block { definitions, ..Block::default() };
        let impacts = ModelPart { impacts: vec![block], ..ModelPart::default() };
        Report { model: impacts, ..Report::default() }.html()
    };
    assert!(
        explained("A_y = 0").contains("<dt class=\"line\">")
            && !explained("A_y").contains("<dt class=\"line\">")
    );
}
