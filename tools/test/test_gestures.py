# SPDX-License-Identifier: Apache-2.0
"""Tests that the humanoid can make the gestures that its page offers."""

from __future__ import annotations

from pathlib import Path

import pytest
from robot_console.gestures.gesture_file import Gesture, read_gestures
from robot_console.gestures.gesture_plan import plan_gesture, RobotState
from urdf import Joint, parse_urdf
import xacro

MOST_RAD_S = 1.5


@pytest.fixture(name='gestures')
def _gestures(root: Path) -> tuple[Gesture, ...]:
    """Return the gestures of the file."""
    path = root / 'src' / 'humanoid_bringup' / 'config' / 'gestures.yaml'
    return read_gestures(path.read_text(), path.name)


def joints_of(hands: str) -> dict[str, Joint]:
    """Return the moving joints of the humanoid."""
    from ament_index_python.packages import get_package_share_directory

    model = Path(get_package_share_directory('humanoid_description')) / 'urdf'
    document = xacro.process_file(str(model / 'humanoid.urdf.xacro'), mappings={'hands': hands})
    return {each.name: each for each in parse_urdf(document.toxml(), 'humanoid').moving_joints}


@pytest.mark.parametrize('hands', ['false', 'true'])
def test_the_humanoid_can_make_its_gestures(gestures: tuple[Gesture, ...], hands: str) -> None:
    """With hands or without, its joints exist, and reach each step fast enough."""
    joints = joints_of(hands)
    arms = ('_shoulder', '_elbow', '_wrist')
    controllers = {
        f'{side}_arm': tuple(name for name in joints if any(side + part in name for part in arms))
        for side in ('left', 'right')
    }
    controllers |= {'head': ('head_yaw', 'head_pitch'), 'waist': ('waist_yaw',)}
    state = RobotState(joints, controllers, dict.fromkeys(joints, 0.0))
    for gesture in gestures:
        plan = plan_gesture(gesture, state, MOST_RAD_S)
        assert plan.motions, gesture.name
        told_s = sum(step.duration_s for step in gesture.steps)
        assert plan.duration_s == pytest.approx(told_s, rel=0.35), gesture.name


def test_bent_gestures_end_upright(gestures: tuple[Gesture, ...]) -> None:
    """A body that is bent stays within what the walk allows, and is straight at the end."""
    bodies = {each.name: [step.body for step in each.steps if step.body] for each in gestures}
    assert {'Bow', 'Squat', 'Stand straight'} == {name for name, bent in bodies.items() if bent}
    for bent in filter(None, bodies.values()):
        assert bent[-1].pitch_rad == bent[-1].height_m == 0.0
        assert all(0.0 <= each.pitch_rad <= 0.5 for each in bent)
        assert all(-0.12 <= each.height_m <= 0.0 for each in bent)
