"""scipy.integrate.solve_ivp: flights that end at an event, then the impact by the law of Newton, then the next flight."""

import scipy
from scipy.integrate import solve_ivp

from systems import Motion

NAME = f"SciPy {scipy.__version__}"
TIGHT = {"rtol": 1e-12, "atol": 1e-12}
SETTINGS = {
    "solve_ivp, defaults": {},
    "solve_ivp, DOP853, 1e-12": {"method": "DOP853", **TIGHT},
    "solve_ivp, DOP853, 1e-12, steps up to 10 ms": {"method": "DOP853", **TIGHT, "max_step": 0.01},
}
# So many impacts are taken for a motion that does not get on.
MOST = 500


def touch(bouncer, foot):
    """The event in which a foot that comes down reaches the floor."""

    def gap(_time, state):
        return bouncer.gap(foot, state[1], state[2])

    gap.terminal, gap.direction = True, -1
    return gap


def bounce(bouncer, options, times):
    events = [touch(bouncer, foot) for foot in bouncer.feet]
    motion, now, state, wanted = Motion({}, []), 0.0, list(bouncer.start), sorted(times)

    def slope(_time, s):
        return [s[3], s[4], s[5], 0.0, -bouncer.gravity, 0.0]

    while now < bouncer.until and len(motion.bounces) < MOST:
        flight = solve_ivp(slope, (now, bouncer.until), state, events=events, dense_output=True, **options)
        while wanted and wanted[0] <= flight.t[-1]:
            time = wanted.pop(0)
            motion.states[time] = tuple(flight.sol(time))
        now, state = flight.t[-1], list(flight.y[:, -1])
        struck = [foot for foot, found in zip(bouncer.feet, flight.t_events) if len(found)]
        for foot in struck:
            state = bouncer.bounced(foot, state)
            motion.bounces.append(now)
    motion.note = f"{len(motion.bounces)} impacts" if now == bouncer.until else f"stays at {now:.6f} s"
    return motion


AIR = {
    "solve_ivp, defaults": {},
    "solve_ivp, RK45, 1e-9": {"rtol": 1e-9, "atol": 1e-9},
    "solve_ivp, RK45, 1e-12": TIGHT,
    "solve_ivp, DOP853, 1e-12": {"method": "DOP853", **TIGHT},
    "solve_ivp, LSODA, 1e-12": {"method": "LSODA", **TIGHT},
}


def solve(system, start, options):
    """The state of a motion without impacts at its end."""
    return list(solve_ivp(system.slope, (0.0, system.until), start, **options).y[:, -1])
