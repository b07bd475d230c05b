//! What is given to others: packages of the crates, and a program that needs nothing of the machine it runs on.

use std::path::{Path, PathBuf};
use std::{env, fs};

use anyhow::{Context, Result, ensure};

use crate::command::{self, Process};
use crate::workspace::{Workspace, copy};

/// Linked with nothing of the system.
const TARGET: &str = "x86_64-unknown-linux-musl";
/// What goes with the program, and how it is called there.
const WITH_IT: [(&str, &str); 5] = [
    ("README.md", "README.md"),
    ("LICENSE-APACHE", "LICENSE-APACHE"),
    ("LICENSE-MIT", "LICENSE-MIT"),
    ("CITATION.cff", "CITATION.cff"),
    ("crates/tumble-notation/font/LICENSE.txt", "LICENSE-formulas-font.txt"),
];
/// Whose fonts are in the program, with their notices in its `NOTICE`.
const FONTS: &str = "typst-assets";

/// Every crate, packaged and built from its package.
pub(crate) fn packages(workspace: &Workspace) -> Result<()> {
    let folder = workspace.scratch("packages")?;
    forget(&folder.join("debug/.fingerprint"))?;
    // Registries in folders, as the one is that cargo packages into, have no host in their names.
    for registry in named(&cargo_home()?.join("registry/src"), "-")? {
        forget(&registry)?;
    }
    let arguments = ["package", "--workspace", "--exclude", "xtask", "--locked", "--allow-dirty"];
    // What is built is not run: nobody debugs it, and it is built once.
    let bare = [("CARGO_PROFILE_DEV_DEBUG", "none"), ("CARGO_INCREMENTAL", "0")];
    let packaging = workspace.cargo(arguments).arg("--target-dir").arg(&folder);
    bare.into_iter().fold(packaging, |packaging, (name, value)| packaging.env(name, value)).run()
}

fn cargo_home() -> Result<PathBuf> {
    let own = env::var_os("CARGO_HOME").map(PathBuf::from);
    own.or_else(|| Some(env::home_dir()?.join(".cargo"))).context("no home of cargo")
}

/// Removes what a folder has of our crates from when they were packaged before, unpacked or built: cargo takes a package of the same
/// version for the same, and would build the crates above against the older one.
fn forget(folder: &Path) -> Result<()> {
    for package in named(folder, "tumble")? {
        fs::remove_dir_all(&package).with_context(|| format!("cannot remove {}", package.display()))?;
    }
    Ok(())
}

/// What stands in a folder with a name that begins so.
fn named(folder: &Path, begin: &str) -> Result<Vec<PathBuf>> {
    let begins =
        |path: &PathBuf| path.file_name().is_some_and(|name| name.to_string_lossy().starts_with(begin));
    Ok(entries(folder)?.into_iter().filter(begins).collect())
}

/// What stands in a folder; nothing where there is none.
fn entries(folder: &Path) -> Result<Vec<PathBuf>> {
    if !folder.is_dir() {
        return Ok(vec![]);
    }
    let list = fs::read_dir(folder).with_context(|| format!("cannot read {}", folder.display()))?;
    list.map(|entry| Ok(entry?.path())).collect()
}

/// The static program in an archive, with licences and the notices of its fonts.
pub(crate) fn program(workspace: &Workspace) -> Result<()> {
    if let Some(rustup) = command::find("rustup") {
        Process::new(rustup, workspace.root()).args(["target", "add", TARGET]).run()?;
    }
    let folder = workspace.scratch("release")?;
    let build = ["build", "--release", "--locked", "--package", "tumble", "--target", TARGET];
    workspace.cargo(build).arg("--target-dir").arg(&folder).run()?;
    let program = folder.join(TARGET).join("release/tumble");
    ensure!(is_static(&program)?, "{} asks for a loader: it is not static", program.display());
    let archive = archived(workspace, &program)?;
    println!("{}", archive.display());
    Ok(())
}

/// Whether an ELF file for 64 bits has no part that names a loader.
fn is_static(program: &Path) -> Result<bool> {
    /// The type of such a part.
    const LOADER: u64 = 3;
    let bytes = fs::read(program).with_context(|| format!("cannot read {}", program.display()))?;
    let number = |at: usize, length: usize| {
        let digits = bytes.get(at..at + length).context("too short for a program")?;
        Ok(digits.iter().rev().fold(0, |number, digit| number << 8 | u64::from(*digit)))
    };
    let (first, size, count) = (number(0x20, 8)?, number(0x36, 2)?, number(0x38, 2)?);
    let types = (0..count).map(|index| number((first + index * size) as usize, 4));
    let types: Vec<u64> = types.collect::<Result<_>>()?;
    Ok(!types.is_empty() && !types.contains(&LOADER))
}

fn archived(workspace: &Workspace, program: &Path) -> Result<PathBuf> {
    let version = Process::new(program, workspace.root()).arg("--version").output()?;
    let version = version.split_whitespace().nth(1).context("a program without a version")?;
    let name = format!("tumble-{version}-{TARGET}");
    let place = workspace.empty_scratch("archive")?;
    let folder = place.join(&name);
    copy(program, &folder.join("tumble"))?;
    for (file, own) in WITH_IT {
        copy(&workspace.path(file), &folder.join(own))?;
    }
    copy(&notice(workspace)?, &folder.join("NOTICE-fonts.txt"))?;
    let archive = place.join(format!("{name}.tar.gz"));
    Process::new("tar", &place).arg("-czf").arg(&archive).arg(&name).run()?;
    Ok(archive)
}

/// The notices of the fonts, in the sources of the crate that carries them.
fn notice(workspace: &Workspace) -> Result<PathBuf> {
    let text = workspace.cargo(["metadata", "--format-version", "1", "--locked"]).output()?;
    let metadata: serde_json::Value = serde_json::from_str(&text).context("cargo metadata")?;
    let packages = metadata["packages"].as_array().context("no packages")?;
    let fonts = packages.iter().find(|package| package["name"] == FONTS).context("no fonts")?;
    let manifest = fonts["manifest_path"].as_str().context("no manifest")?;
    Ok(Path::new(manifest).with_file_name("NOTICE"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_our_packages_are_forgotten() {
        let root = env::temp_dir().join(format!("tumble-packages-{}", std::process::id()));
        let all = ["tumble-expr-0.1.0", "libm-0.2.1"];
        for package in all {
            fs::create_dir_all(root.join(package)).unwrap();
        }
        forget(&root).unwrap();
        assert_eq!(all.map(|package| root.join(package).is_dir()), [false, true]);
        forget(&root.join("nowhere")).unwrap();
        fs::remove_dir_all(root).unwrap();
    }

    #[test]
    fn our_own_program_here_needs_a_loader() {
        let own = env::current_exe().unwrap();
        assert!(!is_static(&own).unwrap());
        assert!(is_static(Path::new("/dev/null")).is_err());
    }
}
