//! Which subroutines outlines call: programs are followed as far as calls and lengths depend on it.

use std::collections::BTreeSet;

/// Calls within calls that the format allows.
const DEEPEST: usize = 10;

/// Where a program is.
#[derive(Default)]
struct State {
    stack: Vec<i32>,
    /// Hints so far: masks have a bit for each.
    stems: usize,
}

/// The subroutines, with nothing in the place of those that these programs do not call.
pub(super) fn kept<'a>(all: &[&'a [u8]], programs: &[&[u8]]) -> Option<Vec<&'a [u8]>> {
    let mut used = BTreeSet::new();
    for program in programs {
        follow(program, all, &mut State::default(), &mut used, 0)?;
    }
    let keep = |(index, program): (usize, &&'a [u8])| if used.contains(&index) { *program } else { &[][..] };
    Some(all.iter().enumerate().map(keep).collect())
}

/// Calls count from the middle of the list.
fn bias(count: usize) -> i32 {
    match count {
        0..1240 => 107,
        1240..33900 => 1131,
        _ => 32768,
    }
}

fn follow(
    program: &[u8],
    all: &[&[u8]],
    state: &mut State,
    used: &mut BTreeSet<usize>,
    depth: usize,
) -> Option<()> {
    if depth > DEEPEST {
        return None;
    }
    let mut at = 0;
    while let Some(first) = program.get(at).copied() {
        at += 1;
        let byte = |offset: usize| program.get(at + offset).copied().map(i32::from);
        match first {
            10 => {
                let index = usize::try_from(state.stack.pop()? + bias(all.len())).ok()?;
                used.insert(index);
                follow(all.get(index)?, all, state, used, depth + 1)?;
            }
            11 | 14 => return Some(()),
            // Global subroutines: this font has none.
            29 => return None,
            1 | 3 | 18 | 23 => state.count_stems(),
            19 | 20 => {
                state.count_stems();
                at += state.stems.div_ceil(8);
            }
            12 => {
                at += 1;
                state.stack.clear();
            }
            28 => {
                state.stack.push(i32::from(i16::from_be_bytes([byte(0)? as u8, byte(1)? as u8])));
                at += 2;
            }
            32..=246 => state.stack.push(i32::from(first) - 139),
            247..=250 => {
                state.stack.push((i32::from(first) - 247) * 256 + byte(0)? + 108);
                at += 1;
            }
            251..=254 => {
                state.stack.push(-(i32::from(first) - 251) * 256 - byte(0)? - 108);
                at += 1;
            }
            255 => {
                state.stack.push(0);
                at += 4;
            }
            _ => state.stack.clear(),
        }
    }
    Some(())
}

impl State {
    fn count_stems(&mut self) {
        self.stems += self.stack.len() / 2;
        self.stack.clear();
    }
}
