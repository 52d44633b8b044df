# SPDX-License-Identifier: Apache-2.0
"""Advance the state of a MuJoCo world by control periods, under external forces."""

from __future__ import annotations

from typing import Any

from humanoid_simulation.backend.forces import Wrenches
from humanoid_simulation.backend.hoist import Hoists
from humanoid_simulation.backend.settings import BackendSettings
from humanoid_simulation.backend.state import carry_over, LastSound, numbers_in
import mujoco


class PhysicsStepper:
    """
    Advances the state of a world by control periods, and undoes a period in which it diverges.

    Parameters
    ----------
    model, data
        The compiled MuJoCo world, and its state.
    settings
        Length of a control period, and the number of physics steps in it.

    Attributes
    ----------
    wrenches, hoists
        The external forces that act on the world in each period.

    """

    def __init__(self, model: Any, data: Any, settings: BackendSettings) -> None:
        self._model, self._data, self._settings = model, data, settings
        self._sound = LastSound(data)
        self.wrenches = Wrenches(data)
        self.hoists = Hoists(model, data, self.wrenches)

    def enter(self, model: Any, data: Any) -> None:
        """
        Switch to another model; what both have in common keeps its state and the forces on it.

        Parameters
        ----------
        model, data
            The new MuJoCo model and its state, whose derived quantities are not recomputed.

        """
        carry_over(self._model, self._data, model, data)
        numbers = numbers_in(self._model, model)
        self.wrenches.enter(data, numbers)
        self.hoists.enter(model, data, numbers)
        self._model, self._data = model, data
        self._sound = LastSound(data)

    def advance(self) -> bool:
        """
        Advance by one control period; if the physics becomes unstable, undo it.

        Returns
        -------
        bool
            Whether the period has passed. If not, the state before it is restored without
            external forces, and derived quantities are not recomputed.

        """
        settings = self._settings
        period_s = settings.period_s
        self.hoists.act(period_s)
        self.wrenches.act(period_s)
        self._sound.keep()
        mujoco.mj_step(self._model, self._data, settings.steps_per_period)
        if not self._sound.is_lost:
            return True
        self._sound.restore()
        self._end_forces()
        return False

    def reset(self) -> None:
        """Set the initial state of the model, and end all external forces."""
        mujoco.mj_resetData(self._model, self._data)
        self._end_forces()

    def _end_forces(self) -> None:
        """End all wrenches, and release all robots from their hoists."""
        self.wrenches.clear()
        self.hoists.clear()
