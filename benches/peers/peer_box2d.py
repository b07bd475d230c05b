"""Box2D, by pybox2d: 2-D, single precision."""

import Box2D

from stepping import follow

NAME = f"Box2D {Box2D.__version__}"
# The manual's step and iterations, and a finer step. Impacts slower than 1 m/s do not bounce in this version.
SETTINGS = {"step 1/60 s": 1 / 60, "step 0.1 ms": 1e-4}
VELOCITY_ITERATIONS, POSITION_ITERATIONS = 8, 3
# Edges have a skin of this thickness: the floor lies so much lower.
SKIN = Box2D.b2_polygonRadius


def bounce(bouncer, step, times):
    world = Box2D.b2World(gravity=(0, -bouncer.gravity))
    height = bouncer.floor - SKIN
    floor = Box2D.b2EdgeShape(vertices=[(-100, height), (100, height)])
    world.CreateStaticBody().CreateFixture(shape=floor, friction=0)
    x, y, angle, vx, vy, omega = bouncer.start
    body = world.CreateDynamicBody(position=(x, y), angle=angle, linearVelocity=(vx, vy), angularVelocity=omega)
    for foot in bouncer.feet:
        circle = Box2D.b2CircleShape(pos=(foot, 0), radius=bouncer.radius)
        body.CreateFixture(shape=circle, density=1, friction=0, restitution=bouncer.restitution)
    body.massData = Box2D.b2MassData(mass=bouncer.mass, I=bouncer.inertia, center=(0, 0))

    def state():
        return (*body.position, body.angle, *body.linearVelocity, body.angularVelocity)

    return follow(bouncer, step, times, lambda: world.Step(step, VELOCITY_ITERATIONS, POSITION_ITERATIONS), state)
