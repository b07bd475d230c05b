"""Bounces on a rigid floor: what each tool makes of them. Prints Markdown; name tools to have only these."""

import importlib
import sys
import warnings

from systems import ball, ball_reference, ball_rest, rod, rod_reference
from tables import error, rough, show, timed

PEERS = ["tumble", "heyoka", "scipy", "siconos", "rapier", "pymunk", "box2d", "pybullet", "mujoco"]


def cases(peers):
    """Name, setting and the function that follows a bouncer."""
    for name in peers:
        peer = importlib.import_module(f"peer_{name}")
        for label, setting in peer.SETTINGS.items():
            yield f"{peer.NAME}, {label}", lambda b, times, p=peer, s=setting: p.bounce(b, s, times)


def state(motion, time, index):
    return motion.states[time][index] if time in motion.states else None


def elastic(peers):
    """The rod with restitution 1."""
    times, body = [0.5, 1.0, 2.5, 5.0], rod(1)
    head = ["tool", *[f"height at {t:g} s, {n}" for t, n in zip(times, ("no bounce", "1 bounce", "3", "9"))]]
    rows = []
    for name, bounce in cases(peers):
        motion, spent = timed(lambda: bounce(body, times))
        heights = [error(state(motion, t, 1), rod_reference(1, t)[0]) for t in times]
        end = motion.states.get(5.0)
        lost = error(end and body.energy(end), body.energy(body.start))
        angle = error(state(motion, 1.0, 2), rod_reference(1, 1.0)[1])
        rows.append([name, *heights, angle, lost, rough(spent), motion.note])
    show("Rod, restitution 1", [*head, "angle at 1 s", "energy at 5 s", "time", ""], rows)


def lossy(peers):
    """The rod with restitution 0.7, which lies flat in the end."""
    times, body = [1.0, 2.5, 5.0], rod(0.7)
    head = ["tool", "height at 1 s, 1 bounce", "height at 2.5 s, 6", "height at 5 s, at rest", "angle at 5 s"]
    rows = []
    for name, bounce in cases(peers):
        motion, spent = timed(lambda: bounce(body, times))
        heights = [error(state(motion, t, 1), rod_reference(0.7, t)[0]) for t in times]
        angle = error(state(motion, 5.0, 2), rod_reference(0.7, 5.0)[1])
        rows.append([name, *heights, angle, rough(spent), motion.note])
    show("Rod, restitution 0.7", [*head, "time", ""], rows)


def dropped(peers):
    """The ball, which comes to rest."""
    times, body = [0.7, 1.2, 2.0], ball()
    head = ["tool", "height at 0.7 s, 1 bounce", "height at 1.2 s, 3", "height at 2 s, at rest", "time", ""]
    rows = []
    for name, bounce in cases(peers):
        motion, spent = timed(lambda: bounce(body, times))
        heights = [error(state(motion, t, 1), ball_reference(t)) for t in times]
        rows.append([name, *heights, rough(spent), motion.note])
    show(f"Ball, restitution 0.5; it rests from {ball_rest():.15g} s on", head, rows)


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    chosen = sys.argv[1:] or PEERS
    for table in (elastic, lossy, dropped):
        table(chosen)
