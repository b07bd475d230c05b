//! Tapes of rows and pairs at one instant: what impacts, lasting contacts and corrections are found from.

use std::collections::HashMap;
use std::sync::Arc;

use tumble_expr::{Binary, Expr, Layout, NodeId, Rounding, Tape, Unary};
use tumble_ode::Reason;

use super::algebra::{Algebra, Nodes};
use super::linking::Linking;
use super::names::Name;
use super::part::{Part, RowOf};
use crate::cache::Cache;
use crate::equations::Equations;
use crate::mode::Mode;

/// Tapes by what they are of, mode and how numbers are rounded.
pub(crate) type InstantTapes = Cache<((Asked, Mode), Rounding), InstantTape>;

/// What a tape is of.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Asked {
    /// The pairs of an island, by its bodies.
    Island(Vec<usize>),
    /// The gaps of all bodies that meet each other.
    Gaps,
    /// These rows.
    Rows(Vec<RowOf>),
}

/// A tape with where the numbers stand among its outputs.
#[derive(Clone, Debug)]
pub(crate) struct InstantTape {
    pub(crate) tape: Arc<Tape>,
    /// Behind each of these stand the gap's acceleration, the restitution, the force if a compliant surface exerts one, and what must not be
    /// negative while they touch.
    pub(crate) pairs: Vec<Measured>,
    /// Of those with friction, by their order among the pairs, the rate along the surface; behind each of these stand its derivative
    /// and both coefficients.
    pub(crate) slips: Vec<Slipping>,
    pub(crate) rows: Vec<Measured>,
    /// Where numbers of bodies begin.
    pub(crate) bodies: usize,
    /// What unit forces do, where loads read any.
    pub(crate) pushes: Option<Pushes>,
}

/// Where the numbers stand of what unit forces at pairs, then along surfaces, do to the acceleration of each, row by row.
#[derive(Clone, Debug)]
pub(crate) struct Pushes {
    first: usize,
    /// How many there are in a row.
    columns: usize,
    /// Those that are asked about.
    of: Vec<usize>,
}

impl Pushes {
    /// The same where some are asked about.
    pub(crate) fn only(&self, of: Vec<usize>) -> Self {
        Self { of, ..self.clone() }
    }

    /// How many are asked about.
    pub(crate) fn count(&self) -> usize {
        self.of.len()
    }

    /// Where the number of a row and column stands.
    pub(crate) fn place(&self, row: usize, column: usize) -> usize {
        self.first + self.of[row] * self.columns + self.of[column]
    }
}

/// What rubs where a pair touches: its friction, or its resistance against rolling.
#[derive(Clone, Debug)]
pub(crate) struct Slipping {
    /// Order of the pair among those of the tape.
    pub(crate) position: usize,
    /// Index of the pair, or of what stands for its rolling resistance.
    pub(crate) pair: usize,
    pub(crate) row: Measured,
}

/// Where the numbers of a row stand: its position if it has one, its rate, the slopes of that by velocities.
#[derive(Clone, Debug)]
pub(crate) struct Measured {
    pub(crate) position: usize,
    /// Velocities that the rate depends on, by their order among those that are asked about.
    velocities: Vec<usize>,
}

impl Measured {
    pub(crate) fn rate(&self) -> usize {
        self.position + 1
    }

    /// Velocities, each with where the slope by it stands.
    pub(crate) fn slopes(&self) -> impl Iterator<Item = (usize, usize)> {
        self.velocities.iter().copied().zip(self.position + 2..)
    }

    /// Where the next number stands.
    pub(crate) fn end(&self) -> usize {
        self.position + 2 + self.velocities.len()
    }
}

impl InstantTape {
    /// The same with numbers rounded in another way.
    fn rounded(&self, rounding: Rounding) -> Self {
        Self { tape: Arc::new(self.tape.rounded(rounding)), ..self.clone() }
    }
}

