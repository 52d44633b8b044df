# SPDX-License-Identifier: Apache-2.0
"""Options of `ros2 bag record`; importing this does not import rclpy."""

from __future__ import annotations

import argparse
from datetime import datetime

from ros2bag.api.common_arguments import (
    add_log_level_argument,
    count,
    not_negative,
    Refused,
    TopicFilter,
)
from ros2cli.arguments import positive_number, regular_expression
from ros2cli.names import absolute

__all__ = ['add_record_arguments', 'compression_of', 'filter_of', 'output_folder', 'usage_error']

PRESETS = {'none': 'none', 'fastwrite': 'none', 'zstd_fast': 'zstd', 'zstd_small': 'zstd'}
EPILOG = """\
Ctrl-C, SIGTERM and SIGHUP end the recording, with status 0 if the bag is
complete. After kill -9 or a loss of power, "ros2 bag recover" saves all but
the last 0.2 seconds."""
ACTIONS = 'actions cannot be recorded in ROS 2 Jazzy, but their hidden topics can, by name'
SNAPSHOT_BYTES = 100 * 1024 * 1024
SCRIPTS = 'accepted for scripts: chunks are compressed when they are written'


def add_record_arguments(parser: argparse.ArgumentParser) -> None:
    """
    Add the choice of topics, the output and the recording options.

    Parameters
    ----------
    parser
        The parser of the verb; its epilog is set as well.

    """
    _add_choice(parser)
    _add_output(parser)
    _add_compression(parser)
    _add_behaviour(parser)
    _add_refused(parser)
    parser.epilog = EPILOG


