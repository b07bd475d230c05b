//! A small SVG document builder: elements, attributes, escaped text.
//!
//! Everything that reaches the output passes through [`escape`], so a scene's
//! title can hold any characters. Numbers are printed to a hundredth of a
//! pixel, and equal input gives equal bytes.

use std::fmt::{self, Display, Write};

use crate::rect::Rect;

/// Decimals of a coordinate: a hundredth of a pixel is below what any screen
/// or printer resolves.
const DECIMALS: i32 = 2;

/// Coordinates beyond this many pixels are clamped; renderers store single precision.
const FARTHEST: f64 = 1e6;

/// A complete drawing, `width` by `height` in pixels (CSS pixels, 1/96 inch).
#[derive(Clone, Debug, PartialEq)]
pub struct Svg {
    /// Width of the drawing in pixels.
    pub width: f64,
    /// Height of the drawing in pixels.
    pub height: f64,
    /// Plain-text title, read by screen readers and shown as a tooltip.
    pub title: String,
    /// What the drawing shows, for those who cannot see it; may be empty.
    pub description: String,
    /// Elements in drawing order, first at the back.
    pub children: Vec<Element>,
    /// What a narrow page shows in place of the whole, from top to bottom; none if the whole is narrow enough.
    pub parts: Vec<Excerpt>,
}

/// A part of a broad drawing for narrow pages.
#[derive(Clone, Debug, PartialEq)]
pub enum Excerpt {
    /// What the drawing has there, in pixels.
    Cut(Rect),
    /// The same as somewhere in the drawing, set narrower.
    Drawn(Box<Svg>),
}

impl Excerpt {
    /// As an element of a page; a cut shows what has the name.
    fn inline(&self, drawing: &str) -> Element {
        let (area, content) = match self {
            Self::Cut(area) => (*area, vec![Element::new("use").attr("href", format!("#{drawing}"))]),
            Self::Drawn(svg) => (Rect::new(0.0, 0.0, svg.width, svg.height), svg.children.clone()),
        };
        sized(&area).attr("class", "part").attr("aria-hidden", "true").children(content)
    }
}

impl Svg {
    /// An empty drawing of the given size with a plain-text title.
    pub fn new(width: f64, height: f64, title: impl Into<String>) -> Self {
        Self {
            width,
            height,
            title: title.into(),
            description: String::new(),
            children: vec![],
            parts: vec![],
        }
    }

    /// A sheet of paper of the given size.
    pub fn on_paper(width: f64, height: f64, title: impl Into<String>) -> Self {
        let mut svg = Self::new(width, height, title);
        let page = Element::new("rect").attrs([("width", width), ("height", height)]);
        svg.push(page.attr("fill", crate::theme::PAPER));
        svg
    }

    /// The same drawing with a description in plain text.
    pub fn described(mut self, description: impl Into<String>) -> Self {
        self.description = description.into();
        self
    }

    /// Puts an element in front of those already there.
    pub fn push(&mut self, element: Element) {
        self.children.push(element);
    }

    /// The drawing as a part of a page: `id` (unique there, without blanks)
    /// ties the title and the description to it for screen readers. Its parts follow.
    pub fn inline(&self, id: &str) -> String {
        let [title, description, drawing] =
            ["title", "description", "drawing"].map(|what| format!("{id}-{what}"));
        let names = [&title, &description, &drawing].map(String::as_str);
        let labelled = self.root(Some(names)).attr("aria-labelledby", title.clone());
        let whole = match self.description.is_empty() {
            true => labelled,
            false => labelled.attr("aria-describedby", description.clone()),
        };
        std::iter::once(whole)
            .chain(self.parts.iter().map(|part| part.inline(&drawing)))
            .map(|svg| svg.to_string())
            .collect()
    }

    /// The root element; title, description and, where it has parts, all that is drawn get the names, if there are some.
    fn root(&self, names: Option<[&str; 3]>) -> Element {
        let named = |element: Element, i: usize| match names {
            Some(names) => element.attr("id", names[i]),
            None => element,
        };
        let root = sized(&Rect::new(0.0, 0.0, self.width, self.height))
            .attr("role", "img")
            .child(named(Element::new("title"), 0).text(&self.title));
        let description =
            (!self.description.is_empty()).then(|| named(Element::new("desc"), 1).text(&self.description));
        let root = root.children(description);
        let drawn = self.children.iter().cloned();
        match self.parts.is_empty() {
            true => root.children(drawn),
            false => root.child(named(Element::new("g"), 2).children(drawn)),
        }
    }
}

