# SPDX-License-Identifier: Apache-2.0
"""Which frames a buffer has: names, latest samples, chains, and as text, YAML or Graphviz."""

from __future__ import annotations

import re
from typing import NamedTuple, TYPE_CHECKING

from tf2_py.messages import nanoseconds

if TYPE_CHECKING:
    import threading

    from rclpy.time import Time
    from tf2_py._frame_store import Cache, FrameStore
    from tf2_py.samples import Sample

_SHORTEST_S = 1e-4
_NO_DATA = '"no tf data"\n'
_PLAIN = re.compile(r'[\w/][\w/.-]*')


class _Branch(NamedTuple):
    """The entry of a frame in a listing."""

    frame: str
    parent: str
    broadcaster: str
    rate_hz: float
    latest_s: float
    oldest_s: float

    @property
    def length_s(self) -> float:
        """Return the time between the oldest and the latest transform."""
        return self.latest_s - self.oldest_s


class KnownFrames:
    """
    The frames of a buffer; all methods are thread-safe.

    Parameters
    ----------
    store
        The frames with their samples.
    lock
        Guards the store.

    """

    def __init__(self, store: FrameStore, lock: threading.RLock) -> None:
        self._store = store
        self._lock = lock

    def names(self) -> list[str]:
        """Return the names of all frames."""
        with self._lock:
            return self._store.names()

    def has(self, *frames: str) -> bool:
        """
        Check whether all of some frames exist.

        Parameters
        ----------
        *frames
            The names, all of which must be known.

        """
        with self._lock:
            return self._store.has(*frames)

    def latest(self, frame: str) -> Sample | None:
        """
        Return the latest sample of a frame; that of a static frame has time 0.

        Parameters
        ----------
        frame
            The child frame.

        Returns
        -------
        Sample or None
            None if the frame has no parent.

        """
        with self._lock:
            return self._store.latest(frame)

    def latest_of_all(self) -> dict[str, Sample]:
        """Return the latest sample of each frame that has a parent, by name."""
        with self._lock:
            latest = {frame: cache.latest() for frame, cache in self._store.known()}
        return {frame: sample for frame, sample in latest.items() if sample is not None}

    def chain(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
    ) -> list[str]:
        """
        Return the chain of frames from the source via the fixed frame to the target.

        Parameters
        ----------
        target_frame, target_time
            The last frame of the chain, and the time; 0 is the latest.
        source_frame, source_time
            The first frame of the chain, and the time; 0 is the latest.
        fixed_frame
            A frame that the chain passes.

        Raises
        ------
        TransformException
            A frame is unknown, or the frames are not connected at these times.

        """
        with self._lock:
            self._store.check(
                'chain',
                target_frame=target_frame,
                source_frame=source_frame,
                fixed_frame=fixed_frame,
            )
            below = self._between(fixed_frame, source_frame, nanoseconds(source_time))
            above = self._between(target_frame, fixed_frame, nanoseconds(target_time))
        return [*below, *above[1:]]

    def as_yaml(self) -> str:
        """
        Format the frames as YAML, for `tf2_tools view_frames` and the service `tf2_frames`.

        Returns
        -------
        str
            A mapping from each child frame to its parent, broadcaster, rate (Hz) and times (s).

        """
        return ''.join(map(_yaml, self._branches())) or '{}'

    def as_string(self) -> str:
        """Format the frames and their parents as text, one per line."""
        return ''.join(
            f'Frame {branch.frame} exists with parent {branch.parent}.\n'
            for branch in self._branches()
        )

    def as_dot(self) -> str:
        """Format the frame tree as a Graphviz graph."""
        arrows = ''.join(map(_arrow, self._branches()))
        return f'digraph G {{\n{arrows or _NO_DATA}}}\n'

    def _branches(self) -> list[_Branch]:
        """Return all frames that have a parent."""
        with self._lock:
            return [_branch(frame, cache) for frame, cache in self._store.known() if cache.samples]

    def _between(self, target: str, source: str, time_ns: int) -> list[str]:
        """Return the frames from the source up to the common ancestor, then down to the target."""
        time_ns = time_ns or self._store.common_time_ns(target, source)
        route = self._store.route(target, source, time_ns)
        up = [source, *(link.parent for link in route.from_source)]
        down = [target, *(link.parent for link in route.from_target)]
        return [*up, *reversed(down[:-1])]


class FrameIntrospection:
    """
    Base class of buffers that answers, under the names of ROS 2, which frames there are.

    Parameters
    ----------
    known_frames
        The frames of the buffer.

    Attributes
    ----------
    known_frames
        The frames that exist, with their latest samples.

    """

    def __init__(self, known_frames: KnownFrames) -> None:
        self.known_frames = known_frames

    def all_frames_as_yaml(self) -> str:
        """Format the frames, their parents and broadcasters as YAML."""
        return self.known_frames.as_yaml()

    def all_frames_as_string(self) -> str:
        """Format the frames and their parents as text, one per line."""
        return self.known_frames.as_string()

    def _allFramesAsDot(self) -> str:  # noqa: N802
        """Format the frames as a Graphviz graph."""
        return self.known_frames.as_dot()

    def _frameExists(self, frame_id: str) -> bool:  # noqa: N802
        """Whether a frame exists."""
        return self.known_frames.has(frame_id)

    def _getFrameStrings(self) -> list[str]:  # noqa: N802
        """Return the names of all frames."""
        return self.known_frames.names()

    def _chain(
        self,
        target_frame: str,
        target_time: Time,
        source_frame: str,
        source_time: Time,
        fixed_frame: str,
    ) -> list[str]:
        """Return the chain of frames from the source via the fixed frame to the target."""
        return self.known_frames.chain(
            target_frame, target_time, source_frame, source_time, fixed_frame
        )


def _branch(frame: str, cache: Cache) -> _Branch:
    first, last = cache.samples[0], cache.samples[-1]
    latest_s, oldest_s = last.stamp_ns / 1e9, first.stamp_ns / 1e9
    rate_hz = len(cache.samples) / max(latest_s - oldest_s, _SHORTEST_S)
    return _Branch(frame, last.parent, last.authority, rate_hz, latest_s, oldest_s)


def _yaml(branch: _Branch) -> str:
    return (
        f'{_key(branch.frame)}: \n'
        f'  parent: {_yaml_text(branch.parent)}\n'
        f"  broadcaster: '{branch.broadcaster}'\n"
        f'  rate: {branch.rate_hz:.3f}\n'
        f'  most_recent_transform: {branch.latest_s:.6f}\n'
        f'  oldest_transform: {branch.oldest_s:.6f}\n'
        f'  buffer_length: {branch.length_s:.3f}\n'
    )


def _key(frame: str) -> str:
    """Format a frame as a YAML key, quoted if YAML would parse it differently."""
    return frame if _PLAIN.fullmatch(frame) else _yaml_text(frame)


def _yaml_text(text: str) -> str:
    return "'" + text.replace("'", "''") + "'"


def _arrow(branch: _Branch) -> str:
    label = (
        f'Broadcaster: {branch.broadcaster}\\n'
        f'Average rate: {branch.rate_hz:.3f} Hz\\n'
        f'Most recent transform: {branch.latest_s:.6f}\\n'
        f'Buffer length: {branch.length_s:.3f} s\\n'
    )
    return f'{_dot_text(branch.parent)} -> {_dot_text(branch.frame)} [label="{label}"];\n'


def _dot_text(text: str) -> str:
    escaped = text.replace('\\', '\\\\').replace('"', '\\"')
    return f'"{escaped}"'
