//! Impacts of an instant: without friction, by Routh at one contact with friction, or of several.

use nalgebra::DVector;
use tumble_ode::Reason;

use super::{STANDS, Settling, Touched};
use crate::contact::complementarity::{ZERO, standing};
use crate::contact::pair::Pair;
use crate::contact::routh::{Refused, Strike};
use crate::contact::sticking::{Patch, Pushes, Rough};
use crate::contact::touch::Touch;
use crate::contact::zeno::flight;
use crate::friction::Restitution;
use crate::laws::impact::{FOLLOWED, MultipleImpacts, fastest, impulses};
use crate::mode::Mode;
use crate::record::Jump;

/// Impacts at one instant, each since the one before turned round what was about to part, that have not come to an end by then are refused.
const MOST_ROUNDS: usize = 1000;
/// Contacts that change each other's rates by less than this part of their own by an impulse do not influence each other.
const COUPLED: f64 = 1e-12;
/// Impacts one after the other at one instant that have not come to an end by then are refused.
const MOST_SEQUENTIAL: usize = 10_000;

/// What the restitution of a pair is the ratio of.
fn law_of(pair: &Pair) -> Restitution {
    pair.friction.as_ref().and_then(|friction| friction.restitution).unwrap_or_default()
}

impl Settling<'_> {
    /// Velocities after the impacts of this instant, and whether there are any: an impact may turn round what touches and was about to part.
    pub(super) fn impacts(&mut self, touched: &Touched, jump: &mut Jump<Mode>) -> Result<bool, Reason> {
        let before = self.rounds;
        loop {
            let closing = self.about_to_close(touched);
            if closing.is_empty() {
                return Ok(self.rounds > before);
            }
            self.count_round()?;
            self.take_part(closing);
            let fastest = self.of(&self.touch.rate).amax();
            self.impact(jump)?;
            self.blur_closing(fastest);
        }
    }

    /// Impulses of several let none close, but for rounding, which is that of the fastest: struck again, what is slower than it would be left as it is.
    fn blur_closing(&mut self, fastest: f64) {
        let rounding = -ZERO * fastest..0.0;
        let is_left = |position: &usize| rounding.contains(&self.touch.rate[*position]);
        let left: Vec<usize> = self.part.iter().copied().filter(is_left).collect();
        self.take_for_still(&left);
    }

    /// One more impact of this instant; too many are refused.
    pub(super) fn count_round(&mut self) -> Result<(), Reason> {
        if self.rounds == MOST_ROUNDS {
            return Err(self.endless());
        }
        self.rounds += 1;
        self.is_ended = false;
        Ok(())
    }

    /// Contacts that close now: what is within the rounding of its gap but takes longer than the shortest step is still to come, unless it has not
    /// been further away since the event before. What is squeezed between walls would go to and fro within rounding, each time a little slower.
    pub(super) fn about_to_close(&self, touched: &Touched) -> Vec<usize> {
        let Touch { gap, rate, free, .. } = &self.touch;
        let is_at_once = |position: usize| {
            let time = flight(gap[position].max(0.0), rate[position], free[position]);
            self.may_touch(position, touched) && (self.is_unresolved || time <= self.shortest())
        };
        let closes = |position: &usize| rate[*position] < 0.0 && !self.stands(*position);
        let has_part = |position: usize| self.part.contains(&position) || is_at_once(position);
        (0..gap.len()).filter(|position| closes(position) && has_part(*position)).collect()
    }

    fn impact(&mut self, jump: &mut Jump<Mode>) -> Result<(), Reason> {
        let (rate, restitution) = (self.of(&self.touch.rate), self.of(&self.touch.restitution));
        let impulses = if self.is_rough() { self.rough_impulses()? } else { self.smooth_impulses()? };
        self.impulses += &impulses;
        self.apply(&impulses, jump)?;
        let rebounds = -restitution.component_mul(&rate);
        self.refine(&rebounds, jump)
    }

    /// Impulses of the impacts of this instant where nothing has friction.
    fn smooth_impulses(&self) -> Result<DVector<f64>, Reason> {
        let rule = self.equations.model().multiple_impacts;
        let (rate, restitution) = (self.of(&self.touch.rate), self.of(&self.touch.restitution));
        let push = impulses(rule, &self.response(&self.part), &rate, &restitution);
        let push = push.ok_or_else(|| match rule {
            MultipleImpacts::Sequential => self.endless(),
            MultipleImpacts::Simultaneous => self.unsolved("impact"),
        });
        Ok(self.whole(&self.part, &push?))
    }

    /// Takes the rounding of the impulses out of the rates where they are known, each what its restitution makes of it, or none where others have
    /// taken that away, whichever is nearer: a ball that bounces for long makes the same rounding each time.
    fn refine(&mut self, rebounds: &DVector<f64>, jump: &mut Jump<Mode>) -> Result<(), Reason> {
        self.rebounding.clear();
        let rate = self.of(&self.touch.rate);
        let nearer = |rebound: f64, rate: f64| if rate <= 0.5 * rebound { 0.0 } else { rebound };
        let target = rebounds.zip_map(&rate, nearer);
        let off = rate - &target;
        let is_known = |i: usize| off[i].abs() <= self.no_rate(self.part[i]);
        let are_known = (0..off.len()).all(is_known);
        let mut rows = if are_known { self.part.clone() } else { vec![] };
        let mut off = self.whole(&self.part, &off);
        for slip in self.standing_slips() {
            off[slip] = self.touch.slips.rate[slip - self.touch.pairs.len()];
            rows.push(slip);
        }
        if rows.is_empty() {
            return Ok(());
        }
        // Contacts that are not independent keep what rounding left.
        let Some(missing) = standing(&self.touch.response, &off, &rows) else { return Ok(()) };
        self.apply(&missing, jump)?;
        if are_known {
            let positions = self.part.iter().zip(&target).filter(|(_, rate)| **rate > 0.0);
            self.rebounding = positions.map(|(position, _)| *position).collect();
        }
        Ok(())
    }

    /// Impulses of the impacts of this instant.
    fn rough_impulses(&mut self) -> Result<DVector<f64>, Reason> {
        let mut all = DVector::zeros(self.touch.response.nrows());
        for group in self.coupled(&self.part) {
            let closes = |position: &usize| self.touch.rate[*position] < -STANDS * self.speed[*position];
            if !group.iter().any(closes) {
                continue;
            }
            let rule = self.equations.model().multiple_impacts;
            all += match &group[..] {
                [only] => self.routh(*only, &self.rates())?,
                _ if rule == MultipleImpacts::Sequential => self.one_by_one(&group)?,
                _ => self.at_once(&group, &self.rates())?,
            };
            self.blur_together(&group);
        }
        Ok(all)
    }

    /// Impulses of several are found to a rounding error of the fastest of them: what is left of the others' rates is none.
    fn blur_together(&mut self, group: &[usize]) {
        let fastest = group.iter().map(|position| self.speed[*position]).fold(0.0, f64::max);
        group.iter().for_each(|position| self.speed[*position] = fastest);
    }

    /// Some contacts, parted where impulses at some do nothing to others.
    pub(super) fn coupled(&self, some: &[usize]) -> Vec<Vec<usize>> {
        let mut groups: Vec<Vec<usize>> = vec![];
        for &position in some {
            let (own, others): (Vec<_>, Vec<_>) = groups
                .into_iter()
                .partition(|group| group.iter().any(|other| self.are_coupled(position, *other)));
            groups = others;
            groups.push([own.concat(), vec![position]].concat());
        }
        groups.iter_mut().for_each(|group| group.sort_unstable());
        groups.sort_unstable();
        groups
    }

    fn are_coupled(&self, a: usize, b: usize) -> bool {
        let response = &self.touch.response;
        let [of_a, of_b] = [a, b].map(|position| {
            let slip = self.touch.slips.at(position).map(|slip| self.touch.pairs.len() + slip);
            [Some(position), slip]
        });
        let own = |i: usize, j: usize| libm::sqrt(response[(i, i)] * response[(j, j)]);
        let mut entries = of_a.iter().flatten().flat_map(|i| of_b.iter().flatten().map(move |j| (*i, *j)));
        entries.any(|(i, j)| response[(i, j)].abs() > COUPLED * own(i, j))
    }

    /// The impulse at one contact that strikes alone.
    pub(super) fn routh(&self, position: usize, rates: &DVector<f64>) -> Result<DVector<f64>, Reason> {
        let (response, pair) = (&self.touch.response, &self.equations.pairs()[self.touch.pairs[position]]);
        let mut all = DVector::zeros(response.nrows());
        let restitution = self.touch.restitution[position];
        let Some(slip) = self.touch.slips.at(position) else {
            all[position] = -(1.0 + restitution) * rates[position] / response[(position, position)];
            return Ok(all);
        };
        let row = self.touch.pairs.len() + slip;
        let stands = rates[row].abs() <= self.still(slip);
        let strike = Strike {
            response: [response[(row, row)], response[(row, position)], response[(position, position)]],
            before: [if stands { 0.0 } else { rates[row] }, rates[position]],
            friction: self.touch.slips.friction[slip],
            restitution,
            law: law_of(pair),
        };
        let struck = strike.resolve().map_err(|refused| self.refused(position, refused))?;
        [all[row], all[position]] = struck.impulse;
        Ok(all)
    }

    fn refused(&self, position: usize, refused: Refused) -> Reason {
        let name = &self.equations.pairs()[self.touch.pairs[position]].name;
        Reason::Model(match refused {
            Refused::Blocked => {
                format!("`{name}` strikes, and nothing that pushes there parts it from the surface")
            }
            Refused::GainsEnergy(gain) => format!(
                "`{name}` strikes with friction, and Newton's law of restitution would add {gain} J there (Kane's paradox): take \
                 `law = \"poisson\"` or `law = \"stronge\"`, which never add energy"
            ),
        })
    }

    /// The fastest approach first, then the next; those that are equally fast together.
    fn one_by_one(&self, group: &[usize]) -> Result<DVector<f64>, Reason> {
        let mut rates = self.rates();
        let mut all = DVector::zeros(rates.len());
        for _ in 0..MOST_SEQUENTIAL {
            let closes = |position: &usize| rates[*position] < -FOLLOWED * self.speed[*position];
            let closing: Vec<usize> = group.iter().copied().filter(closes).collect();
            let first = fastest(closing.iter().map(|position| rates[*position]));
            let first: Vec<usize> = first.into_iter().map(|index| closing[index]).collect();
            if first.is_empty() {
                return Ok(all);
            }
            let now = rates.clone();
            for together in self.coupled(&first) {
                let impulse = match &together[..] {
                    [only] => self.routh(*only, &now)?,
                    several => self.at_once(several, &now)?,
                };
                rates += &self.touch.response * &impulse;
                all += impulse;
            }
        }
        Err(self.endless())
    }

    /// Compression until nothing closes, then restitution gives back its part, and as much more as keeps the gaps from closing.
    fn at_once(&self, group: &[usize], rates: &DVector<f64>) -> Result<DVector<f64>, Reason> {
        self.refuse_other_laws(group)?;
        let zero = STANDS * group.iter().map(|position| self.speed[*position]).fold(0.0, f64::max);
        let patches = self.patches(group, false);
        let compressed = Rough { zero, ..self.rough(group, &patches, rates.clone()) }.solve();
        self.restored(group, &patches, compressed.ok_or_else(|| self.unsolved("impact"))?, zero)
    }

    /// Impulses of compression with those of restitution.
    pub(super) fn restored(
        &self,
        group: &[usize],
        patches: &[Patch],
        compressed: Pushes,
        zero: f64,
    ) -> Result<DVector<f64>, Reason> {
        let mut given = DVector::zeros(compressed.pushes.len());
        for position in group {
            given[*position] = self.touch.restitution[*position] * compressed.pushes[*position];
        }
        if given.amax() == 0.0 {
            return Ok(compressed.pushes);
        }
        let restored = Rough { given, zero, ..self.rough(group, patches, compressed.then) }.solve();
        Ok(compressed.pushes + restored.ok_or_else(|| self.unsolved("impact"))?.pushes)
    }

    pub(super) fn refuse_other_laws(&self, group: &[usize]) -> Result<(), Reason> {
        let pairs = group.iter().map(|position| &self.equations.pairs()[self.touch.pairs[*position]]);
        match pairs.into_iter().find(|pair| law_of(pair) != Restitution::Poisson) {
            None => Ok(()),
            Some(pair) => Err(Reason::Model(format!(
                "`{}` strikes together with others, for which there is Poisson's law alone: write `law = \"poisson\"`, or \
                 `impacts = \"sequential\"` to let one strike after the other",
                pair.name
            ))),
        }
    }

    /// Impacts one after the other at this instant that come to no end.
    fn endless(&self) -> Reason {
        let bodies = self.equations.body_names(&self.island);
        let way_out = match self.equations.model().multiple_impacts {
            MultipleImpacts::Sequential => "take `impacts = \"simultaneous\"`",
            MultipleImpacts::Simultaneous => "take less restitution, or start a little differently",
        };
        Reason::Model(format!(
            "impacts of {bodies} follow each other at one instant and come to no end, nor near one: {way_out}"
        ))
    }
}