/// An empty drawing that shows an area, in pixels.
fn sized(area: &Rect) -> Element {
    let view = [area.x, area.y, area.width, area.height].map(number).join(" ");
    Element::new("svg")
        .attr("xmlns", "http://www.w3.org/2000/svg")
        .attr("width", area.width)
        .attr("height", area.height)
        .attr("viewBox", view)
        .attr("font-family", crate::font::FAMILY)
}

impl Display for Svg {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.root(None).fmt(f)?;
        f.write_char('\n')
    }
}

/// One SVG element with attributes in the order they were given.
#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    name: &'static str,
    attributes: Vec<(&'static str, String)>,
    content: Vec<Node>,
}

#[derive(Clone, Debug, PartialEq)]
enum Node {
    Element(Element),
    Text(String),
}

impl Element {
    /// An element without attributes or content.
    pub fn new(name: &'static str) -> Self {
        Self { name, attributes: Vec::new(), content: Vec::new() }
    }

    /// Adds an attribute; numbers are rounded as coordinates are.
    pub fn attr(mut self, name: &'static str, value: impl Into<AttributeValue>) -> Self {
        self.attributes.push((name, value.into().0));
        self
    }

    /// Adds several numeric attributes, for instance `[("x", 1.0), ("y", 2.0)]`.
    pub fn attrs<const N: usize>(self, values: [(&'static str, f64); N]) -> Self {
        values.into_iter().fold(self, |element, (name, value)| element.attr(name, value))
    }

    /// Adds the colour and the thickness of its line.
    pub fn stroked(self, colour: impl Into<AttributeValue>, thickness: f64) -> Self {
        self.attr("stroke", colour).attr("stroke-width", thickness)
    }

    /// Adds the dashes of its line; none for no text.
    pub fn dashed(self, dashes: &str) -> Self {
        if dashes.is_empty() { self } else { self.attr("stroke-dasharray", dashes) }
    }

    /// Adds a child element.
    pub fn child(mut self, child: Element) -> Self {
        self.content.push(Node::Element(child));
        self
    }

    /// Adds child elements in order.
    pub fn children(self, children: impl IntoIterator<Item = Element>) -> Self {
        children.into_iter().fold(self, Element::child)
    }

    /// Adds text; markup in it is shown, never interpreted.
    pub fn text(mut self, text: &str) -> Self {
        self.content.push(Node::Text(text.to_owned()));
        self
    }

    fn is_text(&self) -> bool {
        self.content.iter().any(|node| matches!(node, Node::Text(_)))
    }

    fn write(&self, out: &mut fmt::Formatter<'_>, in_text: bool) -> fmt::Result {
        write!(out, "<{}", self.name)?;
        for (name, value) in &self.attributes {
            write!(out, " {name}=\"{}\"", escape(value))?;
        }
        if self.content.is_empty() {
            return out.write_str("/>");
        }
        out.write_char('>')?;
        // A line break inside running text would be drawn as a space.
        let in_text = in_text || self.name == "text" || self.is_text();
        self.write_content(out, in_text)?;
        write!(out, "</{}>", self.name)
    }

    fn write_content(&self, out: &mut fmt::Formatter<'_>, in_text: bool) -> fmt::Result {
        let separator = if in_text { "" } else { "\n" };
        for node in &self.content {
            out.write_str(separator)?;
            match node {
                Node::Element(element) => element.write(out, in_text)?,
                Node::Text(text) => out.write_str(&escape(text))?,
            }
        }
        out.write_str(separator)
    }
}

impl Display for Element {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write(f, false)
    }
}

/// The text of an attribute, made from a number or a string.
pub struct AttributeValue(String);

impl From<f64> for AttributeValue {
    fn from(value: f64) -> Self {
        Self(number(value))
    }
}

impl From<&str> for AttributeValue {
    fn from(value: &str) -> Self {
        Self(value.to_owned())
    }
}

impl From<String> for AttributeValue {
    fn from(value: String) -> Self {
        Self(value)
    }
}

/// Escapes text for XML and HTML, content and quoted attributes alike;
/// characters that XML forbids, and marks that turn the direction of what follows, become U+FFFD.
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            '\t' | '\n' | '\r' => out.push(' '),
            c if c.is_control() || turns(c) || matches!(c, '\u{FFFE}' | '\u{FFFF}') => out.push('\u{FFFD}'),
            c => out.push(c),
        }
    }
    out
}

