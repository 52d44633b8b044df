# SPDX-License-Identifier: Apache-2.0
"""
Options of several verbs: for the output of messages, their selection and the quality of service.

Importing this imports neither rclpy nor the compiler of filters.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import Any

from ros2cli.arguments import positive_int, positive_number, whole_number

DEFAULT_TRUNCATE_LENGTH = 128
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


def add_echo_arguments(parser: argparse.ArgumentParser) -> None:
    """
    Add the options for the output format, the selection of messages and the end.

    Parameters
    ----------
    parser
        The parser of the verb.

    """
    add_form_arguments(parser)
    _add_selection(parser)
    _add_limits(parser)


def add_form_arguments(parser: argparse.ArgumentParser) -> None:
    """
    Add the options for the output format: YAML or CSV, and limits for arrays and strings.

    Parameters
    ----------
    parser
        The parser of the verb.

    """
    add = parser.add_argument
    add(
        '--csv',
        action='store_true',
        help='Output all recursive fields separated by commas (e.g. for plotting)',
    )
    add(
        '-f',
        '--full-length',
        action='store_true',
        help='Output all elements for arrays, bytes, and strings',
    )
    add(
        '-l',
        '--truncate-length',
        metavar='N',
        type=whole_number,
        default=DEFAULT_TRUNCATE_LENGTH,
        help='The length to truncate arrays, bytes, and strings to (default: %(default)s)',
    )
    add('--no-arr', action='store_true', help="Don't print array fields of messages")
    add('--no-str', action='store_true', help="Don't print string fields of messages")
    add(
        '--flow-style',
        action='store_true',
        help='Print collections in the flow style, on one line',
    )


def _add_selection(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add('--field', help='Echo a selected field of a message, e.g. "pose.position"')
    add_filter_argument(parser, 'echo')
    add('--raw', action='store_true', help='Echo the raw binary representation')
    add(
        '-i',
        '--include-message-info',
        action='store_true',
        help='Shows the associated message info',
    )


def _add_limits(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add('--no-lost-messages', action='store_true', help="Don't report when a message is lost")
    add('--once', action='store_true', help='Print the first message received and then exit')
    add('--timeout', metavar='SECONDS', type=positive_number, help='Stop after this time')


def add_filter_argument(parser: argparse.ArgumentParser, what: str) -> None:
    """
    Add the option `--filter`, a condition that messages must meet.

    Parameters
    ----------
    parser
        The parser of the verb.
    what
        The action of the verb on the messages, for the help, such as `echo`.

    """
    parser.add_argument(
        '--filter',
        type=_message_filter,
        metavar='EXPR',
        help=f'Only {what} messages for which an expression is true. The message is `m`, for '
        'example "m.data > 1 and len(m.name) == 2"',
    )


def _message_filter(text: str) -> Callable[[Any], bool]:
    from ros2topic.api.filtering import MessageFilter

    return MessageFilter(text)


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
            f'{text} seconds is too long: at most {LONGEST_LEASE_S:.0f}'
        )
    return duration_s
