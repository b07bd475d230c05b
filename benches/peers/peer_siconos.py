"""Siconos: steps after Moreau and Jean, by its C++ library of Debian's packages; see peer_siconos.cpp. Bodies on a floor only."""

import math
import subprocess

from stepping import bouncing
from systems import REPOSITORY, Motion

SETTINGS = {"step 1 ms": 1e-3, "step 0.1 ms": 1e-4, "step 0.01 ms": 1e-5}
FOLDER = REPOSITORY / "target/peers"
SOURCE = REPOSITORY / "benches/peers/peer_siconos.cpp"
INCLUDED = [f"-I/usr/include/siconos{folder}" for folder in ("", "/kernel", "/numerics")]
LINKED = ["-lsiconos_kernel", "-lsiconos_numerics", "-lsiconos_externals"]


def version():
    command = ["dpkg-query", "--show", "--showformat=${Version}", "libsiconos-kernel-dev"]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.split("+")[0]


NAME = f"Siconos {version()}"


def built():
    """The program, built anew where its source is newer."""
    program = FOLDER / "siconos"
    if not program.exists() or program.stat().st_mtime < SOURCE.stat().st_mtime:
        subprocess.run(["g++", "-O2", "-std=c++17", *INCLUDED, str(SOURCE), "-o", str(program), *LINKED], check=True)
    return program


def motion(stage, step, times):
    """None for what hangs on hooks. The floor is level here and the weight oblique."""
    (piece,) = stage.pieces if len(stage.pieces) == 1 else (None,)
    if piece is None or piece.hook:
        return None
    width, height = piece.box or (0, 0)
    corners = [(x * width / 2, y * height / 2, 0) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    feet = corners if piece.box else [(foot, 0, piece.radius) for foot in piece.feet]
    pull = (-stage.gravity * math.sin(stage.slope), -stage.gravity * math.cos(stage.slope))
    steps = round(stage.until / step)
    start = turned(lifted(piece.start, -stage.floor), -stage.slope)
    given = [piece.mass, piece.inertia, *pull, stage.restitution, stage.friction, step, steps, *start]
    words = [repr(float(one)) for one in [*given, *(one for foot in feet for one in foot)]]
    done = subprocess.run([str(built()), *words], capture_output=True, text=True, check=True)
    *lines, spent = [line for line in done.stdout.splitlines() if line and line[0] in "-0123456789"]
    marks = {round(time / step): time for time in times}
    found, path = {marks[0]: [piece.start]} if 0 in marks else {}, []
    for count, line in enumerate(lines, 1):
        state = lifted(turned([float(one) for one in line.split()], stage.slope), stage.floor)
        path.append((count * step, state))
        if count in marks:
            found[marks[count]] = [state]
    return Motion(found, path=path, spent=float(spent))


def turned(state, angle):
    x, y, turn, vx, vy, omega = state
    sin, cos = math.sin(angle), math.cos(angle)
    return (x * cos - y * sin, x * sin + y * cos, turn + angle, vx * cos - vy * sin, vx * sin + vy * cos, omega)


def lifted(state, height):
    return (state[0], state[1] + height, *state[2:])


bounce = bouncing(motion)
