//! Closed loops drawn once: laps over a line already there would fill the gaps of its dashes.

use std::collections::HashMap;

/// Side of the cells in which drawn lines are remembered, in pixels.
const CELL: f64 = 0.5;
/// A line is compared only with what lies at least this far back along it, in pixels.
const BACK: f64 = 20.0;
/// Retraced stretches shorter than this are drawn again: they may be crossings.
const SHORTEST: f64 = 12.0;
/// Longest piece of a line that is looked up; lines leaving the page are not.
const LONGEST: f64 = 1e4;

/// The parts of a line (`[x, y]` in pixels) that do not run along earlier parts of it.
pub fn without_laps(points: &[[f64; 2]]) -> Vec<Vec<[f64; 2]>> {
    let Some(first) = points.first() else { return Vec::new() };
    let mut walk = Walk::new(*first);
    points[1..].iter().for_each(|point| walk.step(*point));
    walk.settle();
    walk.drawn.retain(|part| part.len() > 1 || points.len() == 1);
    walk.drawn
}

type Cell = (i64, i64);

struct Walk {
    /// Length walked when a cell was first drawn in.
    seen: HashMap<Cell, f64>,
    drawn: Vec<Vec<[f64; 2]>>,
    /// Retraced points not yet drawn or dropped.
    waiting: Vec<[f64; 2]>,
    waiting_length: f64,
    at: [f64; 2],
    length: f64,
}

impl Walk {
    fn new(first: [f64; 2]) -> Self {
        let (drawn, seen) = (vec![vec![first]], HashMap::new());
        Self { seen, drawn, waiting: Vec::new(), waiting_length: 0.0, at: first, length: 0.0 }
    }

    fn step(&mut self, to: [f64; 2]) {
        let length = (to[0] - self.at[0]).hypot(to[1] - self.at[1]);
        self.length += length;
        if length < LONGEST && samples(self.at, to).all(|p| self.is_old(p)) {
            self.waiting.push(to);
            self.waiting_length += length;
        } else {
            self.settle();
            self.draw(to, length);
        }
        self.at = to;
    }

    fn is_old(&self, point: [f64; 2]) -> bool {
        let (x, y) = cell(point);
        let near = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (x + dx, y + dy)));
        let mut seen = near.filter_map(|cell| self.seen.get(&cell));
        seen.any(|length| self.length - length > BACK)
    }

    /// Drops what waits if it is a lap, else draws it.
    fn settle(&mut self) {
        let waiting = std::mem::take(&mut self.waiting);
        let is_lap = std::mem::take(&mut self.waiting_length) > SHORTEST;
        match (is_lap, waiting.last()) {
            (true, Some(last)) => self.drawn.push(vec![*last]),
            _ => waiting.into_iter().for_each(|point| self.draw(point, 0.0)),
        }
    }

    fn draw(&mut self, to: [f64; 2], length: f64) {
        let Some(part) = self.drawn.last_mut() else { return };
        let from = part.last().copied().unwrap_or(to);
        part.push(to);
        if length < LONGEST {
            samples(from, to).for_each(|p| _ = self.seen.entry(cell(p)).or_insert(self.length));
        }
    }
}

fn cell([x, y]: [f64; 2]) -> Cell {
    ((x / CELL).floor() as i64, (y / CELL).floor() as i64)
}

/// Points along a piece of line, one a cell or more, its start left out.
fn samples(a: [f64; 2], b: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
    let count = ((b[0] - a[0]).hypot(b[1] - a[1]) / CELL).ceil().max(1.0);
    (1..=count as usize).map(move |i| {
        let part = i as f64 / count;
        [a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn length(parts: &[Vec<[f64; 2]>]) -> f64 {
        let pieces = parts.iter().flat_map(|part| part.windows(2));
        pieces.map(|w| (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1])).sum()
    }

    fn loops(count: f64, pitch: f64) -> Vec<[f64; 2]> {
        let point = |i: i32| {
            let turn = f64::from(i) / 333.3;
            let radius = 100.0 - pitch * turn;
            let (sin, cos) = (std::f64::consts::TAU * turn).sin_cos();
            [200.0 + radius * cos, 200.0 + radius * sin]
        };
        (0..(count * 333.3) as i32).map(point).collect()
    }

    #[test]
    fn a_loop_is_drawn_once() {
        let parts = without_laps(&loops(7.0, 0.0));
        let once = std::f64::consts::TAU * 100.0;
        assert!((length(&parts) - once).abs() < 0.05 * once, "{}", length(&parts));
    }

    #[test]
    fn a_spiral_is_drawn_whole() {
        let line = loops(7.0, 6.0);
        assert_eq!(without_laps(&line), [line]);
    }

    #[test]
    fn crossings_leave_no_gap() {
        let eight: Vec<_> = (0..=400)
            .map(|i| std::f64::consts::TAU * f64::from(i) / 400.0)
            .map(|a| [200.0 + 100.0 * a.sin(), 200.0 + 80.0 * (2.0 * a).sin()])
            .collect();
        assert_eq!(without_laps(&eight).len(), 1);
    }

    #[test]
    fn short_lines_stay() {
        assert!(without_laps(&[]).is_empty());
        assert_eq!(without_laps(&[[1.0, 1.0]]), [[[1.0, 1.0]]]);
    }
}
