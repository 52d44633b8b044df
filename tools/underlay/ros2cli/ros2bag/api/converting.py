# SPDX-License-Identifier: Apache-2.0
"""
Write bags anew: merged, filtered, cut, split or compressed; this does not import rclpy.

A YAML file describes the bags to write, with the names that rosbag2 gives to its options.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import takewhile
import os
import re
from typing import Any

from ros2bag.api.common_arguments import TopicFilter
from ros2bag.api.record_arguments import PRESETS
from ros2bag.api.storage_config import read_storage_config
from ros2bag.storage import BagError
from ros2bag.storage.bag_writer import BagWriter, WriterOptions
from ros2bag.storage.bags import Bags
from ros2bag.storage.definitions import Definition
from ros2bag.storage.latched import RecordedMessage
from ros2cli.names import absolute
from ros_environment.suggestions import did_you_mean
import yaml

__all__ = ['Output', 'convert', 'read_inputs', 'read_outputs']

NS_PER_S = 1_000_000_000
FOR_EVER_NS = 2**63 - 1
IGNORED = (
    'compression_queue_size',
    'compression_threads',
    'compression_threads_priority',
    'include_unpublished_topics',
    'max_cache_size',
)
"""Entries that change nothing in the bag."""
DEFAULTS: dict[str, Any] = {
    'uri': '',
    'storage_id': 'mcap',
    'max_bagfile_size': 0,
    'max_bagfile_duration': 0,
    'storage_preset_profile': 'none',
    'storage_config_uri': '',
    'all': False,
    'all_topics': False,
    'topics': [],
    'topic_types': [],
    'all_services': False,
    'services': [],
    'regex': '',
    'exclude': '',
    'exclude_regex': '',
    'exclude_topics': [],
    'exclude_topic_types': [],
    'exclude_services': [],
    'include_hidden_topics': False,
    'rmw_serialization_format': 'cdr',
    'input_serialization_format': 'cdr',
    'output_serialization_format': 'cdr',
    'compression_mode': 'none',
    'compression_format': '',
    'start_time_ns': -1,
    'end_time_ns': -1,
    'custom_data': {},
}
CHOICES = {
    'storage_id': ('mcap',),
    'storage_preset_profile': tuple(PRESETS),
    'rmw_serialization_format': ('cdr',),
    'input_serialization_format': ('cdr',),
    'output_serialization_format': ('cdr',),
    'compression_mode': ('none', 'file', 'message'),
    'compression_format': ('', 'zstd', 'lz4'),
}


@dataclass(frozen=True)
class Output:
    """A bag to write: its folder, its topics, its time span and how it is stored."""

    folder: str
    topics: TopicFilter
    start_ns: int
    end_ns: int
    options: WriterOptions


def read_inputs(path: str) -> list[str]:
    """
    Read the paths of the bags to read from a YAML file.

    Parameters
    ----------
    path
        The file, whose `input_bags` have a `uri` each.

    Raises
    ------
    BagError
        The file cannot be read or is malformed.

    """
    return [
        str(_checked(entry, path, {'uri', 'storage_id'})['uri'])
        for entry in _entries(path, 'input_bags')
    ]


def read_outputs(path: str) -> list[Output]:
    """
    Read the descriptions of the bags to write from a YAML file.

    Parameters
    ----------
    path
        The file, whose `output_bags` have a `uri` each, and a choice of topics.

    Raises
    ------
    BagError
        The file cannot be read or is malformed.

    """
    return [_output(entry, path) for entry in _entries(path, 'output_bags')]


def convert(
    bags: Bags, outputs: Sequence[Output], find_definition: Callable[[str], Definition]
) -> Iterator[tuple[str, int]]:
    """
    Write bags with messages of others.

    Parameters
    ----------
    bags
        The bags to read.
    outputs
        The bags to write.
    find_definition
        Returns the definition of an installed type, for types whose definition is not recorded.

    Yields
    ------
    tuple of str and int
        The folder of a bag that is complete, and the number of its messages.

    Raises
    ------
    BagError
        A bag cannot be read or written.

    """
    for output in outputs:
        topics = [
            each.topic
            for each in bags.metadata.topics
            if output.topics.wants(each.topic.name, each.topic.type_name)
        ]
        writer = BagWriter(
            output.folder,
            output.options,
            lambda name: _known(bags.definition(name)) or find_definition(name),
        )
        try:
            for topic in topics:
                writer.set_topic(topic)
            for message in _messages(bags, [topic.name for topic in topics], output):
                writer.write(message)
        finally:
            writer.close()
        yield output.folder, writer.message_count


def _known(definition: Definition) -> Definition | None:
    return definition if definition.text else None


def _messages(bags: Bags, names: list[str], output: Output) -> Iterator[RecordedMessage]:
    if not names:  # the reader would take no names for all topics
        return iter(())
    messages = bags.messages(names, output.start_ns)
    return takewhile(lambda message: message.log_ns <= output.end_ns, messages)


def _entries(path: str, key: str) -> list[Any]:
    try:
        with open(path, encoding='utf-8') as stream:
            content = yaml.safe_load(stream)
    except (OSError, ValueError, yaml.YAMLError) as error:
        raise BagError(f"'{path}' cannot be read: {error}") from error
    entries = content.get(key) if isinstance(content, dict) else None
    if not isinstance(entries, list) or not entries:
        raise BagError(
            f"'{path}' has no list '{key}', as in:\n{key}:\n- uri: FOLDER\n  storage_id: mcap"
        )
    return entries


def _checked(entry: Any, path: str, known: set[str]) -> dict[str, Any]:
    """Return an entry with its defaults; raise BagError for what it may not have."""
    if not isinstance(entry, dict) or not entry.get('uri'):
        raise BagError(f"'{path}': each bag needs a 'uri', which is its folder")
    for name, value in entry.items():
        if name in IGNORED:
            continue
        if name not in known:
            hint = did_you_mean(str(name), known)
            raise BagError(f"'{path}': there is no option '{name}'. {hint}".rstrip())
        _check_value(path, name, value)
    given = {
        name: value
        for name, value in entry.items()
        if value is not None and not (value == '' and DEFAULTS.get(name))
    }
    return {**DEFAULTS, **given}


def _check_value(path: str, name: str, value: Any) -> None:
    default = DEFAULTS[name]
    number = isinstance(default, int) and not isinstance(default, bool)
    kinds = (int, float) if number else (type(default),)
    fits = isinstance(value, kinds) and not (number and isinstance(value, bool))
    if value is not None and not fits:
        raise BagError(f"'{path}': {name} cannot be {value!r}")
    choices = CHOICES.get(name)
    if choices and value not in (None, '', *choices):
        raise BagError(f"'{path}': {name} cannot be '{value}', only {', '.join(choices)}")


def _output(entry: Any, path: str) -> Output:
    values = _checked(entry, path, set(DEFAULTS))
    every = values['all']
    return Output(
        folder=values['uri'],
        topics=TopicFilter(
            everything=every or values['all_topics'],
            topics=_names(values['topics'], 'topic'),
            types=frozenset(values['topic_types']),
            regex=_regex(path, values['regex']),
            excluded_topics=_names(values['exclude_topics'], 'topic'),
            excluded_types=frozenset(values['exclude_topic_types']),
            excluded_regex=_regex(path, values['exclude_regex'] or values['exclude']),
            include_hidden=values['include_hidden_topics'],
            all_services=every or values['all_services'],
            services=_names(values['services'], 'service'),
            excluded_services=_names(values['exclude_services'], 'service'),
        ),
        start_ns=max(0, values['start_time_ns']),
        end_ns=values['end_time_ns'] if values['end_time_ns'] >= 0 else FOR_EVER_NS,
        options=_writer_options(values, path),
    )


def _writer_options(values: Mapping[str, Any], path: str) -> WriterOptions:
    compression = PRESETS[values['storage_preset_profile']]
    if values['compression_mode'] != 'none':
        if not values['compression_format']:
            raise BagError(
                f"'{path}': compression_mode needs a compression_format as well: zstd or lz4"
            )
        compression = values['compression_format']
    storage: dict[str, Any] = {'compression': compression}
    storage |= read_storage_config(values['storage_config_uri'])
    return WriterOptions(
        **storage,
        max_bytes=int(values['max_bagfile_size']),
        max_duration_ns=int(values['max_bagfile_duration'] * NS_PER_S),
        ros_distro=os.environ.get('ROS_DISTRO', WriterOptions.ros_distro),
        custom_data={str(key): str(value) for key, value in values['custom_data'].items()},
    )


def _names(names: list[Any], kind: str) -> frozenset[str]:
    return frozenset(absolute(str(name), kind) for name in names)


def _regex(path: str, text: str) -> re.Pattern[str] | None:
    try:
        return re.compile(text) if text else None
    except re.error as error:
        raise BagError(f"'{path}': {text!r} is not a regular expression: {error}") from error
