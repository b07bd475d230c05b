"""Motions in air, without impacts: errors at the end. Prints Markdown."""

import peer_heyoka
import peer_scipy
import peer_tumble
from systems import ThrownRod, WindPendulum
from tables import error, rough, show, timed

PERIODS = [0.5, 1.0, 2.0, 4.0]


def pendulums():
    """Name and the function that gives the final state of a pendulum."""
    for label, accuracy in peer_tumble.SETTINGS.items():
        yield f"{peer_tumble.NAME}, {label}", lambda s, a=accuracy: peer_tumble.pendulum(s, a)
    for peer in (peer_heyoka, peer_scipy):
        for label, options in peer.AIR.items():
            yield f"{peer.NAME}, {label}", lambda s, p=peer, o=options: p.solve(s, (0.0, 0.0), o)


def throws():
    """Name and the function that gives the final state of a thrown rod."""
    for label, accuracy in peer_tumble.SETTINGS.items():
        yield f"{peer_tumble.NAME}, {label}", lambda s, a=accuracy: peer_tumble.thrown(s, a)
    yield f"{peer_heyoka.NAME}, defaults", lambda s: peer_heyoka.solve(s, s.start, False)
    for label, options in peer_scipy.AIR.items():
        yield f"{peer_scipy.NAME}, {label}", lambda s, o=options: peer_scipy.solve(s, s.start, o)


def pendulum_table():
    rows = []
    for name, solve in pendulums():
        found = [timed(lambda: solve(WindPendulum(period))) for period in PERIODS]
        angles = [error(end[0], WindPendulum(period).reference()[0]) for (end, _), period in zip(found, PERIODS)]
        rows.append([name, *angles, rough(sum(spent for _, spent in found) / len(found))])
    head = ["tool", *[f"gusts every {period:g} s" for period in PERIODS], "time of a run"]
    show("Pendulum in the wind: error of the angle at 20 s, rad", head, rows)


def throw_table():
    system, rows = ThrownRod(), []
    x, y, _, _, angle, omega = system.reference()
    for name, solve in throws():
        end, spent = timed(lambda: solve(system))
        errors = [error(found, expected) for found, expected in zip((*end[:2], *end[4:]), (x, y, angle, omega))]
        rows.append([name, *errors, rough(spent)])
    show("Thrown rod in air: errors at 1.2 s", ["tool", "X, m", "Y, m", "angle, rad", "omega, rad/s", "time"], rows)


if __name__ == "__main__":
    pendulum_table()
    throw_table()
