//! A document as a part of a page: headings that can be linked to, formulas, links between pages, examples that play.

use std::collections::BTreeMap;
use std::fs;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use pulldown_cmark::{CodeBlockKind, CowStr, Event, HeadingLevel, Options, Parser, Tag, TagEnd, html};
use pulldown_latex::config::DisplayMode;
use tumble_report::site::url;

use super::documents::{Documents, report_page};
use super::examples::{command, completed};
use super::formula::mathml;

/// Tags that a text may have; others are shown as they are written.
const TAGS: [&str; 7] = ["i", "b", "em", "strong", "sub", "sup", "br"];

/// What a document came to.
#[derive(Debug, Default)]
pub(super) struct Text {
    /// Its first heading.
    pub(super) title: String,
    /// All of it, as HTML.
    pub(super) html: String,
    /// Whether there are formulas in it.
    pub(super) has_formulas: bool,
}

fn events(text: &str) -> Vec<Event<'_>> {
    let options = Options::ENABLE_TABLES | Options::ENABLE_MATH | Options::ENABLE_STRIKETHROUGH;
    Parser::new_ext(text, options).collect()
}

/// Where its links lead.
pub(super) fn links(text: &str) -> Vec<String> {
    let link = |event: Event<'_>| match event {
        Event::Start(Tag::Link { dest_url, .. }) => Some(dest_url.into_string()),
        _ => None,
    };
    events(text).into_iter().filter_map(link).collect()
}

/// The words of a document's first paragraph.
pub(super) fn first_paragraph(text: &str) -> String {
    let events = events(text);
    let from = events.iter().position(|event| matches!(event, Event::Start(Tag::Paragraph)));
    from.map(|from| words(&events[from..])).unwrap_or_default()
}

/// The scaffold that completes fragments, where these documents have one.
pub(super) fn scaffold(documents: &Documents) -> Option<String> {
    let of = |text: &String| {
        let mut is_open = false;
        events(text).into_iter().find_map(|event| match event {
            Event::Start(Tag::CodeBlock(CodeBlockKind::Fenced(kind))) => {
                is_open = &*kind == "toml scaffold";
                None
            }
            Event::Text(text) if is_open => Some(text.into_string()),
            _ => None,
        })
    };
    documents.texts.values().find_map(of)
}

/// A document of these as a part of a page one folder below that of the site.
pub(super) fn rendered(documents: &Documents, scaffold: Option<&str>, path: &str, text: &str) -> Text {
    let mut writer =
        Writer { documents, scaffold, path, slugs: BTreeMap::new(), is_edited: false, has_formulas: false };
    let events = events(text);
    let (mut shown, mut at) = (vec![], 0);
    while at < events.len() {
        let (more, next) = writer.event(&events, at);
        shown.extend(more);
        at = next;
    }
    let heading = events.iter().position(|event| matches!(event, Event::Start(Tag::Heading { .. })));
    let mut html = String::new();
    html::push_html(&mut html, shown.into_iter());
    Text {
        title: heading.map(|at| words(&events[at..])).unwrap_or_default(),
        html,
        has_formulas: writer.has_formulas,
    }
}

/// The words up to the end of what begins here.
fn words(events: &[Event<'_>]) -> String {
    let mut found = String::new();
    for event in events {
        match event {
            Event::End(TagEnd::Heading(_) | TagEnd::Paragraph) => break,
            Event::Text(text) | Event::Code(text) | Event::InlineMath(text) => found.push_str(text),
            Event::SoftBreak | Event::HardBreak => found.push(' '),
            _ => {}
        }
    }
    found
}

struct Writer<'a> {
    documents: &'a Documents,
    scaffold: Option<&'a str>,
    /// The document.
    path: &'a str,
    /// How often each name of a heading was given.
    slugs: BTreeMap<String, usize>,
    /// Whether the next command is of a scene that the text has changed.
    is_edited: bool,
    has_formulas: bool,
}

