"""Steps along Taylor series that the reference scripts share."""

import mpmath as mp

PRINTED = 20


def states(series, energy, state, times, order):
    """States at the times; `series` gives the coefficients of each state about a state, `energy` what is to be kept.

    A step is so long that its last four coefficients are below the working precision.
    """
    now, found, first = mp.mpf(0), [], energy(state)
    for time in map(mp.mpf, times):
        while now < time:
            coefficients = series(state, order)
            reach = time - now
            for last in range(order - 3, order + 1):
                size = max(abs(own[last]) for own in coefficients)
                if size > 0:
                    reach = min(reach, mp.root(mp.eps / size, last))
            state = [mp.polyval(own[::-1], reach) for own in coefficients]
            now = time if reach == time - now else now + reach
        assert abs(energy(state) - first) < mp.mpf(10) ** (3 - PRINTED)
        found.append(state)
    return found


def text(value):
    """20 significant digits."""
    return mp.nstr(value, PRINTED, strip_zeros=False, min_fixed=-6, max_fixed=12)
