# SPDX-License-Identifier: Apache-2.0
"""Names, sentences, the memory of messages and the list of recordings, without ROS."""

from __future__ import annotations

from datetime import datetime
import os
from pathlib import Path
import subprocess
import sys
from typing import Any

import pytest
from recorded_samples import find_definition, LATCHED, MS, S, START_NS, text, topic, write_bag
from robot_console.recordings.bags import about, Bag, BagTopic, commands_among, Shelf, topics_table
from robot_console.recordings.child import Child, last_sentence
from robot_console.recordings.programs.remember import write_bag as write_kept
from robot_console.recordings.record_folder import bag_folder, regex_of_robot, topics_in
from robot_console.recordings.widgets import (
    clock_text,
    listed,
    memory_text,
    mixture_text,
)
from ros2bag.storage.bag_reader import BagReader
from ros2bag.storage.bag_writer import WriterOptions
from ros2bag.storage.snapshot import MessageMemory

NOW = datetime(2026, 11, 21, 19, 5, 12)


def test_name(tmp_path: Path) -> None:
    """A recording has the name that it is given, or that of its time."""
    folder = str(tmp_path)
    assert bag_folder(folder, ' walk ', NOW) == str(tmp_path / 'walk')
    assert bag_folder(folder, '', NOW) == str(tmp_path / '2026-11-21_19-05-12')
    (tmp_path / '2026-11-21_19-05-12').mkdir()
    assert bag_folder(folder, '', NOW) == str(tmp_path / '2026-11-21_19-05-12_2')


@pytest.mark.parametrize('name', ['../x', 'a/b', '.', '..', '.x', 'x\0y'])
def test_name_outside(tmp_path: Path, name: str) -> None:
    """No name leads out of the folder."""
    with pytest.raises(ValueError, match='no slashes'):
        bag_folder(str(tmp_path), name, NOW)


def test_name_taken(tmp_path: Path) -> None:
    """A name that is taken is refused before anything starts."""
    (tmp_path / 'walk').mkdir()
    with pytest.raises(ValueError, match="already a recording 'walk'"):
        bag_folder(str(tmp_path), 'walk', NOW)


def test_topics_of_robot() -> None:
    """All topics of one of several robots are those below its namespace, and the shared ones."""
    import re

    pattern = re.compile(regex_of_robot('robot1'))
    assert pattern.search('/robot1/joint_states') and pattern.search('/tf_static')
    assert not pattern.search('/robot10/joint_states') and not pattern.search('/x/robot1/tf')
    assert regex_of_robot('') == ''


def test_topics_in_text() -> None:
    """Names may be separated by whatever one types."""
    assert topics_in(' a, b\n\nc a ') == ['a', 'b', 'c']


def test_commands() -> None:
    """What moves a robot is found in any namespace, and only that."""
    moving = ['/cmd_vel', '/cmd_vel_nav', '/r1/emergency_stop', '/joint_commands', '/arm/command']
    moving.append('/r1/stop_state')  # the answer to a stop: the page believes it
    resting = ['/joint_states', '/tf', '/camera/image', '/recommendation']
    assert commands_among([*moving, *resting]) == moving
    assert commands_among(['/cmd_vel', '/x'], 'x') == ['/x']


def test_memory_forgets_by_time() -> None:
    """What is older than the span is forgotten."""
    memory = MessageMemory(2 * S, 10**6)
    memory.set_topic(topic('/ticks'))
    for number in range(50):
        memory.write(text('/ticks', str(number), number * 100 * MS))
    now_ns = START_NS + 5 * S
    kept = memory.kept(now_ns)
    assert len(kept.messages) == 20 and memory.message_count == 20
    assert kept.messages[0].log_ns == START_NS + 3 * S
    assert not memory.is_short and memory.age_ns(now_ns) == 2 * S


def test_memory_is_bounded() -> None:
    """However much comes, no more bytes are kept than allowed."""
    memory = MessageMemory(60 * S, 100_000)
    memory.set_topic(topic('/image'))
    for number in range(100):
        memory.write(text('/image', 'x' * 9000, number * MS))
        assert memory.size_bytes <= 100_000
    assert memory.is_short and memory.message_count == 10
    memory.write(text('/image', 'x' * 200_000, 200 * MS))
    assert (memory.message_count, memory.size_bytes) == (0, 0)


def test_memory_saves_latched(tmp_path: Path) -> None:
    """A latched message that has been forgotten is at the head of what is saved."""
    memory = MessageMemory(S, 10**6)
    for each in (topic('/ticks'), topic('/description', LATCHED)):
        memory.set_topic(each)
    memory.write(text('/description', '<robot/>', 0))
    for number in range(50):
        memory.write(text('/ticks', str(number), number * 100 * MS))
    folder = str(tmp_path / 'bag')
    kept = memory.kept(START_NS + 5 * S)
    assert write_kept(kept, folder, WriterOptions(), find_definition) == 11
    messages = list(BagReader(folder).messages())
    assert messages[0].topic == '/description' and b'<robot/>' in messages[0].data
    assert {each.log_ns >= START_NS + 4 * S for each in messages} == {True}


