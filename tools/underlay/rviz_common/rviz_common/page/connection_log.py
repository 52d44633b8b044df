# SPDX-License-Identifier: Apache-2.0
"""What is logged about the connections of browsers to a page, at a limited rate."""

from __future__ import annotations

import asyncio
import logging
from typing import Any

from rviz_common.pace import Pace
from rviz_common.status import described_error
from websockets.exceptions import ConnectionClosed, InvalidHandshake

__all__ = ['LOGGER', 'complain', 'complain_about_task']

LOGGER = logging.getLogger('rviz_common.page')
REPEAT_S = 10.0
_PACE = Pace(REPEAT_S)


def complain(sentence: str) -> None:
    """
    Log a warning, unless one has been logged within the last 10 s.

    Parameters
    ----------
    sentence
        The message.

    """
    if _PACE.is_due():
        LOGGER.warning(sentence)


def complain_about_task(loop: asyncio.AbstractEventLoop, about: dict[str, Any]) -> None:
    """
    Log the failure of a task of the page; an exception handler for an asyncio event loop.

    Parameters
    ----------
    loop
        The event loop.
    about
        The context of the failure, with the keys `exception` and `message` of asyncio.

    """
    error = about.get('exception')
    said = described_error(error) if isinstance(error, Exception) else about.get('message', '')
    complain(f'A message from a browser could not be handled: {said}')


def _shorten(record: logging.LogRecord) -> bool:
    """
    Filter log records, shortening an exception to one line.

    The `websockets` library logs too much, such as clients that do not speak HTTP or disconnect.
    """
    error = record.exc_info[1] if record.exc_info else None
    if isinstance(error, Exception):
        record.msg = f'A connection has failed: {described_error(error)}'
        record.args, record.exc_info = (), None
        return not isinstance(error, (ConnectionClosed, InvalidHandshake))
    return record.levelno >= logging.WARNING


LOGGER.addFilter(_shorten)
