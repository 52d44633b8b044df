# SPDX-License-Identifier: Apache-2.0
"""What every controller offers to the manager that runs it."""

from __future__ import annotations

from typing import Protocol

from humanoid_control.backends import JointTargets, Observation
import numpy as np
from numpy.typing import NDArray

Mask = NDArray[np.bool_]


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


class Guest(Controller, Protocol):
    """Moves joints that are lent to it, for as long as it has commands for them."""

    @property
    def way_out(self) -> str:
        """Say what somebody else who wants its joints can do, as the end of a sentence."""

    @property
    def waits(self) -> bool:
        """Tell whether it is to be started, even if it has its joints already."""

    def wanted(self, now_s: float) -> Mask:
        """Return for which joints it has commands, (n,)."""

    def cancel(self) -> None:
        """Forget all commands."""
