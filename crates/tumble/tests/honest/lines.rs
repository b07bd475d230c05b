//! Air along a rod that spins about a centre which drifts slowly: a sum over nodes, of what has a corner.

use super::ask::scene;

/// kg/m^2, m/s and rad/s
const DRAG: f64 = 0.5;
const DRIFT: [f64; 2] = [0.1, 0.03];
const SPIN: f64 = 20.0;
/// s
const UNTIL: f64 = 5.0;
const STEPS: usize = 20_000;

/// Integrals of |w|, of q |w| and of q^2 |w| with |w| = sqrt(a^2 + q^2), up to q.
fn integrals(a: f64, q: f64) -> [f64; 3] {
    let speed = a.hypot(q);
    let turn = if a == 0.0 { 0.0 } else { a * a * (q / a.abs()).asinh() };
    let square = (q * (2.0 * q * q + a * a) * speed - a * a * turn) / 8.0;
    [(q * speed + turn) / 2.0, speed.powi(3) / 3.0, square]
}

/// Rates of x, y, vx, vy, angle and omega of a rod of 1 m and 1 kg. In its axes the velocity at s is (a, b + omega s).
fn rates([_, _, vx, vy, angle, omega]: [f64; 6]) -> [f64; 6] {
    let (sin, cos) = angle.sin_cos();
    let (a, b) = (vx * cos + vy * sin, vy * cos - vx * sin);
    let [low, high] = [-0.5, 0.5].map(|s| integrals(a, b + omega * s));
    let [plain, first, second] = std::array::from_fn(|index| (high[index] - low[index]) / omega);
    let (along, across) = (-DRAG * a * plain, -DRAG * first);
    let torque = -DRAG * (second - b * first) / omega;
    [vx, vy, along * cos - across * sin, along * sin + across * cos, omega, 12.0 * torque]
}

/// By the classical method of Runge and Kutta.
fn end() -> [f64; 6] {
    let h = UNTIL / STEPS as f64;
    let moved = |state: [f64; 6], rate: [f64; 6], by: f64| -> [f64; 6] {
        std::array::from_fn(|index| state[index] + by * rate[index])
    };
    let mut state = [0.0, 0.0, DRIFT[0], DRIFT[1], 0.0, SPIN];
    for _ in 0..STEPS {
        let k1 = rates(state);
        let k2 = rates(moved(state, k1, h / 2.0));
        let k3 = rates(moved(state, k2, h / 2.0));
        let k4 = rates(moved(state, k3, h));
        let mean = std::array::from_fn(|i| (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]) / 6.0);
        state = moved(state, mean, h);
    }
    state
}

#[test]
fn what_the_nodes_leave_out_is_stated() {
    let spinning = format!(
        "[body.p]\nrod = {{ from = [\"-0.5 m\", 0], to = [\"0.5 m\", 0] }}\nmass = \"1 kg\"\n\
         start = {{ velocity = [\"{} m/s\", \"{} m/s\"], omega = \"{SPIN} rad/s\" }}\n\
         [drag.air]\nalong = \"p\"\nquadratic = \"{DRAG} kg/m^2\"\n",
        DRIFT[0], DRIFT[1]
    );
    let truth = end();
    let scene = scene(&spinning).until(&format!("{UNTIL} s"));
    for (accuracy, most) in [(1e-3, 2e-3), (1e-5, 2e-4)] {
        let found =
            scene.clone().accuracy(accuracy).ask(["p.x", "p.y", "p.vx", "p.vy", "p.angle", "p.omega"]);
        found.iter().zip(truth).for_each(|(found, truth)| found.is(truth, most));
    }
}

/// A rod that flies up flat turns at once along all of its length: m v' = -m g - c L v |v|.
#[test]
fn a_rod_that_turns_back_at_once_is_known_after() {
    let (g, k): (f64, f64) = (1.35e6, 0.018_12e-3 * 4.9e4 / 2.8e4);
    let (rate, fastest) = ((k * g).sqrt(), (g / k).sqrt());
    for number in 0..24 {
        let speed = 1.5e5 + 100.0 * f64::from(number);
        let thrown = format!(
            "[parameters]\nsize = \"4.9e4 m\"\nx = \"-9.97e8 m\"\nspeed = \"{speed} m/s\"\n\
             [body.p]\nrod = {{ from = [0, 0], to = [\"size\", 0] }}\nmass = \"2.8e7 g\"\n\
             start = {{ at = [\"x\", 0], velocity = [0, \"speed\"] }}\n\
             [drag.air]\nalong = \"p\"\nquadratic = \"0.01812 g/m^2\"\n"
        );
        let scene = scene(&thrown).gravity(&format!("{g} m/s^2")).until("0.224 s").accuracy(1.9e-13);
        let [found] = scene.ask(["p.vy"]);
        let up = (speed / fastest).atan() / rate;
        found.is(-fastest * (rate * (0.224 - up)).tanh(), 1e-8);
    }
}
