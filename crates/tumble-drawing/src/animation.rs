//! Motions that play in the page.

use crate::curves::Mark;
use crate::free_body::{ArrowKind, Ground, NamedPoint};
use crate::outline::{Outline, Pose};
use crate::scale::drawable;
use crate::scene_drawing::LinkKind;
use crate::text::Label;

/// A motion in one or several cases.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Animation {
    /// Title; may be empty.
    pub title: Label,
    /// What happens, for those who cannot see it; if empty, start and end are listed.
    pub description: String,
    /// The cases, in the order of the report.
    pub cases: Vec<MovingCase>,
    /// Seconds of motion for a second of the reader's, at first; 0 chooses so that it takes some seconds.
    pub speed: f64,
}

/// The motion in one case.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MovingCase {
    /// What sets the case apart; may be empty if there is one only.
    pub name: Label,
    /// Names of what sets it apart, with their values.
    pub values: Vec<(String, f64)>,
    /// Instants in seconds, never decreasing. The places below belong to
    /// them one by one; what lacks at the end stays as it was.
    pub times: Vec<f64>,
    /// The bodies, in drawing order.
    pub bodies: Vec<MovingBody>,
    /// Springs, dampers and threads.
    pub links: Vec<MovingLink>,
    /// Forces, shown on request.
    pub forces: Vec<MovingForce>,
    /// Half-planes of material that stay where they are.
    pub surfaces: Vec<Ground>,
    /// Points that stay where they are, such as pivots.
    pub points: Vec<NamedPoint>,
    /// Instants with names, in seconds.
    pub events: Vec<Mark>,
}

/// A body with its poses.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MovingBody {
    /// Its name.
    pub name: Label,
    /// Its outlines about the centre of mass, metres.
    pub outlines: Vec<Outline>,
    /// Its pose at every instant; the times in them are not used.
    pub poses: Vec<Pose>,
    /// Whether its centre leaves a trail.
    pub trail: bool,
}

/// Something between two points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MovingLink {
    /// Its name.
    pub name: Label,
    /// Its looks.
    pub kind: LinkKind,
    /// Its ends in world coordinates (metres) at every instant; not finite where it is not there.
    pub ends: Vec<[[f64; 2]; 2]>,
}

/// A force with its points of action.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MovingForce {
    /// What kind of force it is.
    pub kind: ArrowKind,
    /// Its symbol.
    pub symbol: Label,
    /// Point of action (world, metres) and force (N) at every instant; not finite or zero where it does not act.
    pub samples: Vec<[[f64; 2]; 2]>,
}

impl MovingCase {
    /// First and last instant, s.
    pub fn span(&self) -> [f64; 2] {
        [self.times.first(), self.times.last()].map(|time| time.copied().unwrap_or(0.0))
    }

    /// Left, lower, right and upper bound of all that moves and of the points, in metres; `None` if there is nothing.
    pub fn extent(&self) -> Option<[f64; 4]> {
        let bodies = self.bodies.iter().flat_map(|body| {
            body.poses.iter().filter(|pose| pose.is_drawable()).flat_map(|pose| {
                body.outlines.iter().flat_map(|outline| outline.extent(pose)).chain([pose.centre()])
            })
        });
        let links = self.links.iter().flat_map(|link| link.ends.iter().flatten().copied());
        let points = self.points.iter().map(|point| point.at);
        let all = bodies.chain(links).chain(points);
        let mut all = all.filter(|p| drawable(p[0]) && drawable(p[1])).map(|[x, y]| [x, y, x, y]);
        let first = all.next()?;
        Some(all.fold(first, |[l, b, r, t], [x, y, ..]| [l.min(x), b.min(y), r.max(x), t.max(y)]))
    }
}
