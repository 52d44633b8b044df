# SPDX-License-Identifier: Apache-2.0
"""Control loop that survives errors of the physics."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from humanoid_control.backends import Backend, Observation
from humanoid_control.hosting.control_loop import Brain, ControlLoop
from humanoid_simulation.errors import SimulationError


class GuardedLoop(ControlLoop):
    """
    A control loop that halts after an error of the simulation, until it is reset.

    Parameters
    ----------
    backend
        The simulated world.
    brains
        Controllers by robot name; a robot without one gets no targets.
    say
        Called with the message of an error.

    Raises
    ------
    ValueError
        There is a controller for a robot that the backend does not have.

    """

    def __init__(
        self, backend: Backend, brains: Mapping[str, Brain], say: Callable[[str], None]
    ) -> None:
        super().__init__(backend, brains)
        self._say = say
        self._has_failed = False

    @property
    def has_failed(self) -> bool:
        """Whether the loop has halted after an error, until a reset."""
        return self._has_failed

    def tick(self) -> Mapping[str, Observation]:
        """Advance by a period unless halted; return the observations before it."""
        if not self._has_failed:
            try:
                return super().tick()
            except SimulationError as error:
                self._has_failed = True
                self._say(str(error))
        return self.backend.observe()

    def reset(self, keyframe: str = 'home') -> None:
        """
        Reset robots and controllers, and clear an error; time continues.

        Parameters
        ----------
        keyframe
            Name of the posture in which the robots start again.

        Raises
        ------
        SimulationError
            There is no keyframe of that name; an error is not cleared then.

        """
        super().reset(keyframe)
        self._has_failed = False
