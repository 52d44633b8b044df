# SPDX-License-Identifier: Apache-2.0
"""Which transforms a buffer takes in, and what it says about the others, without repetition."""

from __future__ import annotations

from collections.abc import Callable, Iterable
import time
from typing import TYPE_CHECKING

from tf2_py.poses import is_finite, normalized, Pose
from tf2_py.samples import Sample

if TYPE_CHECKING:
    import threading

    from tf2_py._frame_store import FrameStore
    from tf2_py.messages import Reading

_SILENCE_S = 10.0


class Intake:
    """
    Intake of a buffer: stores valid transforms, and warns about the others.

    Parameters
    ----------
    store
        The frames with their samples.
    lock
        Guards the store.
    say
        The function that logs a warning.

    """

    def __init__(
        self, store: FrameStore, lock: threading.RLock, say: Callable[[str], object]
    ) -> None:
        self._store = store
        self._lock = lock
        self._complaints = Complaints(say)

    def insert(self, readings: Iterable[Reading], authority: str, is_static: bool) -> None:
        """
        Insert transforms given as frame names and numbers.

        Parameters
        ----------
        readings
            For each transform: parent frame, child frame, stamp in ns, and pose of the child.
        authority
            The publisher of the transforms.
        is_static
            Whether the transforms are valid at all times.

        """
        for parent, child, stamp_ns, pose in readings:
            parent, child = parent.lstrip('/'), child.lstrip('/')
            reason = refusal(parent, child, pose, authority)
            unit = None if reason else normalized(pose)
            if unit is None:
                reason = reason or bad_quaternion(child, pose, authority)
                self._complaints.add(reason, child, authority)
            else:
                self._keep(child, Sample(stamp_ns, parent, unit, authority), is_static)

    def _keep(self, child: str, sample: Sample, is_static: bool) -> None:
        with self._lock:
            if self._store.changes_kind(child, is_static):
                self._complaints.add(both_kinds(child, sample.authority), child, 'both')
            is_new = self._store.insert(child, sample, is_static)
        if not is_new:
            self._complain_of_old(child, sample)

    def _complain_of_old(self, child: str, sample: Sample) -> None:
        latest = self._store.latest(child)
        if latest is not None:
            authority, cache_ns = sample.authority, self._store.cache_ns
            text = old_data(child, sample.stamp_ns, latest.stamp_ns, cache_ns, authority)
            self._complaints.add(text, child, authority)


def refusal(parent: str, child: str, pose: Pose, authority: str) -> str:
    """
    Validate the frame names and numbers of a transform, other than the length of its quaternion.

    Parameters
    ----------
    parent, child
        The frame of the header, and the child frame, without leading slashes.
    pose
        Translation and quaternion.
    authority
        The publisher of the transform.

    Returns
    -------
    str
        The reason why the transform is rejected; '' if it is valid.

    """
    if not child:
        return (
            f'Ignoring transform from authority "{authority}" because child_frame_id is not set, '
            f'with frame_id "{parent}"'
        )
    if not parent:
        return (
            f'Ignoring transform with child_frame_id "{child}" from authority "{authority}" '
            'because frame_id is not set'
        )
    if parent == child:
        return (
            f'Ignoring transform from authority "{authority}" with frame_id and child_frame_id '
            f'"{child}" because they are the same'
        )
    if not is_finite(pose):
        return _bad_number(child, pose, authority)
    return ''


def _bad_number(child: str, pose: Pose, authority: str) -> str:
    return (
        f'Ignoring transform for child_frame_id "{child}" from authority "{authority}" because '
        f'of a nan or infinite value in the transform {_numbers(pose)}'
    )


def bad_quaternion(child: str, pose: Pose, authority: str) -> str:
    """
    Format the error for a transform whose quaternion is not normalized.

    Parameters
    ----------
    child
        The child frame.
    pose
        Translation and quaternion x, y, z, w.
    authority
        The publisher of the transform.

    """
    hint = ' (an empty message has w = 0; no rotation is w = 1)' if not any(pose[3:]) else ''
    return (
        f'Ignoring transform for child_frame_id "{child}" from authority "{authority}" because '
        f'of an invalid quaternion in the transform {_numbers(pose[3:])}: its length must be 1'
        f'{hint}'
    )


def old_data(child: str, stamp_ns: int, latest_ns: int, cache_ns: int, authority: str) -> str:
    """
    Format the warning for a transform that is older than the buffer.

    Parameters
    ----------
    child
        The child frame.
    stamp_ns, latest_ns
        The time of the transform and of the latest one of this frame, in ns.
    cache_ns
        The length of the buffer, in ns.
    authority
        The publisher of the transform.

    """
    return (
        f'TF_OLD_DATA ignoring data from the past for frame {child} at time {stamp_ns / 1e9:.6f} '
        f'according to authority {authority}: the latest is from {latest_ns / 1e9:.6f}, and '
        f'{cache_ns / 1e9:g} s are kept. Two clocks are in use (is use_sim_time the same '
        'everywhere?), or time went back, as when a bag is played again'
    )


def both_kinds(child: str, authority: str) -> str:
    """
    Format the warning for a frame that is published both as static and as moving.

    Parameters
    ----------
    child
        The child frame.
    authority
        The publisher of the last transform, which takes precedence.

    """
    return (
        f'Frame "{child}" is published both as a static and as a dynamic transform; the latest '
        f'one is used, from authority "{authority}". Two nodes publish it: '
        "'ros2 topic info -v /tf' and 'ros2 topic info -v /tf_static' name them"
    )


def _numbers(values: tuple[float, ...]) -> str:
    return '(' + ' '.join(f'{value:g}' for value in values) + ')'


class Complaints:
    """
    Throttled logger: logs each kind of warning at most once per period, 10 s by default.

    Parameters
    ----------
    say
        The function that logs a text.
    now_s
        The clock, in s, with an arbitrary epoch.
    silence_s
        The time for which a kind of warning is suppressed after it was logged, in s.

    """

    def __init__(
        self,
        say: Callable[[str], object],
        now_s: Callable[[], float] = time.monotonic,
        silence_s: float = _SILENCE_S,
    ) -> None:
        self._silence_s = silence_s
        self._say = say
        self._now_s = now_s
        self._said_s: dict[tuple[str, ...], float] = {}

    def add(self, text: str, *kind: str) -> None:
        """
        Log a warning unless one of the same kind was logged recently.

        Parameters
        ----------
        text
            The warning.
        *kind
            The key of its kind, such as the frame and the broadcaster.

        """
        now_s = self._now_s()
        if now_s - self._said_s.get(kind, -self._silence_s) >= self._silence_s:
            self._said_s[kind] = now_s
            self._say(text)
