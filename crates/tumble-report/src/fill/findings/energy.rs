//! Where the energy goes: what has taken out or put in much of it, and what joints pass on.

use tumble_mech::{Contribution, ContributionKind, Law};
use tumble_scene::Study;

use super::said::{Said, with_digits};
use crate::figures::symbols;
use crate::fill::names::quantity_to;
use crate::report::Text;
use crate::results::{Case, CaseBalance};

/// Part of the energies in a run from which on work is told.
const MATTERS: f64 = 0.01;
/// Part of what is passed on that may be missing: less is rounding.
const PASSES: f64 = 1e-6;
/// So many that pass most energy on are told of.
const MOST_PASSED: usize = 3;
/// Who loses and gains what no single body does.
const MOTION: &str = "the motion";
/// Digits of a share.
const SHARE: usize = 2;

/// What loads of one kind have done together: all points of a body that touch one surface, with friction apart.
#[derive(Clone)]
struct Done {
    name: String,
    /// What it acts on, in a sentence.
    body: String,
    work: f64,
    error: Option<f64>,
}

impl Done {
    /// What work of that sign is called.
    fn says(&self, work: f64) -> String {
        let does = if work < 0.0 { "takes energy from" } else { "gives energy to" };
        format!("{} {does} {}: ", self.name, self.body)
    }
}

pub(super) fn of(study: &Study, case: &Case) -> Vec<Said> {
    let Some(balance) = &case.balance else { return vec![] };
    let matters = |work: f64| work.abs() > MATTERS * balance.energy.scale;
    let (passed, all) = parted(study, balance);
    let sum = |sign: f64| all.iter().map(|done| (sign * done.work).max(0.0)).sum::<f64>();
    let (lost, gained) = (sum(-1.0), sum(1.0));
    let said = |done: &Done| {
        let (whole, what) =
            if done.work < 0.0 { (lost, "of the total loss") } else { (gained, "of the total gain") };
        let value = with_digits(done.work.abs(), done.error, "J");
        let percent = quantity_to(100.0 * done.work.abs() / whole, SHARE, "");
        let is_alone = done.work.abs() > (1.0 - MATTERS) * whole;
        let share = Text::from(", ").and(percent).and(format!(" % {what}"));
        Said::new(done.says(done.work), if is_alone { value } else { value.and(share) })
    };
    // Beside runs in which it matters, either way.
    let slight = |done: &Done| {
        let either = [1.0, -1.0].map(|way| {
            Said::new(done.says(way), with_digits(way * done.work, done.error, "J")).where_it_matters(false)
        });
        if matters(done.work) { vec![] } else { either.to_vec() }
    };
    let pass = |done: &Done| Said::new(done.name.clone(), with_digits(done.work, done.error, "J"));
    let told = all.iter().filter(|done| matters(done.work)).map(said);
    let told = told.chain(all.iter().flat_map(slight));
    told.chain(passed.iter().filter(|done| matters(done.work)).map(pass)).collect()
}

/// What joints and contacts pass from body to body, and what everything else has done: they too, by what one body does not get of the other's.
fn parted(study: &Study, balance: &CaseBalance) -> (Vec<Done>, Vec<Done>) {
    let counted = balance.contributions.iter().enumerate().filter(|(_, (_, one))| one.counts());
    let entries: Vec<(Done, &Contribution)> = counted
        .map(|(index, (_, one))| {
            let error = balance.work_errors.as_ref().map(|errors| errors[index]);
            let body = called(study, one);
            (Done { name: name_of(study, one), body, work: one.work, error }, one)
        })
        .collect();
    let (mut passed, mut all): (Vec<Done>, Vec<Done>) = (vec![], vec![]);
    for (index, (done, one)) in entries.iter().enumerate() {
        let is_other = |(_, (other, two)): &(usize, &(Done, &Contribution))| {
            two.load == one.load
                && two.kind == one.kind
                && two.body != one.body
                && other.work * done.work < 0.0
        };
        match entries.iter().enumerate().find(|entry| entry.0 != index && is_other(entry)) {
            Some((_, (other, two))) if done.work > 0.0 => {
                let work = done.work.min(-other.work);
                let (rest, error) = (done.work + other.work, done.error.zip(other.error).map(|(a, b)| a + b));
                // Where others strike at the same instant, what goes from one to the next is not of one contact.
                if work >= rest.abs() {
                    passed.push(passing(study, (Done { work, ..done.clone() }, one), two));
                }
                if rest.abs() > PASSES * work {
                    add(&mut all, &Done { work: rest, error, body: MOTION.to_owned(), ..done.clone() });
                }
            }
            Some(_) => {}
            None => add(&mut all, done),
        }
    }
    passed.sort_by(|one, other| other.work.total_cmp(&one.work));
    passed.truncate(MOST_PASSED);
    (passed, all)
}

fn passing(study: &Study, (done, to): (Done, &Contribution), from: &Contribution) -> Done {
    let how = if to.kind == ContributionKind::Impact { " in an impact" } else { "" };
    let (from, body) = (called(study, from), called(study, to));
    let joint = match to.law {
        Some(Law::Contact | Law::Friction) => name_of(study, to),
        _ => symbols::joint(&to.load),
    };
    // Its name says that it was one.
    let how = if joint.contains("impact") { "" } else { how };
    let name = format!("{joint} passes energy from {from} to {body}{how}: ");
    Done { name, body, ..done }
}

/// The body that something acts on.
fn called(study: &Study, one: &Contribution) -> String {
    one.body.map_or_else(|| MOTION.to_owned(), |body| symbols::the(&study.model.bodies[body].name))
}

/// Works of one name are one, and so are their errors.
fn add(all: &mut Vec<Done>, done: &Done) {
    match all.iter_mut().find(|same| same.name == done.name && same.body == done.body) {
        Some(same) => {
            same.work += done.work;
            same.error = same.error.zip(done.error).map(|(a, b)| a + b);
        }
        None => all.push(Done { name: done.name.clone(), body: done.body.clone(), ..*done }),
    }
}

/// `the normal force in impacts on the floor`, `friction on the floor`; other loads by their own name.
fn name_of(study: &Study, one: &Contribution) -> String {
    let touched = one.load.split('.').next().unwrap_or_default();
    let is_surface = study.model.surfaces.iter().any(|surface| surface.name == touched);
    // Contacts of bodies with each other are no place.
    let on = if is_surface { format!(" on {}", symbols::the(touched)) } else { String::new() };
    match (one.law, one.kind) {
        (Some(Law::Friction), ContributionKind::Impact) => format!("friction in impacts{on}"),
        (Some(Law::Friction), _) => format!("friction{on}"),
        (Some(Law::Rolling), _) => format!("rolling resistance{on}"),
        (Some(Law::Contact), ContributionKind::Impact) => format!("the normal force in impacts{on}"),
        (Some(Law::Contact), _) => symbols::the(touched),
        _ => symbols::holder(study, &one.load).unwrap_or_else(|| symbols::the(&one.load)),
    }
}
