# SPDX-License-Identifier: Apache-2.0
"""Nodes that plan, smooth and follow paths, select plugins for that, or call navigators."""

from __future__ import annotations

from typing import Any, ClassVar

from nav2_behavior_tree.action_node import ActionNode, BASIC_PORTS, ERROR_PORTS
from nav2_behavior_tree.node import NodeConfig, TreeNode
from nav2_behavior_tree.ports import in_port, out_port, Port
from nav2_behavior_tree.registry import register
from nav2_behavior_tree.ros_interface import LATCHED
from nav2_behavior_tree.status import NodeStatus
from nav2_msgs import action
from nav_msgs.msg import Path
from rclpy.duration import Duration
from std_msgs.msg import String

__all__ = [
    'ComputePathThroughPoses',
    'ComputePathToPose',
    'FollowPath',
    'NavigateThroughPoses',
    'NavigateToPose',
    'Selector',
    'SmoothPath',
]

SUCCESS = NodeStatus.SUCCESS
_SECOND_NS = 1e-9


class _Planning(ActionNode):
    """Base class of planning nodes; after a failure, an empty path is on the blackboard."""

    purpose = 'The planner found no way to the goal'

    def _set_start(self, goal: Any) -> None:
        start, use_start = self.input('start'), self.input('use_start')
        if start is not None and use_start is not False:
            goal.start, goal.use_start = start, True
        goal.planner_id = self.input('planner_id') or ''

    def on_success(self, result: Any) -> NodeStatus:
        """Write the path."""
        self.output('path', result.path)
        return SUCCESS

    def on_failure(self) -> None:
        """Write an empty path."""
        self.output('path', Path())

    def on_canceled(self) -> NodeStatus:
        """Write an empty path."""
        self.on_failure()
        return SUCCESS


_PLANNING_PORTS: dict[str, Port] = {
    'start': in_port('pose', None, 'Where the path begins; not set: where the robot is.'),
    'use_start': in_port('boolean', None, 'Whether to heed start; not set: if it is there.'),
    'planner_id': in_port('text', '', 'The planner; empty where there is but one.'),
    'path': out_port('path', 'The path.'),
    **BASIC_PORTS,
    **ERROR_PORTS,
}


@register()
class ComputePathToPose(_Planning):
    """Plans a path to a pose."""

    action, server = action.ComputePathToPose, 'compute_path_to_pose'
    ports: ClassVar[dict[str, Port]] = {
        'goal': in_port('pose', '{goal}', 'Where to.'),
        **_PLANNING_PORTS,
    }

    def make_goal(self) -> Any:
        """Make the goal for the planner."""
        goal = action.ComputePathToPose.Goal(goal=self.required('goal'))
        self._set_start(goal)
        return goal

    def changed_goal(self) -> Any:
        """Replan immediately if the goal has changed."""
        return self.make_goal() if self.input('goal') is not self._goal.goal else None


@register()
class ComputePathThroughPoses(_Planning):
    """Plans a path through poses."""

    action, server = action.ComputePathThroughPoses, 'compute_path_through_poses'
    purpose = 'The planner found no way through the goals'
    ports: ClassVar[dict[str, Port]] = {
        'goals': in_port('poses', '{goals}', 'The poses, in their order.'),
        **_PLANNING_PORTS,
    }

    def make_goal(self) -> Any:
        """Make the goal for the planner."""
        self._goals = self.required('goals')
        goal = action.ComputePathThroughPoses.Goal(goals=list(self._goals))
        self._set_start(goal)
        return goal

    def changed_goal(self) -> Any:
        """Replan immediately if the goals have changed."""
        return self.make_goal() if self.input('goals') is not self._goals else None


@register()
class SmoothPath(ActionNode):
    """Smooths a path."""

    action, server = action.SmoothPath, 'smooth_path'
    purpose = 'The path could not be smoothed'
    ports: ClassVar[dict[str, Port]] = {
        'unsmoothed_path': in_port('path', '{path}', 'The path.'),
        'max_smoothing_duration': in_port('number', '3.0', 'For how long to try, in s.'),
        'check_for_collisions': in_port('boolean', 'false', 'Whether it has to be free then.'),
        'smoother_id': in_port('text', '', 'The smoother; empty where there is but one.'),
        'smoothed_path': out_port('path', 'The smooth path.'),
        'smoothing_duration': out_port('number', 'How long it took, in s.'),
        'was_completed': out_port('boolean', 'Whether it became as smooth as was wanted.'),
        **BASIC_PORTS,
        **ERROR_PORTS,
    }

    def make_goal(self) -> Any:
        """Make the goal for the smoother."""
        return action.SmoothPath.Goal(
            path=self.required('unsmoothed_path'),
            smoother_id=self.input('smoother_id') or '',
            max_smoothing_duration=Duration(seconds=self.input('max_smoothing_duration')).to_msg(),
            check_for_collisions=self.input('check_for_collisions'),
        )

    def on_success(self, result: Any) -> NodeStatus:
        """
        Write the smoothed path, and the details of the smoothing, to the output ports.

        Parameters
        ----------
        result
            The result of the action `SmoothPath`.

        Returns
        -------
        NodeStatus
            SUCCESS, even if smoothing was not completed.

        """
        took = result.smoothing_duration
        self.output('smoothed_path', result.path)
        self.output('smoothing_duration', took.sec + took.nanosec * _SECOND_NS)
        self.output('was_completed', result.was_completed)
        return SUCCESS


