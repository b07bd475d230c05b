//! What a key is, declared once by the section that reads it: the reader, the schema, the page of the language and completion all
//! go by it.

use tumble_expr::Dimension;

use crate::sections::{SECTIONS, play, text};

/// A key with what it takes and what it means.
#[derive(Debug)]
pub struct Declared {
    /// How it is written.
    pub name: &'static str,
    /// What it takes.
    pub takes: Takes,
    /// What holds without it, in words; `None` where it must be given.
    pub default: Option<&'static str>,
    /// A value as a scene has it.
    pub example: &'static str,
    /// What it means, in Markdown: part of a sentence.
    pub says: &'static str,
    /// Where a scene that lacks it finds help: whole lines of one that has it.
    pub(crate) lines: Option<&'static str>,
}

/// A key that its table must have.
pub(crate) const fn must(
    name: &'static str,
    takes: Takes,
    example: &'static str,
    says: &'static str,
) -> Declared {
    Declared { name, takes, default: None, example, says, lines: None }
}

/// A key that its table may have; `default` says what holds without it.
pub(crate) const fn may(
    name: &'static str,
    takes: Takes,
    default: &'static str,
    example: &'static str,
    says: &'static str,
) -> Declared {
    Declared { default: Some(default), ..must(name, takes, example, says) }
}

/// What may stand behind a key.
#[derive(Debug)]
pub enum Takes {
    /// A text in quotes.
    Text,
    /// The name of one of these, such as a body, or of a point.
    Name(&'static str),
    /// A time, an event or a contact.
    Instant,
    /// A formula of any dimension; a pure number may stand without quotes.
    Formula,
    /// A formula of this dimension; only 0 may stand without quotes, unless it is a pure number.
    Quantity(Dimension),
    /// An angle, or angle per time.
    Angle(Dimension),
    /// Two of them, `[x, y]`.
    Vector(Dimension),
    /// `true` or `false`.
    Flag,
    /// `true` and nothing else.
    True,
    /// This number.
    Exactly(u32),
    /// A number without quotes, the ends included.
    Number(f64, f64),
    /// A whole number without quotes, the ends included.
    Count(usize, usize),
    /// One of these words.
    Word(&'static [&'static str]),
    /// A list of two.
    Pair(&'static Takes),
    /// A list of so many or more, and of so many at most.
    List(usize, usize, &'static Takes),
    /// A table with these keys.
    Table(&'static Keys),
    /// A table whose keys are the user's names.
    Named(&'static Takes),
    /// A table that has more of the user's names in it than keys.
    Open,
    /// Any of these.
    Either(&'static [Takes]),
}

impl Takes {
    /// The name of one body.
    pub(crate) const BODY: Self = Self::Name("body");
    /// The name of a surface.
    pub(crate) const SURFACE: Self = Self::Name("surface");
    /// The name of an event.
    pub(crate) const EVENT: Self = Self::Name("event");
    /// The name of a point, such as `"rod.tip"`.
    pub(crate) const POINT: Self = Self::Name("point");
    /// A pure number, or a formula that is one.
    pub(crate) const PURE: Self = Self::Quantity(Dimension::NONE);
    /// A length.
    pub(crate) const LENGTH: Self = Self::Quantity(Dimension::LENGTH);
    /// A time.
    pub(crate) const TIME: Self = Self::Quantity(Dimension::TIME);
    /// A place, or a distance with a direction.
    pub(crate) const PLACE: Self = Self::Vector(Dimension::LENGTH);
    /// No list is too long.
    pub const MOST: usize = usize::MAX;
}

/// The keys of a table.
#[derive(Debug)]
pub struct Keys {
    /// What the table is called: `[body.NAME]`, or the key of an inline table.
    pub title: &'static str,
    /// The keys, in the order of the language's page.
    groups: &'static [&'static [Declared]],
    /// Exactly one key of each of these must be there.
    pub one_of: &'static [&'static [&'static str]],
}

impl Keys {
    /// Those of an inline table.
    pub(crate) const fn of(title: &'static str, groups: &'static [&'static [Declared]]) -> Self {
        Self { title, groups, one_of: &[] }
    }

    /// The same, with one of some keys.
    pub(crate) const fn one_of(self, one_of: &'static [&'static [&'static str]]) -> Self {
        Self { one_of, ..self }
    }

    /// Every key; a section may have a text beside its own.
    pub fn iter(&self) -> impl Iterator<Item = &'static Declared> + Clone {
        let text: &'static [Declared] = if self.title.starts_with('[') { text::KEY } else { &[] };
        self.groups.iter().copied().flatten().chain(text)
    }

    /// The key of that name.
    pub(crate) fn find(&self, name: &str) -> Option<&'static Declared> {
        self.iter().find(|key| key.name == name)
    }
}

/// Sections, and keys at the top of a scene.
pub fn of_scene() -> impl Iterator<Item = &'static Declared> + Clone {
    SECTIONS.iter().map(|section| &section.declared)
}

/// What `[play]` has among the names of what may be changed, under `presets`.
pub const PRESETS: Takes = Takes::Table(&play::PRESET);

/// Every table with a fixed set of keys: what it stands behind, `[body` for a section or the key of an inline table, with its keys.
pub fn tables() -> Vec<(String, &'static Keys)> {
    let mut found = vec![];
    for section in of_scene() {
        gather(&format!("[{}", section.name), &section.takes, &mut found);
    }
    gather("[play.presets", &PRESETS, &mut found);
    found
}

fn gather(behind: &str, takes: &'static Takes, found: &mut Vec<(String, &'static Keys)>) {
    match takes {
        Takes::Table(keys) if !found.iter().any(|(known, of)| known == behind && of.title == keys.title) => {
            found.push((behind.to_owned(), keys));
            keys.iter().for_each(|key| gather(key.name, &key.takes, found));
        }
        Takes::Pair(inner) | Takes::List(.., inner) | Takes::Named(inner) => gather(behind, inner, found),
        Takes::Either(all) => all.iter().for_each(|one| gather(behind, one, found)),
        _ => {}
    }
}
