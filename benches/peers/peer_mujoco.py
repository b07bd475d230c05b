"""MuJoCo: 3-D, double precision. Contacts are soft and have no restitution; a damping stands for it here."""

import math

import mujoco

from stepping import bouncing, follow

NAME = f"MuJoCo {mujoco.__version__}"
# Default contacts; contacts whose damping gives the restitution, so many steps long; the same with small steps.
SETTINGS = {
    "default contacts, step 2 ms": (2e-3, None, "Euler"),
    "elastic contacts, step 2 ms": (2e-3, 10, "Euler"),
    "elastic contacts, step 0.1 ms, RK4": (1e-4, 10, "RK4"),
}
# The same for friction, and the way out that its documentation names for creep: elliptic cones and further iterations against slip.
ROUGH = {
    **SETTINGS,
    "default contacts, step 2 ms, elliptic cones, noslip": (2e-3, None, "Euler", 'cone="elliptic" noslip_iterations="10"'),
}
# How much of a contact is the spring and damper given: as near to all of it as MuJoCo takes.
IMPEDANCE = 0.9999


def restitution_of(ratio):
    """Restitution of a spring with that damping ratio which does not pull: it lets go at zero force."""
    damped = math.sqrt(1 - ratio**2)
    phase = math.pi - math.atan2(2 * ratio * damped, 1 - 2 * ratio**2)
    return math.exp(-ratio / damped * phase)


def damping_ratio(restitution):
    """Its inverse."""
    low, high = 0.0, 0.999
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if restitution_of(middle) > restitution else (low, middle)
    return low


def contact(restitution, step, steps):
    """Attributes of a contact that lasts so many steps: a spring and damper for each unit of mass."""
    if steps is None:
        return ""
    frequency = math.pi / (steps * step)
    damping = 2 * damping_ratio(restitution) * frequency
    return f'solref="{-(frequency**2)} {-damping}" solimp="{IMPEDANCE} {IMPEDANCE} 0.001"'


def motion(stage, setting, times):
    step, steps, integrator, *more = setting
    law = contact(stage.restitution, step, steps)
    touch = f'condim="{3 if stage.friction else 1}" friction="{stage.friction} 0 0" {law}'
    bodies = "".join(drawn(piece, touch) for piece in stage.pieces)
    floor = f'<geom type="plane" size="100 100 1" pos="0 0 {stage.floor}" euler="0 {-stage.slope} 0" {touch}/>'
    model = mujoco.MjModel.from_xml_string(f"""
      <mujoco>
        <compiler angle="radian"/>
        <option timestep="{step}" integrator="{integrator}" gravity="0 0 {-stage.gravity}" {" ".join(more)}/>
        <worldbody>{floor if stage.floor is not None else ""}{bodies}</worldbody>
      </mujoco>""")
    data = mujoco.MjData(model)
    for number, piece in enumerate(stage.pieces):
        if piece.hook:
            data.qpos[number], data.qvel[number] = piece.start[2], piece.start[5]
        else:
            data.qpos[3 * number : 3 * number + 3], data.qvel[3 * number : 3 * number + 3] = piece.start[:3], piece.start[3:]

    def states():
        places, rates = data.qpos.tolist(), data.qvel.tolist()
        if stage.pieces[0].hook:
            return [(0.0, 0.0, place, 0.0, 0.0, rate) for place, rate in zip(places, rates)]
        return [(*places[i : i + 3], *rates[i : i + 3]) for i in range(0, len(places), 3)]

    return follow(stage, step, times, lambda: mujoco.mj_step(model, data), states)


def drawn(piece, touch):
    """A body in the plane of x and z. One on a hook has its angle as its only coordinate, so its states are angles alone."""
    shapes = "".join(f'<geom type="sphere" size="{piece.radius}" pos="{foot} 0 0" {touch}/>' for foot in piece.feet)
    if piece.box:
        width, height = piece.box
        shapes = f'<geom type="box" size="{width / 2} 0.1 {height / 2}" {touch}/>'
    joints = '<joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/><joint type="hinge" axis="0 -1 0"/>'
    x, y, angle, *_ = piece.start
    place = "0 0 0"
    if piece.hook:
        joints = f'<joint type="hinge" axis="0 -1 0" pos="0 0 {piece.hook}"/>'
        place = f"{x - piece.hook * math.sin(angle)} 0 {y + piece.hook * math.cos(angle) - piece.hook}"
    inertia = f'<inertial pos="0 0 0" mass="{piece.mass}" diaginertia="{" ".join([str(piece.inertia)] * 3)}"/>'
    return f'<body pos="{place}">{joints}{inertia}{shapes}</body>'


bounce = bouncing(motion)
