"""heyoka.py: Taylor's method with events; a terminal event ends a step, and its callback gives the impact."""

import math

import heyoka as hy

from systems import Motion

NAME = f"heyoka.py {hy.__version__}"
SETTINGS = {"defaults": {}}
# So many impacts are taken for a motion that does not get on.
MOST = 500


def bounce(bouncer, options, times):
    x, y, angle, vx, vy, omega = hy.make_vars("x", "y", "angle", "vx", "vy", "omega")
    slope = [(x, vx), (y, vy), (angle, omega), (vx, 0.0 * x), (vy, -bouncer.gravity + 0.0 * x), (omega, 0.0 * x)]
    motion, stopped = Motion({}, []), ""

    def impact(foot):
        def callback(taylor, _sign):
            taylor.state[:] = bouncer.bounced(foot, list(taylor.state))
            motion.bounces.append(taylor.time)
            return len(motion.bounces) < MOST

        return callback

    events = [
        hy.t_event(bouncer.gap(foot, y, angle, hy.sin), callback=impact(foot), direction=hy.event_direction.negative)
        for foot in bouncer.feet
    ]
    taylor = hy.taylor_adaptive(slope, list(bouncer.start), t_events=events, **options)
    for time in sorted({*times, bouncer.until}):
        outcome = taylor.propagate_until(time)[0]
        if outcome != hy.taylor_outcome.time_limit:
            stopped = f", stays at {taylor.time:.6f} s"
            break
        if time in times:
            motion.states[time] = tuple(taylor.state)
    motion.note = f"{len(motion.bounces)} impacts{stopped}"
    return motion


AIR = {"the term by relu": False, "its sign by an event": True}


class Functions:
    """The functions of heyoka's expressions, under the names of the module math."""

    cos, sin, sqrt = hy.cos, hy.sin, hy.sqrt

    @staticmethod
    def fabs(u):
        return hy.relu(u) + hy.relu(-u)


class Signed(Functions):
    """|u| as s u, with a sign s that an event changes where u changes its own."""

    def __init__(self):
        self.seen = []

    def fabs(self, u):
        self.seen.append(u)
        return hy.par[0] * u


def turn(taylor, sign):
    """The callback of that event: u now has the sign of its derivative."""
    taylor.pars[0] = sign
    return True


def solve(system, start, by_event):
    """The state of a motion without impacts at its end. Any length that may vanish is positive at the start."""
    variables = hy.make_vars(*[f"v{i}" for i in range(len(start))])
    functions = Signed() if by_event else Functions()
    rates = system.slope(hy.time, variables, functions)
    options = {}
    if by_event and functions.seen:
        options = {"pars": [1.0], "t_events": [hy.t_event(functions.seen[0], callback=turn)]}
    taylor = hy.taylor_adaptive(list(zip(variables, rates)), list(start), **options)
    taylor.propagate_until(system.until)
    return list(taylor.state)
