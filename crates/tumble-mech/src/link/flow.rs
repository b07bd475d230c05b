//! The flow of a mode, put together.

use std::collections::HashMap;

use tumble_expr::{Binary, Expr, Symbol, Unary};
use tumble_ode::{AtZero, Direction, Flow, Guard, Invariant, LazyGuard, ScaleGroup, StateVariable};

use super::algebra::Algebra;
use super::island::Without;
use super::linking::Linking;
use super::names::Name;
use super::part::{Part, Pusher, RowOf};
use crate::contact::{Pair, WEDGED, Watched};
use crate::coordinates::Measure;
use crate::event::Event;
use crate::laws::compliant::{resistance, time_transformation};
use crate::parameters::time_symbol;

impl<A: Algebra> Linking<'_, A> {
    /// All that the integrator asks for.
    pub(crate) fn flow(&mut self) -> Flow<A::Value> {
        let (equations, mode) = (self.equations, self.mode);
        let rates = equations.state_rates(mode);
        let places =
            rates.iter().zip(0..).filter_map(|(state, place)| Some((self.names.find(&state.symbol)?, place)));
        let places: HashMap<Name, usize> = places.collect();
        let states = rates.into_iter().map(|state| StateVariable {
            rate: self.formula(&state.rate),
            symbol: state.symbol,
            group: state.measure as usize,
            per_parameter: state.per_parameter,
        });
        let states = states.collect();
        let schedule = self.formulas(&equations.scheduled_times(mode));
        let time_transformation = self.time_transformation();
        Flow {
            states,
            time: time_symbol(),
            inputs: equations.model().parameters.symbols(),
            rounding: equations.rounding(),
            groups: self.groups(),
            schedule,
            guards: self.guards(),
            lazy_guards: self.lazy_guards(),
            invariants: self.invariants(&places),
            time_transformation,
        }
    }

    /// The rate dt/ds is a pure number; the unit of the roots goes into the pieces' own parameter.
    pub(super) fn time_transformation(&mut self) -> Option<A::Value> {
        let roots = self.equations.roots(self.mode).into_iter();
        let roots = roots.map(|pair| Expr::from(self.equations.pairs()[pair].root_symbol()));
        time_transformation(roots).map(|rate| self.formula(&rate))
    }

    /// What each kind of state is measured against; the order is [`Measure`]'s.
    fn groups(&mut self) -> Vec<ScaleGroup<A::Value>> {
        let zero = self.algebra.zero();
        let size = self.size(&self.mode.bodies).unwrap_or_else(|| zero.clone());
        let one = self.formula(&Expr::one());
        let group = |name: &str, floor: &A::Value, per_run| ScaleGroup {
            name: name.to_owned(),
            floor: floor.clone(),
            per_run,
        };
        vec![
            group("length", &size, false),
            group("angle", &one, false),
            group("speed", &size, true),
            group("angular rate", &one, true),
            group("root of a depth", &zero, false),
            group("force", &zero, false),
            group("torque", &zero, false),
        ]
    }

    /// The largest length that places of some bodies are measured against.
    pub(super) fn size(&mut self, bodies: &[usize]) -> Option<A::Value> {
        bodies.iter().fold(None, |far, body| {
            let own = self.part(Part::Size(*body)).remove(0);
            Some(match far {
                None => own,
                Some(far) => self.algebra.binary(Binary::Max, far, own),
            })
        })
    }

    /// Guards of events, then of the pairs that touch.
    fn guards(&mut self) -> Vec<Guard<A::Value>> {
        let equations = self.equations;
        let events = equations.events(self.mode).into_iter().map(|event| &equations.model().events[event]);
        let watched: Vec<Expr> = events.clone().map(|event| event.when.clone()).collect();
        let guard = |(event, formula): (&Event, A::Value)| Guard {
            name: event.name.clone(),
            formula,
            direction: event.direction,
            at_zero: AtZero::Begins,
        };
        let mut guards: Vec<_> = events.zip(self.formulas(&watched)).map(guard).collect();
        for (pair, watched, direction) in equations.touching(self.mode) {
            guards.push(self.touching_guard(pair, watched, direction));
        }
        for (brake, watched, direction) in equations.watched_brakes(self.mode) {
            guards.push(self.brake_guard(brake, watched, direction));
        }
        for (name, formula) in self.too_much_feedback().into_iter().chain(self.too_steep()) {
            let (direction, at_zero) = (Direction::Falling, AtZero::Ends);
            guards.push(Guard { name, formula, direction, at_zero });
        }
        guards
    }

    fn brake_guard(&mut self, index: usize, watched: Watched, direction: Direction) -> Guard<A::Value> {
        let brake = &self.equations.brakes()[index];
        let formula = self.formula(&brake.watched(watched));
        let at_zero = match watched {
            Watched::Cone(_) => AtZero::EndsIfItMoves {
                response: self.part(Part::Lightness(brake.bodies[0])).remove(0),
                group: Measure::Length as usize,
                again: false,
            },
            _ => AtZero::Begins,
        };
        Guard { name: brake.guard_name(watched), formula, direction, at_zero }
    }

    fn touching_guard(&mut self, index: usize, watched: Watched, direction: Direction) -> Guard<A::Value> {
        let pair = &self.equations.pairs()[index];
        let formula = match watched {
            // The gap and the root of the depth vanish together; the root does so with a slope.
            Watched::Gap if pair.is_hertzian() && self.mode.is_pressed(index) => {
                let root = self.algebra.leaf(&pair.root_symbol());
                self.algebra.unary(Unary::Neg, root)
            }
            Watched::Gap => self.part(Part::Gap(index)).remove(0),
            Watched::Shallow => self.formula(&pair.shallow()),
            Watched::Depth | Watched::Out => {
                let slight = pair.slight_within(self.mode.contact_mode(index));
                let (gap, slight) = (self.part(Part::Gap(index)).remove(0), self.formula(&slight));
                let of = if watched == Watched::Depth { Binary::Add } else { Binary::Sub };
                self.algebra.binary(of, gap, slight)
            }
            // The root of the depth is no state of what is let go.
            Watched::Force if pair.is_hertzian() => {
                let [elastic, damped] = resistance(pair);
                self.formula(&(elastic + damped))
            }
            Watched::Force => self.part(Part::Pressed(index)).remove(0),
            Watched::Normal => self.symbol(&pair.force_symbol()),
            Watched::Slip => self.part(Part::Slip(index)).remove(0),
            Watched::Cone(way) => {
                let left = self.equations.friction_left(self.mode, index, way);
                self.formula(&left)
            }
            Watched::Wedge => self.wedge(index),
            Watched::Limit(limit) => self.part(Part::Leaving(index)).swap_remove(limit),
        };
        let at_zero = match watched {
            // A surface does not pull, not for a moment.
            Watched::Normal | Watched::Cone(_) => AtZero::EndsIfItMoves {
                response: self.lightness(pair),
                group: Measure::Length as usize,
                again: watched == Watched::Normal,
            },
            Watched::Gap | Watched::Depth | Watched::Out | Watched::Shallow | Watched::Force => {
                AtZero::Begins
            }
            // Friction acts against the slip.
            Watched::Slip => AtZero::Keeps { group: Measure::Speed as usize },
            Watched::Wedge => AtZero::Ends,
            Watched::Limit(_) => AtZero::EndsBeyond { group: Measure::Length as usize },
        };
        Guard { name: pair.guard_name(watched), formula, direction, at_zero }
    }

    /// What a unit of force does to the bodies of a pair, 1/kg.
    fn lightness(&mut self, pair: &Pair) -> A::Value {
        let own = self.part(Part::Lightness(pair.body)).remove(0);
        let Some(other) = pair.other else { return own };
        let other = self.part(Part::Lightness(other)).remove(0);
        self.algebra.binary(Binary::Add, own, other)
    }

    /// How much a push moves a contact that slips beyond the part of it that is [`WEDGED`], 1/kg.
    fn wedge(&mut self, pair: usize) -> A::Value {
        if !self.equations.is_alone(self.mode, pair) {
            return self.wedge_among(pair);
        }
        let row = RowOf::Pair(pair);
        let own = self.part(Part::Response(row, Pusher::Row(row))).remove(0);
        let most = self.formula(&Expr::from(1.0 - WEDGED));
        let own = self.algebra.binary(Binary::Mul, most, own);
        self.with_friction(own, row, Without::Nothing, |slip| (Part::Response(row, slip), 0))
    }

    /// The same where others hold its bodies too.
    fn wedge_among(&mut self, pair: usize) -> A::Value {
        let [left, own] =
            [Without::Nothing, Without::Friction(pair)].map(|without| self.yielding(pair, without));
        let least = self.formula(&Expr::from(WEDGED));
        let least = self.algebra.binary(Binary::Mul, least, own);
        self.algebra.binary(Binary::Sub, left, least)
    }

    fn symbol(&mut self, symbol: &Symbol) -> A::Value {
        self.formula(&symbol.clone().into())
    }

    /// Gaps of the pairs that are apart.
    fn lazy_guards(&mut self) -> Vec<LazyGuard<A::Value>> {
        let (equations, mode) = (self.equations, self.mode);
        let mut guards = vec![];
        for index in equations.apart(mode) {
            let pair = &equations.pairs()[index];
            let slopes = self.part(Part::Slopes(index));
            let coordinates = pair.bodies().flat_map(|body| equations.coordinate_states(mode, body));
            let by_state = coordinates.zip(slopes.iter().cloned());
            let reach = pair.slopes_reach().filter(|_| !slopes.is_empty());
            let reach = reach.map(|reach| self.formula(reach));
            guards.push(LazyGuard {
                name: pair.guard_name(Watched::Gap),
                of: equations.watched_gap(index, &mode.changes),
                direction: Direction::Falling,
                at_zero: match pair.has_edge() || !pair.limits.is_empty() {
                    true => AtZero::EndsBeyond { group: Measure::Length as usize },
                    false => AtZero::Ends,
                },
                group: Measure::Length as usize,
                slopes: (!slopes.is_empty()).then(|| by_state.collect()),
                reach,
            });
        }
        guards
    }

    /// What is zero all along the mode: of rows, then of the roots of depths.
    fn invariants(&mut self, places: &HashMap<Name, usize>) -> Vec<Invariant<A::Value>> {
        let (equations, mode) = (self.equations, self.mode);
        let joints = equations.rows_by_joint(mode).into_iter();
        let rows = joints.filter(|(index, _)| !mode.redundant.contains(index)).map(|(_, row)| row);
        let contacts = mode.held().map(RowOf::Pair).chain(mode.sticking().map(RowOf::Slip));
        let braked = mode.braked().map(RowOf::Brake);
        let rows = rows.chain(contacts).chain(braked).map(Part::Kept);
        let parts: Vec<Part> = rows.chain(equations.roots(mode).into_iter().map(Part::Root)).collect();
        let mut invariants = vec![];
        for part in parts {
            let piece = equations.piece(part);
            let mut values = self.exports(&piece).into_iter();
            for (measure, states) in &piece.kept {
                let Some(formula) = values.next() else { break };
                let slopes = values.by_ref().take(states.len());
                let slopes =
                    states.iter().zip(slopes).filter_map(|(state, slope)| Some((*places.get(state)?, slope)));
                let mut slopes: Vec<(usize, A::Value)> = slopes.collect();
                slopes.sort_unstable_by_key(|(state, _)| *state);
                invariants.push(Invariant { formula, slopes, group: *measure as usize, follows: false });
            }
        }
        invariants.extend(self.algebraic_invariants(places));
        invariants
    }
}
