//! Names that become those of files: what is a file here must be one on every system, and nothing else.

/// Names that Windows keeps for devices, whatever their ending and the case of their letters.
const DEVICES: &[&str] = &["con", "prn", "aux", "nul", "conin$", "conout$"];
/// These too, with a digit behind them.
const PORTS: &[&str] = &["com", "lpt"];
/// Digits of ports; Windows takes superscripts for digits.
const PORT_DIGITS: &[&str] = &["0", "1", "2", "3", "4", "5", "6", "7", "8", "9", "¹", "²", "³"];
/// Letters; nobody tells longer names apart.
const LONGEST: usize = 100;
/// Bytes: file systems have names of 255, and endings such as `.run-001.svg` come behind this.
const MOST_BYTES: usize = 200;

/// Why a name cannot be that of a file or folder on every system, as the end of a sentence; `None` if it can.
pub fn file_name_fault(name: &str) -> Option<String> {
    let special = |c: char| crate::is_unseen(c) || r#"/\:*?"<>|"#.contains(c);
    let fault = match name {
        "" => "it is empty",
        _ if name.contains(special) => "it leads to another folder, or has characters that files cannot have",
        _ if name.starts_with('.') => "it begins with a point, which hides files",
        _ if name.starts_with('-') => "it begins with a hyphen, as options of commands do",
        _ if name.trim() != name || name.ends_with('.') => {
            "it begins with a space, or ends in a space or a point"
        }
        _ if is_device(name) => "some systems keep it for themselves",
        _ if name.chars().count() > LONGEST => return Some(format!("it has more than {LONGEST} letters")),
        _ if name.len() > MOST_BYTES => return Some(format!("it has more than {MOST_BYTES} bytes")),
        _ => return None,
    };
    Some(fault.to_owned())
}

fn is_device(name: &str) -> bool {
    let stem = name.split('.').next().unwrap_or(name).trim_end().to_lowercase();
    let is_port = |port: &&str| stem.strip_prefix(*port).is_some_and(|digit| PORT_DIGITS.contains(&digit));
    DEVICES.contains(&&*stem) || PORTS.iter().any(is_port)
}

/// What names have in common that are one file on systems where the case of letters does not count.
pub(crate) fn folded(name: &str) -> String {
    // Both ways: letters such as the sharp s have no capital of one letter.
    name.to_uppercase().to_lowercase()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_everywhere() {
        let longest = "a".repeat(LONGEST);
        for name in ["swing", "my-scene 2", "Öse", "a.b", "con2", "com", "com10", "xcon", "lpt-1", &longest]
        {
            assert_eq!(file_name_fault(name), None, "{name}");
        }
    }

    #[test]
    fn names_that_some_system_takes_for_something_else() {
        let (long, wide) = ("a".repeat(LONGEST + 1), "摆".repeat(70));
        for name in [
            "",
            ".",
            "..",
            "../up",
            "a/b",
            "/tmp/x",
            "a\\b",
            "c:x",
            "-x",
            "-rf",
            ".x",
            "x.",
            " x",
            "x ",
            "NUL",
            "Con",
            "prn.svg",
            "aux .txt",
            "COM1",
            "lpt9",
            "COM²",
            "a\nb",
            "a\u{202e}b",
            &long,
            &wide,
        ] {
            assert!(file_name_fault(name).is_some(), "{name:?}");
        }
    }

    #[test]
    fn case_does_not_tell_files_apart() {
        assert_eq!(folded("Öse"), folded("öSE"));
        assert_ne!(folded("a"), folded("b"));
    }
}
