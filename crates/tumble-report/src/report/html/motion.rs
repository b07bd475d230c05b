//! The data of a motion for the page's scripts, and the picture that stands for it without them.

use super::data::{label, mark};
use crate::report::Text;
use crate::report::json::{list, number, object, on_grid, string};
use tumble_drawing::free_body::{Ground, GroundCircle, NamedPoint};
use tumble_drawing::outline::{Outline, Pose};
use tumble_drawing::stroboscope::StroboscopicPicture;
use tumble_drawing::svg::Svg;
use tumble_drawing::track::BodyPath;
use tumble_drawing::{Animation, Label, LinkKind, MovingBody, MovingCase, MovingForce, MovingLink};

/// Steps over the range of places: finer than a screen shows.
const STEPS: f64 = 1e4;
/// Steps over the range of forces, whose arrows are a tenth of the picture.
const ARROW_STEPS: f64 = 1e3;
/// Steps over the duration, so that instants agree with those of curves.
const TIME_STEPS: f64 = 1e6;
/// Frames of one case, at most and at least, and numbers of all cases together: about a megabyte.
const MOST_FRAMES: usize = 1500;
const LEAST_FRAMES: usize = 120;
/// Frames of a picture in an index.
const LIVING_FRAMES: usize = 150;
const MOST_NUMBERS: usize = 300_000;
/// Instants in the picture that stands for the motion.
const INSTANTS: usize = 13;

/// The first case as a stroboscopic picture, described in words.
pub(in crate::report) fn still(animation: &Animation) -> Svg {
    let picture = animation.cases.first().map(|motion| StroboscopicPicture {
        tracks: motion.bodies.iter().map(|b| track(motion, b)).collect(),
        surfaces: motion.surfaces.clone(),
        ..StroboscopicPicture::default()
    });
    let svg = picture.unwrap_or_default().small_svg().described(description(animation));
    Svg { title: animation.title.to_plain_or("Motion"), ..svg }
}

fn track(motion: &MovingCase, body: &MovingBody) -> BodyPath {
    let timed = motion.times.iter().zip(&body.poses).map(|(t, pose)| Pose { t: *t, ..*pose });
    let poses: Vec<Pose> = timed.collect();
    let [from, to] = motion.span();
    let instant = |i: usize| from + (to - from) * i as f64 / (INSTANTS - 1) as f64;
    let nearest =
        |i: usize| poses.iter().min_by(|a, b| (a.t - instant(i)).abs().total_cmp(&(b.t - instant(i)).abs()));
    BodyPath {
        label: body.name.clone(),
        shapes: body.outlines.clone(),
        poses: (0..INSTANTS).filter_map(nearest).copied().collect(),
        trace: poses.iter().map(Pose::centre).collect(),
    }
}

fn description(animation: &Animation) -> String {
    if !animation.description.is_empty() {
        return animation.description.clone();
    }
    let words = animation.cases.iter().take(1).flat_map(|motion| motion.bodies.iter().filter_map(ends));
    words.collect::<Vec<_>>().join(" ")
}

fn ends(body: &MovingBody) -> Option<String> {
    let place = |pose: &Pose| {
        let [x, y, degrees] =
            [pose.x, pose.y, pose.angle.to_degrees()].map(|v| Label::number(v, 3).to_plain());
        format!("({x}, {y}) m at {degrees} degrees")
    };
    let (first, last) = (body.poses.first()?, body.poses.last()?);
    let name = body.name.to_plain_or("The body");
    Some(format!("{name} moves from {} to {}.", place(first), place(last)))
}

/// A motion for a page that is there already.
pub fn motion(animation: &Animation) -> String {
    motion_data(animation, &description(animation))
}

/// One case alone, small: no forces, and no more frames than a small picture needs. It is one of those that the lines beside the
/// picture tell of, where they name some.
pub fn living(animation: &Animation, beside: &[Text]) -> String {
    let said: String = beside.iter().map(|line| line.to_plain().replace('\u{a0}', " ")).collect();
    let is_named =
        |motion: &&MovingCase| said.contains(&format!("({})", motion.name.to_plain().replace('\u{a0}', " ")));
    let named: Vec<&MovingCase> = animation.cases.iter().filter(is_named).collect();
    let cases = if named.is_empty() { animation.cases.iter().collect() } else { named };
    let case = telling(&cases).map(|motion| MovingCase { forces: vec![], ..motion.clone() });
    let small = Animation { cases: case.into_iter().collect(), ..animation.clone() };
    let description = description(&small);
    data_of(&small, &description, LIVING_FRAMES)
}

