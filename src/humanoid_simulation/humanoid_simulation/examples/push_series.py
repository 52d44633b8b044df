# SPDX-License-Identifier: Apache-2.0
"""Find out how hard a push a robot stands in each direction."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

DIRECTIONS = {'forward': 1 + 0j, 'back': -1 + 0j, 'left': 1j, 'right': -1j}
"""Unit vectors of the ground plane in the robot's axes: x forward, y to the left."""


@dataclass(frozen=True)
class Push:
    """One push: its direction by name, and its impulse."""

    direction: str
    impulse_ns: float


@dataclass(frozen=True)
class PushPlan:
    """Which impulses are tried, and how long the robot is watched before and after."""

    first_ns: float = 5.0
    step_ns: float = 5.0
    most_ns: float = 40.0
    settle_s: float = 2.0
    watch_s: float = 4.0
    give_up_s: float = 20.0


class Step(Enum):
    """What is to be done now."""

    WAIT = 'wait'
    PUSH = 'push'
    RESET = 'reset'
    DONE = 'done'


class NeverStoodError(Exception):
    """The robot does not stand, so that there is nothing to push."""


class PushSeries:
    """
    Pushes in one direction after the other, each time harder, until the robot falls.

    Before each push the robot has to have stood for a while, and after each it is put back.

    Parameters
    ----------
    plan
        Impulses and durations.

    """

    def __init__(self, plan: PushPlan) -> None:
        self._plan = plan
        self._left = list(DIRECTIONS)
        self._impulse_ns = plan.first_ns
        self._is_pushed = False
        self._waits_since_s: float | None = None
        self._stands_since_s: float | None = None
        self.stood_ns = dict.fromkeys(DIRECTIONS, 0.0)
        """The hardest push that the robot stood in each direction; 0 if none."""

    @property
    def push(self) -> Push:
        """Return the push that is due or whose consequences are watched."""
        return Push(self._left[0], self._impulse_ns)

    def update(self, time_s: float, stands: bool) -> Step:
        """
        Decide the next step of the test.

        Parameters
        ----------
        time_s
            Simulated time now.
        stands
            Whether the robot stands; False if it has fallen.

        Returns
        -------
        Step
            What the caller has to do now: with `PUSH`, apply `push`.

        Raises
        ------
        NeverStoodError
            The robot has not stood for long enough within the time that it is given.

        """
        if not self._left:
            return Step.DONE
        if self._waits_since_s is None:
            self._waits_since_s = time_s
        return (self._watch if self._is_pushed else self._settle)(time_s, stands)

    def _settle(self, time_s: float, stands: bool) -> Step:
        """Wait until the robot has stood for long enough."""
        assert self._waits_since_s is not None
        if not stands:
            self._stands_since_s = None
        elif self._stands_since_s is None:
            self._stands_since_s = time_s
        elif time_s - self._stands_since_s >= self._plan.settle_s:
            self._is_pushed, self._waits_since_s = True, time_s
            return Step.PUSH
        if time_s - self._waits_since_s > self._plan.give_up_s:
            raise NeverStoodError(
                f'The robot has not stood for {self._plan.settle_s:g} s within '
                f'{self._plan.give_up_s:g} s, so it cannot be pushed. Reset the simulation and '
                'see that its controller runs.'
            )
        return Step.WAIT

    def _watch(self, time_s: float, stands: bool) -> Step:
        """Wait until it is clear whether the robot stood the push."""
        assert self._waits_since_s is not None
        if stands and time_s - self._waits_since_s < self._plan.watch_s:
            return Step.WAIT
        self._conclude(stands)
        self._is_pushed, self._waits_since_s, self._stands_since_s = False, None, None
        return Step.RESET

    def _conclude(self, stood: bool) -> None:
        """Keep the result, and go on with a harder push or the next direction."""
        if stood:
            self.stood_ns[self._left[0]] = self._impulse_ns
            self._impulse_ns += self._plan.step_ns
        if not stood or self._impulse_ns > self._plan.most_ns:
            del self._left[0]
            self._impulse_ns = self._plan.first_ns
