//! Why a formula is not shown.

use thiserror::Error;
use tumble_expr::TypeError;

/// A formula that cannot be shown.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum MathError {
    /// Its parts do not fit together.
    #[error(transparent)]
    Type(#[from] TypeError),
    /// More parts than anyone would read.
    #[error("this formula has more than {limit} parts, too many to show")]
    TooLarge {
        /// The most that are shown.
        limit: usize,
    },
    /// An exact number or exponent that outgrows what is kept.
    #[error("this formula holds an exact number of more than {bits} bits, too long to show")]
    TooLong {
        /// The most that are kept.
        bits: u64,
    },
}