impl Equations {
    /// That of the pairs of an island and the joints that hold it. By velocity it has the change by a unit of impulse, the sum of the
    /// sizes of all forces, lasting contacts left out, then the largest extent of a body, then masses where there are joints.
    pub(crate) fn island_tape(
        &self,
        island: &[usize],
        mode: &Mode,
        pairs: &[usize],
    ) -> Result<Arc<InstantTape>, Reason> {
        if let Some(twin) = self.twin(mode) {
            let its: Vec<usize> = pairs.iter().map(|pair| twin.pair(*pair)).collect();
            let island: Vec<usize> = island.iter().map(|body| twin.body(*body)).collect();
            let tape = self.island_tape(&island, &twin.mode(mode), &its)?;
            return Ok(Arc::new(InstantTape {
                slips: self.own_slips(&tape.slips, pairs),
                ..(*tape).clone()
            }));
        }
        let asked = Asked::Island(island.to_vec());
        self.instant_tape((asked, mode.without_support(self.pairs(), island)), |mode| {
            let mut instant = Instant::new(self, mode, island);
            let contacts: Vec<RowOf> = pairs.iter().map(|pair| RowOf::Pair(*pair)).collect();
            let rough = pairs.iter().copied().enumerate();
            let rough = rough.filter(|(_, pair)| self.pairs()[*pair].friction.is_some());
            let pairs = pairs.iter().map(|pair| instant.pair(*pair)).collect();
            let rough = rough
                .flat_map(|(position, pair)| self.pair_list().rubbing(pair).map(move |own| (position, own)));
            let slips: Vec<Slipping> = rough
                .map(|(position, own)| Slipping { position, pair: own, row: instant.slip(own) })
                .collect();
            let rows = self.independent_rows_of(mode, island).into_iter();
            let rows: Vec<Measured> = rows.map(|(_, row)| instant.row(row)).collect();
            let bodies = instant.outputs.len();
            instant.add_bodies(island, !rows.is_empty());
            let pushes = instant.pushes(island, &contacts, &slips);
            Ok(InstantTape { tape: instant.tape()?, pairs, slips, rows, bodies, pushes })
        })
    }

    /// What rubs of some pairs, where these are called otherwise.
    fn own_slips(&self, slips: &[Slipping], pairs: &[usize]) -> Vec<Slipping> {
        let list = self.pair_list();
        let own = |slip: &Slipping| {
            let pair = pairs[slip.position];
            let pair = if list.owner.contains_key(&slip.pair) { list.rolling[&pair] } else { pair };
            Slipping { pair, ..slip.clone() }
        };
        slips.iter().map(own).collect()
    }

    /// That of the gaps of pairs of bodies: all there are among those of a mode.
    pub(crate) fn gaps_tape(&self, mode: &Mode, pairs: &[usize]) -> Result<Arc<InstantTape>, Reason> {
        if let Some(twin) = self.twin(mode) {
            let pairs: Vec<usize> = pairs.iter().map(|pair| twin.pair(*pair)).collect();
            return self.gaps_tape(&twin.mode(mode), &pairs);
        }
        let mode = mode.without_support(self.pairs(), &mode.bodies);
        self.instant_tape((Asked::Gaps, mode), |mode| {
            let mut instant = Instant::new(self, mode, &[]);
            let pairs = pairs.iter().map(|pair| instant.row(RowOf::Pair(*pair))).collect();
            Ok(InstantTape {
                tape: instant.tape()?,
                pairs,
                slips: vec![],
                rows: vec![],
                bodies: 0,
                pushes: None,
            })
        })
    }

    /// That of some rows in a mode, with the masses by velocity of all its bodies.
    pub(crate) fn rows_tape(&self, mode: &Mode, rows: Vec<RowOf>) -> Result<Arc<InstantTape>, Reason> {
        self.instant_tape((Asked::Rows(rows.clone()), mode.clone()), |mode| {
            let mut instant = Instant::new(self, mode, &mode.bodies);
            let rows = rows.into_iter().map(|row| instant.row(row)).collect();
            let bodies = instant.outputs.len();
            mode.bodies.iter().for_each(|body| instant.add_masses(*body));
            Ok(InstantTape {
                tape: instant.tape()?,
                pairs: vec![],
                slips: vec![],
                rows,
                bodies,
                pushes: None,
            })
        })
    }

    fn instant_tape(
        &self,
        key: (Asked, Mode),
        build: impl FnOnce(&Mode) -> Result<InstantTape, Reason>,
    ) -> Result<Arc<InstantTape>, Reason> {
        let tapes = &self.built().instant_tapes;
        tapes.get_rounded(key, self.rounding(), |(_, mode)| build(mode), InstantTape::rounded)
    }
}

/// A tape being put together.
struct Instant<'a> {
    linking: Linking<'a, Nodes>,
    layout: Layout,
    /// Velocities that are asked about, with their order.
    velocities: HashMap<Name, usize>,
    outputs: Vec<NodeId>,
}

