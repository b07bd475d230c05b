"""A rod on a pin with dry friction that reads the pin's own force, until it stands still.

A uniform rod of mass m and length L hangs from its end, theta from the downward vertical. The pin's torque on it is -a |R| against its rate, with
R the force of the pin and a the friction times the pin's radius. With s the sign of the rate, along the rod and across it,

    R_n = m (L/2 theta'^2 + g cos theta)        R_t = m (L/2 theta'' + g sin theta)
    (m L^2/3) theta'' = -m g (L/2) sin theta - s a |R|

so that |R| is the positive root of a quadratic, with m = L = 1: (1 - 9 a^2/4) R^2 + (3/4) s a g sin(theta) R - (g sin(theta)/4)^2 - R_n^2 = 0.
Where the rate comes to zero R is the weight if the rod stays, which it does if g/2 |sin theta| is at most a g.

Integrated along Taylor series, turn by turn. Checked here, before anything is printed: that R is the force of the motion that it makes, the energy
with the work of friction, and the same with more digits and another order, and so other steps.

Writes JSON to the standard output. Values are decimal strings of 20 significant digits.
"""

import json

import mpmath as mp

from taylor import PRINTED, at, product, step, text

DIGITS = 32
ORDER = 24
# s, of steps
MOST = "0.1"
GRAVITY = "9.81"
ABOUT = (
    "A uniform rod of 1 kg and 1 m on a pin at its end, g = 9.81 m/s^2, whose friction has the torque arm |R| with R the force of the pin. It starts "
    "at the angle (from the downward vertical) with the rate; turns are when its rate comes to zero and where, the last of them for good. SI units."
)
CASES = {
    "decays": {"arm": "0.02", "angle": "1.2", "rate": "0"},
    "soon": {"arm": "0.1", "angle": "2.5", "rate": "0"},
    "turns_over": {"arm": "0.03", "angle": "0.25", "rate": "12"},
}


def root(square, n, known):
    """Coefficient n of the square root of a series, of which those before are known."""
    if n == 0:
        return mp.sqrt(square[0])
    return (square[n] - mp.fdot(known[1:n], known[n - 1 : 0 : -1])) / (2 * known[0])


def series(state, arm, sign, order):
    """Coefficients in t of theta, its rate and the work of friction, and the force of the pin."""
    gravity = mp.mpf(GRAVITY)
    q, w, work = ([value] for value in state)
    sin, cos, linear, inner, roots, force = [mp.sin(q[0])], [mp.cos(q[0])], [], [], [], []
    whole = 1 - 9 * arm**2 / 4
    along = []
    for n in range(order):
        if n:
            slope = [(k + 1) * q[k + 1] for k in range(n)]
            sin.append(product(slope, cos, n - 1) / n)
            cos.append(-product(slope, sin, n - 1) / n)
        along.append(product(w, w, n) / 2 + gravity * cos[n])
        linear.append(sign * arm * gravity * sin[n] * 3 / 8)
        square = gravity**2 * product(sin, sin, n) / 16 + product(along, along, n)
        inner.append(product(linear, linear, n) + whole * square)
        roots.append(root(inner, n, roots))
        force.append((roots[n] - linear[n]) / whole)
        q.append(w[n] / (n + 1))
        w.append(3 * (-gravity * sin[n] / 2 - sign * arm * force[n]) / (n + 1))
        work.append(-sign * arm * product(force, w, n) / (n + 1))
    across = w[1] / 2 + gravity * sin[0]
    assert abs(force[0] - mp.hypot(along[0], across)) < mp.mpf(10) ** (-PRINTED), "the force is that of the motion"
    return [q, w, work]


def energy(state):
    q, w, work = state
    return w**2 / 6 - mp.mpf(GRAVITY) * mp.cos(q) / 2 - work


def turn(state, arm, order):
    """From a rate, or from rest where it does not stay, to where the rate is zero: how long, and the state there."""
    sign = mp.sign(state[1]) or -mp.sign(mp.sin(state[0]))
    first, now = energy(state), mp.mpf(0)
    while True:
        coefficients = series(state, arm, sign, order)
        assert abs(energy(state) - first) < mp.mpf(10) ** (2 - PRINTED), "the balance of energy"
        reach = step(coefficients, order, mp.mpf(MOST))
        rate = coefficients[1][::-1]
        if sign * mp.polyval(rate, reach) <= 0:
            there = mp.findroot(lambda s: mp.polyval(rate, s), (reach / 1024, reach), solver="anderson")
            q, _, work = at(coefficients, there)
            return now + there, [q, mp.mpf(0), work]
        state, now = at(coefficients, reach), now + reach


def turns(case, order):
    arm = mp.mpf(case["arm"])
    state, now, found = [mp.mpf(case["angle"]), mp.mpf(case["rate"]), mp.mpf(0)], mp.mpf(0), []
    while state[1] != 0 or abs(mp.sin(state[0])) > 2 * arm:
        time, state = turn(state, arm, order)
        now += time
        found.append({"t": text(now), "angle": text(state[0]), "work": text(state[2])})
    return found


def values(digits, order):
    with mp.workdps(digits):
        return {name: {**case, "turns": turns(case, order)} for name, case in CASES.items()}


def main():
    found = values(DIGITS, ORDER)
    assert found == values(DIGITS + 8, ORDER + 6), "the method shows in the printed digits"
    print(json.dumps({"about": ABOUT, "cases": found}, indent=1))


if __name__ == "__main__":
    main()
