//! Settings from the command line, such as `--set T=2s`, that stand in the place of parameters and of the accuracy.

use crate::code::Code;
use crate::diagnostic::{Diagnostic, SourceText};
use crate::draft::Draft;
use crate::formula::{Origin, Text};
use crate::names::{ACCURACY, Level};
use crate::sections::start;
use crate::suggest;

/// Another formula for a parameter, as `--set name=text` gives it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Override {
    /// Name of the parameter.
    pub name: String,
    /// Its formula.
    pub text: String,
}

/// A setting as a source of its own.
#[derive(Clone, Debug)]
pub(crate) struct Setting {
    pub(crate) name: String,
    pub(crate) text: Text,
}

impl Override {
    /// As a source that diagnostics can point into.
    pub(crate) fn source(&self) -> SourceText {
        let text = format!("{}={}", self.name, self.text);
        SourceText { name: format!("--set {text}"), text }
    }

    /// With its place in the source of that index.
    pub(crate) fn setting(&self, source: usize) -> Setting {
        let origin = Origin::of_setting(source, self.name.len() + 1, self.text.len());
        let text = Text { key: self.name.clone(), text: self.text.clone(), origin };
        Setting { name: self.name.clone(), text }
    }
}

/// Settings of parameters that there are not.
pub(crate) fn refuse_unknown(draft: &mut Draft) {
    let parameters: Vec<_> = draft.model.parameters.symbols().into_iter().map(|symbol| symbol.name).collect();
    let known = |name: &str| {
        name == ACCURACY
            || draft.model.parameters.symbol(name).is_some()
            || draft.names.is_broken(name)
            || start::is_setting(&draft.names, name)
    };
    let unknown: Vec<_> = draft.settings.iter().filter(|setting| !known(&setting.name)).cloned().collect();
    for setting in unknown {
        let exists = draft.names.scope(Level::Output).value(&setting.name).is_some();
        let message = match exists {
            true => format!("`{}` is not a parameter, and cannot be set", setting.name),
            false => format!("there is no parameter `{}`", setting.name),
        };
        let all = parameters.iter().map(|name| &**name).chain([ACCURACY]);
        let help = suggest::name(&setting.name, "names that can be set", all);
        let mistake = Diagnostic::new(Code::UnknownParameter, 0..setting.name.len(), message);
        draft.note(mistake.within(setting.text.origin.source).label("unknown parameter").help(help));
    }
}
