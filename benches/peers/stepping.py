"""What engines with fixed time steps have in common: step, look, step."""

from stages import Piece, Stage
from systems import Motion


def staged(bouncer):
    """A body that bounces, for engines."""
    piece = Piece(bouncer.mass, bouncer.inertia, bouncer.start, bouncer.radius, bouncer.feet)
    floor, gravity = bouncer.floor, bouncer.gravity
    return Stage((piece,), bouncer.until, gravity, floor=floor, restitution=bouncer.restitution)


def bouncing(motion):
    """An engine's `bounce` by its `motion`: of one body, whose states are told alone."""

    def bounce(bouncer, setting, times):
        found = motion(staged(bouncer), setting, times)
        return Motion({time: states[0] for time, states in found.states.items()}, note=found.note, spent=found.spent)

    return bounce


def follow(stage, step, times, advance, states):
    """Steps to the end. `advance()` makes one step, `states()` are those of all bodies.

    Told are the states at the times and, as `path`, after every step those of the first body.
    """
    marks = {round(time / step): time for time in times}
    found, path = {marks[0]: states()} if 0 in marks else {}, []
    for count in range(1, round(stage.until / step) + 1):
        advance()
        now = states()
        path.append((count * step, now[0]))
        if count in marks:
            found[marks[count]] = now
    return Motion(found, path=path)
