//! Scenes as large as one likes: what nobody writes by hand, and programs that write scenes do.

/// A kind of large scene: its name, and the scene of a size.
pub(crate) type Kind = (&'static str, fn(usize) -> String);

/// Every kind. The size is the number of what there are many of.
pub(crate) const KINDS: &[Kind] = &[
    ("parameters", |n| parameters(n, |i| format!("\"{} m\"", i + 1))),
    ("a chain of parameters", |n| parameters(n, |i| after("1 m", i, |before| format!("p{before} + 1 m")))),
    ("a chain of parameters, last first", |n| {
        parameters(n, |i| after("1 m", n - 1 - i, |_| format!("p{} + 1 m", i + 1)))
    }),
    ("a chain in which each parameter uses two", |n| {
        parameters(n, |i| after("1 m", i, |before| format!("p{before} + p{}/2", before.saturating_sub(1))))
    }),
    ("a circle of parameters", |n| parameters(n, |i| format!("\"p{} + 1 m\"", (i + 1) % n))),
    ("terms of a sum", |n| parameters(1, |_| format!("\"{}\"", vec!["1"; n].join("+")))),
    ("terms of a sum of names", |n| {
        format!("{}x = \"{}\"\n", parameters(1, |_| "\"1 m\"".into()), vec!["p0"; n].join("+"))
    }),
    ("signs", |n| parameters(1, |_| format!("\"{}1\"", "-".repeat(n)))),
    ("powers", |n| parameters(1, |_| format!("\"{}1\"", "1^".repeat(n)))),
    ("brackets", |n| parameters(1, |_| format!("\"{}1{}\"", "(".repeat(n), ")".repeat(n)))),
    ("letters of a title", |n| format!("title = \"{}\"\n{}", "t".repeat(n), scene())),
    ("letters of a name", |n| format!("{}{} = 1\n", parameters(1, |_| "1".into()), "n".repeat(n))),
    ("points", |n| {
        format!(
            "{}[body.c]\npoint = {{}}\nmass = \"1 kg\"\n{}",
            scene(),
            lines(n, |i| format!("points.q{i} = [\"{i} mm\", 0]"))
        )
    }),
    ("plots", |n| sections(n, "plot", |_| "y = \"b.x\"".into())),
    ("checks", |n| {
        sections(n, "check", |_| "that = \"b.x\"\nequals = \"0 m\"\nwithin = \"1 m\"\nat = \"0.5 s\"".into())
    }),
    ("checks of as many parameters", |n| {
        let claim = |i| format!("that = \"b.x\"\nequals = \"p{i}\"\nwithin = \"1 m\"");
        parameters(n, |i| format!("\"{i} m\"")) + &tables(n, "check", claim)
    }),
    ("events that set as many parameters", |n| {
        let event =
            |i| format!("when = \"b.x rises through {i} m\"\naction = {{ set = {{ p{i} = \"1 m\" }} }}");
        parameters(n, |i| format!("\"{i} m\"")) + &tables(n, "event", event)
    }),
    ("symbols", |n| {
        format!(
            "{}[symbols]\n{}",
            parameters(n, |i| format!("\"{i} m\"")),
            lines(n, |i| format!("p{i} = \"q{i}\""))
        )
    }),
    ("meaning", |n| {
        format!(
            "{}[meaning]\n{}",
            parameters(n, |i| format!("\"{i} m\"")),
            lines(n, |i| format!("p{i} = \"length {i}\""))
        )
    }),
    ("functions", |n| {
        format!("{}[functions]\n{}", scene(), lines(n, |i| format!("\"f{i}(a)\" = \"a + {i}\"")))
    }),
    ("forces", |n| sections(n, "force", |_| "on = \"b\"\nat = \"b.cm\"\nforce = [\"1 N\", 0]".into())),
    ("drags", |n| sections(n, "drag", |_| "at = \"b.cm\"\nlinear = \"1 kg/s\"".into())),
    ("corners of a polygon above a floor", |n| {
        let corners: Vec<_> = (0..n).map(|i| format!("[\"{i} mm\", \"{} mm\"]", i * i)).collect();
        let floor = "[surface.floor]\nthrough = [0, \"-1 m\"]\nrigid = { restitution = 1 }\non = \"c\"\n";
        format!(
            "{}[body.c]\npolygon = {{ corners = [{}] }}\nmass = \"1 kg\"\n{floor}",
            scene(),
            corners.join(", ")
        )
    }),
    ("values of a sweep", |n| {
        let values: Vec<_> = (0..n).map(|i| format!("\"p0 + {i} s\"")).collect();
        format!(
            "{}[sweep]\nx = [{}]\n",
            parameters(1, |_| "\"1 s\"".into()) + "x = \"1 s\"\n",
            values.join(", ")
        )
    }),
    ("keys that are not known", |n| scene() + "[run.x]\n" + &lines(n, |i| format!("k{i} = 1"))),
    ("names that are not known", |n| parameters(n, |i| format!("\"q{i} + 1 m\""))),
    ("keys given twice", |n| scene() + "[parameters]\n" + &lines(n, |_| "p = 1".into())),
    ("times of the run", |n| {
        sections(n, "find", |i| format!("that = \"b.x\"\nat = \"s{i}[2]\""))
            + &tables(n, "event", |i| format!("when = \"b.y rises through {i} m\""))
    }),
];

/// A scene of one body.
fn scene() -> String {
    "version = 1\nworld.gravity = 0\nrun.until = \"1 s\"\nbody.b = { point = {}, mass = \"1 kg\" }\n\n".into()
}

fn lines(n: usize, line: impl Fn(usize) -> String) -> String {
    (0..n).map(|i| line(i) + "\n").collect()
}

fn parameters(n: usize, value: impl Fn(usize) -> String) -> String {
    format!("{}[parameters]\n{}", scene(), lines(n, |i| format!("p{i} = {}", value(i))))
}

/// The first value, or a formula of the one before.
fn after(first: &str, i: usize, formula: impl Fn(usize) -> String) -> String {
    let text = i.checked_sub(1).map_or(first.to_owned(), formula);
    format!("\"{text}\"")
}

fn sections(n: usize, kind: &str, content: impl Fn(usize) -> String) -> String {
    scene() + &tables(n, kind, content)
}

fn tables(n: usize, kind: &str, content: impl Fn(usize) -> String) -> String {
    lines(n, |i| format!("[{kind}.s{i}]\n{}", content(i)))
}
