# SPDX-License-Identifier: Apache-2.0
"""Base class of the navigators: an action whose goals are executed by a behavior tree."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

from geometry_msgs.msg import PoseStamped
from nav2_behavior_tree.geometry import PathProgress, time_left_s
from nav2_behavior_tree.status import NodeStatus, TreeError
from nav2_behavior_tree.tree import BehaviorTree
from nav2_bt_navigator.navigation_node import NavigationNode
from nav2_bt_navigator.tree_files import find_tree_file
from nav2_util import ActionAborted, ConfigurationError, Pose2D, TransformError
from nav2_util.geometry import make_pose_stamped
from nav2_util.services import wait_for
from nav2_util.timing import steady_clock
from rclpy.duration import Duration
from rclpy.task import Future

__all__ = ['Navigator']

_FEEDBACK_PERIOD_S = 0.1
_LOOK_S, _PATIENCE = 0.1, 50
"""Period and number of pose lookups before the goal fails for lack of the robot's pose."""


@dataclass
class _Run:
    """A running navigation: its tree, file and outcome, and its start in s of the node's clock."""

    tree: BehaviorTree
    file: str
    end: Future[None]
    start_s: float = 0.0
    feedback_s: float = -1.0


class Navigator:
    """
    Navigator that offers an action, and ticks a tree while one of its goals is running.

    Parameters
    ----------
    node
        The node.
    name
        The name of the action.

    """

    action: ClassVar[Any]
    default_file: ClassVar[str]
    file_parameter: ClassVar[str]
    first_code: ClassVar[int]
    """The first of five error codes: unknown, bad tree, no transform, timeout, bad goal."""

    def __init__(self, node: NavigationNode, name: str) -> None:
        self.node, self.name = node, name
        self._progress = PathProgress()
        self._run: _Run | None = None
        self._check_default_tree()
        self.server = node.offer_action(
            self.action, name, self._work, takes_over=True, check_goal=self._check_goal
        )

    def close(self) -> None:
        """Halt the running tree while the clients of its actions still exist."""
        if self._run is not None:
            self._run.tree.halt()
            self._run.tree.take_changes()

    def goals_of(self, goal: Any) -> list[PoseStamped]:
        """
        Return the poses of a goal of the action.

        Parameters
        ----------
        goal
            The goal message.

        Returns
        -------
        list of PoseStamped
            The poses in order, in any frame; empty if the goal has none.

        """
        raise NotImplementedError

    def write_goal(self, blackboard: Any, poses: list[PoseStamped]) -> None:
        """
        Write the poses to the blackboard entry that the tree reads.

        Parameters
        ----------
        blackboard
            The blackboard of the main tree.
        poses
            The poses in the global frame, at least one.

        """
        raise NotImplementedError

    def fill_feedback(self, feedback: Any, blackboard: Any) -> None:
        """
        Fill in the feedback fields that are specific to this action.

        Parameters
        ----------
        feedback
            The feedback message, modified in place; the common fields are already set.
        blackboard
            The blackboard of the main tree.

        """

    def _default(self) -> str:
        given = getattr(self.node.settings.current, self.file_parameter)
        return find_tree_file(given or self.default_file)

    def _file_of(self, goal: Any) -> str:
        return find_tree_file(goal.behavior_tree) if goal.behavior_tree else self._default()

    def _check_default_tree(self) -> None:
        """Build the default tree once, to report errors and let its clients discover servers."""
        try:
            self._make_tree(self._default())
        except TreeError as error:
            raise ConfigurationError(f"The tree of '{self.name}' is invalid. {error}") from error

    def _make_tree(self, file: str) -> BehaviorTree:
        document = self.node.files.read(file)
        for warning in document.warnings:
            self.node.get_logger().warning(warning, once=True)
        return BehaviorTree(document, self.node.ros.now_s, self.node.ros)

    def _check_goal(self, goal: Any) -> str | None:
        for other in self.node.action_servers:
            if other is not self.server and other.is_running:
                return f"'{other.name}' is running; cancel it first"
        return None

    async def _work(self, goal: Any) -> None:
        await self._find_robot()
        run = self._run = self._begin(goal)
        period_s = 1e-3 * self.node.settings.current.bt_loop_duration
        # A timer ticks the tree: waking this coroutine for each tick would double the cost.
        # It uses a steady clock: goals can be canceled even while a simulation is paused.
        timer = self.node.create_timer(period_s, self.step, clock=steady_clock())
        try:
            self.step()
            await run.end
        except TreeError as error:
            raise ActionAborted(self.first_code, str(error)) from error
        finally:
            self._run = None
            self.node.destroy_timer(timer)
            run.tree.halt()
            self.node.log.publish(run.tree.take_changes())

    def step(self) -> None:
        """Tick the tree of the running goal, and detect its end, cancellation or preemption."""
        run = self._run
        if run is None or run.end.done():
            return
        try:
            self.server.check()
            self._check_inhibition()
            if self.server.is_preempt_requested:
                self._take_over(run)
            if self._tick(run) is not NodeStatus.RUNNING:
                run.end.set_result(None)
        except Exception as error:
            run.end.set_exception(error)

    async def _find_robot(self) -> None:
        """Wait for the first transforms, which a newly started stack does not have yet."""
        for _ in range(_PATIENCE):
            self.server.check()
            self._check_inhibition()
            try:
                self.node.ros.robot_pose()
            except TransformError:
                await wait_for(self.node, Future(), _LOOK_S)
            else:
                return

    def _check_inhibition(self) -> None:
        if self.node.inhibition:
            raise ActionAborted(self.first_code, self.node.inhibition)

    def _begin(self, goal: Any) -> _Run:
        file = self._file_of(goal)
        try:
            tree = self._make_tree(file)
        except TreeError as error:
            raise ActionAborted(self.first_code + 1, str(error)) from error
        run = _Run(tree, file, Future(executor=self.node.executor))
        self._set_goal(run, goal)
        return run

    def _take_over(self, run: _Run) -> None:
        """Pass a newer goal to the running tree, or abort the old one if it needs another tree."""
        goal = self.server.pending_goal()
        if self._file_of(goal) != run.file:
            raise ActionAborted(self.first_code, 'A newer goal with another tree took its place.')
        try:
            self._set_goal(run, goal)
        except ActionAborted as error:
            self.server.reject_pending(error.code, str(error))
        else:
            self.server.accept_pending()
            run.tree.renew()

    def _set_goal(self, run: _Run, goal: Any) -> None:
        """Write a goal to the blackboard; raise ActionAborted if it is invalid."""
        poses = self.goals_of(goal)
        if not poses:
            raise ActionAborted(self.first_code + 4, 'The goal has no poses. Give at least one.')
        settings, board = self.node.settings.current, run.tree.blackboard
        try:
            robot = self.node.ros.robot_pose()
            poses = [self._in_global_frame(pose) for pose in poses]
        except TransformError as error:
            raise ActionAborted(
                self.first_code + 2, f'The robot cannot navigate. {error}'
            ) from error
        self.write_goal(board, poses)
        board.set('number_recoveries', 0)
        board.set('initial_pose_received', True)
        for name in self._error_names():
            board.set(name, 0)
        run.start_s = self.node.ros.now_s()
        run.tree.context.failure = None
        end = poses[-1].pose.position
        self.node.get_logger().info(
            f"'{self.name}': from ({robot.x:.2f}, {robot.y:.2f}) to ({end.x:.2f}, {end.y:.2f}) "
            f"in '{settings.global_frame}'."
        )

    def _in_global_frame(self, pose: PoseStamped) -> PoseStamped:
        frame = self.node.settings.current.global_frame
        planar: Pose2D = self.node.ros.pose_in(pose, frame)
        if pose.header.frame_id == frame:
            return pose
        return make_pose_stamped(planar, frame, pose.header.stamp)

    def _error_names(self) -> list[str]:
        settings = self.node.settings.current
        prefixed = [f'{each}_error_code' for each in settings.error_code_name_prefixes]
        return [*settings.error_code_names, *prefixed]

    def _tick(self, run: _Run) -> NodeStatus:
        """Tick the tree; raise ActionAborted with the reason if it has failed."""
        status = run.tree.tick()
        self.node.log.publish(run.tree.take_changes())
        if status is NodeStatus.RUNNING:
            self._tell(run)
        elif status is not NodeStatus.SUCCESS:
            code, message = _failure_reason(run.tree, self._error_names())
            raise ActionAborted(code or self.first_code, message)
        return status

    def _tell(self, run: _Run) -> None:
        """Publish feedback at 10 Hz."""
        ros, board = self.node.ros, run.tree.blackboard
        now_s = ros.watchdog_s()
        if now_s - run.feedback_s < _FEEDBACK_PERIOD_S:
            return
        run.feedback_s = now_s
        try:
            robot = ros.robot_pose()
        except TransformError:
            return
        settings = self.node.settings.current
        path = board.get(settings.path_blackboard_id)
        way_m = self._progress.remaining_m(path, robot)
        passed_s = max(ros.now_s() - run.start_s, 0.0)
        left_s = time_left_s(way_m, ros.speed_m_s())
        feedback = self.action.Feedback(
            current_pose=make_pose_stamped(robot, settings.global_frame, ros.stamp()),
            navigation_time=Duration(seconds=passed_s).to_msg(),
            estimated_time_remaining=Duration(seconds=left_s).to_msg(),
            number_of_recoveries=board.get('number_recoveries', 0),
            distance_remaining=way_m,
        )
        self.fill_feedback(feedback, board)
        self.server.publish_feedback(feedback)


def _failure_reason(tree: BehaviorTree, names: list[str]) -> tuple[int, str]:
    """
    Get the error code, 0 if unknown, and the error message of a failed tree.

    Parameters
    ----------
    tree
        The tree.
    names
        The blackboard entries with the error codes of actions. The code of the node that failed
        last is used, else the lowest one, as Nav2 documents.

    """
    board, failure = tree.blackboard, tree.failure
    codes = {name: board.get(name, 0) for name in names}
    codes = {name: code for name, code in codes.items() if isinstance(code, int) and code > 0}
    if failure is not None and (failure.code in codes.values() or not codes):
        return failure.code, failure.message
    if codes:
        name = min(codes, key=lambda each: codes[each])
        message = board.get(f'{name.removesuffix("_error_code")}_error_msg', '')
        return codes[name], message or (
            failure.message if failure is not None else f"'{name}' is {codes[name]}."
        )
    return 0, 'The behavior tree failed, and none of its nodes said why.'
