//! Links of generated pages lead to files that are there, and to parts of them that have that name.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Component, Path, PathBuf};

use anyhow::{Result, bail};

use crate::workspace::read;

/// Attributes that lead somewhere.
const ATTRIBUTES: [&str; 4] = [" href=\"", " src=\"", " data-page=\"", " data-player=\""];
/// Parts of pages that a script makes: what is set in a page that plays.
const SETTINGS: char = '=';

/// Refuses pages in which a link is dead.
pub(crate) fn refuse(folder: &Path, pages: &[PathBuf]) -> Result<()> {
    let texts =
        pages.iter().map(|page| Ok((page.clone(), read(page)?))).collect::<Result<BTreeMap<_, _>>>()?;
    let names: BTreeMap<&PathBuf, BTreeSet<&str>> =
        texts.iter().map(|(page, text)| (page, values(text, " id=\"").collect())).collect();
    let mut count = 0;
    let mut dead = vec![];
    for (page, text) in &texts {
        for link in ATTRIBUTES.iter().flat_map(|attribute| values(text, attribute)).filter(|l| is_local(l)) {
            count += 1;
            let (path, part) = link.split_once('#').map_or((link, ""), |(path, part)| (path, part));
            let to = if path.is_empty() { page.clone() } else { joined(page, path) };
            let is_named = part.is_empty()
                || part.contains(SETTINGS)
                || names.get(&to).is_some_and(|names| names.contains(part));
            if !to.starts_with(folder) || fs::metadata(&to).is_err() || !is_named {
                dead.push(format!("{}: {link}", page.display()));
            }
        }
    }
    if !dead.is_empty() {
        bail!("{} dead links:\n{}", dead.len(), dead.join("\n"));
    }
    println!("{count} links between {} pages lead somewhere", pages.len());
    Ok(())
}

/// The values of an attribute.
fn values<'a>(text: &'a str, attribute: &'a str) -> impl Iterator<Item = &'a str> {
    text.match_indices(attribute).filter_map(move |(at, _)| text[at + attribute.len()..].split('"').next())
}

fn is_local(link: &str) -> bool {
    !link.contains(':') && !link.contains("${") && !link.is_empty()
}

/// Where a relative path leads from a page.
fn joined(page: &Path, path: &str) -> PathBuf {
    let mut found = page.parent().unwrap_or(page).to_owned();
    for part in Path::new(path).components() {
        match part {
            Component::ParentDir => _ = found.pop(),
            Component::Normal(name) => found.push(name),
            _ => {}
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn judged(link: &str) -> bool {
        let folder = std::env::temp_dir().join(format!("tumble-links-{}-{}", std::process::id(), link.len()));
        fs::create_dir_all(folder.join("below")).unwrap();
        let [one, other] = ["below/one.html", "other.html"].map(|name| folder.join(name));
        fs::write(&one, format!("<a href=\"{link}\">")).unwrap();
        fs::write(&other, "<h2 id=\"part\">").unwrap();
        let is_good = refuse(&folder, &[one, other]).is_ok();
        fs::remove_dir_all(&folder).unwrap();
        is_good
    }

    #[test]
    fn living_links_pass_and_dead_ones_are_refused() {
        for good in ["../other.html", "../other.html#part", "#T=2s", "https://example.org/"] {
            assert!(judged(good), "{good}");
        }
        for dead in ["other.html", "../other.html#nothing", "../../outside.html", "#nothing"] {
            assert!(!judged(dead), "{dead}");
        }
    }
}
