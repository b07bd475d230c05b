//! Pages around reports: the index of a gallery, its lessons, a book. They share the look of reports, and the ways between them.

mod index;

use std::fmt::{self, Display, Formatter, Write};

use tumble_drawing::svg::escape;

pub use index::{Entry, Index, Link};

/// What the head of each page says of its origin. The zeros are for whoever writes the file: a hash in their place tells
/// whether it was changed.
pub const GALLERY_SEAL: &str =
    "tumble gallery 0000000000000000000000000000000000000000000000000000000000000000";
/// The look of reports, and what only these pages have.
const STYLE: &str = concat!(include_str!("../report/assets/report.css"), include_str!("assets/site.css"));
/// What plays an example where it stands, and has the keys reach what is scrolled.
const EXAMPLES: &str = concat!(
    include_str!("../report/assets/address.js"),
    include_str!("assets/examples.js"),
    include_str!("../report/assets/scroll.js")
);

/// The pages of a site that every page leads to.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Ways {
    /// What leads from the page to the folder of the index: nothing, or `../`.
    pub root: String,
    /// Each place with its name, from there.
    pub places: Vec<Link>,
}

impl Ways {
    /// The same from a folder below.
    #[must_use]
    pub fn below(&self) -> Self {
        Self { root: format!("{}../", self.root), places: self.places.clone() }
    }

    /// The links, for the head of a page.
    pub(crate) fn html(&self) -> String {
        let link = |place: &Link| {
            let path = url(&format!("{}{}", self.root, place.path));
            format!("<li><a href=\"{path}\">{}</a></li>", escape(&place.text))
        };
        let links: String = self.places.iter().map(link).collect();
        format!("<nav class=\"site\" aria-label=\"Site\"><ul>{links}</ul></nav>\n")
    }
}

/// A page of a site.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Page {
    /// Title of the page.
    pub title: String,
    /// Language of the texts as HTML names it, for instance `en`; empty if unknown.
    pub language: String,
    /// Where it leads.
    pub ways: Ways,
    /// What stands in it, as HTML.
    pub content: String,
    /// Whether there are formulas in it.
    pub has_formulas: bool,
    /// Data and scripts, as HTML.
    pub scripts: String,
}

impl Page {
    /// The same, whose examples (`data-scene`) and reports (`data-page`) play where they stand, in frames of this page: from
    /// the page itself, with `/` between folders.
    #[must_use]
    pub fn playing(mut self, player: &str) -> Self {
        // Writing to a string cannot fail.
        write!(self.scripts, "<script data-player=\"{}\">\n{EXAMPLES}</script>\n", escape(player))
            .unwrap_or_default();
        self
    }
}

impl Display for Page {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { title, language, ways, content, has_formulas, scripts } = self;
        let font = if *has_formulas { tumble_notation::page_font() } else { String::new() };
        let seal = format!("<meta name=\"generator\" content=\"{GALLERY_SEAL}\">\n");
        let body = format!("{}<main>\n{content}</main>\n{scripts}", ways.html());
        f.write_str(&document([title, language], &seal, &format!("{STYLE}{font}"), &body))
    }
}

/// A page of its own, with more for its head.
pub(crate) fn document([title, language]: [&str; 2], head: &str, style: &str, body: &str) -> String {
    let language =
        if language.is_empty() { String::new() } else { format!(" lang=\"{}\"", escape(language)) };
    let title = escape(title);
    format!(
        "<!doctype html>\n<html{language}>\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n{head}\
         <title>{title}</title>\n<style>\n{style}\n</style>\n</head>\n<body>\n{body}</body>\n</html>\n"
    )
}

/// A relative path as a URL. Everything but plain characters is
/// percent-encoded, so a path can name neither a scheme nor a query.
pub fn url(path: &str) -> String {
    let mut url = String::new();
    // What begins with a name and a colon would name a scheme.
    if !path.starts_with("../") {
        url.push_str("./");
    }
    for byte in path.trim_start_matches('/').bytes() {
        match byte {
            b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' | b'/' => {
                url.push(char::from(byte));
            }
            // Writing to a string cannot fail.
            _ => write!(url, "%{byte:02X}").unwrap_or_default(),
        }
    }
    url
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_in_a_path_is_run() {
        assert_eq!(url("javascript:alert(1)"), "./javascript%3Aalert%281%29");
        assert_eq!(url("a b/\"><script>.svg"), "./a%20b/%22%3E%3Cscript%3E.svg");
        assert_eq!(url("../a/b.html"), "../a/b.html");
    }

    #[test]
    fn every_page_leads_to_the_others_and_says_whose_it_is() {
        let places = vec![Link { path: "index.html".into(), text: "The <gallery>".into() }];
        let ways = Ways { root: String::new(), places }.below();
        let page = Page { title: "<b>".into(), ways, ..Page::default() }.to_string();
        assert!(page.contains("href=\"../index.html\">The &lt;gallery&gt;</a>"), "{page}");
        assert!(page.contains("<title>&lt;b&gt;</title>"));
        assert_eq!(page.matches(GALLERY_SEAL).count(), 1);
        assert!(!page.contains("http") && !page.contains("@import"));
    }
}
