# SPDX-License-Identifier: Apache-2.0
"""Check that a localisation that was started anew is told where the robot was."""

from __future__ import annotations

from collections.abc import Iterator

from geometry_msgs.msg import PoseWithCovarianceStamped
from humanoid_common.qos import LATCHED, STATE
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_navigation.pose_keeper import PoseKeeper
import pytest
from rclpy.node import Node


class Guard(Node):
    """A node that outlives the localisation."""

    def __init__(self, **options: object) -> None:
        super().__init__('guard', **options)
        self.keeper = PoseKeeper(self)


class Localisation(Node):
    """Publishes poses, as AMCL does."""

    def __init__(self, **options: object) -> None:
        super().__init__('amcl', **options)
        self.poses = self.create_publisher(PoseWithCovarianceStamped, 'amcl_pose', LATCHED)

    def say(self, x_m: float, variance_m2: float = 0.02) -> None:
        """Say where the robot is."""
        message = PoseWithCovarianceStamped()
        message.header.frame_id = 'map'
        message.pose.pose.position.x = x_m
        message.pose.covariance[0] = variance_m2
        self.poses.publish(message)


@pytest.fixture
def ros() -> Iterator[RosSandbox]:
    """Give a domain that nobody else uses."""
    with ros_sandbox() as ros:
        yield ros


def told_to(ros: RosSandbox) -> list[PoseWithCovarianceStamped]:
    """Return the list of what a localisation is told from now on."""
    told: list[PoseWithCovarianceStamped] = []
    observer = ros.observer()
    observer.create_subscription(PoseWithCovarianceStamped, 'initialpose', told.append, STATE)
    return told


def heard_by(ros: RosSandbox, guard: Guard) -> list[float]:
    """Return the list of the places in x that the guard's node hears of from now on."""
    heard: list[float] = []
    guard.create_subscription(
        PoseWithCovarianceStamped,
        'amcl_pose',
        lambda message: heard.append(message.pose.pose.position.x),
        LATCHED,
    )
    return heard


@pytest.mark.parametrize(('variance_m2', 'expected_m2'), [(0.02, 0.1), (0.4, 0.4)])
def test_a_new_one_is_told_the_last_pose(
    ros: RosSandbox, variance_m2: float, expected_m2: float
) -> None:
    """It is told once, as sure as the last one was, but not surer than some steps allow."""
    told, guard = told_to(ros), ros.start(Guard)
    heard = heard_by(ros, guard)
    first = ros.start(Localisation)
    first.say(2.5, variance_m2)
    ros.wait_until(lambda: heard == [2.5], what='the first pose')
    ros.wait_until(lambda: guard.count_subscribers('initialpose') == 1, what='the listener')
    second = ros.start(Localisation)
    second.say(0.0)
    ros.wait_until(lambda: len(told) == 1, what='what the new one is told')
    second.say(2.4)
    ros.wait_until(lambda: heard[-1] == 2.4, what='its pose')
    assert len(told) == 1
    assert told[0].header.frame_id == 'map'
    assert told[0].pose.pose.position.x == 2.5
    assert told[0].pose.covariance[0] == pytest.approx(expected_m2)


def test_the_same_one_is_told_nothing(ros: RosSandbox) -> None:
    """Poses that one localisation publishes change nothing, and neither does its first."""
    told, guard = told_to(ros), ros.start(Guard)
    heard, one = heard_by(ros, guard), ros.start(Localisation)
    for x_m in (0.0, 1.0, -3.0):
        one.say(x_m)
        ros.wait_until(lambda x_m=x_m: heard[-1:] == [x_m], what=f'a pose at {x_m}')
    assert told == []
