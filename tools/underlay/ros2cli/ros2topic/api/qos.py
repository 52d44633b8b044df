# SPDX-License-Identifier: Apache-2.0
"""Selection of a QoS profile compatible with the publishers of a topic."""

from __future__ import annotations

import argparse
from typing import Any

from rclpy.duration import Duration
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    LivelinessPolicy,
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
