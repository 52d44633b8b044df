# SPDX-License-Identifier: Apache-2.0
"""Several filters as one."""

# ruff: noqa: N802
from __future__ import annotations

from typing import Any

from message_filters.simple_filter import SimpleFilter

__all__ = ['Chain']


class Chain(SimpleFilter):
    """
    Filter that passes messages through other filters, one after the other.

    What the last of them puts out is the output of the chain; without any, it is the input.

    Parameters
    ----------
    message_filter
        The filter whose messages go into the chain; None for one that `connectInput` or `add`
        feeds.

    """

    def __init__(self, message_filter: SimpleFilter | None = None) -> None:
        super().__init__()
        self.incoming_connection: int | None = None
        self._input: SimpleFilter | None = None
        self._entry = SimpleFilter()
        self._filters: list[Any] = []
        self._entry.registerCallback(self._pass_on, 0)
        if message_filter is not None:
            self.connectInput(message_filter)

    @property
    def node(self) -> Any:
        """The node of the chain's subscriber; None without one."""
        return getattr(self._input, 'node', None)

    def connectInput(self, message_filter: SimpleFilter) -> None:
        """
        Take the messages of a filter, instead of those of an earlier one.

        Parameters
        ----------
        message_filter
            The filter.

        """
        if self._input is not None and self.incoming_connection is not None:
            self._input.callbacks.pop(self.incoming_connection, None)
        self._input = message_filter
        self.incoming_connection = message_filter.registerCallback(self.add)

    def add(self, *msg: Any) -> None:
        """
        Put a message into the chain.

        Parameters
        ----------
        *msg
            The message, or the messages of a synchronizer.

        """
        self._entry.signalMessage(*msg)

    def addFilter(self, message_filter: Any) -> int:
        """
        Append a filter.

        Parameters
        ----------
        message_filter
            A filter with `connectInput`, such as `Cache`.

        Returns
        -------
        int
            Its index.

        Raises
        ------
        TypeError
            The filter takes no input, as a `Subscriber` does not.

        """
        if not hasattr(message_filter, 'connectInput'):
            raise TypeError(
                f'A {type(message_filter).__name__} has no connectInput, so it cannot follow '
                'another filter. As the beginning of a chain: Chain(message_filter)'
            )
        message_filter.connectInput(self._filters[-1] if self._filters else self._entry)
        self._filters.append(message_filter)
        message_filter.registerCallback(self._pass_on, len(self._filters))
        return len(self._filters) - 1

    def getFilter(self, index: int) -> Any:
        """
        Return a filter of the chain; None if it has no such filter.

        Parameters
        ----------
        index
            Its index, from 0.

        """
        return self._filters[index] if 0 <= index < len(self._filters) else None

    def _pass_on(self, *arguments: Any) -> None:
        """Put out what the last filter has put out; the last argument is a filter's position."""
        *msg, position = arguments
        if position == len(self._filters):
            self.signalMessage(*msg)
