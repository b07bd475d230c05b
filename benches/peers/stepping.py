"""What engines with fixed time steps have in common: step, look, step."""

from systems import Motion


def follow(bouncer, step, times, advance, state):
    """Steps to the end. `advance()` makes one step, `state()` is (x, y, angle, vx, vy, omega) of the centre.

    A bounce is a step that begins with the lowest foot going down and ends with it going up.
    """
    marks = {round(time / step): time for time in times}
    states, bounces, down = {}, [], False
    if 0 in marks:
        states[marks[0]] = state()
    for count in range(1, round(bouncer.until / step) + 1):
        advance()
        now = state()
        rate = now[4]
        if down and rate > 0:
            bounces.append(count * step)
        down = rate < 0
        if count in marks:
            states[marks[count]] = now
    return Motion(states, bounces)
