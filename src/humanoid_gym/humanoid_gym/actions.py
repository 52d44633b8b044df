# SPDX-License-Identifier: Apache-2.0
"""How an action of the agent, from -1 to 1, moves the robot."""

from __future__ import annotations

from typing import Protocol

from humanoid_control.backends import Array, JointLimits, JointTargets, Observation
from humanoid_control.walking import VelocityCommand, VelocityLimits, WalkParameters
from humanoid_description.drives import load_drives
from humanoid_simulation.testing.lockstep_robot import LockstepRobot
import numpy as np

MOST_RAD = 0.5
"""How far a joint target is from the home posture at most, where the agent keeps the balance."""


class Actions(Protocol):
    """Meaning of the actions of an environment."""

    @property
    def size(self) -> int:
        """Return the number of values in an action."""

    def take(self, action: Array) -> None:
        """
        Obey an action from the next control period on.

        Parameters
        ----------
        action
            The values (size,), from -1 to 1.

        """

    def targets(self, observation: Observation) -> JointTargets:
        """
        Compute the joint targets of a control period. Call once per period.

        Parameters
        ----------
        observation
            Sensor values at the start of the period, with the time since the reset.

        """


class JointRange:
    """
    Positions of m joints: -1 is the lower end of their range, 0 the home posture, 1 the upper end.

    Parameters
    ----------
    lower_rad, home_rad, upper_rad
        The ends of the range, and the home posture between them (m,).

    """

    def __init__(self, lower_rad: Array, home_rad: Array, upper_rad: Array) -> None:
        self._home_rad = home_rad
        self._below_rad, self._above_rad = home_rad - lower_rad, upper_rad - home_rad

    def positions_rad(self, action: Array) -> Array:
        """
        Convert an action to joint positions.

        Parameters
        ----------
        action
            The values (m,), from -1 to 1.

        """
        way_rad = np.where(action < 0.0, self._below_rad, self._above_rad)
        positions: Array = self._home_rad + action * way_rad
        return positions

    def action(self, positions_rad: Array) -> Array:
        """
        Convert joint positions to the action that commands them.

        Parameters
        ----------
        positions_rad
            Positions (m,) within the range.

        """
        way_rad = positions_rad - self._home_rad
        return way_rad / np.where(way_rad < 0.0, self._below_rad, self._above_rad)


class JointActions:
    """
    Targets for all n joints around the home posture, held by the servos; nothing else balances.

    A servo exerts kp (target - q) - kd dq, with the gains and limits of the robot's drives.

    Parameters
    ----------
    robot
        The robot, in its home posture.

    """

    def __init__(self, robot: LockstepRobot) -> None:
        joints = robot.backend.joints
        limits = JointLimits.of(load_drives(), joints)
        home_rad = robot.backend.observe()[''].positions_rad
        self._range = JointRange(
            np.maximum(limits.lower_rad, home_rad - MOST_RAD),
            home_rad,
            np.minimum(limits.upper_rad, home_rad + MOST_RAD),
        )
        self.size = len(joints)
        self._zero = np.zeros(self.size)
        self.take(self._zero)

    def take(self, action: Array) -> None:
        """
        Move the targets of all joints, see `Actions.take`.

        Parameters
        ----------
        action
            The values (n,), in the order of the joints.

        """
        self._targets = JointTargets(self._range.positions_rad(action), self._zero, self._zero)

    def targets(self, observation: Observation) -> JointTargets:
        """
        Return the joint targets of the last action.

        Parameters
        ----------
        observation
            Not used: only the agent reacts to the sensors.

        """
        return self._targets


class VelocityActions:
    """
    A velocity for the robot's own walk: forward, to the left, anticlockwise.

    Parameters
    ----------
    robot
        The robot.

    """

    size = 3

    def __init__(self, robot: LockstepRobot) -> None:
        self._control = robot.walking.control
        limits = VelocityLimits.of(WalkParameters().velocity)
        self._most = np.array([limits.forward_m_s, limits.left_m_s, limits.turn_rad_s])
        self._velocity = VelocityCommand()

    def take(self, action: Array) -> None:
        """
        Command a velocity, see `Actions.take`.

        Parameters
        ----------
        action
            The velocity (3,), in shares of the limits of the walk.

        """
        self._velocity = VelocityCommand(*(action * self._most).tolist())

    def targets(self, observation: Observation) -> JointTargets:
        """
        Compute the joint targets of the walk, see `Actions.targets`.

        Parameters
        ----------
        observation
            Sensor values at the start of the period.

        """
        self._control.walk(self._velocity)
        return self._control.update(observation)


class ArmActions:
    """
    Targets for the joints of an arm, within their limits; the robot's own walk balances.

    Parameters
    ----------
    robot
        The robot, in its home posture.
    joints
        Names of the m joints of the arm.

    """

    def __init__(self, robot: LockstepRobot, joints: tuple[str, ...]) -> None:
        self._control, self._joints = robot.walking.control, joints
        limits = JointLimits.of(load_drives(), joints)
        indices = [robot.backend.joints.index(joint) for joint in joints]
        home_rad = robot.backend.observe()[''].positions_rad[indices]
        self.range = JointRange(limits.lower_rad, home_rad, limits.upper_rad)
        """The positions that actions stand for."""
        self.size = len(joints)

    def take(self, action: Array) -> None:
        """
        Command the arm as the topic `joint_commands` would, see `Actions.take`.

        Parameters
        ----------
        action
            The values (m,), in the order of the joints.

        """
        self._control.follow(self._joints, self.range.positions_rad(action).tolist())

    def targets(self, observation: Observation) -> JointTargets:
        """
        Compute the targets of all joints, with the legs balancing, see `Actions.targets`.

        Parameters
        ----------
        observation
            Sensor values at the start of the period.

        """
        return self._control.update(observation)
