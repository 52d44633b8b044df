# SPDX-License-Identifier: Apache-2.0
"""Options of `ros2 bag play` and `burst`; importing this does not import rclpy."""

from __future__ import annotations

import argparse
from typing import Any

from ros2bag.api.common_arguments import (
    add_log_level_argument,
    count,
    not_negative,
    TopicFilter,
)
from ros2bag.storage import BagError
from ros2cli.arguments import positive_number, regular_expression
from ros2cli.names import absolute

__all__ = [
    'AS_FAST_AS_POSSIBLE',
    'add_bag_argument',
    'add_bags_arguments',
    'add_choice_arguments',
    'add_input_argument',
    'add_play_arguments',
    'add_span_arguments',
    'bag_paths',
    'end_of_playback_ns',
    'filter_of',
    'publishes_clock',
    'remaps',
    'request_source',
]

CLOCK_HZ = 40.0
FOR_EVER_NS = 2**63 - 1
NS_PER_S = 1_000_000_000
AS_FAST_AS_POSSIBLE: dict[str, Any] = {
    'rate': float('inf'),
    'loop': False,
    'clock': None,
    'clock_topics': [],
    'clock_topics_all': False,
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
    _add_storage_argument(parser)


def add_bags_arguments(parser: argparse.ArgumentParser) -> None:
    """
    Add the arguments for the bags to play.

    Parameters
    ----------
    parser
        The parser of the verb.

    """
    parser.add_argument('bag_path', nargs='?', help='the folder of the bag, or one of its files')
    add_input_argument(parser)
    _add_storage_argument(parser)


def add_input_argument(parser: argparse.ArgumentParser) -> None:
    """
    Add the option for one of several bags.

    Parameters
    ----------
    parser
        The parser of the verb.

    """
    parser.add_argument(
        '-i',
        '--input',
        nargs='+',
        action='append',
        default=[],
        metavar=('BAG', 'STORAGE'),
        help='one of several bags, which are merged by time; the storage is mcap or sqlite3',
    )


def _add_storage_argument(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        '-s',
        '--storage',
        choices=['mcap', 'sqlite3'],
        help='format of the files, which need not be named',
    )


def bag_paths(args: argparse.Namespace) -> list[str]:
    """
    Return the paths of the bags to read.

    Parameters
    ----------
    args : argparse.Namespace
        The options of `add_bags_arguments`, or of `add_bag_argument`.

    Raises
    ------
    BagError
        There is none, there are both kinds, or a storage cannot be read.

    """
    inputs: list[list[str]] = getattr(args, 'input', [])
    path = getattr(args, 'bag_path', None)
    if path is None and not inputs:
        raise BagError('Name a bag: its folder, or several with -i')
    if path is not None and inputs:
        raise BagError(
            f"Name all bags with -i, or a single one without: not '{path}' and -i together"
        )
    for bag, *storage in inputs:
        if storage not in ([], ['mcap'], ['sqlite3']):
            raise BagError(
                f"The storage '{' '.join(storage)}' of '{bag}' is not supported, only mcap and "
                f'sqlite3 are. Convert it first: rosbags-convert --src {bag} --dst {bag}_mcap '
                '--dst-storage mcap. For several bags, repeat -i'
            )
    return [words[0] for words in inputs] or [str(path)]


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
        '--services', nargs='+', default=[], metavar='SERVICE', help='publish only these services'
    )
    parser.add_argument(
        '-e',
        '--regex',
        type=regular_expression,
        help='publish only topics and services in whose names this regular expression is found',
    )
    parser.add_argument(
        '-x',
        '--exclude-regex',
        metavar='REGEX',
        type=regular_expression,
        help='leave out the topics and services in whose names this regular expression is found',
    )
    parser.add_argument(
        '--exclude-topics', nargs='+', default=[], metavar='TOPIC', help='leave out these topics'
    )
    parser.add_argument(
        '--exclude-services',
        nargs='+',
        default=[],
        metavar='SERVICE',
        help='leave out these services',
    )
    parser.add_argument(
        '--publish-service-requests',
        action='store_true',
        help='send the requests of recorded services, instead of publishing their events',
    )
    parser.add_argument(
        '--service-requests-source',
        choices=['service_introspection', 'client_introspection'],
        default='service_introspection',
        metavar='SOURCE',
        help='whose events have the requests, those of the server or of the clients: %(choices)s '
        '(default: %(default)s)',
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
    parser.add_argument(
        '--storage-config-file',
        metavar='FILE',
        help='accepted for scripts: there are no settings for reading MCAP files',
    )
    add_log_level_argument(parser)


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
    clock = parser.add_mutually_exclusive_group()
    clock.add_argument(
        '--clock',
        nargs='?',
        type=positive_number,
        const=CLOCK_HZ,
        metavar='HZ',
        help=f'publish the recorded time on /clock, {CLOCK_HZ:g} times a second if not given',
    )
    clock.add_argument(
        '--clock-topics',
        nargs='+',
        default=[],
        metavar='TOPIC',
        help='publish the recorded time on /clock before each message of these topics',
    )
    clock.add_argument(
        '--clock-topics-all',
        action='store_true',
        help='publish the recorded time on /clock before each message',
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
    parser.add_argument(
        '--disable-loan-message',
        action='store_true',
        help='accepted for scripts: messages are never loaned',
    )
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
        help='stop after this much recorded time; negative for no limit (default: no limit). With '
        '--playback-until-... the later end counts',
    )
    until = parser.add_mutually_exclusive_group()
    until.add_argument(
        '--playback-until-sec',
        type=float,
        default=-1.0,
        metavar='S',
        help='stop at this recorded time, in seconds since 1970; negative for no limit',
    )
    until.add_argument(
        '--playback-until-nsec',
        type=int,
        default=-1,
        metavar='NS',
        help='the same in nanoseconds',
    )


def end_of_playback_ns(args: argparse.Namespace, start_ns: int) -> int:
    """
    Compute the recorded time after which nothing is played, in ns since the epoch.

    Parameters
    ----------
    args : argparse.Namespace
        The options of `add_span_arguments`.
    start_ns
        The recorded time at the start.

    """
    ends = []
    if args.playback_duration >= 0:
        ends.append(start_ns + int(args.playback_duration * NS_PER_S))
    if args.playback_until_sec >= 0:
        ends.append(int(args.playback_until_sec * NS_PER_S))
    if args.playback_until_nsec >= 0:
        ends.append(args.playback_until_nsec)
    return max(ends, default=FOR_EVER_NS)


def publishes_clock(args: argparse.Namespace) -> bool:
    """
    Whether the recorded time is published.

    Parameters
    ----------
    args : argparse.Namespace
        The options of `add_play_arguments`.

    """
    return bool(args.clock or args.clock_topics or args.clock_topics_all)


def request_source(args: argparse.Namespace) -> str:
    """
    Return whose recorded requests are sent; '' to publish the events of services instead.

    Parameters
    ----------
    args : argparse.Namespace
        The options of `add_choice_arguments`.

    """
    return str(args.service_requests_source) if args.publish_service_requests else ''


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
    everything = not (args.topics or args.services) and args.regex is None
    return TopicFilter(
        everything=everything,
        all_services=everything,
        services=frozenset(absolute(name, 'service') for name in args.services),
        excluded_services=frozenset(absolute(name, 'service') for name in args.exclude_services),
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
