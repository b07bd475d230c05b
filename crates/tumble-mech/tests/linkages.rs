//! A four-bar linkage against its one coordinate, `references/linkages.py`.

use crate::common::number;
use tumble_expr::Expr;
use tumble_expr::units::{KG, M, S};
use tumble_mech::{Action, Anchor, Body, Event, Gravity, Joint, Model, Start};
use tumble_ode::{Accuracy, Direction};

/// Crank, coupler, rocker and base, m.
const BARS: [f64; 4] = [0.2, 0.5, 0.4, 0.5];

fn bar(model: &mut Model, name: &str, length: f64) -> Body {
    let bar = Body::rod(name, [0 * M, 0 * M], [length * M, 0 * M]).mass(2.0 * length * KG);
    model.add(bar.with_point("start", [0 * M, 0 * M]).with_point("end", [length * M, 0 * M]))
}

/// Released at rest it swings to and fro: the times at which the crank turns back are half a period apart and more, and the angle there
/// is known.
#[test]
fn a_four_bar_linkage_swings_with_its_period() {
    let text = include_str!("../../tumble/tests/reference/linkages.json");
    let json: serde_json::Value = serde_json::from_str(text).expect("valid JSON");
    let [start, period, other] = ["start", "swinging", "turns_back_at"].map(|key| number(&json[key]));
    let [a, b, c, d] = BARS;
    let reach = (a * a + d * d - 2.0 * a * d * start.cos()).sqrt();
    let inner = (a * start.sin()).atan2(d - a * start.cos());
    let rocker_at =
        std::f64::consts::PI - inner - ((reach * reach + c * c - b * b) / (2.0 * c * reach)).acos();
    let [x, y] = [a * start.cos(), a * start.sin()];
    let coupler_at = (c * rocker_at.sin() - y).atan2(d + c * rocker_at.cos() - x);

    let mut model = Model::new();
    model.gravity = Gravity::Vertical(9.81 * M / (S * S));
    let [crank, coupler, rocker] =
        [("crank", a), ("coupler", b), ("rocker", c)].map(|(name, length)| bar(&mut model, name, length));
    model.pivot_at("A0", &crank, [0 * M, 0 * M], [0 * M, 0 * M]);
    model.pivot_at("B0", &rocker, [0 * M, 0 * M], [d * M, 0 * M]);
    let ends = |first: &Body, at: &str, second: &Body, there: &str| {
        [(first, at), (second, there)]
            .map(|(body, point)| Anchor::Material(body.named_point(point).expect("given")))
    };
    model.join(Joint { assemble: true, ..Joint::pin("A", ends(&crank, "end", &coupler, "start")) });
    model.join(Joint { assemble: true, ..Joint::pin("B", ends(&coupler, "end", &rocker, "end")) });
    let middle = [(x + b / 2.0 * coupler_at.cos()) * M, (y + b / 2.0 * coupler_at.sin()) * M];
    model.starts.push(("crank".into(), Start::default().angle(Expr::from(start))));
    model.starts.push(("rocker".into(), Start::default().angle(Expr::from(rocker_at))));
    model.starts.push(("coupler".into(), Start::default().at(middle).angle(Expr::from(coupler_at))));
    model.events.push(Event {
        name: "turn".into(),
        when: crank.kinematics().omega().clone(),
        direction: Direction::Rising,
        action: Action::Record,
    });
    let accuracy = Accuracy::new(1e-12).expect("an accuracy");
    let found =
        model.simulate_to(&[], 10 * S, accuracy).map_err(|error| error.to_string()).expect("a motion");
    let turns: Vec<f64> = found.trajectory().events.iter().map(|event| event.time).collect();
    assert_eq!(turns.len(), 4);
    for (index, turn) in turns.iter().enumerate() {
        let expected = period * (index as f64 + 0.5);
        println!("{:e}", turn - expected);
        assert!((turn - expected).abs() < 1e-11, "{turn} is not {expected}");
        let angle = found.at(*turn).expect("within").angle(&crank).expect("finite");
        assert!((angle - other).abs() < 1e-11, "{angle} is not {other}");
    }
}