def _add_choice(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group('what to record')
    group.add_argument(
        'topics_positional', nargs='*', metavar='topic', help='a topic to record, as with --topics'
    )
    group.add_argument('-a', '--all', action='store_true', help='record all topics and services')
    group.add_argument('--all-topics', action='store_true', help='record all topics')
    group.add_argument(
        '--all-services',
        action='store_true',
        help='record all services whose introspection is on, by the topics of their events',
    )
    group.add_argument(
        '--topics', nargs='+', default=[], metavar='TOPIC', help='record these topics'
    )
    group.add_argument(
        '--services', nargs='+', default=[], metavar='SERVICE', help='record these services'
    )
    group.add_argument(
        '--topic-types', nargs='+', default=[], metavar='TYPE', help='record topics of these types'
    )
    group.add_argument(
        '-e',
        '--regex',
        type=regular_expression,
        help='record the topics and services in whose names this regular expression is found',
    )
    group.add_argument(
        '-x',
        '--exclude-regex',
        '--exclude',
        metavar='REGEX',
        type=regular_expression,
        help='leave out the topics and services in whose names this regular expression is found',
    )
    group.add_argument(
        '--exclude-topics', nargs='+', default=[], metavar='TOPIC', help='leave out these topics'
    )
    group.add_argument(
        '--exclude-services',
        nargs='+',
        default=[],
        metavar='SERVICE',
        help='leave out these services',
    )
    group.add_argument(
        '--exclude-topic-types',
        nargs='+',
        default=[],
        metavar='TYPE',
        help='leave out topics of these types',
    )
    group.add_argument(
        '--include-hidden-topics', action='store_true', help='consider hidden topics as well'
    )
    group.add_argument(
        '--include-unpublished-topics',
        action='store_true',
        help='include topics without publishers in the list of recorded topics',
    )
    group.add_argument(
        '--ignore-leaf-topics',
        action='store_true',
        help='leave out topics that nobody else subscribes to, until somebody does',
    )


def _add_output(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group('output')
    group.add_argument(
        '-o',
        '--output',
        help='the folder to create for the bag (default: rosbag2_ with the date and time)',
    )
    group.add_argument(
        '-s', '--storage', choices=['mcap'], default='mcap', help='format of the files'
    )
    group.add_argument(
        '-f',
        '--serialization-format',
        choices=['cdr'],
        default='cdr',
        help='format of the messages: as they are sent',
    )
    group.add_argument(
        '--storage-config-file',
        metavar='FILE',
        help='a YAML file with settings of the MCAP files: compression (None, Lz4, Zstd) and '
        'chunkSize in bytes; they override the other options',
    )
    group.add_argument(
        '-b',
        '--max-bag-size',
        type=count,
        default=0,
        metavar='BYTES',
        help='start a new file when one has this size (default: no limit)',
    )
    group.add_argument(
        '-d',
        '--max-bag-duration',
        type=not_negative,
        default=0,
        metavar='SECONDS',
        help='start a new file after this time; each has the latched messages. It also bounds the '
        'memory of the index, which grows by some 30 MB an hour (default: no limit)',
    )
    group.add_argument(
        '--custom-data',
        nargs='+',
        default=[],
        type=_key_and_value,
        metavar='KEY=VALUE',
        help='entries to store in metadata.yaml',
    )


def _add_compression(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group('compression, of the chunks inside the MCAP files')
    group.add_argument(
        '--compression-mode',
        choices=['none', 'file', 'message'],
        default=None,
        help='none, or one of the other two, which are equivalent here',
    )
    group.add_argument(
        '--compression-format', choices=['zstd', 'lz4'], help='how chunks are compressed'
    )
    group.add_argument(
        '--storage-preset-profile',
        metavar='PROFILE',
        choices=sorted(PRESETS),
        default='none',
        help='another way to choose the compression: %(choices)s',
    )
    for name in ('--compression-queue-size', '--compression-threads'):
        group.add_argument(name, type=count, default=0, metavar='N', help=SCRIPTS)
    group.add_argument(
        '--compression-threads-priority', type=int, default=0, metavar='N', help=SCRIPTS
    )


def _add_behaviour(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group('behaviour')
    group.add_argument(
        '--use-sim-time', action='store_true', help='record with the time of the topic /clock'
    )
    group.add_argument(
        '--start-paused',
        action='store_true',
        help='record nothing until SPACE is pressed or the service ~/resume called',
    )
    group.add_argument(
        '--no-discovery', action='store_true', help='only topics that exist at the start'
    )
    group.add_argument(
        '-p',
        '--polling-interval',
        type=positive_number,
        default=100,
        metavar='MS',
        help='time between searches for new topics, in milliseconds (default: %(default)s)',
    )
    group.add_argument(
        '--qos-profile-overrides-path',
        metavar='FILE',
        help='a YAML file with the quality of service of subscriptions, by topic',
    )
    group.add_argument(
        '--node-name', default='rosbag2_recorder', help='name of the node (default: %(default)s)'
    )
    group.add_argument(
        '--disable-keyboard-controls', action='store_true', help='do not listen to SPACE'
    )
    group.add_argument(
        '--max-cache-size',
        type=count,
        default=SNAPSHOT_BYTES,
        metavar='BYTES',
        help='how much is kept in snapshot mode (default: %(default)s). Otherwise there is no '
        'cache: messages are on the disk after 0.1 s',
    )
    group.add_argument(
        '--snapshot-mode',
        action='store_true',
        help='record nothing until the service ~/snapshot is called, which writes the last '
        'messages',
    )
    add_log_level_argument(group)
    group.add_argument('-q', '--quiet', action='store_true', help='print warnings only')


def _add_refused(parser: argparse.ArgumentParser) -> None:
    """Add the unsupported rosbag2 options, which are rejected with a reason."""
    for name in ('--all-actions', '--actions', '--exclude-actions'):
        parser.add_argument(name, action=Refused, reason=ACTIONS)


def filter_of(args: argparse.Namespace) -> TopicFilter:
    """
    Build the topic filter for recording.

    Parameters
    ----------
    args : argparse.Namespace
        The options of `add_record_arguments`.

    Raises
    ------
    RuntimeError
        A given topic name is not valid.

    """
    return TopicFilter(
        everything=args.all or args.all_topics,
        topics=frozenset(absolute(name) for name in [*args.topics, *args.topics_positional]),
        types=frozenset(args.topic_types),
        regex=args.regex,
        excluded_topics=frozenset(absolute(name) for name in args.exclude_topics),
        excluded_types=frozenset(args.exclude_topic_types),
        excluded_regex=args.exclude_regex,
        include_hidden=args.include_hidden_topics,
        all_services=args.all or args.all_services,
        services=frozenset(absolute(name, 'service') for name in args.services),
        excluded_services=frozenset(absolute(name, 'service') for name in args.exclude_services),
    )


def usage_error(args: argparse.Namespace) -> str:
    """
    Check the options for contradictions and omissions.

    Parameters
    ----------
    args : argparse.Namespace
        The options of `add_record_arguments`.

    Returns
    -------
    str
        The error message, or ''.

    """
    topics = [args.topics_positional, args.topics, args.topic_types, args.regex]
    services = [args.services, args.regex]
    if (args.all or args.all_topics) and any(topics):
        return 'Name topics, types or a regular expression, or all topics with -a, but not both.'
    if (args.all or args.all_services) and any(services):
        return 'Name services or a regular expression, or all services, but not both.'
    if not any((args.all, args.all_topics, args.all_services, *topics, *services)):
        return 'Nothing to record: name topics after --topics, or record all of them with -a.'
    if args.snapshot_mode and not args.max_cache_size:
        return 'In snapshot mode --max-cache-size has to be above zero: it is what is kept.'
    if args.output == '':
        return 'The name of the output folder is empty: give one after -o, or omit -o.'
    if args.compression_mode in ('file', 'message') and not args.compression_format:
        return 'Choose the compression as well: --compression-format zstd or lz4.'
    return ''


def compression_of(args: argparse.Namespace) -> str:
    """
    Return the compression of MCAP chunks: `none`, `lz4` or `zstd`.

    Parameters
    ----------
    args : argparse.Namespace
        The options of `add_record_arguments`; an explicit format takes precedence over the preset.

    """
    if args.compression_format and args.compression_mode != 'none':
        return str(args.compression_format)
    return PRESETS[args.storage_preset_profile]


def output_folder(args: argparse.Namespace) -> str:
    """
    Return the output folder; its default name contains the local date and time.

    Parameters
    ----------
    args : argparse.Namespace
        The options of `add_record_arguments`.

    """
    return args.output or datetime.now().strftime('rosbag2_%Y_%m_%d-%H_%M_%S')


def _key_and_value(text: str) -> tuple[str, str]:
    key, separator, value = text.partition('=')
    if not (key and separator):
        raise argparse.ArgumentTypeError(f'{text!r} is not of the form KEY=VALUE')
    return key, value
