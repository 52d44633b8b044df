# SPDX-License-Identifier: Apache-2.0
"""The rest of a buffer: texts, clear, slashes, both kinds of topics, and threads."""

from __future__ import annotations

import threading

import pytest
from rclpy.duration import Duration
from tf2_messages import at, numbers, stamped
from tf2_py import BufferCore
from tf2_py.intake import Complaints
import yaml


@pytest.fixture
def buffer() -> BufferCore:
    """Return a buffer with one frame that moves and one that does not."""
    buffer = BufferCore()
    for number in range(11):
        buffer.set_transform(stamped('map', 'base', 1.0 + number / 10, (number, 0, 0)), 'me')
    buffer.set_transform_static(stamped('base', 'camera'), 'you')
    return buffer


def test_yaml(buffer: BufferCore) -> None:
    """The frames with parent, broadcaster and times; {} without frames."""
    frames = yaml.safe_load(buffer.all_frames_as_yaml())
    assert frames['base'] == {
        'parent': 'map',
        'broadcaster': 'me',
        'rate': 11.0,
        'most_recent_transform': 2.0,
        'oldest_transform': 1.0,
        'buffer_length': 1.0,
    }
    assert frames['camera']['rate'] == 10000.0
    assert BufferCore().all_frames_as_yaml() == '{}'


def test_other_texts(buffer: BufferCore) -> None:
    """The frames as sentences, as a graph and as names."""
    assert buffer.all_frames_as_string() == (
        'Frame base exists with parent map.\nFrame camera exists with parent base.\n'
    )
    graph = buffer._allFramesAsDot()
    assert graph.startswith('digraph G {\n"map" -> "base" [label="Broadcaster: me\\n')
    assert '"no tf data"' in BufferCore()._allFramesAsDot()
    assert sorted(buffer._getFrameStrings()) == ['base', 'camera', 'map']
    assert buffer._frameExists('map') and not buffer._frameExists('nap')


def test_chain(buffer: BufferCore) -> None:
    """The frames between two, in order."""
    buffer.set_transform_static(stamped('base', 'arm'), 'me')
    arguments = (at(0), 'arm', at(0), 'base')
    assert buffer._chain('camera', *arguments) == ['arm', 'base', 'camera']
    assert buffer._chain('map', *arguments) == ['arm', 'base', 'map']


def test_clear(buffer: BufferCore) -> None:
    """What moves is forgotten, what does not move stays; older data come in again."""
    buffer.clear()
    assert not buffer.can_transform_core('map', 'base', at(0))[0]
    assert buffer.can_transform_core('base', 'camera', at(0))[0]
    buffer.set_transform(stamped('map', 'base', 0.5), 'me')
    assert buffer.lookup_transform_core('map', 'camera', at(0)).header.stamp == at(0.5).to_msg()


def test_slashes() -> None:
    """A slash in front of a broadcaster's names is taken away."""
    buffer = BufferCore()
    buffer.set_transform_static(stamped('/map', '/odom'), 'me')
    assert buffer.can_transform_core('map', 'odom', at(0))[0]


def test_a_frame_that_begins_to_move(buffer: BufferCore, caplog: pytest.LogCaptureFixture) -> None:
    """The last message tells whether a frame moves; a change is worth a warning."""
    buffer.set_transform(stamped('base', 'camera', 2.0, (5, 0, 0)), 'me')
    assert numbers(buffer.lookup_transform_core('base', 'camera', at(2.0)))[0] == 5
    assert not buffer.can_transform_core('base', 'camera', at(1.5))[0]
    assert '"camera" is published both as a static and as a dynamic' in caplog.text


def test_threads() -> None:
    """Look-ups in some threads see whole transforms while another thread inserts."""
    buffer = BufferCore()
    errors: list[str] = []
    stopping = threading.Event()

    def insert() -> None:
        for number in range(3000):
            time = 1.0 + number / 100
            buffer.set_transform(stamped('map', 'odom', time, (time, 0, 0)), 'me')
            buffer.set_transform(stamped('odom', 'base', time, (-time, 0, 0)), 'me')
        stopping.set()

    def look() -> None:
        while not stopping.is_set():
            if buffer.can_transform_core('map', 'base', at(0))[0]:
                x = numbers(buffer.lookup_transform_core('map', 'base', at(0)))[0]
                if abs(x) > 1e-9:
                    errors.append(f'{x}')

    threads = [threading.Thread(target=look) for _ in range(3)]
    for thread in threads:
        thread.start()
    insert()
    for thread in threads:
        thread.join(30)
    assert errors == []


def test_complaints() -> None:
    """The same complaint is not repeated within ten seconds."""
    said: list[str] = []
    times_s = iter([0.0, 1.0, 5.0, 10.0, 11.0])
    complaints = Complaints(said.append, lambda: next(times_s))
    for text, kind in (('a', 'x'), ('b', 'x'), ('c', 'y'), ('d', 'x'), ('e', 'x')):
        complaints.add(text, kind)
    assert said == ['a', 'c', 'd']


def test_strange_names_are_listed() -> None:
    """Names with quotes, colons and backslashes are the same in YAML, and escaped for graphviz."""
    names = ['it\'s: "a"', 'back\\slash', '- dash', 'l_wrist', 'robot1/base.link-2']
    buffer = BufferCore()
    for parent, child in zip(names, [*names[1:], names[0] + '#']):
        buffer.set_transform_static(stamped(parent, child), 'me')
    frames = yaml.safe_load(buffer.all_frames_as_yaml())
    assert list(frames) == [*names[1:], names[0] + '#']
    assert [frame['parent'] for frame in frames.values()] == names
    assert 'l_wrist: \n' in buffer.all_frames_as_yaml()
    assert '"it\'s: \\"a\\"" -> "back\\\\slash" [' in buffer._allFramesAsDot()


def test_negative_cache_is_refused() -> None:
    """A buffer that keeps less than nothing would know nothing, and not say why."""
    with pytest.raises(ValueError, match='must be 0 s or more, not -1 s'):
        BufferCore(Duration(seconds=-1))
    buffer = BufferCore(Duration(seconds=0))
    buffer.set_transform(stamped('map', 'odom', 1.0, (1, 0, 0)), 'me')
    assert numbers(buffer.lookup_transform_core('map', 'odom', at(0)))[0] == 1
