# SPDX-License-Identifier: Apache-2.0
"""Poses between frames and their parents, which are asked for most."""

from __future__ import annotations

import math

from geometry_msgs.msg import TransformStamped
import pytest
from rviz_common.frames import FIXED_FRAME, FrameError, Frames, Pose
from tf2_ros import Buffer

HALF = math.sqrt(0.5)


@pytest.fixture
def frames() -> Frames:
    """Return frames of a robot that stands in a map: one that turns, and one that does not."""
    buffer = Buffer()
    for parent, child, x in (('map', 'base', 1.0), ('base', 'arm', 2.0), ('x', 'y', 3.0)):
        transform = TransformStamped(child_frame_id=child)
        transform.header.frame_id = parent
        transform.header.stamp.sec = 5
        transform.transform.translation.x = x
        transform.transform.rotation.z = transform.transform.rotation.w = HALF
        buffer.set_transform(transform, 'test')
    return Frames(buffer, 'map')


def test_down_and_up(frames: Frames) -> None:
    """A frame in its parent is what was said; the parent in the frame is the opposite."""
    assert frames.find('map', 'base') == Pose((1.0, 0.0, 0.0), pytest.approx((HALF, 0, 0, HALF)))
    up = frames.find('base', 'map')
    assert up is not None
    assert up.position == pytest.approx((0.0, 1.0, 0.0))
    assert up.wxyz == pytest.approx((HALF, 0.0, 0.0, -HALF))


@pytest.mark.parametrize('stamp_ns', [0, 5 * 10**9])
def test_short_cut_is_no_other_way(frames: Frames, stamp_ns: int) -> None:
    """With a time or without one, the same comes out."""
    for target, source in (('map', 'base'), ('base', 'map'), ('map', 'arm')):
        found, latest = frames.between(target, source, stamp_ns), frames.find(target, source)
        assert latest is not None
        assert found.position == pytest.approx(latest.position)
        assert found.wxyz == pytest.approx(latest.wxyz)


def test_several_hops(frames: Frames) -> None:
    """Frames that are not next to each other are found as well."""
    assert frames.find(FIXED_FRAME, 'arm').position == pytest.approx((1.0, 2.0, 0.0))
    assert frames.find('arm', 'arm') == Pose()


@pytest.mark.parametrize('source', ['nobody', 'y', ''])
def test_nowhere(frames: Frames, source: str) -> None:
    """What is not known is None, and the reason can be asked for."""
    assert frames.find('map', source) is None
    assert frames.reason('map', source).startswith(f'No transform from [{source}] to [map]: ')
    with pytest.raises(FrameError):
        frames.between('map', source)


def test_no_reason(frames: Frames) -> None:
    """There is no reason for what is known."""
    assert frames.reason('map', 'arm') == ''


def test_latest(frames: Frames) -> None:
    """All frames with a parent can be had at once."""
    assert {name: sample.parent for name, sample in frames.latest().items()} == {
        'base': 'map',
        'arm': 'base',
        'y': 'x',
    }
