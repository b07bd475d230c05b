//! The modes that the runs went through: of several runs that went through one, the first tells of it.

use std::collections::HashSet;

use tumble_mech::{ContactMode, Mode};
use tumble_ode::Piece;

use crate::results::Case;

/// A mode, and the first run that went through it.
pub(super) struct Passed<'a> {
    pub(super) case: &'a Case,
    pub(super) mode: Mode,
}

/// Those of each body; what one contact is given no force of, because others do it, is one of several that might push.
pub(super) fn by_body(cases: &[Case]) -> Vec<Vec<Passed<'_>>> {
    let bodies = 0..cases[0].run.equations.model().bodies.len();
    bodies.map(|body| of_body(cases, body)).collect()
}

fn of_body(cases: &[Case], body: usize) -> Vec<Passed<'_>> {
    each_once(cases, |case| {
        let mut modes = case.run.of_body(body).trajectory().modes.clone();
        for (_, contact) in modes.iter_mut().flat_map(|mode| &mut mode.contacts) {
            if *contact == ContactMode::Idle {
                *contact = ContactMode::Resting;
            }
        }
        modes
    })
}

/// Those in which the motion has stayed: at the instant of the start there may be another one, and while impacts end that are too low to be
/// followed it stays for no time that a reader knows of.
pub(super) fn lasting(cases: &[Case]) -> Vec<Passed<'_>> {
    each_once(cases, |case| {
        let trajectory = case.run.trajectory();
        let stays = |number: usize| {
            trajectory.pieces.iter().any(|piece: &Piece| piece.mode == number && piece.end > piece.start)
        };
        let settles =
            |mode: &Mode| mode.contacts.iter().any(|(_, contact)| *contact == ContactMode::Settling);
        let modes = trajectory.modes.iter().enumerate();
        modes
            .filter(|(number, mode)| stays(*number) && !settles(mode))
            .map(|(_, mode)| mode.clone())
            .collect()
    })
}

fn each_once(cases: &[Case], modes: impl Fn(&Case) -> Vec<Mode>) -> Vec<Passed<'_>> {
    let mut known = HashSet::new();
    let all = cases.iter().flat_map(|case| modes(case).into_iter().map(move |mode| Passed { case, mode }));
    all.filter(|passed| known.insert(passed.mode.clone())).collect()
}
