//! `[balance.NAME]`: energies and works along the run as curves.

use super::each;
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::study::{BalancePlot, Sheet};

pub(super) fn read(draft: &mut Draft, section: &Field) {
    each(draft, section, balance);
}

fn balance(draft: &mut Draft, field: &Field, table: &mut Table) {
    draft.figure_name(field);
    let title = table.take("title").and_then(|field| draft.line(&field));
    let show = match table.take("show") {
        Some(field) => draft.choice(&field, &Sheet::ALL.map(Sheet::word)),
        None => Some(Sheet::Energies.word()),
    };
    let Some(show) = show.and_then(|word| Sheet::ALL.into_iter().find(|sheet| sheet.word() == word)) else {
        return;
    };
    draft.balances.push(BalancePlot { name: field.key.to_owned(), title, show });
}
