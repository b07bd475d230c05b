//! Contacts at an instant: what the integrator saw, sorted by body, and each body dealt with by its surfaces' laws.

use tumble_ode::{Cause, Crossing, Direction, Reason};

use crate::contact::change::Change;
use crate::contact::contact_mode::ContactMode;
use crate::contact::settle::{BALANCED, STANDS, Touched};
use crate::contact::slight::LEAST;
use crate::contact::touch::Now;
use crate::contact::watched::Watched;
use crate::equations::Equations;
use crate::impulse::Sizes;
use crate::mode::Mode;
use crate::record::{Happening, Jump};
use crate::uniqueness::Spot;

/// Two that are not so many rounding errors of their gap apart may meet before bounces of either have ended that are too low to be
/// followed: these are some rounding errors high, and must have ended long before another comes.
const LOW: f64 = 1024.0;

/// What the integrator saw of contacts, by pair.
#[derive(Clone, Debug, Default)]
pub(crate) struct Causes {
    seen: Vec<(usize, Watched, bool)>,
    /// Forces that loads read and that are determined no more, in the order of their guards.
    fed: Vec<usize>,
    /// Brakes with what was seen of them.
    pub(crate) braked: Vec<(usize, Watched)>,
    wakes: bool,
}

impl Causes {
    /// Those of a crossing. Where modes have led into each other around a circle, what ended each of them counts as well: forces that are zero
    /// but for rounding seem to cross it in each, and what holds is a mode in which all of them have. Of corners that slide off each other in
    /// one point each contact leaves where there may be one, and is there again for the others.
    pub(crate) fn of(equations: &Equations, at: &Crossing<'_, Mode>) -> Self {
        let [mut causes, mut before] = [Self::default(), Self::default()];
        causes.add(equations, at.mode, at.causes);
        at.around.iter().for_each(|(mode, around)| before.add(equations, mode, around));
        let counts =
            |watched: Watched| matches!(watched, Watched::Normal | Watched::Cone(_) | Watched::Limit(_));
        causes.seen.extend(before.seen.into_iter().filter(|(_, watched, _)| counts(*watched)));
        causes
    }

    /// Indices of guards count the events first.
    fn add(&mut self, equations: &Equations, mode: &Mode, causes: &[Cause]) {
        let events = equations.events(mode).len();
        let (mut touching, mut apart) = (None, None);
        for cause in causes {
            match cause {
                Cause::Guard(guard) if *guard >= events => {
                    let touching = touching.get_or_insert_with(|| equations.touching(mode));
                    self.see(equations, mode, touching, guard - events);
                }
                Cause::LazyGuard(lazy_guard) => {
                    let apart = apart.get_or_insert_with(|| equations.apart(mode));
                    self.seen.push((apart[*lazy_guard], Watched::Gap, true));
                }
                Cause::Wake => self.wakes = true,
                Cause::Guard(_) | Cause::Scheduled(_) => {}
            }
        }
    }

    /// What a guard behind those of events says.
    fn see(
        &mut self,
        equations: &Equations,
        mode: &Mode,
        touching: &[(usize, Watched, Direction)],
        guard: usize,
    ) {
        let brakes = equations.watched_brakes(mode);
        match (touching.get(guard), guard.checked_sub(touching.len())) {
            (Some((pair, watched, _)), _) => self.seen.push((*pair, *watched, false)),
            (None, Some(behind)) => match brakes.get(behind) {
                Some((brake, watched, _)) => self.braked.push((*brake, *watched)),
                None => self.fed.push(behind - brakes.len()),
            },
            (None, None) => {}
        }
    }

    /// Whether bodies may strike.
    pub(crate) fn closes(&self) -> bool {
        self.seen.iter().any(|(_, watched, _)| *watched == Watched::Gap)
    }
}

/// What an instant finds before compliant contacts change.
struct Unpressed {
    mode: Mode,
    states: Vec<f64>,
}

