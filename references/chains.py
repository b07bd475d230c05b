"""Reference values of chains of links in a plane, by Lagrange's equations in the angles of the links.

n equal links hang one below the other from the origin, theta_i is the angle of link i from the downward vertical, counted from
0, counter-clockwise. With c_ij = n - 1 - max(i, j) + 1/2 for uniform rods of mass m and length L, c_ii = n - 1 - i + 1/3, and with
c_ij = n - max(i, j) for masses m at the lower ends of massless links,

    sum_j c_ij (cos(theta_i - theta_j) theta_j'' + sin(theta_i - theta_j) theta_j'^2) = -(g/L) w_i sin(theta_i)

where w_i is n - 1 - i + 1/2 for rods and n - i for masses. The mass does not matter.

Integrated along Taylor series in the angles, with the coefficients of sines and cosines from those of the rates. Checked here,
before anything is printed: the same values with other steps, another order and more digits, the energy, and the values of the
double pendulum of two masses that others have published.

Writes JSON to the standard output. Values are decimal strings of 20 significant digits.
"""

import json

import mpmath as mp

from taylor import product, states, text

DIGITS = 34
GRAVITY = "9.81"
ABOUT = (
    "Links of 1 m and 1 kg in a vertical plane, pinned to each other and the first to the origin, g = 9.81 m/s^2, no resistance, "
    "released at rest at t = 0. Angles from the downward vertical, counter-clockwise, not wrapped. SI units."
)
# The angles at which a chain of uniform links hangs at rest between two places of one height: with H the pull along x and half
# the links left of the middle, tan(theta_i - 90 deg) = (i - (n - 1)/2) m g/H.
SAG = 4
CHAINS = [
    # name, links, kind, angles at the start, times
    ("double pendulum of masses", 2, "masses", ["90 deg", "90 deg"], ["1", "5", "10"]),
    ("double pendulum of rods", 2, "rods", ["90 deg", "90 deg"], ["1", "3", "5"]),
    ("five rods released flat", 5, "rods", ["90 deg"] * 5, ["0.5", "1", "1.5", "2"]),
    ("hanging chain let go", 6, "rods", "hanging", ["0.25", "0.5", "0.75", "1"]),
]
# The double pendulum of two masses at 10 s, wrapped into (-pi, pi].
PUBLISHED = ["-0.56847466401595018878", "-0.52639372793240469833"]


class Chain:
    """A chain at the current precision."""

    def __init__(self, links, kind):
        self.links, self.kind = links, kind
        self.g = mp.mpf(GRAVITY)
        index = range(links)
        rods = kind == "rods"

        def shared(i, j):
            below = links - 1 - max(i, j)
            if not rods:
                return mp.mpf(below + 1)
            return below + (mp.mpf(1) / 3 if i == j else mp.mpf(1) / 2)

        self.c = [[shared(i, j) for j in index] for i in index]
        self.w = [(links - 1 - i + mp.mpf(1) / 2) if rods else mp.mpf(links - i) for i in index]

    def start(self, angles):
        """The state at the start: angles and rates."""
        if angles == "hanging":
            middle = mp.mpf(self.links - 1) / 2
            angles = [mp.pi / 2 + mp.atan((i - middle) * SAG) for i in range(self.links)]
        else:
            angles = [mp.mpf(angle.split()[0]) * mp.pi / 180 for angle in angles]
        return angles + [mp.mpf(0)] * self.links

    def series(self, state, order):
        """Taylor coefficients of angles and rates, up to an order."""
        n, index = self.links, range(self.links)
        angle, rate, turning = [[v] for v in state[:n]], [[v] for v in state[n:]], [[] for _ in index]
        pairs = [(i, j) for i in index for j in index if i < j]
        own = [Wave(angle[i], rate[i]) for i in index]
        apart = {(i, j): [x - y for x, y in zip(rate[i], rate[j])] for i, j in pairs}
        both = {(i, j): Wave([angle[i][0] - angle[j][0]], apart[i, j]) for i, j in pairs}
        square = [[v * v] for v in state[n:]]
        matrix = [[self.c[i][j] * (1 if i == j else both[min(i, j), max(i, j)].cosine[0]) for j in index] for i in index]
        for k in range(order):
            right = []
            for i in index:
                rest = -self.g * self.w[i] * own[i].sine[k]
                for j in index:
                    if i != j:
                        wave, sign = both[min(i, j), max(i, j)], 1 if i < j else -1
                        rest -= self.c[i][j] * sum(wave.cosine[l] * turning[j][k - l] for l in range(1, k + 1))
                        rest -= self.c[i][j] * sign * product(wave.sine, square[j], k)
                right.append(rest)
            for i, value in enumerate(solved(matrix, right)):
                turning[i].append(value)
                angle[i].append(rate[i][k] / (k + 1))
                rate[i].append(value / (k + 1))
            for i in index:
                own[i].extend(k + 1)
                square[i].append(product(rate[i], rate[i], k + 1))
            for i, j in pairs:
                apart[i, j].append(rate[i][k + 1] - rate[j][k + 1])
                both[i, j].extend(k + 1)
        return angle + rate

    def energy(self, state):
        """In units of m L^2/s^2."""
        n = self.links
        both = [(i, j) for i in range(n) for j in range(n)]
        moving = sum(self.c[i][j] * mp.cos(state[i] - state[j]) * state[n + i] * state[n + j] for i, j in both)
        return moving / 2 - self.g * sum(self.w[i] * mp.cos(state[i]) for i in range(n))


