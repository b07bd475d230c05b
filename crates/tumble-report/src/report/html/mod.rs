//! The report as one page of HTML.

mod data;
mod figures;
mod inline;
mod lab;
mod motion;
mod page;
mod parts;
mod tables;
#[cfg(test)]
mod tests;

pub(super) use data::label;
pub(crate) use inline::text;
pub use motion::{living, motion};
pub(super) use page::page;
pub use page::parts;
pub(crate) use page::{MOTION, joined};
