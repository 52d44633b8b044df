# SPDX-License-Identifier: Apache-2.0
"""Frame tree with transform samples over time."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from tf2_py.exceptions import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
)
from tf2_py.poses import chain, IDENTITY, inverse, Pose
from tf2_py.route import (
    empty_frame,
    extrapolation,
    find_route,
    Route,
    slashed_frame,
    Unconnected,
    unconnected_frames,
    unknown_frame,
)
from tf2_py.samples import Link, Sample, StaticCache, TimeCache

Cache = TimeCache | StaticCache


class _Latest(NamedTuple):
    """The latest link of a frame; static frames have no time."""

    parent: str
    stamp_ns: int | None


class FrameStore:
    """
    Transform samples by frame name, independent of messages and threads.

    Parameters
    ----------
    cache_ns
        The length of the buffer for moving frames, in ns.

    """

    def __init__(self, cache_ns: int) -> None:
        self.cache_ns = cache_ns
        # Frames that are known only as parents have no cache.
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
            The parent, pose, time and broadcaster of the frame.
        is_static
            Whether the sample holds at all times.

        Returns
        -------
        bool
            False if the sample was dropped because it is older than the buffer.

        """
        cache = self._caches.get(frame)
        if cache is None or cache.is_static != is_static:
            cache = StaticCache() if is_static else TimeCache(self.cache_ns)
            self._caches[frame] = cache
        self._caches.setdefault(sample.parent, None)
        return cache.insert(sample)

    def changes_kind(self, frame: str, is_static: bool) -> bool:
        """
        Check whether a sample would change a frame between static and moving.

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
        """Remove the samples of moving frames."""
        for _, cache in self.known():
            cache.clear()

    def names(self) -> list[str]:
        """Return the names of all frames."""
        return list(self._caches)

    def has(self, *frames: str) -> bool:
        """
        Check whether all frames are known, including those known only as parents.

        Parameters
        ----------
        *frames
            The frame names, all of which must be known.

        """
        return all(frame in self._caches for frame in frames)

    def known(self) -> Iterator[tuple[str, Cache]]:
        """Yield the frames that have a cache, that is, not only a name."""
        return ((frame, cache) for frame, cache in self._caches.items() if cache is not None)

    def latest(self, frame: str) -> Sample | None:
        """
        Return the latest sample of a frame.

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
            A name is empty or starts with a slash.
        LookupException
            The frame does not exist.

        """
        for argument, frame in frames.items():
            if frame in self._caches:
                continue
            if not frame:
                raise InvalidArgumentException(empty_frame(call, argument))
            if frame.startswith('/'):
                raise InvalidArgumentException(slashed_frame(call, argument, frame))
            raise LookupException(unknown_frame(call, argument, frame, self._caches))

    def pose(self, target: str, source: str, time_ns: int) -> Pose:
        """
        Compute the pose of the source frame in the target frame.

        Parameters
        ----------
        target, source
            The frames, which must be known.
        time_ns
            The time in ns; 0 is not treated as the latest time here.

        Returns
        -------
        Pose
            Translation in m and quaternion x, y, z, w.

        Raises
        ------
        ConnectivityException
            The frames are in different trees.
        ExtrapolationException
            The samples do not cover that time.
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
            The time in ns; 0 is not treated as the latest time here.

        Raises
        ------
        ConnectivityException
            The frames are in different trees.
        ExtrapolationException
            The samples do not cover that time.
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
            text = extrapolation(error.gap, target, source)
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
        return ConnectivityException(unconnected_frames(target, source, roots))

    def _root(self, frame: str) -> str:
        seen = {frame}
        above = self._latest_link(frame)
        while above is not None and above.parent not in seen:
            frame = above.parent
            seen.add(frame)
            above = self._latest_link(frame)
        return frame


def _pose_above(links: list[Link]) -> Pose:
    """Chain the poses of links: the pose of the first frame in the last parent."""
    pose = IDENTITY
    for link in links:
        pose = chain(link.pose(), pose)
    return pose
