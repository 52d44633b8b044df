# SPDX-License-Identifier: Apache-2.0
"""Options for the quality of service; importing this does not import rclpy."""

from __future__ import annotations

import argparse

from ros2cli.argument_types import positive_int, positive_number

PROFILES = (
    'default',
    'system_default',
    'sensor_data',
    'services_default',
    'parameters',
    'parameter_events',
    'action_status_default',
    'best_available',
)
POLICIES = {
    'history': ('system_default', 'keep_last', 'keep_all'),
    'reliability': ('system_default', 'reliable', 'best_effort', 'best_available'),
    'durability': ('system_default', 'transient_local', 'volatile', 'best_available'),
    'liveliness': ('system_default', 'automatic', 'manual_by_topic', 'best_available'),
}
LARGEST_DEPTH = 1_000_000
LONGEST_LEASE_S = 1e9


def add_qos_arguments(parser: argparse.ArgumentParser, role: str) -> None:
    """
    Add the options for the QoS preset profile and for its single policies.

    Parameters
    ----------
    parser
        The parser of the verb.
    role
        The owner of the profile, for the help: `publisher` or `subscription`.

    """
    by_default = 'is `default`' if role == 'publisher' else 'follows the other side'
    parser.add_argument(
        '--qos-profile',
        metavar='PROFILE',
        choices=PROFILES,
        help=f'Quality of service preset profile of the {role}: %(choices)s; by default it '
        f'{by_default}',
    )
    parser.add_argument(
        '--qos-depth', metavar='N', type=_queue_depth, help=f'Queue size setting of the {role}'
    )
    for policy, choices in POLICIES.items():
        parser.add_argument(
            f'--qos-{policy}',
            metavar='POLICY',
            choices=choices,
            help=f'Quality of service {policy} setting of the {role}: %(choices)s',
        )
    parser.add_argument(
        '--qos-liveliness-lease-duration-seconds',
        metavar='SECONDS',
        type=_lease_duration,
        help=f'Quality of service liveliness lease duration setting of the {role}',
    )


def _queue_depth(text: str) -> int:
    depth = positive_int(text)
    if depth > LARGEST_DEPTH:
        raise argparse.ArgumentTypeError(
            f'a queue of {text} messages is too long: at most {LARGEST_DEPTH}'
        )
    return depth


def _lease_duration(text: str) -> float:
    duration_s = positive_number(text)
    if duration_s > LONGEST_LEASE_S:
        raise argparse.ArgumentTypeError(
            f'{text} seconds are too long: at most {LONGEST_LEASE_S:.0f}'
        )
    return duration_s
