# SPDX-License-Identifier: Apache-2.0
"""Why nothing comes on a topic."""

from collections.abc import Callable
from typing import Any

from geometry_msgs.msg import PointStamped, PoseStamped
import pytest
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rviz_common.topics import reason_of_silence

RELIABLE = QoSProfile(depth=1)
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
BEST_EFFORT = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)


def test_nobody_publishes(node: Node) -> None:
    """That nobody publishes is said; a name that is none is left to others."""
    assert reason_of_silence(node, PoseStamped, '/a', RELIABLE) == ': it has no publisher.'
    assert reason_of_silence(node, PoseStamped, '/a b', RELIABLE) == '.'


@pytest.mark.parametrize(
    ('offered', 'asked', 'words'),
    [
        (RELIABLE, LATCHED, "set 'Durability Policy' to Volatile"),
        (BEST_EFFORT, RELIABLE, "set 'Reliability Policy' to Best Effort"),
        (LATCHED, RELIABLE, "set 'Durability Policy' to Transient Local"),
        (RELIABLE, BEST_EFFORT, 'messages may be rare'),
    ],
)
def test_quality_of_service(
    node: Node, spin_until: Callable[..., None], offered: Any, asked: Any, words: str
) -> None:
    """What does not fit is said, with what to set."""
    node.create_publisher(PoseStamped, '/a', offered)
    spin_until(lambda: node.count_publishers('/a'))
    reason = reason_of_silence(node, PoseStamped, 'a', asked)
    assert words.lower() in reason.lower()


def test_another_type(node: Node, spin_until: Callable[..., None]) -> None:
    """A topic of another type is said to be one."""
    node.create_publisher(PointStamped, '/a', RELIABLE)
    spin_until(lambda: node.count_publishers('/a'))
    reason = reason_of_silence(node, PoseStamped, '/a', RELIABLE)
    assert 'geometry_msgs/msg/PointStamped there, not geometry_msgs/msg/PoseStamped' in reason
