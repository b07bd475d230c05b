//! What the command does besides running scenes, one noun a file.

pub(crate) mod completions;
pub(crate) mod explain;
pub(crate) mod new;
pub(crate) mod say;
#[cfg(test)]
mod scaffold;
pub(crate) mod schema;
pub(crate) mod stop;
pub(crate) mod units;
