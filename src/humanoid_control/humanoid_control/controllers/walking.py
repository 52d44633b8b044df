# SPDX-License-Identifier: Apache-2.0
"""Walking controller, and the mode that leaves the joints above the legs to other controllers."""

from __future__ import annotations

from humanoid_control.backends import JointTargets, Observation
from humanoid_control.controllers.modes import Mode
from humanoid_control.walking.velocity_command import VelocityCommand
from humanoid_control.walking.walker import Walker

CLAIMABLE = ('head_', 'waist_', 'shoulder', 'elbow', 'wrist', 'gripper')
"""A joint whose name contains one of these is not needed to walk."""

MOVING = ('walk', 'stop', 'stand_up')
DOWN = 'the robot has fallen, and is not on its feet again'


class WalkingController:
    """
    Controller of all joints that walks, or stands when its velocity is zero.

    Parameters
    ----------
    walker
        Computes the joint targets of the gait; it has the joints of the robot.

    """

    name = 'walking'

    def __init__(self, walker: Walker) -> None:
        self.walker = walker
        self.joints = walker.robot.joints

    def start(self, observation: Observation, held: JointTargets) -> None:
        """
        Restart the walk from where the feet are at the next `update`, with zero velocity.

        Parameters
        ----------
        observation, held
            As for `Controller.start`; not used.

        """
        self.walker.restart()

    def update(self, observation: Observation) -> JointTargets:
        """
        Compute the joint targets of the walk, as for `Controller.update`.

        Parameters
        ----------
        observation
            Sensor values of the current period.

        Returns
        -------
        JointTargets
            Targets of all n joints of the robot, including claimed ones.

        Raises
        ------
        WalkingError
            The observation has arrays of the wrong length or values that are not finite.

        """
        return self.walker.update(observation)

    def is_at_rest(self) -> bool:
        """Check whether the robot can be held as it is; in the middle of a step it would fall."""
        return self.walker.phase not in MOVING

    def needs_all_because(self) -> str:
        """Return the reason for keeping all joints at the moment; empty if there is none."""
        return DOWN if self.walker.has_fallen else ''

    def drive(self, velocity: VelocityCommand) -> None:
        """
        Set the walking velocity; zero stops. Repeating the same velocity costs nothing.

        Parameters
        ----------
        velocity
            Velocity of the body in its own axes; the gait limits it to what is feasible.

        """
        if velocity != self.walker.velocity:
            self.walker.command(velocity)


def walking_mode(controller: WalkingController) -> Mode:
    """
    Build the mode in which the robot walks and leaves the joints above the legs to controllers.

    Parameters
    ----------
    controller
        The controller of all joints of the robot.

    """
    claimable = tuple(
        joint for joint in controller.joints if any(part in joint for part in CLAIMABLE)
    )
    return Mode(
        controller.name,
        controller,
        claimable,
        may_end=controller.is_at_rest,
        needs_all_because=controller.needs_all_because,
        forget=controller.walker.reset,
        supports=True,
    )
