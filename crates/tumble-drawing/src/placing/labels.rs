//! Choosing places for all labels of a panel together.

use std::collections::VecDeque;

use super::occupancy::{CLEARANCE, Occupancy, covers, lines_cross};
use crate::rect::Rect;
use crate::svg::{Element, line};
use crate::text::{Label, PlacedText};
use crate::theme::{GREY, Rgb, SMALL};

use super::candidates::{Candidate, anywhere};
use crate::geometry::{Point, gap, length, minus, plus, times};

/// Labels farther than this from what they belong to get a leader, in pixels.
const LEADER_FROM: f64 = 22.0;
/// Distance of a leader from what it points at, and from the label, in pixels.
const LEADER_GAP: f64 = 3.0;
/// Thickness of leaders.
const LEADER: f64 = 0.7;
/// What a leader costs, and each pixel of distance, and each line it crosses or touches.
const LEADER_COST: f64 = 30.0;
const DISTANCE_COST: f64 = 0.5;
const CROSSING_COST: f64 = 45.0;
/// What lines between a label and what it belongs to cost where there is no leader.
const PARTED_COST: f64 = 15.0;
/// What covering something drawn costs, compared with the page's own measure: it comes last.
const COVER_WEIGHT: f64 = 6.0;
/// What standing nearer to something else costs, or nearly so.
const RIVAL_COST: f64 = 250.0;
const NEARLY: f64 = 5.0;
/// What two labels that overlap cost, and a leader that touches a label, which would seem a letter of it: more than crossing any arrows.
const OVERLAP_COST: f64 = 4000.0;
/// What it costs that another label has to move, while it is sought where one may stand.
const PUSH_COST: f64 = 20.0;
/// Labels that may have to move for one.
const MOST_PUSHED: usize = 6;
/// Points of what a label belongs to at which a leader may end, but for the nearest.
const PARTS: usize = 6;
/// Room kept between a leader and what it does not belong to, in pixels.
const LEADER_APART: f64 = 2.0;
/// What two labels beside each other keep apart beyond what lines above each other do, in pixels: a space would be read as one of a text.
const WORDS_APART: f64 = 12.0;
/// Candidates kept for each label.
const KEPT: usize = 500;
/// By how much all have to gain for others to make room: less is rounding.
const BETTER: f64 = 1e-6;
/// Rounds in which every label may move again.
const ROUNDS: usize = 6;

/// A label that wants a place.
#[derive(Clone, Debug)]
pub(crate) struct Tag {
    pub(crate) label: Label,
    pub(crate) colour: Rgb,
    /// Text size in pixels.
    pub(crate) size: f64,
    /// What it belongs to, as a line on the page: where a leader may point.
    pub(crate) owner: Vec<Point>,
    /// All of it, which other labels must not seem to belong to.
    pub(crate) whole: Vec<Point>,
    /// Places near the owner.
    pub(crate) near: Vec<Candidate>,
    /// What it costs that it stands anywhere, with a leader, if it may.
    pub(crate) far: Option<f64>,
    /// Closed outlines on which it would seem to name something else.
    pub(crate) off: Vec<Vec<Point>>,
}

impl Tag {
    /// A label that stands near what it belongs to.
    pub(crate) fn new(label: Label, colour: Rgb, owner: Vec<Point>, near: Vec<Candidate>) -> Self {
        let whole = owner.clone();
        Self { label, colour, size: SMALL, owner, whole, near, far: None, off: vec![] }
    }

    /// Width and height in pixels.
    pub(crate) fn extent(label: &Label, size: f64) -> [f64; 2] {
        [label.width(size), 1.15 * size]
    }
}

/// A label at its place.
#[derive(Clone, Debug)]
pub(crate) struct Placed {
    pub(crate) label: Label,
    pub(crate) colour: Rgb,
    pub(crate) size: f64,
    pub(crate) place: Rect,
    /// A thin line to what it belongs to.
    pub(crate) leader: Option<[Point; 2]>,
    /// Whether it stands on a line, from which a rim of paper parts it.
    pub(crate) halo: bool,
}

/// Labels with their leaders.
pub(crate) fn draw_placed(labels: &[Placed]) -> Vec<Element> {
    let leaders = labels.iter().filter_map(|label| label.leader).map(leader);
    let text = |label: &Placed| {
        let text = PlacedText::centred(&label.label, &label.place, label.size).colour(label.colour);
        if label.halo { text.halo().element() } else { text.element() }
    };
    leaders.chain(labels.iter().map(text)).collect()
}

/// The thin line from a label to what it belongs to.
fn leader([from, to]: [Point; 2]) -> Element {
    line(from, to).stroked(GREY, LEADER)
}

/// A place with all that it costs by itself.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Spot {
    place: Rect,
    leader: Option<[Point; 2]>,
    cost: f64,
}

