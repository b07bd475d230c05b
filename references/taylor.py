"""Steps along Taylor series that the reference scripts share."""

import mpmath as mp

PRINTED = 20


def states(series, energy, state, times, order):
    """States at the times; `series` gives the coefficients of each state about a state, `energy` what is to be kept."""
    now, found, first = mp.mpf(0), [], energy(state)
    for time in map(mp.mpf, times):
        while now < time:
            coefficients = series(state, order)
            reach = step(coefficients, order, time - now)
            state = at(coefficients, reach)
            now = time if reach == time - now else now + reach
        assert abs(energy(state) - first) < mp.mpf(10) ** (3 - PRINTED)
        found.append(state)
    return found


def step(coefficients, order, most):
    """So long that the last four coefficients are below the working precision, and no longer than `most`."""
    for last in range(order - 3, order + 1):
        size = max(abs(own[last]) for own in coefficients)
        if size > 0:
            most = min(most, mp.root(mp.eps / size, last))
    return most


def product(a, b, n):
    """Coefficient n of a product of series."""
    return mp.fdot(a[: n + 1], b[n::-1])


def at(coefficients, step):
    """The state that series have come to after a step."""
    return [mp.polyval(own[::-1], step) for own in coefficients]


def text(value):
    """20 significant digits."""
    return mp.nstr(value, PRINTED, strip_zeros=False, min_fixed=-6, max_fixed=12)
