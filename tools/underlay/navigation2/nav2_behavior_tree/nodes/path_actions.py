# SPDX-License-Identifier: Apache-2.0
"""Nodes that modify goals and paths on the blackboard, and the decorator that updates goals."""

from __future__ import annotations

import math
from typing import Any, ClassVar

from geometry_msgs.msg import PoseStamped
from nav2_behavior_tree.control_node import Decorator
from nav2_behavior_tree.geometry import distances_along_m, nearest_index, within
from nav2_behavior_tree.node import NodeConfig, TreeNode
from nav2_behavior_tree.ports import in_port, out_port, Port
from nav2_behavior_tree.registry import register
from nav2_behavior_tree.status import NodeStatus
from nav2_util.errors import NavigationError
from nav2_util.geometry import make_pose_stamped, make_quaternion, path_poses
from nav_msgs.msg import Path
from rclpy.time import Time

__all__ = [
    'ConcatenatePaths',
    'GetCurrentPose',
    'GetPoseFromPath',
    'GoalUpdater',
    'RemovePassedGoals',
    'TruncatePath',
    'TruncatePathLocal',
]

RUNNING, SUCCESS, FAILURE = NodeStatus.RUNNING, NodeStatus.SUCCESS, NodeStatus.FAILURE


@register()
class RemovePassedGoals(TreeNode):
    """Removes the leading goals that the robot is near; the last one is kept."""

    ports: ClassVar[dict[str, Port]] = {
        'input_goals': in_port('poses', '{goals}', 'The goals.'),
        'radius': in_port('number', '0.5', 'How near, in m.'),
        'robot_base_frame': in_port('text', '', "The robot's frame; empty: the navigator's."),
        'global_frame': in_port('text', '', "The frame to measure in; empty: the navigator's."),
        'input_waypoint_statuses': in_port('any', None, 'No effect: not in Jazzy.'),
        'output_goals': out_port('poses', 'The goals that are left.', '{goals}'),
        'output_waypoint_statuses': out_port('any', 'No effect: not in Jazzy.'),
    }

    def on_tick(self) -> NodeStatus:
        """Compare the robot's pose with the goals."""
        goals = list(self.input('input_goals') or [])
        passed = 0
        if len(goals) > 1:
            frame = self.input('global_frame')
            ros = self.context.ros
            robot = ros.robot_pose(frame, self.input('robot_base_frame'))
            radius = self.input('radius')
            while (
                passed < len(goals) - 1
                and robot.distance_to(ros.pose_in(goals[passed], frame)) <= radius
            ):
                passed += 1
        if passed or self.config.bindings['output_goals'].key != self._source():
            self.output('output_goals', goals[passed:])
        return SUCCESS

    def _source(self) -> str | None:
        return self.config.bindings['input_goals'].key


@register()
class TruncatePath(TreeNode):
    """Truncates the end of a path; the new last pose faces the original end."""

    ports: ClassVar[dict[str, Port]] = {
        'input_path': in_port('path', '{path}', 'The path.'),
        'distance': in_port('number', '1.0', 'How much to cut off, in m.'),
        'output_path': out_port('path', 'The shorter path.'),
    }

    def on_tick(self) -> NodeStatus:
        """Truncate the path."""
        path = self.required('input_path')
        poses = path_poses(path)
        if not len(poses):
            self.output('output_path', path)
            return SUCCESS
        left = distances_along_m(poses[::-1])[::-1]
        kept = [index for index in range(len(poses)) if left[index] >= self.input('distance')]
        last = kept[-1] if kept else 0
        cut = Path(header=path.header, poses=list(path.poses[: last + 1]))
        toward = poses[-1, :2] - poses[last, :2]
        if math.hypot(*toward) > 1e-6:
            end = PoseStamped(header=path.poses[last].header)
            end.pose.position = path.poses[last].pose.position
            end.pose.orientation = make_quaternion(math.atan2(toward[1], toward[0]))
            cut.poses[-1] = end
        self.output('output_path', cut)
        return SUCCESS


@register()
class TruncatePathLocal(TreeNode):
    """
    Extracts the part of a path that is near the robot.

    Parameters
    ----------
    config
        As for `TreeNode`; its context has a `RosInterface`.

    """

    ports: ClassVar[dict[str, Port]] = {
        'input_path': in_port('path', '{path}', 'The path.'),
        'distance_forward': in_port('number', '8.0', 'How far ahead, in m; -1: to the end.'),
        'distance_backward': in_port('number', '4.0', 'How far back, in m.'),
        'robot_frame': in_port('text', '', "The robot's frame; empty: the navigator's."),
        'robot_base_frame': in_port('text', '', 'The same.'),
        'transform_tolerance': in_port('number', '0.2', 'No effect: the newest pose counts.'),
        'pose': in_port('pose', None, "A pose in place of the robot's."),
        'angular_distance_weight': in_port('number', '0.0', 'How many m a rad counts.'),
        'max_robot_pose_search_dist': in_port(
            'number', 'inf', 'How far along the path to look for the robot, in m.'
        ),
        'output_path': out_port('path', 'The part.'),
    }

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._path: Any = None
        self._near = 0

    def on_tick(self) -> NodeStatus:
        """Find the robot on the path, and truncate it."""
        path = self.required('input_path')
        if path is not self._path:
            self._path, self._near, self._poses = path, 0, path_poses(path)
        poses = self._poses
        if not len(poses):
            self.output('output_path', path)
            return SUCCESS
        ros, frame = self.context.ros, path.header.frame_id
        pose = self.input('pose')
        base_frame = self.input('robot_base_frame') or self.input('robot_frame')
        robot = ros.robot_pose(frame, base_frame) if pose is None else ros.pose_in(pose, frame)
        reach = self.input('max_robot_pose_search_dist')
        end = len(poses)
        if math.isfinite(reach):
            end = within(poses, self._near, reach, 0.0)[1]
        start = self._near if math.isfinite(reach) else 0
        weight = self.input('angular_distance_weight')
        self._near = nearest_index(poses[:end], robot, weight, start)
        first, last = within(
            poses, self._near, self.input('distance_forward'), self.input('distance_backward')
        )
        self.output('output_path', Path(header=path.header, poses=list(path.poses[first:last])))
        return SUCCESS


