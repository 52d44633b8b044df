# SPDX-License-Identifier: Apache-2.0
"""The interface of engines, which do many runs in parallel, and what they tell of them."""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass
from typing import Protocol, TYPE_CHECKING

from humanoid_simulation.sweep.results import RunResult

if TYPE_CHECKING:  # processes of tests need not import the walk
    from humanoid_simulation.sweep.conditions import Run

Work = Callable[['Run'], RunResult]
"""Does one run; other processes import it by its module and name."""
ATTEMPTS = 2
"""How often a run is tried whose process crashes."""


@dataclass(frozen=True)
class Done:
    """A run that is finished."""

    run: Run
    result: RunResult


@dataclass(frozen=True)
class Crashed:
    """An attempt at a run in which its process ended or failed."""

    run: Run
    attempt: int
    reason: str

    @property
    def is_final(self) -> bool:
        """Whether the run is not tried again."""
        return self.attempt >= ATTEMPTS


@dataclass(frozen=True)
class Notice:
    """A sentence for the user about what does the runs, such as that a machine is lost."""

    sentence: str


Outcomes = Generator[Done | Crashed | Notice, None, None]


class Engine(Protocol):
    """What does runs: each is done once, or tried `ATTEMPTS` times if its process crashes."""

    def outcomes(self, runs: Sequence[Run]) -> Outcomes:
        """
        Do the runs, and yield what becomes of each as soon as it is known, in any order.

        Closing the generator ends all work.

        Parameters
        ----------
        runs
            The runs to do.

        Raises
        ------
        SimulationError
            Nothing can do runs, or no longer; those without an outcome are not done.

        """
