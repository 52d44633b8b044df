# SPDX-License-Identifier: Apache-2.0
"""The active hoists of a world."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from humanoid_control.backends import Array
from humanoid_simulation.backend.entities import EntityState
from humanoid_simulation.backend.wrenches import Wrench, Wrenches
from humanoid_simulation.hoist import Hoist
import mujoco
import numpy as np

_ABOVE_M = 0.5
"""Height above the base from which a ray is cast down to find the ground."""
_WORLD_ALONE = np.array([1, 0, 0, 0, 0, 0], dtype=np.uint8)
"""The geom groups of that ray: the world without robots."""


class Hoists:
    """
    The active hoists of a world, at most one for each robot.

    Parameters
    ----------
    model, data
        The MuJoCo model, and its state.
    wrenches
        Applies the forces and torques of the hoists.

    """

    def __init__(self, model: Any, data: Any, wrenches: Wrenches) -> None:
        self._model, self._data, self._wrenches = model, data, wrenches
        self._working: dict[int, tuple[Hoist, Callable[[], EntityState]]] = {}

    def enter(self, model: Any, data: Any, numbers: Mapping[int, int]) -> None:
        """
        Switch to another model, in which the bases of the robots may have other ids.

        Parameters
        ----------
        model, data
            The new MuJoCo model, and its state.
        numbers
            New ids of the bodies, by the old ones.

        """
        self._model, self._data = model, data
        self._working = {numbers[base]: hoist for base, hoist in self._working.items()}

    def begin(self, base: int, standing_m: float, state: Callable[[], EntityState]) -> None:
        """
        Start lifting a robot; a hoist that is already lifting it is replaced.

        Parameters
        ----------
        base
            Id of its floating body.
        standing_m
            Height of the base above the ground when the robot stands.
        state
            Returns the state of the base, in the world frame.

        """
        mass_kg = float(self._model.body_subtreemass[base])
        now = state()
        hoist = Hoist(now, mass_kg, standing_m, self._ground_m(now.position_m))
        self._working[base] = (hoist, state)

    def clear(self) -> None:
        """Release all robots immediately."""
        self._working = {}

    def is_lifting(self, base: int) -> bool:
        """
        Check whether a hoist is lifting a robot.

        Parameters
        ----------
        base
            Id of its floating body.

        """
        return base in self._working

    def act(self, period_s: float) -> None:
        """
        Apply the wrenches of all hoists for the coming period, and remove finished hoists.

        Parameters
        ----------
        period_s
            Length of a control period.

        """
        for base, (hoist, state) in list(self._working.items()):
            force, torque = hoist.wrench(state(), period_s)
            if hoist.is_done:
                del self._working[base]
            else:
                wrench = Wrench(base, force, torque, np.zeros(3), period_s)
                self._wrenches.add(wrench, always=True)

    def _ground_m(self, position_m: Array) -> float:
        """Find the height of the ground below a position by ray casting; 0 without a hit."""
        start = position_m + (0.0, 0.0, _ABOVE_M)
        geom, down = np.zeros(1, dtype=np.int32), np.array([0.0, 0.0, -1.0])
        far_m = mujoco.mj_ray(self._model, self._data, start, down, _WORLD_ALONE, 1, -1, geom)
        return float(start[2]) - far_m if far_m >= 0.0 else 0.0
