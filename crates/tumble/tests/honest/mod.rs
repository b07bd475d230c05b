//! Scenes with known answers, from their text to what is found: the truth lies within the error that is stated, the error
//! is small enough to be of use, and nothing is passed over in silence.

mod ask;
mod balanced;
mod events;
mod forces;
mod formulas;
mod impacts;
mod joints;
mod lines;
mod open;
mod refusals;
mod rounding;
mod signs;
mod still;
mod tallies;
mod times;
mod touching;
