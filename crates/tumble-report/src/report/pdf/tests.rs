use typst::layout::{Abs, Frame, FrameItem, Point, Size};

use super::*;
use crate::report::*;
use crate::svg::{Svg, circle};
use crate::{Axis, CurveFigure, Label};

/// Would be a command, the end of a string, of a formula or of markup.
const HOSTILE: &str = "#panic(\"x\") <script> $ * _ @ \\ ] ) \" // [a] `b` = ~ -- #eval";
/// Rounding of lengths, in points.
const ROUNDING: f64 = 1e-6;

/// What stands where: its page, its left upper corner and its size; a picture has no text.
struct Placed {
    page: usize,
    text: Option<String>,
    at: Point,
    size: Size,
}

struct Shown {
    pages: Vec<Size>,
    placed: Vec<Placed>,
}

impl Shown {
    fn of(report: &Report) -> Self {
        let set = set(report);
        assert!(set.warnings.is_empty(), "{:?}", set.warnings);
        let document = set.output.expect("a document");
        let mut shown = Self { pages: vec![], placed: vec![] };
        for page in document.pages() {
            shown.pages.push(page.frame.size());
            shown.add(&page.frame, Point::zero());
        }
        shown
    }

    fn add(&mut self, frame: &Frame, origin: Point) {
        let page = self.pages.len() - 1;
        for (place, item) in frame.items() {
            let at = origin + *place;
            match item {
                FrameItem::Group(group) => {
                    self.add(&group.frame, at + Point::new(group.transform.tx, group.transform.ty));
                }
                FrameItem::Text(text) => {
                    let size = Size::new(text.width(), Abs::zero());
                    self.placed.push(Placed { page, text: Some(text.text.to_string()), at, size });
                }
                FrameItem::Image(_, size, _) => {
                    self.placed.push(Placed { page, text: None, at, size: *size })
                }
                _ => {}
            }
        }
    }

    /// All text without blanks: lines break anywhere.
    fn text(&self) -> String {
        let all: String = self.placed.iter().filter_map(|placed| placed.text.as_deref()).collect();
        all.split_whitespace().collect()
    }

    fn pictures(&self) -> impl Iterator<Item = &Placed> {
        self.placed.iter().filter(|placed| placed.text.is_none())
    }
}

fn titled() -> Report {
    Report { title: "A rod".into(), language: "en".into(), ..Report::default() }
}

fn drawing(width: f64, height: f64) -> Picture {
    let mut svg = Svg::new(width, height, "A picture");
    svg.push(circle([width / 2.0, height / 2.0], width / 2.0));
    Picture::new(svg, "Its caption, which says what is seen.")
}

#[test]
fn texts_of_every_kind_are_shown_and_not_run() {
    let words = || Text::words(HOSTILE);
    let formula = || Math { typst: HOSTILE.into(), text: HOSTILE.into(), ..Math::default() };
    let label = || Label::plain(HOSTILE);
    let mut report = Report { title: HOSTILE.into(), language: HOSTILE.into(), ..Report::default() };
    report.intro = vec![words(), label().into(), formula().into()];
    report.meta = vec![(HOSTILE.into(), HOSTILE.into())];
    let block = || Block {
        title: words(),
        lines: vec![formula()],
        definitions: vec![Definition { symbol: formula(), meaning: words() }],
    };
    let mode = Mode { name: words(), holds: words(), equations: vec![block()] };
    report.model = Model { assumptions: vec![words()], modes: vec![mode], ..Model::default() };
    report.solve.method = vec![(words(), words())];
    report.solve.tables = vec![Table::new(words(), vec![Column::words(words())]).row(vec![words()])];
    let svg = Svg::new(10.0, 10.0, HOSTILE).described(HOSTILE);
    report.analyze.pictures = vec![Picture::new(svg, words())];
    let series = vec![[0.0, 1.0], [1.0, 2.0]];
    let axis = || Axis::new(label(), "s");
    let figure = CurveFigure::new(label(), axis(), axis()).series(label(), series);
    report.analyze.plots = vec![Plot::new(figure, words())];
    let wanted: String = HOSTILE.split_whitespace().collect();
    let shown = Shown::of(&report).text().matches(&wanted).count();
    // Title, introduction (3), facts (4), block (4), mode (2), assumption, table (3), captions (2).
    assert_eq!(shown, 20);
    assert!(report.pdf().is_ok());
}

