# SPDX-License-Identifier: Apache-2.0
"""What the options of record and play share: topic selection, numbers, unsupported options."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import dataclass, field
import re
from typing import Any

from ros2bag.storage.service_events import event_topic, Service, service_of
from ros2cli.names import is_hidden

__all__ = [
    'Refused',
    'TopicFilter',
    'add_log_level_argument',
    'count',
    'not_negative',
]

LOG_LEVELS = ('debug', 'info', 'warn', 'error', 'fatal')


@dataclass(frozen=True)
class TopicFilter:
    """Filter of topics and services: the requested ones minus the excluded ones."""

    everything: bool = False
    topics: frozenset[str] = frozenset()
    types: frozenset[str] = frozenset()
    regex: re.Pattern[str] | None = None
    excluded_topics: frozenset[str] = frozenset()
    excluded_types: frozenset[str] = frozenset()
    excluded_regex: re.Pattern[str] | None = None
    include_hidden: bool = field(default=True)
    all_services: bool = False
    services: frozenset[str] = frozenset()
    excluded_services: frozenset[str] = frozenset()

    @property
    def named(self) -> frozenset[str]:
        """Return the topics that are requested by name, including those of services' events."""
        return self.topics | {event_topic(service) for service in self.services}

    def wants(self, name: str, type_name: str) -> bool:
        """
        Whether a topic is selected; one given by name is selected even if it is hidden.

        The topic with the events of a service is selected as the service is.

        Parameters
        ----------
        name
            The full name of the topic.
        type_name
            Its type, such as `std_msgs/msg/String`.

        """
        if self._is_excluded(name, type_name):
            return False
        if name in self.topics:
            return True
        service = service_of(name, type_name)
        if service is not None:
            return self._wants_service(service)
        if is_hidden(name) and not self.include_hidden:
            return False
        matches = self.regex is not None and self.regex.search(name)
        return bool(self.everything or type_name in self.types or matches)

    def _wants_service(self, service: Service) -> bool:
        if service.name in self.excluded_services:
            return False
        if self.excluded_regex is not None and self.excluded_regex.search(service.name):
            return False
        matches = self.regex is not None and self.regex.search(service.name)
        return bool(self.all_services or service.name in self.services or matches)

    def _is_excluded(self, name: str, type_name: str) -> bool:
        matches = self.excluded_regex is not None and self.excluded_regex.search(name)
        return bool(matches or name in self.excluded_topics or type_name in self.excluded_types)


def add_log_level_argument(parser: Any) -> None:
    """
    Add the option for the messages of the node.

    Parameters
    ----------
    parser
        The parser of the verb, or a group of it.

    """
    parser.add_argument(
        '--log-level',
        choices=LOG_LEVELS,
        default='info',
        help='print messages of at least this severity (default: %(default)s)',
    )


def count(text: str) -> int:
    """
    Parse a non-negative integer argument.

    Parameters
    ----------
    text
        The argument text.

    Returns
    -------
    int
        Zero or more.

    Raises
    ------
    argparse.ArgumentTypeError
        The text is not such a number.

    """
    try:
        value = int(text)
    except ValueError:
        value = -1
    if value < 0:
        raise argparse.ArgumentTypeError(f'{text!r} is not a non-negative integer')
    return value


def not_negative(text: str) -> float:
    """
    Parse a finite non-negative number argument.

    Parameters
    ----------
    text
        The argument text.

    Returns
    -------
    float
        Zero or more.

    Raises
    ------
    argparse.ArgumentTypeError
        The text is not such a number.

    """
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0.0 <= value < float('inf'):
        raise argparse.ArgumentTypeError(f'{text!r} is not a non-negative number')
    return value


class Refused(argparse.Action):
    """
    Argparse action of a rosbag2 option that is not supported here.

    Using the option is a usage error with the reason; the help does not list it.

    Parameters
    ----------
    option_strings, dest
        As argparse passes them; values that follow the option are ignored.
    reason
        The text of the usage error after "is not supported here:".

    """

    def __init__(self, option_strings: Sequence[str], dest: str, *, reason: str) -> None:
        super().__init__(option_strings, dest, nargs='*', help=argparse.SUPPRESS)
        self._reason = reason

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        """Exit with a usage error."""
        parser.error(f'{option_string} is not supported here: {self._reason}')