@register()
class FollowPath(ActionNode):
    """Follows a path, and each newer one that appears on the blackboard meanwhile."""

    action, server = action.FollowPath, 'follow_path'
    purpose = 'The controller could not follow the path'
    ports: ClassVar[dict[str, Port]] = {
        'path': in_port('path', '{path}', 'The path.'),
        'controller_id': in_port('text', '', 'The controller; empty where there is but one.'),
        'goal_checker_id': in_port('text', '', 'The goal checker; empty where there is one.'),
        'progress_checker_id': in_port('text', '', 'The progress checker; likewise.'),
        **BASIC_PORTS,
        **ERROR_PORTS,
    }

    def _parts(self) -> tuple[Any, str, str, str]:
        return (
            self.required('path'),
            self.input('controller_id') or '',
            self.input('goal_checker_id') or '',
            self.input('progress_checker_id') or '',
        )

    def make_goal(self) -> Any:
        """Make the goal for the controller."""
        path, controller, goal_checker, progress_checker = self._parts()
        return action.FollowPath.Goal(
            path=path,
            controller_id=controller,
            goal_checker_id=goal_checker,
            progress_checker_id=progress_checker,
        )

    def changed_goal(self) -> Any:
        """Return the newer path, or the same one for another controller."""
        path, *ids = self._parts()
        old = self._goal
        same = [old.controller_id, old.goal_checker_id, old.progress_checker_id] == ids
        if path is old.path and same:
            return None
        return None if same and path == old.path else self.make_goal()


@register()
class NavigateToPose(ActionNode):
    """Navigates to a pose with its own tree, through another navigator."""

    action, server = action.NavigateToPose, 'navigate_to_pose'
    purpose = 'The robot could not be navigated to the pose'
    ports: ClassVar[dict[str, Port]] = {
        'goal': in_port('pose', '{goal}', 'Where to.'),
        'behavior_tree': in_port('text', '', "The file of the tree; empty: that server's own."),
        **BASIC_PORTS,
        **ERROR_PORTS,
    }

    def make_goal(self) -> Any:
        """Make the goal for the navigator."""
        return action.NavigateToPose.Goal(
            pose=self.required('goal'), behavior_tree=self.input('behavior_tree') or ''
        )


@register()
class NavigateThroughPoses(ActionNode):
    """Navigates through poses with its own tree, through another navigator."""

    action, server = action.NavigateThroughPoses, 'navigate_through_poses'
    purpose = 'The robot could not be navigated through the poses'
    ports: ClassVar[dict[str, Port]] = {
        'goals': in_port('poses', '{goals}', 'The poses, in their order.'),
        'behavior_tree': in_port('text', '', "The file of the tree; empty: that server's own."),
        **BASIC_PORTS,
        **ERROR_PORTS,
    }

    def make_goal(self) -> Any:
        """Make the goal for the navigator."""
        return action.NavigateThroughPoses.Goal(
            poses=list(self.required('goals')), behavior_tree=self.input('behavior_tree') or ''
        )


class Selector(TreeNode):
    """
    Writes the most recently published name, or the default; fails if there is neither.

    Parameters
    ----------
    config
        As for `TreeNode`; its context has a `RosInterface`.

    """

    subject: ClassVar[str]

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._latest = config.context.ros.latest(String, self.input('topic_name'), LATCHED)

    def on_tick(self) -> NodeStatus:
        """Write the name."""
        name = self._latest.message.data if self._latest.message is not None else ''
        name = name or self.input(f'default_{self.subject}')
        if not name:
            self.fail(
                f"'{self.name}' has no default, and nothing was published on "
                f"'{self.input('topic_name')}'."
            )
            return NodeStatus.FAILURE
        self.output(f'selected_{self.subject}', name)
        return NodeStatus.SUCCESS


def _make_selector(type_name: str, subject: str) -> None:
    what = subject.replace('_', ' ')
    ports: dict[str, Port] = {
        'topic_name': in_port('text', f'{subject}_selector', 'The topic, a std_msgs/String.'),
        f'default_{subject}': in_port('text', '', f'The {what} if nothing was published.'),
        f'selected_{subject}': out_port('text', f'The {what}.', f'{{selected_{subject}}}'),
    }
    body = {'__doc__': Selector.__doc__, 'subject': subject, 'ports': ports}
    register()(type(type_name, (Selector,), body))


_make_selector('PlannerSelector', 'planner')
_make_selector('ControllerSelector', 'controller')
_make_selector('SmootherSelector', 'smoother')
_make_selector('GoalCheckerSelector', 'goal_checker')
_make_selector('ProgressCheckerSelector', 'progress_checker')
