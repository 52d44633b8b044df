# SPDX-License-Identifier: Apache-2.0
"""Check how a node takes a policy, and that a mistaken one does not take it down."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from humanoid_common.errors import UserError
from humanoid_common.onnx_file import Operation, Tensor, write_onnx
from humanoid_common.qos import LATCHED
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_control.hosting import policies
from humanoid_control.hosting.policies import policy_path
from humanoid_control.mock_robot import MockRobot
from humanoid_control.policy import PolicyError
from humanoid_control.policy.testing import write
import numpy as np
import pytest
from rcl_interfaces.msg import Log
from rclpy.parameter import Parameter
from std_msgs.msg import String

pytest.importorskip('onnxruntime')


@pytest.fixture(name='path')
def _path(tmp_path: Path) -> Path:
    """Return a policy that moves a knee and an elbow by 0.1 rad."""
    bias = np.full((1, 2), 0.1, dtype=np.float32)
    write_onnx(
        tmp_path / 'moves.onnx',
        [Operation('MatMul', ['observation', 'zero'], 'none'),
         Operation('Add', ['none', 'bias'], 'action')],
        {'zero': np.zeros((4, 2), dtype=np.float32), 'bias': bias},
        [Tensor('observation', [1, 4])],
        [Tensor('action', [1, 2])],
    )  # fmt: skip
    return write(tmp_path, default_rad=[0.7, -0.5], action={'scale_rad': 1.0})


@pytest.fixture(name='ros')
def _ros() -> Iterator[RosSandbox]:
    """Give a domain of its own."""
    with ros_sandbox() as sandbox:
        yield sandbox


class Heard:
    """What a robot says: its walking state, and its log."""

    def __init__(self, ros: RosSandbox) -> None:
        self._ros = ros
        self.state, self.log = '', ''
        node = ros.observer()
        node.create_subscription(String, 'walking_state', self._take_state, LATCHED)
        node.create_subscription(Log, '/rosout', self._take_log, 100)

    def wait_for(self, state: str) -> None:
        """Wait for a walking state."""
        self._ros.wait_until(lambda: self.state == state, 60.0, f'the state {state}')

    def wait_for_log(self, words: str) -> None:
        """Wait for some words in the log."""
        self._ros.wait_until(lambda: words in self.log, 60.0, words)

    def _take_state(self, message: String) -> None:
        self.state = message.data

    def _take_log(self, message: Log) -> None:
        self.log += message.msg


def test_a_policy_is_taken_or_refused(ros: RosSandbox, path: Path) -> None:
    """A change to one that cannot be run is refused, and the robot goes on as before."""
    heard = Heard(ros)
    robot = ros.start(MockRobot, {'policy': str(path)})
    assert robot.set_parameters([Parameter('mode', value='policy')])[0].successful
    heard.wait_for('policy')
    (broken,) = robot.set_parameters([Parameter('policy', value='/nowhere/walk.yaml')])
    assert not broken.successful and '/nowhere/walk.yaml cannot be read' in broken.reason
    assert robot.get_parameter('policy').value == str(path)
    write(path.parent, joints=['left_nee', 'left_elbow'], default_rad=0.0)
    (broken,) = robot.set_parameters([Parameter('mode', value='policy')])
    assert not broken.successful and "Did you mean 'left_knee'?" in broken.reason
    write(path.parent, rate_hz=200.0, default_rad=[0.7, -0.5])
    (fast,) = robot.set_parameters([Parameter('policy', value=str(path))])
    assert not fast.successful and 'the control loop runs at 100 Hz' in fast.reason
    assert robot.set_parameters([Parameter('mode', value='walking')])[0].successful
    heard.wait_for('stand')


def test_a_robot_that_starts_without_its_policy(ros: RosSandbox, path: Path) -> None:
    """The node runs, says why, and holds its pose; a policy may come later."""
    path.with_name('moves.onnx').unlink()
    heard = Heard(ros)
    robot = ros.start(MockRobot, {'policy': str(path), 'mode': 'policy'})
    heard.wait_for('policy')
    heard.wait_for_log("moves.onnx' is not there")
    assert 'The robot holds its pose.' in heard.log
    assert robot.set_parameters([Parameter('mode', value='walking')])[0].successful
    heard.wait_for('stand')


def test_policies_by_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """An installed one, or a path; the home folder is that of the user."""
    (tmp_path / 'policies').mkdir()
    (tmp_path / 'policies' / 'stand.yaml').touch()
    monkeypatch.setattr(policies, 'get_package_share_directory', lambda name: str(tmp_path))
    assert policy_path('stand') == tmp_path / 'policies' / 'stand.yaml'
    assert policy_path('~/run/walk.yaml') == Path.home() / 'run' / 'walk.yaml'
    with pytest.raises(PolicyError, match="No policy 'stant' is installed. Did you mean 'stand'?"):
        policy_path('stant')
    with pytest.raises(UserError, match="no home folder '~nobody_of_this_name'. Give the whole"):
        policy_path('~nobody_of_this_name/walk.yaml')
    with pytest.raises(PolicyError, match='to the path of a file that ends with .yaml'):
        policy_path(str(tmp_path))
