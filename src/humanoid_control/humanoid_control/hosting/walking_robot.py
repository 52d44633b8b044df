# SPDX-License-Identifier: Apache-2.0
"""Walking robot: its walker and its control."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from humanoid_control.backends import ImuNoise
from humanoid_control.controllers import follow_mode, hold_mode
from humanoid_control.controllers.silence import Clock
from humanoid_control.controllers.walking import walking_mode, WalkingController
from humanoid_control.hosting.robot_control import RobotControl
from humanoid_control.limits import JointLimits
from humanoid_control.walking.body_pose import BodyPose
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.velocity_command import VelocityCommand
from humanoid_control.walking.walker import Walker
from humanoid_description.drives import Drive
from humanoid_description.robot import Robot


@dataclass(frozen=True, eq=False)
class WalkingRobotControl:
    """The walker of a robot, and its control."""

    walker: Walker
    control: RobotControl

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
        able: Callable[[VelocityCommand], VelocityCommand] = lambda velocity: velocity,
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
        walking = WalkingController(walker)
        modes = (walking_mode(walking), follow_mode(joints), hold_mode(joints))
        limits = JointLimits.of(drives, joints)

        def drive(velocity: VelocityCommand) -> None:
            walking.drive(able(velocity))

        def hold_body(pose: BodyPose | None) -> None:
            if pose is None:
                walker.freeze()
            else:
                walker.hold(pose)

        control = RobotControl(joints, limits, modes, drive, clock, say, hold_body)
        return cls(walker, control)
