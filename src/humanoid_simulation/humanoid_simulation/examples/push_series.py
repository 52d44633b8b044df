# SPDX-License-Identifier: Apache-2.0
"""Find the strongest push that a robot withstands in each direction."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from humanoid_common.errors import UserError

DIRECTIONS = {'forward': 1 + 0j, 'back': -1 + 0j, 'left': 1j, 'right': -1j}
"""Unit vectors of the ground plane in the robot's axes: x forward, y to the left."""


@dataclass(frozen=True)
class Push:
    """One push: its direction by name, and its impulse."""

    direction: str
    impulse_ns: float


@dataclass(frozen=True)
class PushPlan:
    """The impulses to try, and how long to watch the robot before and after each push."""

    first_ns: float = 5.0
    step_ns: float = 5.0
    most_ns: float = 40.0
    settle_s: float = 2.0
    watch_s: float = 4.0
    give_up_s: float = 20.0


class NextAction(Enum):
    """The next action of the caller."""

    WAIT = 'wait'
    PUSH = 'push'
    RESET = 'reset'
    DONE = 'done'


class NeverStoodError(UserError):
    """The robot does not stand, so it cannot be pushed."""


class PushSeries:
    """
    State machine that pushes in one direction after another, each time harder, until a fall.

    Before each push the robot must have stood for a while; after each, the simulation is reset.

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
        """The strongest impulse (N s) that the robot withstood in each direction; 0 if none."""

    @property
    def push(self) -> Push:
        """Return the push that is due, or whose effect is being watched."""
        return Push(self._left[0], self._impulse_ns)

    def update(self, time_s: float, stands: bool) -> NextAction:
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
        NextAction
            What the caller has to do now: with `PUSH`, apply `push`.

        Raises
        ------
        NeverStoodError
            The robot has not stood for long enough before the timeout.

        """
        if not self._left:
            return NextAction.DONE
        if self._waits_since_s is None:
            self._waits_since_s = time_s
        return (self._watch if self._is_pushed else self._settle)(time_s, stands)

    def _settle(self, time_s: float, stands: bool) -> NextAction:
        """Wait until the robot has stood for long enough."""
        assert self._waits_since_s is not None
        if not stands:
            self._stands_since_s = None
        elif self._stands_since_s is None:
            self._stands_since_s = time_s
        elif time_s - self._stands_since_s >= self._plan.settle_s:
            self._is_pushed, self._waits_since_s = True, time_s
            return NextAction.PUSH
        if time_s - self._waits_since_s > self._plan.give_up_s:
            raise NeverStoodError(
                f'The robot has not stood still for {self._plan.settle_s:g} s within '
                f'{self._plan.give_up_s:g} s, so it cannot be pushed. Reset the simulation and '
                'check that its controller is running.'
            )
        return NextAction.WAIT

    def _watch(self, time_s: float, stands: bool) -> NextAction:
        """Wait until it is clear whether the robot withstood the push."""
        assert self._waits_since_s is not None
        if stands and time_s - self._waits_since_s < self._plan.watch_s:
            return NextAction.WAIT
        self._conclude(stands)
        self._is_pushed, self._waits_since_s, self._stands_since_s = False, None, None
        return NextAction.RESET

    def _conclude(self, stood: bool) -> None:
        """Record the result, and proceed to a harder push or to the next direction."""
        if stood:
            self.stood_ns[self._left[0]] = self._impulse_ns
            self._impulse_ns += self._plan.step_ns
        if not stood or self._impulse_ns > self._plan.most_ns:
            del self._left[0]
            self._impulse_ns = self._plan.first_ns
