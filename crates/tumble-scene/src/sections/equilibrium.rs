//! `[equilibrium]`: asks for the pose near the start in which nothing accelerates.

use super::only;
use crate::document::Field;
use crate::draft::Draft;
use crate::keys::Keys;

pub(super) const SAYS: &str = "asks for the pose near the start in which nothing accelerates";
pub(super) const KEYS: Keys = Keys::of("[equilibrium]", &[]);

/// All that it needs is known of the model: the section alone asks for it.
pub(super) fn read(draft: &mut Draft, section: &Field) {
    draft.remember("equilibrium", &section.key_span);
    draft.equilibrium = true;
    only(draft, section, &KEYS, |_, _| {});
}
