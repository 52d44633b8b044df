# SPDX-License-Identifier: Apache-2.0
"""Find the line of the launch file that created an action, or that raised an error."""

from __future__ import annotations

import os
import sys
from typing import NamedTuple, Optional

_OWN_PACKAGES = frozenset(
    (
        'launch',
        'launch_pytest',
        'launch_ros',
        'launch_testing',
        'launch_testing_ros',
        'launch_xml',
        'launch_yaml',
    )
)
# Packages, and modules of the packages above, that run launches written by others.
_COMMANDS = frozenset(
    ('launch._event_processor', 'launch_testing._single_run', 'ros2cli', 'ros2launch')
)
_INSTALLED = ('site-packages', 'dist-packages')
_STANDARD_LIBRARY = os.path.dirname(os.__file__) + os.sep


class CallSite(NamedTuple):
    """A line of a file; the line is 0 if it is unknown."""

    file_name: str
    line: int

    def __str__(self) -> str:
        """Format the file name and the line number."""
        return f"'{self.file_name}'" + (f', line {self.line}' if self.line else '')


def calling_line() -> Optional[CallSite]:
    """
    Return the innermost line on the stack outside launch and the standard library.

    None if launch itself is the caller, at run time or in a command.
    """
    frame = sys._getframe(1)
    while frame is not None:
        package = _package(frame.f_globals)
        if package in _COMMANDS or frame.f_globals.get('__name__') in _COMMANDS:
            return None
        file_name = frame.f_code.co_filename
        if package not in _OWN_PACKAGES and not file_name.startswith(_STANDARD_LIBRARY):
            return CallSite(file_name, frame.f_lineno)
        frame = frame.f_back  # type: ignore[assignment]
    return None


def raising_line(error: BaseException) -> Optional[CallSite]:
    """
    Find the line of the user's own files at which an error was raised.

    Parameters
    ----------
    error
        An exception with its traceback.

    Returns
    -------
    CallSite or None
        The innermost line that belongs neither to launch, nor to Python, nor to an installed
        library; None if there is no such line.

    """
    found = None
    traceback = error.__traceback__
    while traceback is not None:
        frame = traceback.tb_frame
        is_own = _package(frame.f_globals) in _OWN_PACKAGES | _COMMANDS
        if not is_own and _is_of_a_user(frame.f_code.co_filename):
            found = CallSite(frame.f_code.co_filename, traceback.tb_lineno)
        traceback = traceback.tb_next
    return found


def _package(variables: dict[str, object]) -> str:
    return str(variables.get('__name__', '')).partition('.')[0]


def _is_of_a_user(file_name: str) -> bool:
    """Check whether a file belongs neither to Python nor to an installed library."""
    if file_name.startswith('<') or any(part in file_name for part in _INSTALLED):
        return False
    return not file_name.startswith(_STANDARD_LIBRARY)
