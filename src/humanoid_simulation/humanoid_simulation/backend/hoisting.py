# SPDX-License-Identifier: Apache-2.0
"""The hoists that are at work in a world."""

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
"""From so far above a base the ground below it is looked for."""
_WORLD_ALONE = np.array([1, 0, 0, 0, 0, 0], dtype=np.uint8)
"""The groups of geoms that are no robot's."""


class Hoists:
    """
    The hoists at work in a world, at most one for each robot.

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
        Start to lift a robot, in place of a hoist that has it already.

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
        """Let go of everything at once."""
        self._working = {}

    def is_lifting(self, base: int) -> bool:
        """
        Whether a robot hangs on a hoist.

        Parameters
        ----------
        base
            Id of its floating body.

        """
        return base in self._working

    def act(self, period_s: float) -> None:
        """
        Apply the wrenches of all hoists in the coming period, and drop those that are done.

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
        """Return how high the ground is below a place."""
        start = position_m + (0.0, 0.0, _ABOVE_M)
        geom, down = np.zeros(1, dtype=np.int32), np.array([0.0, 0.0, -1.0])
        far_m = mujoco.mj_ray(self._model, self._data, start, down, _WORLD_ALONE, 1, -1, geom)
        return float(start[2]) - far_m if far_m >= 0.0 else 0.0
