//! Long curves made short without changing the picture.

use crate::geometry::{length, minus, nearest};

/// Points that one straight piece may replace, at most; bounds the work.
const LONGEST_RUN: usize = 64;

/// Splits a curve at points that are not finite: a gap in the data is a gap in the line.
pub fn pieces(points: impl IntoIterator<Item = [f64; 2]>) -> Vec<Vec<[f64; 2]>> {
    let mut pieces = vec![Vec::new()];
    for point in points {
        match pieces.last_mut() {
            Some(piece) if point[0].is_finite() && point[1].is_finite() => piece.push(point),
            Some(piece) if piece.is_empty() => {}
            _ => pieces.push(Vec::new()),
        }
    }
    pieces.retain(|piece| !piece.is_empty());
    pieces
}

/// Thins a line (`[x, y]` in pixels): of consecutive points in one column,
/// `column` pixels wide, the first, last, lowest and highest stay, in order.
pub fn thinned(points: &[[f64; 2]], column: f64) -> Vec<[f64; 2]> {
    let same_column = |a: &[f64; 2], b: &[f64; 2]| (a[0] / column).floor() == (b[0] / column).floor();
    let mut kept = Vec::new();
    for run in points.chunk_by(same_column) {
        kept.extend(extremes(run).map(|i| run[i]));
    }
    kept
}

/// Drops points that lie within `tolerance` pixels of the straight line between those kept.
pub fn simplified(points: &[[f64; 2]], tolerance: f64) -> Vec<[f64; 2]> {
    let Some(first) = points.first() else { return Vec::new() };
    let (mut kept, mut anchor) = (vec![*first], 0);
    for end in 1..points.len() {
        let mut between = points[anchor + 1..end].iter();
        let strays = between.any(|p| distance(*p, points[anchor], points[end]) > tolerance);
        if strays || end - anchor > LONGEST_RUN {
            anchor = end - 1;
            kept.push(points[anchor]);
        }
    }
    kept.extend(points[1..].last());
    kept
}

/// Distance of `p` from the straight piece between `a` and `b`.
fn distance(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    length(minus(p, nearest(p, [a, b])))
}

/// Indices of the first, last, lowest and highest point, increasing, each once.
fn extremes(run: &[[f64; 2]]) -> impl Iterator<Item = usize> {
    let better = |i: usize, best: usize, sign: f64| sign * run[i][1] > sign * run[best][1];
    let extreme = |sign| (0..run.len()).fold(0, |best, i| if better(i, best, sign) { i } else { best });
    let mut kept = [0, extreme(1.0), extreme(-1.0), run.len().saturating_sub(1)];
    kept.sort_unstable();
    kept.into_iter().scan(None, |previous, i| Some((previous.replace(i) != Some(i)).then_some(i))).flatten()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn gaps_split_the_line() {
        let nan = f64::NAN;
        let line = [[0.0, nan], [1.0, 1.0], [2.0, 2.0], [3.0, nan], [nan, 0.0], [5.0, 5.0]];
        assert_eq!(pieces(line), [vec![[1.0, 1.0], [2.0, 2.0]], vec![[5.0, 5.0]]]);
        assert!(pieces([]).is_empty());
    }

    #[test]
    fn a_million_points_become_a_few_per_column() {
        let points: Vec<_> = (0..1_000_000).map(|i| [f64::from(i) / 2000.0, f64::from(i).sin()]).collect();
        assert!(thinned(&points, 0.5).len() <= 4 * 1000);
    }

    #[test]
    fn straight_lines_need_few_points() {
        let line: Vec<_> = (0..50).map(|i| [f64::from(i), 2.0 * f64::from(i)]).collect();
        assert_eq!(simplified(&line, 0.01), [line[0], line[49]]);
        assert_eq!(simplified(&line[..1], 0.01), [line[0]]);
    }

    proptest! {
        #[test]
        fn simplified_lines_stay_close(ys in prop::collection::vec(-2.0..2.0f64, 1..100)) {
            let points: Vec<_> = ys.iter().enumerate().map(|(i, y)| [i as f64, *y]).collect();
            let simple = simplified(&points, 0.5);
            for p in &points {
                let near = |w: &[[f64; 2]]| distance(*p, w[0], w[1]) <= 0.5 + 1e-12;
                prop_assert!(simple.len() == 1 || simple.windows(2).any(near));
            }
        }

        #[test]
        fn extremes_ends_and_order_stay(ys in prop::collection::vec(-1e3..1e3f64, 1..400)) {
            let points: Vec<_> = ys.iter().enumerate().map(|(i, y)| [i as f64 * 0.05, *y]).collect();
            let thin = thinned(&points, 1.0);
            let greatest = |p: &[[f64; 2]]| p.iter().map(|p| p[1]).fold(f64::NEG_INFINITY, f64::max);
            let least = |p: &[[f64; 2]]| p.iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
            prop_assert_eq!(greatest(&thin), greatest(&points));
            prop_assert_eq!(least(&thin), least(&points));
            prop_assert_eq!((thin[0], thin[thin.len() - 1]), (points[0], points[points.len() - 1]));
            prop_assert!(thin.windows(2).all(|w| w[0][0] < w[1][0]));
        }
    }
}
