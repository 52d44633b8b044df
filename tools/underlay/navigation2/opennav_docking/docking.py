# SPDX-License-Identifier: Apache-2.0
"""The steps of docking and undocking."""

from __future__ import annotations

from collections.abc import Callable
import math
from typing import Any, TYPE_CHECKING

from builtin_interfaces.msg import Duration
from nav2_behaviors.collision_checker import CannotCheck
from nav2_msgs.action import DockRobot
from nav2_util import ActionAborted, ActionServer, Rate, TransformError
from nav2_util.geometry import make_pose_stamped, Pose2D, wrap_angle
from nav2_util.timing import now_s
from nav2_util.twist import Velocity
import numpy as np

from opennav_docking.approach import approach_velocity, STRAIGHT_M, turn_velocity
from opennav_docking.dock_database import Dock
from opennav_docking.dock_types import SimpleNonChargingDock

if TYPE_CHECKING:
    from opennav_docking.docking_server import DockingServer
    from opennav_docking.staging import StagingNavigator

__all__ = ['Docking']

_CODES = DockRobot.Result
_PHASES = DockRobot.Feedback
_MAX_AGE_S = 1.0


class _Failed(ActionAborted):
    """An attempt has failed; another one may succeed."""


class Docking:
    """
    One goal of the docking server.

    Parameters
    ----------
    node
        The docking server, with its parameters.
    server
        The action server of the goal.
    kind
        The type of the dock.

    """

    def __init__(
        self, node: DockingServer, server: ActionServer, kind: SimpleNonChargingDock
    ) -> None:
        self._node, self._server, self._kind = node, server, kind
        self._told, self._values = node.told.current, node.approach.current
        self._began_s = now_s(node)
        self._retries = 0

    async def dock(self, dock: Dock, goal: Any, navigator: StagingNavigator) -> None:
        """
        Bring the robot to a dock, with further attempts after failures.

        Parameters
        ----------
        dock
            The dock.
        goal
            The goal of `DockRobot`.
        navigator
            The client of the navigator.

        Raises
        ------
        ActionAborted
            The robot is not docked.

        """
        await self._go_to_staging_pose(dock, goal, navigator)
        while True:
            pose = self._in_fixed_frame(dock)
            try:
                await self._detect(pose)
                last = await self._drive_to_dock(pose)
                await self._wait_for_charge(last)
                return
            except _Failed as failure:
                await self._prepare_another_attempt(pose, failure)

    async def undock(self, timeout_s: float) -> None:
        """
        Drive the robot from the dock to the staging pose.

        Parameters
        ----------
        timeout_s
            The time limit; none if 0.

        Raises
        ------
        ActionAborted
            The robot is not there, or is still charged.

        """
        here = self._robot()
        await self._drive_back(here, self._kind.staging_pose(here), timeout_s or math.inf)
        end_s = now_s(self._node) + self._told.wait_charge_timeout
        with self._rate() as rate:
            while self._kind.is_charging(math.inf):
                self._server.check()
                if now_s(self._node) > end_s:
                    raise ActionAborted(
                        _CODES.FAILED_TO_CONTROL,
                        'The robot has left the dock, but its battery is still charged.',
                    )
                await rate.tick()

    async def _go_to_staging_pose(
        self, dock: Dock, goal: Any, navigator: StagingNavigator
    ) -> None:
        self._tell(_PHASES.NAV_TO_STAGING_POSE)
        staging = self._kind.staging_pose(dock.pose)
        if not goal.navigate_to_staging_pose or self._is_near(staging, dock.frame):
            return
        stamp = self._node.get_clock().now().to_msg()
        pose = make_pose_stamped(staging, dock.frame, stamp)
        tree = self._told.navigator_bt_xml
        await navigator.navigate(self._server, pose, tree, goal.max_staging_time)

    def _is_near(self, staging: Pose2D, frame: str) -> bool:
        robot = self._robot(frame)
        distance = math.hypot(robot.distance_to(staging), wrap_angle(robot.yaw - staging.yaw))
        return distance < self._told.dock_prestaging_tolerance

    async def _detect(self, dock: Pose2D) -> None:
        """Wait until the dock is detected."""
        self._tell(_PHASES.INITIAL_PERCEPTION)
        end_s = now_s(self._node) + self._told.initial_perception_timeout
        with self._rate() as rate:
            while self._kind.refined_pose(dock) is None:
                self._server.check()
                if now_s(self._node) > end_s:
                    raise _Failed(
                        _CODES.FAILED_TO_DETECT_DOCK,
                        "The dock was not detected: nothing new came on 'detected_dock_pose'.",
                    )
                await rate.tick()

    async def _drive_to_dock(self, dock: Pose2D) -> float:
        """Drive until the robot is docked; return its distance from the docking pose in m."""
        self._tell(_PHASES.CONTROLLING)
        is_near = False
        end_s = now_s(self._node) + self._told.dock_approach_timeout
        with self._rate() as rate:
            while True:
                self._server.check()
                target = self._kind.refined_pose(dock)
                if target is None:
                    raise _Failed(
                        _CODES.FAILED_TO_DETECT_DOCK, 'The dock was lost from sight on the way.'
                    )
                here = self._robot().inverse() @ target
                distance_m = math.hypot(here.x, here.y)
                if self._kind.is_docked(distance_m) or self._kind.is_charging(distance_m):
                    self._node.velocities.publish(Velocity())
                    return distance_m
                if is_near and distance_m > STRAIGHT_M:
                    raise _Failed(_CODES.FAILED_TO_CONTROL, 'The robot has missed the dock.')
                is_near = distance_m < STRAIGHT_M
                if now_s(self._node) > end_s:
                    raise _Failed(
                        _CODES.FAILED_TO_CONTROL,
                        f'The dock was not reached within {self._told.dock_approach_timeout:g} s.',
                    )
                velocity = approach_velocity(
                    here, self._values, backward=self._told.dock_backwards
                )
                self._check_collision(velocity, here)
                self._node.velocities.publish(velocity)
                await rate.tick()

    async def _wait_for_charge(self, distance_m: float) -> None:
        if not self._kind.is_charger:
            return
        self._tell(_PHASES.WAIT_FOR_CHARGE)
        end_s = now_s(self._node) + self._told.wait_charge_timeout
        with self._rate() as rate:
            while not self._kind.is_charging(distance_m):
                self._server.check()
                if now_s(self._node) > end_s:
                    raise _Failed(
                        _CODES.FAILED_TO_CHARGE, 'The robot is docked, but does not charge.'
                    )
                await rate.tick()

    async def _prepare_another_attempt(self, dock: Pose2D, failure: _Failed) -> None:
        """Drive back to the staging pose, or abort the goal after the last attempt."""
        self._node.velocities.publish(Velocity())
        if self._retries >= self._told.max_retries:
            after = f' There were {self._retries + 1} attempts.' if self._retries else ''
            raise ActionAborted(failure.code, f'{failure}{after}') from failure
        self._retries += 1
        self._server.result.num_retries = self._retries
        self._node.get_logger().warning(f'{failure} Trying again.')
        self._tell(_PHASES.RETRY)
        staging = self._kind.staging_pose(dock)
        await self._drive_back(dock, staging, self._told.dock_approach_timeout)

    async def _drive_back(self, dock: Pose2D, staging: Pose2D, timeout_s: float) -> None:
        """Drive away from the dock to the staging pose."""
        end_s = now_s(self._node) + timeout_s
        with self._rate() as rate:
            while (velocity := self._velocity_back(staging)) is not None:
                self._server.check()
                if now_s(self._node) > end_s:
                    raise ActionAborted(
                        _CODES.FAILED_TO_CONTROL,
                        f'The place before the dock was not reached within {timeout_s:g} s.',
                    )
                self._check_collision(velocity, self._robot().inverse() @ dock)
                self._node.velocities.publish(velocity)
                await rate.tick()
        self._node.velocities.publish(Velocity())

    def _velocity_back(self, staging: Pose2D) -> Velocity | None:
        """Return the velocity to the staging pose; None at the pose."""
        here = self._robot().inverse() @ staging
        if math.hypot(here.x, here.y) > self._told.undock_linear_tolerance:
            backward = not self._told.dock_backwards
            return approach_velocity(here, self._values, backward=backward)
        if abs(wrap_angle(here.yaw)) > self._told.undock_angular_tolerance:
            return turn_velocity(here.yaw, self._values)
        return None

    def _check_collision(self, velocity: Velocity, dock: Pose2D) -> None:
        """Raise an error before a collision far from the dock, which is in the base frame."""
        values = self._values
        if self._node.checker is None or not values.use_collision_detection:
            return
        step_s = values.simulation_time_step
        times = np.arange(0.0, values.projection_time + 0.5 * step_s, step_s)
        poses = velocity.poses_after(times)
        away = np.hypot(poses[:, 0] - dock.x, poses[:, 1] - dock.y)
        poses = poses[away > values.dock_collision_threshold]
        if not len(poses):
            return
        try:
            hit = self._node.checker.first_collision(poses)
        except CannotCheck as error:
            raise _Failed(_CODES.FAILED_TO_CONTROL, str(error)) from error
        if hit is not None:
            raise _Failed(_CODES.FAILED_TO_CONTROL, 'There is an obstacle on the way.')

    def _robot(self, frame: str = '') -> Pose2D:
        """Return the pose of the robot in a frame, by default the fixed one."""
        told = self._told
        max_age_s = self._values.transform_tolerance + _MAX_AGE_S
        return self._pose_of(
            lambda: self._node.transforms.pose_of(
                told.base_frame, frame or told.fixed_frame, not_older_s=max_age_s
            )
        )

    def _in_fixed_frame(self, dock: Dock) -> Pose2D:
        fixed = self._told.fixed_frame
        if dock.frame == fixed:
            return dock.pose
        return self._pose_of(lambda: self._node.transforms.pose_of(dock.frame, fixed)) @ dock.pose

    def _pose_of(self, look_up: Callable[[], Pose2D]) -> Pose2D:
        try:
            return look_up()
        except TransformError as error:
            raise ActionAborted(_CODES.UNKNOWN, str(error)) from error

    def _rate(self) -> Rate:
        return Rate(self._node, self._told.controller_frequency)

    def _tell(self, state: int) -> None:
        """Publish the state as feedback."""
        elapsed_s = now_s(self._node) - self._began_s
        duration = Duration(sec=int(elapsed_s), nanosec=int(elapsed_s % 1.0 * 1e9))
        self._server.publish_feedback(
            DockRobot.Feedback(state=state, docking_time=duration, num_retries=self._retries)
        )
