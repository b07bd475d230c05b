"""PyBullet: 3-D. The motion stays in the plane x, z."""

import math
from importlib.metadata import version

import pybullet as b

from stepping import follow

NAME = f"PyBullet {version('pybullet')}"
# Its own default step, and a finer one that bounces at any speed and neither looks ahead nor pushes bodies apart (both
# change the restitution). Damping, 0.04 by default, is off in both.
SETTINGS = {"step 1/240 s": (1 / 240, False), "step 0.1 ms, bare contacts": (1e-4, True)}


def bounce(bouncer, setting, times):
    step, bare = setting
    b.connect(b.DIRECT)
    b.setGravity(0, 0, -bouncer.gravity)
    b.setTimeStep(step)
    if bare:
        b.setPhysicsEngineParameter(restitutionVelocityThreshold=0, contactERP=0)
    thick = 10
    slab = b.createCollisionShape(b.GEOM_BOX, halfExtents=[100, 100, thick])
    floor = b.createMultiBody(0, slab, basePosition=[0, 0, bouncer.floor - thick])
    count = len(bouncer.feet)
    spheres = b.createCollisionShapeArray(
        shapeTypes=[b.GEOM_SPHERE] * count,
        radii=[bouncer.radius] * count,
        collisionFramePositions=[[foot, 0, 0] for foot in bouncer.feet],
    )
    x, y, angle, vx, vy, omega = bouncer.start
    # A turn counter-clockwise in x, z is one about -y.
    turn = b.getQuaternionFromAxisAngle([0, -1, 0], angle)
    body = b.createMultiBody(bouncer.mass, spheres, basePosition=[x, 0, y], baseOrientation=turn)
    b.resetBaseVelocity(body, [vx, 0, vy], [0, -omega, 0])
    # The restitution of two bodies is the product.
    b.changeDynamics(floor, -1, restitution=1, lateralFriction=0)
    b.changeDynamics(
        body, -1, restitution=bouncer.restitution, lateralFriction=0, linearDamping=0, angularDamping=0,
        localInertiaDiagonal=[bouncer.inertia] * 3, **({"contactProcessingThreshold": 0} if bare else {}),
    )
    turned = [angle]

    def state():
        (x, _, z), turn = b.getBasePositionAndOrientation(body)
        (vx, _, vz), (_, rate, _) = b.getBaseVelocity(body)
        axes = b.getMatrixFromQuaternion(turn)
        shown = math.atan2(axes[6], axes[0])
        turned[0] += math.remainder(shown - turned[0], 2 * math.pi)
        return x, z, turned[0], vx, vz, -rate

    motion = follow(bouncer, step, times, b.stepSimulation, state)
    b.disconnect()
    return motion
