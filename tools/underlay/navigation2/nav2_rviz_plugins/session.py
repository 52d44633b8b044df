# SPDX-License-Identifier: Apache-2.0
"""Session that the goal tool and the navigation panel share: the goals of one robot."""

from __future__ import annotations

import math
import time
from typing import Any, TYPE_CHECKING
from weakref import WeakKeyDictionary

from geometry_msgs.msg import PoseStamped
from nav2_rviz_plugins.action_watch import ActionWatch
from nav2_rviz_plugins.interfaces import interface
from nav2_rviz_plugins.managers import command_all, ManagerWatch
from nav2_rviz_plugins.progress import ACTIONS, Goal, THROUGH, TO_POSE, WAYPOINTS
from nav2_rviz_plugins.waypoints import WaypointDisplay
from nav2_util.timing import steady_clock
from robot_console.namespaces import below
from robot_console.service_calls import ServiceCalls
from visualization_msgs.msg import MarkerArray

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['NavigationSession', 'close_sessions', 'session_of']

PERIOD_S = 0.1
LOOK_S = 1.0
MOST = 200
"""The maximum number of waypoints."""


class NavigationSession:
    """
    Navigation session of one robot: collects, sends and monitors its goals.

    It runs in the thread of its node and has the same lifetime, so that a goal is monitored even
    while another configuration file is loaded.

    Parameters
    ----------
    node
        The node that calls the actions and publishes the markers of waypoints.
    namespace
        The namespace of the robot; empty: that of the node.

    Raises
    ------
    ImportError
        nav2_msgs is not built; the text is a full sentence.

    """

    def __init__(self, node: Node, namespace: str = '') -> None:
        kinds = (
            interface('action', 'NavigateToPose'),
            interface('action', 'NavigateThroughPoses'),
            interface('action', 'FollowWaypoints'),
        )
        self._manage = interface('srv', 'ManageLifecycleNodes')
        self.node, self.namespace = node, namespace
        self.waypoints: list[PoseStamped] = []
        self.collects = False
        """Whether poses are collected as waypoints instead of sent as goals."""
        self.is_watched = False
        """Whether the state of the lifecycle managers is needed."""
        self.note = ''
        self._calls = ServiceCalls(node)
        self._actions = {
            action: ActionWatch(node, self._calls, kind, action, below(namespace, action))
            for action, kind in zip(ACTIONS, kinds)
        }
        self._managers = [
            ManagerWatch(node, below(namespace, f'lifecycle_manager_{part}'))
            for part in ('localization', 'navigation')
        ]
        self._newest = TO_POSE
        self._begun = dict.fromkeys(ACTIONS, 0)
        self._sent: list[PoseStamped] = []
        self._display = WaypointDisplay(node, below(namespace, 'waypoints'))
        self._looked_s = 0.0
        self._timer = node.create_timer(PERIOD_S, self.update, clock=steady_clock())

    @property
    def goal(self) -> Goal | None:
        """Return the newest goal of all actions."""
        return self._actions[self._newest].goal

    @property
    def markers(self) -> MarkerArray:
        """Return the markers of the goals that are shown."""
        return self._display.markers

    def take_pose(self, pose: PoseStamped) -> None:
        """
        Send the robot to a pose, or add the pose to the waypoints while these are collected.

        Parameters
        ----------
        pose
            The pose, in the frame of its header.

        """
        if not self.collects:
            self._send(TO_POSE, [pose], pose=pose)
        elif len(self.waypoints) < MOST:
            self.waypoints.append(pose)
        else:
            self.note = f'No more than {MOST} waypoints can be collected.'

    def collect(self, is_wanted: bool) -> None:
        """
        Start or stop collecting waypoints.

        Parameters
        ----------
        is_wanted
            Whether poses become waypoints from now on, instead of goals.

        """
        self.collects = is_wanted

    def remove(self, index: int) -> None:
        """
        Remove a waypoint.

        Parameters
        ----------
        index
            Its index, from 0; an invalid one is ignored.

        """
        if 0 <= index < len(self.waypoints):
            del self.waypoints[index]

    def clear(self) -> None:
        """Remove all waypoints."""
        self.waypoints.clear()

    def follow(self, loops: int = 0) -> None:
        """
        Send the robot through the waypoints one after another.

        Parameters
        ----------
        loops
            The number of repetitions after the first round.

        """
        poses = list(self.waypoints)
        self._send(WAYPOINTS, poses, poses=poses, number_of_loops=loops)

    def go_through(self) -> None:
        """Send the robot to the last waypoint through the others, without stopping."""
        poses = list(self.waypoints)
        self._send(THROUGH, poses, poses=poses)

    def cancel(self) -> None:
        """Cancel all active goals, from any client."""
        watches = [
            watch
            for action, watch in self._actions.items()
            if _is_active(watch.goal) and not self._is_part(action)
        ]
        if not watches:
            self.note = 'There is no goal to cancel.'
        for watch in watches:
            watch.cancel(self.say)

    def command(self, command: str) -> None:
        """
        Send a command to the lifecycle managers that are running, one after the other.

        Parameters
        ----------
        command
            A name in `managers.COMMANDS`, such as `startup`.

        """
        managers = [each for each in self._managers if each.is_there]
        if not managers:
            names = ' and '.join(each.name for each in self._managers)
            self.note = f'There is no lifecycle manager: no node offers the services of {names}.'
            return
        if command not in ('startup', 'resume'):
            managers.reverse()  # navigation stops before the localization that it depends on
        command_all(self._calls, self._manage, command, managers, self.say)

    def say(self, sentence: str) -> None:
        """
        Show a message on the page, which replaces the previous one.

        Parameters
        ----------
        sentence
            The message.

        """
        self.note = sentence

    def update(self) -> None:
        """Process calls and received messages, and show the changes."""
        now_s = time.monotonic()
        self._calls.update()
        is_look = now_s - self._looked_s >= LOOK_S
        if is_look:
            self._looked_s = now_s
        for action, watch in self._actions.items():
            watch.update()
            if is_look:
                watch.look()
            if watch.changed != self._begun[action]:
                self._begun[action] = watch.changed
                if not self._is_part(action):
                    self._newest = action
        if self.is_watched:
            for manager in self._managers:
                manager.update(now_s)
        self._display.update(self.waypoints, self._sent, self.goal)

    def told(self) -> dict[str, Any]:
        """Return the state to show on the page."""
        localization, navigation = self._managers
        return {
            'localization': localization.told(),
            'navigation': navigation.told(),
            'there': self._actions[TO_POSE].is_there,
            'goal': self._goal_told(),
            'collects': self.collects,
            'waypoints': [_told(each) for each in self.waypoints],
            'note': self.note,
        }

    def close(self) -> None:
        """Close the session; active goals continue."""
        self.node.destroy_timer(self._timer)
        for watch in self._actions.values():
            watch.close()
        for manager in self._managers:
            manager.close()
        self._calls.close()
        self._display.close()

    def _is_part(self, action: str) -> bool:
        """Whether the goal of an action is only a part of the waypoint goal in progress."""
        goal = self._actions[action].goal
        follows = action != WAYPOINTS and _is_active(self._actions[WAYPOINTS].goal)
        return follows and goal is not None and not goal.is_own

    def _goal_told(self) -> dict[str, Any] | None:
        """Return the goal to show on the page, with its progress to the current waypoint."""
        goal, part = self.goal, self._actions[TO_POSE].goal
        if goal is None:
            return None
        told = goal.told()
        if part is not None and goal.action == WAYPOINTS and self._is_part(TO_POSE):
            told['numbers'] = {**part.numbers, **goal.numbers}
        return told

    def _send(self, action: str, poses: list[PoseStamped], /, **fields: Any) -> None:
        if not poses:
            self.note = 'There are no waypoints: collect some first.'
            return
        stamp = self.node.get_clock().now().to_msg()
        for pose in poses:
            pose.header.stamp = stamp
        self.note = ''
        self._sent = poses
        self._actions[action].send(len(poses), **fields)


