"""Box2D, by pybox2d: 2-D, single precision."""

import math

import Box2D

from stepping import bouncing, follow

NAME = f"Box2D {Box2D.__version__}"
# The manual's step and iterations, and a finer step. Impacts slower than 1 m/s do not bounce in this version.
SETTINGS = {"step 1/60 s": 1 / 60, "step 0.1 ms": 1e-4}
VELOCITY_ITERATIONS, POSITION_ITERATIONS = 8, 3
# Edges and polygons have a skin of this thickness: the floor lies so much lower for each of them that touches it.
SKIN = Box2D.b2_polygonRadius


def motion(stage, step, times):
    world = Box2D.b2World(gravity=(0, -stage.gravity))
    ground = world.CreateStaticBody()
    if stage.floor is not None:
        skins = 2 if any(piece.box for piece in stage.pieces) else 1
        height, (nx, ny) = stage.floor, stage.normal()
        far = [(100 * side * ny, height - 100 * side * nx) for side in (-1, 1)]
        sunk = [(x - skins * SKIN * nx, y - skins * SKIN * ny) for x, y in far]
        # Of two coefficients of friction the geometric mean counts, and the greater restitution.
        ground.CreateFixture(shape=Box2D.b2EdgeShape(vertices=sunk), friction=stage.friction)
    bodies = [add(world, ground, stage, piece) for piece in stage.pieces]

    def states():
        return [(*b.position, b.angle, *b.linearVelocity, b.angularVelocity) for b in bodies]

    return follow(stage, step, times, lambda: world.Step(step, VELOCITY_ITERATIONS, POSITION_ITERATIONS), states)


def add(world, ground, stage, piece):
    x, y, angle, vx, vy, omega = piece.start
    body = world.CreateDynamicBody(position=(x, y), angle=angle, linearVelocity=(vx, vy), angularVelocity=omega)
    shapes = [Box2D.b2CircleShape(pos=(foot, 0), radius=piece.radius) for foot in piece.feet]
    if piece.box:
        shapes = [Box2D.b2PolygonShape(box=[side / 2 for side in piece.box])]
    for shape in shapes:
        body.CreateFixture(shape=shape, density=1, friction=stage.friction, restitution=stage.restitution)
    body.massData = Box2D.b2MassData(mass=piece.mass, I=piece.inertia, center=(0, 0))
    if piece.hook:
        hook = (x - piece.hook * math.sin(angle), y + piece.hook * math.cos(angle))
        world.CreateRevoluteJoint(bodyA=ground, bodyB=body, anchor=hook)
    return body


bounce = bouncing(motion)
