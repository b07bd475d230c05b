//! The engine of a page that plays, for WebAssembly: a scene goes in as text, the parts of the page come out.
//!
//! [`Session`] is a run of a scene in stages, between which its host sees whether somebody wants something else by now. The module
//! `abi` has it as functions that any host can call: plain numbers and bytes, no generated glue.
//!
//! A stage is not cut in the middle. A motion, its check runs and what is asked of them are one function that holds its state on the
//! stack, and making all of that resumable would give the integrator a second way to go on. So the host runs the engine in a worker,
//! lets a short run come to its end, ends the worker of a long one when something newer is wanted, and has another one ready: an
//! instance costs milliseconds, and what went wrong in one, out of memory included, is gone with it.

mod abi;
mod request;
mod session;

pub use request::Request;
pub use session::Session;
