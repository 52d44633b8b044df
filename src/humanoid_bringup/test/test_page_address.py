# SPDX-License-Identifier: Apache-2.0
"""Check that the start of the humanoid is quiet, and ends with the address of the page."""

from __future__ import annotations

from pathlib import Path

from humanoid_bringup.robot_watch import announcement, Startup
from humanoid_common.testing.launching import running_launch_file
from humanoid_common.testing.ros import ros_sandbox
from sensor_msgs.msg import JointState

LAUNCH_FILE = Path(__file__).parents[1] / 'launch' / 'bringup.launch.py'
URL = 'http://127.0.0.1:8080/?token=a-b'
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


def test_announcement() -> None:
    """The address stands between two lines."""
    _, line, sentence, again = announcement(URL).split('\n')
    assert URL in sentence and line == again == '-' * len(sentence)


def test_bringup_is_quiet() -> None:
    """Of the joints, of which commands go on, one line is said; the address comes after it."""
    with ros_sandbox() as ros, running_launch_file(LAUNCH_FILE, 'backend:=mock') as program:
        program.wait_for_output('to see and drive the robot.', timeout_s=120.0)
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
