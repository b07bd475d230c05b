"""tumble: writes a scene, runs the command on it and reads summary.json."""

import json
import math
import os
import subprocess
import tempfile
from pathlib import Path

from stepping import bouncing
from systems import REPOSITORY, Motion

COMMAND = os.environ.get("TUMBLE", str(REPOSITORY / "target/release/tumble"))
NAME = subprocess.run([COMMAND, "--version"], capture_output=True, text=True, check=True).stdout.split(" (")[0].strip()
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
        check(f"{body}-{state}-{number}", f"{body}.{state}", unit, time)
        for number, time in enumerate(times)
        for state, unit in STATES.items()
    )


def at_times(found, count, times):
    """The states of so many bodies that the checks have found."""
    values = {one["name"]: one["found"] for one in found["checks"]}

    def state(number, body):
        return tuple(values[f"body{body}-{state}-{number}"] for state in STATES)

    return {time: [state(number, body) for body in range(count)] for number, time in enumerate(times)}


def start(x, y, angle, vx, vy, omega):
    """The value of a body's key of that name."""
    motion = f'velocity = ["{vx!r} m/s", "{vy!r} m/s"], angle = "{angle!r} rad", omega = "{omega!r} rad/s"'
    return f'{{ at = ["{x!r} m", "{y!r} m"], {motion} }}'


def body(number, piece):
    """A rod with round ends at its feet, a ball or a box, and its hook."""
    if piece.box:
        width, height = piece.box
        shape = f'box = {{ width = "{width!r} m", height = "{height!r} m" }}'
    elif len(piece.feet) == 1:
        shape = f'ball = {{ radius = "{piece.radius!r} m" }}'
    else:
        left, right = piece.feet
        shape = f'rod = {{ from = ["{left} m", 0], to = ["{right} m", 0], end_radius = "{piece.radius} m" }}'
    x, y, angle, *_ = piece.start
    hook = (x - piece.hook * math.sin(angle), y + piece.hook * math.cos(angle))
    held = f"""
[pivot.hook{number}]
body = "body{number}"
point = [0, "{piece.hook!r} m"]
world = ["{hook[0]!r} m", "{hook[1]!r} m"]
"""
    begin = f'{{ angle = "{angle!r} rad" }}' if piece.hook else start(*piece.start)
    return f"""
[body.body{number}]
{shape}
mass = "{piece.mass!r} kg"
start = {begin}
{held if piece.hook else ""}"""


IMPACTS = 'impacts = "sequential"'


def motion(stage, accuracy, times):
    rigid = f"rigid = {{ restitution = {stage.restitution!r}, friction = {stage.friction!r} }}"
    meets = f'[contact.row]\nbetween = "all"\n{rigid}' if len(stage.pieces) > 1 else ""
    floor = f'[surface.floor]\nthrough = [0, "{stage.floor!r} m"]\nslope = "{stage.slope!r} rad"\n{rigid}'
    found = run(f"""
version = 1
title = "A stage"
[world]
gravity = "{stage.gravity} m/s^2"
{IMPACTS if len(stage.pieces) > 1 else ""}
{"".join(body(number, piece) for number, piece in enumerate(stage.pieces))}
{floor if stage.floor is not None else ""}
{meets}
[run]
until = "{stage.until!r} s"
accuracy = {accuracy}
{"".join(checks(f"body{number}", times) for number in range(len(stage.pieces)))}""")
    events = {what: event["time"] for event in reversed(found["events"]) for what in event["what"]}
    struck = [event["time"] for event in found["events"] if any(what.endswith(".impact") for what in event["what"])]
    states = at_times(found, len(stage.pieces), times)
    return Motion(states, impacts=struck, events=events, note=told(found["events"]))


def told(events):
    """Impacts, and when a motion has come to rest."""
    struck = [event["time"] for event in events for what in event["what"] if what.endswith(".impact")]
    rest = [event["time"] for event in events for what in event["what"] if what.endswith(".start")]
    return f"{len(struck)} impacts" + (f", rests from {rest[-1]!r} s on" if rest else "")


bounce = bouncing(motion)


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
