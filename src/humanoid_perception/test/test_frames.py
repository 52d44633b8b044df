# SPDX-License-Identifier: Apache-2.0
"""Test which pictures are looked at, and with which depth."""

from __future__ import annotations

from humanoid_perception.frames import FramePairs, stamp_in
import pytest
from rclpy.serialization import serialize_message
from sensor_msgs.msg import Image


def named(stamp_s: float) -> bytes:
    """Return the data of a message of a time."""
    return f'{stamp_s:.3f}'.encode()


def test_a_picture_waits_for_its_depth():
    pairs = FramePairs(0.2, 0.01)
    pairs.add_depth(0.9, named(0.9), 0.0)
    pairs.add_color(1.0, named(1.0), 0.1)
    assert pairs.take(0.1) is None
    pairs.add_depth(1.0, named(1.0), 0.15)
    frame = pairs.take(0.15)
    assert frame is not None
    assert (frame.color, frame.depth) == (named(1.0), named(1.0))
    assert pairs.take(0.16) is None


def test_depth_that_stays_away_is_waited_for_a_moment_only():
    pairs = FramePairs(0.2, 0.01)
    pairs.add_depth(0.9, named(0.9), 0.0)
    pairs.add_color(1.0, named(1.0), 0.1)
    assert pairs.take(0.3) is None
    frame = pairs.take(0.5)
    assert frame is not None
    assert frame.depth is None
    pairs.add_color(2.0, named(2.0), 1.5)
    frame = pairs.take(1.5)
    assert frame is not None
    assert frame.depth is None


def test_depth_of_another_time_fits_if_it_is_close_enough():
    pairs = FramePairs(0.2, 0.02)
    for stamp_s in (0.95, 0.985, 1.05):
        pairs.add_depth(stamp_s, named(stamp_s), 0.0)
    pairs.add_color(1.0, named(1.0), 0.0)
    frame = pairs.take(0.0)
    assert frame is not None
    assert frame.depth == named(0.985)


def test_the_first_picture_waits_too():
    pairs = FramePairs(0.2, 0.01)
    pairs.add_color(1.0, named(1.0), 0.0)
    assert pairs.take(0.1) is None
    pairs.add_depth(1.0, named(1.0), 0.1)
    frame = pairs.take(0.1)
    assert frame is not None
    assert frame.depth == named(1.0)


@pytest.mark.parametrize(('rate_hz', 'expected'), [(30.0, 6), (10.0, 5), (4.0, 4), (5.0, 5)])
def test_pictures_that_come_too_fast_are_dropped(rate_hz: float, expected: int):
    pairs = FramePairs(0.2, 0.01)
    taken = []
    for number in range(round(rate_hz)):
        stamp_s = 7.0 + number / rate_hz
        pairs.add_depth(stamp_s, named(stamp_s), stamp_s)
        pairs.add_color(stamp_s, named(stamp_s), stamp_s)
        frame = pairs.take(stamp_s)
        if frame:
            taken.append(frame.stamp_s)
    assert expected - 1 <= len(taken) <= expected
    assert all(later - before >= 0.19 for before, later in zip(taken, taken[1:]))


def test_a_slow_detector_gets_the_newest_picture():
    pairs = FramePairs(0.0, 0.01)
    for number in range(100):
        pairs.add_color(number / 30.0, named(number / 30.0), 0.0)
        pairs.add_depth(number / 30.0, named(number / 30.0), 0.0)
    frame = pairs.take(0.0)
    assert frame is not None
    assert frame.stamp_s == pytest.approx(99 / 30.0)
    assert pairs.take(10.0) is None


def test_depth_that_is_always_late_is_still_used():
    pairs = FramePairs(0.0, 0.001)
    with_depth = 0
    for number in range(60):
        now_s = number / 30.0
        pairs.add_color(now_s, named(now_s), now_s)
        pairs.add_depth(now_s - 2 / 30.0, named(now_s - 2 / 30.0), now_s)
        frame = pairs.take(now_s)
        with_depth += frame is not None and frame.depth is not None
    assert with_depth > 50


def test_after_a_reset_pictures_are_looked_at_again():
    pairs = FramePairs(0.2, 0.01)
    pairs.add_color(100.0, named(100.0), 0.0)
    assert pairs.take(0.5) is not None
    pairs.add_color(0.1, named(0.1), 0.5)
    frame = pairs.take(1.0)
    assert frame is not None
    assert frame.stamp_s == 0.1


def test_the_stamp_is_read_from_a_serialized_message():
    image = Image()
    image.header.stamp.sec, image.header.stamp.nanosec = 1234, 500_000_000
    image.header.frame_id = 'camera'
    assert stamp_in(serialize_message(image)) == 1234.5
