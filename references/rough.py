"""Two bodies that strike a rough floor, from event to event.

The rod of scenes/21-rough-floor, with round ends of the radius r: between impacts it flies freely; the end that comes to the floor first is found by steps that are
small against the turning, then by Newton's method. In an impact the velocities of the end change in proportion to the impulse p along the
normal while its state of slip lasts, dv = K (f, 1) dp with K its inverse mass matrix and f the friction for a unit of p. It slips with
f = -mu sign(s); at s = 0 it sticks with f = -K_tn/K_tt if that is at most mu, or else is driven to slip towards sign(K_tn). Compression ends where the normal
speed is zero, restitution when e times its impulse is given back (Poisson).

A block that rocks, of scenes/27-rocking-block, without bouncing or slipping (Housner, Bull. Seism. Soc. Am. 53, 1963): about an edge
q'^2 = q0'^2 - (3 g/(2 R)) (cos(alpha - q) - cos(alpha)), so that the time of a half rocking is an integral over the angle; an impact leaves
the part 1 - 3/2 sin^2(alpha) of the rate.

Checked here, before anything is printed: the same with other steps and more digits.

Writes JSON to the standard output. Values are decimal strings of 20 significant digits.
"""

import json

import mpmath as mp

from taylor import PRINTED, text

DIGITS = 40
ABOUT = (
    "Rod: 0.5 kg, 1 m between the centres of its ends of 0.05 m radius, inertia of a thin rod, centre at (0, 2.05 m) with velocity (vx, 0), angle 0.6 rad and rate omega: 2 m/s and 2 rad/s, where impacts turn the slip round, 5 m/s and -2 rad/s, where none does; floor at y = 0, restitution 0.7, friction 0.1. "
    "States are x, y, vx, vy, angle, omega of the centre; `slip` is that as an impact ends. Block: half-width 0.1 m, half-height 0.4 m, let go at half its critical angle. "
    "g = 9.81 m/s^2. SI units."
)
GRAVITY = "9.81"
TIMES = ["1", "2", "2.5"]
IMPACTS = 8
RODS = {"turns": ("2", "2"), "slips": ("5", "-2")}


class Rod:
    def __init__(self, speed, rate):
        self.mass, self.half, self.radius = mp.mpf("0.5"), mp.mpf("0.5"), mp.mpf("0.05")
        self.inertia = self.mass * self.half**2 / 3
        self.friction, self.restitution, self.gravity = mp.mpf("0.1"), mp.mpf("0.7"), mp.mpf(GRAVITY)
        self.state = [mp.mpf(one) for one in ("0", "2.05", speed, "0", "0.6", rate)]
        self.time, self.impacts = mp.mpf(0), []

    def flown(self, span):
        x, y, vx, vy, angle, omega = self.state
        fallen = self.gravity * span
        return [x + vx * span, y + (vy - fallen / 2) * span, vx, vy - fallen, angle + omega * span, omega]

    def gap(self, end, span):
        _, y, _, _, angle, _ = self.flown(span)
        return y + end * self.half * mp.sin(angle) - self.radius

    def next(self, most, step):
        """Time to the next impact and its end, or `most` and none."""
        begin = mp.mpf(0)
        while begin < most:
            upto = min(begin + step, most)
            # An end that has just struck is at the floor and leaves it.
            closed = [end for end in (-1, 1) if self.gap(end, upto) < 0]
            if closed:
                whens = [(mp.findroot(lambda s, e=end: self.gap(e, s), (begin + upto) / 2), end) for end in closed]
                return min(whens)
            begin = upto
        return most, 0

    def struck(self, end):
        x, y, vx, vy, angle, omega = self.state
        rx, ry = end * self.half * mp.cos(angle), end * self.half * mp.sin(angle) - self.radius
        tt, nn = 1 / self.mass + ry**2 / self.inertia, 1 / self.mass + rx**2 / self.inertia
        tn = -rx * ry / self.inertia
        along, across, slip = impulse([vx - omega * ry, vy + omega * rx], [tt, tn, nn], self.friction, self.restitution)
        turned = omega + (rx * across - ry * along) / self.inertia
        self.state = [x, y, vx + along / self.mass, vy + across / self.mass, angle, turned]
        return slip

    def follow(self, time, step):
        """To a time."""
        while self.time < time:
            span, end = self.next(time - self.time, step)
            self.state, self.time = self.flown(span), self.time + span if end else time
            if end:
                self.impacts.append({"t": self.time, "end": end, "slip": self.struck(end)})
        return self.state


def impulse(speeds, response, friction, restitution):
    """Along and across the floor, and the sign of the slip that is left: from one change of slip to the next."""
    (s, n), (tt, tn, nn), (along, across) = speeds, response, (mp.mpf(0), mp.mpf(0))
    last = None  # the impulse at which the impact ends, once compression is over
    while last is None or across < last:
        sticks = s == 0 and abs(tn) <= friction * tt
        f = -tn / tt if sticks else -friction * mp.sign(s if s else tn)
        ds, dn = (mp.mpf(0) if sticks else tt * f + tn), tn * f + nn
        ends = [-s / ds] if ds * s < 0 else []
        ends += [-n / dn] if last is None else [last - across]
        step = min(one for one in ends if one > 0)
        stops = bool(ds * s < 0) and step == ends[0]
        s, n = mp.mpf(0) if stops else s + ds * step, n + dn * step
        along, across = along + f * step, across + step
        if last is None and step == ends[-1]:
            last = (1 + restitution) * across
    return along, across, int(mp.sign(s))


def rod(step, start):
    body, states = Rod(*start), {}
    for time in TIMES:
        states[time] = [text(one) for one in body.follow(mp.mpf(time), step)]
    impacts = [{**one, "t": text(one["t"])} for one in body.impacts]
    return {"states": states, "impacts": impacts}


def block(panels):
    """Times of impacts, and the rates after them, turned from one edge to the other."""
    gravity, wide, high = mp.mpf(GRAVITY), mp.mpf("0.1"), mp.mpf("0.4")
    alpha, pull = mp.atan(wide / high), 3 * gravity / (2 * mp.hypot(wide, high))
    ratio = 1 - 3 * mp.sin(alpha) ** 2 / 2
    top, when, impacts = alpha / 2, mp.mpf(0), []

    def falls(top):
        """From its highest angle down to the floor; q = top (1 - s^2) takes the root away."""

        def slowness(s):
            q = top * (1 - s * s)
            lost = 2 * mp.sin((top - q) / 2) * mp.sin(alpha - (top + q) / 2)
            return 2 * top * s / mp.sqrt(pull * lost)

        return mp.quad(slowness, mp.linspace(0, 1, panels + 1), method="gauss-legendre")

    rate = mp.sqrt(pull * (mp.cos(alpha - top) - mp.cos(alpha)))
    when = falls(top)
    for count in range(IMPACTS):
        rate *= ratio
        impacts.append({"t": text(when), "rate": text(rate if count % 2 else -rate)})
        top = alpha - mp.acos(mp.cos(alpha) + rate**2 / pull)
        when += 2 * falls(top)
    return {"impacts": impacts}


def values(digits, step, panels):
    with mp.workdps(digits):
        rods = {name: rod(mp.mpf(step), start) for name, start in RODS.items()}
        return {"rods": rods, "block": block(panels)}


def main():
    found = values(DIGITS, "1e-3", 4)
    assert found == values(DIGITS + 10, "6e-4", 7), "the method shows in the printed digits"
    print(json.dumps({"about": ABOUT, **found}, indent=1))


if __name__ == "__main__":
    main()
