//! Where labels stand: what is drawn already, where a label may stand, and the choice for all labels of a picture together.

mod candidates;
mod labels;
mod occupancy;

pub(crate) use candidates::{Candidate, about_arc, about_arrow, about_line, about_point, beside_shaft};
pub(crate) use labels::{Placed, Tag, draw_placed, placed};
#[cfg(test)]
pub(crate) use occupancy::covers;
pub(crate) use occupancy::{Occupancy, beside};
