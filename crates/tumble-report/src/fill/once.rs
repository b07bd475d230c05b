//! Equations that are told once: what another mode, another body or a law has said stands there alone.

use crate::report::{Block, Definition, ModeEquations, Text, Typeset};

use super::alike::listed;
use super::words;

/// What is said of equations that Newton's laws state as shortly as can be.
pub(super) const BY_NAME: &str =
    "Newton\u{2019}s laws above, with the forces of the table, are the equations of motion.";
/// The same where no force acts between events.
pub(super) const BY_LAWS: &str = "Newton\u{2019}s laws above are the equations of motion.";
/// What is said of conditions that stand beside Newton's laws.
pub(super) const BESIDE_LAWS: &str = "with Newton\u{2019}s laws above";
pub(super) const OTHERS_BY_NAME: &str = "The equations of motion of the bodies that are not listed here are Newton\u{2019}s laws above, with the forces of the table.";

/// What a symbol means is said where it comes first.
pub(super) fn defined_once(mut blocks: Vec<Block>) -> Vec<Block> {
    let mut said: Vec<Definition> = vec![];
    for block in &mut blocks {
        block.definitions.retain(|definition| !said.contains(definition));
        said.extend(block.definitions.iter().cloned());
    }
    blocks
}

/// Modes of the same equations are told together.
pub(super) fn told_once(mut told: Vec<ModeEquations>, next: ModeEquations) -> Vec<ModeEquations> {
    let is_same = |known: &&mut ModeEquations| known.equations == next.equations && known.holds == next.holds;
    match told.iter_mut().find(is_same) {
        Some(known) => known.name = words::either(&known.name.to_plain(), &next.name.to_plain()).into(),
        None => told.push(next),
    }
    told
}

/// Leaves out equations that are laws word for word, those that an earlier mode has told of, and those that differ from others
/// by numbers of names alone; `by_name` is said where none is left.
pub(super) fn say_once(modes: &mut [ModeEquations], laws: &[&Typeset], by_name: &str) {
    let mut told: Vec<(Text, Vec<Typeset>)> = vec![];
    for mode in modes {
        let all = mode.equations.len();
        mode.equations.retain(|block| !block.lines.iter().all(|line| laws.contains(&line)));
        if mode.equations.len() < all {
            mode.holds = if mode.equations.is_empty() { by_name } else { OTHERS_BY_NAME }.into();
        }
        let is_told =
            |block: &Block| told.iter().any(|(name, lines)| (name, lines) == (&block.title, &block.lines));
        let (again, new): (Vec<Block>, Vec<Block>) =
            mode.equations.drain(..).partition(|block| !block.title.is_empty() && is_told(block));
        if !again.is_empty() {
            let names: Vec<String> = again.iter().map(|block| block.title.to_plain()).collect();
            let as_above = Text::from(format!("As above: {}. ", listed(&names)));
            mode.holds = as_above.and(mode.holds.clone());
        }
        told.extend(new.iter().map(|block| (block.title.clone(), block.lines.clone())));
        mode.equations = likewise(new);
    }
}

/// Of bodies whose equations are the same but for the numbers in names, as those of a chain's links, the first is shown.
fn likewise(blocks: Vec<Block>) -> Vec<Block> {
    let mut shown: Vec<(Block, Vec<String>)> = vec![];
    for block in blocks {
        let same = shown.iter_mut().find(|(first, _)| {
            let forms = [first, &block].map(relative);
            forms[0].is_some() && forms[0] == forms[1]
        });
        match same {
            Some((_, others)) => others.push(body_of(&block).to_owned()),
            None => shown.push((block, vec![])),
        }
    }
    let told = |(block, others): (Block, Vec<String>)| match others.is_empty() {
        true => block,
        false => {
            let own = format!("; likewise, with their numbers, {}", listed(&others));
            Block { title: block.title.clone().and(own), ..block }
        }
    };
    shown.into_iter().map(told).collect()
}

/// The body of a block: `link 3` of `link 3, and the forces that hold it`.
fn body_of(block: &Block) -> String {
    block.title.to_plain().split(',').next().unwrap_or_default().to_owned()
}

/// The words and equations of a block with the numbers of names counted from that of its body; nothing for a body without one.
fn relative(block: &Block) -> Option<String> {
    let body = body_of(block);
    let (kind, own) = body.split_at(body.trim_end_matches(|c: char| c.is_ascii_digit()).len());
    let own: i64 = own.parse().ok()?;
    let said = block.title.to_plain().replacen(&body, kind, 1);
    let lines: Vec<String> = block.lines.iter().map(|line| counted_from(own, &line.text)).collect();
    Some(format!("{said}: {}", lines.join("; ")))
}

/// Numbers that end a name of several letters, such as `link3`, less `own`.
fn counted_from(own: i64, text: &str) -> String {
    let (mut shown, mut letters, mut digits) = (String::new(), 0, String::new());
    for c in text.chars().chain([' ']) {
        if c.is_ascii_digit() && letters > 1 {
            digits.push(c);
            continue;
        }
        if let Ok(number) = std::mem::take(&mut digits).parse::<i64>() {
            shown.push_str(&format!("({})", number - own));
        }
        letters = if c.is_alphabetic() { letters + 1 } else { 0 };
        shown.push(c);
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block(title: &str, line: &str) -> Block {
        let lines = vec![Typeset { text: line.to_owned(), ..Typeset::default() }];
        Block { title: title.into(), lines, ..Block::default() }
    }

    #[test]
    fn links_that_differ_by_their_numbers_are_told_once() {
        let chain = |n: i64| {
            block(&format!("link {n}"), &format!("2 m A_link{n} = R_joint{} \u{2212} R_joint{n}", n - 1))
        };
        let all = likewise(vec![chain(3), chain(4), chain(5), block("stone", "m A = 0")]);
        let titles: Vec<String> = all.iter().map(|block| block.title.to_plain()).collect();
        assert_eq!(titles, ["link 3; likewise, with their numbers, link 4 and link 5", "stone"]);
        let other = block("link 4", "3 m A_link4 = R_joint3 \u{2212} R_joint4");
        assert_eq!(likewise(vec![chain(3), other]).len(), 2, "a factor is no number of a name");
    }
}
