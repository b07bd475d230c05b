//! The documents around scenes: a lesson in the folder of each, and a book beside them, with all that they lead to.

use std::collections::{BTreeMap, VecDeque};
use std::fs;
use std::path::{Path, PathBuf};

use super::markdown;

/// The lesson of a scene, and the first page of a book.
const FIRST: &str = "README.md";
/// The folder of the book, beside that of the scenes.
const BOOK: &str = "docs";
/// What reports print, in one document, whose lines are too long for a narrow page: on the site it is the reports themselves.
const EQUATIONS: &str = "docs/equations.md";

/// What is written in Markdown below the folder that holds the scenes.
#[derive(Debug, Default)]
pub(super) struct Documents {
    /// The folder that holds the folder of scenes.
    root: PathBuf,
    /// The name of the folder of scenes in it.
    scenes: String,
    /// Names of the scenes, those of their folders.
    names: Vec<String>,
    /// Texts by their paths from the root, with `/` between folders.
    pub(super) texts: BTreeMap<String, String>,
}

impl Documents {
    /// The lessons of these scenes and the book beside them; each document that one of them leads to is one of them.
    pub(super) fn beside(folder: &Path, names: &[String]) -> Self {
        let Ok(folder) = folder.canonicalize() else { return Self::default() };
        let (Some(root), Some(scenes)) = (folder.parent(), folder.file_name()) else {
            return Self::default();
        };
        let scenes = scenes.to_string_lossy().into_owned();
        let lessons = names.iter().map(|name| format!("{scenes}/{name}/{FIRST}"));
        let mut waiting: VecDeque<String> = lessons.chain([format!("{BOOK}/{FIRST}")]).collect();
        let mut texts = BTreeMap::new();
        while let Some(path) = waiting.pop_front() {
            if texts.contains_key(&path) {
                continue;
            }
            if let Ok(text) = fs::read_to_string(root.join(&path)) {
                let links = markdown::links(&text);
                let next = links.iter().filter_map(|link| Some(resolved(&path, link)?.0));
                waiting.extend(next.filter(|path| path.ends_with(".md") && path != EQUATIONS));
                texts.insert(path, text);
            }
        }
        Self { root: root.to_owned(), scenes, names: names.to_vec(), texts }
    }

    /// Whether there is a book.
    pub(super) fn has_book(&self) -> bool {
        self.texts.contains_key(&format!("{BOOK}/{FIRST}"))
    }

    /// The text of a scene's lesson.
    pub(super) fn lesson(&self, scene: &str) -> Option<&str> {
        self.texts.get(&format!("{}/{scene}/{FIRST}", self.scenes)).map(String::as_str)
    }

    /// The name of a scene, as it is kept.
    fn known(&self, name: &str) -> Option<&str> {
        self.names.iter().find(|known| *known == name).map(String::as_str)
    }

    /// The scene that a document is the lesson of.
    pub(super) fn scene_of(&self, path: &str) -> Option<&str> {
        let (name, rest) = path.strip_prefix(&self.scenes)?.strip_prefix('/')?.split_once('/')?;
        let name = self.known(name)?;
        (rest == FIRST).then_some(name)
    }

    /// The page of a document, from the folder of the site.
    pub(super) fn page_of(&self, path: &str) -> String {
        if let Some(scene) = self.scene_of(path) {
            return lesson_page(scene);
        }
        let own = path.strip_prefix(BOOK).and_then(|rest| rest.strip_prefix('/'));
        match own.unwrap_or(path).trim_end_matches(".md") {
            "README" if own.is_some() => BOOK_PAGE.to_owned(),
            stem => format!("book/{}.html", stem.replace('/', "-")),
        }
    }

    /// Where a link of a document leads on the site, from its folder; `None` where that is no page of it.
    pub(super) fn page_behind(&self, document: &str, link: &str) -> Option<String> {
        let (path, part) = resolved(document, link)?;
        let part = part.map(|part| format!("#{part}")).unwrap_or_default();
        if self.texts.contains_key(&path) {
            return Some(self.page_of(&path) + &part);
        }
        if path == EQUATIONS {
            return Some("index.html".to_owned());
        }
        let below = path.strip_prefix(&self.scenes).map(|rest| rest.trim_start_matches('/'));
        match below? {
            "" => Some("index.html".to_owned()),
            rest => {
                let scene = rest.trim_end_matches('/').trim_end_matches("/scene.toml");
                Some(report_page(self.known(scene)?))
            }
        }
    }

