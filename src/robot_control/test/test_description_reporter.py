# SPDX-License-Identifier: Apache-2.0
"""Check the node that reports the model."""

from __future__ import annotations

from pathlib import Path
import signal

from ament_index_python.packages import get_package_share_directory
from humanoid_common.testing.launching import load_launch_file
from humanoid_common.testing.processes import (
    assert_clean_exit,
    ExitReport,
    module_command,
    running_program,
)
from humanoid_common.testing.ros import ros_sandbox
import pytest
from robot_control.description_reporter import DescriptionReporter

LAUNCH_FILE = Path(__file__).parents[1] / 'launch' / 'robot_control.launch.py'
URDF = Path(get_package_share_directory('robot_description')) / 'urdf' / 'simple_arm.urdf'
MODULE = 'robot_control.description_reporter'


def run_with(urdf: str) -> ExitReport:
    """Run the node with a text that it refuses."""
    command = module_command(MODULE, '--ros-args', '-p', f"robot_description:='{urdf}'")
    with ros_sandbox(), running_program(command) as program:
        return program.wait_for_exit()


def test_model_of_the_other_package() -> None:
    """The node reads the model that the other package installs."""
    with ros_sandbox() as ros:
        node = ros.start(DescriptionReporter, {'robot_description': URDF.read_text()})
    assert [joint.name for joint in node.model.joints] == ['shoulder', 'elbow', 'hand_fixed']


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_signal(number: signal.Signals) -> None:
    """The node reports what it loaded, and ends in order."""
    urdf = ' '.join(URDF.read_text().split())
    command = module_command(MODULE, '--ros-args', '-p', f"robot_description:='{urdf}'")
    with ros_sandbox(), running_program(command) as program:
        program.wait_for_output('hand_fixed: fixed, forearm -> hand')
        report = program.stop(number)
    assert_clean_exit(report)
    assert "Loaded robot 'simple_arm': 4 links" in report.stderr


@pytest.mark.parametrize(
    ('urdf', 'sentence'),
    [
        ('', 'The robot description is empty. Pass the text of a URDF file.'),
        ('<robot', 'The robot description is not valid XML'),
    ],
)
def test_bad_urdf(urdf: str, sentence: str) -> None:
    """A bad URDF ends the node with one sentence and status 1."""
    report = run_with(urdf)
    assert report.status == 1
    assert report.stderr.startswith(sentence) and len(report.stderr.splitlines()) == 1


def test_launch_file_loads() -> None:
    """The launch file starts one node."""
    assert len(load_launch_file(LAUNCH_FILE).entities) == 1
