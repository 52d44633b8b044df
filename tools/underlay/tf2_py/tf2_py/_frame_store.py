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
    """Samples of frames by the frame's name. It knows neither messages nor threads."""

    def __init__(self, cache_ns: int) -> None:
        """Create a store that keeps this much of the past."""
        self.cache_ns = cache_ns
        # A frame that is only known as a parent has no cache.
        self._caches: dict[str, Cache | None] = {}

    def insert(self, frame: str, sample: Sample, is_static: bool) -> bool:
        """Take a sample of a frame; return False if it is too old."""
        cache = self._caches.get(frame)
        if cache is None or cache.is_static != is_static:
            cache = StaticCache() if is_static else TimeCache(self.cache_ns)
            self._caches[frame] = cache
        self._caches.setdefault(sample.parent, None)
        return cache.insert(sample)

    def changes_kind(self, frame: str, is_static: bool) -> bool:
        """Tell if a frame has been static and begins to move, or the other way round."""
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
        """Tell if all these are names of frames."""
        return all(frame in self._caches for frame in frames)

    def known(self) -> Iterator[tuple[str, Cache]]:
        """Yield the frames of which more is known than the name."""
        return ((frame, cache) for frame, cache in self._caches.items() if cache is not None)

    def latest(self, frame: str) -> Sample | None:
        """Return the newest sample of a frame."""
        cache = self._caches.get(frame)
        return None if cache is None else cache.latest()

    def check(self, call: str, **frames: str) -> None:
        """Raise unless all these arguments of a call are names of known frames."""
        for argument, frame in frames.items():
            if frame in self._caches:
                continue
            if not frame:
                raise InvalidArgumentException(_reasons.empty_frame(call, argument))
            if frame.startswith('/'):
                raise InvalidArgumentException(_reasons.slashed_frame(call, argument, frame))
            raise LookupException(_reasons.unknown_frame(call, argument, frame, self._caches))

    def pose(self, target: str, source: str, time_ns: int) -> Pose:
        """Return the pose of the source in the target at a time that is not 0."""
        route = self.route(target, source, time_ns)
        return chain(inverse(_pose_above(route.from_target)), _pose_above(route.from_source))

    def route(self, target: str, source: str, time_ns: int) -> Route[Link]:
        """Return the links between two frames at a time."""

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
        """Return the newest time at which all between two frames is known; 0 if nothing moves."""
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
