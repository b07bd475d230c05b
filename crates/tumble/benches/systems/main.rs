//! Work and time on systems with known answers, beside peers in the same run.
//!
//! `cargo bench -p tumble --bench systems` prints, for each system and accuracy, what the layers of an answer cost and how
//! long a peer takes for the same error ([`layers`]); then how long a scene's text takes to become equations, and a cold
//! process from the text to its tables ([`processes`]). What follows after `--`:
//!
//! | option | what |
//! |---|---|
//! | `--long` | more repetitions; processor time and memory of large sweeps, too |
//! | `--beside PROGRAM ARGUMENTS..` | instead: our time a step and that of another program, in turn |
//! | `--json` | instead: the pendulum in the wind as JSON, for programs that compare |
//!
//! Every time is the least of many, and what is compared is run in turn, so that both meet the same noise.

mod beside;
mod json;
mod layers;
mod measure;
mod peer;
mod problems;
mod processes;

fn main() {
    // Cargo says `--bench` to every benchmark.
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    let is_long = arguments.first().is_some_and(|first| first == "--long");
    match &arguments[..] {
        [first, program, rest @ ..] if first == "--beside" => beside::table(program, rest),
        [first] if first == "--json" => json::print(),
        [] | [_] if arguments.is_empty() || is_long => {
            layers::tables(is_long);
            processes::tables(is_long);
        }
        _ => eprintln!("what is asked for? --long, --json, or --beside PROGRAM ARGUMENTS.."),
    }
}