@register()
class GetPoseFromPath(TreeNode):
    """Extracts a pose of a path."""

    ports: ClassVar[dict[str, Port]] = {
        'path': in_port('path', '{path}', 'The path.'),
        'index': in_port('whole', '0', 'Which pose; -1: the last one.'),
        'pose': out_port('pose', 'The pose.'),
    }

    def on_tick(self) -> NodeStatus:
        """Write the pose; its frame is that of the path if the pose has none."""
        path, index = self.required('path'), self.input('index')
        if not -len(path.poses) <= index < len(path.poses):
            self.fail(f'The path has {len(path.poses)} poses; there is none with index {index}.')
            return FAILURE
        pose = path.poses[index]
        if not pose.header.frame_id:
            pose = PoseStamped(header=path.header, pose=pose.pose)
        self.output('pose', pose)
        return SUCCESS


@register()
class ConcatenatePaths(TreeNode):
    """Appends a path to another one."""

    ports: ClassVar[dict[str, Port]] = {
        'input_path1': in_port('path', None, 'The first path.'),
        'input_path2': in_port('path', None, 'The path that follows it, in the same frame.'),
        'output_path': out_port('path', 'Both, one after the other.'),
    }

    def on_tick(self) -> NodeStatus:
        """Write the poses of both paths; one of them may be missing or empty."""
        first, second = (self.input(name) or Path() for name in ('input_path1', 'input_path2'))
        if not first.poses and not second.poses:
            self.fail('Both paths are empty.')
            return FAILURE
        frames = [path.header.frame_id for path in (first, second) if path.poses]
        if len(set(frames)) > 1:
            self.fail(f"The paths are in different frames, '{frames[0]}' and '{frames[1]}'.")
            return FAILURE
        header = (first if first.poses else second).header
        self.output('output_path', Path(header=header, poses=[*first.poses, *second.poses]))
        return SUCCESS


@register()
class GetCurrentPose(TreeNode):
    """Writes the pose of the robot."""

    ports: ClassVar[dict[str, Port]] = {
        'global_frame': in_port('text', '', "The frame of the pose; empty: the navigator's."),
        'robot_base_frame': in_port('text', '', "The robot's frame; empty: the navigator's."),
        'current_pose': out_port('pose', 'The pose.'),
    }

    def on_tick(self) -> NodeStatus:
        """Look up the newest pose."""
        ros = self.context.ros
        frame = self.input('global_frame') or ros.global_frame
        robot = ros.robot_pose(frame, self.input('robot_base_frame'))
        self.output('current_pose', make_pose_stamped(robot, frame, ros.stamp()))
        return SUCCESS


@register()
class GoalUpdater(Decorator):
    """
    Updates the goal from a topic while its child is running.

    Parameters
    ----------
    config
        As for `TreeNode`; its context has a `RosInterface`.

    """

    ports: ClassVar[dict[str, Port]] = {
        'input_goal': in_port('pose', '{goal}', 'The goal.'),
        'input_goals': in_port('poses', None, 'The goals.'),
        'output_goal': out_port('pose', 'The goal, or the one of the topic if that is newer.'),
        'output_goals': out_port('poses', 'The goals.'),
    }

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        ros = config.context.ros
        topic = ros.parameter('goal_updater_topic', 'goal_update', 'Newer goals of GoalUpdater.')
        self._update = ros.latest(PoseStamped, topic)

    def on_tick(self) -> NodeStatus:
        """Write the newer goal, and tick the child."""
        goal, update = self.input('input_goal'), self._update.message
        if update is not None and (goal is None or not _is_older(update, goal)):
            goal = update
        if goal is None and self.input('input_goals') is None:
            raise NavigationError(f"'{self.name}' has no goal.")
        if goal is not None:
            self.output('output_goal', goal)
        if self.input('input_goals') is not None:
            self.output('output_goals', self.input('input_goals'))
        self.set_state(RUNNING)
        return self.child.execute_tick()


def _is_older(update: PoseStamped, goal: PoseStamped) -> bool:
    """Whether an update is older than the goal; one without a stamp never is."""
    stamp = Time.from_msg(update.header.stamp)
    return bool(stamp.nanoseconds > 0 and stamp < Time.from_msg(goal.header.stamp))
