//! Singular configurations that a motion meets on its way: passed where one motion goes on through them, refused where not.
//!
//! # Law
//! Joints keep `g(q) = 0` with the Jacobian J. Where bars of a loop lie in one line, J loses rank: with n of `n^T J = 0` and d of
//! `J d = 0`, the poses that g allows meet there in several branches, whose velocities v all solve
//!
//! ```text
//! J v = 0,    n^T J'(v) v = 0    with  J'(v) = sum over i of v_i dJ/dq_i
//! ```
//!
//! (derivatives of `g = 0` along a motion, of which `n^T` takes out all that holds accelerations). A motion does not jump, so it goes on
//! along a branch that has the velocity with which it arrives. Along it J(t) is analytic and `J(t* + h) d = h J'(v) d` to first order: the
//! smallest singular value s of J that is not zero elsewhere grows like `|h|` exactly if no d but those along the branch has
//! `n^T J'(v) d = 0`, that is if the conditions above, linear about v, leave no more than the branch's own directions. Then no other
//! branch has this velocity, and the motion is the analytic continuation of the one that arrived: it obeys the equation of
//! the branch's own coordinates, which is regular there. It is passed, and told. Where s grows like `h^2`, another branch has the same
//! velocity, or the bodies stop there: either is a motion, and it is refused.
//!
//! With rows that are left out because they follow from others, J is that of all rows: what a second loop forbids is no branch.
//! Where only the rows that are kept lose rank nothing is singular, and it is passed without a word.
//!
//! The instant t* is where s is zero; the step over it starts a part of an ordinary step before it and ends a small part of that behind it, with
//! the series about its start ([`tumble_ode::Over`]).
//!
//! # Symbols and units
//! q coordinates (m, rad), v their rates, g and J as rows are (m or rad); s in units of one over the root of a mass; t* and h (s).
//!
//! # Sign and frame
//! s is not negative.
//!
//! # Validity
//! Rigid bars without play, friction or elasticity: a real linkage at such a pose is led by its play. The forces of the joints may grow
//! beyond all bounds towards t*; the motion does not. Bars whose lengths differ by less than a part [`ZERO`] of s elsewhere count as equal: poses
//! that differ by rounding would miss the singular one by the root of it. Joints only, not lasting contacts.
//!
//! # Source
//! Wohlhart, Degrees of shakiness (Mechanism and Machine Theory 34, 1999): conditions of higher order on velocities; Zlatanov, Bonev and
//! Gosselin, Constraint singularities as C-space singularities (Advances in Robot Kinematics, 2002).
//!
//! # Checked by
//! `tests/singular.rs`: parallelograms of one and two loops against the pendulum that they are, a kite, starts that are singular.

mod rank;
mod start;

use tumble_ode::{Over, Piece, Reason, Refusal, Solver};

use crate::equations::Equations;
use crate::mode::Mode;
use crate::record::{Happening, Record};
use crate::sets::Sets;
use rank::{Rank, Zero};

/// A step of this part of the longest of late makes one look for what is ahead.
const SHORT: f64 = 1.0 / 8.0;
/// The longest step of late counts for so much after another step.
const FADES: f64 = 0.95;
/// The step over an instant starts so many of the longest steps of late before it, or the next of these where the series from there do
/// not reach over it: near the instant rounding errors grow faster along a step, far from it the step is too long.
const BEFORE: [f64; 5] = [0.8, 1.3, 0.5, 0.3, 0.1];
/// Nearer than this, in the same units, rounding is all that is left of the series.
const NEAREST: f64 = 1e-3;
/// It ends this part of the way to the instant behind it: rounding errors are then some four times what they were at the instant.
const BEHIND: f64 = 0.04;
/// Rows at the end of the step over an instant hold to this part of the scale, or the series did not lead there.
const HOLDS: f64 = 1e-9;

/// What has been seen of singular configurations on the way of a motion.
#[derive(Default)]
pub(crate) struct Passages {
    /// Rows of the mode that holds, where there are loops.
    known: Option<(Mode, Option<Rank>)>,
    /// The longest step of late, s.
    longest: f64,
    /// Before this time nothing more is looked for, s.
    not_before: f64,
    /// The last instant that was gone over, s.
    last: Option<f64>,
    /// How many of [`BEFORE`] were too far or too near for an instant about this time, s.
    tried: usize,
    tried_for: f64,
}

