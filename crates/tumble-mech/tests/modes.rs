//! A mode that was linked of its parts moves as one whose formulas were put together and compiled as one.

use crate::common::chain;
use crate::common::{bouncing_rod, close, rigid, spring, wind_pendulum};
use chain::chain;
use tumble_expr::Expr;
use tumble_expr::units::{M, S};
use tumble_mech::{Action, ContactLaw, Equations, Event, Gravity, Mode, Model, Record, Start, Surface};
use tumble_ode::{Accuracy, Crossing, Direction, Flow, Hybrid, Jump, Motion, Reason, solve};

/// What a second of a motion of unstable bodies may make of last bits.
const ROUNDING: f64 = 1e-12;

/// The same equations, each mode compiled as one.
struct AsOne<'a>(&'a Equations);

impl Hybrid for AsOne<'_> {
    type Mode = Mode;
    type Record = Record;

    fn flow(&self, mode: &Mode) -> Result<Flow, Reason> {
        self.0.flow(mode)
    }

    fn jump(&self, at: &Crossing<'_, Mode>) -> Result<Jump<Mode, Record>, Reason> {
        self.0.jump(at)
    }
}

fn moved<H: Hybrid<Mode = Mode>>(system: &H, equations: &Equations, until: f64) -> Motion<H> {
    let start = equations.start(&equations.model().parameters).expect("a start");
    let moved = solve(system, start, until, Accuracy::new(1e-9).expect("allowed"));
    moved.map_err(|stopped| stopped.refusal.reason.to_string()).expect("a motion")
}

/// All events and pieces, but for the last bits: a product of series is summed from its first factor on, and which factor that is
/// depends on which was there first.
#[track_caller]
fn is_the_same(model: Model, until: f64, modes: usize) {
    let equations = Equations::new(model).expect("a model");
    let (linked, as_one) =
        (moved(&equations, &equations, until), moved(&AsOne(&equations), &equations, until));
    assert_eq!(linked.modes, as_one.modes);
    assert_eq!(linked.modes.len(), modes, "{:?}", linked.modes);
    assert_eq!(linked.events.len(), as_one.events.len());
    for (a, b) in linked.pieces.iter().zip(&as_one.pieces) {
        assert_eq!(a.mode, b.mode);
        close(a.end, b.end, ROUNDING);
        let ends = [a, b].map(|piece| piece.states_at_parameter(piece.length));
        assert_eq!(ends[0].len(), ends[1].len());
        ends[0].iter().zip(&ends[1]).for_each(|(a, b)| close(*a, *b, ROUNDING));
    }
    assert_eq!(linked.pieces.len(), as_one.pieces.len());
}

/// Rods that differ, held out flat above a floor.
fn flat_chain(links: usize, height: f64, law: ContactLaw) -> Model {
    let flat = std::iter::repeat_n(std::f64::consts::FRAC_PI_2, links);
    let (mut model, _) = chain(flat, |index| 1 + index as i32);
    model.surface(Surface::floor("floor", -height * M, law));
    model
}

#[test]
fn a_free_body_on_floors() {
    is_the_same(bouncing_rod(rigid(0.5)), 1.0, 1);
    is_the_same(bouncing_rod(spring()), 2.0, 3);
}

#[test]
fn a_body_that_slides_on_its_end() {
    let mut model = bouncing_rod(rigid(0.0));
    model.starts.clear();
    let start = Start::default().at([0 * M, 0.5 * M]).angle(Expr::from(0.6));
    model.starts.push(("rod".into(), start));
    is_the_same(model, 0.6, 3);
}

#[test]
fn a_pivot_in_the_wind() {
    is_the_same(wind_pendulum(2.0), 2.0, 1);
}

#[test]
fn a_chain_that_meets_the_floor_and_loses_a_joint() {
    let mut model = flat_chain(4, 1.2, rigid(0.0));
    let last = model.joints.pop().expect("four");
    model.joints.push(last.until("snap"));
    model.events.push(Event {
        name: "snap".into(),
        when: tumble_mech::time() - 0.3 * S,
        direction: Direction::Rising,
        action: Action::Record,
    });
    let equations = Equations::new(model.clone()).expect("a model");
    let modes = moved(&equations, &equations, 0.5).modes;
    assert!(modes.iter().any(|mode| !mode.switched.is_empty()), "a joint lets go: {modes:?}");
    assert!(modes.iter().any(|mode| !mode.contacts.is_empty()), "a link touches: {modes:?}");
    is_the_same(model, 0.5, modes.len());
}

#[test]
fn parameters_that_events_change() {
    let mut model = flat_chain(2, 9.0, rigid(0.5));
    let gravity = 9.81 * M / (S * S);
    let gravity = model.parameters.set("g", gravity).expect("a name");
    model.gravity = Gravity::Vertical(gravity.clone());
    model.events.push(Event {
        name: "change".into(),
        when: tumble_mech::time() - 0.2 * S,
        direction: Direction::Rising,
        action: Action::Set(vec![("g".into(), gravity / 3)]),
    });
    is_the_same(model, 0.5, 2);
}