def test_shelf(tmp_path: Path) -> None:
    """The newest recording comes first, with what it has; other things are no recordings."""
    write_bag(tmp_path / 'old', '/ticks')
    write_bag(tmp_path / 'new', '/ticks', '/sensor', count=5)
    (tmp_path / 'text.txt').write_text('no bag')
    (tmp_path / 'empty').mkdir()
    for path in (tmp_path / 'old').iterdir():
        os.utime(path, (1, 1))
    new, old = Shelf(str(tmp_path)).look()
    assert (new.name, old.name) == ('new', 'old')
    assert (new.message_count, new.duration_s, new.problem) == (11, 0.4, '')
    assert [each.name for each in new.topics] == ['/description', '/sensor', '/ticks']


def test_shelf_problems(tmp_path: Path) -> None:
    """A recording that cannot be played is listed with the reason."""
    write_bag(tmp_path / 'unfinished', '/ticks')
    (tmp_path / 'unfinished' / 'metadata.yaml').unlink()
    write_bag(tmp_path / 'broken', '/ticks')
    (tmp_path / 'broken' / 'metadata.yaml').write_text('{[')
    (tmp_path / 'noise.mcap').write_bytes(b'\0' * 99)
    problems = {bag.name: bag.problem for bag in Shelf(str(tmp_path)).look()}
    assert 'ros2 bag recover' in problems['unfinished']
    assert problems['broken'] and problems['noise.mcap']


def test_shelf_reads_once(tmp_path: Path) -> None:
    """What has not changed is not read again; what is gone is forgotten."""
    write_bag(tmp_path / 'one', '/ticks')
    shelf = Shelf(str(tmp_path))
    first, second = shelf.look()[0], shelf.look()[0]
    assert first is second
    for path in (tmp_path / 'one').iterdir():
        path.unlink()
    assert shelf.look() == []
    assert Shelf(str(tmp_path / 'nowhere')).look() == []


def test_words() -> None:
    """Times, lists and mixtures read well."""
    assert [clock_text(each) for each in (7.52, 75, 3723)] == ['7.5 s', '1:15', '1:02:03']
    assert listed('abcdef') == 'a, b, c, d and 2 more'
    assert mixture_text({}) == ''
    assert mixture_text({'/tf': ['rsp']}).startswith('rsp publishes /tf as well')
    assert about(Bag('x', '/x', problem='Bad *end*')) == r'✖ Bad \*end\*'


def test_topics_table() -> None:
    """What a file names its topics means nothing to the page."""
    table = topics_table([BagTopic('/<img src=x>', 'a/msg/B', 3)])
    count: Any = '<img>'
    assert '<img' not in topics_table([BagTopic('/a', 'a/msg/B', count)])
    assert '/&lt;img src=x&gt;' in table and '<img' not in table and '>3<' in table


def test_memory_words() -> None:
    """It is said if less is kept than asked for."""
    facts = {'seconds': 31.2, 'messages': 5, 'topics': 2, 'size_bytes': 2048, 'is_short': False}
    said = memory_text(facts, 30, 200)
    assert said == 'Keeps 30 s: 5 messages of 2 topics, 2.0 KiB.'
    assert '200 MiB' in memory_text({**facts, 'is_short': True}, 30, 200)
    assert memory_text({}, 30, 200) == 'Starting ...'


def test_output_of_a_program_that_is_no_object(monkeypatch: pytest.MonkeyPatch) -> None:
    """It is kept as text, and the facts after it are heard."""
    start, code = subprocess.Popen, r"""print('3\n[]\nnull\n{"a": 1}')"""
    monkeypatch.setattr(
        subprocess, 'Popen', lambda _, **options: start([sys.executable, '-c', code], **options)
    )
    child = Child('play', [])
    child.close()
    assert child.facts == {'a': 1}
    assert [line.strip() for line in child._lines] == ['3', '[]', 'null']


def test_last_sentence() -> None:
    """Of what a program has said the reason of its end is found."""
    lines = ['[INFO] [1.2] [node]: Recording...', 'record.py: error: Nothing is chosen', '']
    assert last_sentence(lines) == 'Nothing is chosen'
    assert last_sentence(['[WARN] [1.2] [node]: Odd']) == 'Odd'
    assert last_sentence(['[INFO] [1.2] [node]: Fine']) == ''


def test_shelf_strange_names(tmp_path: Path) -> None:
    """A name that is no text can be shown, and its path still leads there."""
    folder = os.fsencode(tmp_path) + b'/b\xff'
    os.mkdir(folder)
    (Path(os.fsdecode(folder)) / 'metadata.yaml').touch()
    (bag,) = Shelf(str(tmp_path)).look()
    assert bag.name == 'b?' and os.path.isdir(bag.path)
    assert ''.join((bag.name, *about(bag))).encode()