#[test]
fn formulas_that_are_more_than_mathematics_are_words() {
    let typeset = |formula: &str| {
        let math = Math { typst: formula.into(), text: "WORDS".into(), ..Math::default() };
        let report = Report { intro: vec![math.into()], ..titled() };
        !Shown::of(&report).text().contains("WORDS")
    };
    for harmless in [
        "θ'' = −frac(3 thin g, 2 thin L) thin op(\"sin\") θ",
        "v_(x,\"rod.tip\")^(2) ≤ abs(u)^(1 slash 2) < dot.double(θ) dot.op italic(\"dt\")",
        "mat(a, b; c, d) + cases(x & \"if \" x < 0, sqrt(x) & \"otherwise\")",
        "op(\"w\") (t, (x + 1)^(2)) − 2.50",
    ] {
        assert!(typeset(harmless), "{harmless}");
    }
    for other in [
        "#panic()",
        "std.panic(1)",
        "read(\"looks.typ\")",
        "a $ b",
        "a // b",
        "frac(",
        "\\ a",
        "sum",
        "\"words\"",
    ] {
        assert!(!typeset(other), "{other}");
    }
}

#[test]
fn long_tables_go_on_below_their_head() {
    let columns = vec![Column::words("Instant"), Column::numbers("Height")];
    let rows = (0..200).map(|i| vec![format!("event {i}").into(), i.to_string().into()]);
    let table = rows.fold(Table::new("Events", columns), Table::row);
    let mut report = titled();
    report.solve.tables.push(table);
    let shown = Shown::of(&report);
    let on = |page: usize, words: &str| {
        shown.placed.iter().any(|p| p.page == page && p.text.as_deref().is_some_and(|t| t.starts_with(words)))
    };
    let with_rows: Vec<usize> = (0..shown.pages.len()).filter(|page| on(*page, "event")).collect();
    assert!(with_rows.len() > 2, "{with_rows:?}");
    assert!(with_rows.iter().all(|page| on(*page, "Instant")), "{with_rows:?}");
    for page in 0..shown.pages.len() {
        assert!(on(page, &format!("{} / {}", page + 1, shown.pages.len())), "page {page} has its number");
    }
}

#[test]
fn wide_tables_go_on_with_their_first_column() {
    let columns = (0..20).map(|i| Column::numbers(format!("greatest{i}"))).collect();
    let cells = (0..20).map(|i| Text::from(format!("-{i}.123456"))).collect();
    let mut report = titled();
    report.solve.tables.push(Table::new("Runs", columns).row(cells));
    let shown = Shown::of(&report);
    let text = shown.text();
    assert!((0..20).all(|i| text.contains(&format!("greatest{i}"))), "{text}");
    assert_eq!(text.matches("-0.123456").count(), 3);
    let numbers: Vec<_> =
        shown.placed.iter().filter(|p| p.text.as_deref().is_some_and(|t| t.contains('.'))).collect();
    for pair in numbers.windows(2).filter(|pair| pair[0].at.y == pair[1].at.y) {
        assert!(pair[0].at.x + pair[0].size.x < pair[1].at.x, "numbers stand clear of each other");
    }
}

#[test]
fn pictures_are_whole_and_no_wider_than_the_text() {
    let sizes = [[600.0, 300.0], [2000.0, 500.0], [300.0, 4000.0], [640.0, 480.0], [640.0, 480.0]];
    let pictures = sizes.map(|[width, height]| drawing(width, height));
    let mut report = titled();
    report.analyze.pictures = pictures.into();
    let shown = Shown::of(&report);
    assert_eq!(shown.pictures().count(), sizes.len());
    let inside = |low: Abs, size: Abs, bound: Abs, margin: Abs| {
        let rounding = Abs::pt(ROUNDING);
        low >= margin - rounding && low + size <= bound - margin + rounding
    };
    for (picture, [width, height]) in shown.pictures().zip(sizes) {
        let (page, margin) = (shown.pages[picture.page], Abs::mm(25.0));
        assert!(inside(picture.at.x, picture.size.x, page.x, margin), "{width} by {height}");
        assert!(inside(picture.at.y, picture.size.y, page.y, margin), "{width} by {height}");
        let ratio = picture.size.x / picture.size.y;
        assert!((ratio - width / height).abs() < 1e-6, "{width} by {height} keeps its shape");
    }
}

#[test]
fn equal_reports_give_equal_bytes() {
    let mut report = titled();
    report.identify.scene = Some(drawing(300.0, 200.0));
    let [one, other] = [report.pdf(), report.pdf()].map(|pdf| pdf.expect("a file"));
    assert_eq!(one, other);
    assert!(one.bytes.starts_with(b"%PDF"));
}
