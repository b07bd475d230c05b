//! What an instant changes for an island that touches surfaces: impacts, then which contacts last, and how friction holds them.

mod collisionless;
mod corners;
mod ending;
mod meanwhile;
mod motions;
mod opening;
mod pressed;
mod rubbing;
mod settled;
mod sharing;
mod striking;
mod wedged;

use std::collections::BTreeSet;

use nalgebra::{DMatrix, DVector};
use tumble_ode::Reason;

use crate::contact::change::Change;
use crate::contact::complementarity::{moved, pushing, standing};
use crate::contact::contact_mode::ContactMode;
use crate::contact::grip::Way;
use crate::contact::touch::{Now, Touch};
use crate::contact::watched::Watched;
use crate::coordinates::Measure;
use crate::equations::Equations;
use crate::impulse::Sizes;
use crate::mode::Mode;
use crate::record::{Happening, Jump};
use ending::Ending;
use rubbing::Rubbing;

/// A gap that opens or closes slower than this part of the speeds it is made of stands still: rounding of an impact.
pub(crate) const STANDS: f64 = 1e-12;
/// An acceleration below this part of what the forces would do without each other is none: rounding of the equations.
pub(crate) const BALANCED: f64 = 1e-10;

/// What is left of the motion of contacts that come to stand is at most this part of the largest speed: bounces are followed down to some 1e-7 of
/// it. If more is to be taken away, what takes it was not found.
const LEFT_OVER: f64 = 1e-3;

/// A gap that has not been beyond so many times its rounding error has not been open for certain.
const RESOLVED: f64 = 4.0;

/// No step is shorter than this part of the time.
const SHORTEST: f64 = 4.0 * f64::EPSILON;

/// Why the contacts of an island are looked at.
#[derive(Clone, Debug, Default)]
pub(crate) struct Touched {
    /// Pairs that have just closed.
    pub(crate) closed: BTreeSet<usize>,
    /// Pairs whose force has just come down to zero.
    pub(crate) lifted: BTreeSet<usize>,
    /// Pairs that have just ceased to slip.
    pub(crate) stopped: BTreeSet<usize>,
    /// Pairs that friction cannot hold any more, with the way they are about to slip.
    pub(crate) broken: BTreeSet<(usize, Way)>,
    /// Pairs at which friction takes all that a push would move.
    pub(crate) wedged: BTreeSet<usize>,
    /// Pairs that have just left where they may touch.
    pub(crate) left: BTreeSet<usize>,
}

impl Touched {
    /// Adds what was seen of a pair: of a compliant one, what its friction does.
    pub(crate) fn add(&mut self, pair: usize, watched: Watched) {
        match watched {
            Watched::Normal => _ = self.lifted.insert(pair),
            Watched::Slip => _ = self.stopped.insert(pair),
            Watched::Cone(way) => _ = self.broken.insert((pair, way)),
            Watched::Wedge => _ = self.wedged.insert(pair),
            Watched::Limit(_) => _ = self.left.insert(pair),
            Watched::Gap | Watched::Depth | Watched::Shallow | Watched::Out | Watched::Force => {
                self.closed.insert(pair);
            }
        }
    }
}

/// Contacts that last, by position, and the accelerations of all gaps then.
type Held = (Vec<(usize, ContactMode)>, DVector<f64>);

/// What lasts, and how it is held along surfaces with friction.
#[derive(Default)]
struct Lasting {
    modes: Vec<(usize, ContactMode)>,
    rubbing: Option<Rubbing>,
}

/// Velocities and contacts of an island while they are settled.
struct Settling<'a> {
    equations: &'a Equations,
    /// Bodies, in order.
    island: Vec<usize>,
    now: Now<'a>,
    touch: Touch,
    /// Positions, among the island's pairs, of those that take part.
    part: Vec<usize>,
    /// Impulses of the impact so far, by position, N s.
    impulses: DVector<f64>,
    /// What the impacts of a Zeno sequence that are not followed come to, less what the forces of the contacts do meanwhile; friction of what
    /// slides has none then. N s.
    cut_off: DVector<f64>,
    /// How long those take that were ended before what lasts was found, s.
    bounced: f64,
    /// Whether there have been such since the last impact.
    is_ended: bool,
    /// How many impacts there have been.
    rounds: usize,
    /// Whether rounding says which of several strikes first.
    is_unresolved: bool,
    /// Those that the last impact has given the rate that their restitution asks for, which is not none.
    rebounding: Vec<usize>,
    /// Those that open though nothing of it is seen yet but rounding.
    opening: Vec<usize>,
    /// Those whose force has come to zero, and that others keep where they are.
    staying: Vec<usize>,
    /// Those that touch at the ends of their edges and move beyond these.
    beyond: Vec<usize>,
    /// Speeds before the impact, by position: what rounding after it is relative to.
    speed: DVector<f64>,
    /// Accelerations of the gaps with the forces of the contacts that last, m/s^2.
    then: DVector<f64>,
}

