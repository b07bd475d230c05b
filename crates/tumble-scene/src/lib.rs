//! The scene language: a TOML file becomes a [`Study`], or a list of diagnostics that show what to change.
//!
//! [`read`] notes every mistake of a file, not the first. One section of the language is one file with its
//! [keys] and one function, and one entry in one table. There is no physics here: formulas go to `tumble-expr`, bodies and loads to `tumble-mech`.
//!
//! ```
//! let scene = r#"
//!     version = 1
//!     world.gravity = "9.81 m/s^2"
//!     run.until = "1 s"
//!
//!     [body.stone]
//!     point = {}
//!     mass = "1 kilo"
//! "#;
//! let mistakes = tumble_scene::read("scene.toml", scene, &[]).unwrap_err();
//! assert_eq!(mistakes.to_string(), "scene.toml:8:15: E0201: `kilo` is not a unit");
//! ```

mod code;
mod csv_text;
mod curve;
mod diagnostic;
mod document;
mod draft;
mod file_names;
mod files;
mod formula;
pub mod keys;
mod model_mistakes;
mod moments;
mod names;
mod places;
mod plan;
mod play;
mod printable;
mod quantities;
mod reader;
mod render;
mod sections;
mod settings;
mod study;
mod suggest;
mod sweep;
mod toml_text;
mod unit_text;
mod values;
mod words;

use draft::Draft;

pub use code::Code;
pub use diagnostic::{Diagnostic, Diagnostics, Severity, SourceText, Span, Underlined};
pub use file_names::file_name_fault;
pub use files::{Files, Folder, MAX_FILE_BYTES, NoFiles};
pub use moments::Count;
pub use plan::Plan;
pub use play::{Knob, Play, Preset};
pub use printable::{is_unseen, printable, printable_lines};
pub use settings::Override;
pub use study::{
    BalancePlot, Check, Commentary, Curve, FreeBody, Instant, Plot, Quantity, Question, Sheet, Stroboscope,
    Study, When,
};
pub use sweep::{SweepAxis, SweepValue, SweepValues, Swept};

/// A scene may have this many bytes.
pub const MAX_BYTES: usize = 16 << 20;

/// Reads a scene without measured tables from the bytes of a file; `name` is what diagnostics call it.
pub fn read_bytes(name: &str, bytes: &[u8], overrides: &[Override]) -> Result<Study, Diagnostics> {
    read_bytes_in(name, bytes, overrides, &NoFiles)
}

/// Reads a scene from the bytes of a file; its measured tables are in `files`.
pub fn read_bytes_in(
    name: &str,
    bytes: &[u8],
    overrides: &[Override],
    files: &dyn Files,
) -> Result<Study, Diagnostics> {
    refuse_size(name, bytes.len())?;
    let text = std::str::from_utf8(bytes).map_err(|error| not_text(name, bytes, error.valid_up_to()))?;
    read_in(name, text, overrides, files)
}

/// Reads a scene without measured tables; `name` is what diagnostics call it, `overrides` stand in the place of
/// parameters.
pub fn read(name: &str, text: &str, overrides: &[Override]) -> Result<Study, Diagnostics> {
    read_in(name, text, overrides, &NoFiles)
}

/// Reads a scene; its measured tables are in `files`, such as the [`Folder`] that it stands in.
pub fn read_in(
    name: &str,
    text: &str,
    overrides: &[Override],
    files: &dyn Files,
) -> Result<Study, Diagnostics> {
    refuse_size(name, text.len())?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut draft = Draft::begin(name, text, overrides);
    let (document, mistakes) = toml_text::parse(text);
    draft.mistakes = mistakes;
    match document {
        Some(_) if text.trim().is_empty() => draft.note(empty()),
        Some(document) => {
            draft.files = files::of_tables(document.get_ref(), files);
            read_document(&mut draft, document.get_ref());
        }
        None => {}
    }
    draft.finish()
}

fn read_document(draft: &mut Draft, document: &toml::de::DeTable) {
    sections::read(draft, document);
    settings::refuse_unknown(draft);
    model_mistakes::check(draft);
    values::check(draft);
    if draft.mistakes.is_empty() {
        draft.play = play::of(draft);
    }
}

fn refuse_size(name: &str, bytes: usize) -> Result<(), Diagnostics> {
    if bytes <= MAX_BYTES {
        return Ok(());
    }
    let message = format!("a scene has at most {MAX_BYTES} bytes, not {bytes}");
    Err(about_file(name, String::new(), Diagnostic::new(Code::TooLarge, 0..0, message).nowhere()))
}

fn not_text(name: &str, bytes: &[u8], at: usize) -> Diagnostics {
    let line = bytes[..at].iter().filter(|byte| **byte == b'\n').count() + 1;
    let message = format!("line {line} holds the byte 0x{:02x}, which is no text in UTF-8", bytes[at]);
    let readable = String::from_utf8_lossy(&bytes[..at]).into_owned();
    let mistake = Diagnostic::new(Code::Encoding, at..at, message).label("the text ends before this");
    about_file(name, readable, mistake.help("save the file as UTF-8"))
}

fn about_file(name: &str, text: String, mistake: Diagnostic) -> Diagnostics {
    Diagnostics::new(vec![SourceText { name: name.to_owned(), text }], vec![mistake])
}

fn empty() -> Diagnostic {
    let example = "version = 1\n\n[world]\ngravity = \"9.81 m/s^2\"\n\n[body.stone]\npoint = {}\nmass = \"1 kg\"\n\n[run]\nuntil = \"1 s\"";
    Diagnostic::new(Code::Empty, 0..0, "the file is empty")
        .nowhere()
        .help(format!("a short scene is\n{example}"))
}
