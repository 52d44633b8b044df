# SPDX-License-Identifier: Apache-2.0
"""Test that a transform that is missing ends a goal with its code."""

from __future__ import annotations

from geometry_msgs.msg import TransformStamped
from humanoid_common.single_goal import GoalAborted
from humanoid_common.testing.ros import ros_sandbox
from humanoid_perception.transforms import Transforms
import numpy as np
import pytest
from tf2_ros import StaticTransformBroadcaster


def test_a_missing_transform_has_its_code_and_says_which_frame_it_is() -> None:
    """Also where nobody has waited for it; one that is there is looked up."""
    with ros_sandbox() as ros:
        node = ros.observer()
        transforms = Transforms(node)
        told = TransformStamped(child_frame_id='camera')
        told.header.frame_id = 'head'
        told.transform.translation.z, told.transform.rotation.w = 0.1, 1.0
        broadcaster = StaticTransformBroadcaster(ros.observer())
        with transforms.listening():
            for frame, child in (('head', 'camera'), ('odom', 'camera')):
                with pytest.raises(GoalAborted, match="No transform of 'camera'") as aborted:
                    transforms.pose(frame, child)
                assert aborted.value.name == 'NO_TRANSFORM'
            broadcaster.sendTransform(told)

            def is_there() -> bool:
                try:
                    return bool(np.isclose(transforms.pose('head', 'camera')[2, 3], 0.1))
                except GoalAborted:
                    return False

            ros.wait_until(is_there, 30.0, 'a transform')
            assert transforms.pose('head', 'head') == pytest.approx(np.eye(4))
