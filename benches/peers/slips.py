"""What a slip of units does: the same mistakes, given to each tool. Prints Markdown."""

import subprocess
import tempfile
import warnings
from dataclasses import replace
from pathlib import Path

import peer_mujoco
import peer_pymunk
import peer_scipy
import peer_tumble
from systems import rod
from tables import show

SCENE = """
version = 1
title = "A thrown rod"
run.until = "1 s"
[world]
gravity = {gravity}
[body.rod]
rod = {{ from = [0, 0], to = [{length}, 0] }}
mass = {mass}
start = {{ angle = {angle} }}
[drag.air]
at = "rod.cm"
quadratic = {quadratic}
"""
RIGHT = {
    "gravity": '"9.81 m/s^2"',
    "length": '"1 m"',
    "mass": '"0.5 kg"',
    "angle": '"30 deg"',
    "quadratic": '"0.02 kg/m"',
}
# What goes wrong, and how it is written in a scene.
SLIPS = {
    "an angle in degrees without saying so": {"angle": "30"},
    "a mass without a unit": {"mass": "0.5"},
    "a length for a mass": {"mass": '"0.5 m"'},
    "a coefficient of drag per metre for one at a point": {"quadratic": '"0.02 kg/m^2"'},
    "gravity as a force": {"gravity": '"9.81 N"'},
    "grams written as kilograms": {"mass": '"500 kg"'},
    "feet written as metres": {"length": '"3.28 m"'},
}


def message(slip):
    """What `tumble check` says: the first mistake, or nothing."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.toml"
        path.write_text(SCENE.format(**{**RIGHT, **slip}))
        done = subprocess.run([peer_tumble.COMMAND, "check", str(path)], capture_output=True, text=True)
    said = [line.strip() for line in done.stderr.splitlines()]
    code = next((line for line in said if line.startswith("E0")), "")
    sentence = next((line.removeprefix("× ") for line in said if line.startswith("×")), "nothing")
    return done.returncode, f"{code} {sentence}".strip()


def refused():
    rows = []
    for name, slip in SLIPS.items():
        code, said = message(slip)
        rows.append([name, *[f"`{key} = {value}`" for key, value in slip.items()], str(code), said])
    show("tumble: exit code and message", ["slip", "in the scene", "code", "message"], rows)


def taken():
    """The bouncing rod with its angle given as 30, for 30 degrees."""
    right = rod(1)
    slipped = replace(right, start=(*right.start[:2], 30.0, *right.start[3:]), until=1.0)
    rows = []
    for peer in (peer_scipy, peer_pymunk, peer_mujoco):
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            state = peer.bounce(slipped, next(iter(peer.SETTINGS.values())), [1.0]).states[1.0]
        rows.append([peer.NAME, str(len(said)), f"{state[2]:.3f} rad"])
    show("Other tools: an angle of 30", ["tool", "warnings", "angle at 1 s"], rows)


if __name__ == "__main__":
    refused()
    taken()
