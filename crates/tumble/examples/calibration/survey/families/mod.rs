//! Families of problems with known answers.

mod breaks;
mod bumps;
mod compliant;
mod extremes;
mod glances;
mod guards;
mod hertz;
mod impacts;
mod linear;
mod lines;
mod pendulum;
mod resists;
mod rounds;
mod rubs;
mod settles;
mod slopes;
mod spins;
mod stands;
mod stops;
mod strikes;
mod switches;
mod throws;
mod twist;
mod walls;
mod windows;

use std::cell::Cell;
use std::panic::{catch_unwind, set_hook, take_hook};
use std::sync::Once;

use super::draw::Draw;
use super::setup::{Problem, Setup};

/// A kind of problem.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Family {
    /// How tables and the command call it.
    pub(crate) name: &'static str,
    make: fn(Setup) -> Problem,
}

/// Every family; a new one is a new entry at the end, so that the others keep their problems.
pub(crate) const FAMILIES: &[Family] = &[
    Family { name: "linear", make: linear::make },
    Family { name: "pendulum", make: pendulum::make },
    Family { name: "guards", make: guards::make },
    Family { name: "bumps", make: bumps::make },
    Family { name: "ball", make: impacts::ball },
    Family { name: "level", make: impacts::level },
    Family { name: "walls", make: walls::make },
    Family { name: "compliant", make: compliant::make },
    Family { name: "windows", make: windows::make },
    Family { name: "flight", make: throws::flight },
    Family { name: "swing", make: throws::swing },
    Family { name: "spin", make: lines::spin },
    Family { name: "fall", make: lines::fall },
    Family { name: "damped", make: extremes::damped },
    Family { name: "plane", make: extremes::plane },
    Family { name: "twist", make: twist::make },
    Family { name: "switches", make: switches::make },
    Family { name: "stops", make: stops::make },
    Family { name: "breaks", make: breaks::make },
    Family { name: "backspin", make: spins::make },
    Family { name: "slopes", make: slopes::make },
    Family { name: "resists", make: resists::make },
    Family { name: "rod-strikes", make: strikes::rod },
    Family { name: "round-strikes", make: strikes::round },
    Family { name: "glances", make: glances::make },
    Family { name: "hertz", make: hertz::make },
    Family { name: "rounds", make: rounds::make },
    Family { name: "rubs", make: rubs::make },
    Family { name: "stands", make: stands::make },
    Family { name: "settles", make: settles::make },
];

/// What the number of a problem that is drawn anew is raised by.
const ANEW: u64 = 1 << 32;

/// The index of the family of a name.
pub(crate) fn named(name: &str) -> Option<usize> {
    FAMILIES.iter().position(|family| family.name == name)
}

/// A problem by the seed of its survey, its family and its number. Numbers that are written with few digits may make none, such as
/// a speed of zero where an answer is divided by it: then they are drawn anew.
pub(crate) fn problem(seed: u64, family: usize, index: u64) -> Problem {
    QUIET.call_once(tell_no_draws);
    let drawn = |attempt: u64| {
        let draw = Draw::of(seed, family as u64, index + attempt * ANEW);
        IS_DRAWING.set(true);
        let made = catch_unwind(|| (FAMILIES[family].make)(Setup::new(draw)));
        IS_DRAWING.set(false);
        made.ok()
    };
    (0..).find_map(drawn).expect("one of many draws makes a problem")
}

static QUIET: Once = Once::new();

thread_local! {
    static IS_DRAWING: Cell<bool> = const { Cell::new(false) };
}

/// That a draw makes no problem is nothing to tell.
fn tell_no_draws() {
    let tell = take_hook();
    set_hook(Box::new(move |panic| {
        if !IS_DRAWING.get() {
            tell(panic);
        }
    }));
}
