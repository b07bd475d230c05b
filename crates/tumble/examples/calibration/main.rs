//! Holds the errors that tumble states against true ones, over random problems with known answers.
//!
//! ```sh
//! cargo run --release -p tumble --example calibration -- [COUNT [SEED [FAMILY]]]
//! cargo run --release -p tumble --example calibration -- --only FAMILY SEED INDEX
//! ```
//!
//! The first prints tables and the worst failures, the second one problem with its scene and all its values.

mod apart;
mod survey;

use anyhow::{Context, Result, bail};
use survey::Key;

/// Problems of a survey, where nothing else is said.
const COUNT: u64 = 10_000;
/// Its seed.
const SEED: u64 = 1;

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words[..] {
        ["--only", family, seed, index] => print_one(&key(family, seed, index)?),
        [apart::ANSWER, family, seed, index] => {
            print!("{}", survey::transfer::write(&key(family, seed, index)?.measured()));
        }
        [] => print((COUNT, SEED), None),
        [count] => print((number(count)?, SEED), None),
        [count, seed] => print((number(count)?, number(seed)?), None),
        [count, seed, family] => {
            let known =
                survey::families::named(family).with_context(|| format!("there is no family `{family}`"))?;
            print((number(count)?, number(seed)?), Some(known));
        }
        _ => bail!("say COUNT SEED FAMILY or --only FAMILY SEED INDEX"),
    }
    Ok(())
}

fn key(family: &str, seed: &str, index: &str) -> Result<Key> {
    let key = Key::named(family, number(seed)?, number(index)?);
    key.with_context(|| format!("there is no family `{family}`"))
}

fn number(word: &str) -> Result<u64> {
    word.parse().with_context(|| format!("`{word}` is no whole number"))
}

fn print_one(key: &Key) {
    // The scene comes first: its motion may take a while.
    println!("{}", key.scene());
    print!("{}", key.values(key.measured()));
}

fn print((count, seed): (u64, u64), family: Option<usize>) {
    let survey = survey::survey((count, seed), family, apart::measured);
    println!("{count} problems, seed {seed}\n\n{}", survey::render(&survey));
    survey::missed(&survey).iter().for_each(|target| println!("missed: {target}"));
}