/// Whether one that touches but for rounding has not been further away since the event before this one: impacts of several bodies that follow each
/// other ever faster come to that, and which of them is the next is then unknown. What touches at the start does so by the scene, all at once.
fn is_unresolved(
    equations: &Equations,
    touch: &Touch,
    touched: &Touched,
    now: Now<'_>,
    jump: &Jump<Mode>,
) -> bool {
    let since = now.time - now.since;
    let strikes = |position: usize| touched.closed.contains(&touch.pairs[position]);
    let is_near = |position: &usize| {
        let (pair, blur) = (touch.pairs[*position], touch.blur[*position]);
        let touches =
            touch.gap[*position].abs() <= blur && touch.rate[*position].abs() * since <= RESOLVED * blur;
        let moves = touch.rate[*position].abs() > STANDS * touch.speed[*position];
        // What forces press together ends in contact, whichever strikes first.
        let is_free = touch.free[*position] >= -BALANCED * touch.strength;
        touches
            && moves
            && is_free
            && equations.pairs()[pair].is_rigid()
            && jump.mode.contact_mode(pair).is_none()
    };
    let near: Vec<usize> = (0..touch.pairs.len()).filter(is_near).collect();
    near.iter().any(|position| !strikes(*position)) || (near.len() > 1 && now.time > 0.0)
}

impl Lasting {
    fn has(&self, position: usize) -> bool {
        self.modes.iter().any(|(known, _)| *known == position)
    }

    /// Rows that are kept where they are.
    fn held(&self) -> Vec<usize> {
        if let Some(Rubbing { found, .. }) = &self.rubbing {
            return [&found.held[..], &found.holding].concat();
        }
        let held = self.modes.iter().filter(|(_, contact_mode)| contact_mode.is_held());
        held.map(|(position, _)| *position).collect()
    }
}

impl Equations {
    /// Settles the contacts of bodies that joints and contacts make an island now, but for who is pressed into a compliant surface. The impulses of the impact.
    pub(crate) fn settle(
        &self,
        island: &[usize],
        touched: &Touched,
        now: Now<'_>,
        jump: &mut Jump<Mode>,
    ) -> Result<Sizes, Reason> {
        self.leave(&touched.left, jump);
        let mut settling = Settling::new(self, island, touched, now, jump)?;
        settling.pass_corners(jump)?;
        settling.impacts(touched, jump)?;
        let (lasting, zeno) = settling.settled(touched, jump)?;
        if zeno.is_none() && settling.bounced == 0.0 {
            // Rounding of what stands.
            settling.cut_off.fill(0.0);
        }
        settling.arrange(lasting, zeno, jump);
        Ok(settling.found())
    }
}

impl Equations {
    /// Ends contacts that leave where there may be one; others take their places.
    fn leave(&self, left: &BTreeSet<usize>, jump: &mut Jump<Mode>) {
        for &pair in left {
            jump.mode.set_contact_mode(pair, None);
            self.pair_list().rubbing(pair).for_each(|own| jump.mode.set_grip(own, None));
            jump.record.happened.push(Happening::Contact { pair, change: Change::End });
        }
    }
}

