# SPDX-License-Identifier: Apache-2.0
"""Why there is no transform, in sentences."""

from __future__ import annotations

import logging

import pytest
from rclpy.duration import Duration
from rclpy.time import Time
from tf2_messages import at, numbers, stamped
from tf2_py import (
    BufferCore,
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)


@pytest.fixture
def buffer() -> BufferCore:
    """Return a buffer with two trees."""
    buffer = BufferCore()
    for time in (10.0, 12.0):
        buffer.set_transform(stamped('map', 'odom', time), 'test')
        buffer.set_transform(stamped('odom', 'base_link', time), 'test')
    buffer.set_transform_static(stamped('mars', 'rover'), 'test')
    buffer.set_transform(stamped('map', 'single', 11.0), 'test')
    return buffer


def reason(buffer: BufferCore, target: str, source: str, time: Time) -> TransformException:
    """Return why a look-up fails; that it can succeed must be denied alike."""
    with pytest.raises(TransformException) as caught:
        buffer.lookup_transform_core(target, source, time)
    assert not buffer.can_transform_core(target, source, time)[0]
    return caught.value


def test_hierarchy() -> None:
    """All exceptions are TransformExceptions."""
    for kind in (
        ConnectivityException,
        ExtrapolationException,
        InvalidArgumentException,
        LookupException,
        TimeoutException,
    ):
        assert issubclass(kind, TransformException)


def test_misspelt_frame(buffer: BufferCore) -> None:
    """The frame that is meant is named."""
    error = reason(buffer, 'map', 'base_lnk', at(0))
    assert isinstance(error, LookupException)
    assert str(error) == (
        '"base_lnk" passed to lookupTransform argument source_frame does not exist. '
        "Did you mean 'base_link'?"
    )
    assert buffer.can_transform_core('base_lnk', 'map', at(0))[1] == (
        'Invalid frame ID "base_lnk" passed to canTransform argument target_frame - frame does '
        "not exist. Did you mean 'base_link'?"
    )


def test_unknown_frame(buffer: BufferCore) -> None:
    """Without a similar name all names are listed; without any frame that is said."""
    text = str(reason(buffer, 'xyzzy', 'map', at(0)))
    assert text.endswith('The frames are: base_link, map, mars, odom, rover, single')
    text = str(reason(BufferCore(), 'map', 'odom', at(0)))
    assert text.endswith('There are no frames yet: nothing was received on /tf and /tf_static')


@pytest.mark.parametrize(
    ('frame', 'end'),
    [('', 'in tf2 frame_ids cannot be empty'), ('/map', "cannot start with a '/'. Write 'map'")],
)
def test_impossible_names(buffer: BufferCore, frame: str, end: str) -> None:
    """An empty name and one with a slash are refused."""
    error = reason(buffer, frame, 'odom', at(0))
    assert isinstance(error, InvalidArgumentException) and str(error).endswith(end)


def test_two_trees(buffer: BufferCore) -> None:
    """The roots are named between which something is missing."""
    for time in (at(0), at(11.0)):
        error = reason(buffer, 'base_link', 'rover', time)
        assert isinstance(error, ConnectivityException)
        assert str(error).startswith(
            "Could not find a connection between 'base_link' and 'rover' because they are not "
            'part of the same tree. Tf has two or more unconnected trees. '
        )
        assert "'base_link' is below 'map', 'rover' is below 'mars': no node" in str(error)
    error = reason(buffer, 'map', 'rover', at(0))
    assert "'map' is a root, 'rover' is below 'mars': no node publishes" in str(error)


@pytest.mark.parametrize(
    ('time_s', 'text'),
    [
        (
            12.25,
            'Lookup would require extrapolation into the future.  Requested time 12.250000 but '
            'the latest data is at time 12.000000, when looking up transform from frame '
            '[base_link] to frame [map]. That is 0.250 s ahead: pass a timeout',
        ),
        (
            9.5,
            'Lookup would require extrapolation into the past.  Requested time 9.500000 but '
            'the earliest data is at time 10.000000, when looking up transform from frame '
            '[base_link] to frame [map]. That is 0.500 s too early',
        ),
        (99.0, 'That is 87 s ahead: is use_sim_time the same everywhere?'),
    ],
)
def test_extrapolation(buffer: BufferCore, time_s: float, text: str) -> None:
    """How far off the time is, and what to do."""
    error = reason(buffer, 'map', 'base_link', at(time_s))
    assert isinstance(error, ExtrapolationException) and text in str(error)
    assert isinstance(reason(buffer, 'base_link', 'map', at(time_s)), ExtrapolationException)


