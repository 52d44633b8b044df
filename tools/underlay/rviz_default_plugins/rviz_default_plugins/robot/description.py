# SPDX-License-Identifier: Apache-2.0
"""Where the description of a robot comes from: a topic, or a file."""

from __future__ import annotations

from collections.abc import Callable
import os
from typing import Any

from rclpy.qos import DurabilityPolicy
from rviz_common.display import Display
from rviz_common.properties import qos_of
from rviz_common.status import Level
from rviz_default_plugins.robot.mesh_file import find_file
from urdf import read_urdf_file

__all__ = ['DescriptionTopic', 'read_description']

PATH = 'Description Topic'
Take = Callable[[str, str], None]


class DescriptionTopic:
    """
    The descriptions that come on a topic.

    It always asks for the one from before: that is how robot_state_publisher publishes, and files
    of RViz say Volatile nevertheless. Who publishes without keeping is heard too.
    """

    def __init__(self, display: Display, take: Take) -> None:
        """Subscribe the topic of a display."""
        self._display, self._take = display, take
        self._name = display.values[f'{PATH}/Value']
        self._subscriptions: list[Any] = []
        if not self._name:
            display.status.say('URDF', Level.WARN, 'No description topic is chosen.')
            return
        try:
            for durability in (DurabilityPolicy.TRANSIENT_LOCAL, DurabilityPolicy.VOLATILE):
                self._subscribe(durability)
        except Exception as error:  # rclpy has no one exception for bad names
            sentence = f"'{self._name}' cannot be subscribed: {error}"
            display.status.say('URDF', Level.ERROR, sentence)
            return
        display.status.say(
            'URDF',
            Level.WARN,
            f'No description has come on {self._name} yet; robot_state_publisher publishes it.',
        )

    def close(self) -> None:
        """Subscribe no longer."""
        for subscription in self._subscriptions:
            self._display.context.node.destroy_subscription(subscription)
        self._subscriptions.clear()

    def _subscribe(self, durability: DurabilityPolicy) -> None:
        from rclpy.event_handler import SubscriptionEventCallbacks
        from std_msgs.msg import String

        qos = qos_of(self._display.values, PATH)
        qos.durability = durability
        self._subscriptions.append(
            self._display.context.node.create_subscription(
                String,
                self._name,
                lambda message: self._take(message.data, self._name),
                qos,
                event_callbacks=SubscriptionEventCallbacks(use_default_callbacks=False),
            )
        )


def read_description(name: str) -> str:
    """Return the text of a file, or raise ValueError with the reason."""
    if not name:
        raise ValueError('No description file is chosen.')
    path = str(find_file(name))
    if os.path.exists(path) and not os.path.isfile(path):  # a pipe might never end
        raise ValueError(f"'{name}' is no regular file.")
    return read_urdf_file(path)