impl<'a> Settling<'a> {
    fn new(
        equations: &'a Equations,
        island: &[usize],
        touched: &Touched,
        now: Now<'a>,
        jump: &Jump<Mode>,
    ) -> Result<Self, Reason> {
        let touch = equations.touch(island, &jump.mode, &jump.states, now)?;
        let takes_part = |position: &usize| {
            let pair = touch.pairs[*position];
            let lasts = jump.mode.contact_mode(pair).is_some_and(ContactMode::is_lasting);
            // What touches and does not part has a part too: else rounding would say whether it closes next.
            let stays = touch.rate[*position] <= STANDS * touch.speed[*position];
            let touches = touch.gap[*position] <= touch.blur[*position] && stays;
            let is_there = touches && equations.pairs()[pair].is_rigid() && !touched.left.contains(&pair);
            touched.closed.contains(&pair) || touched.lifted.contains(&pair) || lasts || is_there
        };
        let part = (0..touch.pairs.len()).filter(takes_part).collect();
        let is_unresolved = is_unresolved(equations, &touch, touched, now, jump);
        let before = Self::before(equations, island, touch, now);
        let mut settling = Self { part, is_unresolved, ..before };
        settling.doubt();
        Ok(settling)
    }

    /// Before anything is settled, and nothing takes part.
    fn before(equations: &'a Equations, island: &[usize], touch: Touch, now: Now<'a>) -> Self {
        let count = touch.response.nrows();
        let [impulses, cut_off] = [(); 2].map(|()| DVector::zeros(count));
        Self {
            equations,
            island: island.to_vec(),
            now,
            part: vec![],
            impulses,
            cut_off,
            bounced: 0.0,
            is_ended: false,
            rounds: 0,
            speed: touch.speed.clone(),
            then: touch.free.clone(),
            touch,
            is_unresolved: false,
            rebounding: vec![],
            opening: vec![],
            staying: vec![],
            beyond: vec![],
        }
    }

    /// Where rounding says which of several strikes first, contacts of a check run give back all or nothing, whichever is further from what they should: what is
    /// left of their speeds by then is what is unknown.
    fn doubt(&mut self) {
        if self.is_unresolved && !self.equations.rounding().is_nearest() {
            let rigid = self.touch.pairs.iter().map(|pair| self.equations.pairs()[*pair].is_rigid());
            for (e, _) in self.touch.restitution.iter_mut().zip(rigid).filter(|(_, is_rigid)| *is_rigid) {
                *e = if *e < 0.5 { 1.0 } else { 0.0 };
            }
        }
    }

    fn take_part(&mut self, positions: Vec<usize>) {
        self.part.extend(positions);
        self.part.sort_unstable();
        self.part.dedup();
    }

    /// Those that stand still, or will after a Zeno sequence.
    fn members(&self, zeno: Option<&Ending>) -> Vec<usize> {
        match zeno {
            Some(Ending { members, .. }) => members.clone(),
            None => self.part.iter().copied().filter(|position| self.stands(*position)).collect(),
        }
    }

    /// Which contacts last, of those that stand still or will after a Zeno sequence; their velocities are made to
    /// stand. `None` where the Zeno sequence had to be ended first: then it is looked at again.
    fn lasting(
        &mut self,
        touched: &Touched,
        zeno: Option<&Ending>,
        jump: &mut Jump<Mode>,
    ) -> Result<Option<Lasting>, Reason> {
        let members = self.members(zeno);
        let is_pressed = !self.pressed(jump).is_empty();
        if members.is_empty() && !is_pressed {
            return Ok(Some(Lasting::default()));
        }
        let without = self.bearing(&members, touched, jump);
        // What opens does not close, whatever rounding makes of its acceleration now.
        let members: Vec<usize> =
            members.into_iter().filter(|position| !self.opening.contains(position)).collect();
        self.refuse_jammed(&members, &jump.mode)?;
        if self.is_rough() || is_pressed {
            return self.lasting_with_friction([&without, &members], zeno, touched, jump);
        }
        let (found, then) = match self.hold(&without, &members) {
            Some(held) => held,
            None => {
                self.hold(&members, &members).ok_or_else(|| self.without_forces(&members, touched, jump))?
            }
        };
        self.then = then;
        let lasting = Lasting { modes: found, rubbing: None };
        let stop = standing(&self.touch.response, &self.rates(), &lasting.held());
        self.stop(&stop.ok_or_else(|| self.unsolved("contact"))?, jump)?;
        Ok(Some(lasting))
    }