def test_extrapolation_of_one_sample(buffer: BufferCore) -> None:
    """One sample holds at its time only."""
    assert buffer.can_transform_core('map', 'single', at(11.0))[0]
    assert str(reason(buffer, 'map', 'single', at(11.5))).startswith(
        'Lookup would require extrapolation at time 11.500000, but only time 11.000000 is in the '
        'buffer, when looking up transform from frame [single] to frame [map]'
    )


def test_full_lookup(buffer: BufferCore) -> None:
    """The full look-up checks all three frames and both times."""
    with pytest.raises(LookupException, match='argument fixed_frame does not exist'):
        buffer.lookup_transform_full_core('map', at(11), 'odom', at(11), 'nowhere')
    with pytest.raises(ExtrapolationException):
        buffer.lookup_transform_full_core('odom', at(50), 'base_link', at(11), 'map')
    assert not buffer.can_transform_full_core('odom', at(11), 'base_link', at(50), 'map')[0]


def test_loop(buffer: BufferCore) -> None:
    """A loop is named instead of being followed for ever."""
    for parent, child in (('a', 'b'), ('b', 'c'), ('c', 'a')):
        buffer.set_transform_static(stamped(parent, child), 'test')
    error = reason(buffer, 'map', 'a', at(0))
    assert 'contains a loop. From child to parent: ' in str(error)
    assert {'a', 'b', 'c'} <= set(str(error).split(': ')[1].split('. ')[0].split(' -> '))


@pytest.mark.parametrize(
    ('change', 'text'),
    [
        ({'rotation': (0, 0, 0, 0)}, 'invalid quaternion in the transform (0 0 0 0)'),
        ({'rotation': (0, 0, 0, 2)}, 'its length must be 1'),
        ({'translation': (float('nan'), 0, 0)}, 'a nan or infinite value in the transform (nan'),
        ({'child': 'map'}, 'with frame_id and child_frame_id "map" because they are the same'),
        ({'child': ''}, 'because child_frame_id is not set'),
        ({'parent': ''}, 'because frame_id is not set'),
    ],
)
def test_bad_transforms(
    caplog: pytest.LogCaptureFixture, change: dict[str, object], text: str
) -> None:
    """What cannot be a transform is not taken, and this is said once in a while."""
    buffer = BufferCore()
    for _ in range(5):
        buffer.set_transform(stamped(**{'parent': 'map', 'child': 'odom', **change}), 'me')
    assert buffer.all_frames_as_string() == ''
    assert [text in record.message for record in caplog.records] == [True]
    assert caplog.records[0].levelno == logging.WARNING


def test_old_data(buffer: BufferCore, caplog: pytest.LogCaptureFixture) -> None:
    """A transform older than the cache is not taken, and this is said."""
    buffer.set_transform(stamped('map', 'odom', 1.5, (9, 9, 9)), 'late')
    assert caplog.records[0].message.startswith(
        'TF_OLD_DATA ignoring data from the past for frame odom at time 1.500000 according to '
        'authority late: the latest is from 12.000000, and 10 s are kept.'
    )
    assert not buffer.can_transform_core('map', 'odom', at(1.5))[0]


def test_cache_time() -> None:
    """How much is kept can be chosen."""
    buffer = BufferCore(Duration(seconds=1.0))
    for time in (1.0, 2.5):
        buffer.set_transform(stamped('map', 'odom', time), 'test')
    assert isinstance(reason(buffer, 'map', 'odom', at(1.2)), ExtrapolationException)


def test_long_chain() -> None:
    """Chains may have a thousand links; longer ones are refused like loops."""
    buffer = BufferCore()
    for number in range(1001):
        message = stamped(f'f{number}', f'f{number + 1}', 0.0, (1, 0, 0))
        buffer.set_transform_static(message, 'me')
    assert numbers(buffer.lookup_transform_core('f0', 'f1000', at(0)))[0] == 1000
    with pytest.raises(LookupException, match='a chain of more than 1000 frames'):
        buffer.lookup_transform_core('f0', 'f1001', at(0))