impl Passages {
    /// Looks ahead after a step, or after none was found; goes over a singular instant that is near. What stands in the way still.
    pub(crate) fn watch(
        &mut self,
        equations: &Equations,
        solver: &mut Solver<'_, Equations>,
        inputs: &[f64],
        refusal: Option<Refusal>,
    ) -> Option<Refusal> {
        if !self.is_to_look(solver, refusal.as_ref()) {
            return refusal;
        }
        match self.pass(equations, solver, inputs) {
            Ok(true) => None,
            Ok(false) => refusal,
            Err(refused) => Some(refused),
        }
    }

    fn is_to_look(&mut self, solver: &Solver<'_, Equations>, refusal: Option<&Refusal>) -> bool {
        let Some(piece) = solver.trajectory().pieces.last() else { return false };
        let length = piece.end - piece.start;
        if piece.end < self.not_before {
            return false;
        }
        if piece.end > self.tried_for {
            self.tried = 0;
        }
        let is_stuck = refusal.is_some_and(|refusal| {
            matches!(
                refusal.reason,
                Reason::Stalled { .. } | Reason::NotFinite { .. } | Reason::WouldTakeTooMuchMemory { .. }
            )
        });
        let is_short = refusal.is_none() && length < SHORT * self.longest;
        self.longest = length.max(FADES * self.longest);
        (is_stuck || is_short) && piece.time_series.is_none()
    }

    /// Whether an instant ahead was gone over, or is about to be approached from another side.
    fn pass(
        &mut self,
        equations: &Equations,
        solver: &mut Solver<'_, Equations>,
        inputs: &[f64],
    ) -> Result<bool, Refusal> {
        let Some(piece) = solver.trajectory().pieces.last() else { return Ok(false) };
        let (mode, now) = (&solver.trajectory().modes[piece.mode], piece.end);
        let (longest, tried, last) = (self.longest, self.tried, self.last);
        let earliest = last_change(solver).max(self.not_before);
        // Rounding errors grow with the distance to an instant behind as well.
        let between = |ahead: f64| last.map_or(earliest, |last| earliest.max(0.5 * (last + ahead)));
        let Some(rank) = self.rank(equations, mode, inputs) else { return Ok(false) };
        let Some(ahead) = rank.ahead(piece, longest) else { return Ok(false) };
        let Some(way) = BEFORE.get(tried).map(|wanted| wanted * longest) else {
            return match rank.is_lost(solver.trajectory().pieces.last()) {
                Some(rows) => Err(Refusal { time: now, reason: equations.not_passed(now, &rows) }),
                None => Ok(false),
            };
        };
        let from = (ahead - way).min(now).max(between(ahead)).min(now);
        if ahead - from < NEAREST * longest || !solver.go_back(from) {
            return Ok(false);
        }
        let refused = |reason: Reason| Refusal { time: from, reason };
        let Some(mut seen) = See::from(rank, solver, ahead).map_err(refused)? else { return Ok(false) };
        // From far away it was not known where to start.
        let from = (seen.at() - way).max(between(seen.at()));
        if from < seen.series.start && solver.go_back(from) {
            let ahead = seen.at();
            let Some(nearer) = See::from(rank, solver, ahead).map_err(refused)? else { return Ok(false) };
            seen = nearer;
        }
        self.over(equations, solver, &seen).map_err(refused)
    }

    /// Goes over the instant that is seen.
    fn over(
        &mut self,
        equations: &Equations,
        solver: &mut Solver<'_, Equations>,
        See { series, ahead, zero }: &See,
    ) -> Result<bool, Reason> {
        let (at, blur, is_singular) = match zero {
            Zero::None => return Ok(self.try_elsewhere(*ahead)),
            Zero::Touched { at, rows } => return Err(equations.not_unique(*at, rows)),
            Zero::Crossed { at, blur, is_singular } => (*at, *blur, *is_singular),
        };
        let way = at - series.start;
        let end = at + BEHIND * way;
        let Some((_, Some(rank))) = &mut self.known else { return Ok(false) };
        if !solver.reaches(end) || !rank.holds(series, end, solver.scales(), HOLDS) {
            return Ok(self.try_elsewhere(at));
        }
        let record = is_singular.then(|| Record { happened: vec![Happening::Singular], ..Record::default() });
        solver.step_over(Over { instant: at, blur, record, end, near: at + way })?;
        (self.not_before, self.last, self.tried) = (end, Some(at), 0);
        Ok(true)
    }

