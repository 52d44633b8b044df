# SPDX-License-Identifier: Apache-2.0
"""The drawing of the frames."""

from __future__ import annotations

from collections.abc import Iterator
import os
from pathlib import Path
import signal
import subprocess
import sys
from xml.etree import ElementTree

from domain_coordinator import domain_id
import pytest
from tf2_tools.drawing import draw, tree_svg, write_graph

TIMEOUT_S = 100.0
SVG = '{http://www.w3.org/2000/svg}'
DOT = """#!/bin/sh
[ "$1" = -Tpdf ] && [ "$3" = -o ] || exit 2
grep -q digraph "$2" || { echo "no graph in $2" >&2; exit 1; }
echo drawn > "$4"
"""


@pytest.fixture
def environment() -> Iterator[dict[str, str]]:
    """Return the variables of a domain of one's own."""
    with domain_id() as domain:
        yield {
            **os.environ,
            'ROS_DOMAIN_ID': str(domain),
            'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
        }


@pytest.fixture
def dot(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Put a stand-in for graphviz first on the path."""
    program = tmp_path / 'bin' / 'dot'
    program.parent.mkdir()
    program.write_text(DOT)
    program.chmod(0o755)
    monkeypatch.setenv('PATH', str(program.parent), prepend=os.pathsep)


def never() -> bool:
    """Return that nobody wants graphviz to stop."""
    return False


def start(environment: dict[str, str], *command: str) -> subprocess.Popen[str]:
    """Start a module as a program."""
    return subprocess.Popen(
        [sys.executable, '-m', *command],
        env=environment,
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )


def test_graph_is_drawn(tmp_path: Path, dot: None) -> None:
    """With graphviz there is a PDF; folders are made."""
    path = str(tmp_path / 'deep' / 'frames')
    assert write_graph(path, 'digraph G {}\n') == f'{path}.gv'
    assert draw(f'{path}.gv', f'{path}.pdf', never) == ''
    assert Path(f'{path}.pdf').read_text() == 'drawn\n'


def test_graphviz_fails(tmp_path: Path, dot: None) -> None:
    """What graphviz says is handed on."""
    path = str(tmp_path / 'frames')
    write_graph(path, 'nothing')
    assert (
        draw(f'{path}.gv', f'{path}.pdf', never)
        == f'dot could not draw {path}.gv: no graph in {path}.gv'
    )


def test_graphviz_cannot_start(tmp_path: Path, dot: None) -> None:
    """A program that is none is a sentence."""
    (tmp_path / 'bin' / 'dot').write_text('#!/no/such/shell\n')
    assert draw(str(tmp_path / 'f.gv'), str(tmp_path / 'f.pdf'), never).startswith(
        'dot cannot be started: No such file'
    )


def test_interrupt_of_graphviz(tmp_path: Path, dot: None, environment: dict[str, str]) -> None:
    """Ctrl-C while a large graph is drawn ends graphviz and the program."""
    (tmp_path / 'bin' / 'dot').write_text('#!/bin/sh\necho begun >&2; exec sleep 1000\n')
    path = str(tmp_path / 'frames')
    environment = {**environment, 'PATH': os.environ['PATH']}
    viewer = start(environment, 'tf2_tools.view_frames', '-t', '0', '-o', path)
    assert viewer.stderr is not None
    while 'Generating graph' not in viewer.stderr.readline():
        assert viewer.poll() is None
    viewer.send_signal(signal.SIGINT)
    _, errors = viewer.communicate(timeout=TIMEOUT_S / 2)
    assert viewer.returncode == 0 and 'Traceback' not in errors
    assert f'dot did not finish drawing {path}.gv in time, and was stopped' in errors


def test_tree_as_svg() -> None:
    """Each frame is below its parent and further to the right; circles and odd names are drawn."""
    facts = {'broadcaster': 'a', 'rate': 9.96, 'most_recent_transform': 2.0, 'buffer_length': 1.0}
    parents = {'base': 'odom', 'arm': 'base', '<&>': 'base', 'odom': 'map', 'x': 'y', 'y': 'x'}
    text = tree_svg({frame: {**facts, 'parent': parent} for frame, parent in parents.items()})
    names = [each.text for each in ElementTree.fromstring(text).iter(f'{SVG}text')][::2]
    assert names == ['map', 'odom', 'base', '<&>', 'arm', 'x', 'y']
    boxes = [int(each.get('x', '0')) for each in ElementTree.fromstring(text).iter(f'{SVG}rect')]
    assert boxes[1:] == [20, 56, 92, 128, 128, 20, 56]
    assert 'a, 10.0 Hz, the last 1.0 s until 2.000' in text
    assert 'no tf data' in tree_svg({})


def test_chain_of_many_frames() -> None:
    """A tree that is very deep is drawn as well."""
    facts = {'broadcaster': 'a', 'rate': 1.0, 'most_recent_transform': 0.0, 'buffer_length': 0.0}
    chain = {f'd{number + 1}': {**facts, 'parent': f'd{number}'} for number in range(5000)}
    assert tree_svg(chain).count('<path') == 5000


def test_program(tmp_path: Path, environment: dict[str, str]) -> None:
    """The program writes the graph of what it has heard, draws it, and prints it as YAML."""
    environment['PATH'] = str(tmp_path)  # without graphviz
    names = ['--frame-id', 'map', '--child-frame-id', 'odom']
    publisher = start(environment, 'tf2_ros.static_transform_publisher', *names)
    path = str(tmp_path / 'frames')
    viewer = start(environment, 'tf2_tools.view_frames', '--wait-time', '3', '-o', path)
    output, errors = viewer.communicate(timeout=TIMEOUT_S)
    publisher.kill()
    publisher.communicate()
    assert viewer.returncode == 0 and 'Traceback' not in errors
    assert 'Listening to tf data for 3.0 seconds...' in errors
    assert '"map" -> "odom" [label="Broadcaster: default_authority' in Path(
        f'{path}.gv'
    ).read_text(encoding='utf-8')
    assert "odom: \n  parent: 'map'\n" in output
    assert f'Generating graph in {path}.svg file...' in errors
    assert '>odom</text>' in Path(f'{path}.svg').read_text(encoding='utf-8')


def test_nothing_comes(tmp_path: Path, environment: dict[str, str]) -> None:
    """Without transforms that is said, and the file says it too."""
    path = str(tmp_path / 'frames')
    viewer = start(environment, 'tf2_tools.view_frames', '-t', '0.2', '-o', path)
    output, errors = viewer.communicate(timeout=TIMEOUT_S)
    assert viewer.returncode == 0 and output == '{}\n'
    assert 'No transforms received.' in errors
    assert 'no tf data' in Path(f'{path}.gv').read_text(encoding='utf-8')


def test_file_that_cannot_be_written(tmp_path: Path, environment: dict[str, str]) -> None:
    """A bad place for the files is a sentence, with status 1."""
    (tmp_path / 'file').write_text('')
    path = str(tmp_path / 'file' / 'frames')
    viewer = start(environment, 'tf2_tools.view_frames', '-t', '0.1', '-o', path)
    _, errors = viewer.communicate(timeout=TIMEOUT_S)
    assert viewer.returncode == 1 and 'Traceback' not in errors
    assert f'{path} cannot be written' in errors


def test_interrupt(tmp_path: Path, environment: dict[str, str]) -> None:
    """Ctrl-C while it listens ends it in order."""
    path = str(tmp_path / 'frames')
    viewer = start(environment, 'tf2_tools.view_frames', '-t', '50', '-o', path)
    assert viewer.stderr is not None
    assert 'Listening' in viewer.stderr.readline()
    viewer.send_signal(signal.SIGINT)
    _, errors = viewer.communicate(timeout=TIMEOUT_S)
    assert viewer.returncode == 0 and 'Traceback' not in errors


@pytest.mark.parametrize('seconds', ['nan', 'inf', '-1', 'long'])
def test_no_time_to_listen(environment: dict[str, str], seconds: str) -> None:
    """A time that is none is named, and the status is 2."""
    process = start(environment, 'tf2_tools.view_frames', f'--wait-time={seconds}')
    _, errors = process.communicate(timeout=TIMEOUT_S)
    assert process.returncode == 2 and 'Traceback' not in errors
    assert f"'{seconds}' is not a time in seconds: give a number from 0" in errors


def test_closed_output(environment: dict[str, str], tmp_path: Path) -> None:
    """The files are written also if nobody wants to read."""
    words = [sys.executable, '-m', 'tf2_tools.view_frames', '-t', '0', '-o', str(tmp_path / 'f')]
    result = subprocess.run(
        ['sh', '-c', 'exec "$0" "$@" >&-', *words],
        env=environment,
        stderr=subprocess.PIPE,
        text=True,
        timeout=TIMEOUT_S,
    )
    assert result.returncode == 0 and 'Traceback' not in result.stderr
    assert (tmp_path / 'f.gv').exists()
