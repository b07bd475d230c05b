//! The report as one page of HTML.

mod data;
mod figures;
mod inline;
mod motion;
mod page;
mod sections;
mod tables;
#[cfg(test)]
mod tests;

#[cfg(feature = "pdf")]
pub(super) use figures::description;
#[cfg(feature = "pdf")]
pub(super) use motion::still;
pub(super) use page::page;