    /// Of some contacts that stand still, those that are held and those that then stay by themselves, with the
    /// accelerations of all gaps; `None` if one of `all` would close.
    fn hold(&self, some: &[usize], all: &[usize]) -> Option<Held> {
        // Rounding does not say who presses.
        let zero = self.zero();
        let free = self.accelerations().map(|own| if own.abs() > zero { own } else { 0.0 });
        let (set, push) = pushing(&self.pushes(some), &self.some(some, &free))?;
        let push = self.whole(some, &push);
        let then = moved(self.touch.pushes(), &free, &push);
        if all.iter().any(|position| then[*position] < -zero) {
            return None;
        }
        let held: Vec<usize> = set.into_iter().map(|index| some[index]).collect();
        let may_stay = |position: &usize| some.contains(position) || self.staying.contains(position);
        let contact_mode = |position: &usize| match held.contains(position) {
            true => Some((*position, ContactMode::Resting)),
            false if then[*position] <= zero && may_stay(position) => Some((*position, ContactMode::Idle)),
            false => None,
        };
        Some((all.iter().filter_map(contact_mode).collect(), then))
    }

    /// Writes what was found into the jump.
    fn arrange(&self, lasting: Lasting, zeno: Option<Ending>, jump: &mut Jump<Mode>) {
        let Lasting { modes: lasting, rubbing } = lasting;
        let left = zeno.as_ref().map_or(0.0, |zeno| zeno.time);
        let wake = self.resolved(self.bounced + left);
        jump.early = zeno.as_ref().map_or(0.0, |zeno| zeno.slow.time).max(self.bounced).max(jump.early);
        jump.wake = wake.map(|time| self.now.time + time).or(jump.wake);
        let mut members: BTreeSet<usize> = self.part.iter().copied().collect();
        members.extend(zeno.into_iter().flat_map(|zeno| zeno.members).chain(self.beyond.iter().copied()));
        for position in members {
            let index = self.touch.pairs[position];
            let pair = &self.equations.pairs()[index];
            let before = jump.mode.contact_mode(index);
            let lasts =
                lasting.iter().find(|(known, _)| *known == position).map(|(_, contact_mode)| *contact_mode);
            let after = match lasts {
                Some(ContactMode::Resting) if wake.is_some() => Some(ContactMode::Settling),
                // What is still settling goes on to do so.
                Some(ContactMode::Resting) if before == Some(ContactMode::Settling) => before,
                other => other,
            };
            let changes = [
                (self.impulses[position] > 0.0).then_some(Change::Impact),
                (after == Some(ContactMode::Settling) && before != after).then_some(Change::Zeno),
                (after.is_some() && before.is_none() && after != Some(ContactMode::Settling))
                    .then_some(Change::Start),
                (before.is_some() && after.is_none()).then_some(Change::End),
            ];
            let happening = |change| Happening::Contact { pair: index, change };
            jump.record.happened.extend(changes.into_iter().flatten().map(happening));
            jump.mode.set_contact_mode(index, after);
            if after.is_none() {
                let zeros = self.zeros(position);
                jump.zeros.push((pair.guard_name(Watched::Gap), zeros));
            }
        }
        self.name_parting(jump);
        self.arrange_grips(rubbing.as_ref(), jump);
    }

    /// Gaps that are zero but for rounding and open, though nothing happens to them: else rounding would say that they close.
    fn name_parting(&self, jump: &mut Jump<Mode>) {
        for (position, &index) in self.touch.pairs.iter().enumerate() {
            let pair = &self.equations.pairs()[index];
            let is_apart = pair.is_rigid() && jump.mode.contact_mode(index).is_none();
            let touches = self.touch.gap[position].abs() <= self.touch.blur[position];
            let opens = self.touch.rate[position] > 0.0 && !self.stands(position);
            if is_apart && touches && opens && !self.part.contains(&position) {
                jump.zeros.push((pair.guard_name(Watched::Gap), 1));
            }
        }
    }

    /// No step is shorter, s.
    fn shortest(&self) -> f64 {
        SHORTEST * self.now.time.abs()
    }

    /// An acceleration that is none.
    fn zero(&self) -> f64 {
        BALANCED * self.touch.strength
    }

    /// How many derivatives of a gap that opens are zero now, itself included.
    fn zeros(&self, position: usize) -> usize {
        match self.stands(position) {
            false => 1,
            true if self.then[position].abs() > self.zero() && !self.opening.contains(&position) => 2,
            true => 3,
        }
    }

