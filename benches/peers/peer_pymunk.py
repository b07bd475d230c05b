"""Pymunk: 2-D, Chipmunk's engine, double precision."""

import pymunk

from stepping import follow

NAME = f"Pymunk {pymunk.version}"
# What its documentation steps with, and a finer one.
SETTINGS = {"step 1/60 s": 1 / 60, "step 0.1 ms": 1e-4}
# Of the floor: nothing falls through it in one step.
THICKNESS = 10


def bounce(bouncer, step, times):
    space = pymunk.Space()
    space.gravity = (0, -bouncer.gravity)
    low, high = bouncer.floor - THICKNESS, bouncer.floor
    floor = pymunk.Poly(space.static_body, [(-100, low), (100, low), (100, high), (-100, high)])
    body = pymunk.Body(bouncer.mass, bouncer.inertia)
    x, y, body.angle, vx, vy, body.angular_velocity = bouncer.start
    body.position, body.velocity = (x, y), (vx, vy)
    feet = [pymunk.Circle(body, bouncer.radius, (foot, 0)) for foot in bouncer.feet]
    # The restitution of two shapes is the product.
    floor.elasticity = 1
    for shape in feet:
        shape.elasticity, shape.friction = bouncer.restitution, 0
    space.add(floor, body, *feet)

    def state():
        return (*body.position, body.angle, *body.velocity, body.angular_velocity)

    return follow(bouncer, step, times, lambda: space.step(step), state)
