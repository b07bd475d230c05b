//! Why a motion does not go on through a singular configuration, in words.

use tumble_ode::{Piece, Reason};

use super::pose::Pose;
use super::rank::Rank;
use super::{LOST, states_beyond};
use crate::equations::Equations;
use crate::mode::Mode;

/// Bodies come to rest whose kinetic energy, in parts of what it was a step before, is less: what is left of it takes them some
/// hundredths of the way of that step.
const AT_REST: f64 = 1e-3;

impl Equations {
    /// That more than one motion goes on from an instant along a piece.
    pub(super) fn not_unique(&self, at: f64, mode: &Mode, rank: &mut Rank, piece: &Piece) -> Reason {
        let states = states_beyond(piece, at);
        let pose = rank.pose(at, &states);
        let before = pose.energy(&states_beyond(piece, piece.start));
        let comes = match pose.energy(&states) < AT_REST * before {
            true => "to rest in a singular configuration, from which nothing says how they go on",
            false => {
                "to a singular configuration with velocities that more than one motion goes on with: its branches touch there"
            }
        };
        Reason::Model(format!(
            "at t = {at} s the bodies come {comes}. {}. Start with other velocities, or change a length a little",
            self.ways_on(mode, &pose)
        ))
    }

    /// That no step leads over a singular configuration next to the end of a piece.
    pub(super) fn not_passed(&self, mode: &Mode, rank: &mut Rank, piece: &Piece) -> Reason {
        let at = piece.end;
        let pose = rank.pose(at, &states_beyond(piece, at));
        Reason::Model(format!(
            "the bodies are next to a singular configuration, and no step was found that leads over it with digits left: \
             an event, a start or another one too short before it leaves no room for one, and so do a motion that all but comes to rest \
             there and bars that are equal but for their last digits. {}",
            self.ways_on(mode, &pose)
        ))
    }

    /// That a singular configuration is too near.
    pub(super) fn lost(&self, mode: &Mode, pose: &Pose, distance: f64) -> Reason {
        Reason::Model(format!(
            "the bodies are about {distance:.1e} (rad or m) from a singular configuration and no step leads over it: \
             nearer than {LOST:e} rounding decides how they go on. {}. Start with other velocities, or change a length a little",
            self.ways_on(mode, pose)
        ))
    }

    /// Names of the joints that rows belong to, quoted.
    pub(crate) fn named_joints(&self, rows: &[usize]) -> String {
        let joints = self.joints_of_rows();
        let mut named: Vec<usize> = rows.iter().map(|row| joints[*row]).collect();
        named.sort_unstable();
        named.dedup();
        let names: Vec<String> =
            named.into_iter().map(|joint| format!("`{}`", self.model().joints[joint].name)).collect();
        names.join(", ")
    }
}
