# SPDX-License-Identifier: Apache-2.0
"""A loop that stands still after an error."""

from __future__ import annotations

from humanoid_simulation.errors import SimulationError
from humanoid_simulation.simulated_world import GuardedLoop


class Fragile:
    """A backend that breaks when it is told to."""

    robots = ('',)
    joints = ()
    period_s = 0.01

    def __init__(self) -> None:
        self.steps = 0
        self.is_broken = False

    def observe(self):
        return {'': self.steps}

    def step(self, targets) -> None:
        if self.is_broken:
            raise SimulationError('It broke.')
        self.steps += 1

    def reset(self, keyframe: str = 'home') -> None:
        self.is_broken = False

    def close(self) -> None:
        pass


def test_an_error_is_said_once_and_nothing_goes_on_before_a_reset() -> None:
    """The error reaches the user, not the thread that ticks; a reset mends it."""
    said: list[str] = []
    backend = Fragile()
    loop = GuardedLoop(backend, {}, said.append)
    loop.tick()
    backend.is_broken = True
    assert [loop.tick(), loop.tick(), loop.tick()] == [{'': 1}] * 3
    assert said == ['It broke.']
    assert loop.has_failed
    loop.reset()
    loop.tick()
    assert (backend.steps, loop.has_failed) == (2, False)
