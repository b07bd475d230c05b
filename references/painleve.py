"""A rod whose foot slides ahead of it on a rough floor, by the published equations of motion up to where they end.

Genot and Brogliato, New results on Painleve paradoxes, Eur. J. Mech. A/Solids 18 (1999) 653-677. A uniform rod of half-length l at the angle q
above the floor, its foot sliding to the left with v < 0. Friction is mu N to the right, so that the foot stays on the floor where B N = A:

    A = g - l q'^2 sin q                            N m what holds the foot down, for a unit of mass
    B = 1 + 3 cos q (cos q - mu sin q)              what a unit of N does about it
    q'' = (3/l) (mu sin q - cos q) A/B              v' = mu A/B + l q'' sin q + l q'^2 cos q

In the time tau with dt = B dtau the right sides are entire functions, and the singular point A = B = 0, to which slidings are drawn, is an
equilibrium. For mu < 8/(3 sqrt 3) the foot lifts off before it, for a greater mu the point is reached, and the force grows without bound. Integrated along Taylor series in tau until the foot stops (v = 0), lifts off (A = 0 with B > 0), or is at the
singular point within the digits printed. Checked here, before anything is printed: the same with other steps, another order and more digits, and
on the way that the energy changes by the work of friction.

Writes JSON to the standard output. Values are decimal strings of 20 significant digits.
"""

import json

import mpmath as mp

from taylor import PRINTED, at, product, text

# At the singular point B is the square of A and less.
DIGITS = 70
ORDER = 24
STEP = "0.02"
ABOUT = (
    "A uniform rod of 1 kg and 1 m on a floor with friction mu, g = 9.81 m/s^2. Its foot is on the floor, the rod at the angle atan(tan) above "
    "it to the right, q' = rate and the foot's velocity speed. SI units."
)
HALF, GRAVITY = "0.5", "9.81"
CASES = {
    "stops": {"mu": "1.3", "tan": "2", "rate": "0", "speed": "-1"},
    "stops_low": {"mu": "1.5", "tan": "1.1", "rate": "0", "speed": "-1"},
    "lifts_off": {"mu": "1.4", "tan": "1.3", "rate": "2", "speed": "-10"},
    "lifts_off_late": {"mu": "1.5", "tan": "1.1", "rate": "0", "speed": "-6"},
    "singular": {"mu": "1.7", "tan": "0.9", "rate": "0", "speed": "-9"},
}


def series(state, mu, order):
    """Coefficients in tau of q, q', v, t, the work of friction, and of A and B."""
    half, gravity = mp.mpf(HALF), mp.mpf(GRAVITY)
    q, w, v, t, work = ([value] for value in state)
    sin, cos, square, a, b, turn = [mp.sin(q[0])], [mp.cos(q[0])], [], [], [], []
    for n in range(order):
        if n:
            slope = [(k + 1) * q[k + 1] for k in range(n)]
            sin.append(product(slope, cos, n - 1) / n)
            cos.append(-product(slope, sin, n - 1) / n)
        square.append(product(w, w, n))
        across = [cos[k] - mu * sin[k] for k in range(n + 1)]
        a.append((gravity if n == 0 else 0) - half * product(square, sin, n))
        b.append((1 if n == 0 else 0) + 3 * product(cos, across, n))
        turn.append(-3 / half * product(a, across, n))
        centrifugal = [product(square, cos, k) for k in range(n + 1)]
        slows = mu * a[n] + half * product(turn, sin, n) + half * product(b, centrifugal, n)
        q.append(product(b, w, n) / (n + 1))
        w.append(turn[n] / (n + 1))
        work.append(mu * product(a, v, n) / (n + 1))
        v.append(slows / (n + 1))
        t.append(b[n] / (n + 1))
    return [q, w, v, t, work], a, b


def energy(state):
    """Of a unit of mass; the foot is on the floor."""
    half, (q, w, v, _, _) = mp.mpf(HALF), state
    along, up = v - half * w * mp.sin(q), half * w * mp.cos(q)
    return (along**2 + up**2 + half**2 * w**2 / 3) / 2 + mp.mpf(GRAVITY) * half * mp.sin(q)


def ends(case, step, order):
    """How, and the state there."""
    mu = mp.mpf(case["mu"])
    state = [mp.atan(mp.mpf(case["tan"])), mp.mpf(case["rate"]), mp.mpf(case["speed"]), mp.mpf(0), mp.mpf(0)]
    first = energy(state)
    while True:
        coefficients, a, b = series(state, mu, order)
        assert abs(energy(state) - first - state[4]) < mp.mpf(10) ** (2 - PRINTED), "the balance of energy"
        if max(abs(a[0]), abs(b[0])) < mp.mpf(10) ** (-PRINTED - 2):
            return "singular", state
        for how, watched in (("stops", coefficients[2]), ("lifts_off", a)):
            if watched[0] * mp.polyval(watched[::-1], step) < 0:
                there = mp.findroot(lambda s: mp.polyval(watched[::-1], s), (0, step), solver="anderson")
                return how, at(coefficients, there)
        state = at(coefficients, step)


def values(digits, step, order):
    with mp.workdps(digits):
        found = {}
        for name, case in CASES.items():
            how, (q, w, v, t, _) = ends(case, mp.mpf(step), order)
            assert name.startswith(how), (name, how)
            found[name] = {**case, "t": text(t), "angle": text(q), "end_rate": text(w), "end_speed": text(v if how != "stops" else mp.mpf(0))}
        return found


def main():
    found = values(DIGITS, STEP, ORDER)
    again = values(DIGITS + 8, "0.013", ORDER + 6)
    for name, one in found.items():
        for key, value in one.items():
            off = abs(mp.mpf(value) - mp.mpf(again[name][key]))
            assert off < mp.mpf(10) ** (2 - PRINTED), f"the method shows in {name} {key}: {off}"
    print(json.dumps({"about": ABOUT, "cases": found}, indent=1))


if __name__ == "__main__":
    main()
