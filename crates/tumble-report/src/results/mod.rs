//! The runs of a study and what they came to: the answers that a scene asks for, its claims, warnings, the balance.

pub(crate) mod case;
pub(crate) mod case_balance;
pub(crate) mod checks;
mod combinations;
pub(crate) mod digits;
pub(crate) mod equilibrium;
mod error;
pub(crate) mod finished;
mod known;
pub(crate) mod locate;
pub(crate) mod moments;
pub(crate) mod open;
mod placed;
pub(crate) mod questions;
pub(crate) mod samples;
pub(crate) mod survey;
pub(crate) mod swept;
pub(crate) mod tallies;
pub(crate) mod telling;
mod told;
pub(crate) mod works;

pub use case::{Case, Missing, Runs, folder};
pub use case_balance::{ABOUT, CaseBalance, Summary as BalanceSummary};
pub use checks::CheckResult;
pub use combinations::Combinations;
pub use digits::Held;
pub use equilibrium::Summary as EquilibriumSummary;
pub use error::CaseError;
pub use finished::{Finished, Happened, Tally};
pub use locate::{Equal, Optimum, Sample};
pub use questions::FindResult;
pub use samples::{SampleRow, equal_times, is_angle, sample, sample_between, unit};
pub use survey::{Located, Survey, Surveyor};
pub use swept::SweptAxis;
pub use telling::{FAMILY, telling};
pub use told::count;
