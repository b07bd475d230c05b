"""Reference values of an elastic pendulum: a point mass m on a massless spring of stiffness k and length L, from the origin.

    r'' = -(k/m) (1 - L/|r|) r - g e_y

Integrated along Taylor series of both coordinates; with q = r . r and p = q^(-1/2), the coefficients of p follow from
q p' = -q' p / 2. Checked here, before anything is printed: the same values with other steps, another order and more digits, and the
energy.

Writes JSON to the standard output. Values are decimal strings of 20 significant digits.
"""

import json

import mpmath as mp

from taylor import states, text

DIGITS = 34
ABOUT = (
    "A point mass of 1 kg on a spring of 40 N/m and 1 m from the origin, vertical plane, g = 9.81 m/s^2, no resistance, let go at rest at "
    "(1 m, 0.2 m) at t = 0. x to the right, y up. SI units."
)
MASS, STIFFNESS, LENGTH, GRAVITY = "1", "40", "1", "9.81"
START = ["1", "0.2", "0", "0"]
TIMES = ["1", "3", "5", "10"]


def series(state, order):
    """Coefficients of x, y, vx, vy."""
    rate, length, gravity = mp.mpf(STIFFNESS) / mp.mpf(MASS), mp.mpf(LENGTH), mp.mpf(GRAVITY)
    x, y, vx, vy = ([value] for value in state)
    q, p = [], []
    for n in range(order):
        q.append(sum(x[i] * x[n - i] + y[i] * y[n - i] for i in range(n + 1)))
        if n == 0:
            p.append(1 / mp.sqrt(q[0]))
        else:
            p.append(sum((-mp.mpf(k) / 2 - (n - k)) * q[k] * p[n - k] for k in range(1, n + 1)) / (n * q[0]))
        pull = [(1 if i == 0 else 0) - length * p[i] for i in range(n + 1)]
        ax = -rate * sum(pull[i] * x[n - i] for i in range(n + 1))
        ay = -rate * sum(pull[i] * y[n - i] for i in range(n + 1)) - (gravity if n == 0 else 0)
        x.append(vx[n] / (n + 1))
        y.append(vy[n] / (n + 1))
        vx.append(ax / (n + 1))
        vy.append(ay / (n + 1))
    return [x, y, vx, vy]


def energy(state):
    x, y, vx, vy = state
    stretch = mp.hypot(x, y) - mp.mpf(LENGTH)
    motion = mp.mpf(MASS) * (vx * vx + vy * vy) / 2
    return motion + mp.mpf(STIFFNESS) * stretch * stretch / 2 + mp.mpf(MASS) * mp.mpf(GRAVITY) * y


def samples(digits, order):
    with mp.workdps(digits):
        names = ("x", "y", "vx", "vy")
        start = [mp.mpf(value) for value in START]
        rows = zip(TIMES, states(series, energy, start, TIMES, order))
        return [{"t": time} | {name: text(value) for name, value in zip(names, state)} for time, state in rows]


def main():
    rows = samples(DIGITS, 32)
    assert rows == samples(DIGITS + 8, 44), "the method shows in the printed digits"
    print(json.dumps({"about": ABOUT, "samples": rows}, indent=1))


if __name__ == "__main__":
    main()
