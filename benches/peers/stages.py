"""Bodies on a rough floor or on hooks, and what they really do: a block on a slope, backspin, a cradle, a rod on a rough floor.

SI units; x to the right, y up, angles counter-clockwise. A state is (x, y, angle, vx, vy, omega) of a body's centre.
"""

import json
import math
from dataclasses import dataclass

from systems import REPOSITORY

ROUGH = json.loads((REPOSITORY / "crates/tumble/tests/reference/rough.json").read_text())
GRAVITY = 9.81


@dataclass(frozen=True)
class Piece:
    """A body: circles about points of its own x axis, or a box; perhaps on a hook above its centre."""

    mass: float
    inertia: float
    start: tuple
    radius: float = 0.0
    feet: tuple = (0.0,)  # distances of the circles from the centre
    box: tuple = ()  # width and height
    hook: float = 0.0  # height of the hook above the centre at angle 0, or none


@dataclass(frozen=True)
class Stage:
    """Pieces, and the floor through (0, floor), which rises to the right by the slope."""

    pieces: tuple
    until: float
    gravity: float = GRAVITY
    slope: float = 0.0
    floor: float | None = 0.0
    friction: float = 0.0
    restitution: float = 0.0

    def normal(self):
        return -math.sin(self.slope), math.cos(self.slope)


@dataclass(frozen=True)
class Resting:
    """A block on a slope that is rough enough: it stays where it is."""

    friction: float = 0.5
    slope: float = math.radians(20)
    size: tuple = (0.5, 0.25)
    until: float = 10.0

    def stage(self):
        width, height = self.size
        mass, half = 2.0, height / 2
        place = (-half * math.sin(self.slope), half * math.cos(self.slope), self.slope, 0.0, 0.0, 0.0)
        block = Piece(mass, mass * (width**2 + height**2) / 12, place, box=self.size)
        return Stage((block,), self.until, slope=self.slope, friction=self.friction)

    def creep(self, early, late):
        """How far it moves along the slope from one state to another."""
        return (late[0] - early[0]) * math.cos(self.slope) + (late[1] - early[1]) * math.sin(self.slope)


@dataclass(frozen=True)
class Backspin:
    """A ball that is thrown along the floor with backspin: it slips, rolls back and comes home."""

    friction: float = 0.3
    radius: float = 0.3
    speed: float = 2.0
    spin: float = 20.0

    def stage(self):
        mass, start = 0.5, (0.0, self.radius, 0.0, self.speed, 0.0, self.spin)
        ball = Piece(mass, 0.4 * mass * self.radius**2, start, self.radius)
        return Stage((ball,), 8.0, friction=self.friction)

    def slip(self, state):
        return state[3] + self.radius * state[5]

    def rolls(self):
        """When it rolls: the slip falls by mu g, and by 5/2 of that since it turns slower."""
        return self.slip(self.stage().pieces[0].start) / (3.5 * self.friction * GRAVITY)

    def rolling(self):
        """The speed that it rolls with."""
        return self.speed - self.friction * GRAVITY * self.rolls()

    def home(self):
        """When it comes back to where it was thrown."""
        way = self.speed * self.rolls() - self.friction * GRAVITY * self.rolls() ** 2 / 2
        return self.rolls() - way / self.rolling()


@dataclass(frozen=True)
class Cradle:
    """Balls in a row on hooks, of which the first is let go; each impact is passed on to the last."""

    count: int = 5
    radius: float = 0.1
    hook: float = 1.0
    lift: float = math.radians(30)
    swings: int = 5

    def stage(self):
        mass, balls = 1.0, []
        for number in range(self.count):
            x, angle = 2 * self.radius * number, 0.0 if number else -self.lift
            place = (x + self.hook * math.sin(angle), self.hook * (1 - math.cos(angle)), angle, 0.0, 0.0, 0.0)
            balls.append(Piece(mass, 0.4 * mass * self.radius**2, place, self.radius, hook=self.hook))
        return Stage(tuple(balls), (self.swings + 0.5) * self.half(), floor=None, restitution=1.0)

    def half(self):
        """Half a period, by the arithmetic and geometric mean: from one ball at its top to the other at its."""
        a, b = 1.0, math.cos(self.lift / 2)
        while abs(a - b) > 1e-16:
            a, b = (a + b) / 2, math.sqrt(a * b)
        length = self.hook + 0.4 * self.radius**2 / self.hook
        return math.pi / a * math.sqrt(length / GRAVITY)

    def angles(self, swings):
        """Of all balls after so many half periods."""
        out = self.count - 1 if swings % 2 else 0
        return [0.0 if n != out else self.lift if out else -self.lift for n in range(self.count)]


def rough_rod(speed, rate):
    """The rod of scenes/21-rough-floor with round ends: friction acts under their centres. Its inertia is that of a thin rod."""
    mass, length, radius = 0.5, 1.0, 0.05
    start = (0.0, 2.0 + radius, 0.6, speed, 0.0, rate)
    rod = Piece(mass, mass * length**2 / 12, start, radius, (-length / 2, length / 2))
    return Stage((rod,), 2.5, friction=0.1, restitution=0.7)


def rough_reference(rod, time):
    """x, y and angle of one of the two rods at one of the times of the references."""
    x, y, _, _, angle, _ = (float(value) for value in ROUGH["rods"][rod]["states"][f"{time:g}"])
    return x, y, angle


# Times of the impacts of a rocking block.
ROCKS = [float(impact["t"]) for impact in ROUGH["block"]["impacts"]]


def rocking_block():
    """The block of scenes/27-rocking-block."""
    mass, wide, high = 100.0, 0.1, 0.4
    tilt = math.atan(wide / high) / 2
    sin, cos = math.sin(tilt), math.cos(tilt)
    place = (-wide + wide * cos - high * sin, wide * sin + high * cos, tilt, 0.0, 0.0, 0.0)
    block = Piece(mass, mass * (wide**2 + high**2) / 3, place, box=(2 * wide, 2 * high))
    return Stage((block,), 3.0, friction=0.8)
