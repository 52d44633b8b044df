# SPDX-License-Identifier: Apache-2.0
"""Identify the nodes that cannot connect to an endpoint because of incompatible QoS."""

from __future__ import annotations

import sys
from typing import Any

from rclpy.duration import Duration, Infinite
from rclpy.qos import LivelinessPolicy, qos_check_compatible, QoSCompatibility, QoSProfile
from ros2topic.api.qos import copy_profile

DURATIONS = ('deadline', 'lifespan', 'liveliness_lease_duration')


class Incompatibility:
    """
    Report on stderr about nodes that cannot connect because of incompatible QoS.

    Nothing is looked up before the middleware reports a mismatch: pass `on_event` to rclpy as the
    callback for incompatible QoS, and call `check` regularly.

    Parameters
    ----------
    node
        The `DirectNode` that has the publisher or subscription.
    topic
        Full name of the topic.
    profile
        The profile of the publisher or subscription.
    publishes
        Whether it is a publisher.

    """

    def __init__(
        self, node: Any, topic: str, profile: QoSProfile, *, publishes: bool = False
    ) -> None:
        self._node = node
        self._topic = topic
        self._profile = as_discovered(profile)
        self._publishes = publishes
        self._told: set[bytes] = set()
        self._is_due = False

    def on_event(self, _: Any) -> None:
        """
        Record a mismatch reported by the middleware, for the next `check`.

        Parameters
        ----------
        _
            The event of rclpy; unused, since it does not identify the other node.

        """
        self._is_due = True

    def check(self) -> None:
        """Report the nodes of a mismatch as soon as they are known."""
        if not self._is_due:
            return
        reasons = [(info, self._reason(info)) for info in self._others()]
        # A node with several endpoints is reached through a compatible one.
        reached = {_full_name(info) for info, reason in reasons if not reason}
        for info, reason in reasons:
            is_apart = reason and _full_name(info) not in reached
            if is_apart and bytes(info.endpoint_gid) not in self._told:
                self._told.add(bytes(info.endpoint_gid))
                self._is_due = False
                print(self._text(info, reason), file=sys.stderr)

    def _others(self) -> list[Any]:
        from ros2cli.graph.endpoint_info import UNKNOWN_NODE

        graph = self._node.watch.updated()
        find = (
            graph.get_subscriptions_info_by_topic
            if self._publishes
            else graph.get_publishers_info_by_topic
        )
        return [info for info in find(self._topic) if info.node_name != UNKNOWN_NODE.name]

    def _reason(self, info: Any) -> str:
        pair = (self._profile, info.qos_profile)
        status, reason = qos_check_compatible(*(pair if self._publishes else reversed(pair)))
        if status != QoSCompatibility.ERROR:
            return ''
        return '; '.join(str(reason).replace('ERROR: ', '').strip(' ;').split(';'))

    def _text(self, info: Any, reason: str) -> str:
        ends = [f"'/{self._node.get_name()}'", f"'{_full_name(info)}'"]
        publisher, subscriber = ends if self._publishes else reversed(ends)
        cure = 'Change the --qos options' + (
            '.' if self._publishes else ', or leave them away to follow the publisher.'
        )
        return (
            f'WARNING: no message passes from {publisher} to {subscriber} on '
            f"'{self._topic}': {reason}. {cure}"
        )


def _full_name(info: Any) -> str:
    return f'{info.node_namespace.rstrip("/")}/{info.node_name}'


def as_discovered(profile: QoSProfile) -> QoSProfile:
    """
    Complete a QoS profile to the form that other nodes discover.

    Parameters
    ----------
    profile
        The profile of a publisher or subscription; it is not changed.

    Returns
    -------
    QoSProfile
        A copy: unset durations become infinite, and the system default liveliness automatic.

    """
    seen = copy_profile(profile)
    for name in DURATIONS:
        if getattr(seen, name) == Duration():
            setattr(seen, name, Infinite)
    if seen.liveliness == LivelinessPolicy.SYSTEM_DEFAULT:
        seen.liveliness = LivelinessPolicy.AUTOMATIC
    return seen
