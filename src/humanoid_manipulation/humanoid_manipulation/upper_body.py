# SPDX-License-Identifier: Apache-2.0
"""Inverse kinematics of an arm and the waist, with a diagnosis of unreachable poses."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
import math

from humanoid_control.dynamics.frames import Frame
from humanoid_description.drives import SIDES
from humanoid_description.kinematics import chain, poses
from humanoid_description.robot import Array, Robot
from humanoid_description.rotations import about_z, log
from humanoid_manipulation.arm_ik import Arm
from humanoid_manipulation.closed_form import Posture
from humanoid_manipulation.errors import ManipulationError
import numpy as np
from scipy.optimize import least_squares, minimize_scalar

__all__ = ['OutOfReachError', 'Reach', 'UpperBody']

_STEP_RAD = 0.15
"""Step between the waist angles that are tried first."""
_LEVER_M = 0.2
"""In the search for the nearest pose, a turn of the hand by 1 rad counts as this distance."""


_MOST_MINIMA = 3
_MOST_TRIES = 30
_START_RAD: Posture = (0.0, 0.0, 0.0, -0.6, 0.0, 0.0)
"""Start of the search for the nearest pose: a bent arm, far from singularities."""


@dataclass(frozen=True)
class Reach:
    """The waist angle (rad) and the posture of an arm."""

    waist_rad: float
    posture: Posture

    @property
    def positions_rad(self) -> Array:
        """Return the joint positions (7,), the waist first."""
        return np.array([self.waist_rad, *self.posture])


class OutOfReachError(ManipulationError):
    """
    A pose of the gripper is out of reach; the message states why.

    Attributes
    ----------
    nearest
        The reach that comes closest to it.
    pose
        The pose of the gripper at that reach, in the pelvis frame.

    """

    def __init__(self, message: str, nearest: Reach, pose: Frame) -> None:
        super().__init__(message)
        self.nearest, self.pose = nearest, pose


@dataclass(frozen=True, eq=False)
class UpperBody:
    """
    The arms of a robot, on a torso that its waist turns.

    Attributes
    ----------
    arms
        The arms by side.
    base, waist
        The link of the pelvis, and the joint that turns the torso about its z axis.
    waist_m
        The position of that joint in the pelvis frame (3,).
    lower_rad, upper_rad
        The limits of the waist.

    """

    arms: Mapping[str, Arm]
    base: str
    waist: str
    waist_m: Array
    lower_rad: float
    upper_rad: float

    @classmethod
    def of(cls, robot: Robot) -> UpperBody:
        """
        Extract the arms and the waist of a robot with hands.

        Parameters
        ----------
        robot
            The description of the robot.

        Raises
        ------
        ManipulationError
            The robot lacks an arm or the waist, or its kinematics differ.

        """
        arms = {side: Arm.of(robot, side) for side in SIDES}
        torso = next(iter(arms.values())).base
        joints = chain(robot, torso)
        driven = [joint for joint in joints if joint.is_driven]
        turned = poses(robot)[torso]
        is_waist = len(driven) == 1 and joints[-1] is driven[0]
        if not is_waist or not np.allclose(turned[:3, :3] @ driven[0].axis, (0.0, 0.0, 1.0)):
            raise ManipulationError(
                f"Between '{robot.roots[0]}' and '{torso}' there must be exactly one joint, "
                'which turns the torso about z.'
            )
        (waist,) = driven
        if waist.limits is None:
            raise ManipulationError(f"The joint '{waist.name}' needs limits.")
        lower, upper = waist.limits.lower, waist.limits.upper
        return cls(arms, robot.roots[0], waist.name, turned[:3, 3], lower, upper)

    def forward(self, side: str, reach: Reach) -> Frame:
        """
        Compute the forward kinematics of an arm and the waist: the pose of the gripper.

        Parameters
        ----------
        side
            `left` or `right`.
        reach
            The waist angle and the posture of the arm.

        Returns
        -------
        Frame
            The pose of the gripper in the pelvis (base_link).

        """
        in_torso = self.arms[side].forward(reach.posture)
        turn = about_z(reach.waist_rad)
        return Frame(self.waist_m + turn @ in_torso.position_m, turn @ in_torso.rotation)

    def reach(self, side: str, gripper: Frame, near: Reach | None = None) -> Reach:
        """
        Solve the inverse kinematics of an arm and the waist.

        Parameters
        ----------
        side
            `left` or `right`.
        gripper
            The target pose of the gripper in the pelvis frame.
        near
            The current posture. The waist turns no more than necessary, and the arm posture
            nearest in joint space is chosen.

        Raises
        ------
        OutOfReachError
            The pose is out of reach.

        """
        found = self.find(side, gripper, near)
        if found is None:
            raise self._out_of_reach(side, gripper, near)
        return found

    def find(self, side: str, gripper: Frame, near: Reach | None = None) -> Reach | None:
        """
        Solve the inverse kinematics of an arm and the waist; return None if out of reach.

        Parameters
        ----------
        side, gripper, near
            As for `reach`, which costs more if it fails, as it also finds the reason.

        """
        arm, start = self.arms[side], near.waist_rad if near else 0.0
        posture = near.posture if near else None
        misfits: dict[float, float] = {}
        for waist_rad in self._turns(start):
            pose = self._in_torso(gripper, waist_rad)
            postures = arm.postures(pose, posture)
            if postures:
                return Reach(waist_rad, postures[0])
            misfits[waist_rad] = _misfit(arm, pose)
        for waist_rad in _lowest(misfits):
            between = self._between(arm, gripper, waist_rad)
            if between is not None:
                return between
        return None

    def reach_with_arm(self, side: str, gripper: Frame, near: Reach) -> Reach:
        """
        Solve the inverse kinematics of an arm with the waist fixed at its current angle.

        Parameters
        ----------
        side, gripper, near
            As for `reach`.

        Raises
        ------
        OutOfReachError
            The pose is out of reach.

        """
        found = self.find_with_arm(side, gripper, near.waist_rad, near.posture)
        if found is None:
            raise self._out_of_reach(side, gripper, near)
        return found

    def find_with_arm(
        self, side: str, gripper: Frame, waist_rad: float, near: Posture | None = None
    ) -> Reach | None:
        """
        Solve the inverse kinematics of an arm with the waist fixed at a given angle.

        Parameters
        ----------
        side
            `left` or `right`.
        gripper
            The target pose of the gripper in the pelvis frame.
        waist_rad
            The angle of the waist.
        near
            The posture (rad) near which a solution is chosen, as for `Arm.postures`.

        Returns
        -------
        Reach or None
            The solution; None if the pose is out of reach.

        """
        postures = self.arms[side].postures(self._in_torso(gripper, waist_rad), near)
        return Reach(waist_rad, postures[0]) if postures else None

    def _turns(self, start_rad: float) -> Iterator[float]:
        """Yield waist angles: the current one, then others at increasing distance from it."""
        start_rad = min(max(start_rad, self.lower_rad), self.upper_rad)
        yield start_rad
        for number in range(1, math.ceil((self.upper_rad - self.lower_rad) / _STEP_RAD) + 1):
            for turn in (number * _STEP_RAD, -number * _STEP_RAD):
                if self.lower_rad <= start_rad + turn <= self.upper_rad:
                    yield start_rad + turn

    def _between(self, arm: Arm, gripper: Frame, near_rad: float) -> Reach | None:
        """Search for a reach with a waist angle between those already tried."""

        def misfit(waist_rad: float) -> float:
            return _misfit(arm, self._in_torso(gripper, waist_rad))

        bounds = (
            max(near_rad - _STEP_RAD, self.lower_rad),
            min(near_rad + _STEP_RAD, self.upper_rad),
        )
        best = minimize_scalar(
            misfit, bounds=bounds, method='bounded', options={'maxiter': 20, 'xatol': 1e-3}
        )
        postures = arm.postures(self._in_torso(gripper, float(best.x)))
        return Reach(float(best.x), postures[0]) if postures else None

    def _in_torso(self, gripper: Frame, waist_rad: float) -> Frame:
        """Transform a pose from the pelvis frame to the torso."""
        back = about_z(-waist_rad)
        return Frame(back @ (gripper.position_m - self.waist_m), back @ gripper.rotation)

    def _out_of_reach(self, side: str, gripper: Frame, near: Reach | None) -> OutOfReachError:
        """Create the error for an unreachable pose: the reason, and the nearest reach."""
        nearest = self._nearest(side, gripper, near)
        pose = self.forward(side, nearest)
        gap_m = float(np.linalg.norm(gripper.position_m - pose.position_m))
        turn = math.degrees(float(np.linalg.norm(log(pose.rotation.T @ gripper.rotation))))
        if gap_m > turn / 90.0 * _LEVER_M:
            why = f'the {side} hand cannot get closer than {gap_m:.2f} m'
        else:
            why = f'the {side} hand cannot turn that way there: it is {turn:.0f} degrees short'
        x, y, z = gripper.position_m
        return OutOfReachError(
            f'x {x:.2f}, y {y:.2f}, z {z:.2f} m from the pelvis is out of reach: {why}.',
            nearest,
            pose,
        )

    def _nearest(self, side: str, gripper: Frame, near: Reach | None) -> Reach:
        """Find the reach that comes closest to a pose, by least squares."""
        arm = self.arms[side]
        lower = np.array([self.lower_rad, *arm.lower_rad])
        upper = np.array([self.upper_rad, *arm.upper_rad])
        start = (0.0, *_START_RAD) if near is None else (near.waist_rad, *near.posture)

        def errors(joints: Array) -> Array:
            pose = self.forward(side, Reach(joints[0], tuple(joints[1:])))
            turned = log(pose.rotation.T @ gripper.rotation)
            return np.concatenate((gripper.position_m - pose.position_m, _LEVER_M * turned))

        begin = np.clip(start, lower + 1e-6, upper - 1e-6)
        solution = least_squares(errors, begin, bounds=(lower, upper), max_nfev=_MOST_TRIES)
        waist_rad, *posture = solution.x.tolist()
        return Reach(waist_rad, tuple(posture))


def _misfit(arm: Arm, pose: Frame) -> float:
    """
    Compute by how far a pose is out of reach: zero or less if it is within reach.

    Up to pi it is by how much (rad) a joint would have to exceed its limits; beyond, there is no
    solution at all, and it grows with the distance to the workspace (m).
    """
    excess_rad = min(map(arm.excess_rad, arm.solutions(pose)), default=math.inf)
    return excess_rad if excess_rad < math.inf else math.pi + arm.lack_m(pose)


def _lowest(values: Mapping[float, float]) -> list[float]:
    """Return the keys of the lowest local minima, the lowest first."""
    places = sorted(values)
    padded = [math.inf, *(values[place] for place in places), math.inf]
    minima = [
        (middle, place)
        for before, middle, after, place in zip(padded, padded[1:], padded[2:], places)
        if middle <= before and middle <= after
    ]
    return [place for _, place in sorted(minima)[:_MOST_MINIMA]]
