//! Scales of lengths and forces that fill the panels.

use super::arrow::Velocity;
use super::body::FreeBodyDiagram;
use super::layout::{Scales, about_centre, body_size};
use super::strokes::LEAST_LENGTH;

/// Parts of the panel that a body may fill, largest first.
const BODY_PARTS: [f64; 16] =
    [0.9, 0.8, 0.72, 0.66, 0.6, 0.55, 0.5, 0.45, 0.4, 0.35, 0.3, 0.25, 0.2, 0.12, 0.06, 0.01];
/// Part of the panel at which a body is large enough.
const GOOD_BODY: f64 = 0.62;
/// Length of the longest arrow as a part of the panel's smaller side.
const GOOD_ARROW: f64 = 0.58;
/// Arrows shorter than this in pixels cannot be compared; a smaller body is the lesser evil.
const SHORT_ARROW: f64 = 2.0 * LEAST_LENGTH;
/// Bisections of the longest arrow: to a thousandth.
const BISECTIONS: usize = 10;
/// Bodies without size are drawn at any scale, in pixels per metre.
const ANY_DENSITY: f64 = 100.0;
/// Sizes in metres outside of these would lose digits in divisions.
const SIZES: std::ops::Range<f64> = 1e-290..1e290;

/// A body and the room for it on the page, width and height in pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Room<'a> {
    pub(super) body: &'a FreeBodyDiagram,
    pub(super) size: [f64; 2],
}

/// Scales common to some bodies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fit {
    pub(super) density: f64,
    /// Length of the longest arrow of each unit in pixels.
    pub(super) arrow: f64,
    /// How large bodies and arrows are compared with good sizes, 0 to 1.
    pub(super) quality: f64,
    /// The part of the room that is used, in the panel that needs most.
    pub(super) used: f64,
}

/// The best common scales of lengths and forces.
pub(super) fn fit(rooms: &[Room<'_>]) -> Fit {
    let full = full_density(rooms);
    let fits = BODY_PARTS.iter().map(|part| {
        let density = full.map_or(ANY_DENSITY, |full| part * full);
        let (arrow, good) = (longest_arrow(rooms, density), good_arrow(rooms));
        let short = (arrow / SHORT_ARROW).min(1.0);
        let quality = (part / GOOD_BODY).min(1.0) * (arrow / good).min(1.0) * short;
        Fit { density, arrow, quality, used: 1.0 }
    });
    let better = |best: Fit, fit: Fit| if fit.quality > best.quality { fit } else { best };
    let none = Fit { density: ANY_DENSITY, arrow: 0.0, quality: 0.0, used: 1.0 };
    let best = fits.reduce(better).unwrap_or(none);
    Fit { used: used(rooms, &best), ..best }
}

/// The greatest parts of width and height that are used, multiplied.
fn used(rooms: &[Room<'_>], fit: &Fit) -> f64 {
    let parts = rooms.iter().map(|room| {
        let taken = about_centre(room.body, &scales(rooms, room.body, fit.density, fit.arrow));
        [taken.width / room.size[0], taken.height / room.size[1]]
    });
    let [width, height] = parts.fold([0.0_f64; 2], |most, part| [0, 1].map(|k| most[k].max(part[k])));
    width * height
}

/// Pixels per metre at which the largest body just fills its panel; `None` if no body has a size.
fn full_density(rooms: &[Room<'_>]) -> Option<f64> {
    let ratios = rooms.iter().flat_map(|room| {
        let size = body_size(room.body);
        [room.size[0] / size[0], room.size[1] / size[1]].into_iter().zip(size)
    });
    let usable = ratios.filter(|(_, size)| SIZES.contains(size)).map(|(ratio, _)| ratio);
    usable.reduce(f64::min)
}

fn good_arrow(rooms: &[Room<'_>]) -> f64 {
    let sides = rooms.iter().map(|room| room.size[0].min(room.size[1]));
    GOOD_ARROW * sides.fold(f64::INFINITY, f64::min).min(1e3)
}

/// The longest arrow in pixels at which everything fits, at most a good one.
pub(super) fn longest_arrow(rooms: &[Room<'_>], density: f64) -> f64 {
    let fits = |arrow: f64| {
        rooms.iter().all(|room| {
            let taken = about_centre(room.body, &scales(rooms, room.body, density, arrow));
            taken.width <= room.size[0] && taken.height <= room.size[1]
        })
    };
    let (mut low, mut high) = (0.0, good_arrow(rooms));
    if fits(high) {
        return high;
    }
    if !fits(low) {
        return 0.0;
    }
    for _ in 0..BISECTIONS {
        let middle = f64::midpoint(low, high);
        if fits(middle) { low = middle } else { high = middle }
    }
    low
}

/// The scales of one body if the longest arrow of its unit among `rooms` is `arrow` pixels long.
pub(super) fn scales(rooms: &[Room<'_>], body: &FreeBodyDiagram, density: f64, arrow: f64) -> Scales {
    let same_unit = rooms.iter().filter(|room| room.body.unit == body.unit);
    let forces = same_unit.flat_map(|room| room.body.forces.iter().chain(&room.body.resultant));
    let largest = forces.map(|force| force.magnitude()).fold(0.0, f64::max);
    let speeds = rooms.iter().flat_map(|room| &room.body.velocities).map(Velocity::speed);
    Scales { density, arrow, largest, fastest: speeds.fold(0.0, f64::max) }
}
