"""PyBullet: 3-D. The motion stays in the plane x, z."""

import math
from importlib.metadata import version

import pybullet as b

from stepping import bouncing, follow

NAME = f"PyBullet {version('pybullet')}"
# Its own default step, and a finer one that bounces at any speed and neither looks ahead nor pushes bodies apart (both
# change the restitution). Damping, 0.04 by default, is off in both.
SETTINGS = {"step 1/240 s": (1 / 240, False), "step 0.1 ms, bare contacts": (1e-4, True)}


def motion(stage, setting, times):
    step, bare = setting
    b.connect(b.DIRECT)
    b.setGravity(0, 0, -stage.gravity)
    b.setTimeStep(step)
    if bare:
        b.setPhysicsEngineParameter(restitutionVelocityThreshold=0, contactERP=0)
    if stage.floor is not None:
        lay(stage)
    bodies = [add(stage, piece, bare) for piece in stage.pieces]
    turned = [piece.start[2] for piece in stage.pieces]

    def states():
        return [hung(body) if piece.hook else free(body, number) for number, (body, piece) in enumerate(zip(bodies, stage.pieces))]

    def free(body, number):
        (x, _, z), turn = b.getBasePositionAndOrientation(body)
        (vx, _, vz), (_, rate, _) = b.getBaseVelocity(body)
        axes = b.getMatrixFromQuaternion(turn)
        shown = math.atan2(axes[6], axes[0])
        turned[number] += math.remainder(shown - turned[number], 2 * math.pi)
        return x, z, turned[number], vx, vz, -rate

    found = follow(stage, step, times, b.stepSimulation, states)
    b.disconnect()
    return found


def lay(stage):
    """The floor, a thick slab."""
    thick, (nx, ny) = 10, stage.normal()
    slab = b.createCollisionShape(b.GEOM_BOX, halfExtents=[100, 100, thick])
    place = [-thick * nx, 0, stage.floor - thick * ny]
    floor = b.createMultiBody(0, slab, basePosition=place, baseOrientation=turn(stage.slope))
    # Of two bodies the coefficients are multiplied.
    b.changeDynamics(floor, -1, restitution=1, lateralFriction=1)


def turn(angle):
    """A turn counter-clockwise in x, z is one about -y."""
    return b.getQuaternionFromAxisAngle([0, -1, 0], angle)


def add(stage, piece, bare):
    x, y, angle, vx, vy, omega = piece.start
    body = hang(piece) if piece.hook else b.createMultiBody(
        piece.mass, shape(piece), basePosition=[x, 0, y], baseOrientation=turn(angle)
    )
    if not piece.hook:
        b.resetBaseVelocity(body, [vx, 0, vy], [0, -omega, 0])
    b.changeDynamics(
        body, 0 if piece.hook else -1, restitution=stage.restitution, lateralFriction=stage.friction,
        linearDamping=0, angularDamping=0, jointDamping=0, localInertiaDiagonal=[piece.inertia] * 3,
        **({"contactProcessingThreshold": 0} if bare else {}),
    )
    return body


def shape(piece):
    if piece.box:
        width, height = piece.box
        return b.createCollisionShape(b.GEOM_BOX, halfExtents=[width / 2, 0.1, height / 2])
    count = len(piece.feet)
    return b.createCollisionShapeArray(
        shapeTypes=[b.GEOM_SPHERE] * count,
        radii=[piece.radius] * count,
        collisionFramePositions=[[foot, 0, 0] for foot in piece.feet],
    )


def hang(piece):
    """A ball as the link of a base that stands at its hook."""
    x, y, angle, *_ = piece.start
    hook = [x - piece.hook * math.sin(angle), 0, y + piece.hook * math.cos(angle)]
    ball = b.createCollisionShape(b.GEOM_SPHERE, radius=piece.radius, collisionFramePosition=[0, 0, -piece.hook])
    body = b.createMultiBody(
        baseMass=0, basePosition=hook, linkMasses=[piece.mass], linkCollisionShapeIndices=[ball],
        linkVisualShapeIndices=[-1], linkPositions=[[0, 0, 0]], linkOrientations=[[0, 0, 0, 1]],
        linkInertialFramePositions=[[0, 0, -piece.hook]], linkInertialFrameOrientations=[[0, 0, 0, 1]],
        linkParentIndices=[0], linkJointTypes=[b.JOINT_REVOLUTE], linkJointAxis=[[0, -1, 0]],
    )
    b.resetJointState(body, 0, angle)
    # Without its motor, which brakes by default.
    b.setJointMotorControl2(body, 0, b.VELOCITY_CONTROL, force=0)
    return body


def hung(body):
    """Of a ball on a hook the angle and its rate alone."""
    angle, rate, *_ = b.getJointState(body, 0)
    return 0.0, 0.0, angle, 0.0, 0.0, rate


bounce = bouncing(motion)