impl Equations {
    /// Deals with all contacts of an instant; `jump` holds what else happens then. The sizes of the impulses.
    pub(crate) fn switch_contacts(
        &self,
        at: &Crossing<'_, Mode>,
        causes: Causes,
        jump: &mut Jump<Mode>,
    ) -> Result<Sizes, Reason> {
        if self.pairs().is_empty() && !self.is_fed(&at.mode.bodies) {
            return Ok(Sizes::default());
        }
        if !causes.fed.is_empty() {
            let here = Spot { mode: at.mode, time: at.time, states: at.states, inputs: at.inputs };
            self.refuse_feedback(here, &causes.fed)?;
        }
        let now = Now::of(at);
        let woken = if causes.wakes { self.wake(jump) } else { vec![] };
        let is_compliant = |(pair, ..): &(usize, Watched, bool)| !self.pairs()[*pair].is_rigid();
        let unpressed = causes.seen.iter().any(is_compliant);
        let unpressed = unpressed.then(|| Unpressed { mode: jump.mode.clone(), states: jump.states.clone() });
        let (islands, touching) = self.islands_now(&causes, now, jump)?;
        let mut touched = vec![None; islands.len()];
        let of = |pair: usize| {
            islands.iter().position(|island| island.binary_search(&self.pairs()[pair].body).is_ok())
        };
        for pair in self.still_standing(at, jump).into_iter().chain(woken) {
            of(pair).into_iter().for_each(|island| _ = touched[island].get_or_insert_default());
        }
        for (pair, watched, closes) in causes.seen {
            let before = self.roots(&jump.mode);
            let mut pressed = vec![];
            let is_rigid = self.pairs()[pair].is_rigid();
            let own = of(pair).filter(|_| is_rigid || self.pairs()[pair].friction.is_some());
            let own = own.map(|island| touched[island].get_or_insert_with(Touched::default));
            match (is_rigid, watched) {
                (true, _) | (_, Watched::Slip | Watched::Cone(_)) => {
                    own.into_iter().for_each(|touched| touched.add(pair, watched));
                }
                (false, _) if closes => self.press(pair, None, now, jump)?,
                (false, Watched::Limit(_)) => pressed = self.pass_on(pair, now, jump)?,
                // It has passed with another.
                (false, Watched::Depth | Watched::Shallow)
                    if jump.mode.contact_mode(pair) != at.mode.contact_mode(pair) => {}
                (false, Watched::Depth | Watched::Shallow) => pressed = self.pass_slight(pair, now, jump)?,
                (false, watched) => pressed = self.let_go(pair, watched, now, jump)?,
            }
            self.restate(&before, &pressed, now, jump)?;
        }
        self.turn_round(at, jump)?;
        if let Some(unpressed) = &unpressed {
            let before = self.roots(&jump.mode);
            self.press_behind(&touching, unpressed, now, jump)?;
            self.restate(&before, &[], now, jump)?;
            self.enter_together(now, jump)?;
        }
        let mut impulses = Sizes::default();
        for (island, touched) in islands.iter().zip(touched) {
            let Some(touched) = touched else { continue };
            impulses.add(self.settle(island, &touched, now, jump)?);
            // Impacts of others may have turned what presses round, and so who slips.
            if self.turn_round(at, jump)? {
                impulses.add(self.settle(island, &Touched::default(), now, jump)?);
            }
        }
        Ok(impulses)
    }

    /// What joints, lasting contacts and bodies that meet at this instant make one island; with the pairs of bodies that touch. What bounces
    /// too low to be followed has those in its island that may come before it has ended.
    fn islands_now(
        &self,
        causes: &Causes,
        now: Now<'_>,
        jump: &Jump<Mode>,
    ) -> Result<(Vec<Vec<usize>>, Vec<usize>), Reason> {
        let near = self.meeting(&jump.mode, &jump.states, now, LOW)?;
        let seen = causes.seen.iter().map(|(pair, ..)| *pair);
        let meeting: Vec<usize> = near.iter().map(|(pair, _)| *pair).chain(seen).collect();
        let touching = near.into_iter().filter(|(_, blurs)| *blurs <= 1.0).map(|(pair, _)| pair).collect();
        Ok((self.islands_with(&jump.mode, &jump.mode.bodies, &meeting), touching))
    }

    /// Pairs that last or rub, where loads or parameters change now: what held them may not any more.
    fn still_standing(&self, at: &Crossing<'_, Mode>, jump: &Jump<Mode>) -> Vec<usize> {
        let is_pushed =
            |happening: &Happening| matches!(happening, Happening::Joint { .. } | Happening::Impulse(_));
        let same = at.mode.windows == jump.mode.windows
            && at.mode.changes == jump.mode.changes
            && !jump.record.happened.iter().any(is_pushed);
        if same {
            return vec![];
        }
        let lasting = at.mode.contacts.iter().filter(|(_, contact_mode)| contact_mode.is_lasting());
        lasting.map(|(pair, _)| *pair).chain(at.mode.grips.iter().map(|(pair, _)| *pair)).collect()
    }

    /// Impacts that were too small to follow have ended; the pairs of these. Nobody has watched how these slip.
    fn wake(&self, jump: &mut Jump<Mode>) -> Vec<usize> {
        let mut woken = vec![];
        for (pair, contact_mode) in &mut jump.mode.contacts {
            if *contact_mode == ContactMode::Settling {
                *contact_mode = ContactMode::Resting;
                jump.record.happened.push(Happening::Contact { pair: *pair, change: Change::Start });
                woken.push(*pair);
            }
        }
        woken
    }

