# SPDX-License-Identifier: Apache-2.0
"""Check that robots of all sizes move alike, which is what the powers of the scale are for."""

from __future__ import annotations

import math
from typing import Any

from humanoid_description.drives import load_drives
from humanoid_description.expansion import humanoid_urdf
import numpy as np
import pytest

mujoco = pytest.importorskip('mujoco')

STEP_S = 0.001
STEPS = 400


def simulation(scale: float) -> Any:
    """Return a model of the robot, hanging from its pelvis, with all its times scaled."""
    model = mujoco.MjModel.from_xml_string(humanoid_urdf(scale))
    time = math.sqrt(scale)
    model.opt.timestep = STEP_S * time
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONTACT)
    # The time constant of friction and limits belongs to the simulator, not to the robot.
    model.dof_solref[:, 0] = model.jnt_solref[:, 0] = 0.02 * time
    return model


def swing(scale: float) -> np.ndarray[Any, Any]:
    """Return the joints' angles while the servos follow a swing that soon becomes too fast."""
    model, drives = simulation(scale), load_drives(scale)
    data = mujoco.MjData(model)
    ordered = [drives[model.joint(index).name] for index in range(model.njnt)]
    kp, kd, effort, model.dof_armature[:] = np.array(
        [(d.kp, d.kd, d.effort, d.armature) for d in ordered]
    ).T
    angles = []
    for step in range(STEPS):
        wanted = 0.3 * math.sin((step * STEP_S * 8) ** 2)
        torque = kp * (wanted - data.qpos) - kd * data.qvel
        data.qfrc_applied[:] = np.clip(torque, -effort, effort)
        mujoco.mj_step(model, data)
        angles.append(data.qpos.copy())
    return np.array(angles)


@pytest.mark.parametrize('scale', [0.5, 1.3])
def test_motion_is_similar(scale: float) -> None:
    """Servos move a robot of another size as the original, at times multiplied by sqrt(s)."""
    original = swing(1.0)
    assert np.ptp(original, axis=0).min() > 0.1
    assert np.allclose(swing(scale), original, rtol=0, atol=1e-6)
