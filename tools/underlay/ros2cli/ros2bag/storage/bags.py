# SPDX-License-Identifier: Apache-2.0
"""Several bags as one: their messages are merged in the order of log time."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import replace
from heapq import merge

from ros2bag.storage.bag_reader import BagReader
from ros2bag.storage.definitions import Definition
from ros2bag.storage.latched import RecordedMessage
from ros2bag.storage.metadata import BagMetadata, merged

__all__ = ['Bags']


class Bags:
    """
    Reader of several bags, with what `BagReader` has.

    Parameters
    ----------
    paths
        The folders of the bags, or their files; at least one.

    Attributes
    ----------
    metadata
        The topics and the time span of all bags.
    path
        The paths, for messages to the user.

    Raises
    ------
    BagError
        As for `BagReader`.

    """

    def __init__(self, paths: Sequence[str]) -> None:
        self._readers = [BagReader(path) for path in paths]
        self.path = ', '.join(paths)
        parts = [reader.metadata for reader in self._readers]
        self.metadata: BagMetadata = (
            parts[0] if len(parts) == 1 else replace(merged(parts), custom_data=_joined(parts))
        )

    def check(self) -> None:
        """Raise BagError unless messages can be read from all files."""
        for reader in self._readers:
            reader.check()

    def messages(
        self,
        topics: Collection[str] | None = None,
        start_ns: int = 0,
        on_split: Callable[[str, str], None] = lambda *_: None,
    ) -> Iterator[RecordedMessage]:
        """
        Read messages in the order of log time.

        Parameters
        ----------
        topics, start_ns, on_split
            As for `BagReader.messages`.

        Returns
        -------
        iterator of RecordedMessage
            Of all bags.

        """
        streams = [reader.messages(topics, start_ns, on_split) for reader in self._readers]
        return streams[0] if len(streams) == 1 else iter(merge(*streams, key=_time))

    def definition(self, type_name: str) -> Definition:
        """
        Return the definition of a type as it was recorded; empty if no bag has one.

        Parameters
        ----------
        type_name
            The name of the type.

        """
        for reader in self._readers:
            if (found := reader.definitions().get(type_name)) and found.text:
                return found
        return Definition()


def _time(message: RecordedMessage) -> int:
    return message.log_ns


def _joined(parts: Sequence[BagMetadata]) -> dict[str, str]:
    return {key: value for part in parts for key, value in part.custom_data.items()}
