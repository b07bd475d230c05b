//! Something round that is let go on a rough slope, on both sides of the friction from which on it rolls.
//!
//! # Law
//!
//! With k m R^2 the moment of inertia, rolling asks for the friction m g sin(slope) k/(k + 1).
//!
//! # Closed form
//!
//! It rolls with g sin(slope)/(k + 1) if mu >= tan(slope) k/(k + 1), else it slips with g (sin(slope) - mu cos(slope)), turning ever faster by
//! mu g cos(slope)/(k R).
//!
//! # Source
//!
//! Routh, Dynamics of a System of Rigid Bodies, Elementary Part.

use super::super::ground::{Along, Ground, Round};
use super::super::real::Real;
use super::super::setup::{At, Problem, Setup};
use super::super::units::{FORCE, RATE, SPEED, TIME};

/// Distances from the threshold, in parts of it; nearer the rounding of the slope decides.
const APART: [f64; 2] = [1e-10, 0.5];
/// Ends of runs, in the problem's own size.
const ENDS: [f64; 2] = [0.1, 10.0];

pub(super) fn make(mut setup: Setup) -> Problem {
    let ground = Ground::random(&mut setup, 1.0);
    let round = Round::random(&mut setup);
    let (radius, k) = (&round.radius.value, &round.inertia);
    let part = k / (k + 1);
    let apart = setup.draw.sign() * setup.draw.log_between(APART[0], APART[1]);
    let apart = format!("{apart:.2e}");
    let (share, slope) = (round.share(), &ground.slope);
    setup.parameter("mu", &format!("(1 + {apart})*abs(tan({slope}))*{share}"));
    ground.write(&mut setup, [&round.shape(), ""], [&round.radius.word, "0"], "friction = \"mu\"");
    let [pull, push] = ground.weight();
    let mu = (1 + Real::read(&apart)) * slope.value.tan().abs() * &part;
    let rolls = Real::read(&apart).sign() >= 0;
    let held = if rolls { -(&pull * &part) } else { -(&mu * &push * pull.sign()) };
    let (gained, turned) = (&pull + &held, &held / (k * radius));
    let size = setup.draw.log_between(ENDS[0], ENDS[1]);
    let until = setup.given("until", size, TIME);
    let time = &until.value;
    let (speed, place) = (&gained * time, &gained * time.squared() / 2);
    ground.ask(&mut setup, &At::End, radius, Along { place: &place, speed: &speed }, &speed);
    setup.ask("p.omega", At::End, &(&turned * time), RATE);
    setup.ask("floor.friction", At::End, &(&held * &ground.mass.value), FORCE);
    let slip = if rolls { Real::zero() } else { (&gained + &turned * radius) * time };
    setup.ask_beside("floor.p.rim.slip", At::End, (&slip, speed.to_f64().abs()), SPEED);
    setup.problem(&ground.gravity.word, &until)
}
