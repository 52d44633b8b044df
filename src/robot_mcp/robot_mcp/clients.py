# SPDX-License-Identifier: Apache-2.0
"""What the handling of tool calls needs of a client, and what it answers."""

from __future__ import annotations

import asyncio
from dataclasses import dataclass
from typing import Protocol

__all__ = ['Answer', 'Client', 'NeedsInputError']


@dataclass(frozen=True)
class Answer:
    """The answer to a client: a text, PNG images, and whether it is an error."""

    text: str
    pictures: tuple[bytes, ...] = ()
    is_error: bool = False


class NeedsInputError(Exception):
    """The client has to ask its user, and to call again with the answer."""

    def __init__(self, question: str, code: str) -> None:
        super().__init__(question)
        self.question, self.code = question, code


class Client(Protocol):
    """Interface to the calling client."""

    name: str
    gone: asyncio.Event | None
    """Set when the client has disconnected; None if that cancels the call anyway."""

    async def asks(self, question: str, request: str) -> bool | None:
        """
        Request confirmation from the person at the client.

        Parameters
        ----------
        question
            The text shown to the person.
        request
            The request that a confirmation is valid for, beginning with `request_of`.

        Returns
        -------
        bool or None
            Whether the person agrees; None if the client cannot ask one.

        Raises
        ------
        NeedsInputError
            The client has to call again with the answer.

        """

    async def report(self, progress: float, total: float, text: str) -> None:
        """
        Report progress to the client.

        Parameters
        ----------
        progress, total
            The number of completed steps, including fractions, and the total number.
        text
            The current step, or its result.

        """
