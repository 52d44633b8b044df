# SPDX-License-Identifier: Apache-2.0
"""Report errors in launch files to the user."""

from __future__ import annotations

import logging


def report_failure(logger: logging.Logger, error: BaseException) -> None:
    """
    Log an error and the line of the launch file that it comes from.

    The traceback is logged at the level DEBUG.

    Parameters
    ----------
    logger
        The logger to use.
    error
        The exception.

    """
    from launch._call_site import raising_line
    from launch._error_text import error_text
    from launch._failure_place import FailurePlace, place_of

    text = error_text(error)
    logger.error('Caught exception in launch (see debug for traceback): %s', text)
    place = place_of(error)
    line = raising_line(error) if place is None else None
    if place is None and line is not None:
        place = FailurePlace(line)
    if place is not None:
        logger.error('%s', place)
    logger.debug('the traceback of it', exc_info=error)
