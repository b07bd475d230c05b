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
        Law::Contact => format!("N_{}", contact(study, load)),
        Law::Friction => format!("f_{}", contact(study, rubbed(load))),
        Law::Reaction => format!("R_{last}"),
        _ if law.is_couple() => format!("tau_{last}"),
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

/// The contact that friction of this name is of.
pub(crate) fn rubbed(load: &str) -> &str {
    load.strip_suffix(".friction").unwrap_or(load)
}

/// Where a body is touched: by the point, `tip` of `floor.rod.tip`, and where there are several surfaces by them too.
pub(crate) fn contact(study: &Study, pair: &str) -> String {
    match pair.split_once('.') {
        Some((surface, _)) if study.model.surfaces.len() > 1 => format!("{surface}_{}", last(pair)),
        _ => last(pair).to_owned(),
    }
}

/// A symbol with one more letter below it: `N_tip,y`, `W_y`.
pub(crate) fn below(symbol: &str, letter: &str) -> String {
    let separator = if symbol.contains('_') { ',' } else { '_' };
    format!("{symbol}{separator}{letter}")
}

/// The torque of a force: `tau_air` of `F_air`, `tau_N,tip` of the contact's `N_tip`.
pub(crate) fn torque(force: &str) -> String {
    let below = force.strip_prefix("F_").or_else(|| force.strip_prefix("R_")).unwrap_or(force);
    format!("tau_{}", below.replace('_', ","))
}

/// The last word of a name: `tip` of `floor.rod.tip`.
pub(crate) fn last(name: &str) -> &str {
    name.rsplit('.').next().unwrap_or(name)
}
