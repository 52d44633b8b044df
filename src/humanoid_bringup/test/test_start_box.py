# SPDX-License-Identifier: Apache-2.0
"""Check what a terminal shows once the robot has started."""

from __future__ import annotations

import io
import sys

from humanoid_bringup.start_box import is_shared, qr_code, start_box, Terminal
import pytest

URL = 'http://192.0.2.2:8080/?token=blzKN63zCSvi6rk7odk9_g'
WIDE = Terminal(columns=120)
MODULE = 4
"""The size of a drawn module of a QR code, in pixels."""


def test_box_has_straight_sides() -> None:
    """It fits into 80 columns with the address of a page, the commands and how to stop."""
    lines = start_box(URL, '', False, Terminal(columns=80)).split('\n')
    assert len({len(line) for line in lines}) == 1 and len(lines[0]) <= 80
    assert lines[0][0] + lines[0][-1] + lines[-1][0] + lines[-1][-1] == '┌┐└┘'
    assert {line[0] + line[-1] for line in lines[1:-1]} == {'││'}
    text = '\n'.join(lines)
    assert URL in text and '/cmd_vel' in text and 'Ctrl-C' in text and 'ready' not in text


def test_narrow_terminals_wrap_no_side() -> None:
    """Without room for sides, there are none, and commands stay in one piece."""
    lines = start_box(URL, '', False, Terminal(columns=40)).split('\n')
    assert lines[0] == lines[-1] == '─' * 40
    assert not any('│' in line for line in lines)
    assert f'  {URL}' in lines


@pytest.mark.parametrize('encoding', ['ascii', 'latin-1', 'no-such-encoding'])
def test_output_without_unicode(encoding: str) -> None:
    """The box is drawn in ASCII, and there is no QR code."""
    terminal = Terminal(120, encoding)
    box = start_box(URL, 'turn around', False, terminal)
    assert box.isascii() and box.startswith('+-') and box.endswith('-+')
    assert qr_code(URL, terminal) == ''


def test_sentences() -> None:
    """With a page, the robot is told in its tab; without one, by a command; else not at all."""
    assert 'Command tab, for example:' in start_box(URL, 'turn around', False, WIDE)
    without_page = start_box('', 'turn around', False, WIDE)
    assert 'without a page' in without_page and 'http' not in without_page
    command = 'ros2 topic pub --once /user_command std_msgs/msg/String \'{data: "turn around"}\''
    assert command in without_page
    assert 'scan' not in start_box(URL, '', False, WIDE)
    assert 'scanning the code below' in start_box(URL, '', True, WIDE)


@pytest.mark.parametrize(
    ('url', 'expected'),
    [
        (URL, True),
        ('http://[2001:db8::1]:8080/?token=a', True),
        ('http://127.0.0.1:8080/?token=a', False),
        ('http://[::1]:8080/', False),
        ('http://robot:8080/', False),
        ('', False),
    ],
)
def test_is_shared(url: str, expected: bool) -> None:
    """Other machines reach every address but those of the loopback interface."""
    assert is_shared(url) == expected


@pytest.mark.parametrize('has_colors', [True, False])
def test_qr_code_can_be_read(has_colors: bool) -> None:
    """A decoder finds the address in what is drawn, in both kinds of terminals."""
    pytest.importorskip('segno')
    cv2 = pytest.importorskip('cv2')
    import numpy as np

    text = qr_code(URL, Terminal(columns=80, has_colors=has_colors))
    lines = [line.removeprefix('\x1b[38;5;16;48;5;231m') for line in text.split('\n')]
    lines = [line.removesuffix('\x1b[0m') for line in lines]
    assert len(lines) <= 23 and {len(line) for line in lines} == {len(lines[0])}
    halves = {' ': (0, 0), '▄': (0, 1), '▀': (1, 0), '█': (1, 1)}
    rows = [[halves[each][row] for each in line] for line in lines for row in (0, 1)]
    drawn = np.array(rows, np.uint8)
    light = 1 - drawn if has_colors else drawn
    image = np.kron(light * 255, np.ones((MODULE, MODULE), np.uint8))
    assert cv2.QRCodeDetector().detectAndDecode(image)[0] == URL


def test_there_is_no_code_without_room_or_package(monkeypatch: pytest.MonkeyPatch) -> None:
    """A code that would be wrapped is left out, and one that nothing can draw."""
    assert qr_code(URL, Terminal(columns=30)) == ''
    monkeypatch.setitem(sys.modules, 'segno', None)
    assert qr_code(URL, WIDE) == ''


def test_terminal_of_output(monkeypatch: pytest.MonkeyPatch) -> None:
    """A file has no colors and its own encoding; the width can be given."""
    monkeypatch.setenv('COLUMNS', '60')
    monkeypatch.setattr(sys, 'stdout', io.TextIOWrapper(io.BytesIO(), encoding='latin-1'))
    assert Terminal.of_output() == Terminal(60, 'latin-1', has_colors=False)
    sys.stdout.close()
    assert not Terminal.of_output().has_colors
    monkeypatch.setattr(sys, 'stdout', None)
    assert Terminal.of_output() == Terminal(60, 'ascii', has_colors=False)
