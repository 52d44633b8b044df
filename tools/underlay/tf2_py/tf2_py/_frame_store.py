# SPDX-License-Identifier: Apache-2.0
"""The frames, and the way between two of them at a time."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from tf2_py import _reasons
from tf2_py._link import Link, Sample
from tf2_py._pose import chain, IDENTITY, inverse, Pose
from tf2_py._route import find_route, Route, Unconnected
from tf2_py._static_cache import StaticCache
from tf2_py._time_cache import TimeCache
from tf2_py.exceptions import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
)

Cache = TimeCache | StaticCache


class _Latest(NamedTuple):
    """The newest link of a frame; one that does not move has no time."""

    parent: str
    stamp_ns: int | None


class FrameStore:
    """
    Samples of frames by the frame's name. It knows neither messages nor threads.

    Parameters
    ----------
    cache_ns
        How much of the past is kept for moving frames, in ns.

    """

    def __init__(self, cache_ns: int) -> None:
        self.cache_ns = cache_ns
        # A frame that is only known as a parent has no cache.
        self._caches: dict[str, Cache | None] = {}

    def insert(self, frame: str, sample: Sample, is_static: bool) -> bool:
        """
        Insert a sample of a frame.

        A frame that changes between static and moving loses its earlier samples.

        Parameters
        ----------
        frame
            The child frame.
        sample
            Its parent, pose, time and broadcaster.
        is_static
            Whether the sample holds at all times.

        Returns
        -------
        bool
            False if the sample is older than what is kept, and so was left out.

        """
        cache = self._caches.get(frame)
        if cache is None or cache.is_static != is_static:
            cache = StaticCache() if is_static else TimeCache(self.cache_ns)
            self._caches[frame] = cache
        self._caches.setdefault(sample.parent, None)
        return cache.insert(sample)

    def changes_kind(self, frame: str, is_static: bool) -> bool:
        """
        Check whether a sample would turn a static frame into a moving one, or the other way round.

        Parameters
        ----------
        frame
            The child frame.
        is_static
            Whether the sample holds at all times.

        """
        cache = self._caches.get(frame)
        return cache is not None and cache.is_static != is_static

    def clear(self) -> None:
        """Forget what moves."""
        for _, cache in self.known():
            cache.clear()

    def names(self) -> list[str]:
        """Return the names of all frames."""
        return list(self._caches)

    def has(self, *frames: str) -> bool:
        """
        Check whether frames are known, be it only as parents.

        Parameters
        ----------
        *frames
            Their names, all of which must be known.

        """
        return all(frame in self._caches for frame in frames)

    def known(self) -> Iterator[tuple[str, Cache]]:
        """Yield the frames of which more is known than the name."""
        return ((frame, cache) for frame, cache in self._caches.items() if cache is not None)

    def latest(self, frame: str) -> Sample | None:
        """
        Look up the newest sample of a frame.

        Parameters
        ----------
        frame
            The child frame.

        Returns
        -------
        Sample or None
            None if the frame has no parent.

        """
        cache = self._caches.get(frame)
        return None if cache is None else cache.latest()

    def check(self, call: str, **frames: str) -> None:
        """
        Validate the frame names of a call.

        Parameters
        ----------
        call
            The name of the call, for the error message: 'lookupTransform'.
        **frames
            The names by argument, such as `target_frame`.

        Raises
        ------
        InvalidArgumentException
            A name is empty or begins with a slash.
        LookupException
            There is no such frame.

        """
        for argument, frame in frames.items():
            if frame in self._caches:
                continue
            if not frame:
                raise InvalidArgumentException(_reasons.empty_frame(call, argument))
            if frame.startswith('/'):
                raise InvalidArgumentException(_reasons.slashed_frame(call, argument, frame))
            raise LookupException(_reasons.unknown_frame(call, argument, frame, self._caches))

    def pose(self, target: str, source: str, time_ns: int) -> Pose:
        """
        Compute the pose of the source frame in the target frame.

        Parameters
        ----------
        target, source
            The frames, which must be known.
        time_ns
            The time in ns; here 0 does not stand for the latest one.

        Returns
        -------
        Pose
            Translation in m and quaternion x, y, z, w.

        Raises
        ------
        ConnectivityException
            The frames are in different trees.
        ExtrapolationException
            There are no samples around that time.
        LookupException
            The parents form a loop.

        """
        route = self.route(target, source, time_ns)
        return chain(inverse(_pose_above(route.from_target)), _pose_above(route.from_source))

    def route(self, target: str, source: str, time_ns: int) -> Route[Link]:
        """
        Find the links from two frames up to their common ancestor.

        Parameters
        ----------
        target, source
            The frames, which must be known.
        time_ns
            The time in ns; here 0 does not stand for the latest one.

        Raises
        ------
        ConnectivityException
            The frames are in different trees.
        ExtrapolationException
            There are no samples around that time.
        LookupException
            The parents form a loop.

        """

        def link_of(frame: str) -> Link | None:
            cache = self._caches[frame]
            return None if cache is None else cache.link_at(time_ns)

        try:
            return find_route(source, target, link_of)
        except Unconnected as error:
            if error.gap is None:
                raise self._unconnected(target, source) from None
            text = _reasons.extrapolation(error.gap, target, source)
            raise ExtrapolationException(text) from None

    def common_time_ns(self, target: str, source: str) -> int:
        """
        Find the latest time at which the whole chain between two frames is known.

        Parameters
        ----------
        target, source
            The frames, which must be known.

        Returns
        -------
        int
            The time in ns; 0 if all transforms between them are static.

        Raises
        ------
        ConnectivityException
            The frames are in different trees.
        LookupException
            The parents form a loop.

        """
        if target == source:
            sample = self.latest(source)
            return sample.stamp_ns if sample is not None else 0
        try:
            route = find_route(source, target, self._latest_link)
        except Unconnected:
            raise self._unconnected(target, source) from None
        steps = [*route.from_source, *route.from_target]
        return min((step.stamp_ns for step in steps if step.stamp_ns is not None), default=0)

    def _latest_link(self, frame: str) -> _Latest | None:
        cache = self._caches[frame]
        sample = None if cache is None else cache.latest()
        if cache is None or sample is None:
            return None
        return _Latest(sample.parent, None if cache.is_static else sample.stamp_ns)

    def _unconnected(self, target: str, source: str) -> ConnectivityException:
        roots = self._root(target), self._root(source)
        return ConnectivityException(_reasons.unconnected(target, source, roots))

    def _root(self, frame: str) -> str:
        seen = {frame}
        above = self._latest_link(frame)
        while above is not None and above.parent not in seen:
            frame = above.parent
            seen.add(frame)
            above = self._latest_link(frame)
        return frame


def _pose_above(links: list[Link]) -> Pose:
    """Return the pose of the first frame in the one above all links."""
    pose = IDENTITY
    for link in links:
        pose = chain(link.pose(), pose)
    return pose
