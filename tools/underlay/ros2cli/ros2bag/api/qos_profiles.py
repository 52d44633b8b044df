# SPDX-License-Identifier: Apache-2.0
"""Conversion of QoS profiles from publishers to the recording and back."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from rclpy.duration import Duration
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    LivelinessPolicy,
    QoSProfile,
    ReliabilityPolicy,
)
from ros2bag.storage import BagError
from ros2bag.storage.metadata import Topic
from ros2bag.storage.offered_qos import INFINITE_NS, OfferedQos
import yaml

__all__ = ['offered_by', 'playback_profile', 'read_overrides']

QUEUE_DEPTH = 100
LATCHED_DEPTH = 10


def offered_by(publishers: Iterable[Any]) -> tuple[OfferedQos, ...]:
    """
    Convert the discovered QoS of publishers to the form that a bag stores.

    Parameters
    ----------
    publishers
        Endpoint infos of rclpy, with a `qos_profile` each.

    Returns
    -------
    tuple of OfferedQos
        One per publisher, in their order.

    """
    return tuple(_offered(info.qos_profile) for info in publishers)


def playback_profile(topic: Topic) -> QoSProfile:
    """
    Choose a QoS profile compatible with every subscription that the recorded publishers match.

    Parameters
    ----------
    topic
        The topic with the QoS that was offered; reliable and volatile if nothing was recorded.

    """
    offered = topic.offered_qos or (OfferedQos(),)
    reliable = any(qos.reliability != 'best_effort' for qos in offered)
    return QoSProfile(
        depth=_latched_depth(offered) if topic.is_latched else QUEUE_DEPTH,
        reliability=ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=(
            DurabilityPolicy.TRANSIENT_LOCAL if topic.is_latched else DurabilityPolicy.VOLATILE
        ),
    )


def read_overrides(path: str | None) -> dict[str, QoSProfile]:
    """
    Read QoS profiles by topic name from a YAML file.

    Parameters
    ----------
    path
        The file, or None for no overrides.

    Returns
    -------
    dict of str to QoSProfile
        Empty without a file.

    Raises
    ------
    BagError
        The file cannot be read or is malformed.

    """
    if path is None:
        return {}
    try:
        with open(path, encoding='utf-8') as stream:
            content = yaml.safe_load(stream) or {}
        return {topic: _profile(OfferedQos.from_dict(each)) for topic, each in content.items()}
    except (OSError, yaml.YAMLError, AttributeError, KeyError, TypeError, ValueError) as error:
        raise BagError(
            f"'{path}' is not a file with the quality of service of topics "
            f'({type(error).__name__}: {error}). Expected format: '
            '{/topic: {reliability: best_effort, history: keep_last, depth: 5}}'
        ) from error


def _latched_depth(offered: Iterable[OfferedQos]) -> int:
    """Return the total depth of latched publishers; discovery often does not transmit it."""
    return sum(qos.depth or LATCHED_DEPTH for qos in offered if qos.is_latched)


def _offered(profile: Any) -> OfferedQos:
    return OfferedQos(
        history=profile.history.name.lower(),
        depth=profile.depth,
        reliability=profile.reliability.name.lower(),
        durability=profile.durability.name.lower(),
        deadline_ns=profile.deadline.nanoseconds,
        lifespan_ns=profile.lifespan.nanoseconds,
        liveliness=profile.liveliness.name.lower(),
        liveliness_lease_duration_ns=profile.liveliness_lease_duration.nanoseconds,
        avoid_ros_namespace_conventions=profile.avoid_ros_namespace_conventions,
    )


def _profile(qos: OfferedQos) -> QoSProfile:
    history = 'keep_last' if qos.history == 'unknown' else qos.history
    profile = QoSProfile(
        depth=qos.depth or QUEUE_DEPTH,
        history=HistoryPolicy[history.upper()],
        reliability=ReliabilityPolicy[qos.reliability.upper()],
        durability=DurabilityPolicy[qos.durability.upper()],
        liveliness=LivelinessPolicy[qos.liveliness.upper()],
    )
    for name in ('deadline', 'lifespan', 'liveliness_lease_duration'):
        duration_ns = getattr(qos, f'{name}_ns')
        if duration_ns != INFINITE_NS:
            setattr(profile, name, Duration(nanoseconds=duration_ns))
    return profile
