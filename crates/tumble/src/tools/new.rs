//! `tumble new NAME`: a scene to start from.

use std::fs::{self, File};
use std::io::{self, BufRead, IsTerminal, Write};
use std::path::Path;

use clap::ValueEnum;
use tumble_scene::{file_name_fault, printable};

use tumble::templates::TEMPLATES;

use super::say::{say, tell};
use crate::commands::Ending;

/// What a new scene shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Kind {
    /// A rod that swings on a hinge.
    Pendulum,
    /// A ball that is thrown through the air.
    Throw,
    /// A ball that bounces on the floor.
    Bounce,
    /// A ball that is kicked off-centre, seen from above.
    Kick,
    /// The least that a scene needs.
    Empty,
}

impl Kind {
    fn scene(self) -> &'static str {
        TEMPLATES[self as usize].1
    }

    /// Its name on the command line, and what it is.
    fn described(self) -> (String, String) {
        let value = self.to_possible_value();
        let help = value.as_ref().and_then(|value| value.get_help()).map(ToString::to_string);
        (value.map_or_else(String::new, |value| value.get_name().to_owned()), help.unwrap_or_default())
    }
}

/// Writes the scene of a kind into a new folder.
pub(crate) fn run(name: &str, kind: Option<Kind>) -> Ending {
    if let Some(fault) = file_name_fault(name) {
        tell!("error: \"{}\" cannot be the name of a scene: {fault}", printable(name));
        return Ending::Mistake;
    }
    // Before anything is asked.
    if fs::symlink_metadata(name).is_ok() {
        tell!("error: {name} exists already: choose another name, or remove it");
        return Ending::File;
    }
    let Some(kind) = kind.or_else(choose) else {
        tell!("error: no kind of scene was chosen");
        return Ending::Mistake;
    };
    match write(Path::new(name), kind.scene()) {
        Ok(()) => {
            say!("wrote {name}/scene.toml; run it with\n\n    tumble run {name}/scene.toml");
            Ending::Success
        }
        Err(error) => {
            tell!("error: cannot write {name}/scene.toml: {error}");
            Ending::File
        }
    }
}

/// The folder must be new, so that nothing is overwritten.
fn write(folder: &Path, scene: &str) -> io::Result<()> {
    fs::create_dir(folder)?;
    let file = folder.join("scene.toml");
    let written = File::create_new(&file).and_then(|mut made| made.write_all(scene.as_bytes()));
    written.inspect_err(|_| {
        // What was only begun does not stay, and the folder goes if it is empty.
        let _ = fs::remove_file(&file);
        let _ = fs::remove_dir(folder);
    })
}

/// The kind that a person at a terminal chooses; else the first.
fn choose() -> Option<Kind> {
    let stdin = io::stdin();
    if !stdin.is_terminal() {
        return Some(Kind::Pendulum);
    }
    asked(&mut stdin.lock())
}

fn asked(answers: &mut dyn BufRead) -> Option<Kind> {
    let kinds = Kind::value_variants();
    let described: Vec<_> = kinds.iter().map(|kind| kind.described()).collect();
    for ((name, help), number) in described.iter().zip(1..) {
        tell!("{number}  {name:<10}{help}");
    }
    loop {
        tell!("Which one? A number or a name; nothing for {}.", described[0].0);
        let mut answer = String::new();
        if answers.read_line(&mut answer).ok()? == 0 {
            return None;
        }
        let answer = answer.trim();
        let number = answer.parse::<usize>().ok().and_then(|number| number.checked_sub(1));
        let by_name = || kinds.iter().position(|kind| kind.described().0.eq_ignore_ascii_case(answer));
        let index = if answer.is_empty() { Some(0) } else { number.or_else(by_name) };
        if let Some(kind) = index.and_then(|index| kinds.get(index)) {
            return Some(*kind);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_has_its_own_template() {
        let told = Kind::value_variants().iter().map(|kind| kind.described().1);
        assert!(told.eq(TEMPLATES.iter().map(|(what, _)| *what)));
    }

    #[test]
    fn an_answer_is_a_number_a_name_or_nothing() {
        for (answers, kind) in [
            ("\n", Some(Kind::Pendulum)),
            ("2\n", Some(Kind::Throw)),
            ("Empty\n", Some(Kind::Empty)),
            ("0\n99\nwhat\nkick\n", Some(Kind::Kick)),
            ("", None),
            ("what", None),
        ] {
            assert_eq!(asked(&mut answers.as_bytes()), kind, "{answers:?}");
        }
    }
}
