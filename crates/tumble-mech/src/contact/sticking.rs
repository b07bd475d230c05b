//! Contacts with friction at one instant: pushes with which no gap closes, and which friction allows.
//!
//! With w what gaps and slips do (rates or accelerations), b what they would do without pushes and A the response, `w = b + A z`. Along
//! the normals `w_n >= 0`, `z_n >= 0`, one of the two zero. Along a surface, for all points of one body on it together, since they slip
//! alike: it sticks, `w_t = 0` and `|z_t| <= mu_s z_n`, or it slides, `z_t = -mu_k sign(w_t) z_n`. For a choice of who sticks and who
//! slides which way, friction is eliminated and what is left is a problem of complementarity along the normals. The choice is found by
//! letting those slide that cannot hold; where that does not end, the choice that sweeps over single contacts come to is put right in
//! the same way; else that of the whole problem by complementary pivoting, in which sliding and sticking have one coefficient; and where there
//! are few surfaces and contacts all choices are tried, with every set of contacts: friction that is tied to pushes may hold one choice with
//! several sets, of which only one leaves it within what friction can be.
//!
//! A compliant surface presses with a force that is known, and part of b: of its contacts only the friction is looked for, with that load
//! in the place of z_n: what sticks is held by up to the sum of `mu_s` times the loads of all points that slip alike.

mod pivoting;
mod redundant;

use nalgebra::{DMatrix, DVector};

use crate::contact::complementarity::{
    DEPENDENT, independent, left_by_rounding, moved, pushing, standing, standing_together,
};
use crate::contact::grip::{Grip, Way};
use crate::product::product;

/// Friction that is beyond what it can be by less than this part has all that it can be.
const FULL: f64 = 1e-11;
/// Choices in turn for each surface before all are tried.
const ROUNDS: usize = 4;
/// Sweeps over all contacts for a first choice; what they have not come to by then is put right afterwards.
const SWEEPS: usize = 1000;
/// Friction nearer to what it can be at most than this part is taken for all of it after the sweeps.
const NEARLY_FULL: f64 = 1e-6;
/// With more surfaces than this not all choices are tried: there are five for each. Six, with every set of as many contacts, are some seconds, once.
pub(super) const MOST_TRIED: usize = 6;

/// All points by which one body touches one surface with friction.
#[derive(Clone, Debug)]
pub(super) struct Patch {
    /// Their normals, each with its row along the surface.
    pub(super) contacts: Vec<(usize, usize)>,
    /// Static and kinetic coefficient.
    pub(super) friction: [f64; 2],
    /// Set where it slips already, whatever happens.
    pub(super) slips: Option<Way>,
}

/// The problem. Normals of all contacts come first in its vectors, then what is along surfaces.
pub(super) struct Rough<'a> {
    pub(super) response: &'a DMatrix<f64>,
    /// b
    pub(super) without: DVector<f64>,
    /// Normals that take part.
    pub(super) contacts: Vec<usize>,
    pub(super) patches: Vec<Patch>,
    /// Pushes along the normals that are there anyway.
    pub(super) given: DVector<f64>,
    /// What presses contacts besides, and is part of b.
    pub(super) loads: DVector<f64>,
    /// What of w is nothing.
    pub(super) zero: f64,
}

/// A solution.
#[derive(Clone, Debug)]
pub(super) struct Pushes {
    /// z
    pub(super) pushes: DVector<f64>,
    /// Normals that push independently, some perhaps with no force.
    pub(super) held: Vec<usize>,
    /// By patch.
    pub(super) grips: Vec<Grip>,
    /// Rows along surfaces by which those that stick do.
    pub(super) holding: Vec<usize>,
    /// w
    pub(super) then: DVector<f64>,
}

/// Friction that is a part of the normal push.
#[derive(Clone, Copy)]
struct Tie {
    /// Row along the surface.
    row: usize,
    /// The contact, and its place among those that take part if it does.
    contact: usize,
    index: Option<usize>,
    part: f64,
}

/// The problem along the normals that is left once friction is eliminated.
#[derive(Clone)]
pub(super) struct Reduced {
    pub(super) matrix: DMatrix<f64>,
    pub(super) without: DVector<f64>,
    friction: Vec<Tie>,
    holding: Vec<usize>,
    /// What holds, without pushes and for each unit of them.
    held_without: DVector<f64>,
    held_by: DMatrix<f64>,
}

