//! `cargo xtask lab`: builds the engine of pages that play, and puts it where the command takes it from.
//!
//! The built engine is in the repository, so that a plain `cargo run` writes pages that play on any machine. Beside it stand the hash
//! of the sources that it was built from, and what is in it under which licence.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use lzma_rust2::{LzmaOptions, LzmaWriter};
use sha2::{Digest, Sha256};

use crate::steps::Step;
use crate::tidy::{File, Tree};
use crate::workspace::{Workspace, read};

const TARGET: &str = "wasm32-unknown-unknown";
/// The engine takes so much stack, bytes: formulas and matrices do not recurse, drawings and TOML do a little. It has a gibibyte of
/// memory at most, so that a run that wants more fails and not the browser. Places of functions are written as short as they are.
const LINKING: &str =
    "-C link-arg=-zstack-size=4194304 -C link-arg=--compress-relocations -C link-arg=--max-memory=1073741824";
pub(crate) const ENGINE: &str = "crates/tumble/assets/engine.wasm.lzma";
pub(crate) const SOURCES: &str = "crates/tumble/assets/engine.sources";
const NOTICES: &str = "crates/tumble/assets/engine.notices";
/// The crates that it is made of.
const CRATES: [&str; 8] = ["expr", "ode", "mech", "scene", "notation", "drawing", "report", "lab"];
/// Parts of them that never reach it.
const NOT_IN_IT: [&str; 3] = ["/assets/", "/tests/", "/tests.rs"];

/// The one step.
pub(crate) fn steps() -> Vec<Step> {
    vec![Step { name: "engine", run: renew }]
}

fn renew(workspace: &Workspace) -> Result<()> {
    let engine = build(workspace)?;
    let packed = packed(&fs::read(&engine).with_context(|| format!("cannot read {}", engine.display()))?)?;
    println!("{} bytes in {}, {} in a page", packed.len(), ENGINE, (packed.len() * 16).div_ceil(13));
    write(&workspace.path(ENGINE), &packed)?;
    write(&workspace.path(SOURCES), format!("{}\n", hash(&Tree::of(workspace)?)).as_bytes())?;
    write(&workspace.path(NOTICES), notices(workspace)?.as_bytes())
}

/// Builds the engine, and returns where it is.
pub(crate) fn build(workspace: &Workspace) -> Result<PathBuf> {
    let arguments =
        ["build", "--locked", "--package", "tumble-lab", "--lib", "--profile", "engine", "--target", TARGET];
    let build = workspace.cargo(arguments).env("RUSTFLAGS", LINKING);
    build.run().with_context(|| format!("is the target there? `rustup target add {TARGET}` adds it"))?;
    Ok(workspace.target().join(TARGET).join("engine/tumble_lab.wasm"))
}

/// The hash of the sources that an engine is built from.
pub(crate) fn hash(tree: &Tree) -> String {
    let mut all: Vec<&File> = tree.files().iter().filter(|file| is_source(&file.path)).collect();
    all.sort_by(|a, b| a.path.cmp(&b.path));
    let mut hash = Sha256::new();
    for file in all {
        hash.update(format!("{}\0{}\0", file.path, file.text().len()));
        hash.update(file.text());
    }
    hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

fn is_source(path: &str) -> bool {
    let folders = CRATES.map(|name| format!("crates/tumble-{name}/"));
    let of_crate = folders
        .iter()
        .filter_map(|folder| path.strip_prefix(folder.as_str()))
        .any(|rest| rest.starts_with("src/") || rest == "Cargo.toml" || rest == "build.rs");
    (of_crate && NOT_IN_IT.iter().all(|part| !path.contains(part)))
        || path == "Cargo.toml"
        || path == "Cargo.lock"
}

/// Packed by LZMA, which is a quarter smaller than what browsers unpack themselves. Code is of bytes: their places tell nothing.
fn packed(bytes: &[u8]) -> Result<Vec<u8>> {
    let length = Some(bytes.len() as u64);
    let options =
        LzmaOptions { lc: 4, pb: 0, nice_len: LzmaOptions::NICE_LEN_MAX, ..LzmaOptions::with_preset(9) };
    let mut writer = LzmaWriter::new_use_header(vec![], &options, length)?;
    writer.write_all(bytes)?;
    Ok(writer.finish()?)
}

/// Every crate in it, with its version and licence.
fn notices(workspace: &Workspace) -> Result<String> {
    let arguments = ["tree", "--locked", "--package", "tumble-lab", "--edges", "normal", "--target", TARGET];
    let all = workspace.cargo(arguments).args(["--prefix", "none", "--format", "{p}: {l}"]).output()?;
    let mut lines: Vec<&str> = all.lines().map(|line| line.trim_end_matches(" (*)")).collect();
    lines.retain(|line| !line.starts_with("tumble-") && !line.is_empty());
    lines.sort_unstable();
    lines.dedup();
    if lines.is_empty() {
        bail!("`cargo tree` lists no crate of the engine");
    }
    Ok(format!(
        "The engine, engine.wasm.lzma, is made of this repository (MIT or Apache-2.0), of Rust's standard library (MIT or Apache-2.0), \
         and of these crates.\n\n{}\n",
        lines.join("\n")
    ))
}

/// Whether the engine of the repository is that of its sources.
pub(crate) fn is_renewed(tree: &Tree) -> bool {
    tree.file(SOURCES).is_some_and(|file| file.text().trim() == hash(tree))
}

/// Refuses an engine that is not of the sources.
pub(crate) fn refuse_stale(workspace: &Workspace) -> Result<()> {
    match read(&workspace.path(SOURCES))?.trim() == hash(&Tree::of(workspace)?) {
        true => Ok(()),
        false => bail!("the engine of pages is not that of the sources: run `cargo xtask lab`"),
    }
}

fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).with_context(|| format!("cannot create {}", folder.display()))?;
    }
    fs::write(path, bytes).with_context(|| format!("cannot write {}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_follows_what_is_in_the_engine_only() {
        let of =
            |path: &str, text: &str| hash(&Tree::from(&[("crates/tumble-expr/src/a.rs", "a"), (path, text)]));
        let nothing = hash(&Tree::from(&[("crates/tumble-expr/src/a.rs", "a")]));
        assert_ne!(of("crates/tumble-ode/src/b.rs", "b"), nothing);
        assert_ne!(of("crates/tumble-ode/src/b.rs", "b"), of("crates/tumble-ode/src/b.rs", "c"));
        assert_ne!(of("Cargo.lock", "b"), nothing);
        for other in ["crates/tumble/src/main.rs", "docs/a.md", "crates/tumble-report/src/report/assets/a.js"]
        {
            assert_eq!(of(other, "b"), nothing, "{other}");
        }
    }
}
