# SPDX-License-Identifier: Apache-2.0
"""Control loop: a backend and the controllers of its robots, in lockstep."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from humanoid_control.backends import Backend, JointTargets, Observation


class Brain(Protocol):
    """Control of one robot, which computes its joint targets."""

    def update(self, observation: Observation) -> JointTargets:
        """
        Compute the joint targets for the coming control period.

        Parameters
        ----------
        observation
            Sensor values of the robot at the start of the period.

        Returns
        -------
        JointTargets
            Targets of all n joints of the robot, each array (n,), in the order of the observation.

        """

    def reset(self) -> None:
        """Restart the control from the next observation."""


class ControlLoop:
    """
    A backend, and a brain for each of its robots; a tick is one period of the backend.

    Parameters
    ----------
    backend
        Observes and moves the robots.
    brains
        The control of each robot, by name; a robot without one gets no targets.

    Raises
    ------
    ValueError
        There is a brain for a robot that the backend does not have.

    """

    def __init__(self, backend: Backend, brains: Mapping[str, Brain]) -> None:
        unknown = set(brains) - set(backend.robots)
        if unknown:
            raise ValueError(
                f'There are brains for {sorted(unknown)}, but the robots are '
                f'{list(backend.robots)}. Give each brain the name of a robot.'
            )
        self.backend = backend
        self._brains = dict(brains)

    def tick(self) -> Mapping[str, Observation]:
        """Observe, compute targets and step one period; return the observations before it."""
        observations = self.backend.observe()
        self.backend.step(
            {name: brain.update(observations[name]) for name, brain in self._brains.items()}
        )
        return observations

    def reset(self, keyframe: str = 'home') -> None:
        """
        Reset all robots to a named posture at their start pose; time continues.

        Parameters
        ----------
        keyframe
            Name of a posture that the backend knows; it raises an error for any other.

        """
        self.backend.reset(keyframe)
        for brain in self._brains.values():
            brain.reset()

    def begin_anew(self, robot: str) -> None:
        """
        Restart the control of a robot that was moved from outside, as by a teleport.

        Parameters
        ----------
        robot
            Name of the robot; one without a brain is ignored.

        """
        if robot in self._brains:
            self._brains[robot].reset()