impl Rough<'_> {
    /// Pushes that every condition holds for; `None` if none were found.
    pub(super) fn solve(&self) -> Option<Pushes> {
        self.solve_or(&[])
    }

    /// The same with a choice that is likely before all are tried.
    pub(super) fn solve_or(&self, likely: &[Grip]) -> Option<Pushes> {
        let found = self.direct().or_else(|| self.chosen(likely));
        let found = found.or_else(|| self.one_of_all()).or_else(|| self.one_of_all_sets())?;
        Some(self.tidied(found))
    }

    /// The solution for a choice in which what slips already goes on, if it is one.
    pub(super) fn chosen(&self, grips: &[Grip]) -> Option<Pushes> {
        let goes_on =
            |(patch, grip): (&Patch, &Grip)| patch.slips.is_none_or(|way| *grip == Grip::Slides(way));
        let is_one = grips.len() == self.patches.len() && self.patches.iter().zip(grips).all(goes_on);
        if is_one { self.allowed(grips).filter(|found| self.all_follow(found)) } else { None }
    }

    /// The same without trying all choices, which may take long.
    pub(super) fn solve_directly(&self) -> Option<Pushes> {
        self.direct().map(|found| self.tidied(found))
    }

    fn direct(&self) -> Option<Pushes> {
        let start = |patch: &Patch| patch.slips.map_or(Grip::Sticks, Grip::Slides);
        let start: Vec<Grip> = self.patches.iter().map(start).collect();
        let found = self.allowed(&start).or_else(|| self.least_friction()).or_else(|| self.put_right(start));
        let found = found.or_else(|| self.put_right(self.swept()));
        found.or_else(|| self.by_pivoting(0)).or_else(|| self.by_pivoting(1))
    }

    fn tidied(&self, found: Pushes) -> Pushes {
        let found = self.strained(&found).unwrap_or(found);
        self.unpressed(&found).unwrap_or(found)
    }

    /// The solution for a choice, if friction allows it.
    fn allowed(&self, grips: &[Grip]) -> Option<Pushes> {
        self.attempt(grips).filter(|found| self.wrong(found).is_none())
    }

    /// What normals hold as far as they can, and friction what they cannot: where more contacts bear a load than are needed, friction may also
    /// wedge them against each other, which nothing asks for.
    fn least_friction(&self) -> Option<Pushes> {
        let mut kept = independent(self.response, self.contacts.iter().copied());
        let mut grip = |patch: &Patch| {
            let Some(way) = patch.slips else {
                let grown = independent(self.response, kept.iter().copied().chain([patch.row()]));
                let is_needed = grown.len() > kept.len();
                kept = grown;
                return if is_needed { Grip::Sticks } else { Grip::Follows };
            };
            Grip::Slides(way)
        };
        let grips: Vec<Grip> = self.patches.iter().map(&mut grip).collect();
        if !grips.contains(&Grip::Follows) {
            return None;
        }
        self.allowed(&grips).filter(|found| self.all_follow(found))
    }

    /// Whether what is to be kept in its place by others does not move, where anything presses it.
    fn all_follow(&self, found: &Pushes) -> bool {
        let mut following = self.patches.iter().zip(&found.grips).filter(|(_, grip)| **grip == Grip::Follows);
        following.all(|(patch, _)| {
            found.then[patch.row()].abs() <= self.zero || self.normal_of(patch, &found.pushes) <= 0.0
        })
    }

    /// The same with friction nowhere that nothing presses, if what is held otherwise keeps it in its place: where loads only begin, normals that
    /// stand still without a push come before it, and say from then on whether they press.
    fn unpressed(&self, found: &Pushes) -> Option<Pushes> {
        let stands = |contact: usize| found.then[contact] <= self.zero && !found.held.contains(&contact);
        let standing: Vec<usize> = self.contacts.iter().copied().filter(|contact| stands(*contact)).collect();
        let is_loose = |(patch, grip): &(&Patch, &Grip)| {
            **grip == Grip::Sticks
                && !self.has_load(patch, &found.pushes)
                && patch.contacts.iter().any(|(contact, _)| standing.contains(contact))
        };
        let all = || self.patches.iter().zip(&found.grips);
        if !all().any(|one| is_loose(&one)) {
            return None;
        }
        let pressed =
            all().filter(|one| *one.1 == Grip::Sticks && !is_loose(one)).map(|(patch, _)| patch.row());
        let kept: Vec<usize> =
            found.held.iter().copied().chain(pressed).chain(standing.iter().copied()).collect();
        let mut kept = independent(self.response, kept);
        let grips: Vec<Grip> = all()
            .map(|one| {
                let grown = independent(self.response, kept.iter().copied().chain([one.0.row()]));
                match is_loose(&one) {
                    true if grown.len() == kept.len() => Grip::Follows,
                    true => {
                        kept = grown;
                        Grip::Sticks
                    }
                    false => *one.1,
                }
            })
            .collect();
        if grips == found.grips {
            return None;
        }
        self.allowed(&grips)
    }

    /// The same with what would slide but goes nowhere held by others, its friction all that it can have: where more contacts bear a load than are
    /// needed, that is one of the ways to share it.
    fn strained(&self, found: &Pushes) -> Option<Pushes> {
        let strains = |(patch, grip): (&Patch, &Grip)| match grip {
            Grip::Slides(way) if patch.slips.is_none() && found.then[patch.row()].abs() <= self.zero => {
                Grip::Strains(*way)
            }
            other => *other,
        };
        let grips: Vec<Grip> = self.patches.iter().zip(&found.grips).map(strains).collect();
        if grips == found.grips {
            return None;
        }
        self.allowed(&grips)
    }

    /// The first of all choices that friction allows.
    fn one_of_all(&self) -> Option<Pushes> {
        let choices = self.all_choices();
        let mut found = choices.iter().filter_map(|grips| self.attempt(grips));
        found.find(|found| self.wrong(found).is_none())
    }

    /// The same with every set of contacts that may push.
    fn one_of_all_sets(&self) -> Option<Pushes> {
        if self.contacts.len() > MOST_TRIED {
            return None;
        }
        let (choices, sets) = (self.all_choices(), self.all_sets());
        let all = choices.iter().flat_map(|grips| sets.iter().map(move |held| (grips, held)));
        let mut found = all.filter_map(|(grips, held)| self.stopped(grips, held));
        found.find(|found| self.is_sound(found))
    }

    /// Whether no push pulls and nothing closes.
    pub(super) fn pushes_apart(&self, found: &Pushes) -> bool {
        self.contacts.iter().all(|&contact| {
            let more = found.pushes[contact] - self.given[contact];
            more >= -self.slack(contact, &found.pushes) && found.then[contact] >= -self.zero
        })
    }

    /// Whether pushes are as friction has them, none of which pulls, and nothing closes.
    pub(super) fn is_sound(&self, found: &Pushes) -> bool {
        self.pushes_apart(found) && self.wrong(found).is_none()
    }

    /// Pushes for a choice in which one after the other is changed that friction does not allow.
    fn put_right(&self, mut grips: Vec<Grip>) -> Option<Pushes> {
        for _ in 0..=ROUNDS * self.patches.len() {
            let found = self.attempt(&grips)?;
            match self.wrong(&found) {
                None => return Some(found),
                Some((patch, grip)) => grips[patch] = grip,
            }
        }
        None
    }

    /// The choice that is come to by pushing at one contact after the other as much as stops it there, within what friction allows
    /// (Gauss and Seidel).
    fn swept(&self) -> Vec<Grip> {
        let mut pushes = self.given.clone();
        for _ in 0..SWEEPS {
            for &contact in &self.contacts {
                let stopping = self.stopping(contact, &pushes);
                pushes[contact] = stopping.max(self.given[contact]);
            }
            for patch in &self.patches {
                for &(contact, row) in &patch.contacts {
                    let normal = self.normal(&pushes, contact);
                    let [most, kinetic] = patch.friction.map(|friction| friction * normal);
                    pushes[row] = match patch.slips {
                        Some(way) => -f64::from(way.sign()) * kinetic,
                        None => self.stopping(row, &pushes).max(-most).min(most),
                    };
                }
            }
        }
        let then = self.then(&pushes);
        self.patches.iter().map(|patch| self.swept_grip(patch, &pushes, &then)).collect()
    }

    /// The push of a row with which it stands still, the others as they are.
    fn stopping(&self, row: usize, pushes: &DVector<f64>) -> f64 {
        let own = self.response[(row, row)];
        let rate = self.without[row] + self.response.row(row).transpose().dot(pushes);
        if own > 0.0 { pushes[row] - rate / own } else { pushes[row] }
    }

    fn swept_grip(&self, patch: &Patch, pushes: &DVector<f64>, then: &DVector<f64>) -> Grip {
        let normal = self.normal_of(patch, pushes);
        let along: f64 = patch.contacts.iter().map(|(_, row)| pushes[*row]).sum();
        let slip = then[patch.row()];
        match patch.slips {
            Some(way) => Grip::Slides(way),
            None if along.abs() < (1.0 - NEARLY_FULL) * patch.friction[0] * normal => Grip::Sticks,
            None if slip.abs() > self.zero => Grip::Slides(Way::of(slip)),
            None if normal > 0.0 => Grip::Strains(Way::of(-along)),
            None => Grip::Sticks,
        }
    }

    /// Pushes of either sign with which just these normals, and those that stick, stand still.
    pub(super) fn stopped(&self, grips: &[Grip], held: &[usize]) -> Option<Pushes> {
        let reduced = self.reduced(grips)?;
        let held: Vec<usize> =
            (0..self.contacts.len()).filter(|index| held.contains(&self.contacts[*index])).collect();
        let of = (&reduced.matrix, &reduced.without);
        let pushes = standing(of.0, of.1, &held).or_else(|| standing_together(of.0, of.1, &held))?;
        let is_redundant = self.is_redundant(&reduced, &held);
        (!is_redundant).then(|| self.complete(grips, reduced, &held, &pushes))
    }

    /// The solution for a choice of grips, whether or not friction allows it.
    pub(super) fn attempt(&self, grips: &[Grip]) -> Option<Pushes> {
        self.solved(grips, self.reduced(grips)?)
    }

    /// The same of the problem that is left.
    pub(super) fn solved(&self, grips: &[Grip], reduced: Reduced) -> Option<Pushes> {
        let (held, pushes) = pushing(&reduced.matrix, &reduced.without)?;
        if self.is_redundant(&reduced, &held) {
            return self.with_one_less(grips, reduced, &held);
        }
        Some(self.complete(grips, reduced, &held, &pushes))
    }

    /// The problem along the normals that a choice of grips leaves.
    pub(super) fn reduced(&self, grips: &[Grip]) -> Option<Reduced> {
        let friction = self.ties(grips);
        let mut columns = DMatrix::from_fn(self.response.nrows(), self.contacts.len(), |row, index| {
            self.response[(row, self.contacts[index])]
        });
        let mut without = &self.without + self.response * &self.given;
        for Tie { row, contact, index, part } in &friction {
            let along = self.response.column(*row);
            if let Some(index) = index {
                columns.column_mut(*index).axpy(*part, &along, 1.0);
            }
            without.axpy(part * self.normal(&self.given, *contact), &along, 1.0);
        }
        let holding = self.holding(grips);
        let of = |some: &[usize]| DMatrix::from_fn(some.len(), columns.ncols(), |i, j| columns[(some[i], j)]);
        let part = |some: &[usize]| DVector::from_fn(some.len(), |i, _| without[some[i]]);
        let [across, among] = [&self.contacts, &holding].map(|some| {
            DMatrix::from_fn(some.len(), holding.len(), |i, j| self.response[(some[i], holding[j])])
        });
        let factors = among.cholesky()?;
        let (held_by, held_without) = (factors.solve(&of(&holding)), factors.solve(&part(&holding)));
        let mut reduced = Reduced {
            matrix: of(&self.contacts) - product(&across, &held_by),
            without: part(&self.contacts) - across * &held_without,
            friction,
            holding,
            held_without,
            held_by,
        };
        self.clear(&mut reduced);
        Some(reduced)
    }

    /// Takes rounding out of what those that stick keep where it is.
    fn clear(&self, reduced: &mut Reduced) {
        for (index, contact) in self.contacts.iter().enumerate() {
            if reduced.matrix[(index, index)].abs() <= DEPENDENT * self.response[(*contact, *contact)] {
                reduced.matrix.fill_row(index, 0.0);
                reduced.matrix.fill_column(index, 0.0);
                if reduced.without[index].abs() <= self.zero {
                    reduced.without[index] = 0.0;
                }
            }
        }
    }

    /// What presses a contact, by the pushes.
    fn normal(&self, pushes: &DVector<f64>, contact: usize) -> f64 {
        pushes[contact] + self.loads[contact]
    }

    /// w by z.
    fn then(&self, pushes: &DVector<f64>) -> DVector<f64> {
        moved(self.response, &self.without, pushes)
    }

    /// A push of a row that is none beside all pushes: rounding.
    fn slack(&self, row: usize, pushes: &DVector<f64>) -> f64 {
        let left = left_by_rounding(self.response, &self.without, pushes, row);
        self.zero.max(left) / self.response[(row, row)].max(f64::MIN_POSITIVE)
    }

    /// Whether anything presses what slips alike.
    pub(super) fn has_load(&self, patch: &Patch, pushes: &DVector<f64>) -> bool {
        self.normal_of(patch, pushes) > self.slack(patch.row(), pushes)
    }

    /// The same of all that slips alike.
    pub(super) fn normal_of(&self, patch: &Patch, pushes: &DVector<f64>) -> f64 {
        patch.contacts.iter().map(|(contact, _)| self.normal(pushes, *contact)).sum()
    }

    /// Friction that is tied to normals.
    fn ties(&self, grips: &[Grip]) -> Vec<Tie> {
        let mut ties = vec![];
        for (patch, grip) in self.patches.iter().zip(grips) {
            let part = match grip {
                Grip::Slides(way) => -f64::from(way.sign()) * patch.friction[1],
                Grip::Strains(way) => -f64::from(way.sign()) * patch.friction[0],
                Grip::Sticks | Grip::Follows => continue,
            };
            let index = |contact: usize| self.contacts.iter().position(|known| *known == contact);
            let own = patch.contacts.iter();
            ties.extend(own.map(|&(contact, row)| Tie { row, contact, index: index(contact), part }));
        }
        ties
    }

    /// Of the rows by which those that stick do, a largest set that is independent.
    fn holding(&self, grips: &[Grip]) -> Vec<usize> {
        let sticking = self.patches.iter().zip(grips).filter(|(_, grip)| **grip == Grip::Sticks);
        independent(self.response, sticking.map(|(patch, _)| patch.row()))
    }

    fn complete(&self, grips: &[Grip], reduced: Reduced, held: &[usize], found: &DVector<f64>) -> Pushes {
        let mut pushes = self.given.clone();
        for (index, contact) in self.contacts.iter().enumerate() {
            pushes[*contact] += found[index];
        }
        for Tie { row, contact, part, .. } in &reduced.friction {
            pushes[*row] = part * self.normal(&pushes, *contact);
        }
        let kept = -(reduced.held_without + reduced.held_by * found);
        reduced.holding.iter().zip(&kept).for_each(|(row, push)| pushes[*row] = *push);
        let then = self.then(&pushes);
        let held = held.iter().map(|index| self.contacts[*index]).collect();
        Pushes { then, pushes, held, grips: grips.to_vec(), holding: reduced.holding }
    }

    /// The first patch that friction does not allow to be held or to slip as it was chosen, with what to try instead.
    fn wrong(&self, found: &Pushes) -> Option<(usize, Grip)> {
        let all = self.patches.iter().zip(&found.grips).enumerate();
        let mut wrong =
            all.filter_map(|(index, (patch, grip))| Some((index, self.instead(patch, *grip, found)?)));
        wrong.next()
    }

    fn instead(&self, patch: &Patch, grip: Grip, found: &Pushes) -> Option<Grip> {
        let normal = self.normal_of(patch, &found.pushes);
        let (row, slip) = (patch.row(), found.then[patch.row()]);
        let slack = self.slack(row, &found.pushes);
        match grip {
            _ if patch.slips.is_some() => None,
            Grip::Sticks | Grip::Follows => {
                let (push, most) = (found.pushes[row], patch.friction[0] * normal);
                (push.abs() > most * (1.0 + FULL) + slack).then(|| Grip::Strains(Way::of(-push)))
            }
            Grip::Strains(way) => {
                let along = f64::from(way.sign()) * slip;
                (slip.abs() > self.zero).then_some(if along > 0.0 {
                    Grip::Slides(way)
                } else {
                    Grip::Slides(Way::of(slip))
                })
            }
            Grip::Slides(way) => {
                let is_against = f64::from(way.sign()) * slip < -self.zero;
                (is_against && normal > 0.0).then_some(Grip::Sticks)
            }
        }
    }

    /// All sets of contacts that may push.
    pub(super) fn all_sets(&self) -> Vec<Vec<usize>> {
        let of =
            |set: usize| self.contacts.iter().enumerate().filter(move |(index, _)| set >> index & 1 == 1);
        (0..1_usize << self.contacts.len())
            .map(|set| of(set).map(|(_, contact)| *contact).collect())
            .collect()
    }

    /// All choices of grips, but for what slips already; none where they are too many.
    fn all_choices(&self) -> Vec<Vec<Grip>> {
        if self.patches.iter().filter(|patch| patch.slips.is_none()).count() > MOST_TRIED {
            return vec![];
        }
        let ways = [Way::Forward, Way::Backward];
        let free: Vec<Grip> =
            [Grip::Sticks].into_iter().chain(ways.map(Grip::Strains)).chain(ways.map(Grip::Slides)).collect();
        self.patches.iter().fold(vec![vec![]], |choices, patch| {
            let own = patch.slips.map_or(free.clone(), |way| vec![Grip::Slides(way)]);
            choices.iter().flat_map(|known| own.iter().map(|grip| [&known[..], &[*grip]].concat())).collect()
        })
    }
}

