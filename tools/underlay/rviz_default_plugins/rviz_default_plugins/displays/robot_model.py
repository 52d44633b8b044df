# SPDX-License-Identifier: Apache-2.0
"""The display of the robot described by a URDF, in its current pose."""

from __future__ import annotations

from collections.abc import Set
import time
from typing import Any

from rviz_common.display import Display
from rviz_common.frames import Frames, Pose
from rviz_common.properties import Choice, Flag, Number, qos_of, Text, topic_properties
from rviz_common.selection import Hit, Ray
from rviz_common.status import Level
from rviz_default_plugins.parts import Parts
from rviz_default_plugins.robot.description import DescriptionTopic, read_description
from rviz_default_plugins.robot.mesh_loading import MeshShelf
from rviz_default_plugins.robot.mesh_reader import MeshReader
from rviz_default_plugins.robot.missing_links import say_missing
from rviz_default_plugins.robot.robot_link import pick_link
from rviz_default_plugins.robot.robot_scene import Look, MAX_SHAPES, PoseOf, RobotScene
from urdf import Joint, Mesh, parse_urdf, UrdfError
from urdf import RobotModel as Robot

__all__ = ['RobotModel']

FILE, TOPIC = 'File', 'Topic'
MAX_LINKS = 2000
ALL_LINKS = 'Links/All Links Enabled'
REASONS_S = 0.5


