"""MuJoCo: 3-D, double precision. Contacts are soft and have no restitution; a damping stands for it here."""

import math

import mujoco

from stepping import follow

NAME = f"MuJoCo {mujoco.__version__}"
# Default contacts; contacts whose damping gives the restitution, so many steps long; the same with small steps.
SETTINGS = {
    "default contacts, step 2 ms": (2e-3, None, "Euler"),
    "elastic contacts, step 2 ms": (2e-3, 10, "Euler"),
    "elastic contacts, step 0.1 ms, RK4": (1e-4, 10, "RK4"),
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


def bounce(bouncer, setting, times):
    step, steps, integrator = setting
    law = contact(bouncer.restitution, step, steps)
    feet = "".join(
        f'<geom type="sphere" size="{bouncer.radius}" pos="{foot} 0 0" condim="1" {law}/>' for foot in bouncer.feet
    )
    model = mujoco.MjModel.from_xml_string(f"""
      <mujoco>
        <option timestep="{step}" integrator="{integrator}" gravity="0 0 {-bouncer.gravity}"/>
        <worldbody>
          <geom type="plane" size="100 100 1" pos="0 0 {bouncer.floor}" condim="1" {law}/>
          <body>
            <joint type="slide" axis="1 0 0"/>
            <joint type="slide" axis="0 0 1"/>
            <joint type="hinge" axis="0 -1 0"/>
            <inertial pos="0 0 0" mass="{bouncer.mass}"
              diaginertia="{bouncer.inertia} {bouncer.inertia} {bouncer.inertia}"/>
            {feet}
          </body>
        </worldbody>
      </mujoco>""")
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = bouncer.start[:3], bouncer.start[3:]

    def state():
        return (*data.qpos.tolist(), *data.qvel.tolist())

    return follow(bouncer, step, times, lambda: mujoco.mj_step(model, data), state)