impl<'a> Writer<'a> {
    /// What an event becomes, and the event after it.
    fn event(&mut self, events: &[Event<'a>], at: usize) -> (Vec<Event<'a>>, usize) {
        let one = |event: Event<'a>| (vec![event], at + 1);
        match &events[at] {
            Event::Start(Tag::Heading { level, .. }) => one(html_of(self.heading(*level, &events[at..]))),
            Event::Start(Tag::CodeBlock(CodeBlockKind::Fenced(kind))) => {
                let length = events[at..].iter().position(|event| matches!(event, Event::End(_)));
                let end = at + length.unwrap_or(events.len() - at - 1);
                let text: String = events[at + 1..end].iter().map(plain).collect();
                (vec![html_of(self.block(kind, &text))], end + 1)
            }
            Event::Start(Tag::Link { dest_url, .. }) => one(html_of(self.link(dest_url))),
            Event::End(TagEnd::Link) => one(html_of("</a>".to_owned())),
            Event::Start(Tag::Image { dest_url, .. }) => {
                let end = events[at..].iter().position(|event| matches!(event, Event::End(TagEnd::Image)));
                let end = at + end.unwrap_or(0);
                let alt: String = events[at + 1..end].iter().map(plain).collect();
                (vec![html_of(self.image(dest_url, &alt))], end + 1)
            }
            Event::InlineMath(latex) => one(html_of(self.formula(latex, DisplayMode::Inline))),
            Event::DisplayMath(latex) => {
                // A paragraph of its own, in which lines are far apart.
                let formula = self.formula(latex, DisplayMode::Block);
                one(html_of(format!("<div class=\"line\">{formula}</div>")))
            }
            Event::Html(tag) | Event::InlineHtml(tag) => one(html_of(harmless(tag))),
            other => one(other.clone()),
        }
    }

    /// The beginning of a heading, by whose words others link to it.
    fn heading(&mut self, level: HeadingLevel, rest: &[Event<'_>]) -> String {
        let slug = slug(&words(rest));
        let count = self.slugs.entry(slug.clone()).or_insert(0);
        let id = if *count == 0 { slug } else { format!("{slug}-{count}") };
        *count += 1;
        format!("<{level} id=\"{}\">", escape(&id))
    }

    /// A link to a page of the site, or to another site; what is neither is no link.
    fn link(&self, to: &str) -> String {
        if to.starts_with("https://") || to.starts_with("http://") || to.starts_with("mailto:") {
            return format!("<a href=\"{}\">", escape(to));
        }
        match self.documents.page_behind(self.path, to) {
            Some(page) => {
                let (page, part) =
                    page.split_once('#').map_or((&*page, None), |(page, part)| (page, Some(part)));
                let part = part.map(|part| format!("#{}", escape(part))).unwrap_or_default();
                format!("<a href=\"{}{part}\">", url(&format!("../{page}")))
            }
            None => "<a>".to_owned(),
        }
    }

    /// A picture in the page itself.
    fn image(&self, to: &str, alt: &str) -> String {
        let read = self.documents.file_behind(self.path, to).and_then(|file| fs::read(file).ok());
        let kind = if to.ends_with(".png") { "png" } else { "svg+xml" };
        match read {
            Some(bytes) => format!(
                "<img alt=\"{}\" src=\"data:image/{kind};base64,{}\">",
                escape(alt),
                STANDARD.encode(bytes)
            ),
            None => format!("<em>{}</em>", escape(alt)),
        }
    }

    fn block(&mut self, kind: &str, text: &str) -> String {
        let pre = format!("<pre><code>{}</code></pre>\n", escape(text));
        let scene = match kind {
            "toml" | "toml error" | "toml scaffold" => Some(text.to_owned()),
            "toml fragment" => self.scaffold.map(|scaffold| completed(text, scaffold)),
            _ => None,
        };
        if let Some(scene) = scene {
            return format!("<div class=\"example\" data-scene=\"{}\">\n{pre}</div>\n", escape(&scene));
        }
        let run = command(text).filter(|_| kind == "console" && !self.is_edited);
        self.is_edited = kind == "diff";
        let named = run.and_then(|(file, set)| Some((self.documents.scene_named(file)?, set)));
        let link = named.filter(|(_, set)| !set.is_empty()).map(|(scene, set)| {
            let page = url(&format!("../{}", report_page(scene)));
            format!("<p class=\"note\"><a href=\"{page}#{}\">Play this run</a></p>\n", escape(&set.join("&")))
        });
        pre + &link.unwrap_or_default()
    }

    /// MathML; what cannot be read stays LaTeX.
    fn formula(&mut self, latex: &str, display_mode: DisplayMode) -> String {
        self.has_formulas = true;
        mathml(latex, display_mode).unwrap_or_else(|| format!("<code>{}</code>", escape(latex)))
    }
}

/// A text as HTML, in an attribute too; lines stay lines.
fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

fn html_of<'a>(text: String) -> Event<'a> {
    Event::Html(CowStr::from(text))
}

fn plain(event: &Event<'_>) -> String {
    match event {
        Event::Text(text) | Event::Code(text) => text.to_string(),
        Event::SoftBreak => " ".to_owned(),
        _ => String::new(),
    }
}

/// A tag of a few; a comment is nothing, and anything else is shown as it is written.
fn harmless(tag: &str) -> String {
    if tag.trim().starts_with("<!--") {
        return String::new();
    }
    let name = tag.trim().trim_start_matches('<').trim_start_matches('/').trim_end_matches('>');
    if TAGS.contains(&name.trim_end_matches('/').trim()) { tag.to_owned() } else { escape(tag) }
}

/// The name of a heading, as sites that show documents make it: small letters, digits, and a hyphen for each space.
fn slug(words: &str) -> String {
    let kept = words.trim().to_lowercase();
    kept.chars()
        .filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'))
        .map(|c| if c == ' ' { '-' } else { c })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn html(text: &str) -> String {
        rendered(&Documents::default(), Some("version = 1\n"), "docs/a.md", text).html
    }

    #[test]
    fn headings_have_the_names_that_links_use() {
        let shown = html("## The `[play]` section, twice\n\n## The play section twice\n\n# x\n\n# x");
        assert!(shown.contains("<h2 id=\"the-play-section-twice\">"), "{shown}");
        assert!(shown.contains("<h2 id=\"the-play-section-twice-1\">") && shown.contains("id=\"x-1\""));
    }

    #[test]
    fn examples_play_and_fragments_are_completed() {
        let two = html("```toml\nversion = 1\na = \"b\"\n```");
        assert!(two.contains("data-scene=\"version = 1\na = &quot;b&quot;\n\""), "{two}");
        assert!(two.contains("<code>version = 1\na"), "{two}");
        assert!(html("```toml fragment\n[a]\n```").contains("data-scene=\"version = 1\n\n[a]\n\""));
        assert!(!html("```json\n{}\n```").contains("data-scene"));
    }

    #[test]
    fn formulas_are_mathml() {
        let shown = rendered(&Documents::default(), None, "a.md", "$\\frac{a}{b}$ and\n\n$$x^2$$");
        assert!(
            shown.html.contains("<mfrac>")
                && shown.html.contains("displaystyle=\"true\"")
                && shown.has_formulas
        );
        assert!(html("$\\nosuchthing{a}$").contains("<code>"));
    }

    #[test]
    fn nothing_in_a_text_is_run() {
        let shown = html(
            "<script>alert(1)</script>\n\na <b onclick=x>b</b> <i>c</i> [d](javascript:alert(1)) ![e](x.svg)",
        );
        assert!(
            !shown.contains("<script") && !shown.contains("<b onclick") && !shown.contains("javascript:"),
            "{shown}"
        );
        assert!(shown.contains("<i>c</i>"));
    }

    #[test]
    fn the_first_paragraph_says_what_happens() {
        assert_eq!(first_paragraph("# Title\n\nA *rod* hangs\nfrom `x`.\n\nMore."), "A rod hangs from x.");
    }
}