impl Patch {
    /// The row along the surface that stands for all of them.
    pub(super) fn row(&self) -> usize {
        self.contacts[0].1
    }
}

#[cfg(test)]
mod tests {
    use crate::contact::certain::tests::{Draw, random};
    use crate::contact::grip::Grip;

    /// Much friction may hold one choice with several sets of contacts: of some thousand problems a few are solved by trying these alone.
    #[test]
    fn every_set_is_tried() {
        let mut draw = Draw(23);
        let mut alone = 0;
        for index in 0..3000 {
            let friction = 0.5 + 0.02 * f64::from(index % 60);
            let rough = random(&mut draw, [2 + index as usize % 2, 3 + index as usize % 3], friction);
            let Some(found) = rough.one_of_all_sets() else { continue };
            assert!(found.then.iter().take(rough.contacts.len()).all(|opens| *opens >= -rough.zero));
            alone += usize::from(rough.one_of_all().is_none());
            assert!(rough.solve().is_some(), "{index}");
        }
        assert!(alone > 5, "{alone}");
    }

    /// With more surfaces than all choices are tried of, and many more rows than are independent: there are pushes for all of these problems, and
    /// pivoting finds them, of which others that stick by other rows may not be within what friction can be.
    #[test]
    fn what_pivoting_finds_is_kept() {
        let mut draw = Draw(47);
        for index in 0..300 {
            let mut rough = random(&mut draw, [8 + index % 3, 4 + index % 5], 0.2 + 0.002 * index as f64);
            rough.patches.iter_mut().for_each(|patch| patch.slips = None);
            assert!(rough.solve().is_some(), "{index}");
        }
    }

    /// Where more contacts bear a load than are needed, forces are found with which some have all the friction they can have: these do not slide if
    /// nothing moves.
    #[test]
    fn what_goes_nowhere_does_not_slide() {
        let mut draw = Draw(31);
        let mut jammed = 0;
        for index in 0..3000 {
            let friction = 0.3 + 0.02 * f64::from(index % 60);
            let mut rough = random(&mut draw, [2 + index as usize % 3, 2 + index as usize % 2], friction);
            rough.patches.iter_mut().for_each(|patch| patch.slips = None);
            let Some(found) = rough.solve().filter(|found| found.then.amax() <= rough.zero) else { continue };
            let slides = found.grips.iter().any(|grip| matches!(grip, Grip::Slides(_)));
            assert!(!slides, "{index}: {:?}", found.grips);
            jammed += usize::from(found.grips.iter().any(|grip| matches!(grip, Grip::Strains(_))));
        }
        assert!(jammed > 20, "{jammed}");
    }
}
