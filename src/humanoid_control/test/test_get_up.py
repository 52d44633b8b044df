# SPDX-License-Identifier: Apache-2.0
"""Check by which motions a robot gets up, and when it does not."""

from __future__ import annotations

from dataclasses import replace

from humanoid_control.backends import Observation
from humanoid_control.hosting.walking_robot import WalkingRobotControl
from humanoid_control.walking import Walker, WalkParameters
from humanoid_control.walking.get_up import (
    BACK,
    FACE,
    LEFT_SIDE,
    lying_on,
    RIGHT_SIDE,
    sided,
    UPRIGHT,
)
from humanoid_control.walking.get_up_motions import KNEEL, MOTIONS, RISE, ROLL_OVER, STRETCH
from humanoid_description.drives import load_drives
from humanoid_description.robot import Robot
from humanoid_description.rotations import from_rpy, quaternion_of
import numpy as np
import pytest

LIES = {
    BACK: (0.0, -1.5),
    FACE: (0.0, 1.5),
    LEFT_SIDE: (-1.5, 0.0),
    RIGHT_SIDE: (1.5, 0.0),
    UPRIGHT: (0.2, 0.4),
}
"""Roll and pitch."""
FALL = WalkParameters().fall


def control_of(robot: Robot) -> WalkingRobotControl:
    """Return the control of a robot that has not begun."""
    return WalkingRobotControl.of(robot, load_drives())


def seen(walker: Walker, time_s: float, lies: str) -> Observation:
    """Return what a robot observes that lies still, without weight on its feet."""
    count = len(walker.robot.joints)
    zeros, three, feet = np.zeros(count), np.zeros(3), np.zeros((2, 3))
    orientation = np.array(quaternion_of(from_rpy(*LIES[lies], 0.0)))
    return Observation(time_s, zeros, zeros, zeros, orientation, three, three, feet, feet)


def motions(control: WalkingRobotControl, lies: dict[str, str], until_s: float) -> list[str]:
    """Return the motions of a robot that first lies on its back, and then as they lead to."""
    found: list[str] = []
    now = BACK
    for tick in range(round(until_s / 0.05)):
        control.walker.update(seen(control.walker, 0.05 * tick, now))
        motion = getattr(control.walker.recovery._action, '_motion', '')
        if motion and (not found or motion != found[-1]):
            found.append(motion)
        now = lies.get(motion, now)
    return found


@pytest.mark.parametrize('lies', LIES)
def test_how_it_lies_is_recognised(lies: str) -> None:
    """From where the vertical points in the axes of the base."""
    assert lying_on(from_rpy(*LIES[lies], 0.7)[2].tolist()) == lies


def test_a_motion_is_mirrored() -> None:
    """The sides are exchanged, and what rolls or yaws turns the other way."""
    joints = {'knee': 1.0, 'hip_roll': 0.2, 'left_hip_yaw': 0.3, 'waist_yaw': 0.4}
    assert sided(joints, mirrored=False) == {
        'left_knee': 1.0,
        'right_knee': 1.0,
        'left_hip_roll': 0.2,
        'right_hip_roll': -0.2,
        'left_hip_yaw': 0.3,
        'waist_yaw': 0.4,
    }
    mirrored = sided({'left_hip_yaw': 0.3, 'right_knee': 1.0, 'waist_yaw': 0.4}, mirrored=True)
    assert mirrored == {'right_hip_yaw': -0.3, 'left_knee': 1.0, 'waist_yaw': -0.4}


@pytest.mark.parametrize('mirrored', [False, True])
def test_the_joints_reach_every_keyframe(mirrored: bool) -> None:
    """No keyframe is beyond the range of a joint."""
    drives = load_drives()
    for keyframe in (each for motion in MOTIONS.values() for each in motion):
        for joint, angle_rad in sided(keyframe.joints_rad, mirrored).items():
            assert drives[joint].lower <= angle_rad <= drives[joint].upper, joint


def test_each_motion_follows_from_how_it_lies(robot: Robot) -> None:
    """From its back it rolls over, kneels and rises."""
    leads = {ROLL_OVER: FACE, KNEEL: UPRIGHT}
    found = motions(control_of(robot), leads, 18.0)
    assert found[:4] == [STRETCH, ROLL_OVER, KNEEL, RISE]


def test_it_gives_up(robot: Robot) -> None:
    """Who does not roll over tries again, some times, and is limp in the end."""
    control = control_of(robot)
    found = motions(control, {}, 30.0)
    assert found == [STRETCH, ROLL_OVER] * FALL.get_up_tries
    assert control.walker.recovery.has_given_up
    assert control.walker.phase == 'fallen'
    assert not control.walker.recovery.will_get_up


def test_a_stop_keeps_it_down(robot: Robot) -> None:
    """It does not get up, or goes limp while it does, and gets up when it is released."""
    control = control_of(robot)
    control.control.hold_still(True)
    assert motions(control, {}, 8.0) == []
    assert not control.walker.recovery.will_get_up
    control.control.hold_still(False)
    assert control.walker.recovery.will_get_up
    control.walker.update(seen(control.walker, 9.0, BACK))
    assert control.walker.phase == 'stand_up'
    control.control.hold_still(True)
    lying = seen(control.walker, 9.1, BACK)
    control.walker.update(lying)
    assert control.walker.phase == 'fallen'
    assert not control.walker.recovery.has_given_up


def test_it_stays_down_if_it_is_to(robot: Robot) -> None:
    """A parameter turns getting up off."""
    walk = replace(WalkParameters(), fall=replace(FALL, get_up=False))
    assert motions(WalkingRobotControl.of(robot, load_drives(), walk), {}, 8.0) == []
