# SPDX-License-Identifier: Apache-2.0
"""Panel to command a robot in natural language."""

from __future__ import annotations

from array import array
import base64
import binascii
from collections import deque
from collections.abc import Mapping
import json
import time
from typing import Any, TYPE_CHECKING

from robot_console.live_panel import LivePanel
from robot_console.namespaces import NAMESPACE
from robot_console.robot_link import LATCHED
from rviz_common.properties import Topic
from std_msgs.msg import String

if TYPE_CHECKING:
    from rclpy.node import Node
from rviz_common.page.channel import Action, Viewer

__all__ = ['Command']

COMMAND, HEARD, SAID = 'you', 'heard', 'robot'
TOPIC, TYPE = 'user_command', 'std_msgs/msg/String'
LONGEST = 500
LONGEST_SOUND = 64_000
KEPT = 200
DEPTH = 50


class Command(LivePanel):
    """
    A conversation with a robot, and the plan that it works on.

    Typed text is published as a string, and so is `stop`. The state of the plan is a JSON string:
    `command`, `state` (running, succeeded, failed or canceled), and `steps`, each with `text` and
    `state`. Audio from the browser's microphone is published as 16 kHz mono S16LE for a speech
    recogniser. The panel is added automatically when a node subscribes to `user_command`.

    """

    CLASS = 'robot_console/Command'
    FOLLOWS = 'robot_console/Drive'
    PAGE = 'command'
    PROPERTIES = (
        NAMESPACE,
        Topic('Command Topic', TOPIC, 'Where typed commands are published.', TYPE),
        Topic('Transcript Topic', 'speech/transcript', 'Topic of the recognised speech.', TYPE),
        Topic('Speech Topic', 'speech/say', 'Topic of what the robot says.', TYPE),
        Topic(
            'Audio Topic',
            'audio',
            "Where the audio of the browser's microphone is published.",
            'audio_common_msgs/msg/AudioData',
        ),
        Topic('State Topic', 'executor/state', 'Topic of the state of the plan.', TYPE),
    )

    @classmethod
    def is_wanted(cls, node: Node) -> bool:
        """
        Check whether a node subscribes to commands.

        Parameters
        ----------
        node
            The node of the page; the topic is relative to its namespace.

        """
        name = node.resolve_topic_name(TOPIC)
        return any(each.topic_type == TYPE for each in node.get_subscriptions_info_by_topic(name))

    def settings(self) -> dict[str, Any]:
        """Return the initial settings of the page."""
        return {'topic': self._name('Command Topic'), 'longest': LONGEST}

    def actions(self) -> Mapping[str, Action]:
        """Return the actions that the page may request."""
        return {
            'tell': self._tell,
            'hear': self._hear,
            'stop': lambda viewer, message: self._publish('stop'),
        }

    def begin(self) -> None:
        """Create publishers and subscriptions; the conversation is kept also without viewers."""
        node = self.context.node
        self._lines: deque[tuple[float, str, str]] = deque(maxlen=KEPT)
        self._plan: dict[str, Any] = {}
        self._commands = node.create_publisher(String, self._name('Command Topic'), DEPTH)
        self._sound = _sound_publisher(node, self._name('Audio Topic'))
        self._subscriptions = [
            node.create_subscription(
                String, self._name(name), lambda message, who=who: self._add(who, message), DEPTH
            )
            for name, who in (
                ('Command Topic', COMMAND),
                ('Transcript Topic', HEARD),
                ('Speech Topic', SAID),
            )
        ]
        self._subscriptions.append(
            node.create_subscription(String, self._name('State Topic'), self._take_plan, LATCHED)
        )

    def greet(self, viewer: Viewer) -> None:
        """
        Send the previous conversation and the plan to a new viewer.

        Parameters
        ----------
        viewer
            The viewer that has opened the panel.

        """
        viewer.tell(lines=list(self._lines), plan=self._plan, fresh=True)

    def end(self) -> None:
        """Destroy the subscriptions and publishers."""
        for each in self._subscriptions:
            self.context.node.destroy_subscription(each)
        for publisher in (self._commands, self._sound):
            if publisher is not None:
                self.context.node.destroy_publisher(publisher)

    def _name(self, name: str) -> str:
        return self.full_name(self.values[name])

    def _tell(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        text = message.get('text')
        if not isinstance(text, str) or not text.strip():
            raise ValueError('Type what the robot should do.')
        if len(text) > LONGEST:
            raise ValueError(f'Use at most {LONGEST} characters.')
        self._publish(text.strip())

    def _hear(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        """Publish a chunk of audio from the browser's microphone."""
        try:
            sound = base64.b64decode(message.get('sound', ''), validate=True)
        except (TypeError, ValueError, binascii.Error):
            raise ValueError('The recording of the microphone could not be read.') from None
        if len(sound) > LONGEST_SOUND or len(sound) % 2:
            raise ValueError('The recording of the microphone could not be read.')
        if self._sound is None or not self._sound.get_subscription_count():
            raise ValueError('No one is listening: the speech recogniser is not running.')
        self._sound.publish(self._sound.msg_type(data=array('B', sound)))

    def _publish(self, text: str) -> None:
        node = self.context.node
        listeners = node.get_subscriptions_info_by_topic(self._commands.topic_name)
        own = (node.get_name(), node.get_namespace())
        if all((each.node_name, each.node_namespace) == own for each in listeners):
            raise ValueError('No one receives commands: the planner of the robot is not running.')
        self._commands.publish(String(data=text))

    def _add(self, who: str, message: String) -> None:
        line = (time.time(), who, message.data[: 2 * LONGEST])
        self._lines.append(line)
        self.channel.tell(lines=[line])

    def _take_plan(self, message: String) -> None:
        try:
            told = json.loads(message.data)
        except ValueError:
            return
        if isinstance(told, dict):
            self._plan = told
            self.channel.tell(plan=told)


def _sound_publisher(node: Node, topic: str) -> Any:
    """Create the audio publisher; None if the message package is not installed."""
    try:
        from audio_common_msgs.msg import AudioData
    except ImportError:
        return None
    return node.create_publisher(AudioData, topic, DEPTH)
