# SPDX-License-Identifier: Apache-2.0
"""Cache for the transform of a static frame."""

from __future__ import annotations

from collections.abc import Sequence

from tf2_py._link import Link, Sample


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
        self._sample = sample._replace(stamp_ns=0)
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
