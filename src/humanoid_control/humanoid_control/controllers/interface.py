# SPDX-License-Identifier: Apache-2.0
"""What every controller offers to the manager that runs it."""

from __future__ import annotations

from typing import Protocol

from humanoid_control.backends import JointTargets, Observation


class Controller(Protocol):
    """Moves the joints that it claims; the manager sees to it that a joint has one owner."""

    @property
    def name(self) -> str:
        """Return what users call it."""

    @property
    def joints(self) -> tuple[str, ...]:
        """Return the joints that it moves, in the order of its targets."""

    def start(self, observation: Observation, held: JointTargets) -> None:
        """Begin; `held` is what its joints were told last, from which it goes on."""

    def update(self, observation: Observation) -> JointTargets:
        """Return the targets of its joints for the coming period; called once a period."""
