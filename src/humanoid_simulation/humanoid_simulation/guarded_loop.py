# SPDX-License-Identifier: Apache-2.0
"""Keep a simulator alive when its physics is at an end."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from humanoid_control.backends import Backend, Observation
from humanoid_control.hosting.control_loop import Brain, ControlLoop
from humanoid_simulation.errors import SimulationError


class GuardedLoop(ControlLoop):
    """
    A control loop that stands still after an error of the simulation, until it is reset.

    Parameters
    ----------
    backend
        The simulated world.
    brains
        Controllers by the names of robots; a robot without one gets no targets.
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
        """Tell whether nothing goes on before a reset."""
        return self._has_failed

    def tick(self) -> Mapping[str, Observation]:
        """Let a period pass, if that is possible; return what was observed before it."""
        if not self._has_failed:
            try:
                return super().tick()
            except SimulationError as error:
                self._has_failed = True
                self._say(str(error))
        return self.backend.observe()

    def reset(self, keyframe: str = 'home') -> None:
        """
        Reset robots and brains, and end the standstill after an error; time goes on.

        Parameters
        ----------
        keyframe
            Name of the posture in which the robots begin again.

        Raises
        ------
        SimulationError
            There is no keyframe of that name; a standstill then lasts.

        """
        super().reset(keyframe)
        self._has_failed = False
