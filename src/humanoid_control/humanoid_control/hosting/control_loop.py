# SPDX-License-Identifier: Apache-2.0
"""Robots and what controls them, in lockstep."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from humanoid_control.backends import Backend, JointTargets, Observation


class Brain(Protocol):
    """What decides where the joints of one robot go."""

    def update(self, observation: Observation) -> JointTargets:
        """Return the targets of all joints for the coming period."""

    def reset(self) -> None:
        """Begin anew with the next observation."""


class ControlLoop:
    """A backend, and a brain for each of its robots; a tick is one period of the backend."""

    def __init__(self, backend: Backend, brains: Mapping[str, Brain]) -> None:
        """Take the brains by the names of the robots; those without one stay as they are."""
        unknown = set(brains) - set(backend.robots)
        if unknown:
            raise ValueError(
                f'There are brains for {sorted(unknown)}, but the robots are '
                f'{list(backend.robots)}. Give each brain the name of a robot.'
            )
        self.backend = backend
        self._brains = dict(brains)

    def tick(self) -> Mapping[str, Observation]:
        """Observe, decide, and let a period pass; return what was observed before it."""
        observations = self.backend.observe()
        self.backend.step(
            {name: brain.update(observations[name]) for name, brain in self._brains.items()}
        )
        return observations

    def reset(self, keyframe: str = 'home') -> None:
        """Put all robots where they began, in a posture that has a name; time goes on."""
        self.backend.reset(keyframe)
        for brain in self._brains.values():
            brain.reset()

    def begin_anew(self, robot: str) -> None:
        """Tell a robot that it was put somewhere else."""
        if robot in self._brains:
            self._brains[robot].reset()
