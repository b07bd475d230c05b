"""tumble: writes a scene, runs the command on it and reads summary.json."""

import json
import os
import subprocess
import tempfile
from pathlib import Path

from systems import REPOSITORY, Motion

COMMAND = os.environ.get("TUMBLE", str(REPOSITORY / "target/release/tumble"))
NAME = subprocess.run([COMMAND, "--version"], capture_output=True, text=True, check=True).stdout.strip()
SETTINGS = {"accuracy 1e-9, the default": 1e-9, "accuracy 1e-12": 1e-12}
# What is read off the run: a check that always holds.
ALWAYS = 1e9
STATES = {"x": "m", "y": "m", "angle": "rad", "vx": "m/s", "vy": "m/s", "omega": "rad/s"}


def run(scene, *options):
    """Runs the scene and gives its summary."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.toml"
        path.write_text(scene)
        command = [COMMAND, "run", str(path), "--out", folder, "--no-figures", "--report", "none", *options]
        subprocess.run(command, check=True, capture_output=True)
        return json.loads(next(Path(folder).glob("*/summary.json")).read_text())["runs"][0]


def check(name, quantity, unit, time):
    return f"""
[check.{name}]
that = "{quantity}"
at = "{time!r} s"
equals = "0 {unit}"
within = "{ALWAYS} {unit}"
"""


def checks(body, times):
    return "".join(
        check(f"{state}-{number}", f"{body}.{state}", unit, time)
        for number, time in enumerate(times)
        for state, unit in STATES.items()
    )


def at_times(found, times):
    """The states that the checks have found."""
    values = {one["name"]: one["found"] for one in found["checks"]}
    return {time: tuple(values[f"{state}-{number}"] for state in STATES) for number, time in enumerate(times)}


def shape(bouncer):
    """The scene's body: a thin rod between its feet, or a ball."""
    if len(bouncer.feet) == 1:
        return f'ball = {{ radius = "{bouncer.radius} m" }}'
    left, right = bouncer.feet
    return (
        f'rod = {{ from = ["{left} m", 0], to = ["{right} m", 0] }}\n'
        f'points.tail = ["{left} m", 0]\npoints.tip = ["{right} m", 0]'
    )


def start(x, y, angle, vx, vy, omega):
    """The value of a body's key of that name."""
    motion = f'velocity = ["{vx} m/s", "{vy} m/s"], angle = "{angle} rad", omega = "{omega} rad/s"'
    return f'{{ at = ["{x} m", "{y} m"], {motion} }}'


def bounce(bouncer, accuracy, times):
    found = run(f"""
version = 1
title = "Bounces"
[world]
gravity = "{bouncer.gravity} m/s^2"
[body.body]
{shape(bouncer)}
mass = "{bouncer.mass} kg"
start = {start(*bouncer.start)}
[surface.floor]
through = [0, 0]
rigid = {{ restitution = {bouncer.restitution} }}
[run]
until = "{bouncer.until} s"
accuracy = {accuracy}
{checks("body", times)}""")
    struck = [event["time"] for event in found["events"] for what in event["what"] if what.endswith(".impact")]
    rest = [event["time"] for event in found["events"] for what in event["what"] if what.endswith(".start")]
    note = f", rests from {rest[-1]!r} s on" if rest else ""
    return Motion(at_times(found, times), struck, f"{len(struck)} impacts{note}")


def pendulum(system, accuracy):
    """The final angle and angular velocity."""
    found = run(f"""
version = 1
title = "Pendulum in the wind"
[functions]
"w(t)" = "({system.wind / 2} m/s)*(1 + cos(2*pi*t/({system.period} s)))"
[world]
gravity = "{system.gravity} m/s^2"
wind = ["w(t)", 0]
[body.rod]
rod = {{ from = [0, 0], to = [0, "-{system.length} m"] }}
mass = "{system.mass} kg"
points.tip = [0, "-{system.length} m"]
start = {{ angle = "0 deg", omega = 0 }}
[pivot.hinge]
body = "rod"
point = [0, 0]
world = [0, 0]
[drag.air]
at = "rod.tip"
component = "normal"
quadratic = "{system.drag} kg/m"
[run]
until = "{system.until} s"
accuracy = {accuracy}
""")
    return [found["end"]["states"][state]["value"] for state in ("rod.angle", "rod.omega")]


def thrown(system, accuracy):
    """The final x, y, vx, vy, angle, omega."""
    points = system.points()
    places = "\n".join(f'points.p{i} = ["{s!r} m", 0]' for i, (s, _) in enumerate(points))
    drags = "\n".join(f'[drag.air{i}]\nat = "rod.p{i}"\nquadratic = "{c!r} kg/m"' for i, (_, c) in enumerate(points))
    x, y, vx, vy, angle, omega = system.start
    half = system.length / 2
    found = run(f"""
version = 1
title = "Thrown rod"
[world]
gravity = "{system.gravity} m/s^2"
[body.rod]
rod = {{ from = ["-{half} m", 0], to = ["{half} m", 0] }}
mass = "{system.mass} kg"
{places}
start = {start(x, y, angle, vx, vy, omega)}
{drags}
[run]
until = "{system.until} s"
accuracy = {accuracy}
""")
    order = ("x", "y", "vx", "vy", "angle", "omega")
    return [found["end"]["states"][f"rod.{state}"]["value"] for state in order]
