# SPDX-License-Identifier: Apache-2.0
"""Check how the pose of the body is followed, and what of it is refused."""

from __future__ import annotations

import math

from geometry_msgs.msg import Pose, Quaternion
from humanoid_control.hosting.conversions import body_pose_of
from humanoid_control.walking.commands import BodyPose, BodyPoseFollower, UPRIGHT
from humanoid_control.walking.errors import WalkingError
from humanoid_control.walking.parameters import WalkParameters
import pytest

P = WalkParameters()


@pytest.mark.parametrize(
    ('wanted', 'can'),
    [
        (BodyPose(0.3, -0.1), BodyPose(0.3, -0.1)),
        (BodyPose(3.0, -9.0), BodyPose(P.body_pose.bend_rad, -P.body_pose.lower_m)),
        (BodyPose(-3.0, 9.0), BodyPose(-P.body_pose.bend_back_rad, 0.0)),
    ],
)
def test_it_bends_as_far_as_it_can(wanted: BodyPose, can: BodyPose) -> None:
    """What is too much is cut."""
    assert wanted.within(P.body_pose) == can


@pytest.mark.parametrize('pose', [BodyPose(math.nan, 0.0), BodyPose(0.0, math.inf)])
def test_what_is_no_pose(pose: BodyPose) -> None:
    """It is refused."""
    with pytest.raises(WalkingError, match='finite'):
        pose.within(P.body_pose)


def test_it_follows_at_a_rate() -> None:
    """And is not upright before it is so."""
    follower = BodyPoseFollower(P.body_pose)
    assert follower.is_upright
    follower.update(BodyPose(0.4, -0.05), 0.5)
    assert follower.pose.pitch_rad == pytest.approx(0.5 * P.body_pose.bend_rad_s)
    assert follower.pose.height_m == pytest.approx(-0.05)
    assert follower.pitch_rate_rad_s == pytest.approx(P.body_pose.bend_rad_s)
    assert not follower.is_upright
    follower.update(BodyPose(0.4, -0.05), 5.0)
    assert follower.pose == BodyPose(0.4, -0.05)
    follower.update(BodyPose(0.4, -0.05), 0.1)
    assert follower.pitch_rate_rad_s == 0.0
    follower.update(UPRIGHT, 0.9)
    assert not follower.is_upright
    follower.update(UPRIGHT, 0.2)
    assert follower.is_upright and follower.pose == UPRIGHT


def test_a_message_says_pitch_and_height() -> None:
    """Its heading and its place mean nothing."""
    message = Pose(orientation=Quaternion(w=math.cos(0.1), y=math.sin(0.1)))
    message.position.x, message.position.z = 3.0, -0.08
    pose = body_pose_of(message)
    assert pose.pitch_rad == pytest.approx(0.2)
    assert pose.height_m == -0.08
    with pytest.raises(WalkingError, match='not a rotation'):
        body_pose_of(Pose(orientation=Quaternion(w=0.0)))
