# SPDX-License-Identifier: Apache-2.0
"""Options of `ros2 bag play` and `burst`; importing this does not import rclpy."""

from __future__ import annotations

import argparse

from ros2bag.api.common_arguments import (
    count,
    not_negative,
    Refused,
    regular_expression,
    TopicFilter,
)
from ros2cli.arguments import positive_number
from ros2cli.names import absolute

__all__ = [
    'AS_FAST_AS_POSSIBLE',
    'add_bag_argument',
    'add_choice_arguments',
    'add_play_arguments',
    'add_span_arguments',
    'filter_of',
    'remaps',
]

CLOCK_HZ = 40.0
SERVICES = 'only topics are played, not services'
AS_FAST_AS_POSSIBLE = {
    'rate': float('inf'),
    'loop': False,
    'clock': None,
    'delay': 0.0,
    'start_paused': False,
    'disable_keyboard_controls': True,
}


def add_bag_argument(parser: argparse.ArgumentParser) -> None:
    """
    Add the arguments for the bag to read.

    Parameters
    ----------
    parser
        The parser of the verb.

    """
    parser.add_argument('bag_path', help='the folder of the bag, or one of its files')
    parser.add_argument(
        '-s', '--storage', choices=['mcap'], default='mcap', help='format of the files'
    )


def add_choice_arguments(parser: argparse.ArgumentParser) -> None:
    """
    Add the options for which topics to publish, under which names and with which QoS.

    Parameters
    ----------
    parser
        The parser of the verb.

    """
    parser.add_argument(
        '--topics', nargs='+', default=[], metavar='TOPIC', help='publish only these topics'
    )
    parser.add_argument(
        '-e',
        '--regex',
        type=regular_expression,
        help='publish only topics in whose names this regular expression is found',
    )
    parser.add_argument(
        '-x',
        '--exclude-regex',
        metavar='REGEX',
        type=regular_expression,
        help='leave out the topics in whose names this regular expression is found',
    )
    parser.add_argument(
        '--exclude-topics', nargs='+', default=[], metavar='TOPIC', help='leave out these topics'
    )
    parser.add_argument(
        '-m',
        '--remap',
        nargs='+',
        default=[],
        type=_pair_of_names,
        metavar='OLD:=NEW',
        help='publish topics under other names',
    )
    parser.add_argument(
        '--qos-profile-overrides-path',
        metavar='FILE',
        help='a YAML file with the quality of service of publishers, by topic',
    )
    parser.add_argument(
        '--wait-for-all-acked',
        type=not_negative,
        metavar='MS',
        help='at the end, wait up to this long until all subscribers have received everything; '
        '0 waits forever (default: 1000)',
        default=1000,
    )


def add_play_arguments(parser: argparse.ArgumentParser) -> None:
    """
    Add the options for the timing of playback, and for its control.

    Parameters
    ----------
    parser
        The parser of the verb.

    """
    parser.add_argument(
        '-r',
        '--rate',
        type=positive_number,
        default=1.0,
        help='how many times as fast as recorded (default: %(default)s)',
    )
    parser.add_argument('-l', '--loop', action='store_true', help='start again at the end')
    parser.add_argument(
        '--clock',
        nargs='?',
        type=positive_number,
        const=CLOCK_HZ,
        metavar='HZ',
        help=f'publish the recorded time on /clock, {CLOCK_HZ:g} times a second if not given',
    )
    parser.add_argument(
        '-d',
        '--delay',
        type=not_negative,
        default=0.0,
        metavar='SECONDS',
        help='wait before the first message',
    )
    parser.add_argument(
        '-p',
        '--start-paused',
        action='store_true',
        help='publish nothing until SPACE is pressed or the service ~/resume called',
    )
    parser.add_argument(
        '--disable-keyboard-controls',
        action='store_true',
        help='do not listen to SPACE (pause), RIGHT (next message), UP and DOWN (rate)',
    )
    parser.add_argument(
        '--read-ahead-queue-size',
        type=count,
        default=0,
        metavar='N',
        help='accepted for scripts: messages are read when they are needed',
    )
    for name in ('--services', '--exclude-services', '--publish-service-requests'):
        parser.add_argument(name, action=Refused, reason=SERVICES)
    parser.set_defaults(num_messages=None)


def add_span_arguments(parser: argparse.ArgumentParser) -> None:
    """
    Add the options for which time span of the bag to publish.

    Parameters
    ----------
    parser
        The parser of the verb.

    """
    parser.add_argument(
        '--start-offset',
        type=not_negative,
        default=0.0,
        metavar='SECONDS',
        help='skip this much of the beginning',
    )
    parser.add_argument(
        '--playback-duration',
        type=float,
        default=-1.0,
        metavar='SECONDS',
        help='stop after this much recorded time; negative for no limit (default: no limit)',
    )


def filter_of(args: argparse.Namespace) -> TopicFilter:
    """
    Build the topic filter for playback; by default it passes all topics.

    Parameters
    ----------
    args : argparse.Namespace
        The options of `add_choice_arguments`.

    Raises
    ------
    RuntimeError
        A given topic name is not valid.

    """
    return TopicFilter(
        everything=not args.topics and args.regex is None,
        topics=frozenset(absolute(name) for name in args.topics),
        regex=args.regex,
        excluded_topics=frozenset(absolute(name) for name in args.exclude_topics),
        excluded_regex=args.exclude_regex,
    )


def remaps(args: argparse.Namespace) -> dict[str, str]:
    """
    Return the new names of remapped topics by their recorded names.

    Parameters
    ----------
    args : argparse.Namespace
        The options of `add_choice_arguments`.

    Raises
    ------
    RuntimeError
        One of the names is not valid.

    """
    return {absolute(old): absolute(new) for old, new in args.remap}


def _pair_of_names(text: str) -> tuple[str, str]:
    old, separator, new = text.partition(':=')
    if not (old and separator and new):
        raise argparse.ArgumentTypeError(f'{text!r} is not of the form OLD:=NEW')
    return old, new
