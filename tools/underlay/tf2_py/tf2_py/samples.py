# SPDX-License-Identifier: Apache-2.0
"""The transforms of a frame over time, and the link to its parent at one time."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from typing import NamedTuple

from tf2_py.poses import interpolate, Pose


class Sample(NamedTuple):
    """A transform of a frame as received from a broadcaster."""

    stamp_ns: int
    parent: str
    pose: Pose
    authority: str


class Link(NamedTuple):
    """The link from a frame to its parent, interpolated between two samples."""

    parent: str
    earlier: Pose
    later: Pose
    fraction: float

    def pose(self) -> Pose:
        """Return the pose of the frame in its parent."""
        if not self.fraction:
            return self.earlier
        return interpolate(self.earlier, self.later, self.fraction)


class Gap(Exception):
    """The samples do not cover the requested time."""

    def __init__(self, requested_ns: int, oldest_ns: int, latest_ns: int) -> None:
        super().__init__()
        self.requested_ns = requested_ns
        self.oldest_ns = oldest_ns
        self.latest_ns = latest_ns


class TimeCache:
    """
    The samples of a moving frame, sorted by time.

    Parameters
    ----------
    duration_ns
        The length of the cache before the latest sample, in ns.

    """

    is_static = False

    def __init__(self, duration_ns: int) -> None:
        self._duration_ns = duration_ns
        self._stamps_ns: list[int] = []
        self._samples: list[Sample] = []

    @property
    def samples(self) -> Sequence[Sample]:
        """Return the samples, oldest first."""
        return self._samples

    def insert(self, sample: Sample) -> bool:
        """
        Insert a sample; it replaces one with the same time.

        Parameters
        ----------
        sample
            The parent, pose, time and broadcaster.

        Returns
        -------
        bool
            False if the sample was dropped because it is older than the buffer.

        """
        stamps_ns = self._stamps_ns
        stamp_ns = sample.stamp_ns
        if not stamps_ns or stamp_ns > stamps_ns[-1]:
            stamps_ns.append(stamp_ns)
            self._samples.append(sample)
            self._prune(stamp_ns - self._duration_ns)
            return True
        if stamp_ns < stamps_ns[-1] - self._duration_ns:
            return False
        index = bisect_left(stamps_ns, stamp_ns)
        end = index + (stamps_ns[index] == stamp_ns)
        stamps_ns[index:end] = [stamp_ns]
        self._samples[index:end] = [sample]
        return True

    def link_at(self, time_ns: int) -> Link | None:
        """
        Interpolate the link to the parent at a time.

        Between samples with different parents, the earlier sample is used.

        Parameters
        ----------
        time_ns
            The time in ns.

        Returns
        -------
        Link or None
            None if there are no samples.

        Raises
        ------
        Gap
            The time is outside the range of the samples.

        """
        stamps_ns = self._stamps_ns
        index = bisect_right(stamps_ns, time_ns) - 1
        if index < 0:
            if not stamps_ns:
                return None
            raise Gap(time_ns, stamps_ns[0], stamps_ns[-1])
        earlier = self._samples[index]
        begin_ns = earlier.stamp_ns
        if begin_ns == time_ns:
            return Link(earlier.parent, earlier.pose, earlier.pose, 0.0)
        if index + 1 == len(stamps_ns):
            raise Gap(time_ns, stamps_ns[0], stamps_ns[-1])
        later = self._samples[index + 1]
        if earlier.parent != later.parent:
            return Link(earlier.parent, earlier.pose, earlier.pose, 0.0)
        fraction = (time_ns - begin_ns) / (later.stamp_ns - begin_ns)
        return Link(earlier.parent, earlier.pose, later.pose, fraction)

    def latest(self) -> Sample | None:
        """Return the latest sample."""
        return self._samples[-1] if self._samples else None

    def clear(self) -> None:
        """Remove all samples."""
        self._stamps_ns.clear()
        self._samples.clear()

    def _prune(self, oldest_ns: int) -> None:
        if self._stamps_ns[0] >= oldest_ns:
            return
        count = bisect_left(self._stamps_ns, oldest_ns)
        del self._stamps_ns[:count]
        del self._samples[:count]


class StaticCache:
    """The single sample of a static frame, valid at all times."""

    is_static = True

    def __init__(self) -> None:
        """Create a cache without a sample."""
        self._sample: Sample | None = None
        self._link: Link | None = None

    @property
    def samples(self) -> Sequence[Sample]:
        """Return the sample, if any, in a sequence."""
        return [] if self._sample is None else [self._sample]

    def insert(self, sample: Sample) -> bool:
        """
        Replace the sample.

        Parameters
        ----------
        sample
            The new sample, whose time is ignored.

        Returns
        -------
        bool
            True, as a static sample is never too old.

        """
        self._sample = Sample(0, sample.parent, sample.pose, sample.authority)
        self._link = Link(sample.parent, sample.pose, sample.pose, 0.0)
        return True

    def link_at(self, time_ns: int) -> Link | None:
        """
        Return the link to the parent, which is the same at all times.

        Parameters
        ----------
        time_ns
            Ignored.

        Returns
        -------
        Link or None
            None without a sample.

        """
        return self._link

    def latest(self) -> Sample | None:
        """Return the sample."""
        return self._sample

    def clear(self) -> None:
        """Keep the sample, as static transforms remain valid after a time jump."""
