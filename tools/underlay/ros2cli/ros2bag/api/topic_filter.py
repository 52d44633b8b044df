# SPDX-License-Identifier: Apache-2.0
"""Selection of the topics to record or play."""

from __future__ import annotations

import argparse
from dataclasses import dataclass, field
import re

from ros2cli.names import is_hidden

__all__ = ['TopicFilter', 'regular_expression']


@dataclass(frozen=True)
class TopicFilter:
    """Topic filter: the requested topics minus the excluded ones."""

    everything: bool = False
    topics: frozenset[str] = frozenset()
    types: frozenset[str] = frozenset()
    regex: re.Pattern[str] | None = None
    excluded_topics: frozenset[str] = frozenset()
    excluded_types: frozenset[str] = frozenset()
    excluded_regex: re.Pattern[str] | None = None
    include_hidden: bool = field(default=True)

    def wants(self, name: str, type_name: str) -> bool:
        """
        Whether a topic is selected; one given by name is selected even if it is hidden.

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
        if is_hidden(name) and not self.include_hidden:
            return False
        matches = self.regex is not None and self.regex.search(name)
        return bool(self.everything or type_name in self.types or matches)

    def _is_excluded(self, name: str, type_name: str) -> bool:
        matches = self.excluded_regex is not None and self.excluded_regex.search(name)
        return bool(matches or name in self.excluded_topics or type_name in self.excluded_types)


def regular_expression(text: str) -> re.Pattern[str]:
    """
    Compile a regular expression argument.

    Parameters
    ----------
    text
        The argument text.

    Raises
    ------
    argparse.ArgumentTypeError
        The text is not a regular expression.

    """
    try:
        return re.compile(text)
    except re.error as error:
        raise argparse.ArgumentTypeError(
            f'{text!r} is not a regular expression: {error}'
        ) from error