/// Whether a character turns or isolates the direction of text, so that what follows is not read as it is written.
pub fn turns(c: char) -> bool {
    matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{206f}')
}

/// A coordinate as text: at most two decimals, no trailing zeros, no `-0`.
/// What is not a number prints as 0, since no renderer accepts it.
pub fn number(value: f64) -> String {
    let scale = 10f64.powi(DECIMALS);
    let rounded = (value.clamp(-FARTHEST, FARTHEST) * scale).round() / scale;
    if rounded == 0.0 || rounded.is_nan() { "0".to_owned() } else { rounded.to_string() }
}

/// The `d` attribute of a path, built point by point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PathData(String);

impl PathData {
    /// A path of straight pieces through `points`, each `[x, y]` in pixels.
    pub fn polyline(points: &[[f64; 2]]) -> Self {
        let mut path = Self::default();
        path.add_polyline(points);
        path
    }

    /// A closed outline through `points`.
    pub fn polygon(points: &[[f64; 2]]) -> Self {
        let mut path = Self::default();
        path.add_polygon(points);
        path
    }

    /// Starts a new piece at the first point and draws to the others.
    pub fn add_polyline(&mut self, points: &[[f64; 2]]) {
        for (i, point) in points.iter().enumerate() {
            let command = match i {
                0 => 'M',
                1 => 'L',
                _ => ' ',
            };
            self.0.push(command);
            self.0.push_str(&number(point[0]));
            self.0.push(',');
            self.0.push_str(&number(point[1]));
        }
    }

    /// Adds a closed outline.
    pub fn add_polygon(&mut self, points: &[[f64; 2]]) {
        self.add_polyline(points);
        self.0.push('Z');
    }

    /// Whether nothing has been drawn.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// A `path` element without fill, its line in a colour and of a thickness.
    pub fn stroke(self, colour: impl Into<AttributeValue>, thickness: f64) -> Element {
        self.fill("none").stroked(colour, thickness)
    }

    /// A `path` element; the caller gives its fill.
    pub fn fill(self, fill: impl Into<AttributeValue>) -> Element {
        Element::new("path").attr("d", self.0).attr("fill", fill)
    }
}

/// A straight line from `from` to `to`, each `[x, y]` in pixels.
pub fn line(from: [f64; 2], to: [f64; 2]) -> Element {
    Element::new("line").attrs([("x1", from[0]), ("y1", from[1]), ("x2", to[0]), ("y2", to[1])])
}

/// A circle, centre and radius in pixels.
pub fn circle(centre: [f64; 2], radius: f64) -> Element {
    Element::new("circle").attrs([("cx", centre[0]), ("cy", centre[1]), ("r", radius)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markup_in_text_and_attributes_is_shown_not_run() {
        let mut svg = Svg::new(10.0, 10.0, "<script>alert(1)</script>");
        svg.push(Element::new("text").attr("class", "\"><script>").text("a < b & 'c'"));
        let out = svg.to_string();
        assert!(!out.contains("<script"), "{out}");
        assert!(out.contains("a &lt; b &amp; &#39;c&#39;"));
    }

    #[test]
    fn control_characters_do_not_break_the_document() {
        assert_eq!(escape("a\u{0}b\nc"), "a\u{FFFD}b c");
    }

    #[test]
    fn text_keeps_the_direction_of_what_follows() {
        assert_eq!(escape("a\u{202e}b\u{2066}c\u{200f}"), "a\u{FFFD}b\u{FFFD}c\u{FFFD}");
        assert_eq!(escape("שלום"), "שלום");
    }

    #[test]
    fn numbers_are_short() {
        let shown: Vec<_> = [1.0, 0.1 + 0.2, -0.001, 1.0 / 3.0, f64::NAN, f64::INFINITY].map(number).into();
        assert_eq!(shown, ["1", "0.3", "0", "0.33", "0", "1000000"]);
    }

    #[test]
    fn paths_separate_pieces() {
        let mut path = PathData::polyline(&[[0.0, 0.0], [1.0, 2.5], [3.0, 4.0]]);
        path.add_polyline(&[[5.0, 5.0], [6.0, 6.0]]);
        assert_eq!(path.fill("none").to_string(), r#"<path d="M0,0L1,2.5 3,4M5,5L6,6" fill="none"/>"#);
    }

    #[test]
    fn running_text_gets_no_line_breaks() {
        let text = Element::new("text").child(Element::new("tspan").text("a")).text("b");
        assert_eq!(text.to_string(), "<text><tspan>a</tspan>b</text>");
    }
}
