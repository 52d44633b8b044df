# SPDX-License-Identifier: Apache-2.0
"""Execution of follow_path goals: from a path to velocity commands, and why a goal is aborted."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TYPE_CHECKING, TypeVar

from nav2_controller.checkers import GoalChecker, ProgressChecker
from nav2_controller.control import (
    Command,
    Controller,
    ControlState,
    NoValidControl,
    Surroundings,
    Velocity,
)
from nav2_controller.tracking import PlanTracker
from nav2_msgs.action import FollowPath
from nav2_util.errors import ActionAborted
from nav2_util.geometry import angle_between, path_poses, Pose2D
from nav2_util.plugins import did_you_mean
from nav2_util.timing import now_s, Rate
from nav2_util.transforms import TransformError
import numpy as np

if TYPE_CHECKING:
    from nav2_controller.controller_server import ControllerServer

__all__ = ['PathFollower']

PluginT = TypeVar('PluginT')
Code = FollowPath.Result

_STALE_S = 0.5
_FEEDBACK_PERIOD_S = 0.1
_SAME_GOAL_M, _SAME_GOAL_RAD = 0.02, 0.02
_NO_POINTS = np.empty((0, 2))


@dataclass
class _Task:
    """A path that is being followed, with its plugins."""

    tracker: PlanTracker
    frame: str
    controller: Controller
    goal_checker: GoalChecker
    progress_checker: ProgressChecker
    plugins: tuple[str, str, str]


class _NoVelocity(Exception):
    """No velocity can be computed now: the error code and the message."""

    def __init__(self, code: int, message: str) -> None:
        super().__init__(message)
        self.code = code


class PathFollower:
    """
    Executor of follow_path goals.

    Parameters
    ----------
    node
        The configured controller server, which has the plugins, the costmap and the publishers.

    """

    def __init__(self, node: ControllerServer) -> None:
        self._node = node
        self._task: _Task | None = None
        self._valid_s = self._feedback_s = self._current_s = 0.0

    async def work(self, goal: FollowPath.Goal) -> None:
        """
        Follow a path, and each path that preempts it, until the goal is reached.

        Parameters
        ----------
        goal
            The path, and the names of the controller and the checkers.

        Raises
        ------
        ActionAborted
            The goal is invalid, or the robot cannot reach it.

        """
        node, server = self._node, self._node.server
        try:
            self._begin(goal)
            with Rate(node, 1.0 / node.period_s) as rate:
                while True:
                    if server.is_preempt_requested:
                        self._begin(server.accept_pending())
                    slowing = self._slowed_down() if server.is_cancel_requested else None
                    if slowing is None:
                        server.check()
                        if self._step():
                            return
                    else:
                        node.publish_velocity(slowing.velocity)
                    await rate.tick()
        finally:
            self._task = None
            if node.settings.current.publish_zero_velocity:
                node.publish_velocity(Velocity())

    def _begin(self, goal: FollowPath.Goal) -> None:
        """Validate a goal and set its path; raise ActionAborted if it is invalid."""
        node, before = self._node, self._task
        names = (
            _chosen(node.controllers, goal.controller_id, 'controller', Code.INVALID_CONTROLLER),
            _chosen(node.goal_checkers, goal.goal_checker_id, 'goal checker', Code.UNKNOWN),
            _chosen(
                node.progress_checkers, goal.progress_checker_id, 'progress checker', Code.UNKNOWN
            ),
        )
        poses, frame = _checked_path(goal.path)
        task = _Task(
            PlanTracker(poses),
            frame,
            node.controllers[names[0]],
            node.goal_checkers[names[1]],
            node.progress_checkers[names[2]],
            names,
        )
        is_new = before is None or not _is_same_goal(before, task)
        changed = (True,) * 3 if before is None else _differences(before.plugins, names)
        task.controller.new_plan(is_new_goal=is_new or changed[0])
        if is_new or changed[1]:
            task.goal_checker.reset()
        if is_new or changed[2]:
            task.progress_checker.reset()
        if is_new:
            self._valid_s = self._current_s = now_s(node)
        self._task = task
        node.displays.show_plan(goal.path)

    def _step(self) -> bool:
        """Compute and publish one velocity; return whether the goal is reached."""
        node, task = self._node, self._task
        assert task is not None
        now = now_s(node)
        if now < self._valid_s:
            self._valid_s = self._current_s = now
        try:
            state = self._observe(task, now)
            self._publish_feedback(state)
            if task.goal_checker.is_reached(state.pose, state.goal, state.velocity):
                return True
            if not task.progress_checker.check(state.pose, now):
                raise ActionAborted(Code.FAILED_TO_MAKE_PROGRESS, task.progress_checker.reason())
            self._require_costmap(now)
            command = task.controller.compute(state)
        except (_NoVelocity, NoValidControl) as error:
            self._fail(error, now)
            return False
        self._valid_s = now
        node.publish_velocity(command.velocity)
        node.displays.show(state, command, node.costmap.global_frame)
        return False

    def _observe(self, task: _Task, now: float) -> ControlState:
        """Observe the state of the robot and of its path, in the frame of the costmap."""
        node, costmap = self._node, self._node.costmap
        age = node.odometry.age_s
        if age is not None and age > _STALE_S:
            raise _NoVelocity(
                Code.TF_ERROR,
                f"The newest odometry on '{node.odometry.topic}' is {age:.1f} s old. "
                'The robot waits until odometry resumes.',
            )
        into = Pose2D(0.0, 0.0, 0.0)
        try:
            pose = node.transforms.pose_of(
                costmap.base_frame,
                costmap.global_frame,
                not_older_s=max(_STALE_S, task.controller.transform_tolerance_s),
            )
            if task.frame != costmap.global_frame:
                into = node.transforms.pose_of(task.frame, costmap.global_frame)
        except TransformError as error:
            raise _NoVelocity(Code.TF_ERROR, str(error)) from error
        task.tracker.advance(into.inverse() @ pose, task.controller.search_distance_m)
        grid = costmap.grid
        plan, is_goal_in_plan = task.tracker.visible(into, grid)
        outline = _NO_POINTS if costmap.is_circular else costmap.footprint
        xy_tolerance, yaw_tolerance = task.goal_checker.tolerances()
        current = node.settings.current
        return ControlState(
            pose=pose,
            velocity=node.odometry.velocity(
                Velocity(
                    current.min_x_velocity_threshold,
                    current.min_y_velocity_threshold,
                    current.min_theta_velocity_threshold,
                )
            ),
            plan=plan,
            goal=into @ task.tracker.goal,
            is_goal_in_plan=is_goal_in_plan,
            remaining_m=task.tracker.remaining_m,
            xy_tolerance_m=xy_tolerance,
            yaw_tolerance_rad=yaw_tolerance,
            surroundings=Surroundings(grid, outline, costmap.shape.inscribed_radius_m),
            now_s=now,
            period_s=node.period_s,
        )

    def _require_costmap(self, now: float) -> None:
        if self._node.costmap.is_current:
            self._current_s = now
        elif now - self._current_s > self._node.settings.current.costmap_update_timeout:
            raise ActionAborted(
                Code.CONTROLLER_TIMED_OUT,
                'The local costmap is not up to date. Are the topics of its layers published?',
            )
        else:
            raise _NoVelocity(Code.CONTROLLER_TIMED_OUT, 'The local costmap is not up to date.')

    def _fail(self, error: Exception, now: float) -> None:
        """Stop the robot; abort the goal if failures have lasted too long."""
        node, tolerance = self._node, self._node.settings.current.failure_tolerance
        node.publish_velocity(Velocity())
        code = error.code if isinstance(error, _NoVelocity) else Code.NO_VALID_CONTROL
        waits_for_costmap = code == Code.CONTROLLER_TIMED_OUT
        lasted = now - self._valid_s
        if waits_for_costmap or tolerance < 0.0 or (0.0 < tolerance and lasted <= tolerance):
            node.get_logger().warning(
                f'There is no velocity for {lasted:.1f} s. {error}', throttle_duration_sec=2.0
            )
            return
        if tolerance > 0.0 and code == Code.NO_VALID_CONTROL:
            raise ActionAborted(
                Code.PATIENCE_EXCEEDED, f'There was no valid velocity for {lasted:.1f} s. {error}'
            )
        raise ActionAborted(code, str(error))

    def _publish_feedback(self, state: ControlState) -> None:
        if 0.0 <= state.now_s - self._feedback_s < 0.9 * _FEEDBACK_PERIOD_S:
            return
        self._feedback_s = state.now_s
        self._node.server.publish_feedback(
            FollowPath.Feedback(
                distance_to_goal=float(state.remaining_m), speed=float(state.velocity.linear)
            )
        )

    def _slowed_down(self) -> Command | None:
        """Compute the decelerating command after a cancel request; None to stop immediately."""
        if self._task is None:
            return None
        try:
            state = self._observe(self._task, now_s(self._node))
            return self._task.controller.cancel(state)
        except (_NoVelocity, NoValidControl):
            return None


def _chosen(known: dict[str, PluginT], name: str, what: str, code: int) -> str:
    """Resolve the name of a plugin; the only one if none is specified."""
    if not name and len(known) == 1:
        return next(iter(known))
    if name in known:
        return name
    names = ', '.join(f"'{each}'" for each in sorted(known))
    if not name:
        raise ActionAborted(code, f'The goal must name a {what}, one of {names}.')
    advice = did_you_mean(name, known)
    raise ActionAborted(code, f"There is no {what} '{name}'.{advice} These exist: {names}.")


def _checked_path(path: Any) -> tuple[Any, str]:
    """Validate a path; return its (N, 3) poses and their frame."""
    if not path.poses:
        raise ActionAborted(Code.INVALID_PATH, 'The path is empty. Has the planner found none?')
    frame = path.header.frame_id or path.poses[0].header.frame_id
    if not frame:
        raise ActionAborted(
            Code.TF_ERROR, 'The path has no frame_id. Give it the frame of its poses, such as map.'
        )
    poses = path_poses(path)
    if not np.isfinite(poses).all():
        raise ActionAborted(Code.INVALID_PATH, 'A pose of the path is not a finite number.')
    return poses, frame


def _is_same_goal(before: _Task, after: _Task) -> bool:
    old, new = before.tracker.goal, after.tracker.goal
    return (
        before.frame == after.frame
        and old.distance_to(new) <= _SAME_GOAL_M
        and abs(angle_between(old.yaw, new.yaw)) <= _SAME_GOAL_RAD
    )


def _differences(before: tuple[str, ...], after: tuple[str, ...]) -> tuple[bool, ...]:
    return tuple(old != new for old, new in zip(before, after))
