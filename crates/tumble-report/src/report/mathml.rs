//! Which MathML may stand in a page: presentation elements and nothing that acts.

/// Elements of presentation MathML.
const ELEMENTS: [&str; 31] = [
    "math",
    "mrow",
    "mi",
    "mn",
    "mo",
    "ms",
    "mtext",
    "mspace",
    "mfrac",
    "msqrt",
    "mroot",
    "msub",
    "msup",
    "msubsup",
    "munder",
    "mover",
    "munderover",
    "mtable",
    "mtr",
    "mtd",
    "mstyle",
    "mpadded",
    "mphantom",
    "mmultiscripts",
    "mprescripts",
    "none",
    "merror",
    "menclose",
    "semantics",
    "annotation",
    "mlabeledtr",
];

/// Attributes that change looks only; none of them holds an address or a script.
const ATTRIBUTES: [&str; 40] = [
    "xmlns",
    "display",
    "displaystyle",
    "scriptlevel",
    "mathvariant",
    "mathsize",
    "dir",
    "alttext",
    "form",
    "fence",
    "separator",
    "lspace",
    "rspace",
    "stretchy",
    "symmetric",
    "maxsize",
    "minsize",
    "largeop",
    "movablelimits",
    "accent",
    "accentunder",
    "linethickness",
    "width",
    "height",
    "depth",
    "voffset",
    "columnalign",
    "rowalign",
    "columnspacing",
    "rowspacing",
    "columnlines",
    "rowlines",
    "frame",
    "framespacing",
    "columnspan",
    "rowspan",
    "notation",
    "encoding",
    "intent",
    "arg",
];

/// Whether the text is `math` elements, with spaces between them, of well-formed MathML made of harmless parts.
pub(super) fn is_harmless(mathml: &str) -> bool {
    let mathml = mathml.trim();
    mathml.starts_with("<math") && mathml.ends_with("</math>") && walk(mathml).is_some()
}

/// Reads tags until the last `math` is closed; `None` if anything is out of order, or something else stands between or behind them.
fn walk(mathml: &str) -> Option<()> {
    let (mut open, mut rest) = (Vec::new(), mathml);
    while let Some(start) = rest.find('<') {
        let (text, tag) = rest.split_at(start);
        if text.contains('>') {
            return None;
        }
        let end = tag_end(tag)?;
        step(&mut open, &tag[1..end])?;
        rest = &tag[end + 1..];
        if open.is_empty() {
            rest = rest.trim_start();
            if !rest.is_empty() && !rest.starts_with("<math") {
                return None;
            }
        }
    }
    (open.is_empty() && rest.is_empty()).then_some(())
}

/// Where the tag ends; quoted signs do not end it.
fn tag_end(tag: &str) -> Option<usize> {
    let mut quoted = false;
    tag.char_indices().find_map(|(i, c)| {
        quoted ^= c == '"';
        (c == '>' && !quoted).then_some(i)
    })
}

fn step<'a>(open: &mut Vec<&'a str>, tag: &'a str) -> Option<()> {
    if let Some(name) = tag.strip_prefix('/') {
        return (open.pop()? == name.trim_end()).then_some(());
    }
    let (tag, closed) = tag.strip_suffix('/').map_or((tag, false), |tag| (tag, true));
    let name = tag.split(char::is_whitespace).next()?;
    if !ELEMENTS.contains(&name) || !harmless_attributes(&tag[name.len()..]) {
        return None;
    }
    if !closed {
        open.push(name);
    }
    Some(())
}

/// Whether the rest of a tag is a list of known attributes with values in double quotes.
fn harmless_attributes(mut rest: &str) -> bool {
    loop {
        rest = rest.trim_start();
        if rest.is_empty() {
            return true;
        }
        let Some((name, after)) = rest.split_once("=\"") else { return false };
        let Some((value, after)) = after.split_once('"') else { return false };
        if !ATTRIBUTES.contains(&name) || value.contains(['<', '>']) {
            return false;
        }
        rest = after;
    }
}

#[cfg(test)]
mod tests {
    use super::is_harmless;

    #[test]
    fn formulas_pass() {
        for good in [
            "<math><mi>x</mi></math>",
            "<math><mi>x</mi></math> <math><mo>=</mo><mn>0</mn></math>",
            "<math xmlns=\"http://www.w3.org/1998/Math/MathML\" display=\"block\"><mfrac><mn>1</mn><mn>2</mn></mfrac></math>",
            "<math><mrow><mi>a</mi><mo stretchy=\"false\">&lt;</mo><mspace width=\"1em\"/></mrow></math>",
        ] {
            assert!(is_harmless(good), "{good}");
        }
    }

    #[test]
    fn whatever_acts_is_refused() {
        for bad in [
            "",
            "x < y",
            "<math><script>alert(1)</script></math>",
            "<math><mi onclick=\"alert(1)\">x</mi></math>",
            "<math><mi href=\"javascript:alert(1)\">x</mi></math>",
            "<math><mi style=\"background:url(http://a)\">x</mi></math>",
            "<math><mi>x</mi></math><img src=x onerror=alert(1)></math>",
            "<math><mi>x</mi></math> <mi>y</mi> <math></math>",
            "<math><mi>x</mi></math> y <math></math>",
            "<math><mi>x</math></mi>",
            "<math><mi mathvariant=normal>x</mi></math>",
            "<math><mi mathvariant=\"a>b\">x</mi></math>",
            "<math><!-- x --></math>",
            "<math><annotation-xml encoding=\"text/html\"><b>x</b></annotation-xml></math>",
            "<math><mi>x</mi>",
            "<math/><img></math>",
        ] {
            assert!(!is_harmless(bad), "{bad}");
        }
    }
}
