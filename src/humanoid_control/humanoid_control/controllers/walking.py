# SPDX-License-Identifier: Apache-2.0
"""The walk as a controller of all joints, which lends those above the legs."""

from __future__ import annotations

from humanoid_control.backends import JointTargets, Observation
from humanoid_control.controllers.modes import Mode
from humanoid_control.walking.velocity_command import VelocityCommand
from humanoid_control.walking.walker import Walker

LENT = ('head_', 'waist_', 'shoulder', 'elbow', 'wrist', 'gripper')
"""A joint whose name contains one of these is not needed to walk."""

MOVING = ('walk', 'stop', 'stand_up')
DOWN = 'the robot has fallen, and is not on its feet again'


class WalkingController:
    """Walks, or stands when its velocity is zero."""

    name = 'walking'

    def __init__(self, walker: Walker) -> None:
        """Take the walker."""
        self.walker = walker
        self.joints = walker.robot.joints

    def start(self, observation: Observation, held: JointTargets) -> None:
        """Begin from where the feet are, without a velocity."""
        self.walker.restart()

    def update(self, observation: Observation) -> JointTargets:
        """Return the targets for the coming period."""
        return self.walker.update(observation)

    def is_at_rest(self) -> bool:
        """Tell whether the robot can be held as it is: in the middle of a step it would fall."""
        return self.walker.phase not in MOVING

    def needs_all_because(self) -> str:
        """Return why it lends nothing for the moment, or nothing."""
        return DOWN if self.walker.has_fallen else ''

    def drive(self, velocity: VelocityCommand) -> None:
        """Walk at a velocity; the same one again costs nothing."""
        if velocity != self.walker.velocity:
            self.walker.command(velocity)


def walking_mode(controller: WalkingController) -> Mode:
    """Return the mode in which the robot walks; legs are not lent."""
    lent = tuple(joint for joint in controller.joints if any(part in joint for part in LENT))
    return Mode(
        controller.name,
        controller,
        lent,
        may_end=controller.is_at_rest,
        needs_all_because=controller.needs_all_because,
        forget=controller.walker.reset,
        supports=True,
    )
