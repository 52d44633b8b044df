# SPDX-License-Identifier: Apache-2.0
"""What a frame's cache keeps."""

from __future__ import annotations

import random

import pytest
from tf2_py.samples import Gap, Sample, StaticCache, TimeCache

S = 10**9


def sample(time_s: float, x: float = 0.0, parent: str = 'map') -> Sample:
    """Return a sample."""
    return Sample(round(time_s * S), parent, (x, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0), 'test')


def filled(*times_s: float) -> TimeCache:
    """Return a cache of 10 s with samples, whose x is their time."""
    cache = TimeCache(10 * S)
    for time_s in times_s:
        cache.insert(sample(time_s, time_s))
    return cache


def stamps_s(cache: TimeCache) -> list[float]:
    """Return the times of the samples."""
    return [item.stamp_ns / S for item in cache.samples]


def test_order() -> None:
    """Samples may come in any order."""
    times_s = [float(number) for number in range(8)]
    shuffled = random.Random(3).sample(times_s, len(times_s))
    cache = filled(*shuffled)
    assert stamps_s(cache) == times_s
    link = cache.link_at(round(4.25 * S))
    assert link is not None and link.pose()[0] == pytest.approx(4.25)


def test_length() -> None:
    """What is older than the cache time goes, and what comes too late is not taken."""
    cache = filled(1.0, 2.0, 5.0, 12.0)
    assert stamps_s(cache) == [2.0, 5.0, 12.0]
    assert not cache.insert(sample(1.9))
    assert cache.insert(sample(2.5))
    assert stamps_s(cache) == [2.0, 2.5, 5.0, 12.0]


def test_same_time() -> None:
    """The last sample of a time counts."""
    cache = filled(1.0, 2.0, 3.0)
    for time_s in (1.0, 2.0, 3.0):
        assert cache.insert(sample(time_s, 7.0))
    assert stamps_s(cache) == [1.0, 2.0, 3.0]
    assert [item.pose[0] for item in cache.samples] == [7.0, 7.0, 7.0]


@pytest.mark.parametrize('time_s', [0.5, 3.5])
def test_gaps(time_s: float) -> None:
    """Before the first and after the last sample there is nothing."""
    with pytest.raises(Gap) as caught:
        filled(1.0, 2.0, 3.0).link_at(round(time_s * S))
    gap = caught.value
    assert (gap.requested_ns, gap.oldest_ns, gap.latest_ns) == (round(time_s * S), S, 3 * S)


def test_empty() -> None:
    """A cache without samples leads nowhere."""
    cache = filled(1.0)
    cache.clear()
    assert cache.link_at(S) is None and cache.latest() is None
    assert StaticCache().link_at(S) is None


def test_static() -> None:
    """One sample holds at all times, and survives a clear; another one replaces it."""
    cache = StaticCache()
    cache.insert(sample(100.0, 1.0))
    cache.insert(sample(50.0, 2.0))
    cache.clear()
    for time_s in (0, 1, 1000):
        link = cache.link_at(time_s * S)
        assert link is not None and link.pose()[0] == 2.0
    assert [item.stamp_ns for item in cache.samples] == [0]


def test_oldest_sample_that_is_taken() -> None:
    """A sample just as old as what is kept is taken, and an older one is not."""
    cache = filled(20.0)
    assert cache.insert(sample(10.0))
    assert not cache.insert(sample(9.999))
    assert stamps_s(cache) == [10.0, 20.0]