/// The places of all labels: each the best for itself, then moved while that helps.
pub(crate) fn placed(tags: &[Tag], drawn: &Occupancy, area: &Rect) -> Vec<Placed> {
    let spots: Vec<Vec<Spot>> = (0..tags.len()).map(|i| spots(tags, i, drawn, area)).collect();
    let mut chosen: Vec<Option<Spot>> = vec![None; tags.len()];
    for _ in 0..ROUNDS {
        let before = chosen.clone();
        for i in 0..tags.len() {
            chosen[i] = best(&spots[i], &chosen, i);
        }
        (0..tags.len()).for_each(|i| make_room(&spots, &mut chosen, i));
        if chosen == before {
            break;
        }
    }
    let kept = |(i, tag): (usize, &Tag)| Some(finished(tag, chosen[i]?, drawn));
    tags.iter().enumerate().filter_map(kept).collect()
}

fn finished(tag: &Tag, spot: Spot, drawn: &Occupancy) -> Placed {
    let Tag { label, colour, size, .. } = tag.clone();
    let halo = drawn.is_crossed(&spot.place.grown(1.0));
    Placed { label, colour, size, place: spot.place, leader: spot.leader, halo }
}

/// The best spot of label `i` beside the others' present ones.
fn best(spots: &[Spot], chosen: &[Option<Spot>], i: usize) -> Option<Spot> {
    cheapest(spots, |spot| crowding(spot, chosen, i))
}

/// The spot that costs least with what it costs beside others.
fn cheapest(spots: &[Spot], beside: impl Fn(&Spot) -> f64) -> Option<Spot> {
    let mut best: Option<(f64, Spot)> = None;
    for spot in spots {
        let least = best.map_or(f64::INFINITY, |(cost, _)| cost);
        // Spots come in order of their own cost.
        if spot.cost >= least {
            break;
        }
        let cost = spot.cost + beside(spot);
        if cost < least {
            best = Some((cost, *spot));
        }
    }
    best.map(|(_, spot)| spot)
}

/// Moves label `i` to where others are in its way, and these elsewhere, if that is better for all.
fn make_room(spots: &[Vec<Spot>], chosen: &mut Vec<Option<Spot>>, i: usize) {
    let mut least = total(chosen);
    for spot in &spots[i] {
        // What it could save is no more than what it costs now.
        let saved = chosen[i].map_or(0.0, |now| now.cost + crowding(&now, chosen, i) - spot.cost);
        if saved <= 0.0 {
            break;
        }
        let pushes = if saved < CROSSING_COST { &[f64::INFINITY][..] } else { &[f64::INFINITY, PUSH_COST] };
        for push in pushes {
            let Some(trial) = pushed(spots, chosen, i, *spot, *push, least) else { continue };
            let cost = total(&trial);
            if cost < least - BETTER {
                (least, *chosen) = (cost, trial);
            }
        }
    }
}

/// With a label at a spot: those in its way move elsewhere, and those in the way of these in their turn, each once. What it costs where
/// another has to move is no more than `push`. Nothing where too many would move, or where all cost no less than `least`.
fn pushed(
    spots: &[Vec<Spot>],
    chosen: &[Option<Spot>],
    i: usize,
    spot: Spot,
    push: f64,
    least: f64,
) -> Option<Vec<Option<Spot>>> {
    let mut trial = chosen.to_vec();
    let mut pushed = 0;
    // What all cost at least: those that are still to move stand best by themselves.
    let own = |spot: Option<Spot>| spot.map_or(0.0, |spot| spot.cost);
    let mut sum: f64 = chosen.iter().map(|spot| own(*spot)).sum::<f64>() - own(chosen[i]);
    let mut is_settled = vec![false; trial.len()];
    let mut moving = VecDeque::from([i]);
    while let Some(j) = moving.pop_front() {
        let beside = |own: &Spot| -> f64 {
            let others = trial.iter().enumerate().filter(|(k, _)| *k != j);
            let cost = |(k, other): (usize, &Spot)| match conflict(own, other) {
                cost if is_settled[k] => cost,
                cost => cost.min(push),
            };
            others.filter_map(|(k, other)| Some((k, other.as_ref()?))).map(cost).sum()
        };
        let place = if j == i { Some(spot) } else { cheapest(&spots[j], beside) };
        trial[j] = place;
        is_settled[j] = true;
        sum += own(place) - if j == i { 0.0 } else { own(spots[j].first().copied()) };
        for k in (0..trial.len()).filter(|k| !is_settled[*k]) {
            if place.zip(trial[k]).is_some_and(|(own, other)| conflict(&own, &other) > 0.0) {
                sum += own(spots[k].first().copied()) - own(trial[k]);
                trial[k] = None;
                moving.push_back(k);
                pushed += 1;
            }
        }
        if pushed > MOST_PUSHED || sum >= least {
            return None;
        }
    }
    Some(trial)
}

