# SPDX-License-Identifier: Apache-2.0
"""Check that the humanoid is shown where the kinematics of another library puts it."""

from __future__ import annotations

import io
import math
from pathlib import Path
from typing import Any

from ament_index_python.packages import get_package_share_directory
from humanoid_common.testing.launching import running_launch_file
from humanoid_common.testing.ros import ros_sandbox
from humanoid_description.expansion import humanoid_urdf
import numpy as np
import pytest
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.time import Time
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage
from tf2_ros import Buffer

LAUNCH_FILE = Path(get_package_share_directory('humanoid_description')) / 'launch/view.launch.py'
JOINTS = ('left_shoulder', 'left_shoulder_roll', 'left_shoulder_yaw', 'left_elbow', 'waist_yaw')
POSES = 60
TIMEOUT_S = 100.0


class Observer:
    """Moves the left arm and the waist, and takes note of the joints' states and transforms."""

    def __init__(self, node: Any) -> None:
        """Begin at once."""
        self.buffer = Buffer()
        self.states: dict[int, JointState] = {}
        self.stamps: set[int] = set()
        self._node = node
        self._commands = node.create_publisher(JointState, 'joint_commands', 10)
        latched = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        node.create_subscription(JointState, 'joint_states', self._note_state, 100)
        node.create_subscription(TFMessage, 'tf', self._note_moving, 100)
        node.create_subscription(TFMessage, 'tf_static', self._note_static, latched)
        node.create_timer(0.02, self._command)

    def poses(self) -> list[int]:
        """Return the stamps at which both the joints and the transforms are known."""
        return sorted(self.stamps & self.states.keys())

    def _command(self) -> None:
        now = self._node.get_clock().now()
        phase = now.nanoseconds / 1e9
        positions = [0.4 * math.sin(phase + index) for index in range(len(JOINTS))]
        command = JointState(name=list(JOINTS), position=positions)
        command.header.stamp = now.to_msg()
        self._commands.publish(command)

    def _note_state(self, state: JointState) -> None:
        self.states[Time.from_msg(state.header.stamp).nanoseconds] = state

    def _note_moving(self, message: TFMessage) -> None:
        for transform in message.transforms:
            self.buffer.set_transform(transform, 'test')
            self.stamps.add(Time.from_msg(transform.header.stamp).nanoseconds)

    def _note_static(self, message: TFMessage) -> None:
        for transform in message.transforms:
            self.buffer.set_transform_static(transform, 'test')


def test_hand_is_where_yourdfpy_says() -> None:
    """At every moment the left hand is where the joints of that moment put it."""
    urdf = pytest.importorskip('yourdfpy').URDF
    model = urdf.load(io.BytesIO(humanoid_urdf().encode()), load_meshes=False)
    with ros_sandbox() as sandbox, running_launch_file(LAUNCH_FILE, 'gui:=false'):
        observer = Observer(sandbox.observer())
        sandbox.wait_until(lambda: len(observer.poses()) >= POSES, TIMEOUT_S, 'transforms')
    seen = []
    for stamp in observer.poses():
        state = observer.states[stamp]
        model.update_cfg(dict(zip(state.name, state.position)))
        expected = model.get_transform('l_wrist', 'base_link')[:3, 3]
        found = observer.buffer.lookup_transform('base_link', 'l_wrist', Time(nanoseconds=stamp))
        shift = found.transform.translation
        assert np.allclose([shift.x, shift.y, shift.z], expected, atol=1e-6)
        seen.append(expected)
    assert np.ptp(seen, axis=0).max() > 0.05, 'the hand has not moved'