class Wave:
    """Taylor coefficients of sine and cosine of an angle, from those of its rate, which are added to elsewhere."""

    def __init__(self, angle, rate):
        self.rate = rate
        self.cosine, self.sine = ([value] for value in mp.cos_sin(angle[0]))

    def extend(self, k):
        """The coefficients of order k."""
        cosine = -product(self.sine, self.rate, k - 1) / k
        sine = product(self.cosine, self.rate, k - 1) / k
        self.cosine.append(cosine)
        self.sine.append(sine)


def solved(matrix, right):
    """The solution of equations with a positive definite matrix, by elimination."""
    n = len(right)
    matrix, right = [list(row) for row in matrix], list(right)
    for k in range(n):
        for i in range(k + 1, n):
            factor = matrix[i][k] / matrix[k][k]
            for j in range(k + 1, n):
                matrix[i][j] -= factor * matrix[k][j]
            right[i] -= factor * right[k]
    found = [mp.mpf(0)] * n
    for i in reversed(range(n)):
        rest = right[i] - sum(matrix[i][j] * found[j] for j in range(i + 1, n))
        found[i] = rest / matrix[i][i]
    return found


def motion(links, kind, angles, times, how):
    """Rows of one chain."""
    digits, order = how
    with mp.workdps(digits):
        chain = Chain(links, kind)
        start = chain.start(angles)
        rows = []
        for time, state in zip(times, states(chain.series, chain.energy, start, times, order)):
            rows.append({"t": time, "theta": [text(v) for v in state[:links]], "omega": [text(v) for v in state[links:]]})
        return rows, [text(angle) for angle in start[:links]]


def check_published(rows):
    """The masses' double pendulum at its last time."""
    for found, known in zip(rows[-1]["theta"], PUBLISHED):
        turns = mp.nint(mp.mpf(found) / (2 * mp.pi))
        assert abs(mp.mpf(found) - 2 * mp.pi * turns - mp.mpf(known)) < mp.mpf(10) ** -17, (found, known)


def main():
    mp.mp.dps = DIGITS
    chains = []
    for name, links, kind, angles, times in CHAINS:
        rows, start = motion(links, kind, angles, times, (DIGITS, 32))
        again, _ = motion(links, kind, angles, times, (DIGITS + 8, 44))
        assert rows == again, f"{name}: the method shows in the printed digits"
        if kind == "masses":
            check_published(rows)
        chains.append({"name": name, "links": links, "kind": kind, "start": start, "samples": rows})
    print(json.dumps({"about": ABOUT, "chains": chains}, indent=1))


if __name__ == "__main__":
    main()
