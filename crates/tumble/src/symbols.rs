//! How forces are written in diagrams, tables, equations and the animation: the same everywhere.

use tumble_mech::Law;
use tumble_report::Label;
use tumble_scene::Study;

/// The user's own symbol for a load, or the usual letter with the load's name.
pub(crate) fn force(study: &Study, load: &str, law: Law) -> String {
    if let Some(own) = study.symbols.get(load) {
        return own.clone();
    }
    let last = last(load);
    match law {
        Law::Weight => "W".to_owned(),
        Law::Contact => format!("N_{last}"),
        Law::Reaction => format!("R_{last}"),
        Law::Torque | Law::Torsion => format!("tau_{last}"),
        _ => format!("F_{last}"),
    }
}

/// The same for figures, where the weight is its formula: it stands for itself on paper.
pub(crate) fn force_label(study: &Study, load: &str, law: Law) -> Label {
    match law {
        Law::Weight if !study.symbols.contains_key(load) => weight(),
        _ => Label::symbol(&force(study, load, law)),
    }
}

/// `m g`
pub(crate) fn weight() -> Label {
    Label::markup("$m$ $g$")
}

/// The last word of a name: `tip` of `floor.rod.tip`.
pub(crate) fn last(name: &str) -> &str {
    name.rsplit('.').next().unwrap_or(name)
}
