# SPDX-License-Identifier: Apache-2.0
"""How joints are grouped by limb."""

from __future__ import annotations

from collections.abc import Mapping

from joint_state_publisher_gui.limbs import limbs, words_of
import pytest
from urdf import parse_urdf, RobotModel

HUMANOID = {
    'waist_yaw': None,
    'head_yaw': 'waist_yaw',
    'head_pitch': 'head_yaw',
    **{
        name: parent
        for side in ('left', 'right')
        for name, parent in (
            (f'{side}_shoulder', 'waist_yaw'),
            (f'{side}_shoulder_roll', f'{side}_shoulder'),
            (f'{side}_elbow', f'{side}_shoulder_roll'),
            (f'{side}_hip_pitch', None),
            (f'{side}_knee', f'{side}_hip_pitch'),
            (f'{side}_ankle_roll', f'{side}_knee'),
        )
    },
}


def robot(parents: Mapping[str, str | None], kinds: Mapping[str, str] | None = None) -> RobotModel:
    """Return a robot whose joints follow each other as a mapping says."""
    kinds = kinds or {}
    text = ''.join(
        f'<link name="{name}_link"/><joint name="{name}" type="{kinds.get(name, "continuous")}">'
        f'<parent link="{f"{parent}_link" if parent else "root"}"/>'
        f'<child link="{name}_link"/></joint>'
        for name, parent in parents.items()
    )
    return parse_urdf(f'<robot name="r"><link name="root"/>{text}</robot>')


def chain(*names: str) -> dict[str, str | None]:
    """Return joints that follow one another."""
    return dict(zip(names, (None, *names)))


def grouped(parents: Mapping[str, str | None], **kinds: str) -> dict[str, list[str]]:
    """Return the joints by the title of their group."""
    model = robot(parents, kinds)
    return {limb.title: list(limb.joints) for limb in limbs(model, parents)}


def test_humanoid() -> None:
    """Torso, head, arms and legs are groups, in the order of the URDF."""
    assert grouped(HUMANOID) == {
        'Torso': ['waist_yaw'],
        'Head': ['head_yaw', 'head_pitch'],
        'Left arm': ['left_shoulder', 'left_shoulder_roll', 'left_elbow'],
        'Left leg': ['left_hip_pitch', 'left_knee', 'left_ankle_roll'],
        'Right arm': ['right_shoulder', 'right_shoulder_roll', 'right_elbow'],
        'Right leg': ['right_hip_pitch', 'right_knee', 'right_ankle_roll'],
    }


def test_labels_leave_out_the_side() -> None:
    """Below a title with the side, a joint's label has no side."""
    model = robot({'left_knee': None, 'r_knee': None, 'knee_l': None, 'left_': None})
    labels = {
        name: limb.label(name)
        for limb in limbs(model, ['left_knee', 'r_knee', 'knee_l', 'left_'])
        for name in limb.joints
    }
    assert labels == {'left_knee': 'knee', 'r_knee': 'knee', 'knee_l': 'knee_l', 'left_': 'left_'}


@pytest.mark.parametrize(
    ('parents', 'groups'),
    [
        (chain('joint1', 'joint2', 'joint3'), {'Joints': ['joint1', 'joint2', 'joint3']}),
        (
            chain('shoulder_pan_joint', 'shoulder_lift_joint', 'elbow_joint', 'wrist_1_joint'),
            {'Arm': ['shoulder_pan_joint', 'shoulder_lift_joint', 'elbow_joint', 'wrist_1_joint']},
        ),
        (
            {
                **chain('panda_joint1', 'panda_joint2'),
                'panda_finger_joint1': 'panda_joint2',
                'panda_finger_joint2': 'panda_joint2',
            },
            {
                'Joints': ['panda_joint1', 'panda_joint2'],
                'Hand': ['panda_finger_joint1', 'panda_finger_joint2'],
            },
        ),
    ],
)
def test_arms(parents, groups) -> None:
    """An arm is a group, and so is its hand; names without words are one group too."""
    assert grouped(parents) == groups


def test_names_in_capitals() -> None:
    """Names that put words together are understood."""
    assert words_of('LHipYawPitch2') == ['l', 'hip', 'yaw', 'pitch']
    assert grouped({'HeadYaw': None, 'LShoulderPitch': None, 'RAnkleRoll': None}) == {
        'Head': ['HeadYaw'],
        'Left arm': ['LShoulderPitch'],
        'Right leg': ['RAnkleRoll'],
    }


def test_four_legs_are_four_groups() -> None:
    """The corner of a leg is a side."""
    parents: dict[str, str | None] = {}
    for corner in ('FL', 'RR', 'front_right', 'rear_left'):
        parents |= chain(f'{corner}_hip_joint', f'{corner}_calf_joint')
    assert list(grouped(parents)) == [
        'Front left leg',
        'Rear right leg',
        'Front right leg',
        'Rear left leg',
    ]


def test_branches_without_a_side_are_groups_of_their_own() -> None:
    """Six legs have the titles that their names begin with."""
    parents = {}
    for number in (1, 2):
        parents |= chain(f'leg{number}_coxa', f'leg{number}_tibia')
    assert grouped(parents) == {
        'leg1': ['leg1_coxa', 'leg1_tibia'],
        'leg2': ['leg2_coxa', 'leg2_tibia'],
    }


def test_unknown_names_belong_to_the_limb_before_them() -> None:
    """A joint whose name tells nothing goes on with the branch, and fixed joints do not end it."""
    parents = chain('left_shoulder', 'flange', 'j5')
    parents['spare'] = 'left_shoulder'
    assert grouped(parents, flange='fixed') == {
        'Left arm': ['left_shoulder'],
        'Left': ['j5', 'spare'],
    }
    del parents['spare']
    model = robot(parents, {'flange': 'fixed'})
    assert [limb.joints for limb in limbs(model, parents)] == [('left_shoulder', 'j5')]


def test_eyes_and_wheels_have_no_side() -> None:
    """What is one group for both sides stays together."""
    parents = chain('neck') | {'left_eye': 'neck', 'right_eye': 'neck', 'wheel_l': None}
    assert grouped(parents | {'wheel_r': None}) == {
        'Head': ['neck', 'left_eye', 'right_eye'],
        'Wheels': ['wheel_l', 'wheel_r'],
    }


def test_only_the_named_joints() -> None:
    """Joints that follow others get no slider, but do not part a branch."""
    model = robot(chain('left_hip', 'left_knee', 'j3'))
    (limb,) = limbs(model, ['left_hip', 'j3'])
    assert (limb.title, limb.joints) == ('Left leg', ('left_hip', 'j3'))
