# SPDX-License-Identifier: Apache-2.0
"""The file of gestures is read, and each error in it has its line."""

from __future__ import annotations

import pytest
from robot_console.gestures.gesture_file import BodyPose, GestureError, read_gestures

FILE = """
optional_joints: [wrist]
poses:
  up: {shoulder: -1.5, wrist: 0}
gestures:
  Wave:
    about: Waves
    steps:
      - {seconds: 1.5, poses: [up], joints: {elbow: -1.6, wrist: 0.5}}
      - {seconds: 2}
  Bow:
    steps:
      - {seconds: 2, body: {pitch: 0.4}}
"""


def test_a_file() -> None:
    """Poses are put together, joints of the step come last, and the rest has defaults."""
    wave, bow = read_gestures(FILE, 'g.yaml')
    assert (wave.name, wave.about, wave.optional_joints) == ('Wave', 'Waves', {'wrist'})
    assert wave.steps[0].joints == {'shoulder': -1.5, 'elbow': -1.6, 'wrist': 0.5}
    assert (wave.steps[1].duration_s, wave.steps[1].joints) == (2.0, {})
    assert bow.steps[0].body == BodyPose(0.4, 0.0)
    assert bow.bends and not wave.bends


@pytest.mark.parametrize(
    ('before', 'after', 'said'),
    [
        (
            'poses: [up]',
            'poses: [pu]',
            "g.yaml:9: Step 1 of 'Wave' has the pose 'pu', which is not",
        ),
        ('poses: [up]', 'poses: up', "g.yaml:9: 'poses' must be a list of names"),
        ('seconds: 1.5', 'seconds: 0', "g.yaml:9: Step 1 of 'Wave' needs 'seconds'"),
        ('seconds: 1.5', 'seconds: soon', "g.yaml:9: Step 1 of 'Wave' needs 'seconds'"),
        ('seconds: 1.5', 'secs: 1.5', "has an unknown key 'secs'. Did you mean 'seconds'?"),
        ('shoulder: -1.5', 'shoulder: high', "'shoulder' must be a number, not 'high'"),
        ('pitch: 0.4', 'roll: 0.4', "has an unknown key 'roll'. Known are: pitch, height."),
        ('  Bow:', '  Wave:', 'g.yaml:11:'),
        (
            'about: Waves',
            'abuot: Waves',
            "g.yaml:7: The gesture 'Wave' has an unknown key 'abuot'",
        ),
        ('gestures:', 'gesture:', "Did you mean 'gestures'?"),
        ('{seconds: 2, body', '{seconds: [2, body', 'g.yaml:13'),
        ('[wrist]', 'wrist', "g.yaml:2: 'optional_joints' must be a list of names"),
    ],
)
def test_errors(before: str, after: str, said: str) -> None:
    """Each error says where it is, and what is right."""
    assert before in FILE
    with pytest.raises(GestureError) as caught:
        read_gestures(FILE.replace(before, after), 'g.yaml')
    assert said in str(caught.value)


@pytest.mark.parametrize('text', ['', '[]', 'gestures: {}', 'gestures: {Wave: {steps: []}}'])
def test_nothing(text: str) -> None:
    """A file without gestures, or with one that does nothing, is an error."""
    with pytest.raises(GestureError, match='g.yaml'):
        read_gestures(text, 'g.yaml')
