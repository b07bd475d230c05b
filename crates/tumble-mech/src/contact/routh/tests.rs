use proptest::prelude::*;

use super::*;

/// Energies of random impacts are differences of numbers of the size of one.
const ROUNDING: f64 = 1e-12;
/// Steps of the integration in small steps; it is exact but for where it turns, within one of them.
const STEPS: usize = 200_000;

/// A body of unit mass with this central radius of gyration, struck at this arm from its centre.
fn free(gyration: f64, [rx, ry]: [f64; 2]) -> [f64; 3] {
    let square = gyration * gyration;
    [1.0 + ry * ry / square, -rx * ry / square, 1.0 + rx * rx / square]
}

fn strike(response: [f64; 3], before: [f64; 2], friction: [f64; 2], restitution: f64) -> Strike {
    Strike { response, before, friction, restitution, law: Restitution::Poisson }
}

fn after(strike: &Strike, [p_t, p_n]: [f64; 2]) -> [f64; 2] {
    let ([tt, tn, nn], [u_t, u_n]) = (strike.response, strike.before);
    [u_t + tt * p_t + tn * p_n, u_n + tn * p_t + nn * p_n]
}

/// The same impact in small steps of the normal impulse, by the definitions and nothing else.
fn marched(strike: &Strike, length: f64) -> Struck {
    let ([tt, tn, nn], [of_rest, kinetic]) = (strike.response, strike.friction);
    let (step, mut u, mut p) = (length / STEPS as f64, strike.before, [0.0; 2]);
    let (mut ending, mut compression, mut taken, mut given) = (Ending::Slips, None, 0.0, 0.0);
    loop {
        // A step that would carry the slip across zero ends there, as far as that tells.
        let still = u[0].abs() <= 0.6 * step * (tt * kinetic + tn.abs());
        let mut ratio = -kinetic * u[0].signum();
        if still && ending != Ending::Turns {
            (ratio, ending) = match -tn / tt {
                hold if hold.abs() <= of_rest => (hold - u[0] / (tt * step), Ending::Sticks),
                _ => (-kinetic * tn.signum(), Ending::Turns),
            };
        }
        let next = [u[0] + (tn + tt * ratio) * step, u[1] + (nn + tn * ratio) * step];
        let work = 0.5 * (u[1] + next[1]) * step;
        u = next;
        p = [p[0] + ratio * step, p[1] + step];
        if compression.is_none() {
            taken -= work.min(0.0);
            compression = (u[1] >= 0.0).then_some(p[1]);
        } else {
            given += work;
        }
        let Some(compression) = compression else { continue };
        let is_over = match strike.law {
            Restitution::Poisson => p[1] >= (1.0 + strike.restitution) * compression,
            Restitution::Stronge => given >= strike.restitution * strike.restitution * taken,
            Restitution::Newton => u[1] >= -strike.restitution * strike.before[1],
        };
        if is_over {
            return Struck { impulse: p, ending };
        }
    }
}

const LAWS: [Restitution; 3] = [Restitution::Poisson, Restitution::Stronge, Restitution::Newton];

/// Slips throughout, sticks while it closes, sticks while it opens, turns round: under each law as by small steps.
#[test]
fn every_regime_is_as_in_small_steps() {
    let eccentric = free(0.3, [0.4, -0.3]);
    let cases = [
        (free(0.6, [0.0, -1.0]), [9.0, -1.0], [0.2, 0.2], Ending::Slips),
        (free(0.6, [0.0, -1.0]), [0.3, -1.0], [0.5, 0.4], Ending::Sticks),
        (free(0.6, [0.0, -1.0]), [1.9, -1.0], [0.5, 0.4], Ending::Sticks),
        (eccentric, [-0.5, -1.0], [0.3, 0.2], Ending::Turns),
        (eccentric, [0.0, -1.0], [0.3, 0.2], Ending::Turns),
        (eccentric, [-0.4, -1.0], [0.95, 0.5], Ending::Sticks),
    ];
    for (response, before, friction, ending) in cases {
        for law in LAWS {
            let strike = Strike { law, ..strike(response, before, friction, 0.6) };
            let Ok(found) = strike.resolve() else { panic!("{strike:?}") };
            assert_eq!(found.ending, ending, "{strike:?}");
            let marched = marched(&strike, found.impulse[1]);
            assert_eq!(marched.ending, ending, "{strike:?}");
            for (own, small) in found.impulse.iter().zip(marched.impulse) {
                assert!((own - small).abs() < 1e-4, "{own} {small} {strike:?}");
            }
        }
    }
}

/// A ball that spins: with `mu (1 + e) v` enough to stop the slip (2/7 of it goes into the impulse) it leaves rolling, else it has lost
/// `mu (1 + e) v` of its speed along the floor.
#[test]
fn a_ball_bounces_with_spin() {
    // Of unit mass and radius, moment of inertia 2/5.
    let ball = [3.5, 0.0, 1.0];
    let found = strike(ball, [1.0, -2.0], [0.3, 0.3], 0.5).resolve().expect("an impact");
    assert_eq!(found.ending, Ending::Sticks);
    assert!((found.impulse[0] + 2.0 / 7.0).abs() < 1e-15 && found.impulse[1] == 3.0);
    let found = strike(ball, [7.0, -2.0], [0.3, 0.3], 0.5).resolve().expect("an impact");
    assert_eq!(found.ending, Ending::Slips);
    assert!((found.impulse[0] + 0.9).abs() < 1e-15);
}

