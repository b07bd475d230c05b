"""The pendulum in the wind at equal error, integration alone: heyoka with an event where u is zero. Prints Markdown.

Both programs run in turn; each time is the least of all. What is done once is left out: heyoka compiles the equations,
tumble derives them and builds its tape. `built` has that in it for tumble, which does it in every run.
"""

import json
import os
import subprocess
import time

import heyoka as hy

import peer_heyoka
from systems import REPOSITORY, WindPendulum
from tables import show

# Prints the times of tumble as JSON.
BENCH = ["cargo", "bench", "--quiet", "--locked", "--package", "tumble", "--bench", "systems", "--", "--json"]
TURNS = 3
# Runs of heyoka in a turn, at each tolerance.
RUNS = 40
# Tolerances that heyoka is tried with, to the rounding of doubles.
TOLERANCES = [10 ** (-exponent / 4) for exponent in range(16, 63)] + [2.220446049250313e-16]
KINDS = ["bare", "checked", "built_bare", "built_checked", "trusted"]


class Pendulum:
    """heyoka at one tolerance, compiled."""

    def __init__(self, tolerance):
        self.system = WindPendulum(1.0)
        state = hy.make_vars("v0", "v1")
        functions = peer_heyoka.Signed()
        rates = self.system.slope(hy.time, state, functions)
        event = hy.t_event(functions.seen[0], callback=peer_heyoka.turn)
        equations = list(zip(state, rates))
        self.taylor = hy.taylor_adaptive(equations, [0.0, 0.0], pars=[1.0], t_events=[event], tol=tolerance)

    def run(self):
        """Seconds that a run takes."""
        self.taylor.time, self.taylor.state[:], self.taylor.pars[0] = 0.0, 0.0, 1.0
        self.taylor.reset_cooldowns()
        begin = time.perf_counter()
        self.taylor.propagate_until(self.system.until)
        return time.perf_counter() - begin

    def error(self):
        """Error at the end, measured as that of tumble: relative where a state is larger than 1."""
        pairs = zip(self.taylor.state, self.system.reference())
        return max(abs(found - expected) / max(abs(expected), 1) for found, expected in pairs)


def candidates():
    """Tolerance, pendulum and error, from the loosest tolerance on."""
    for tolerance in TOLERANCES:
        pendulum = Pendulum(tolerance)
        pendulum.run()
        yield tolerance, pendulum, pendulum.error()


def at_error(found, error):
    """The loosest tolerance at which the error is no larger; that of the least error where it never is."""
    enough = (candidate for candidate in found if candidate[2] <= error)
    return next(enough, min(found, key=lambda candidate: candidate[2]))


def ours():
    """What tumble says, by accuracy. TUMBLE_SYSTEMS names a benchmark that is built already."""
    built = os.environ.get("TUMBLE_SYSTEMS")
    command = [built, "--json"] if built else BENCH
    text = subprocess.run(command, cwd=REPOSITORY, capture_output=True, text=True, check=True).stdout
    return {run["accuracy"]: run for run in json.loads(text)}


def measured():
    """For each accuracy what tumble says, and heyoka's tolerance, error and time in microseconds at that error."""
    found = list(candidates())
    best = ours()
    peers = {accuracy: at_error(found, run["error"]) for accuracy, run in best.items()}
    times = dict.fromkeys(best, float("inf"))
    for turn in range(TURNS):
        for accuracy, (_, pendulum, _) in peers.items():
            times[accuracy] = min([times[accuracy], *(pendulum.run() * 1e6 for _ in range(RUNS))])
        if turn + 1 < TURNS:
            for accuracy, run in ours().items():
                for kind in KINDS:
                    key = f"{kind}_us"
                    best[accuracy][key] = min(best[accuracy][key], run[key])
    return [(best[a], tolerance, error, times[a]) for a, (tolerance, _, error) in peers.items()]


def equal_error_table():
    rows = []
    for run, tolerance, error, spent in measured():
        settings = [f"{run['accuracy']:.0e}", f"{run['error']:.1e}", f"{tolerance:.1e}", f"{error:.1e}"]
        times = [f"{run[f'{kind}_us']:.0f}" for kind in KINDS]
        ratios = [f"{spent / run[f'{kind}_us']:.2f}" for kind in KINDS]
        rows.append([*settings, f"{spent:.0f}", *(f"{t}, {r}" for t, r in zip(times, ratios))])
    head = ["accuracy", "error", f"{peer_heyoka.NAME}, tolerance", "its error", "its time, us"]
    show(
        "Pendulum in the wind, 20 s, at equal error: time of tumble in us, and heyoka's over it",
        [*head, *(kind.replace("_", " ") for kind in KINDS)],
        rows,
    )


if __name__ == "__main__":
    equal_error_table()