    /// The file that a link of a document leads to.
    pub(super) fn file_behind(&self, document: &str, link: &str) -> Option<PathBuf> {
        Some(self.root.join(resolved(document, link)?.0))
    }

    /// The scene whose file a command names.
    pub(super) fn scene_named(&self, file: &str) -> Option<&str> {
        let name = file.strip_prefix(&self.scenes)?.strip_prefix('/')?.strip_suffix("/scene.toml")?;
        self.known(name)
    }
}

/// The first page of the book.
pub(super) const BOOK_PAGE: &str = "book/index.html";

/// The page of a scene's lesson.
pub(super) fn lesson_page(scene: &str) -> String {
    format!("lessons/{scene}.html")
}

/// The page of a scene's report.
pub(super) fn report_page(scene: &str) -> String {
    format!("{scene}/report.html")
}

/// The path from the root that a relative link leads to, and the part of the page; `None` where it leads elsewhere.
fn resolved(document: &str, link: &str) -> Option<(String, Option<String>)> {
    if link.contains("://") || link.starts_with("mailto:") {
        return None;
    }
    let (target, part) = match link.split_once('#') {
        Some((target, part)) => (target, Some(part.to_owned())),
        None => (link, None),
    };
    if target.is_empty() {
        return Some((document.to_owned(), part));
    }
    let folder = document.rsplit_once('/').map_or("", |(folder, _)| folder);
    let mut names: Vec<&str> = vec![];
    for name in folder.split('/').chain(target.split('/')) {
        match name {
            "" | "." => {}
            ".." => drop(names.pop()?),
            name => names.push(name),
        }
    }
    Some((names.join("/"), part))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn some() -> Documents {
        let text = |path: &str| (path.to_owned(), String::new());
        let texts = ["docs/README.md", "docs/a.md", "ABOUT.md", "x/deep/b.md", "scenes/01-one/README.md"];
        Documents {
            root: "/root".into(),
            scenes: "scenes".into(),
            names: vec!["01-one".into(), "02-two".into()],
            texts: texts.into_iter().map(text).collect(),
        }
    }

    #[test]
    fn links_between_documents_lead_to_their_pages() {
        let documents = some();
        let lesson = |link: &str| documents.page_behind("scenes/01-one/README.md", link);
        assert_eq!(lesson("../../docs/a.md#part").as_deref(), Some("book/a.html#part"));
        assert_eq!(lesson("../../docs/README.md").as_deref(), Some("book/index.html"));
        assert_eq!(lesson("#here").as_deref(), Some("lessons/01-one.html#here"));
        assert_eq!(lesson("scene.toml").as_deref(), Some("01-one/report.html"));
        assert_eq!(lesson("../02-two/").as_deref(), Some("02-two/report.html"));
        assert_eq!(lesson("..").as_deref(), Some("index.html"));
        let book = |link: &str| documents.page_behind("docs/a.md", link);
        assert_eq!(book("../ABOUT.md").as_deref(), Some("book/ABOUT.html"));
        assert_eq!(book("../x/deep/b.md").as_deref(), Some("book/x-deep-b.html"));
        for elsewhere in
            ["missing.md", "../scenes/03-three/README.md", "../../..", "https://example.org/a.md"]
        {
            assert_eq!(book(elsewhere), None, "{elsewhere}");
        }
    }

    #[test]
    fn what_documents_lead_to_is_with_them() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let write = |path: &str, text: &str| {
            let path = folder.path().join(path);
            fs::create_dir_all(path.parent().expect("a folder")).expect("writable");
            fs::write(path, text).expect("writable");
        };
        write("scenes/one/README.md", "# One\n\n[more](../../notes/more.md)");
        write("notes/more.md", "# More\n\n[and more](deep/end.md) [out](../../../x.md)");
        write("notes/deep/end.md", "# End");
        write("notes/unread.md", "# Unread");
        let documents = Documents::beside(&folder.path().join("scenes"), &["one".into(), "two".into()]);
        let paths: Vec<&str> = documents.texts.keys().map(String::as_str).collect();
        assert_eq!(paths, ["notes/deep/end.md", "notes/more.md", "scenes/one/README.md"]);
        assert!(!documents.has_book() && documents.lesson("two").is_none());
    }
}