impl<'a> Instant<'a> {
    fn new(equations: &'a Equations, mode: &'a Mode, bodies: &[usize]) -> Self {
        let linking = Linking::new(equations, mode, Nodes::default());
        let layout = Layout { rounding: Rounding::NEAREST, ..equations.layout(mode) };
        let velocities = equations.velocities_of(mode, bodies).into_iter();
        let names = velocities.map(|state| linking.names.find(&layout.states[state]));
        let velocities = names.zip(0..).filter_map(|(name, place)| Some((name?, place))).collect();
        Self { linking, layout, velocities, outputs: vec![] }
    }

    fn tape(self) -> Result<Arc<Tape>, Reason> {
        Ok(Arc::new(self.linking.into_algebra().linker()?.tape(&self.layout, &self.outputs)?))
    }

    fn row(&mut self, row: RowOf) -> Measured {
        let piece = self.linking.equations.piece(Part::Kept(row));
        let mut values = self.linking.exports(&piece).into_iter();
        let position = self.outputs.len();
        if piece.kept.len() == 1 {
            // A slip has no position: nothing stands there.
            self.outputs.push(self.linking.formula(&Expr::zero()));
        }
        let mut by_velocity = vec![];
        for (_, states) in &piece.kept {
            // The slopes of the position come first, those of the rate take their place.
            self.outputs.extend(values.next());
            let slopes = states.iter().zip(values.by_ref().take(states.len()));
            by_velocity =
                slopes.filter_map(|(state, slope)| Some((*self.velocities.get(state)?, slope))).collect();
        }
        by_velocity.sort_unstable_by_key(|(velocity, _)| *velocity);
        let (velocities, slopes): (Vec<usize>, Vec<NodeId>) = by_velocity.into_iter().unzip();
        self.outputs.extend(slopes);
        Measured { position, velocities }
    }

    fn pair(&mut self, index: usize) -> Measured {
        let measured = self.row(RowOf::Pair(index));
        self.add(Part::RowAcceleration(RowOf::Pair(index)));
        let restitution = self.linking.equations.pairs()[index].law.restitution();
        let restitution = restitution.cloned().unwrap_or_else(Expr::zero);
        self.outputs.push(self.linking.formula(&restitution));
        match self.linking.mode.is_pressed(index) {
            true => self.add(Part::Pressed(index)),
            false => self.outputs.push(self.linking.formula(&Expr::zero())),
        }
        self.add(Part::Holding(index));
        measured
    }

    fn slip(&mut self, index: usize) -> Measured {
        let measured = self.row(RowOf::Slip(index));
        self.add(Part::RowAcceleration(RowOf::Slip(index)));
        let friction = self.linking.equations.pairs()[index].friction.clone();
        for coefficient in friction.iter().flat_map(|friction| [&friction.of_rest, &friction.kinetic]) {
            let coefficient = self.linking.formula(coefficient);
            self.outputs.push(coefficient);
        }
        measured
    }

    fn pushes(&mut self, island: &[usize], pairs: &[RowOf], slips: &[Slipping]) -> Option<Pushes> {
        let along = slips.iter().map(|slip| RowOf::Slip(slip.pair));
        let contacts: Vec<RowOf> = pairs.iter().copied().chain(along).collect();
        let (first, columns) = (self.outputs.len(), contacts.len());
        let numbers = self.linking.pushes_of(island, &contacts)?;
        self.outputs.extend(numbers);
        Some(Pushes { first, columns, of: (0..columns).collect() })
    }

    fn add(&mut self, part: Part) {
        self.outputs.extend(self.linking.part(part));
    }

    fn add_bodies(&mut self, island: &[usize], with_masses: bool) {
        island.iter().for_each(|body| self.add(Part::InverseMasses(*body)));
        for body in island {
            let pushes = self.linking.pushes(*body);
            self.outputs.extend(pushes);
        }
        let size = self.linking.size(island);
        self.outputs.extend(size);
        if with_masses {
            island.iter().for_each(|body| self.add_masses(*body));
        }
    }

    fn add_masses(&mut self, body: usize) {
        self.add(Part::Masses(body, self.linking.islands.is_light(body)));
    }
}

impl Linking<'_, Nodes> {
    /// Sizes of all forces and torques on a body, added up without signs: one for each velocity.
    fn pushes(&mut self, body: usize) -> Vec<NodeId> {
        let mut sums = [(); 3].map(|()| self.algebra.zero());
        for term in self.terms_on(body) {
            for (sum, part) in sums.iter_mut().zip(self.part(Part::Term(term))) {
                let size = self.algebra.unary(Unary::Abs, part);
                *sum = self.algebra.binary(Binary::Add, *sum, size);
            }
        }
        // A pivot holds the place: only the torque is left.
        sums[if self.equations.is_pivoted(body) { 2 } else { 0 }..].to_vec()
    }
}
