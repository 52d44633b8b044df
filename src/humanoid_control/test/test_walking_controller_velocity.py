# SPDX-License-Identifier: Apache-2.0
"""Check that the walk as a controller passes the velocity on, and no more often than it must."""

from __future__ import annotations

from types import SimpleNamespace

from humanoid_control.controllers.walking import WalkingController
from humanoid_control.walking.velocity_command import STANDING, VelocityCommand

AHEAD = VelocityCommand(0.2)


class StubWalker:
    """Counts what it is told; a fall makes it forget its velocity by itself."""

    def __init__(self) -> None:
        self.robot = SimpleNamespace(joints=('knee',))
        self.velocity = STANDING
        self.commands = 0

    def command(self, velocity: VelocityCommand) -> None:
        """Take a velocity."""
        self.velocity = velocity
        self.commands += 1


def test_the_same_velocity_is_passed_on_once() -> None:
    """It comes at every tick, and changes seldom."""
    walker = StubWalker()
    controller = WalkingController(walker)
    for _ in range(3):
        controller.drive(AHEAD)
    assert (walker.velocity, walker.commands) == (AHEAD, 1)


def test_a_walker_that_forgot_is_told_again() -> None:
    """After a fall it goes on as whoever drives says, without a change of velocity."""
    walker = StubWalker()
    controller = WalkingController(walker)
    controller.drive(AHEAD)
    walker.velocity = STANDING
    controller.drive(AHEAD)
    assert walker.velocity == AHEAD
