# SPDX-License-Identifier: Apache-2.0
"""
Find the line of a launch file that created an action, or that caused an error.

The line is recorded on the error while it propagates, with the includes that led there, and
reported with the error.
"""

from __future__ import annotations

from collections.abc import Sequence
import inspect
import os
from typing import Any, NamedTuple, Optional, TYPE_CHECKING

if TYPE_CHECKING:
    import logging

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
    ('launch._event_processor', 'launch_testing.test_runner', 'ros2cli', 'ros2launch')
)
_INSTALLED = ('site-packages', 'dist-packages')
_STANDARD_LIBRARY = os.path.dirname(os.__file__) + os.sep
_TOO_DEEP = (
    '{error}\nThe launch file nests groups or other actions too deeply, or a function in it calls '
    'itself endlessly.'
)


class CallSite(NamedTuple):
    """A line of a file; the line is 0 if it is unknown."""

    file_name: str
    line: int

    def __str__(self) -> str:
        """Format the file name and the line number."""
        return f"'{self.file_name}'" + (f', line {self.line}' if self.line else '')


class OpenFile(NamedTuple):
    """Entry of the include stack: a launch file, the including line, and the state then."""

    path: str
    call_site: Optional[CallSite]
    configurations: dict[str, Any]
    environment: Optional[dict[str, str]]


def calling_line() -> Optional[CallSite]:
    """
    Return the innermost line on the stack outside launch and the standard library.

    None if launch itself is the caller, at run time or in a command.
    """
    frame = inspect.currentframe()
    while frame is not None:
        package = _package(frame.f_globals)
        if package in _COMMANDS or frame.f_globals.get('__name__') in _COMMANDS:
            return None
        file_name = frame.f_code.co_filename
        if package not in _OWN_PACKAGES and not file_name.startswith(_STANDARD_LIBRARY):
            return CallSite(file_name, frame.f_lineno)
        frame = frame.f_back
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


class FailurePlace(NamedTuple):
    """Origin of an error: a line, the class of the action, and the lines of the includes."""

    call_site: CallSite
    action: str = ''
    includes: tuple[CallSite, ...] = ()

    def __str__(self) -> str:
        """Format the origin for the user, with a line for each include."""
        action = f' ({self.action})' if self.action else ''
        lines = [f'It comes from {self.call_site}{action}']
        lines += [f'  included from {each}' for each in self.includes]
        return '\n'.join(lines)


def place_of(error: Optional[BaseException]) -> Optional[FailurePlace]:
    """
    Find the origin that was recorded on an error, or else on one of its causes.

    Parameters
    ----------
    error
        The exception, or None.

    Returns
    -------
    FailurePlace or None
        The first origin along the chain of `__cause__`, None if there is none.

    """
    while error is not None:
        found: Optional[FailurePlace] = getattr(error, 'launch_place', None)
        if found is not None:
            return found
        error = error.__cause__
    return None


def note_line(
    error: BaseException,
    call_site: Optional[CallSite],
    action: str = '',
    includes: tuple[CallSite, ...] = (),
) -> None:
    """
    Record on an error the line of the launch file that it comes from.

    Does nothing if the line is unknown or an origin has been recorded already.

    Parameters
    ----------
    error
        The exception to annotate.
    call_site
        The line of the file.
    action
        The tag or the class of the action at that line, if it is known.
    includes
        The lines of the includes that led there so far, innermost first.

    """
    if call_site is not None and place_of(error) is None:
        _set(error, FailurePlace(call_site, action, includes))


def note_place(
    error: BaseException,
    entity: object,
    include_stack: Sequence[OpenFile],
) -> None:
    """
    Record on an error which entity failed, with all includes that led to it.

    Call at each level of a visit through which the error propagates; the innermost call counts.

    Parameters
    ----------
    error
        The exception to annotate.
    entity
        The entity whose visit raised it.
    include_stack
        The launch files that are being read, each included by the previous one.

    """
    if getattr(error, 'launch_place_is_complete', False):
        return
    created = getattr(entity, 'call_site', None)
    inner = place_of(error)
    if inner is None:
        line = raising_line(error) if _runs_code_of_the_user(entity) else None
        place = _place_of_entity(line or created, type(entity).__name__, include_stack)
    else:
        outer = _includes(inner.call_site, created, include_stack)
        includes = tuple(dict.fromkeys((*inner.includes, *outer)))
        place = FailurePlace(inner.call_site, inner.action, includes)
    if place is not None:
        _set(error, place)
        error.launch_place_is_complete = True  # type: ignore[attr-defined]


def _runs_code_of_the_user(entity: object) -> bool:
    return getattr(entity, 'runs_code_of_the_user', False)


def _place_of_entity(
    call_site: Optional[CallSite],
    action: str,
    include_stack: Sequence[OpenFile],
) -> Optional[FailurePlace]:
    """Return the origin of an entity; without a line, use the launch file being read."""
    if call_site is None and include_stack:
        call_site = CallSite(include_stack[-1].path, 0)
    if call_site is None:
        return None
    return FailurePlace(call_site, action, _includes(call_site, None, include_stack))


def _includes(
    call_site: CallSite,
    including: Optional[CallSite],
    include_stack: Sequence[OpenFile],
) -> tuple[CallSite, ...]:
    """Return the lines of the includes that led to a line, innermost first."""
    lines = [including, *(each.call_site for each in reversed(include_stack))]
    return tuple(dict.fromkeys(each for each in lines if each is not None and each != call_site))


def _set(error: Any, place: FailurePlace) -> None:
    error.launch_place = place


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
    text = error_text(error)
    logger.error('Caught exception in launch (see debug for traceback): %s', text)
    place = place_of(error)
    line = raising_line(error) if place is None else None
    if place is None and line is not None:
        place = FailurePlace(line)
    if place is not None:
        logger.error('%s', place)
    logger.debug('the traceback of it', exc_info=error)


def error_text(error: BaseException) -> str:
    """
    Format an exception for the user.

    Parameters
    ----------
    error
        The exception; an explanation is added to a `RecursionError`.

    """
    if isinstance(error, RecursionError):
        return _TOO_DEEP.format(error=error)
    return str(error)
