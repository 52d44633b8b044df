# SPDX-License-Identifier: Apache-2.0
"""Find the route between two frames, and explain why there is none."""

from __future__ import annotations

from collections.abc import Callable, Collection, Container
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

from ros_environment.suggestions import did_you_mean
from tf2_py.exceptions import LookupException
from tf2_py.samples import Gap

_MAX_LINKS = 1000

_SHOWN = 20
_ADVICE_TO_WAIT = 'pass a timeout to wait for it'


class Step(Protocol):
    """Step from a frame to its parent."""

    @property
    def parent(self) -> str:
        """Return the parent frame."""
        ...


StepT = TypeVar('StepT', bound=Step)


@dataclass(frozen=True)
class Route(Generic[StepT]):
    """The steps from two frames up to their common ancestor."""

    from_source: list[StepT]
    from_target: list[StepT]


class Unconnected(Exception):
    """There is no common ancestor, possibly as some frames have no samples at that time."""

    def __init__(self, gap: Gap | None) -> None:
        super().__init__()
        self.gap = gap


def find_route(source: str, target: str, step_of: Callable[[str], StepT | None]) -> Route[StepT]:
    """
    Find the steps from two frames up to their common ancestor.

    Parameters
    ----------
    source, target
        The frames.
    step_of
        Looks up the step from a frame to its parent; returns None at a root, and may raise a Gap.

    Raises
    ------
    Unconnected
        There is no common ancestor; the exception holds the Gap, if one was encountered.
    LookupException
        The parents form a loop, or a chain of more than 1000 frames.

    """
    frames, source_steps, gap = _climb(source, step_of, (target,))
    if frames[-1] == target:
        return Route(source_steps, [])
    target_frames, target_steps, target_gap = _climb(target, step_of, frames)
    if target_frames[-1] not in frames:
        raise Unconnected(gap or target_gap)
    count = frames.index(target_frames[-1])
    return Route(source_steps[:count], target_steps)


def _climb(
    start: str, step_of: Callable[[str], StepT | None], goal: Container[str]
) -> tuple[list[str], list[StepT], Gap | None]:
    """Climb to the goal, the root or a gap; return the frames, the steps and the gap."""
    frame = start
    frames = [start]
    steps: list[StepT] = []
    while frame not in goal:
        try:
            step = step_of(frame)
        except Gap as gap:
            return frames, steps, gap
        if step is None:
            break
        frame = step.parent
        frames.append(frame)
        steps.append(step)
        if len(steps) > _MAX_LINKS:
            raise LookupException(_loop(frames))
    return frames, steps, None


def _loop(frames: list[str]) -> str:
    first = frames.index(frames[-1])
    loop = [*dict.fromkeys(frames[first:]), frames[first]]
    if first == len(frames) - 1:
        return f'The tf tree is invalid because it has a chain of more than {_MAX_LINKS} frames.'
    return (
        'The tf tree is invalid because it contains a loop. '
        f'From child to parent: {" -> ".join(loop)}. One of these frames has a wrong parent; '
        "'ros2 topic echo /tf' and 'ros2 topic info -v /tf' show which node publishes it."
    )


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


def unconnected_frames(target: str, source: str, roots: tuple[str, str]) -> str:
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
        f'{_below(target, roots[0])}, {_below(source, roots[1])}: no node publishes the '
        f"transform between '{roots[0]}' and '{roots[1]}' yet"
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
    return reason.replace(_ADVICE_TO_WAIT, f'not received within {timeout_s:g} s; wait longer')


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
        f'That is {back_s:.3f} s too early: the buffer was created later, its cache is shorter, '
        'or the clocks differ (is use_sim_time the same everywhere?)'
    )


def _seconds(time_ns: int) -> str:
    return f'{time_ns // 10**9}.{time_ns % 10**9 // 1000:06d}'


def _which(frame: str, known: Collection[str]) -> str:
    """Suggest a similar frame name, or list the existing ones."""
    if not known:
        return 'There are no frames yet: nothing was received on /tf and /tf_static'
    question = did_you_mean(frame, known)
    if question:
        return question
    names = sorted(known)
    more = f' and {len(names) - _SHOWN} more' if len(names) > _SHOWN else ''
    return f'The frames are: {", ".join(names[:_SHOWN])}{more}'