    /// Whether a gap neither opens nor closes, but for rounding.
    fn stands(&self, position: usize) -> bool {
        let rate = self.touch.rate[position];
        rate.abs() <= self.no_rate(position) && !(rate > 0.0 && self.rebounding.contains(&position))
    }

    /// A rate of a gap that is none: rounding.
    fn no_rate(&self, position: usize) -> f64 {
        STANDS * self.speed[position].max(self.touch.speed[position]).max(self.pushed(position))
    }

    /// What the largest impulse would do at a row: impulses are found to a rounding error of the largest.
    fn pushed(&self, row: usize) -> f64 {
        self.touch.response[(row, row)] * self.impulses.amax()
    }

    /// Whether rigid ones touch where they may, but for rounding.
    fn may_touch(&self, position: usize, touched: &Touched) -> bool {
        let Touch { gap, blur, pairs, .. } = &self.touch;
        let pair = pairs[position];
        let is_there = !touched.left.contains(&pair) && !self.beyond.contains(&position);
        let touches = gap[position].abs() <= blur[position] && is_there;
        touches && self.equations.pairs()[pair].is_rigid()
    }

    /// Takes away what is left of the rates of contacts that are held.
    fn stop(&mut self, impulses: &DVector<f64>, jump: &mut Jump<Mode>) -> Result<(), Reason> {
        let (speed, taken) =
            (self.now.scales[Measure::Speed as usize], (&self.touch.response * impulses).amax());
        let most = LEFT_OVER * speed.max(self.speed.amax());
        if speed > 0.0 && (taken > most || taken.is_nan()) {
            return Err(self.unsolved("contact"));
        }
        self.cut_off += impulses;
        self.apply(impulses, jump)
    }

    fn apply(&mut self, impulses: &DVector<f64>, jump: &mut Jump<Mode>) -> Result<(), Reason> {
        self.touch.kick(impulses, &mut jump.states);
        self.look_again(jump)
    }

    /// The same island with the states as they are now.
    fn look_again(&mut self, jump: &Jump<Mode>) -> Result<(), Reason> {
        self.touch = self.equations.touch(&self.island, &jump.mode, &jump.states, self.now)?;
        self.doubt();
        Ok(())
    }

    fn of(&self, values: &DVector<f64>) -> DVector<f64> {
        self.some(&self.part, values)
    }

    fn some(&self, some: &[usize], values: &DVector<f64>) -> DVector<f64> {
        DVector::from_fn(some.len(), |i, _| values[some[i]])
    }

    fn response(&self, some: &[usize]) -> DMatrix<f64> {
        DMatrix::from_fn(some.len(), some.len(), |i, j| self.touch.response[(some[i], some[j])])
    }

    /// What forces of some contacts do to their accelerations.
    fn pushes(&self, some: &[usize]) -> DMatrix<f64> {
        let pushes = self.touch.pushes();
        DMatrix::from_fn(some.len(), some.len(), |i, j| pushes[(some[i], some[j])])
    }

    fn whole(&self, some: &[usize], values: &DVector<f64>) -> DVector<f64> {
        let mut all = DVector::zeros(self.touch.response.nrows());
        for (index, position) in some.iter().enumerate() {
            all[*position] = values[index];
        }
        all
    }

    fn unsolved(&self, what: &str) -> Reason {
        let bodies = self.equations.body_names(&self.island);
        Reason::Model(format!("no impulses or forces were found for the {what} of {bodies}"))
    }

    fn found(&self) -> Sizes {
        let by_index = |indices: &[usize], impulses: &DVector<f64>| {
            let all = indices.iter().zip(impulses).filter(|(_, impulse)| **impulse != 0.0);
            all.map(|(index, impulse)| (*index, *impulse)).collect()
        };
        let impulses = &self.impulses + &self.cut_off;
        let shares = &self.touch.joints.share * &impulses;
        let rubbed = &self.touch.slips.pairs;
        let along = self.shared_by_normals(&impulses);
        Sizes {
            normals: by_index(&self.touch.pairs, &impulses),
            frictions: by_index(rubbed, &along),
            rows: by_index(&self.touch.joints.rows, &shares),
            applied: vec![],
        }
    }
}
