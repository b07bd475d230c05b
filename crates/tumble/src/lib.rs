//! A rigid-body mechanics laboratory: state the bodies and the forces, get the motion.
//!
//! From Rust, forces are written as formulas. They are traced, not called: the integrator needs their Taylor series,
//! so a condition inside a force is written with [`prelude::select`], never with `if`.
//!
//! ```
//! use tumble::prelude::*;
//!
//! # fn main() -> Result<(), RunError> {
//! let (m, l, d) = (1.0 * KG, 1.0 * M, 0.02 * KG / M);
//! let (w1, period) = (20.0 * M / S, 4.0 * S);
//! let wind = |t: Expr| vector([0.5 * &w1 * (1.0 + cos(2.0 * pi() * t / &period)), zero()]);
//!
//! let mut model = Model::new();
//! model.gravity = Gravity::Vertical(9.81 * M / (S * S));
//! let rod = model.add(Body::rod("rod", [0 * M, 0 * M], [0 * M, -l]).mass(m));
//! model.pivot(&rod, [0 * M, 0 * M]);
//! let u = wind(t()) - rod.cm().velocity();
//! model.force("air", &rod.cm(), d * norm(&u) * &u);
//!
//! let start = [(&rod, Start::default())];
//! let run = model.simulate(&start, 2.0 * S)?;
//! let theta = run.at(1.2)?.angle(&rod)?;
//! assert!((0.0..1.0).contains(&theta));
//! # Ok(())
//! # }
//! ```
//!
//! What a scene gives, tables, figures, verified digits and the report, a model made in Rust gets by a [`prelude::Plan`] and
//! [`pipeline::run_study`].
//!
//! From a file, [`pipeline::run`] is the whole way: scene, study, equations, trajectory, tables and figures.

pub mod gallery;
pub mod output;
pub mod pipeline;
pub mod prelude;
pub mod progress;
pub mod templates;

mod figure_files;
mod jobs;
mod outcome;
mod report_file;
mod runs;
mod summary;
mod tables;

pub use pipeline::{Options, Outcome, PipelineError};
pub use report_file::{Form as ReportForm, InSite};
pub use tumble_report::results::{
    Case, CaseBalance, CaseError, CheckResult, FindResult, Finished, Happened, Held, Located, Missing, Tally,
};

/// The programs in the documents, compiled and run as tests of the documentation.
#[cfg(doctest)]
mod documents {
    #[doc = include_str!("../../../README.md")]
    struct Readme;
    #[doc = include_str!("../../../docs/writing-forces.md")]
    struct WritingForces;
}
