# SPDX-License-Identifier: Apache-2.0
"""Error messages of failed lookups."""

from __future__ import annotations

from collections.abc import Collection

from launch._did_you_mean import did_you_mean
from tf2_py._link import Gap

_SHOWN = 20
_ADVICE_TO_WAIT = 'give a timeout to wait for it'


def unknown_frame(call: str, argument: str, frame: str, known: Collection[str]) -> str:
    """
    Format the error for a frame that does not exist, with a suggestion.

    Parameters
    ----------
    call, argument
        The call, such as 'lookupTransform', and its argument, such as 'target_frame'.
    frame
        The given name.
    known
        The existing names.

    """
    if call == 'canTransform':
        text = f'Invalid frame ID "{frame}" passed to canTransform argument {argument}'
        return f'{text} - frame does not exist. {_which(frame, known)}'
    return f'"{frame}" passed to {call} argument {argument} does not exist. {_which(frame, known)}'


def empty_frame(call: str, argument: str) -> str:
    """
    Format the error for an empty frame name.

    Parameters
    ----------
    call, argument
        The call, such as 'lookupTransform', and its argument, such as 'target_frame'.

    """
    return (
        f'Invalid argument passed to {call} argument {argument} in tf2 frame_ids cannot be empty'
    )


def slashed_frame(call: str, argument: str, frame: str) -> str:
    """
    Format the error for a frame name with a leading slash.

    Parameters
    ----------
    call, argument
        The call, such as 'lookupTransform', and its argument, such as 'target_frame'.
    frame
        The given name.

    """
    return (
        f'Invalid argument "{frame}" passed to {call} argument {argument} in tf2 frame_ids '
        f"cannot start with a '/'. Write '{frame.lstrip('/')}'"
    )


def unconnected(target: str, source: str, roots: tuple[str, str]) -> str:
    """
    Format the error for two frames in different trees.

    Parameters
    ----------
    target, source
        The frames.
    roots
        The root of the target's tree, and that of the source's tree.

    """
    return (
        f"Could not find a connection between '{target}' and '{source}' because they are not "
        'part of the same tree. Tf has two or more unconnected trees. '
        f'{_below(target, roots[0])}, {_below(source, roots[1])}: nobody publishes the transform '
        f"between '{roots[0]}' and '{roots[1]}', or not yet"
    )


def _below(frame: str, root: str) -> str:
    return f"'{frame}' is a root" if frame == root else f"'{frame}' is below '{root}'"


def after_waiting(reason: str, timeout_s: float) -> str:
    """
    Adapt the reason of a failed lookup for a caller that has already waited.

    Parameters
    ----------
    reason
        The message of the exception.
    timeout_s
        The time for which the caller has waited, in s.

    """
    return reason.replace(_ADVICE_TO_WAIT, f'it has not come within {timeout_s:g} s; wait longer')


def extrapolation(gap: Gap, target: str, source: str) -> str:
    """
    Format the error for a time outside the samples, with the distance to the nearest one.

    Parameters
    ----------
    gap
        The requested time and the range of the samples.
    target, source
        The frames of the lookup.

    """
    where = f'when looking up transform from frame [{source}] to frame [{target}]'
    requested = _seconds(gap.requested_ns)
    if gap.oldest_ns == gap.latest_ns:
        return (
            f'Lookup would require extrapolation at time {requested}, but only time '
            f'{_seconds(gap.latest_ns)} is in the buffer, {where}. {_far(gap)}'
        )
    is_past = gap.requested_ns < gap.oldest_ns
    direction, kind = ('past', 'earliest') if is_past else ('future', 'latest')
    nearest = _seconds(gap.oldest_ns if is_past else gap.latest_ns)
    return (
        f'Lookup would require extrapolation into the {direction}.  Requested time {requested} '
        f'but the {kind} data is at time {nearest}, {where}. {_far(gap)}'
    )


def _far(gap: Gap) -> str:
    if gap.requested_ns > gap.latest_ns:
        ahead_s = (gap.requested_ns - gap.latest_ns) / 1e9
        if ahead_s > 60.0:
            return f'That is {ahead_s:.0f} s ahead: is use_sim_time the same everywhere?'
        return f'That is {ahead_s:.3f} s ahead: {_ADVICE_TO_WAIT}, or ask for time 0, the latest'
    back_s = (gap.oldest_ns - gap.requested_ns) / 1e9
    return (
        f'That is {back_s:.3f} s too early: the buffer was made later, keeps less, or the clocks '
        'differ (is use_sim_time the same everywhere?)'
    )


def _seconds(time_ns: int) -> str:
    return f'{time_ns // 10**9}.{time_ns % 10**9 // 1000:06d}'


def _which(frame: str, known: Collection[str]) -> str:
    """Suggest a similar frame name, or list the existing ones."""
    if not known:
        return 'There are no frames yet: nothing has come on /tf and /tf_static'
    question = did_you_mean(frame, known)
    if question:
        return question
    names = sorted(known)
    more = f' and {len(names) - _SHOWN} more' if len(names) > _SHOWN else ''
    return f'The frames are: {", ".join(names[:_SHOWN])}{more}'
