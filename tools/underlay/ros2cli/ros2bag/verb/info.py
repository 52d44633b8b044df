# SPDX-License-Identifier: Apache-2.0
"""The verb `ros2 bag info`, and its output."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from datetime import datetime
import math
import sys
from typing import TYPE_CHECKING

from ros2bag.api.play_arguments import add_bag_argument
from ros2bag.storage.service_events import count_calls, service_of
from ros2bag.verb import VerbExtension

if TYPE_CHECKING:
    from ros2bag.storage.bag_reader import BagReader
    from ros2bag.storage.metadata import BagMetadata, MessageSpan, TopicInformation
    from ros2bag.storage.offered_qos import OfferedQos

COLUMN = 19
NS_PER_S = 1_000_000_000
KIB = 1024.0
UNITS = ('B', 'KiB', 'MiB', 'GiB', 'TiB')


class InfoVerb(VerbExtension):
    """Print information about a bag."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str) -> None:
        """
        Add the bag and the options for details.

        Parameters
        ----------
        parser, cli_name
            As for `VerbExtension.add_arguments`.

        """
        add_bag_argument(parser)
        parser.add_argument(
            '-t', '--topic-name', action='store_true', help='print only the names of the topics'
        )
        parser.add_argument(
            '-v',
            '--verbose',
            action='store_true',
            help='print for each topic its average rate, type hash and quality of service as '
            'well, and for each service how many requests and responses were recorded',
        )

    def main(self, *, args: argparse.Namespace) -> int | str | None:
        """
        Print the metadata of a bag, and warn of files that are missing.

        Parameters
        ----------
        args : argparse.Namespace
            The parsed arguments, as for `VerbExtension.main`.

        """
        from ros2bag.storage.bag_reader import BagReader

        reader = BagReader(args.bag_path)
        for path in reader.missing_paths:
            print(f"WARNING: the file '{path}' of the recording is missing", file=sys.stderr)
        print(
            _topic_names_text(reader)
            if args.topic_name
            else _info_text(reader, verbose=args.verbose)
        )
        return None


def _info_text(reader: BagReader, *, verbose: bool = False) -> str:
    """
    Format the metadata of a bag for the terminal.

    Parameters
    ----------
    reader
        The bag.
    verbose
        Whether to show the average rate, type hash and offered QoS of each topic as well.

    Returns
    -------
    str
        Several lines, without a newline at the end.

    """
    services = _services(reader, verbose)
    rows = [*_rows(reader), ('Topic information', _topics(reader.metadata, verbose))]
    rows += [('Service', [str(len(services))])]
    rows += [('Service information', services)] if services else []
    return '\n'.join(_row(title, lines) for title, lines in rows)


def _topic_names_text(reader: BagReader) -> str:
    """
    Return the names of the topics in a bag, one per line.

    Parameters
    ----------
    reader
        The bag.

    """
    return '\n'.join(each.topic.name for each in _plain_topics(reader.metadata))


def _plain_topics(metadata: BagMetadata) -> list[TopicInformation]:
    """Return the topics without those of services' events."""
    return [
        each for each in metadata.topics if not service_of(each.topic.name, each.topic.type_name)
    ]


def _services(reader: BagReader, verbose: bool) -> list[str]:
    """Format the services whose events were recorded, with their calls if that is wanted."""
    lines = []
    for each in reader.metadata.topics:
        service = service_of(each.topic.name, each.topic.type_name)
        if service is None:
            continue
        calls = ''
        if verbose:
            events = (message.data for message in reader.messages([each.topic.name]))
            requests, responses = count_calls(events)
            calls = f'Request Count: {requests} | Response Count: {responses} | '
        lines.append(
            f'Service: {service.name} | Type: {service.type_name} | '
            f'Event Count: {each.message_count} | {calls}'
            f'Serialization Format: {each.topic.serialization_format}'
        )
    return lines


def human_size(size_bytes: float) -> str:
    """
    Format a size in bytes with a binary unit, such as `1.5 MiB`.

    Parameters
    ----------
    size_bytes
        The size, zero or more.

    """
    if size_bytes < KIB:
        return f'{size_bytes:.0f} B'
    exponent = min(len(UNITS) - 1, int(math.log(size_bytes, KIB)))
    return f'{size_bytes / KIB**exponent:.1f} {UNITS[exponent]}'


def _rows(reader: BagReader) -> Iterator[tuple[str, list[str]]]:
    metadata = reader.metadata
    span = metadata.span
    yield 'Files', [file.path for file in metadata.files]
    yield 'Bag size', [human_size(reader.size_bytes)]
    yield 'Storage id', [metadata.storage_identifier]
    yield 'ROS Distro', [metadata.ros_distro or 'unknown']
    yield 'Duration', [f'{_seconds(span.duration_ns)}s']
    yield 'Start', [_moment(span, span.start_ns)]
    yield 'End', [_moment(span, span.end_ns)]
    yield 'Messages', [str(span.message_count)]
    if metadata.compression_mode not in ('', 'none'):
        yield 'Compression', [f'{metadata.compression_format}, by {metadata.compression_mode}']
    for key, value in metadata.custom_data.items():
        yield 'Custom data', [f'{key}: {value}']


def _row(title: str, lines: list[str]) -> str:
    width = max(COLUMN, len(title) + 2)
    heads = [f'{title}:'.ljust(width), *(' ' * width for _ in lines[1:])]
    return '\n'.join(f'{head}{line}'.rstrip() for head, line in zip(heads, lines or ['']))


def _topics(metadata: BagMetadata, verbose: bool) -> list[str]:
    lines = []
    for each in _plain_topics(metadata):
        lines.append(
            f'Topic: {each.topic.name} | Type: {each.topic.type_name} | '
            f'Count: {each.message_count} | '
            f'Serialization Format: {each.topic.serialization_format}'
        )
        if verbose:
            lines.extend(_details(each, metadata.span))
    return lines


def _details(information: TopicInformation, span: MessageSpan) -> Iterator[str]:
    if span.duration_ns:
        yield f'    Average rate: {information.message_count * NS_PER_S / span.duration_ns:.3g} Hz'
    if information.topic.type_hash:
        yield f'    Type hash: {information.topic.type_hash}'
    for qos in information.topic.offered_qos:
        yield f'    Offered QoS: {_qos(qos)}'


def _qos(qos: OfferedQos) -> str:
    return f'{qos.reliability}, {qos.durability}, {qos.history} (depth {qos.depth})'


def _seconds(duration_ns: int) -> str:
    """Format a duration in seconds to the nanosecond, without trailing zeros."""
    seconds, rest = divmod(duration_ns, NS_PER_S)
    return f'{seconds}.{rest:09d}'.rstrip('0').rstrip('.')


def _moment(span: MessageSpan, time_ns: int) -> str:
    """Format a time as local date and time, and as a ROS time stamp."""
    if not span.message_count:
        return 'none'
    seconds, rest = divmod(time_ns, NS_PER_S)
    local = datetime.fromtimestamp(seconds).strftime('%b %d %Y %H:%M:%S')
    return f'{local}.{rest:09d} ({seconds}.{rest:09d})'
