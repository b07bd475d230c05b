"""Pymunk: 2-D, Chipmunk's engine, double precision."""

import pymunk

from stepping import bouncing, follow

NAME = f"Pymunk {pymunk.version}"
# What its documentation steps with, and a finer one.
SETTINGS = {"step 1/60 s": 1 / 60, "step 0.1 ms": 1e-4}
# Of the floor: nothing falls through it in one step.
THICKNESS, WIDTH = 10, 100


def motion(stage, step, times):
    space = pymunk.Space()
    space.gravity = (0, -stage.gravity)
    if stage.floor is not None:
        turn = pymunk.Transform.translation(0, stage.floor).rotated(stage.slope)
        corners = [(-WIDTH, -THICKNESS), (WIDTH, -THICKNESS), (WIDTH, 0), (-WIDTH, 0)]
        floor = pymunk.Poly(space.static_body, corners, turn)
        # Of two shapes the coefficients are multiplied.
        floor.elasticity, floor.friction = 1, 1
        space.add(floor)
    bodies = [add(space, stage, piece) for piece in stage.pieces]

    def states():
        return [(*body.position, body.angle, *body.velocity, body.angular_velocity) for body in bodies]

    return follow(stage, step, times, lambda: space.step(step), states)


def add(space, stage, piece):
    body = pymunk.Body(piece.mass, piece.inertia)
    x, y, body.angle, vx, vy, body.angular_velocity = piece.start
    body.position, body.velocity = (x, y), (vx, vy)
    shapes = [pymunk.Circle(body, piece.radius, (foot, 0)) for foot in piece.feet]
    if piece.box:
        shapes = [pymunk.Poly.create_box(body, piece.box)]
    for shape in shapes:
        shape.friction = stage.friction
        # Balls on hooks meet each other, where both have it; on the floor it counts alone.
        shape.elasticity = stage.restitution
    space.add(body, *shapes)
    if piece.hook:
        space.add(pymunk.PivotJoint(space.static_body, body, body.local_to_world((0, piece.hook))))
    return body


bounce = bouncing(motion)