/// The case that shows most: the one in which bodies come about furthest, and of equals the first.
fn telling<'m>(cases: &[&'m MovingCase]) -> Option<&'m MovingCase> {
    let room = |motion: &MovingCase| motion.bodies.iter().map(covered).sum::<f64>();
    cases.iter().copied().rev().max_by(|a, b| room(a).total_cmp(&room(b)))
}

/// How far apart the places are that a body comes to, with all of it.
fn covered(body: &MovingBody) -> f64 {
    let alone = MovingCase { bodies: vec![body.clone()], ..MovingCase::default() };
    alone.extent().map_or(0.0, |[left, low, right, high]| (right - left).hypot(high - low))
}

/// All cases of a motion.
pub(super) fn motion_data(animation: &Animation, description: &str) -> String {
    data_of(animation, description, MOST_FRAMES)
}

fn data_of(animation: &Animation, description: &str, most: usize) -> String {
    let frames = |motion: &MovingCase| frames(motion, animation.cases.len(), most);
    object([
        ("title", label(&animation.title)),
        ("description", string(description)),
        ("speed", number(animation.speed)),
        ("cases", list(animation.cases.iter().map(|motion| case(motion, &frames(motion))))),
    ])
}

/// The frames that are kept: evenly spread in time, with both neighbours of every event.
fn frames(motion: &MovingCase, cases: usize, most: usize) -> Vec<usize> {
    let numbers = 1 + 3 * motion.bodies.len() + 4 * (motion.links.len() + motion.forces.len());
    let most = (MOST_NUMBERS / (numbers * cases.max(1))).clamp(LEAST_FRAMES, most);
    let count = motion.times.len();
    if count <= most {
        return (0..count).collect();
    }
    let [from, to] = motion.span();
    let at = |t: f64| motion.times.partition_point(|other| *other < t).min(count - 1);
    let even = (0..most).map(|i| at(from + (to - from) * i as f64 / (most - 1) as f64));
    let events = motion.events.iter().take(most).map(|event| at(event.at));
    let mut kept: Vec<usize> = even.chain(events.flat_map(|i| [i.saturating_sub(1), i])).collect();
    kept.push(count - 1);
    kept.sort_unstable();
    kept.dedup();
    kept
}

fn case(motion: &MovingCase, frames: &[usize]) -> String {
    object([
        ("name", label(&motion.name)),
        ("times", on_grid(frames.iter().map(|i| motion.times[*i]), TIME_STEPS)),
        ("bodies", list(motion.bodies.iter().map(|b| body(b, frames)))),
        ("links", list(motion.links.iter().map(|l| link(l, frames)))),
        ("forces", list(motion.forces.iter().map(|f| force(f, frames)))),
        ("surfaces", list(motion.surfaces.iter().filter(|s| s.is_drawable()).map(surface))),
        ("points", list(motion.points.iter().map(point))),
        ("events", list(motion.events.iter().map(mark))),
        ("values", list(motion.values.iter().map(|(name, value)| list([string(name), number(*value)])))),
        ("box", motion.extent().map_or("null".to_owned(), |bounds| list(bounds.map(number)))),
    ])
}

/// The values at the kept frames, so many steps over their range; the last one stays where there are too few.
fn at_frames<T>(values: &[T], frames: &[usize], steps: f64, of: impl Fn(&T) -> f64) -> String {
    let values: Vec<f64> = frames.iter().filter_map(|i| values.get(*i).or(values.last()).map(&of)).collect();
    on_grid(values.iter().copied(), steps)
}

/// The columns of points and of what is there: other points, or forces.
fn pairs(values: &[[[f64; 2]; 2]], frames: &[usize], steps: [f64; 2]) -> String {
    let column = |(part, k): (usize, usize)| at_frames(values, frames, steps[part], |pair| pair[part][k]);
    list([(0, 0), (0, 1), (1, 0), (1, 1)].map(column))
}