    /// The next step over an instant about that time starts elsewhere.
    fn try_elsewhere(&mut self, at: f64) -> bool {
        (self.tried, self.tried_for) = (self.tried + 1, at);
        true
    }

    fn rank(&mut self, equations: &Equations, mode: &Mode, inputs: &[f64]) -> Option<&mut Rank> {
        if self.known.as_ref().is_none_or(|(known, _)| known != mode) {
            let rank = equations.has_loop(mode).then(|| Rank::of(equations, mode, inputs).ok()).flatten();
            self.known = Some((mode.clone(), rank));
        }
        self.known.as_mut().and_then(|(_, rank)| rank.as_mut())
    }
}

/// What series at an instant show of the rows ahead.
struct See {
    series: Piece,
    /// Where the singular instant was looked for, s.
    ahead: f64,
    zero: Zero,
}

impl See {
    fn from(rank: &mut Rank, solver: &mut Solver<'_, Equations>, ahead: f64) -> Result<Option<Self>, Reason> {
        let Some(series) = solver.ahead()? else { return Ok(None) };
        let zero = rank.zero(&series, ahead);
        Ok(Some(Self { series, ahead, zero }))
    }

    /// The instant, as far as it is known, s.
    fn at(&self) -> f64 {
        match self.zero {
            Zero::Crossed { at, .. } | Zero::Touched { at, .. } => at,
            Zero::None => self.series.start,
        }
    }
}

/// When the motion was last changed by an event, or began, s.
fn last_change(solver: &Solver<'_, Equations>) -> f64 {
    let found = solver.trajectory();
    let changed = found
        .events
        .iter()
        .rev()
        .find(|event| event.mode_before != event.mode_after || event.before != event.after);
    changed.map(|event| event.time).or(found.start()).unwrap_or(0.0)
}

impl Equations {
    /// Whether joints and pivots that hold close a loop.
    fn has_loop(&self, mode: &Mode) -> bool {
        let world = self.model().bodies.len();
        let mut sets = Sets::new(world + 1);
        let pivots = (0..world).filter(|body| self.pivot_arm(*body).is_some()).map(|body| [body, world]);
        let joints = self.joints().iter().enumerate().filter(|(joint, _)| self.holds(mode, *joint));
        let joints = joints.map(|(_, joint)| {
            [joint.bodies.first().copied().unwrap_or(world), joint.bodies.get(1).copied().unwrap_or(world)]
        });
        pivots.chain(joints).any(|[a, b]| {
            let is_joined = sets.least(a) == sets.least(b);
            sets.join(a, b);
            is_joined
        })
    }

    /// That more than one motion goes on.
    fn not_unique(&self, at: f64, rows: &[usize]) -> Reason {
        Reason::Model(format!(
            "at t = {at} s the bodies come to a singular configuration, in which {} can be kept in more than one way, and the \
             velocities do not tell which: the branches of the motion touch there, or the bodies stop. Start with other \
             velocities, or change a length a little",
            self.named_joints(rows)
        ))
    }

    /// That the series of the motion do not lead over a singular configuration.
    fn not_passed(&self, at: f64, rows: &[usize]) -> Reason {
        Reason::Model(format!(
            "at t = {at} s the bodies are next to a singular configuration, in which {} can be kept in more than one way, and no step was \
             found that leads over it with digits left: an event or a start too short before it leaves no room for one, and bars that \
             are equal but for their last digits pass beside it",
            self.named_joints(rows)
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

/// Parameter of a piece at a time that may lie beyond its end.
fn states_beyond(piece: &Piece, time: f64) -> Vec<f64> {
    piece.states_at_parameter(time - piece.start)
}