class RobotModel(Display):
    """
    The robot that a URDF describes; transforms say where its links are.

    Parameters
    ----------
    *arguments, **options
        As for `Display`.

    """

    CLASS = 'rviz_default_plugins/RobotModel'
    PROPERTIES = (
        Flag('Visual Enabled', True, 'Show the visual geometry of the links.'),
        Flag('Collision Enabled', False, 'Show the collision geometry of the links.'),
        Number('Alpha', 1.0, 'Opacity of the robot, from 0 to 1.', 0.0, 1.0),
        Number('Update Interval', 0.0, 'Seconds between updates; 0: each frame.', 0.0),
        Choice('Description Source', TOPIC, 'Where the URDF comes from.', (TOPIC, FILE)),
        Text('Description File', '', 'The file of the URDF: a path, file:// or package://.'),
        *topic_properties(
            'std_msgs/msg/String', '/robot_description', path='Description Topic', depth=1
        ),
        Text('TF Prefix', '', 'Prefix of the links in frame names, without the slash.'),
        Flag(ALL_LINKS, True, 'Show links that the file does not mention.'),
    )
    UNUSED = ('Mass Properties',)

    def __init__(self, *arguments: Any, **options: Any) -> None:
        super().__init__(*arguments, **options)
        self._links = Parts(super().to_file().get('Links'))
        self._links.all_shown = self.values[ALL_LINKS]
        self._meshes = MeshReader(self.context.queue)

    def to_file(self) -> dict[str, Any]:
        """Return the entry for the .rviz file, with the settings of single links."""
        return self._links.put_into(super().to_file(), 'Links')

    def start(self) -> None:
        """Subscribe to the robot description, or read it from a file."""
        self._model: Robot | None = None
        self._robot: RobotScene | None = None
        self._text = ''
        self._next_s = self._next_reasons_s = 0.0
        self._topic: DescriptionTopic | None = None
        if self.values['Description Source'] == FILE:
            self._read_file()
        else:
            self._listen(self.topic_of('Description Topic'))

    def stop(self) -> None:
        """Remove the robot."""
        if self._topic is not None:
            self._topic.close()
        self._meshes.cancel()
        self._remove()
        self.status.clear()

    def update(self) -> None:
        """Update the poses of the links."""
        now_s = time.monotonic()
        robot = self._robot
        if robot is None or now_s < self._next_s:
            return
        self._next_s = now_s + self.values['Update Interval']
        root, pose_of = self.poses(robot.model)
        unknown = robot.place(root, pose_of)
        robot.hide(self.hidden_links(robot))
        if now_s >= self._next_reasons_s:
            self._next_reasons_s = now_s + REASONS_S
            self.say_reasons(robot.model, root, unknown)

    def pick(self, ray: Ray) -> Hit | None:
        """
        Find the first link on a ray.

        Parameters
        ----------
        ray
            As for `Display.pick`.

        """
        return None if self._robot is None else pick_link(self._robot, ray, self.prefix)

    def on_change(self, path: str) -> None:
        """
        Restart if the description changes; apply any other property to the robot that is shown.

        Parameters
        ----------
        path
            As for `Display.on_change`.

        """
        if path.startswith('Description'):
            super().on_change(path)
            return
        if path == ALL_LINKS:
            self._links.show_all(self.values[ALL_LINKS])
        self._next_s = self._next_reasons_s = 0.0
        if path not in ('TF Prefix', 'Update Interval') and self._model is not None:
            self._prepare(self._model)

    def poses(self, model: Robot) -> tuple[Pose | None, PoseOf]:
        """
        Look up the pose of the root link, and provide those of the joints.

        Parameters
        ----------
        model
            The robot.

        Returns
        -------
        tuple[Pose | None, PoseOf]
            The pose of the root link in the fixed frame; and a function that returns, for a joint,
            that of its child link in its parent link. Each pose is None if it is unknown.

        """
        frames, prefix = self.context.frames, self.prefix
        return frames.find(frames.fixed_frame, prefix + model.root), _poses(frames, prefix)

    def hidden_links(self, robot: RobotScene) -> Set[str]:
        """
        Return the links whose bodies are hidden for now; called after `poses`.

        Parameters
        ----------
        robot
            The robot in the scene.

        """
        return frozenset()

    def topic_of(self, path: str) -> str:
        """
        Read the topic that a property names.

        Parameters
        ----------
        path
            The path of the property, without `/Value`.

        """
        return str(self.values[f'{path}/Value'])

    @property
    def prefix(self) -> str:
        """The prefix of the links in the names of frames."""
        prefix: str = self.values['TF Prefix'].strip('/')
        return f'{prefix}/' if prefix else ''

    def _listen(self, topic: str) -> None:
        try:
            self._topic = DescriptionTopic(
                self.context.node, topic, self._take, qos_of(self.values, 'Description Topic')
            )
        except ValueError as error:
            self.say('URDF', str(error), Level.ERROR)
            return
        missing = f'No description received on {topic} yet; robot_state_publisher publishes it.'
        self.say('URDF', missing)

    def _read_file(self) -> None:
        name = self.values['Description File']
        try:
            self._take(read_description(name), name)
        except ValueError as error:
            self.status.say('URDF', Level.ERROR, str(error))

    def _take(self, text: str, source: str) -> None:
        """Show the robot of a description; if it is invalid, keep the previous one."""
        if text == self._text:
            return
        self._text = text
        try:
            model = parse_urdf(text, source)
            _check_size(model, source)
        except UrdfError as error:
            stays = ' The previous robot stays.' if self._model else ''
            self.status.say('URDF', Level.ERROR, f'{error}{stays}')
            return
        self.status.say('URDF', Level.OK, model.describe())
        self._prepare(model)

    def _prepare(self, model: Robot) -> None:
        """Draw a robot, immediately or once its meshes have been read in the background."""
        self._model, look = model, self.look()
        self._meshes.read(_mesh_names(model, look), lambda shelf: self._draw(model, look, shelf))

    def _draw(self, model: Robot, look: Look, shelf: MeshShelf) -> None:
        self._remove()
        self._robot = RobotScene(self.context.scene, self.root, model, look, shelf.meshes)
        self.say('Meshes', ' '.join(shelf.complaints))
        self.say('Bodies', _too_many(self._robot.left_out))

    def _remove(self) -> None:
        if self._robot is not None:
            self._robot.remove()
        self._robot = None

    def look(self) -> Look:
        """Return the look of the robot: the parts that are shown, and how."""
        return Look(
            visuals=self.values['Visual Enabled'],
            collisions=self.values['Collision Enabled'],
            alpha=self.values['Alpha'],
            links=self._links,
        )

    def say_reasons(self, model: Robot, root: Pose | None, unknown: list[Joint]) -> None:
        """
        Report in the status why the robot, or some of its links, is not shown.

        Parameters
        ----------
        model
            The robot.
        root
            The pose of the root link, None if it is unknown.
        unknown
            The joints whose pose is unknown.

        """
        frames, frame = self.context.frames, self.prefix + model.root
        reason = '' if root else frames.reason(frames.fixed_frame, frame)
        self.say('Transform', reason and f'The robot is not shown: {reason}', Level.ERROR)
        say_missing(self.status, unknown, model, frames.latest(), self.prefix)

    def say(self, subject: str, sentence: str, level: Level = Level.WARN) -> None:
        """
        Set or remove a message of the status.

        Parameters
        ----------
        subject
            What it is about, such as `URDF`.
        sentence
            The message; '' removes it.
        level
            The severity.

        """
        if sentence:
            self.status.say(subject, level, sentence)
        else:
            self.status.forget(subject)


def _too_many(left_out: int) -> str:
    if not left_out:
        return ''
    return f'{MAX_SHAPES + left_out} bodies are too many: {MAX_SHAPES} are shown.'


def _check_size(model: Robot, source: str) -> None:
    if len(model.links) > MAX_LINKS:
        reason = f'{len(model.links)} links are too many: at most {MAX_LINKS} are shown.'
        raise UrdfError(reason, source=source)


def _poses(frames: Frames, prefix: str) -> PoseOf:
    def pose_of(joint: Joint) -> Pose | None:
        return frames.find(prefix + joint.parent, prefix + joint.child)

    return pose_of


def _mesh_names(model: Robot, look: Look) -> list[str]:
    shapes = [shape for link in model.links for _, shape in look.shapes(link)]
    return [shape.geometry.file for shape in shapes if isinstance(shape.geometry, Mesh)]
