# SPDX-License-Identifier: Apache-2.0
"""Route between two frames via their common ancestor."""

from __future__ import annotations

from collections.abc import Callable, Container
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

from tf2_py._link import Gap
from tf2_py.exceptions import LookupException

_MAX_LINKS = 1000


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
        "'ros2 topic echo /tf' and 'ros2 topic info -v /tf' show who says so."
    )