/// What all labels cost where they are.
fn total(chosen: &[Option<Spot>]) -> f64 {
    let cost = |(i, spot): (usize, &Spot)| spot.cost + crowding(spot, &chosen[..i], i);
    chosen.iter().enumerate().filter_map(|(i, spot)| Some((i, spot.as_ref()?))).map(cost).sum()
}

/// What a spot of label `i` costs beside the others.
fn crowding(spot: &Spot, chosen: &[Option<Spot>], i: usize) -> f64 {
    let others = chosen.iter().enumerate().filter(|(j, _)| *j != i);
    others.filter_map(|(_, other)| other.as_ref()).map(|other| conflict(spot, other)).sum()
}

fn conflict(a: &Spot, b: &Spot) -> f64 {
    let shared = a.place.grown(CLEARANCE).wider(WORDS_APART).overlap(&b.place);
    let overlap = if shared > 0.0 { OVERLAP_COST + shared } else { 0.0 };
    let under = |place: &Rect, leader: Option<[Point; 2]>| {
        leader.is_some_and(|[p, q]| place.grown(LEADER_APART).meets_line(p, q))
    };
    let hidden = [under(&a.place, b.leader), under(&b.place, a.leader)].iter().filter(|hit| **hit).count();
    let crossing = a.leader.zip(b.leader).is_some_and(|(p, q)| lines_cross(p, q));
    overlap + OVERLAP_COST * hidden as f64 + if crossing { CROSSING_COST } else { 0.0 }
}

/// The spots of label `i`, cheapest first.
fn spots(tags: &[Tag], i: usize, drawn: &Occupancy, area: &Rect) -> Vec<Spot> {
    let tag = &tags[i];
    let size = Tag::extent(&tag.label, tag.size);
    let far = tag.far.map(|cost| anywhere(area, size, cost)).unwrap_or_default();
    let others = tags.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, other)| &*other.whole);
    let rivals: Vec<Rival<'_>> = others.map(|whole| (whole, Rect::around(whole.iter().copied()))).collect();
    let candidates = tag.near.iter().chain(&far);
    let mut spots: Vec<Spot> = candidates.map(|c| spot(tag, *c, drawn, &rivals)).collect();
    spots.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    spots.truncate(KEPT);
    spots
}

/// What a label must not seem to belong to, and the box that it is in.
type Rival<'t> = (&'t [Point], Option<Rect>);

