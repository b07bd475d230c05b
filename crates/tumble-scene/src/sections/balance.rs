//! `[balance.NAME]`: energies and works along the run as curves.

use super::{TITLE, each};
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::keys::{Keys, Takes, may};
use crate::study::{BalancePlot, Sheet};

#[rustfmt::skip]
pub(super) const KEYS: Keys = Keys::of("[balance.NAME]", &[&[
    may("show", Takes::Word(&SHEETS), "`\"energies\"`", "\"works\"",
        "`\"energies\"`: kinetic, potential and total; `\"works\"`: what each load has done so far; \
         `\"residual\"`: what is left unexplained"),
    TITLE,
]]);

const SHEETS: [&str; 3] = [Sheet::Energies.word(), Sheet::Works.word(), Sheet::Residual.word()];

pub(super) fn read(draft: &mut Draft, section: &Field) {
    each(draft, section, &KEYS, balance);
}

fn balance(draft: &mut Draft, field: &Field, table: &mut Table) {
    draft.figure_name(field);
    let title = table.take("title").and_then(|field| draft.line(&field));
    let show = match table.take("show") {
        Some(field) => draft.choice(&field, &SHEETS),
        None => Some(Sheet::Energies.word()),
    };
    let Some(show) = show.and_then(|word| Sheet::ALL.into_iter().find(|sheet| sheet.word() == word)) else {
        return;
    };
    draft.balances.push(BalancePlot { name: field.key.to_owned(), title, show });
}
