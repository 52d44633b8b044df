# SPDX-License-Identifier: Apache-2.0
"""The source of a robot description: a topic, or a file."""

from __future__ import annotations

from collections.abc import Callable
from copy import copy
import os
from typing import Any

from rclpy.qos import DurabilityPolicy, QoSProfile
from rviz_default_plugins.robot.mesh_file import find_file
from urdf import read_urdf_file

__all__ = ['DescriptionTopic', 'read_description']

Take = Callable[[str, str], None]


class DescriptionTopic:
    """
    Subscription to the robot descriptions on a topic.

    It is always transient local, as robot_state_publisher is, although files of RViz set
    Volatile. Volatile publishers are received, too.

    Parameters
    ----------
    node
        The node that subscribes.
    name
        The topic, with messages of the type `std_msgs/msg/String`.
    take
        Called with each description and the name of the topic.
    qos
        The QoS profile, whose durability is ignored; by default a depth of 1.

    Raises
    ------
    ValueError
        The name is empty, or not a valid topic name.

    """

    def __init__(self, node: Any, name: str, take: Take, qos: QoSProfile | None = None) -> None:
        self._node, self._name, self._take = node, name, take
        self._subscriptions: list[Any] = []
        if not name:
            raise ValueError('No description topic selected.')
        try:
            for durability in (DurabilityPolicy.TRANSIENT_LOCAL, DurabilityPolicy.VOLATILE):
                self._subscribe(durability, qos or QoSProfile(depth=1))
        except Exception as error:  # rclpy has no single exception for invalid names
            raise ValueError(f"'{name}' cannot be subscribed: {error}") from error

    def close(self) -> None:
        """Unsubscribe."""
        for subscription in self._subscriptions:
            self._node.destroy_subscription(subscription)
        self._subscriptions.clear()

    def _subscribe(self, durability: DurabilityPolicy, qos: QoSProfile) -> None:
        from rclpy.event_handler import SubscriptionEventCallbacks
        from std_msgs.msg import String

        qos = copy(qos)
        qos.durability = durability
        self._subscriptions.append(
            self._node.create_subscription(
                String,
                self._name,
                lambda message: self._take(message.data, self._name),
                qos,
                event_callbacks=SubscriptionEventCallbacks(use_default_callbacks=False),
            )
        )


def read_description(name: str) -> str:
    """
    Read the text of a URDF file.

    Parameters
    ----------
    name
        An absolute path, or a URL that starts with `package://` or `file://`.

    Raises
    ------
    ValueError
        The name is empty, or the file cannot be found or read.

    """
    if not name:
        raise ValueError('No description file selected.')
    path = str(find_file(name))
    if os.path.exists(path) and not os.path.isfile(path):  # a pipe might never end
        raise ValueError(f"'{name}' is not a regular file.")
    return read_urdf_file(path)
