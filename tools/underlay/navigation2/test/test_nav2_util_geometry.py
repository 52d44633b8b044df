# SPDX-License-Identifier: Apache-2.0
"""Paths as arrays and as messages."""

from __future__ import annotations

from builtin_interfaces.msg import Time
from nav2_util.geometry import make_path, make_pose_stamped, path_poses, Pose2D
from nav_msgs.msg import Path
import numpy as np
import pytest
from rclpy.serialization import deserialize_message, serialize_message


def test_path_is_made_as_its_poses_are():
    """The quick way gives the messages that the constructors give, each with its own header."""
    poses, stamp = [Pose2D(1.0, 2.0, 0.5), Pose2D(-1.0, 0.25, -3.0)], Time(sec=3, nanosec=4)
    path = make_path(np.array(poses), 'map', stamp)
    assert path.poses == [make_pose_stamped(pose, 'map', stamp) for pose in poses]
    assert make_path(poses, 'map', stamp) == path
    assert deserialize_message(serialize_message(path), Path) == path
    path.poses[0].header.frame_id = 'odom'
    assert path.poses[1].header.frame_id == 'map'


def test_poses_of_a_path():
    """A path gives back its poses; an empty one has none."""
    poses = np.array([[1.0, 2.0, 0.5], [-1.0, 0.25, -3.0]])
    assert path_poses(make_path(poses, 'map', Time())) == pytest.approx(poses)
    assert path_poses(make_path([], 'map', Time())).shape == (0, 3)
