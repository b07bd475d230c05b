"""Friction and rows of balls: what each tool makes of them. Prints Markdown; name tools to have only these."""

import importlib
import sys
import warnings

from stages import ROCKS, Backspin, Cradle, Resting, rocking_block, rough_reference, rough_rod
from tables import error, rough, show, timed

PEERS = ["tumble", "siconos", "rapier", "pymunk", "box2d", "pybullet", "mujoco"]
# The slip has come to an end where it is this part of what it was.
ROLLING = 1e-3


def followed(peers, stage, times):
    """Name with setting, motion and processor time of all tools that have what it takes."""
    for name in peers:
        peer = importlib.import_module(f"peer_{name}")
        for label, setting in getattr(peer, "ROUGH", peer.SETTINGS).items():
            found, spent = timed(lambda p=peer, s=setting: p.motion(stage, s, times))
            if found:
                yield f"{peer.NAME}, {label}", found, rough(spent)


def crossings(path, begin):
    """Times at which a body's angle changes its sign, between steps by a straight line."""
    before, angle = 0.0, begin[2]
    for time, state in path:
        if angle * state[2] < 0:
            yield before + (time - before) * angle / (angle - state[2])
        before, angle = time, state[2] or angle


def resting(peers):
    """A block on a slope that holds it."""
    block, rows = Resting(), []
    begin = block.stage().pieces[0].start
    for name, found, spent in followed(peers, block.stage(), [block.until / 2, block.until]):
        middle, late = (states[0] for states in found.states.values())
        crept = [error(block.creep(begin, late), 0), error(block.creep(middle, late), 0)]
        rows.append([name, *crept, error(late[2], begin[2]), spent])
    show("Block at rest on a slope", ["tool", "creep in 10 s", "in the last 5 s", "turned", "time"], rows)


def rocking(peers):
    """A block that rocks from edge to edge: the angle is zero in its impacts."""
    wanted, rows = [1, 2, 4, 8], []
    stage = rocking_block()
    for name, found, spent in followed(peers, stage, []):
        times = found.impacts or list(crossings(found.path, stage.pieces[0].start))
        cells = [error(times[n - 1] if n <= len(times) else None, ROCKS[n - 1]) for n in wanted]
        rows.append([name, *cells, spent])
    show("Rocking block", ["tool", *[f"time of impact {n}" for n in wanted], "time"], rows)


def backspin(peers):
    """A ball that comes back."""
    ball, rows = Backspin(), []
    stage = ball.stage()
    for name, found, spent in followed(peers, stage, [4.0, 8.0]):
        rolls, truly = found.events.get("floor.body0.rim.rolls"), ball.rolls()
        if found.path:
            slip = ROLLING * ball.slip(stage.pieces[0].start)
            rolls = next((time for time, state in found.path if abs(ball.slip(state)) < slip), None)
            # The slip falls evenly.
            truly *= 1 - ROLLING
        state = found.states[8.0][0]
        home = ball.rolling() * (8.0 - ball.home())
        row = [error(rolls, truly), error(found.states[4.0][0][3], ball.rolling()), error(state[0], home)]
        rows.append([name, *row, spent])
    head = ["tool", "time of rolling", "speed at 4 s", "place at 8 s", "time"]
    title = f"Backspin: rolls from {ball.rolls():.6g} s on with {ball.rolling():.6g} m/s, home at {ball.home():.6g} s"
    show(title, head, rows)


def cradle(peers):
    """Five balls."""
    row, swings, rows = Cradle(), [1, 2, Cradle.swings], []
    times = [count * row.half() for count in swings]
    for name, found, spent in followed(peers, row.stage(), times):
        cells = []
        for count, states in zip(swings, found.states.values()):
            off = [abs(ball[2] - angle) for ball, angle in zip(states, row.angles(count))]
            cells.append(error(max(off), 0))
        rows.append([name, *cells, spent])
    head = ["tool", *[f"angles after {count} half periods" for count in swings], "time"]
    show("Newton's cradle, five balls", head, rows)


def floor(peers):
    """Rods that bounce on a rough floor. One slips forward in all impacts; of the other the second impact turns the slip round."""
    times, rows = [1.0, 2.0, 2.5], []
    turning = followed(peers, rough_rod(2.0, 2.0), times)
    for (name, found, spent), (_, turned, _) in zip(followed(peers, rough_rod(5.0, -2.0), times), turning):
        cells = []
        for time in times:
            (x, y, angle, *_), truth = found.states[time][0], rough_reference("slips", time)
            cells += [error(x, truth[0]), error(y, truth[1])] if time != 2.0 else [error(angle, truth[2])]
        cells += [error(turned.states[time][0][1], rough_reference("turns", time)[1]) for time in (1.0, 2.0)]
        rows.append([name, *cells, spent])
    head = ["x at 1 s", "height at 1 s", "angle at 2 s", "x at 2.5 s", "height at 2.5 s", "other rod: height at 1 s", "at 2 s"]
    show("Rods on a rough floor, restitution 0.7, friction 0.1", ["tool", *head, "time"], rows)


TABLES = {"resting": resting, "rocking": rocking, "backspin": backspin, "cradle": cradle, "floor": floor}

if __name__ == "__main__":
    warnings.simplefilter("ignore")
    chosen = [name for name in sys.argv[1:] if name not in TABLES] or PEERS
    for name, table in TABLES.items():
        if name in sys.argv[1:] or not set(TABLES) & set(sys.argv[1:]):
            table(chosen)
