# SPDX-License-Identifier: Apache-2.0
"""Panel with a slider for each joint of a robot without a controller."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from random import Random
from typing import Any, TYPE_CHECKING

from joint_state_publisher_gui.board import Board, JointSlider
from joint_state_publisher_gui.limbs import Limb
from joint_state_publisher_gui.poses import (
    BoardPoses,
    pose_file,
    PoseError,
    Poses,
    poses_folder,
)
from robot_console.live_panel import LivePanel
from robot_console.namespaces import NAMESPACE
from robot_console.remote_sliders import POSITIONS, RemoteSliders
from rviz_common.pace import Pace
from rviz_common.page.channel import Action, Viewer
from rviz_common.properties import Text, Topic

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['Sliders']

NODE = 'joint_state_publisher'
JOINT_STATE = 'sensor_msgs/msg/JointState'
LIST_S = 1.0
LARGEST = 1e9


@dataclass(frozen=True)
class _Robot:
    """The sliders of a robot, its saved poses, and the limbs as the page shows them."""

    board: Board
    poses: BoardPoses
    limbs: list[dict[str, Any]]

    @classmethod
    def of(cls, board: Board) -> _Robot:
        poses = Poses(pose_file(board.robot, poses_folder()))
        limbs = [
            _limb(limb, [board.sliders[name] for name in limb.joints]) for limb in board.limbs
        ]
        return cls(board, BoardPoses(board, poses), limbs)


class Sliders(LivePanel):
    """
    The joints of a robot as sliders, and its saved poses.

    The node `joint_state_publisher_gui` publishes the joint states. The panel is added
    automatically when there is such a node.

    """

    CLASS = 'robot_console/Sliders'
    PAGE = 'sliders'
    PERIOD_S = 0.1
    PROPERTIES = (
        NAMESPACE,
        Text('Node', NODE, 'Name of the node of joint_state_publisher_gui.'),
        Topic('Joint States Topic', 'joint_states', 'Topic of the joint states.', JOINT_STATE),
        Topic(
            'Description Topic',
            'robot_description',
            'Source of the joints and their limits.',
            'std_msgs/msg/String',
        ),
    )

    @classmethod
    def is_wanted(cls, node: Node) -> bool:
        """
        Check whether there is a joint_state_publisher_gui.

        Parameters
        ----------
        node
            The node of the page; the name of the other node is relative to its namespace.

        """
        return bool(node.count_subscribers(node.resolve_topic_name(f'{NODE}/{POSITIONS}')))

    def actions(self) -> Mapping[str, Action]:
        """Return the actions that the page may request."""
        return {
            'move': self._move,
            'all': self._move_all,
            'load': self._load,
            'save': self._save,
            'delete': self._delete,
        }

    def begin(self) -> None:
        """Prepare to follow the node; nothing is subscribed while nobody views the page."""
        names = ('Node', 'Joint States Topic', 'Description Topic')
        self._sliders = RemoteSliders(
            self.context.node, *(self.full_name(self.values[each]) for each in names)
        )
        self._random = Random()
        self._robot: _Robot | None = None
        self._saved: list[str] = []
        self._poses_problem = ''
        self._told: dict[str, Any] = {}
        self._values: dict[str, float] = {}
        self._look = Pace(LIST_S)

    def greet(self, viewer: Viewer) -> None:
        """
        Send the sliders and their values to a new viewer.

        Parameters
        ----------
        viewer
            As for `LivePanel.greet`.

        """
        viewer.tell(**self._state(), values=self._shown())

    def refresh(self) -> None:
        """Follow the node while somebody views the page, and send what has changed."""
        if not self.channel.viewers:
            self._sliders.rest()
            return
        self._sliders.update()
        self._follow()
        state = self._state()
        if state != self._told:
            self._told, self._values = state, {}
            self.channel.tell(**state)
        values = self._shown()
        changed = {
            name: value for name, value in values.items() if value != self._values.get(name)
        }
        if changed:
            self._values = values
            self.channel.tell(values=changed)

    def end(self) -> None:
        """Destroy the publisher, the subscriptions and the clients."""
        self._sliders.close()

    def _follow(self) -> None:
        """Take the sliders of a new robot, and the saved poses."""
        board = self._sliders.board
        if board is not (self._robot.board if self._robot is not None else None):
            self._robot = _Robot.of(board) if board is not None else None
            self._look.hurry()
        if self._look.is_due():
            self._list()

    def _list(self) -> None:
        """Read the names of the saved poses again, since others may save poses, too."""
        try:
            self._saved = self._robot.poses.names() if self._robot is not None else []
            self._poses_problem = ''
        except PoseError as error:
            self._saved, self._poses_problem = [], str(error)

    def _state(self) -> dict[str, Any]:
        """Return what the page shows besides the values."""
        return {
            'limbs': self._robot.limbs if self._robot is not None else [],
            'poses': self._saved,
            'problem': self._sliders.problem,
            'posesProblem': self._poses_problem,
        }

    def _shown(self) -> dict[str, float]:
        """Return the values of all sliders, in rad or m."""
        sliders = self._robot.board.sliders.values() if self._robot is not None else ()
        return {slider.name: slider.shown for slider in sliders}

    def _known(self) -> _Robot:
        """Return the robot, or raise ValueError."""
        if self._robot is None or self._robot.board is not self._sliders.board:
            raise ValueError(self._sliders.problem or 'The robot has just changed.')
        return self._robot

    def _move(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        """Move a joint to where its slider was dragged."""
        slider = self._known().board.sliders.get(_name(message))
        if slider is None:
            raise ValueError('This slider no longer exists.')
        value = message.get('value')
        if not isinstance(value, (int, float)) or not -LARGEST <= value <= LARGEST:
            raise ValueError(f"The position of '{slider.name}' must be a number.")
        slider.give(value)
        self._sliders.send([slider.name])

    def _move_all(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        """Move all joints as a button says."""
        board = self._known().board
        moves: dict[str, Callable[[], None]] = {
            'centre': board.centre,
            'zero': board.zero,
            'randomise': lambda: board.randomise(self._random),
        }
        if (move := moves.get(str(message.get('how')))) is not None:
            move()
            self._sliders.send(board.sliders)

    def _load(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        robot = self._known()
        viewer.tell(said=robot.poses.load(_name(message)))
        self._sliders.send(robot.board.sliders)
        self._look.hurry()

    def _save(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        viewer.tell(said=self._known().poses.save(_name(message)))
        self._look.hurry()

    def _delete(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        viewer.tell(said=self._known().poses.delete(_name(message)))
        self._look.hurry()


def _name(message: Mapping[str, Any]) -> str:
    return str(message.get('name', ''))


def _limb(limb: Limb, sliders: Sequence[JointSlider]) -> dict[str, Any]:
    return {
        'title': limb.title,
        'sliders': [
            {
                'name': slider.name,
                'label': limb.label(slider.name),
                'ends': slider.scale.ends,
                'step': slider.scale.step,
                'isAngle': slider.scale.is_angle,
                'about': f'{slider.name}: {slider.scale.describe()}',
            }
            for slider in sliders
        ],
    }
