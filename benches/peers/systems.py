"""The systems that every tool is given, and what they really do.

SI units; x to the right, y up, angles counter-clockwise. A rod that bounces, a ball that bounces, a pendulum in the
wind and a thrown rod in air, with the reference numbers of the tests, crates/tumble/tests/reference/systems.json.
"""

import json
import math
from dataclasses import dataclass, field
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
REFERENCE = json.loads((REPOSITORY / "crates/tumble/tests/reference/systems.json").read_text())


@dataclass(frozen=True)
class Bouncer:
    """A body that bounces on a rigid floor without friction.

    It touches the floor by feet: circles of one radius about points of the body. A floor that lies lower by the radius
    than y = 0 makes the rod's feet touch where its ends would reach y = 0, so the motion is that of a thin rod.
    """

    mass: float
    inertia: float
    gravity: float
    restitution: float
    start: tuple  # x, y, angle, vx, vy, omega of the centre
    feet: tuple  # distances from the centre along the body's own x axis
    radius: float
    floor: float  # height of the floor
    until: float

    def gap(self, foot, y, angle, sin=math.sin):
        """Distance of that foot from the floor."""
        return y + foot * sin(angle) - self.radius - self.floor

    def energy(self, state):
        """Kinetic energy, and weight above the height of the centre when the body lies still."""
        _, y, _, vx, vy, omega = state
        height = y - self.radius - self.floor
        return self.mass * (vx**2 + vy**2) / 2 + self.inertia * omega**2 / 2 + self.mass * self.gravity * height

    def bounced(self, foot, state):
        """The state after an impact on that foot, after Newton: it goes up with e times the speed it came down with.

        A foot that goes up already is left alone.
        """
        x, y, angle, vx, vy, omega = state
        arm = foot * math.cos(angle)
        closing = min(vy + arm * omega, 0)
        impulse = -(1 + self.restitution) * closing / (1 / self.mass + arm**2 / self.inertia)
        return [x, y, angle, vx, vy + impulse / self.mass, omega + arm * impulse / self.inertia]


def rod(restitution):
    """The rod of scenes/08-rigid-rod. The radius of its feet is free; 5 cm suits every collision detector."""
    mass, length, radius = 0.5, 1.0, 0.05
    start = (0.0, 2.0, 0.6, 2.0, 0.0, 2.0)
    feet = (-length / 2, length / 2)
    return Bouncer(mass, mass * length**2 / 12, 9.81, restitution, start, feet, radius, -radius, 5.0)


def ball(restitution=0.5):
    """The ball of scenes/09-bouncing-ball, dropped from 1 m."""
    mass, radius = 0.2, 0.05
    start = (0.0, 1.0 + radius, 0.0, 0.0, 0.0, 0.0)
    return Bouncer(mass, 0.4 * mass * radius**2, 9.8, restitution, start, (0.0,), radius, 0.0, 2.0)


@dataclass
class Motion:
    """What a tool found: states (x, y, angle, vx, vy, omega) at the times asked for, and its bounces."""

    states: dict
    bounces: list = field(default_factory=list)  # times, as far as the tool tells
    note: str = ""
    path: list = field(default_factory=list)  # times and states, step by step, or none
    impacts: list = field(default_factory=list)  # their times, where the tool locates them
    events: dict = field(default_factory=dict)  # times by name, where the tool locates them
    spent: float | None = None  # processor time in s, where the tool measures it itself


def rod_reference(restitution, time):
    """Height and angle of the rod's centre."""
    if time < 0.55:
        _, y, angle, _, vy, omega = rod(restitution).start
        return y + vy * time - 9.81 * time**2 / 2, angle + omega * time
    table = REFERENCE["bouncing_rod"]["rigid_e1" if restitution == 1 else "rigid_e0.7"]
    if time > table["t"]:  # it lies flat
        return 0.0, float(table["state"][4])
    state = table["state" if time == table["t"] else f"state_t{time:g}"]
    return float(state[1]), float(state[4])


def ball_reference(time):
    """Height of the ball's centre: flights that last e times the one before."""
    b = ball()
    drop = b.start[1] - b.radius
    begin, speed = math.sqrt(2 * drop / b.gravity), math.sqrt(2 * drop * b.gravity)
    if time <= begin:
        return b.start[1] - b.gravity * time**2 / 2
    for _ in range(200):
        speed *= b.restitution
        if time <= begin + 2 * speed / b.gravity:
            return b.radius + speed * (time - begin) - b.gravity * (time - begin) ** 2 / 2
        begin += 2 * speed / b.gravity
    return b.radius


def ball_rest():
    """When the ball comes to rest."""
    b = ball()
    return math.sqrt(2 * (b.start[1] - b.radius) / b.gravity) * (1 + b.restitution) / (1 - b.restitution)


@dataclass(frozen=True)
class WindPendulum:
    """A rod on a pivot with air resistance D |u| u at its tip, across it: "wind_pendulum_tip" of the references."""

    period: float
    mass: float = 1.0
    length: float = 1.0
    gravity: float = 9.81
    drag: float = 0.03
    wind: float = 20.0
    until: float = 20.0

    def reference(self):
        """Angle and angular velocity at the end."""
        run = REFERENCE["wind_pendulum_tip"]["runs"][f"{self.period:.1f}"]
        return float(run["theta"]), float(run["omega"])

    def slope(self, time, state, m=math):
        """Rates of (angle, angular velocity); m has cos, sin and fabs."""
        angle, omega = state
        wind = self.wind / 2 * (1 + m.cos(2 * math.pi / self.period * time))
        u = wind * m.cos(angle) - self.length * omega
        torque = self.length * self.drag * m.fabs(u) * u - self.mass * self.gravity * self.length / 2 * m.sin(angle)
        return [omega, torque / (self.mass * self.length**2 / 3)]


# Nodes and weights of Gauss and Legendre on [-1, 1], the positive half.
GAUSS_8 = (
    (0.1834346424956498, 0.3626837833783620),
    (0.5255324099163290, 0.3137066458778873),
    (0.7966664774136267, 0.2223810344533745),
    (0.9602898564975363, 0.1012285362903763),
)


@dataclass(frozen=True)
class ThrownRod:
    """A thrown rod whose air acts at 8 points of it: "thrown_rod_air" of the references."""

    mass: float = 0.5
    length: float = 1.0
    gravity: float = 9.81
    drag: float = 0.02
    start: tuple = (0.0, 1.0, 8.0, 6.0, 0.5, 6.0)  # x, y, vx, vy, angle, omega
    until: float = 1.2

    def points(self):
        """Distance from the centre and coefficient in kg/m of each point."""
        half = self.length / 2
        return [(sign * s * half, self.drag * w * half) for s, w in GAUSS_8 for sign in (-1, 1)]

    def reference(self):
        """The state at the end."""
        return [float(value) for value in REFERENCE["thrown_rod_air"]["state"]]

    def slope(self, _time, state, m=math):
        """Rates of the state."""
        _, _, vx, vy, angle, omega = state
        cos, sin = m.cos(angle), m.sin(angle)
        fx, fy, torque = 0.0, -self.mass * self.gravity, 0.0
        for s, c in self.points():
            ux, uy = vx - omega * s * sin, vy + omega * s * cos
            speed = m.sqrt(ux * ux + uy * uy)
            fx, fy = fx - c * speed * ux, fy - c * speed * uy
            torque = torque - c * speed * s * (cos * uy - sin * ux)
        inertia = self.mass * self.length**2 / 12
        return [vx, vy, fx / self.mass, fy / self.mass, omega, torque / inertia]