    /// What touches bodies that are pressed from now on, and lies still, is pressed with them, though with no force at first: rounding would
    /// say when it begins. Each one further along has two more derivatives that are zero.
    fn press_behind(
        &self,
        touching: &[usize],
        unpressed: &Unpressed,
        now: Now<'_>,
        jump: &mut Jump<Mode>,
    ) -> Result<(), Reason> {
        let mut last: Vec<usize> =
            jump.mode.pressed().filter(|pair| !unpressed.mode.is_pressed(*pair)).collect();
        for row in 1.. {
            let is_next = |pair: &&usize| {
                let own = &self.pairs()[**pair];
                let is_open = !own.is_rigid() && jump.mode.contact_mode(**pair).is_none();
                is_open && last.iter().any(|known| self.pairs()[*known].bodies().any(|body| own.has(body)))
            };
            let next: Vec<usize> = touching.iter().filter(is_next).copied().collect();
            for pair in &next {
                self.press(*pair, Some((1 + 2 * row, unpressed)), now, jump)?;
            }
            last = next.into_iter().filter(|pair| jump.mode.is_pressed(*pair)).collect();
            if last.is_empty() {
                break;
            }
        }
        Ok(())
    }

    /// Whether loads that are none now press two together a moment later that touch without speed.
    fn begins_to_press(&self, index: usize, island: &[usize], now: Now<'_>, jump: &Jump<Mode>) -> bool {
        let acceleration = |later: Now<'_>| {
            let states = self.moved(later.time - now.time, jump);
            let touch = self.touch(island, &jump.mode, &states, later).ok()?;
            let then = touch.free[touch.position(index)?];
            (then.abs() > BALANCED * touch.strength).then_some(then)
        };
        now.moments().find_map(acceleration).is_some_and(|then| then < 0.0)
    }

    /// The states a moment later, as bodies move now: all, since springs of others may press on these.
    pub(crate) fn moved(&self, length: f64, jump: &Jump<Mode>) -> Vec<f64> {
        let mut states = jump.states.clone();
        for body in &jump.mode.bodies {
            let places = self.coordinate_states(&jump.mode, *body).into_iter();
            for (place, rate) in places.zip(self.velocity_states(&jump.mode, *body)) {
                states[place] += length * jump.states[rate];
            }
        }
        states
    }

    /// Two of which one is compliant meet. Where they touch without speed or force, they are pressed if others begin to press them, `behind`
    /// with so many derivatives of the gap that are zero.
    fn press(
        &self,
        index: usize,
        behind: Option<(usize, &Unpressed)>,
        now: Now<'_>,
        jump: &mut Jump<Mode>,
    ) -> Result<(), Reason> {
        let pair = &self.pairs()[index];
        let island = self.island_with(index, &jump.mode);
        // What has just begun to press has no force yet, but for rounding of its depth.
        let (mode, states) =
            behind.map_or((&jump.mode, &jump.states), |(_, Unpressed { mode, states })| (mode, states));
        let touch = self.touch(&island, mode, states, now)?;
        let Some(own) = touch.position(index) else { return Ok(()) };
        let stands = touch.rate[own].abs() <= STANDS * touch.speed[own];
        let is_calm = stands && touch.free[own].abs() <= BALANCED * touch.strength;
        let closes = match behind {
            Some(_) if is_calm => true,
            None if is_calm => self.begins_to_press(index, &island, now, jump),
            _ if stands => touch.free[own] < 0.0,
            _ => touch.rate[own] < 0.0,
        };
        if closes {
            jump.record.happened.push(Happening::Contact { pair: index, change: Change::Start });
            if stands && pair.is_hertzian() {
                return self.enter(index, Some(&touch).filter(|_| !is_calm), now, jump);
            }
            jump.mode.set_contact_mode(index, Some(ContactMode::Pressed));
        }
        let known = [1, 2, 3][usize::from(stands) + usize::from(is_calm)];
        let zeros = behind.map(|(zeros, _)| zeros).filter(|_| is_calm).unwrap_or(known);
        jump.zeros.push((pair.guard_name(Watched::Gap), zeros));
        Ok(())
    }

    /// The bodies of a pair with all that is coupled to them.
    pub(super) fn island_with(&self, pair: usize, mode: &Mode) -> Vec<usize> {
        self.islands_with(mode, &[self.pairs()[pair].body], &[pair]).concat()
    }

    /// Gives the new mode's states: roots of depths come with Hertzian contacts and go with them. `before` are those that the states are
    /// with; of what is pressed in as it comes the root is that of its depth, or of half the least that has a force.
    pub(super) fn restate(
        &self,
        before: &[usize],
        pressed: &[usize],
        now: Now<'_>,
        jump: &mut Jump<Mode>,
    ) -> Result<(), Reason> {
        let after = self.roots(&jump.mode);
        let base = jump.states.len() - before.len();
        let mut roots = vec![];
        for pair in after {
            roots.push(match before.iter().position(|known| *known == pair) {
                Some(known) => jump.states[base + known],
                None if pressed.contains(&pair) => {
                    let depth = [-self.pairs()[pair].gap(), self.pairs()[pair].slight()];
                    let depth = self.values(
                        &depth,
                        &Mode { contacts: vec![], ..jump.mode.clone() },
                        now.time,
                        &jump.states[..base],
                        now.inputs,
                    )?;
                    libm::sqrt(depth[0].max(LEAST * depth[1]))
                }
                None => 0.0,
            });
        }
        jump.states.truncate(base);
        jump.states.extend(roots);
        Ok(())
    }
}
