//! The index of a gallery: a picture that moves for each scene, what happens in it, and where it leads.

use tumble_drawing::Animation;
use tumble_drawing::svg::escape;

use super::{Page, Ways, url};
use crate::report::Text;
use crate::report::html::{self, MOTION, joined};
use crate::report::json::{list, object};
use crate::report::live;

/// What makes the pictures move, in the order in which it runs.
const SCRIPTS: [&str; 3] =
    [include_str!("../report/assets/common.js"), MOTION, include_str!("assets/living.js")];

/// A gallery of runs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Index {
    /// Title of the page.
    pub title: String,
    /// Language of the texts as HTML names it, for instance `en`; empty if unknown.
    pub language: String,
    /// Where it leads beside its entries.
    pub ways: Ways,
    /// One entry a scene, in order.
    pub entries: Vec<Entry>,
}

/// One scene of the gallery.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Entry {
    /// Heading.
    pub title: String,
    /// Path of its lesson relative to the page, with `/` between folders, where it has one.
    pub lesson: Option<String>,
    /// Path of its report, likewise.
    pub report: String,
    /// Paragraphs of the summary: what happens, and what was found.
    pub summary: Vec<Text>,
    /// The motion.
    pub motion: Option<Animation>,
    /// Links to files of data.
    pub data: Vec<Link>,
}

/// A link to a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Link {
    /// Path relative to the page, with `/` between folders.
    pub path: String,
    /// What the link says.
    pub text: String,
}

impl Index {
    /// The page.
    pub fn page(&self) -> Page {
        let entries: String =
            self.entries.iter().enumerate().map(|(i, entry)| entry.html(i, self.motions_before(i))).collect();
        let pause = "<p class=\"bar\"><button type=\"button\" id=\"pause-all\" aria-pressed=\"false\" hidden>\
                     Pause all pictures</button></p>\n";
        let title = escape(&self.title);
        Page {
            title: self.title.clone(),
            language: self.language.clone(),
            ways: self.ways.clone(),
            content: format!("<h1>{title}</h1>\n{pause}<div class=\"cards\">\n{entries}</div>\n"),
            has_formulas: false,
            scripts: self.scripts(),
        }
    }

    fn motions_before(&self, index: usize) -> usize {
        self.entries[..index].iter().filter(|entry| entry.motion.is_some()).count()
    }

    fn scripts(&self) -> String {
        let motion = |entry: &Entry| Some(live::living(entry.motion.as_ref()?, &entry.summary));
        let motions = self.entries.iter().filter_map(motion);
        let data = object([("plots", list([])), ("motions", list(motions))]);
        let scripts = joined(&SCRIPTS);
        format!(
            "<script type=\"application/json\" id=\"report-data\">{data}</script>\n<script>\n{scripts}</script>\n"
        )
    }
}

impl Entry {
    fn html(&self, index: usize, motion: usize) -> String {
        let (title, report) = (escape(&self.title), url(&self.report));
        let first = self.lesson.as_ref().map_or_else(|| report.clone(), |lesson| url(lesson));
        let picture = if self.motion.is_some() {
            format!("<figure class=\"motion living\" data-living=\"{motion}\"></figure>\n")
        } else {
            String::new()
        };
        let summary: String =
            self.summary.iter().map(|line| format!("<p>{}</p>\n", html::text(line))).collect();
        let lesson =
            self.lesson.iter().map(|_| format!("<a href=\"{first}\">Lesson</a> · ")).collect::<String>();
        format!(
            "<article id=\"entry-{}\">\n{picture}<h2><a href=\"{first}\">{title}</a></h2>\n{summary}\
             <p class=\"note\">{lesson}<a href=\"{report}\">Report and play</a></p>\n{}</article>\n",
            index + 1,
            self.data()
        )
    }

    fn data(&self) -> String {
        if self.data.is_empty() {
            return String::new();
        }
        let link = |link: &Link| format!("<a href=\"{}\">{}</a>", url(&link.path), escape(&link.text));
        let links: Vec<_> = self.data.iter().map(link).collect();
        format!("<details class=\"data\"><summary>Data</summary>\n<p>{}</p></details>\n", links.join(" · "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn page() -> String {
        let hostile = || "</script><script>alert('\"')</script>".to_owned();
        let link = Link { path: "javascript:alert(1)".into(), text: hostile() };
        let entry = Entry {
            title: hostile(),
            lesson: Some("javascript:alert(1)".into()),
            report: "javascript:alert(1)".into(),
            summary: vec![hostile().into()],
            motion: Some(Animation {
                title: tumble_drawing::Label::plain(&hostile()),
                ..Animation::default()
            }),
            data: vec![link],
        };
        let entries = vec![entry.clone(), entry];
        Index { title: hostile(), language: "en".into(), ways: Ways::default(), entries }.page().to_string()
    }

    #[test]
    fn nothing_in_it_is_run() {
        let html = page();
        assert!(!html.contains("<script>alert") && !html.contains("javascript:"));
        assert_eq!(html.matches("</script>").count(), 2);
    }

    #[test]
    fn it_needs_no_network() {
        let html = page().replace("http://www.w3.org/2000/svg", "");
        assert!(!html.contains("http") && !html.contains("@import") && !html.contains("url("));
    }

    #[test]
    fn entries_have_their_own_pictures() {
        let html = page();
        assert!(html.contains("<article id=\"entry-2\">") && html.contains("data-living=\"1\""));
    }
}