/// For one contact whose normal push does not turn it, all three laws are one.
#[test]
fn without_coupling_the_laws_agree() {
    for law in LAWS {
        let found = Strike { law, ..strike([3.5, 0.0, 1.0], [1.0, -2.0], [0.3, 0.3], 0.5) };
        let found = found.resolve().expect("an impact");
        assert!((found.impulse[1] - 3.0).abs() < 1e-15, "{law:?}");
    }
}

/// The static coefficient alone says whether it sticks, and the kinetic one what slips.
#[test]
fn the_static_coefficient_decides_sticking() {
    let response = free(0.3, [0.4, -0.3]);
    let holds = response[1] / response[0];
    for (of_rest, ending) in [(holds * (1.0 + 1e-9), Ending::Sticks), (holds * (1.0 - 1e-9), Ending::Turns)] {
        let kinetic = 0.3;
        let strike = strike(response, [0.0, -1.0], [of_rest, kinetic], 0.0);
        let found = strike.resolve().expect("an impact");
        assert_eq!(found.ending, ending);
        let ratio = if ending == Ending::Sticks { -holds } else { -kinetic };
        assert!((found.impulse[0] - ratio * found.impulse[1]).abs() < 1e-15);
    }
}

/// A rod on a pivot that strikes with its end: steep, it is stopped and cannot leave again where `tan` of the lean is at most the
/// coefficient; flatter, it leaves with less than e.
#[test]
fn a_rod_on_a_pivot_may_jam() {
    let on_pivot = |[t, n]: [f64; 2]| [t * t, t * n, n * n];
    // Rate of the end along and out for a unit of angular velocity.
    let (steep, flat) = ([0.9, 0.3], [0.3, 0.9]);
    let found =
        strike(on_pivot(steep), steep.map(|part| -part), [0.5, 0.5], 0.8).resolve().expect("an impact");
    assert_eq!(found.ending, Ending::Jams);
    let still = after(&strike(on_pivot(steep), steep.map(|part| -part), [0.5, 0.5], 0.8), found.impulse);
    assert!(still.iter().all(|u| u.abs() < 1e-15), "{still:?}");
    let closing = strike(on_pivot(flat), flat.map(|part| -part), [0.5, 0.5], 0.8);
    let found = closing.resolve().expect("an impact");
    assert_eq!(found.ending, Ending::Turns);
    // Friction helps to stop the rod and then holds it back: (n + mu t) p_c = 1 and (n - mu t) e p_c is what it leaves with.
    let compression = 1.0 / (0.9 + 0.5 * 0.3);
    let leaves = 0.8 * compression * (0.9 - 0.5 * 0.3);
    assert!((after(&closing, found.impulse)[1] - 0.9 * leaves).abs() < 1e-15);
}

/// Kane's pendulum: Newton's law with friction that turns the slip round adds energy, and is refused with how much.
#[test]
fn newton_s_law_that_gains_energy_is_refused() {
    let gaining = (1..100).flat_map(|slip| {
        let response = free(0.29, [0.35, -0.35]);
        let before = [-0.05 * f64::from(slip), -1.0];
        LAWS.map(|law| Strike { law, ..strike(response, before, [0.3, 0.3], 1.0) })
    });
    let refused: Vec<Strike> = gaining.filter(|strike| strike.resolve().is_err()).collect();
    assert!(!refused.is_empty() && refused.iter().all(|strike| strike.law == Restitution::Newton));
    let Err(Refused::GainsEnergy(gain)) = refused[0].resolve() else { panic!("not for its energy") };
    assert!(gain > 0.0);
}

/// What no push moves cannot be struck.
#[test]
fn nothing_to_push_is_blocked() {
    assert_eq!(strike([1.0, 0.0, 0.0], [0.0, -1.0], [0.5, 0.5], 1.0).resolve(), Err(Refused::Blocked));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100_000))]

    /// Free bodies of any shape, struck anywhere: no energy is gained, the contact opens or rests, friction keeps to its cone.
    #[test]
    fn no_impact_gains_energy(
        gyration in 0.05f64..3.0,
        arm in [-2.0f64..2.0, -2.0..2.0],
        slip in -5.0f64..5.0,
        kinetic in 0.0f64..2.0,
        more in 0.0f64..1.0,
        e in 0.0f64..=1.0,
        stronge: bool,
    ) {
        let law = if stronge { Restitution::Stronge } else { Restitution::Poisson };
        let strike = strike(free(gyration, arm), [slip, -1.0], [kinetic + more, kinetic], e);
        let strike = Strike { law, ..strike };
        let found = strike.resolve().expect("a free body is pushed away");
        let (gain, size) = strike.gain(found.impulse);
        prop_assert!(gain <= ROUNDING * size, "{gain} of {size}");
        let [_, out] = after(&strike, found.impulse);
        prop_assert!(out >= -ROUNDING * size.max(1.0), "{out}");
        prop_assert!(found.impulse[0].abs() <= (kinetic + more) * found.impulse[1] * (1.0 + ROUNDING));
    }
}
