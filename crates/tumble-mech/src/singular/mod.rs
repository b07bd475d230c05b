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
//! velocity, or the bodies stop there: either is a motion, and it is refused, with the branches ([`pose`]).
//!
//! A motion that only comes near such a pose, as one that comes to rest next to it, loses its branch to rounding: a pose that is a
//! distance x from it differs from one on another branch by x, but keeps the joints to `x^2`. Nearer than [`LOST`] it is refused as well.
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
//! `tests/singular.rs`: parallelograms of one and two loops against the pendulum that they are, a kite, starts that are singular;
//! `tests/branches.rs`: what is refused.

mod pose;
mod rank;
mod refused;
mod start;

use tumble_ode::{Over, Piece, Reason, Refusal, Solver};

use crate::equations::Equations;
use crate::mode::Mode;
use crate::record::{Happening, Record};
use crate::sets::Sets;
use rank::{Rank, Zero};

/// A step of this part of the longest of late makes one look for what is ahead.
const SHORT: f64 = 1.0 / 8.0;
/// The longest step of late counts for so much after as long a time.
const FADES: f64 = 0.95;
/// The step over an instant starts so many of the longest steps of late before it, or the next of these where the series from there do
/// not reach over it: near the instant rounding errors grow faster along a step, far from it the step is too long.
const BEFORE: [f64; 5] = [0.8, 1.3, 0.5, 0.3, 0.1];
/// Nearer than this, in the same units, rounding is all that is left of the series.
const NEAREST: f64 = 1e-3;
/// Where nothing was seen ahead, so much of the way to where it was looked for is gone before the next look.
const NEXT_LOOK: f64 = 0.5;
/// Where no step leads over an instant, bars that pass next to the singular pose take steps in proportion to the distance: some ten for
/// each digit of it. So many short ones lead nowhere.
const MOST_SHORT: usize = 400;
/// It ends this part of the way to the instant behind it: rounding errors are then some four times what they were at the instant.
const BEHIND: f64 = 0.04;
/// Rows at the end of the step over an instant hold to this part of the scale, or it starts elsewhere; where none does so well, to the
/// other, or the series did not lead there.
const HOLDS: [f64; 2] = [3e-14, 1e-9];
/// A singular pose that is nearer, rad or m: the square of it is a million of the rounding errors by which joints are kept, so that six
/// digits are left of the distance.
const LOST: f64 = 1e-5;

/// What has been seen of singular configurations on the way of a motion.
#[derive(Default)]
pub(crate) struct Passages {
    /// Rows of the mode that holds, where there are loops.
    known: Option<(Mode, Option<Rank>)>,
    /// The longest step of late, s.
    longest: f64,
    /// Before this time nothing more is looked for, s: it is the end of a step over an instant.
    not_before: f64,
    /// The same while steps are found, s: nothing was seen up to there.
    next_look: f64,
    /// The last instant that was gone over, s.
    last: Option<f64>,
    trying: Option<Trying>,
    /// An instant ahead at which branches touch as far as it was seen, s, and what is to be said of it.
    touched: Option<(f64, Reason)>,
}

