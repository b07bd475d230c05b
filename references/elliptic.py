"""Reference values of a physical pendulum, by Jacobi's elliptic functions.

A uniform rod of mass m and length L swings about its end, I = m L^2/3, without resistance:

    I theta'' = -m g (L/2) sin(theta),    w0^2 = 3 g/(2 L).

Released at rest from theta0, with k = sin(theta0/2), k' = cos(theta0/2) and u = w0 t,

    sin(theta/2) = k cn(u)/dn(u),    omega = -2 k k' w0 sn(u)/dn(u),    period = 4 K(k)/w0.

Checked here, before anything is printed: the same values with 60 digits, the energy, and for short times the
equation of motion integrated by an independent method.

Writes JSON to the standard output. Values are decimal strings of 25 significant digits.
"""

import json

import mpmath as mp

DIGITS = 40
PRINTED = 25
GRAVITY = "9.81"
LENGTH = "1"
ANGLES = [90, 150]
SECONDS = ["0.5", "1", "2", "5", "10", "100", "1000"]
PERIODS = ["0.125", "0.25", "0.5", "1", "10.125", "1000", "1000.125"]
ABOUT = (
    "Uniform rod, m = 1 kg, L = 1 m, on a pivot at its end, g = 9.81 m/s^2, no resistance, released at rest from "
    "theta0 (from the downward vertical): I theta'' = -m g (L/2) sin(theta), I = m L^2/3. SI units. g and theta0 are "
    "exact. Where 'periods' stands, t is that many periods and a double nearest to t is off by up to t/2^53: "
    "theta and omega there can be compared only to |omega| t/2^53 and |alpha| t/2^53."
)


class Pendulum:
    """One release at the current precision."""

    def __init__(self, degrees):
        half = mp.mpf(degrees) * mp.pi / 360
        self.theta0 = 2 * half
        self.k, self.k1 = mp.sin(half), mp.cos(half)
        self.w0 = mp.sqrt(3 * mp.mpf(GRAVITY) / (2 * mp.mpf(LENGTH)))
        self.period = 4 * mp.ellipk(self.k**2) / self.w0

    def at(self, t):
        """The angle and the angular velocity at the time t."""
        u = self.w0 * t
        sn, cn, dn = (mp.ellipfun(name, u, m=self.k**2) for name in ("sn", "cn", "dn"))
        return 2 * mp.asin(self.k * cn / dn), -2 * self.k * self.k1 * self.w0 * sn / dn

    def energy_defect(self, theta, omega):
        """Zero, if energy is conserved."""
        return omega**2 / 2 - self.w0**2 * (mp.cos(theta) - mp.cos(self.theta0))

    def integrated(self, t):
        """The state at the time t by mpmath's Taylor integrator."""
        right = lambda _, y: [y[1], -(self.w0**2) * mp.sin(y[0])]
        return mp.odefun(right, 0, [self.theta0, mp.mpf(0)])(t)


def text(value):
    """25 significant digits; what is zero but for rounding is 0."""
    if abs(value) < mp.mpf("1e-30"):
        return "0"
    return mp.nstr(value, PRINTED, strip_zeros=False, min_fixed=-6, max_fixed=12)


def sample(pendulum, label, number):
    """One row: the time, the angle, the angular velocity."""
    t = mp.mpf(number) if label == "seconds" else mp.mpf(number) * pendulum.period
    theta, omega = pendulum.at(t)
    assert abs(pendulum.energy_defect(theta, omega)) < mp.mpf(10) ** (-PRINTED - 5)
    row = {"t": number if label == "seconds" else text(t), "theta": text(theta), "omega": text(omega)}
    return row if label == "seconds" else {"periods": number, **row}


def release(degrees):
    """Everything about one release angle."""
    pendulum = Pendulum(degrees)
    rows = [sample(pendulum, "seconds", number) for number in SECONDS]
    rows += [sample(pendulum, "periods", number) for number in PERIODS]
    return {"theta0_degrees": str(degrees), "period": text(pendulum.period), "samples": rows}


def check_by_integration(degrees):
    """The closed form against the equation of motion at half a second."""
    with mp.workdps(20):
        pendulum = Pendulum(degrees)
        exact, integrated = pendulum.at(mp.mpf("0.5")), pendulum.integrated(mp.mpf("0.5"))
        assert all(abs(a - b) < mp.mpf(10) ** -15 for a, b in zip(exact, integrated))


def compute(digits):
    """All releases with a working precision."""
    with mp.workdps(digits):
        return [release(degrees) for degrees in ANGLES]


def main():
    for degrees in ANGLES:
        check_by_integration(degrees)
    releases = compute(DIGITS)
    assert releases == compute(DIGITS + 20), "rounding shows in the printed digits"
    print(json.dumps({"about": ABOUT, "releases": releases}, indent=1))


if __name__ == "__main__":
    main()
