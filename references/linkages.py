"""Periods of four-bar linkages, by quadrature over their one coordinate.

A crank of length a turns about the origin, a rocker of length c about (d, 0), and a coupler of length b joins their ends; all are
uniform bars of one mass per length rho. With u the angle of the crank, I(u) the moment of inertia that it seems to have and U(u) the
potential energy of all bars, the energy E = I(u) u'^2/2 + U(u) is constant, so that

    T = 2 integral from u_0 to u_1 of sqrt(I(u)/(2 (E - U(u)))) du        between two turning points,
    T = integral over a turn of sqrt(I(u)/(2 E)) du                       of a crank that goes round on a smooth table.

The first becomes smooth by u = (u_0 + u_1)/2 + (u_1 - u_0)/2 sin(s). Checked here: the same with more digits and other panels.

Writes JSON to the standard output. Values are decimal strings of 20 significant digits.
"""

import json

import mpmath as mp

DIGITS = 40
PRINTED = 20
PANELS = 16
ABOUT = (
    "Four-bar linkage of uniform bars, a = 0.2 m, b = 0.5 m, c = 0.4 m, d = 0.5 m, 2 kg/m, g = 9.81 m/s^2 along -y. Swinging: released at rest "
    "at the crank's angle `start`. Turning: on a smooth table, with an angular impulse of 0.6 N m s on the crank at that angle. "
    "SI units."
)
START = "1.3603121848197697"
# About where it turns back.
TURNS_NEAR = "-4.66"


class Linkage:
    """The linkage at the current precision."""

    def __init__(self):
        self.a, self.b, self.c, self.d = (mp.mpf(x) for x in ["0.2", "0.5", "0.4", "0.5"])
        self.rho, self.g = mp.mpf(2), mp.mpf("9.81")

    def angles(self, u):
        """Of rocker and coupler."""
        a, b, c, d = self.a, self.b, self.c, self.d
        reach = mp.sqrt(a * a + d * d - 2 * a * d * mp.cos(u))
        rocker = mp.pi - mp.atan(a * mp.sin(u) / (d - a * mp.cos(u)))
        rocker -= mp.acos((reach**2 + c * c - b * b) / (2 * c * reach))
        return rocker, mp.atan2(c * mp.sin(rocker) - a * mp.sin(u), d + c * mp.cos(rocker) - a * mp.cos(u))

    def potential(self, u):
        """J"""
        rocker, coupler = self.angles(u)
        a, b, c = self.a, self.b, self.c
        high = a * a / 2 * mp.sin(u) + b * (a * mp.sin(u) + b / 2 * mp.sin(coupler)) + c * c / 2 * mp.sin(rocker)
        return self.g * self.rho * high

    def inertia(self, u):
        """kg m^2"""
        rocker, coupler = self.angles(u)
        a, b, c, rho = self.a, self.b, self.c, self.rho
        of_coupler = a * mp.sin(rocker - u) / (b * mp.sin(coupler - rocker))
        of_rocker = a * mp.sin(coupler - u) / (c * mp.sin(coupler - rocker))
        middle = a * a + (b / 2 * of_coupler) ** 2 + a * b * of_coupler * mp.cos(coupler - u)
        return rho * (a**3 / 3 + b * middle + b**3 / 12 * of_coupler**2 + c**3 / 3 * of_rocker**2)

    def swinging(self, panels):
        """Period, and the crank's angle at the other end."""
        first = mp.mpf(START)
        energy = self.potential(first)
        other = mp.findroot(lambda u: self.potential(u) - energy, mp.mpf(TURNS_NEAR))
        middle, half = (first + other) / 2, abs(other - first) / 2

        def rate(s):
            u = middle + half * mp.sin(s)
            return half * mp.cos(s) * mp.sqrt(self.inertia(u) / (2 * abs(energy - self.potential(u))))

        # Gauss's nodes keep away from the ends, where both differences are next to nothing.
        return 2 * integral(rate, -mp.pi / 2, mp.pi / 2, panels), other

    def turning(self, panels):
        """Period of a turn."""
        energy = mp.mpf("0.6") ** 2 / (2 * self.inertia(mp.mpf(START)))
        return integral(lambda u: mp.sqrt(self.inertia(u) / (2 * energy)), 0, 2 * mp.pi, panels)


def integral(function, first, last, panels):
    """By Gauss and Legendre."""
    return mp.quad(function, mp.linspace(first, last, panels + 1), method="gauss-legendre")


def values(digits, panels):
    """All of them, as they are printed."""
    with mp.workdps(digits):
        linkage = Linkage()
        period, other = linkage.swinging(panels)
        found = {"swinging": period, "turns_back_at": other, "turning": linkage.turning(panels)}
        return {name: mp.nstr(value, PRINTED, strip_zeros=False) for name, value in found.items()}


def main():
    found = values(DIGITS, PANELS)
    assert found == values(DIGITS + 10, PANELS * 3 // 2), "the method shows in the printed digits"
    print(json.dumps({"about": ABOUT, "start": START, **found}, indent=1))


if __name__ == "__main__":
    main()
