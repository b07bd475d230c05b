//! Which CSS may bring a font: rules that carry it with them.

/// The rules, if they cannot end the style sheet and reach for nothing outside of it.
pub(super) fn harmless(css: &str) -> Option<&str> {
    let lower = css.to_ascii_lowercase();
    let carried = lower
        .split("url(")
        .skip(1)
        .all(|rest| rest.trim_start().trim_start_matches(['"', '\'']).starts_with("data:"));
    // A backslash could spell any of these words another way.
    let plain = !lower.contains(['<', '\\']) && !lower.contains("@import") && !lower.contains("image-set(");
    (carried && plain).then_some(css)
}

#[cfg(test)]
mod tests {
    use super::harmless;

    #[test]
    fn only_fonts_that_are_carried_along_pass() {
        assert!(
            harmless("@font-face { font-family: M; src: url(\"data:font/woff2;base64,AA==\"); }").is_some()
        );
        for bad in [
            "</style><script>alert(1)</script>",
            "@import 'a.css';",
            "@font-face { src: url(https://example.org/a.woff2) }",
            "@font-face { src: url( 'a.woff2' ) }",
            "a { background: u\\72l(a.png) }",
        ] {
            assert!(harmless(bad).is_none(), "{bad}");
        }
    }
}