fn spot(tag: &Tag, candidate: Candidate, drawn: &Occupancy, rivals: &[Rival<'_>]) -> Spot {
    let Candidate { place, cost } = candidate;
    let (ends, own) = gap(&place, &tag.owner);
    let is_led = tag.far.is_some() && own > LEADER_FROM;
    let led = is_led.then(|| led(tag, &place, ends, drawn));
    let [from, to] = shortened(ends);
    let parted = || PARTED_COST * drawn.crossed_by(from, to).min(1) as f64;
    let (leader, parted) =
        led.map_or_else(|| (None, parted()), |(leader, cost)| (Some(leader), LEADER_COST + cost));
    let on_faces = if tag.off.iter().any(|face| covers(face, &place)) { OVERLAP_COST } else { 0.0 };
    let rivalry: f64 =
        if leader.is_some() { 0.0 } else { rivals.iter().map(|rival| rivalry(&place, rival, own)).sum() };
    let burden = COVER_WEIGHT * drawn.burden(&place.grown(CLEARANCE));
    let away = DISTANCE_COST * own + parted;
    Spot { place, leader, cost: cost + burden + rivalry + on_faces + away }
}

/// The leader of a label, and what it costs beyond being one: to the nearest point of what the label belongs to, or to another
/// where it is in nothing's way.
fn led(tag: &Tag, place: &Rect, nearest: [Point; 2], drawn: &Occupancy) -> ([Point; 2], f64) {
    let cost = |ends: [Point; 2]| {
        let [from, to] = shortened(ends);
        let longer =
            DISTANCE_COST * (length(minus(ends[1], ends[0])) - length(minus(nearest[1], nearest[0])));
        ([from, to], CROSSING_COST * drawn.touched_by(from, to, LEADER_APART) + longer)
    };
    let first = cost(nearest);
    if first.1 == 0.0 {
        return first;
    }
    let others = parts(&tag.owner).into_iter().map(|p| gap(place, &[p]).0).map(cost);
    others.fold(first, |best, other| if other.1 < best.1 { other } else { best })
}

/// Points along a line.
fn parts(line: &[Point]) -> Vec<Point> {
    match *line {
        [a, b] => (0..=PARTS).map(|i| plus(a, times(minus(b, a), i as f64 / PARTS as f64))).collect(),
        _ => line.iter().step_by(line.len().div_ceil(PARTS).max(1)).copied().collect(),
    }
}

fn rivalry(place: &Rect, (rival, within): &Rival<'_>, own: f64) -> f64 {
    // Where all of it is farther than what counts, it need not be known how far.
    if within.is_some_and(|within| place.apart(&within) > own + 2.0 * NEARLY) {
        return 0.0;
    }
    let distance = gap(place, rival).1;
    let part = ((own + NEARLY - distance) / NEARLY).clamp(0.0, 1.0);
    RIVAL_COST * part
}

fn shortened([from, to]: [Point; 2]) -> [Point; 2] {
    let distance = length(minus(to, from));
    let step = times(minus(to, from), LEADER_GAP / distance.max(LEADER_GAP));
    [plus(from, step), minus(to, step)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spot(x: f64, cost: f64) -> Spot {
        Spot { place: Rect::new(x, 0.0, 10.0, 10.0), leader: None, cost }
    }

    #[test]
    fn a_label_makes_room_for_another_that_stands_badly_elsewhere() {
        let spots = [vec![spot(0.0, 0.0), spot(100.0, 10.0)], vec![spot(5.0, 0.0), spot(200.0, 90.0)]];
        let mut chosen: Vec<Option<Spot>> = spots.iter().map(|own| Some(own[0])).collect();
        chosen[1] = best(&spots[1], &chosen, 1);
        assert_eq!(chosen[1], Some(spots[1][1]), "by itself it stays out of the way");
        make_room(&spots, &mut chosen, 1);
        assert_eq!(chosen, [Some(spots[0][1]), Some(spots[1][0])]);
    }

    #[test]
    fn labels_that_make_room_push_others_on() {
        let spots = [
            vec![spot(100.0, 0.0), spot(200.0, 5.0)],
            vec![spot(0.0, 0.0), spot(105.0, 1.0), spot(300.0, 300.0)],
            vec![spot(5.0, 0.0), spot(400.0, 90.0)],
        ];
        let mut chosen = vec![Some(spots[0][0]), Some(spots[1][0]), Some(spots[2][1])];
        make_room(&spots, &mut chosen, 2);
        assert_eq!(chosen, [Some(spots[0][1]), Some(spots[1][1]), Some(spots[2][0])]);
    }

    #[test]
    fn a_leader_ends_where_it_is_in_nothings_way() {
        let place = Rect::new(0.0, 0.0, 20.0, 10.0);
        let owner = vec![[10.0, 60.0], [60.0, 60.0]];
        let tag = Tag { far: Some(0.0), ..Tag::new(Label::plain("a"), GREY, owner, vec![]) };
        let ends = gap(&place, &tag.owner).0;
        let mut drawn = Occupancy::new(Rect::new(-100.0, -100.0, 300.0, 300.0));
        let (straight, cost) = led(&tag, &place, ends, &drawn);
        assert!(straight[1][0] == 10.0 && cost == 0.0);
        // An arrow ends just beside the straight way.
        let arrow = [[11.5, 80.0], [11.5, 40.0]];
        drawn.add_line(arrow.to_vec());
        assert_eq!(drawn.crossed_by(straight[0], straight[1]), 0);
        let (leader, cost) = led(&tag, &place, ends, &drawn);
        assert!(leader[1][0] > 15.0 && cost < CROSSING_COST, "{leader:?}");
        assert_eq!(drawn.touched_by(leader[0], leader[1], LEADER_APART), 0.0);
    }

    #[test]
    fn a_label_stands_on_no_face_that_it_keeps_off() {
        let page = Rect::new(0.0, 0.0, 200.0, 200.0);
        let near: Vec<Candidate> = [[80.0, 90.0], [10.0, 150.0]]
            .map(|[x, y]| Candidate { place: Rect::new(x, y, 20.0, 10.0), cost: y })
            .into();
        let tag = Tag::new(Label::plain("floor"), GREY, vec![[0.0, 120.0], [200.0, 120.0]], near);
        let y = |tag: &Tag| placed(std::slice::from_ref(tag), &Occupancy::new(page), &page)[0].place.y;
        assert_eq!(y(&tag), 90.0);
        let body = vec![[50.0, 50.0], [150.0, 50.0], [150.0, 120.0], [50.0, 120.0]];
        assert_eq!(y(&Tag { off: vec![body], ..tag }), 150.0);
    }

    #[test]
    fn a_leader_keeps_clear_of_other_labels() {
        let label = spot(0.0, 0.0);
        let led = |x: f64| Spot { leader: Some([[x, -20.0], [x, 20.0]]), ..spot(50.0, 0.0) };
        assert!(conflict(&label, &led(5.0)) >= OVERLAP_COST && conflict(&label, &led(11.0)) >= OVERLAP_COST);
        assert_eq!(conflict(&label, &led(13.0)), 0.0);
    }
}