fn body(body: &MovingBody, frames: &[usize]) -> String {
    object([
        ("name", label(&body.name)),
        ("trail", body.trail.to_string()),
        ("outlines", list(body.outlines.iter().map(outline))),
        ("x", at_frames(&body.poses, frames, STEPS, |pose| pose.x)),
        ("y", at_frames(&body.poses, frames, STEPS, |pose| pose.y)),
        ("angle", at_frames(&body.poses, frames, STEPS, |pose| pose.angle)),
    ])
}

fn outline(outline: &Outline) -> String {
    let (name, radius) = match outline {
        Outline::Segment { .. } => ("rod", None),
        Outline::Cord { .. } => ("cord", None),
        Outline::Circle { radius, is_hollow, .. } => {
            (if *is_hollow { "ring" } else { "circle" }, Some(*radius))
        }
        Outline::Polygon(_) => ("polygon", None),
        Outline::Point(_) => ("point", None),
    };
    let numbers = outline.points().into_iter().flatten().chain(radius).map(number);
    list(std::iter::once(string(name)).chain(numbers))
}

fn link(link: &MovingLink, frames: &[usize]) -> String {
    let kind = match link.kind {
        LinkKind::Spring => "spring",
        LinkKind::Damper => "damper",
    };
    object([
        ("name", label(&link.name)),
        ("kind", string(kind)),
        ("ends", pairs(&link.ends, frames, [STEPS; 2])),
    ])
}

fn force(force: &MovingForce, frames: &[usize]) -> String {
    let style = force.kind.style();
    object([
        ("kind", string(force.kind.name())),
        ("dashes", string(style.dashes)),
        ("thickness", number(style.thickness)),
        ("symbol", label(&force.symbol)),
        ("samples", pairs(&force.samples, frames, [STEPS, ARROW_STEPS])),
    ])
}

fn surface(surface: &Ground) -> String {
    let numbers = surface.point.into_iter().chain(surface.normal).chain(surface.reach).map(number);
    let round = |round: GroundCircle| list([number(round.radius), u8::from(round.hollow).to_string()]);
    let round = surface.round.map_or_else(|| "null".to_owned(), round);
    object([("at", list(numbers)), ("name", label(&surface.name)), ("round", round)])
}

fn point(point: &NamedPoint) -> String {
    object([("at", list(point.at.map(number))), ("name", label(&point.name))])
}

#[cfg(test)]
mod tests {
    use super::*;
    use tumble_drawing::curves::Mark;

    #[test]
    fn long_motions_keep_their_ends_and_events() {
        let times: Vec<f64> = (0..100_000).map(|i| f64::from(i) * 1e-4).collect();
        let events = vec![Mark { at: 3.333_35, ..Mark::default() }];
        let motion = MovingCase { times, events, ..MovingCase::default() };
        let kept = frames(&motion, 2, MOST_FRAMES);
        assert!(kept.len() <= MOST_FRAMES + 3);
        assert!(kept.contains(&0) && kept.contains(&99_999));
        assert!(kept.contains(&33_333) && kept.contains(&33_334));
    }

    #[test]
    fn the_case_that_moves_is_shown_and_not_the_one_that_hardly_does() {
        let case = |name: &str, far: f64| {
            let pose = |x: f64| Pose { x, ..Pose::default() };
            let body = MovingBody { poses: vec![pose(0.0), pose(far)], ..MovingBody::default() };
            MovingCase {
                name: tumble_drawing::Label::plain(name),
                bodies: vec![body],
                ..MovingCase::default()
            }
        };
        let cases = vec![case("a", 0.1), case("b", 2.0), case("c", 2.0), case("d", f64::NAN)];
        let all: Vec<&MovingCase> = cases.iter().collect();
        assert_eq!(telling(&all).map(|motion| motion.name.to_plain()), Some("b".to_owned()));
        assert!(telling(&[]).is_none());
        let animation = Animation { cases, ..Animation::default() };
        let shown = |beside: &str| living(&animation, &[beside.into()]);
        assert_eq!(shown("It swings by 0.1 m (a)."), shown("It does (a)."), "what the words are of");
        assert_ne!(shown("It swings by 0.1 m (a)."), shown("It swings."));
    }

    #[test]
    fn poses_that_lack_at_the_end_stay() {
        let shown = at_frames(&[1.0, 2.0], &[0, 1, 2], STEPS, |v| *v);
        assert!(shown.ends_with("[0,10000,0]]"), "{shown}");
    }
}
