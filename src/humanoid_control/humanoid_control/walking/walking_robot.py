# SPDX-License-Identifier: Apache-2.0
"""Walking model of a robot: its legs, its joints, its standing posture, and its state."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from humanoid_control.backends import JointTargets, Observation
from humanoid_control.dynamics.body_model import BodyModel
from humanoid_control.dynamics.body_state import BodyState
from humanoid_control.dynamics.frames import Frame
from humanoid_control.dynamics.leg_ik import leg_posture, LegGeometry
from humanoid_control.dynamics.tree import JointGroup
from humanoid_control.walking.errors import WalkingError
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.planar import LEFT, NAMES, outwards, Point, RIGHT, SIDES
from humanoid_description.drives import Drive
from humanoid_description.kinematics import chain, pose_along
from humanoid_description.robot import Robot
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
HAND_JOINTS = ('wrist', 'gripper')
"""Walking does not use joints whose names contain one of these."""
_ROUNDS = 8
"""Iterations that put the feet below the centre of mass, which they shift slightly."""


@dataclass(frozen=True, eq=False)
class Leg:
    """Leg of a robot: its joint group, and its geometry for inverse kinematics."""

    group: JointGroup
    geometry: LegGeometry

    @classmethod
    def of(cls, robot: Robot, body: BodyModel, side: int) -> Leg:
        """
        Build the leg of a side.

        Parameters
        ----------
        robot, body
            The robot, and the model of its dynamics.
        side
            `LEFT` or `RIGHT`.

        Raises
        ------
        DynamicsError
            The robot has no such leg, or its kinematics are different.

        """
        geometry = LegGeometry.of(robot, NAMES[side])
        return cls(body.group(geometry.joints), geometry)

    @property
    def sole(self) -> str:
        """Return the name of its sole link."""
        return self.geometry.sole

    @property
    def indices(self) -> NDArray[np.intp]:
        """Return the indices of its joints among all, from the hip down (6,)."""
        return self.group.indices


@dataclass(frozen=True, eq=False)
class WalkingRobot:
    """
    Bipedal robot, with arrays in the order of the n joints that walking uses.

    Wrists and grippers are excluded: they have mass, but are assumed to be fixed at zero. `own`
    and `whole` convert the arrays of all joints to those of the walk, and back.
    """

    body: BodyModel
    prefix: str
    legs: tuple[Leg, Leg]
    imu_in_base: Array
    """(3, 3)"""
    joints: tuple[str, ...]
    """Names of all actuated joints, in the order of observations and targets."""
    indices: NDArray[np.intp]
    """(n,) indices among them of the joints that walking uses."""

    @classmethod
    def of(cls, robot: Robot, drives: Mapping[str, Drive], joints: Sequence[str]) -> WalkingRobot:
        """
        Build the walking model of a robot.

        Parameters
        ----------
        robot, drives
            The robot, and the actuators of its joints by joint name, with their armatures.
        joints
            All actuated joints, in the order of observations and targets.

        Raises
        ------
        WalkingError
            A joint has no actuator.
        DynamicsError
            The robot lacks a leg, or the kinematics of a leg are different.

        """
        undriven = [name for name in joints if name not in drives]
        if undriven:
            raise WalkingError(
                f'There is no drive for {", ".join(undriven)}. Add it to config/joints.yaml.'
            )
        own = [joint for joint in joints if not any(part in joint for part in HAND_JOINTS)]
        body = BodyModel.of(robot, own, [drives[joint].armature for joint in own])
        legs = (Leg.of(robot, body, LEFT), Leg.of(robot, body, RIGHT))
        imu = pose_along(chain(robot, robot.prefix + 'imu_link'), {})
        indices = np.array([joints.index(joint) for joint in own], dtype=np.intp)
        return cls(body, robot.prefix, legs, imu[:3, :3], tuple(joints), indices)

    def own(self, observation: Observation) -> Observation:
        """
        Select the joints that walking uses from an observation.

        Parameters
        ----------
        observation
            Observation of all actuated joints.

        Returns
        -------
        Observation
            Observation of the n joints that walking uses.

        Raises
        ------
        WalkingError
            An array of the observation has the wrong length.

        """
        whole, count = len(self.joints), len(self.indices)
        for name in ('positions_rad', 'velocities_rad_s', 'efforts_nm'):
            shape = getattr(observation, name).shape
            if shape != (whole,):
                raise WalkingError(
                    f'{name} has the shape {shape}, but the robot has {whole} joints.'
                )
        if count == whole:
            return observation
        return replace(
            observation,
            positions_rad=observation.positions_rad[self.indices],
            velocities_rad_s=observation.velocities_rad_s[self.indices],
            efforts_nm=observation.efforts_nm[self.indices],
        )

    def whole(self, targets: JointTargets) -> JointTargets:
        """
        Expand the targets of the walk to all actuated joints.

        Parameters
        ----------
        targets
            Targets of the n joints that walking uses.

        Returns
        -------
        JointTargets
            Targets of all actuated joints; zero for those that walking does not use.

        """
        if len(self.indices) == len(self.joints):
            return targets
        return JointTargets(
            self.spread(targets.positions_rad),
            self.spread(targets.velocities_rad_s),
            self.spread(targets.efforts_nm),
        )

    def spread(self, values: Array) -> Array:
        """
        Expand values of the joints that walking uses to all actuated joints.

        Parameters
        ----------
        values
            Values (n,) of the joints that walking uses.

        Returns
        -------
        Array
            One value for each of `joints`; zero for those that walking does not use.

        """
        spread = np.zeros(len(self.joints))
        spread[self.indices] = values
        return spread

    def index(self, joint: str) -> int:
        """
        Find the index of a joint in the arrays (n,) of the walk.

        Parameters
        ----------
        joint
            Its name without the prefix of the robot.

        Raises
        ------
        DynamicsError
            There is no such joint, or walking does not use it.

        """
        return self.body.index(self.prefix + joint)


@dataclass(frozen=True)
class Attitude:
    """Attitude of the pelvis, and its angular velocity in its own axes."""

    roll_rad: float
    pitch_rad: float
    yaw_rad: float
    rates_rad_s: tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class RobotState:
    """Estimated state of the robot at a time, with the heading relative to the odom frame."""

    time_s: float
    state: BodyState
    attitude: Attitude
    loads: tuple[float, float]
    """Normal forces on the soles, as fractions of the weight of the robot."""
    drags: tuple[Point, Point]
    """Horizontal forces on the soles, of the ground or an obstacle, as fractions of the weight."""
    efforts_nm: Array
    """(n,) measured actuator torques"""
    acceleration_m_s2: Array
    """(3,) acceleration of the IMU without gravity, in the axes of the odom frame"""


@dataclass(frozen=True, eq=False)
class HomePosture:
    """Standing posture: knees slightly bent, load points of the feet below the centre of mass."""

    positions_rad: Array
    """(n,)"""
    base_height_m: float
    com_height_m: float
    sole_forward_m: float
    """Position of the soles ahead of the base."""

    @classmethod
    def of(cls, robot: WalkingRobot, parameters: WalkParameters) -> HomePosture:
        """
        Compute the posture in which a robot stands, ready to walk.

        Moving the feet shifts the centre of mass as well: they are put below it iteratively.

        Parameters
        ----------
        robot, parameters
            The robot, and the gait parameters of its size, with crouch, step width and arms.

        Raises
        ------
        DynamicsError
            The robot lacks an elbow or a shoulder roll joint.

        """
        height_m = _stretched_height(robot) - parameters.posture.crouch_m
        positions = np.zeros(len(robot.body.joints))
        _place_arms(robot, parameters, positions)
        forward_m = 0.0
        for _ in range(_ROUNDS):
            _place_legs(robot, parameters, positions, forward_m, height_m)
            com = _com(robot, positions)
            forward_m = float(com[0]) - parameters.posture.zmp_forward_m
        _place_legs(robot, parameters, positions, forward_m, height_m)
        com_height_m = height_m + float(_com(robot, positions)[2])
        return cls(positions, height_m, com_height_m, forward_m)


def _place_arms(robot: WalkingRobot, parameters: WalkParameters, positions: Array) -> None:
    """Bend the elbows, and hold the arms away from the body."""
    for side, name in enumerate(NAMES):
        positions[robot.index(f'{name}_elbow')] = parameters.posture.elbow_rad
        roll_rad = outwards(side) * parameters.posture.shoulder_roll_rad
        positions[robot.index(f'{name}_shoulder_roll')] = roll_rad


def _place_legs(
    robot: WalkingRobot,
    parameters: WalkParameters,
    positions: Array,
    forward_m: float,
    height_m: float,
) -> None:
    """Put the feet side by side, flat, at an offset ahead of and below the base."""
    for side, leg in zip(SIDES, robot.legs):
        left_m = outwards(side) * parameters.footsteps.width_m / 2
        sole = Frame(np.array([forward_m, left_m, -height_m]), np.eye(3))
        positions[leg.indices] = leg_posture(leg.geometry, sole).positions_rad


def _com(robot: WalkingRobot, positions: Array) -> Array:
    """Compute the centre of mass (3,) relative to the upright base."""
    still = np.zeros(len(positions))
    return robot.body.state(np.eye(3), np.zeros(3), positions, still).com_m


def _stretched_height(robot: WalkingRobot) -> float:
    """Compute the height of the base on stretched legs."""
    still = np.zeros(len(robot.body.joints))
    state = robot.body.state(np.eye(3), np.zeros(3), still, still)
    return -float(state.position_m(robot.legs[0].sole)[2])
