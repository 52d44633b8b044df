# SPDX-License-Identifier: Apache-2.0
"""Annotate exceptions with the line of the launch file that they come from."""

from __future__ import annotations

from typing import Any, NamedTuple, Optional, TYPE_CHECKING

from launch._call_site import CallSite, raising_line

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity


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
    entity: LaunchDescriptionEntity,
    context: LaunchContext,
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
    context
        The context of the launch, which knows the files that are being read.

    """
    if getattr(error, 'launch_place_is_complete', False):
        return
    created = getattr(entity, 'call_site', None)
    inner = place_of(error)
    if inner is None:
        line = raising_line(error) if _runs_code_of_the_user(entity) else None
        place = _place_of_entity(line or created, type(entity).__name__, context)
    else:
        outer = _includes(inner.call_site, created, context)
        place = inner._replace(includes=tuple(dict.fromkeys((*inner.includes, *outer))))
    if place is not None:
        _set(error, place)
        error.launch_place_is_complete = True  # type: ignore[attr-defined]


def _runs_code_of_the_user(entity: LaunchDescriptionEntity) -> bool:
    return getattr(entity, '_runs_code_of_the_user', False)


def _place_of_entity(
    call_site: Optional[CallSite],
    action: str,
    context: LaunchContext,
) -> Optional[FailurePlace]:
    """Return the origin of an entity; without a line, use the launch file being read."""
    if call_site is None and context._open_files:
        call_site = CallSite(context._open_files[-1].path, 0)
    if call_site is None:
        return None
    return FailurePlace(call_site, action, _includes(call_site, None, context))


def _includes(
    call_site: CallSite,
    including: Optional[CallSite],
    context: LaunchContext,
) -> tuple[CallSite, ...]:
    """Return the lines of the includes that led to a line, innermost first."""
    lines = [including, *(each.call_site for each in reversed(context._open_files))]
    return tuple(dict.fromkeys(each for each in lines if each is not None and each != call_site))


def _set(error: Any, place: FailurePlace) -> None:
    error.launch_place = place
