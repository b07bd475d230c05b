//! A small writer of JSON that may stand in a script element of a page.

use std::fmt::Write;

/// A text in quotes. What could end a script element or a line of a script is escaped.
pub fn string(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            // A page would obey it, however it is written here.
            c if tumble_drawing::svg::turns(c) => out.push('\u{FFFD}'),
            '<' | '>' | '&' | '\'' | '\u{2028}' | '\u{2029}' | '\u{7f}'..='\u{9f}' | '\0'..='\u{1f}' => {
                // Writing to a string cannot fail.
                write!(out, "\\u{:04x}", u32::from(c)).unwrap_or_default();
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

/// A number; what is none becomes `null`.
pub fn number(value: f64) -> String {
    if value.is_finite() { format!("{value}") } else { "null".to_owned() }
}

/// A list of finished values.
pub fn list(values: impl IntoIterator<Item = String>) -> String {
    format!("[{}]", values.into_iter().collect::<Vec<_>>().join(","))
}

/// Finished values by name.
pub fn object<const N: usize>(fields: [(&str, String); N]) -> String {
    let fields = fields.map(|(name, value)| format!("{}:{value}", string(name)));
    format!("{{{}}}", fields.join(","))
}

/// Numbers as multiples of a step from an origin, of which there are so many over the finite ones: `[origin, step, [differences]]`,
/// each as its difference to the last one, which is short for smooth data. `[count, difference]` stands for several that are equal,
/// and `null` is a gap.
pub(super) fn on_grid(values: impl Iterator<Item = f64> + Clone, steps: f64) -> String {
    let range = tumble_drawing::scale::Range::of(values.clone()).unwrap_or_default();
    // One step of a constant is never used; it must only not be zero.
    let step = if range.span() > 0.0 { range.span() / steps } else { 1.0 };
    let mut last = 0i64;
    let difference = |value: f64| {
        let n = (value - range.low) / step;
        // Beyond this the difference of two numbers is no longer exact.
        if n.is_nan() || n.abs() > 1e15 {
            return None;
        }
        let n = n.round() as i64;
        Some(n - std::mem::replace(&mut last, n))
    };
    let differences: Vec<Option<i64>> = values.map(difference).collect();
    let runs = differences.chunk_by(|a, b| a == b).flat_map(shortened);
    list([number(range.low), number(step), list(runs)])
}

/// Equal differences, as one if that is shorter.
fn shortened(run: &[Option<i64>]) -> Vec<String> {
    let difference = run[0].map_or_else(|| "null".to_owned(), |difference| difference.to_string());
    let whole = list([run.len().to_string(), difference.clone()]);
    let single = run.len() * (difference.len() + 1) <= whole.len() + 1;
    if single { vec![difference; run.len()] } else { vec![whole] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_cannot_leave_a_script() {
        let shown = string("</script><!-- \u{2028}\u{2029}\"\\\n\0");
        assert_eq!(shown, r#""\u003c/script\u003e\u003c!-- \u2028\u2029\"\\\u000a\u0000""#);
    }

    #[test]
    fn numbers_are_json() {
        assert_eq!([0.5, -3.0, f64::NAN, 1e21].map(number), ["0.5", "-3", "null", "1000000000000000000000"]);
    }

    #[test]
    fn grids_keep_what_they_promise() {
        let values = [0.0, 0.25, f64::NAN, 1.0, 0.5];
        assert_eq!(on_grid(values.into_iter(), 100.0), "[0,0.01,[0,25,null,75,-50]]");
        assert_eq!(on_grid([7.0, 7.0].into_iter(), 100.0), "[7,1,[0,0]]");
        assert_eq!(on_grid([].into_iter(), 100.0), "[0,0.01,[]]");
        let even = [0.0, 1.0, 2.0, 3.0, 4.0, f64::NAN, f64::NAN];
        assert_eq!(on_grid(even.into_iter(), 4.0), "[0,1,[0,[4,1],[2,null]]]");
    }
}
