# SPDX-License-Identifier: Apache-2.0
"""Panel with gestures and saved poses as buttons."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
import math
from typing import Any

from geometry_msgs.msg import Point, Pose, Quaternion
from rclpy.duration import Duration
from robot_console.gestures.gesture_book import GestureBook, POSE
from robot_console.gestures.gesture_execution import GestureExecution
from robot_console.gestures.gesture_file import BodyPose, Gesture, GestureError
from robot_console.gestures.gesture_plan import GesturePlan, plan_gesture
from robot_console.gestures.robot_watch import RobotWatch
from robot_console.gestures.trajectory_goals import trajectory_goal, TrajectoryGoals
from robot_console.live_panel import LivePanel
from robot_console.namespaces import NAMESPACE
from robot_console.robot_link import COMMAND, link_of
from robot_console.service_calls import ServiceCalls
from rviz_common.pace import Pace
from rviz_common.page.channel import Action, Viewer
from rviz_common.properties import Number, Text, Topic

__all__ = ['Gestures']

MANAGER, BODY = 'Controller Manager', 'Body Pose Topic'
JOINT_STATES, DESCRIPTION = 'Joint States Topic', 'Description Topic'
LOOKING = 'Looking at the robot ...'


@dataclass(frozen=True)
class _Running:
    """The gesture in progress, and its button."""

    button: str
    gesture: Gesture
    execution: GestureExecution


class Gestures(LivePanel):
    """
    Gestures of a file, and saved poses, as buttons.

    They are goals of the trajectory controllers that the controller manager lists, and body poses
    for robots that subscribe to them. A button is disabled, with the reason, while its gesture is
    not possible.

    """

    CLASS = 'robot_console/Gestures'
    PAGE = 'gestures'
    PROPERTIES = (
        NAMESPACE,
        Text('File', '', 'YAML file of the gestures: a path, file:// or package://.'),
        Number('Max Joint Velocity', 1.5, 'In rad/s or m/s, for all joints.', 0.01, 50.0),
        Number(
            'Path Tolerance',
            0.4,
            'How far a joint may be off on the way, in rad or m; 0: as the controller has it.',
            0.0,
            10.0,
        ),
        Text(MANAGER, 'controller_manager', 'Name of the controller manager.'),
        Topic(
            JOINT_STATES,
            'joint_states',
            'Topic of the joint states.',
            'sensor_msgs/msg/JointState',
        ),
        Topic(DESCRIPTION, 'robot_description', 'Source of joint limits.', 'std_msgs/msg/String'),
        Topic(BODY, 'body_pose', 'Where body poses are published.', 'geometry_msgs/msg/Pose'),
    )

    def actions(self) -> Mapping[str, Action]:
        """Return the actions that the page may request."""
        return {
            'play': self._play,
            'cancel': self._cancel,
            'save': self._save,
            'delete': self._delete,
        }

    def begin(self) -> None:
        """Read the file, and subscribe to the state of the robot."""
        node, namespace = self.context.node, self.values['Namespace']
        names = [
            self.full_name(self.values[each]) for each in (MANAGER, JOINT_STATES, DESCRIPTION)
        ]
        body = self.full_name(self.values[BODY])
        self._link = link_of(self.context, namespace)
        self._calls = ServiceCalls(node)
        self._book = GestureBook(self.values['File'])
        self._robot = RobotWatch(node, self._link, namespace, *names)
        self._bodies = node.create_publisher(Pose, body, COMMAND)
        self._running: _Running | None = None
        self._said = ''
        self._why: dict[str, str] = {}
        self._told: dict[str, Any] = {}
        self._look = Pace(1.0)

    def greet(self, viewer: Viewer) -> None:
        """
        Send the gestures and their state to a new viewer.

        Parameters
        ----------
        viewer
            As for `LivePanel.greet`.

        """
        viewer.tell(**self._state())

    def update(self) -> None:
        """Carry on with the gesture in progress, and send updates."""
        self._calls.update()
        if self._running is not None:
            self._continue(self._running)
        super().update()

    def refresh(self) -> None:
        """Follow the robot while somebody views the page, and send the state if it has changed."""
        if not self.channel.viewers:
            self._robot.rest()
            self._why.clear()
            return
        self._robot.update()
        if self._look.is_due():
            self._robot.examine()
            self._book.refresh(self._robot.name)
            self._why = {key: self._reason(each) for key, each in self._book.gestures.items()}
        state = self._state()
        if state != self._told:
            self._told = state
            self.channel.tell(**state)

    def end(self) -> None:
        """Straighten the body, and destroy the subscriptions and clients; joints move on."""
        if self._running is not None:
            self._running.execution.cancel()
            self._bodies.wait_for_all_acked(Duration(seconds=0.2))
        self._calls.close()
        self._robot.close()
        self.context.node.destroy_publisher(self._bodies)

    def _reason(self, gesture: Gesture) -> str:
        """Explain why a gesture is not possible; '' if it is."""
        try:
            self._plan(gesture)
        except GestureError as error:
            return str(error)
        return ''

    def _plan(self, gesture: Gesture) -> GesturePlan:
        """Plan a gesture from the current positions, or raise GestureError."""
        state = self._robot.state(gesture.bends)
        if gesture.bends and not self._bodies.get_subscription_count():
            raise GestureError(
                f"This robot cannot bend: there is no subscriber on '{self._bodies.topic_name}'."
            )
        return plan_gesture(gesture, state, self.values['Max Joint Velocity'])

    def _state(self) -> dict[str, Any]:
        """Return what the page shows."""
        running = self._running
        others = f"'{running.gesture.name}' is running. Cancel it first." if running else ''
        return {
            'buttons': [
                {
                    'id': button,
                    'name': each.name,
                    'about': each.about,
                    'isSaved': button.startswith(POSE),
                    'why': others or self._why.get(button, LOOKING),
                }
                for button, each in self._book.gestures.items()
            ],
            'running': running.button if running else '',
            'problem': self._book.problem,
            'why': self._robot.problem,
            'said': self._said,
        }

    def _check_person(self, viewer: Viewer) -> None:
        """Raise ValueError if another person is in control."""
        control = self._link.control.person
        if control and control != self._link.people.name(viewer.key):
            raise ValueError(f'{control} is in control.')

    def _play(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        """Begin a gesture, or cancel it if it is running."""
        button = message.get('button')
        running = self._running
        if running is not None and running.button == button:
            self._cancel(viewer, message)
            return
        if running is not None:
            raise ValueError(f"'{running.gesture.name}' is running. Cancel it first.")
        self._check_person(viewer)
        if not isinstance(button, str) or button not in self._book.gestures:
            raise ValueError('This gesture no longer exists.')
        gesture = self._book.gestures[button]
        plan = self._plan(gesture)
        tolerance = self.values['Path Tolerance']
        goals = TrajectoryGoals(
            self._calls,
            {
                self._robot.controllers.action(each.controller): trajectory_goal(each, tolerance)
                for each in plan.motions
            },
        )
        self._said = ''
        execution = GestureExecution(plan, goals, self._bend, self._now_s)
        self._running = _Running(button, gesture, execution)

    def _cancel(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        """Cancel the running gesture, which everybody may do."""
        if self._running is not None:
            self._running.execution.cancel()

    def _continue(self, running: _Running) -> None:
        """Carry on with the running gesture; end it if the robot walks, falls or holds still."""
        reason = self._robot.unready_because
        if reason:
            running.execution.cancel(f"'{running.gesture.name}' was ended. {reason}")
        running.execution.update()
        if running.execution.is_over:
            self._said = running.execution.failure
            self._running = None
            self._look.hurry()

    def _bend(self, body: BodyPose) -> None:
        half_rad = body.pitch_rad / 2.0
        turn = Quaternion(y=math.sin(half_rad), w=math.cos(half_rad))
        self._bodies.publish(Pose(position=Point(z=body.height_m), orientation=turn))

    def _now_s(self) -> float:
        return float(self.context.node.get_clock().now().nanoseconds) / 1e9

    def _save(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        """Save where the joints of all controllers are."""
        pose = self._robot.posture()
        if not pose:
            raise ValueError(
                self._robot.controllers.problem
                or 'The pose is not saved: no joint state has a position.'
            )
        self._book.save(str(message.get('name', '')), pose)
        self._said = ''
        self._look.hurry()

    def _delete(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        self._book.delete(str(message.get('button', '')))
        self._look.hurry()
