//! The gallery's index page: one HTML file that shows figures lying beside it.

use std::fmt::{self, Display, Formatter, Write};

use tumble_drawing::svg::escape;

/// What the head of each page says of its origin. The zeros are for whoever writes the file: a hash in their place tells
/// whether it was changed.
pub const GALLERY_SEAL: &str =
    "tumble gallery 0000000000000000000000000000000000000000000000000000000000000000";
/// The look of reports, and what only this page has.
const STYLE: &str = concat!(include_str!("report/assets/report.css"), include_str!("gallery_page.css"));

/// A gallery of runs.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct IndexPage {
    /// Title of the page.
    pub title: String,
    /// Language of the texts as HTML names it, for instance `en`; empty if unknown.
    pub language: String,
    /// One entry a scene, in order.
    pub entries: Vec<Entry>,
}

/// One scene of the gallery.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Entry {
    /// Heading.
    pub title: String,
    /// Path of its report relative to the page, with `/` between folders.
    pub report: String,
    /// Paragraphs of the summary.
    pub summary: Vec<String>,
    /// Figures, in order.
    pub figures: Vec<Figure>,
    /// Links to files of data.
    pub data: Vec<Link>,
}

/// A picture in a file of its own.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Figure {
    /// Path relative to the page, with `/` between folders.
    pub path: String,
    /// What the picture shows, for those who cannot see it.
    pub alt: String,
    /// Caption below the picture; may be empty.
    pub caption: String,
}

/// A link to a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Link {
    /// Path relative to the page, with `/` between folders.
    pub path: String,
    /// What the link says.
    pub text: String,
}

impl Display for IndexPage {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let title = escape(&self.title);
        let language = language(&self.language);
        writeln!(f, "<!doctype html>\n<html{language}>\n<head>\n<meta charset=\"utf-8\">")?;
        writeln!(f, "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">")?;
        writeln!(f, "<meta name=\"generator\" content=\"{GALLERY_SEAL}\">")?;
        writeln!(f, "<title>{title}</title>\n<style>\n{STYLE}</style>\n</head>")?;
        writeln!(f, "<body>\n<h1>{title}</h1>")?;
        self.contents(f)?;
        f.write_str("<main>\n")?;
        self.entries.iter().enumerate().try_for_each(|(i, entry)| entry.write(f, i))?;
        f.write_str("</main>\n</body>\n</html>\n")
    }
}

fn language(language: &str) -> String {
    if language.is_empty() { String::new() } else { format!(" lang=\"{}\"", escape(language)) }
}

impl IndexPage {
    /// Links to the entries, if there are several.
    fn contents(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if self.entries.len() < 2 {
            return Ok(());
        }
        f.write_str("<nav>\n<ul>\n")?;
        for (i, entry) in self.entries.iter().enumerate() {
            writeln!(f, "<li><a href=\"#{}\">{}</a></li>", anchor(i), escape(&entry.title))?;
        }
        f.write_str("</ul>\n</nav>\n")
    }
}

fn anchor(index: usize) -> String {
    format!("entry-{}", index + 1)
}

impl Entry {
    fn write(&self, f: &mut Formatter<'_>, index: usize) -> fmt::Result {
        let (title, report) = (escape(&self.title), url(&self.report));
        writeln!(f, "<article id=\"{}\">\n<h2><a href=\"{report}\">{title}</a></h2>", anchor(index))?;
        for line in &self.summary {
            writeln!(f, "<p>{}</p>", escape(line))?;
        }
        self.write_figures(f)?;
        self.write_data(f)?;
        f.write_str("</article>\n")
    }

    fn write_figures(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if self.figures.is_empty() {
            return Ok(());
        }
        f.write_str("<div class=\"figures\">\n")?;
        self.figures.iter().try_for_each(|figure| figure.write(f))?;
        f.write_str("</div>\n")
    }

    fn write_data(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if self.data.is_empty() {
            return Ok(());
        }
        let link = |link: &Link| format!("<a href=\"{}\">{}</a>", url(&link.path), escape(&link.text));
        let links: Vec<_> = self.data.iter().map(link).collect();
        writeln!(f, "<details class=\"data\"><summary>Data</summary>\n<p>{}</p></details>", links.join(" · "))
    }
}

impl Figure {
    fn write(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (url, alt) = (url(&self.path), escape(&self.alt));
        write!(f, "<figure><a href=\"{url}\"><img src=\"{url}\" alt=\"{alt}\" loading=\"lazy\"></a>")?;
        if !self.caption.is_empty() {
            write!(f, "<figcaption>{}</figcaption>", escape(&self.caption))?;
        }
        f.write_str("</figure>\n")
    }
}

/// A relative path as a URL. Everything but plain characters is
/// percent-encoded, so a path can name neither a scheme nor a query.
pub(crate) fn url(path: &str) -> String {
    let mut url = String::from("./");
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

    fn page() -> IndexPage {
        let hostile = || "<script>alert('\"')</script>".to_owned();
        let figure = Figure { path: "a b/\"><script>.svg".into(), alt: hostile(), caption: hostile() };
        let link = Link { path: "javascript:alert(1)".into(), text: hostile() };
        let entry = Entry {
            title: hostile(),
            report: "javascript:alert(1)".into(),
            summary: vec![hostile()],
            figures: vec![figure],
            data: vec![link],
        };
        IndexPage { title: hostile(), language: "en".into(), entries: vec![entry.clone(), entry] }
    }

    #[test]
    fn nothing_in_it_is_run() {
        let html = page().to_string();
        assert!(!html.contains("<script") && !html.contains("javascript:"));
        assert!(html.contains("src=\"./a%20b/%22%3E%3Cscript%3E.svg\""));
        assert!(html.contains("href=\"./javascript%3Aalert%281%29\""));
    }

    #[test]
    fn it_says_whose_it_is() {
        assert_eq!(page().to_string().matches(GALLERY_SEAL).count(), 1);
    }

    #[test]
    fn it_needs_no_network() {
        let html = page().to_string();
        assert!(!html.contains("http") && !html.contains("@import") && !html.contains("url("));
    }

    #[test]
    fn contents_link_to_entries() {
        let html = page().to_string();
        assert!(html.contains("href=\"#entry-2\"") && html.contains("<article id=\"entry-2\">"));
    }
}
