# SPDX-License-Identifier: Apache-2.0
"""The QoS profile of a publisher or subscription, and the nodes that it cannot connect to."""

from __future__ import annotations

import argparse
import sys
from typing import Any

from rclpy.duration import Duration, Infinite
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    LivelinessPolicy,
    qos_check_compatible,
    QoSCompatibility,
    QoSPresetProfiles,
    QoSProfile,
    ReliabilityPolicy,
)

QUEUE_DEPTH = 1000
POLICY_TYPES: dict[str, Any] = {
    'history': HistoryPolicy,
    'reliability': ReliabilityPolicy,
    'durability': DurabilityPolicy,
    'liveliness': LivelinessPolicy,
}
DURATIONS = ('deadline', 'lifespan', 'liveliness_lease_duration')


def choose_qos(args: argparse.Namespace, publishers: list[Any]) -> tuple[QoSProfile, list[str]]:
    """
    Choose the QoS profile of a subscription.

    Parameters
    ----------
    args : argparse.Namespace
        The parsed command line with the options of `add_qos_arguments`.
    publishers
        The endpoint infos of the topic's publishers, which the profile follows if none is chosen.

    Returns
    -------
    tuple of QoSProfile and list of str
        The profile, and notices about policies that only some publishers offer.

    """
    notices: list[str] = []
    if args.qos_profile:
        profile = copy_profile(QoSPresetProfiles.get_from_short_key(args.qos_profile))
    else:
        profile, notices = matching_qos(publishers)
    override(profile, args)
    return profile, notices


def matching_qos(publishers: list[Any]) -> tuple[QoSProfile, list[str]]:
    """
    Find the strongest QoS profile that is compatible with all publishers of a topic.

    It is reliable, or transient local, only if all publishers are.

    Parameters
    ----------
    publishers
        Their endpoint infos, as `get_publishers_info_by_topic` returns them.

    Returns
    -------
    tuple of QoSProfile and list of str
        The profile, and notices about policies that only some publishers offer.

    """
    profile = copy_profile(QoSPresetProfiles.get_from_short_key('sensor_data'))
    profile.depth = QUEUE_DEPTH
    profiles = [info.qos_profile for info in publishers]
    profile.reliability, first = _common(
        [each.reliability for each in profiles],
        ReliabilityPolicy.RELIABLE,
        ReliabilityPolicy.BEST_EFFORT,
    )
    profile.durability, second = _common(
        [each.durability for each in profiles],
        DurabilityPolicy.TRANSIENT_LOCAL,
        DurabilityPolicy.VOLATILE,
    )
    return profile, [notice for notice in (first, second) if notice]


def override(profile: QoSProfile, args: argparse.Namespace) -> None:
    """
    Apply the single QoS policies of the command line to a profile.

    Parameters
    ----------
    profile
        The profile, which is changed in place.
    args : argparse.Namespace
        The parsed command line with the options of `add_qos_arguments`.

    """
    for name, policy_type in POLICY_TYPES.items():
        short_key = getattr(args, f'qos_{name}')
        if short_key:
            setattr(profile, name, policy_type.get_from_short_key(short_key))
    if args.qos_depth is not None:
        profile.depth = args.qos_depth
    lease_s = args.qos_liveliness_lease_duration_seconds
    if lease_s is not None:
        profile.liveliness_lease_duration = Duration(nanoseconds=int(lease_s * 1e9))


def _common(offered: list[Any], strong: Any, weak: Any) -> tuple[Any, str]:
    """Return the stronger policy if all publishers offer it, else the weaker one."""
    count = sum(policy == strong for policy in offered)
    if count == 0 or count == len(offered):
        return (strong if count else weak), ''
    return weak, (
        f'Some, but not all, publishers are offering {_name(strong)}. Falling back to '
        f'{_name(weak)} as it will connect to all publishers'
    )


def _name(policy: Any) -> str:
    return f'{type(policy).__name__}.{policy.name}'


def copy_profile(profile: Any) -> QoSProfile:
    """
    Copy a QoS profile; the presets are shared and must not be changed.

    Parameters
    ----------
    profile
        The profile to copy.

    """
    names = (
        'history',
        'depth',
        'reliability',
        'durability',
        'lifespan',
        'deadline',
        'liveliness',
        'liveliness_lease_duration',
        'avoid_ros_namespace_conventions',
    )
    return QoSProfile(**{name: getattr(profile, name) for name in names})


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
            '.' if self._publishes else ', or omit them to follow the publisher.'
        )
        return (
            f'WARNING: messages from {publisher} do not reach {subscriber} on '
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
