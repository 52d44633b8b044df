# SPDX-License-Identifier: Apache-2.0
"""The part of a state that can be seen."""

from __future__ import annotations

import mujoco
import numpy as np
from numpy.typing import NDArray

_SEEN = int(
    mujoco.mjtState.mjSTATE_QPOS
    | mujoco.mjtState.mjSTATE_MOCAP_POS
    | mujoco.mjtState.mjSTATE_MOCAP_QUAT
)


def snapshot_size(model: mujoco.MjModel) -> int:
    """Return how many numbers a snapshot has."""
    return int(mujoco.mj_stateSize(model, _SEEN))


def take_snapshot(
    model: mujoco.MjModel, data: mujoco.MjData, snapshot: NDArray[np.float64]
) -> None:
    """Copy where everything is from the data to a snapshot, (snapshot_size,)."""
    mujoco.mj_getState(model, data, snapshot, _SEEN)


def show_snapshot(
    model: mujoco.MjModel, data: mujoco.MjData, snapshot: NDArray[np.float64]
) -> None:
    """Put everything where a snapshot, (snapshot_size,), says, ready to be drawn."""
    mujoco.mj_setState(model, data, snapshot, _SEEN)
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    mujoco.mj_camlight(model, data)
