# SPDX-License-Identifier: Apache-2.0
"""Walking robot: its walker as the controller of a mode, and its control."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from humanoid_control.backends import ImuNoise, JointLimits, JointTargets, Observation
from humanoid_control.controllers import follow_mode, hold_mode
from humanoid_control.controllers.command_controllers import Clock
from humanoid_control.controllers.modes import DOWN, Mode
from humanoid_control.hosting.robot_control import RobotControl
from humanoid_control.policy.controller import PolicyController
from humanoid_control.policy.policy import Policy, PolicyRobot
from humanoid_control.walking.commands import BodyPose, VelocityCommand
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.walker import Walker
from humanoid_description.drives import Drive
from humanoid_description.robot import Robot
import numpy as np

CLAIMABLE = ('head_', 'waist_', 'shoulder', 'elbow', 'wrist', 'gripper')
"""A joint whose name contains one of these is not needed to walk."""
MOVING = ('walk', 'stop', 'stand_up')
Able = Callable[[VelocityCommand], VelocityCommand]
"""Maps a commanded velocity to what the robot can do, before the limits of the gait."""


class WalkingController:
    """
    Controller of all joints that walks, or stands when its velocity is zero.

    Parameters
    ----------
    walker
        Computes the joint targets of the gait; it has the joints of the robot.
    able
        Maps a commanded velocity to what the robot can do; by default it is the same.

    """

    name = 'walking'

    def __init__(self, walker: Walker, able: Able = lambda velocity: velocity) -> None:
        self.walker, self._able = walker, able
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

    def walk(self, velocity: VelocityCommand) -> None:
        """
        Pass a walking velocity on to the walker when it has changed; zero stops.

        Parameters
        ----------
        velocity
            Velocity of the body in its own axes; the gait limits it to what is feasible.

        """
        velocity = self._able(velocity)
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


@dataclass(frozen=True, eq=False)
class WalkingRobotControl:
    """The walker of a robot, its control, and what runs policies on it."""

    walker: Walker
    control: RobotControl
    policy: PolicyController

    @property
    def home_rad(self) -> dict[str, float]:
        """Return the joint positions of a robot that stands ready to walk, by joint name."""
        home_rad = self.walker.robot.spread(self.walker.home.positions_rad)
        return dict(zip(self.walker.robot.joints, home_rad.tolist()))

    @classmethod
    def of(
        cls,
        robot: Robot,
        drives: Mapping[str, Drive],
        walk: WalkParameters = WalkParameters(),
        clock: Clock | None = None,
        say: Callable[[str], None] = lambda sentence: None,
        able: Able = lambda velocity: velocity,
        imu: ImuNoise = ImuNoise(),
    ) -> WalkingRobotControl:
        """
        Build the walker and the controllers of a robot, which starts in the mode `walking`.

        Parameters
        ----------
        robot
            The model from its URDF.
        drives
            The actuators of all joints, in the order of observations and targets.
        walk
            The parameters of the walk, scaled to the size of the robot.
        clock
            The computer's clock: commands expire when the timeout has passed by it and by the
            robot's time; by default only the robot's time counts.
        say
            Receives a message when a controller asks for targets that are not finite.
        able
            Maps a commanded velocity to what the robot can do, before the limits of the gait.
        imu
            Noise of the IMU, which makes the odometry uncertain.

        """
        joints = tuple(drives)
        walker = Walker.of(robot, drives, joints, walk, imu)
        walking = WalkingController(walker, able)
        limits = JointLimits.of(drives, joints)
        kd_nm_s_rad = np.array([drives[joint].kd for joint in joints])
        known = PolicyRobot(
            joints, walker.robot.prefix, limits, kd_nm_s_rad, walker.robot.imu_in_base
        )
        policy = PolicyController(known, walker, say)
        modes = (
            walking_mode(walking), follow_mode(joints), hold_mode(joints), policy.mode()
        )  # fmt: skip

        def walk_at(velocity: VelocityCommand) -> None:
            walking.walk(velocity)
            policy.walk(velocity)

        def hold_body(pose: BodyPose | None) -> None:
            if pose is None:
                walker.freeze()
            else:
                walker.hold(pose)

        control = RobotControl(joints, limits, modes, walk_at, clock, say, hold_body)
        walker.may_get_up = lambda: not control.must_hold
        return cls(walker, control, policy)

    def use_policy(self, policy: Policy) -> None:
        """
        Let the mode `policy` run a policy from now on.

        Parameters
        ----------
        policy
            The policy, loaded for this robot.

        """
        self.policy.policy = policy
        self.control.manager.replace(self.policy.mode())
