# SPDX-License-Identifier: Apache-2.0
"""Walking controller: from observations and a velocity command to joint targets."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from humanoid_control.backends import Array, ImuNoise, JointTargets, Observation
from humanoid_control.walking.commands import BodyPose, STANDING, UPRIGHT, VelocityCommand
from humanoid_control.walking.odometry import Odometry, Uncertainty
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.planar import LEFT, PlanarPose, Point, RIGHT
from humanoid_control.walking.recovery import Recovery
from humanoid_control.walking.state_estimator import StateEstimator
from humanoid_control.walking.support_polygon import FootShape
from humanoid_control.walking.walk import Walk, WalkStatus
from humanoid_control.walking.walking_robot import HomePosture, RobotState, WalkingRobot
from humanoid_description.drives import Drive
from humanoid_description.robot import Robot
from humanoid_description.rotations import quaternion_of


def _always() -> bool:
    """Let the robot get up at any time."""
    return True


@dataclass(eq=False)
class Walker:
    """
    Controller that makes a robot stand and walk.

    Call `update` with an observation in every control period, at any rate; periods may be missed.
    The walk starts with the first observation, from wherever the feet stand then.
    """

    robot: WalkingRobot
    shape: FootShape
    home: HomePosture
    parameters: WalkParameters
    imu: ImuNoise = field(default_factory=ImuNoise)
    may_get_up: Callable[[], bool] = _always
    """Returns whether the robot may get up by itself when it lies on the ground."""
    recovery: Recovery = field(init=False)
    """What it does after a fall."""
    _estimator: StateEstimator = field(init=False)
    _velocity: VelocityCommand = field(init=False, default=STANDING)
    _body: BodyPose = field(init=False, default=UPRIGHT)
    _walk: Walk | None = field(init=False, default=None)
    _targets: JointTargets | None = field(init=False, default=None)
    _start_m: Point = field(init=False, default=0j)
    _uncertainty: Uncertainty = field(init=False)

    def __post_init__(self) -> None:
        self.reset()

    @classmethod
    def of(
        cls,
        robot: Robot,
        drives: Mapping[str, Drive],
        joints: Sequence[str],
        parameters: WalkParameters,
        imu: ImuNoise = ImuNoise(),
    ) -> Walker:
        """
        Build the walker of a robot.

        Parameters
        ----------
        robot, drives
            The robot, and the actuators of its joints by joint name.
        joints
            All actuated joints, in the order of observations and targets.
        parameters : WalkParameters
            Gait parameters; `WalkParameters().scaled(scale)` for a robot of another size.
        imu
            Errors of the IMU, from which the covariance of the odometry is computed.

        Raises
        ------
        WalkingError
            A joint has no actuator, or a foot has no collision shape.
        DynamicsError
            The robot lacks a joint that walking needs, or the kinematics of a leg are different.

        """
        walking = WalkingRobot.of(robot, drives, joints)
        return cls(
            walking,
            FootShape.of(robot, parameters.posture),
            HomePosture.of(walking, parameters),
            parameters,
            imu,
        )

    def reset(self) -> None:
        """Reset all state, after the robot has been placed elsewhere; odometry starts again."""
        self._estimator = StateEstimator(self.robot)
        self.recovery = Recovery(
            self.robot, self.shape, self.home, self.parameters, lambda: self.may_get_up()
        )
        self._uncertainty = Uncertainty(self.imu, self.home.base_height_m)
        self._start_m = 0j
        self._walk = self._targets = None
        self._velocity, self._body = STANDING, UPRIGHT

    def restart(self) -> None:
        """Restart the walk from where the feet are at the next update; odometry continues."""
        if self._walk:
            x, y, _ = self._walk.base.position_m.tolist()
            self._start_m = complex(x, y)
        self._walk = self._targets = None
        self._velocity, self._body = STANDING, UPRIGHT

    @property
    def velocity(self) -> VelocityCommand:
        """Return the commanded velocity; zero after a reset, a restart or a fall."""
        return self._velocity

    def command(self, velocity: VelocityCommand) -> None:
        """
        Set the velocity command.

        A velocity other than zero also resets the body pose to upright.

        Parameters
        ----------
        velocity
            Velocity in the axes of the robot; the gait clamps it to its limits. Zero stops.

        """
        self._velocity = velocity
        if not velocity.is_zero:
            self._body = UPRIGHT

    @property
    def pose(self) -> BodyPose:
        """Return the commanded body pose; upright after a reset, a restart or a fall."""
        return self._body

    def hold(self, pose: BodyPose) -> None:
        """
        Hold a body pose until a velocity other than zero is commanded.

        Parameters
        ----------
        pose
            Target pose of the body; it is clamped to the limits of the robot.

        Raises
        ------
        WalkingError
            The pose is not finite.

        """
        self._body = pose.within(self.parameters.body_pose)

    def update(self, observation: Observation) -> JointTargets:
        """
        Compute the joint targets until the next control period.

        For an observation that is not newer than the last one, the same targets are returned.

        Parameters
        ----------
        observation
            Observation of all actuated joints.

        Returns
        -------
        JointTargets
            Targets of all actuated joints, in the same order.

        Raises
        ------
        WalkingError
            An array of the observation has the wrong length, or `StateEstimator.read` rejects it.

        """
        last_s = self._walk.sensed.time_s if self._walk else None
        if self._targets and last_s is not None and observation.time_s <= last_s:
            return self._targets
        own = self.robot.own(observation)
        sensed = self._estimator.read(own)
        walk = self._walk or self._begin(sensed)
        targets = self._recover(walk, sensed, own.positions_rad)
        if targets is None:
            walk = self._walk or self._begin(sensed)
            targets = walk.update(sensed, self._velocity, self._body)
        self._uncertainty.update(_pose(walk), sensed.time_s)
        self._targets = self.robot.whole(targets)
        return self._targets

    def watch(self, observation: Observation) -> JointTargets | None:
        """
        Watch for a fall while another controller moves the robot; call it instead of `update`.

        Parameters
        ----------
        observation
            Observation of all actuated joints.

        Returns
        -------
        JointTargets or None
            Targets of all actuated joints while the robot is down; None while it stands.

        Raises
        ------
        WalkingError
            As for `update`.

        """
        own = self.robot.own(observation)
        sensed = self._estimator.read(own)
        targets = self.recovery.update(sensed, own.positions_rad)
        return None if targets is None else self.robot.whole(targets)

    @property
    def has_fallen(self) -> bool:
        """Whether the robot is falling, lies on the ground or is standing up."""
        return self.recovery.phase is not None

    @property
    def is_blocked(self) -> bool:
        """Whether an obstacle blocks the way of the robot."""
        walk = self._walk
        return walk is not None and walk.gait.is_blocked and not self.has_fallen

    def freeze(self) -> None:
        """Hold the present body pose instead of moving to the commanded one."""
        if self._walk:
            self.hold(self._walk.body.pose)

    def _begin(self, sensed: RobotState) -> Walk:
        """Start a walk from where the feet are."""
        self._walk = Walk(
            self.robot, self.shape, self.home, self.parameters, sensed, self._start_m
        )
        return self._walk

    def _recover(
        self, walk: Walk, sensed: RobotState, positions_rad: Array
    ) -> JointTargets | None:
        """Advance the fall recovery; return its targets, or None if the robot walks (again)."""
        was_down = self.has_fallen
        targets = self.recovery.update(sensed, positions_rad)
        if targets is not None:
            walk.lie(sensed)
        elif was_down:
            self.restart()
        return targets

    @property
    def phase(self) -> str | None:
        """Return the phase, as in `WalkStatus`; None before the first update."""
        return self.recovery.phase or (self._walk.gait.phase if self._walk else None)

    @property
    def status(self) -> WalkStatus | None:
        """Return the status of the walk; None before the first update."""
        walk, phase = self._walk, self.phase
        if walk is None or phase is None:
            return None
        # A robot that is down has no plan: no foot carries it, and its references are its state.
        output = None if self.has_fallen else walk.output
        return WalkStatus(
            phase=phase,
            support=output.sides if output else (),
            feet=(walk.footing.pose(LEFT), walk.footing.pose(RIGHT)),
            footsteps=walk.gait.footsteps if output else (),
            odometry=_odometry(walk, self._uncertainty.covariance),
            dcm_m=walk.dcm_m,
            dcm_reference_m=output.reference.dcm_m if output else walk.dcm_m,
            zmp_m=output.zmp_m if output else walk.dcm_m,
            zmp_reference_m=output.reference.zmp_m if output else walk.dcm_m,
        )


def _pose(walk: Walk) -> PlanarPose:
    """Return the pose of the base in the plane of the odom frame."""
    x, y, _ = walk.base.position_m.tolist()
    return PlanarPose(complex(x, y), walk.sensed.attitude.yaw_rad)


def _odometry(walk: Walk, covariance: Array) -> Odometry:
    """Build the odometry: pose, velocities and covariance of the base."""
    state = walk.sensed.state
    to_base = state.base_rotation.T
    return Odometry(
        pose=_pose(walk),
        height_m=walk.height_m,
        orientation=quaternion_of(state.base_rotation),
        linear_velocity_m_s=to_base @ walk.base.velocity_m_s,
        angular_velocity_rad_s=to_base @ state.base_angular_velocity_rad_s,
        covariance=covariance,
    )
