# SPDX-License-Identifier: Apache-2.0
"""Check that the start of the humanoid is quiet, and ends with the address of the page."""

from __future__ import annotations

from pathlib import Path
import re

from humanoid_bringup.robot_watch import announcement, BRING, Startup, TURN
from humanoid_bringup.start_box import Terminal
from humanoid_common.testing.launching import running_launch_file
from humanoid_common.testing.ros import ros_sandbox
import pytest
from sensor_msgs.msg import JointState

LAUNCH_FILE = Path(__file__).parents[1] / 'launch' / 'bringup.launch.py'
URL = 'http://127.0.0.1:8080/?token=a-b'
SHARED = 'http://192.0.2.2:8080/?token=a-b'
PAGE = f'[INFO] [1.2] [rviz2]: RViz is at {URL}\n'
ROBOT = "[INFO] [1.3] [simulator]: Simulator started: one robot in the scene 'flat'\n"


def test_address_comes_when_the_robot_is_there() -> None:
    """Whichever of them is first, and once."""
    startup = Startup()
    assert startup.hear('rviz2-5', PAGE) is None
    assert startup.hear('simulator-1', ROBOT) == URL
    assert startup.hear('rviz2-5', PAGE) is None
    startup = Startup()
    assert startup.hear('simulator-1', ROBOT) is None
    assert startup.hear('rviz2-5', PAGE) == URL


def test_lines_that_come_in_pieces() -> None:
    """What processes write arrives in pieces, and those of others in between."""
    startup = Startup()
    assert startup.hear('rviz2-5', PAGE[:40]) is None
    assert startup.hear('simulator-1', ROBOT) is None
    assert startup.hear('rviz2-5', PAGE[40:]) == URL


def test_without_a_page() -> None:
    """The start of the robot suffices, and there is no address."""
    startup = Startup(has_page=False)
    assert startup.hear('simulator-1', ROBOT[:40]) is None
    assert startup.hear('simulator-1', ROBOT[40:]) == ''
    assert startup.hear('simulator-1', ROBOT) is None


def test_announcement() -> None:
    """On lines of its own, below what else is logged, stand the address and what to try."""
    lines = announcement(URL, {}, Terminal()).split('\n')
    assert lines[0] == '' and lines[1].startswith('┌') and lines[-1].startswith('└')
    assert any(URL in line for line in lines)
    assert not any('ready' in line for line in lines)


def test_what_the_robot_can_be_told() -> None:
    """The example is something that the parts of the launch can do."""
    full = {'planner': 'true', 'scene': 'apartment'}
    full |= dict.fromkeys(('navigation', 'perception', 'hands', 'manipulation'), 'true')
    assert BRING in announcement(URL, full, Terminal())
    for name, value in (('scene', 'flat'), ('manipulation', 'false'), ('navigation', 'false')):
        text = announcement(URL, {**full, name: value}, Terminal())
        assert TURN in text and BRING not in text


@pytest.mark.parametrize(
    ('asked', 'url', 'has_colors', 'is_drawn'),
    [
        ('auto', SHARED, True, True),
        ('auto', SHARED, False, False),
        ('true', SHARED, False, True),
        ('false', SHARED, True, False),
        ('true', URL, True, False),
        ('true', '', True, False),
    ],
)
def test_qr_code(asked: str, url: str, has_colors: bool, is_drawn: bool) -> None:
    """It is drawn if it is wanted, and another machine can use it."""
    pytest.importorskip('segno')
    text = announcement(url, {'qr_code': asked}, Terminal(has_colors=has_colors))
    assert ('█' in text) == ('scanning the code' in text) == is_drawn


def test_bringup_is_quiet() -> None:
    """Of the joints, of which commands go on, one line is said; the address comes after it."""
    with ros_sandbox() as ros, running_launch_file(LAUNCH_FILE, 'backend:=mock') as program:
        program.wait_for_output('The robot has started.', timeout_s=120.0)
        url = re.search(r'RViz is at (\S+)', program.output)
        assert url is not None
        program.wait_for_output(f'  {url[1]}')
        heard: list[JointState] = []
        ros.observer().create_subscription(JointState, 'joint_commands', heard.append, 10)
        ros.wait_until(lambda: len(heard) > 150, 60.0, 'seconds of commands')
        assert program.output.count('left_shoulder: ') <= 1


def test_a_scene_that_does_not_exist_starts_nothing() -> None:
    """The launch of everything ends before it begins."""
    with ros_sandbox(), running_launch_file(LAUNCH_FILE, 'scene:=rom') as program:
        report = program.wait_for_exit(60.0)
    assert report.status == 1
    assert '"scene" provided value "rom" is not valid' in report.output
    assert 'process started' not in report.output