_sessions: WeakKeyDictionary[Node, dict[str, NavigationSession]] = WeakKeyDictionary()


def session_of(node: Node, namespace: str | None = None) -> NavigationSession:
    """
    Get the session of a robot, which lasts as long as the node.

    Parameters
    ----------
    node
        The node of the page.
    namespace
        The namespace of the robot; None for the only robot with a session, else for the empty one.

    Raises
    ------
    ImportError
        nav2_msgs is not built; the text is a full sentence.

    """
    sessions = _sessions.setdefault(node, {})
    if namespace is None:
        namespace = next(iter(sessions)) if len(sessions) == 1 else ''
    if namespace not in sessions:
        sessions[namespace] = NavigationSession(node, namespace)
    return sessions[namespace]


def close_sessions(node: Node) -> None:
    """
    Close the sessions of a node before it is destroyed while its process continues.

    Parameters
    ----------
    node
        The node that was passed to `session_of`.

    """
    for session in _sessions.pop(node, {}).values():
        session.close()


def _is_active(goal: Goal | None) -> bool:
    return goal is not None and not goal.phase.is_over


def _told(pose: PoseStamped) -> dict[str, Any]:
    at, turn = pose.pose.position, pose.pose.orientation
    yaw = 2.0 * math.atan2(turn.z, turn.w)
    return {
        'x': at.x,
        'y': at.y,
        'yaw': math.degrees(math.atan2(math.sin(yaw), math.cos(yaw))),
        'frame': pose.header.frame_id,
    }
