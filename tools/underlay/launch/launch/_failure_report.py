# SPDX-License-Identifier: Apache-2.0
"""Tell the user what went wrong in a launch file."""

from __future__ import annotations

import logging
from typing import Optional


def report_failure(logger: logging.Logger, error: BaseException) -> None:
    """Log an error and the line of the launch file that it comes from."""
    logger.error('Caught exception in launch (see debug for traceback): %s', error)
    place = place_of(error)
    if place:
        logger.error('%s', place)
    logger.debug('the traceback of it', exc_info=error)


def place_of(error: Optional[BaseException]) -> str:
    """Return where the innermost cause with a known place comes from."""
    found = ''
    while error is not None:
        site = getattr(error, 'launch_call_site', None)
        if site is not None:
            action = getattr(error, 'launch_action_name', '')
            found = f'It comes from {site}' + (f' ({action})' if action else '')
        error = error.__cause__
    return found