/// An instant ahead that a step was to go over and did not.
struct Trying {
    /// s
    at: f64,
    /// How many of [`BEFORE`] were too far or too near, for each of [`HOLDS`].
    tried: usize,
    /// Short steps since all were.
    steps: usize,
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
        let is_stuck = refusal.as_ref().is_some_and(|refusal| {
            matches!(
                refusal.reason,
                Reason::Stalled { .. } | Reason::NotFinite { .. } | Reason::WouldTakeTooMuchMemory { .. }
            )
        });
        if refusal.is_some() && !is_stuck {
            return refusal;
        }
        if self.is_to_look(solver, is_stuck) {
            match self.pass(equations, solver, inputs, is_stuck) {
                Ok(true) => return None,
                Ok(false) => {}
                Err(refused) => return Some(refused),
            }
        }
        self.lost(equations, solver, inputs, is_stuck).or(refusal)
    }

    fn is_to_look(&mut self, solver: &Solver<'_, Equations>, is_stuck: bool) -> bool {
        let Some(piece) = solver.trajectory().pieces.last() else { return false };
        let length = piece.end - piece.start;
        if piece.end < self.not_before {
            return false;
        }
        if self.trying.as_ref().is_some_and(|trying| piece.end > trying.at + NEAREST * self.longest) {
            self.trying = None;
        }
        self.touched.take_if(|(at, _)| piece.end > *at + NEAREST * self.longest);
        let is_short =
            length < SHORT * self.longest && (piece.end >= self.next_look || self.trying.is_some());
        if self.trying.is_none() {
            let faded = libm::pow(FADES, length / self.longest.max(length)) * self.longest;
            self.longest = length.max(faded);
        }
        (is_stuck || is_short) && piece.time_series.is_none()
    }

    /// Whether an instant ahead was gone over, or is about to be approached from another side.
    fn pass(
        &mut self,
        equations: &Equations,
        solver: &mut Solver<'_, Equations>,
        inputs: &[f64],
        is_stuck: bool,
    ) -> Result<bool, Refusal> {
        let Some(piece) = solver.trajectory().pieces.last() else { return Ok(false) };
        let (mode, now) = (&solver.trajectory().modes[piece.mode], piece.end);
        let (longest, last) = (self.longest, self.last);
        let earliest = last_change(solver).max(self.not_before);
        // Rounding errors grow with the distance to an instant behind as well.
        let between = |ahead: f64| last.map_or(earliest, |last| earliest.max(0.5 * (last + ahead)));
        let (known, tried) = self.trying.as_ref().map_or((None, 0), |trying| (Some(trying.at), trying.tried));
        let Some(rank) = self.rank(equations, mode, inputs) else { return Ok(false) };
        let Some(mut ahead) = known.or_else(|| rank.ahead(piece, longest)) else { return Ok(false) };
        let Some(way) = Self::before(tried).map(|wanted| wanted * longest) else {
            return self.give_up(equations, solver, is_stuck);
        };
        let refused = |time: f64| move |reason: Reason| Refusal { time, reason };
        if known.is_none() {
            let mode = mode.clone();
            let Some(seen) = See::from(rank, solver, ahead).map_err(refused(now))? else { return Ok(false) };
            ahead = seen.at().unwrap_or(ahead);
            if let Zero::Touched { at } = seen.zero {
                self.touched = Some((at, equations.not_unique(at, &mode, rank, &seen.series)));
            }
            // From nearer it may turn out to be two that are crossed.
            if !is_stuck && !matches!(seen.zero, Zero::Crossed { .. }) {
                self.next_look = now + NEXT_LOOK * (ahead - now).max(0.0);
                return Ok(false);
            }
        }
        let from = (ahead - way).min(now).max(between(ahead)).min(now);
        if ahead - from < NEAREST * longest || !solver.go_back(from) {
            self.trying.get_or_insert(Trying::of(ahead)).tried = HOLDS.len() * BEFORE.len();
            return Ok(false);
        }
        let Some((_, Some(rank))) = &mut self.known else { return Ok(false) };
        let Some(seen) = See::from(rank, solver, ahead).map_err(refused(from))? else { return Ok(false) };
        let gone = self.over(equations, solver, &seen);
        gone.map_err(|reason| Refusal { time: solver.time(), reason })
    }

    /// Goes over the instant that is seen.
    fn over(
        &mut self,
        equations: &Equations,
        solver: &mut Solver<'_, Equations>,
        See { series, ahead, zero }: &See,
    ) -> Result<bool, Reason> {
        let Some((mode, Some(rank))) = &mut self.known else { return Ok(false) };
        let (at, blur, is_singular) = match zero {
            Zero::None => return Ok(self.try_elsewhere(*ahead)),
            Zero::Touched { at } => {
                self.touched = Some((*at, equations.not_unique(*at, mode, rank, series)));
                return Ok(self.try_elsewhere(*at));
            }
            Zero::Crossed { at, blur, is_singular } => (*at, *blur, *is_singular),
        };
        let way = at - series.start;
        let end = at + BEHIND * way;
        let tried = self.trying.as_ref().map_or(0, |trying| trying.tried);
        let part = HOLDS[(tried / BEFORE.len()).min(HOLDS.len() - 1)];
        if !solver.reaches(end) || !rank.holds(series, end, solver.scales(), part) {
            return Ok(self.try_elsewhere(at));
        }
        let record = is_singular.then(|| Record { happened: vec![Happening::Singular], ..Record::default() });
        solver.step_over(Over { instant: at, blur, record, end, near: at + way })?;
        (self.trying, self.touched) = (None, None);
        // An event on the way may have changed the motion before it came there.
        match solver.time() < at {
            true => self.not_before = solver.time(),
            false => (self.not_before, self.last) = (end.min(solver.time()), Some(at)),
        }
        Ok(true)
    }

    /// Where the next step over an instant starts, in units of the longest of late, after so many were tried.
    fn before(tried: usize) -> Option<f64> {
        (tried < HOLDS.len() * BEFORE.len()).then(|| BEFORE[tried % BEFORE.len()])
    }

    /// The next step over an instant about that time starts elsewhere.
    fn try_elsewhere(&mut self, at: f64) -> bool {
        let trying = self.trying.get_or_insert(Trying::of(at));
        (trying.at, trying.tried) = (at, trying.tried + 1);
        true
    }

    /// No step leads over the instant: short steps may lead past it, if bars only come near to a singular pose.
    fn give_up(
        &mut self,
        equations: &Equations,
        solver: &Solver<'_, Equations>,
        is_stuck: bool,
    ) -> Result<bool, Refusal> {
        let Some(trying) = &mut self.trying else { return Ok(false) };
        trying.steps += 1;
        if !is_stuck && trying.steps <= MOST_SHORT {
            return Ok(false);
        }
        let (Some(piece), Some((mode, Some(rank)))) = (solver.trajectory().pieces.last(), &mut self.known)
        else {
            return Ok(false);
        };
        let touched = self.touched.take().map(|(_, reason)| reason);
        let reason = touched.unwrap_or_else(|| equations.not_passed(mode, rank, piece));
        Err(Refusal { time: piece.end, reason })
    }

    /// That a singular pose is too near to tell the branches apart.
    fn lost(
        &mut self,
        equations: &Equations,
        solver: &Solver<'_, Equations>,
        inputs: &[f64],
        is_stuck: bool,
    ) -> Option<Refusal> {
        let piece = solver.trajectory().pieces.last()?;
        let mode = &solver.trajectory().modes[piece.mode];
        let rank = self.rank(equations, mode, inputs)?;
        let pose = rank.near(piece, is_stuck)?;
        let distance = pose.distance()?;
        if distance > if is_stuck { LOST.sqrt() } else { LOST } {
            return None;
        }
        let touched = self.touched.take().map(|(_, reason)| reason);
        let reason = touched.unwrap_or_else(|| equations.lost(mode, &pose, distance));
        Some(Refusal { time: piece.end, reason })
    }

    fn rank(&mut self, equations: &Equations, mode: &Mode, inputs: &[f64]) -> Option<&mut Rank> {
        if self.known.as_ref().is_none_or(|(known, _)| known != mode) {
            let rank = equations.has_loop(mode).then(|| Rank::of(equations, mode, inputs).ok()).flatten();
            self.known = Some((mode.clone(), rank));
        }
        self.known.as_mut().and_then(|(_, rank)| rank.as_mut())
    }
}

impl Trying {
    fn of(at: f64) -> Self {
        Self { at, tried: 0, steps: 0 }
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

    /// The instant, if there is one, s.
    fn at(&self) -> Option<f64> {
        match self.zero {
            Zero::Crossed { at, .. } | Zero::Touched { at } => Some(at),
            Zero::None => None,
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
}

/// Parameter of a piece at a time that may lie beyond its end.
fn states_beyond(piece: &Piece, time: f64) -> Vec<f64> {
    piece.states_at_parameter(time - piece.start)
}
