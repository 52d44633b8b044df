# SPDX-License-Identifier: Apache-2.0
"""Check what a policy file may say, and the sentences about its mistakes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from humanoid_common.tables import TableError
from humanoid_control.policy import read_policy_file
from humanoid_control.policy.testing import CONTENT, write
import pytest

ACTION, OBSERVATION = CONTENT['action'], CONTENT['observation']


def test_what_a_file_says(tmp_path: Path) -> None:
    """Values in the order of the joints; what is left out has its default."""
    file = read_policy_file(write(tmp_path, kp_nm_rad=[40.0, 30], torque_limit_nm=15.0))
    assert file.model == tmp_path / 'moves.onnx'
    assert file.joints == ('left_knee', 'left_elbow')
    assert file.default_rad.tolist() == [0.2, -0.1]
    assert file.kp_nm_rad is not None and file.kp_nm_rad.tolist() == [40.0, 30.0]
    assert file.kd_nm_s_rad is None
    assert file.torque_limit_nm.tolist() == [15.0, 15.0]
    assert file.action_scale_rad.tolist() == [0.5, 0.5]
    assert [(term.name, term.size) for term in file.terms] == [
        ('joint_pos_rel', 2), ('last_action', 2)
    ]  # fmt: skip
    assert (file.history_length, file.history_order, file.input_size) == (1, 'by_term', 4)


def test_the_size_of_the_input(tmp_path: Path) -> None:
    """All terms, as often as the history is long."""
    terms = [{'name': 'base_ang_vel'}, {'name': 'joint_vel_rel'}]
    file = read_policy_file(write(tmp_path, observation={'terms': terms, 'history_length': 5}))
    assert file.input_size == 5 * (3 + 2)


@pytest.mark.parametrize(
    ('changes', 'sentence'),
    [
        ({'model': None}, "lacks the required key 'model'."),
        ({'rate_hz': 0}, 'rate_hz must be a finite number from 1 to 500, but is 0.'),
        ({'rate_hz': True}, 'rate_hz must be a finite number'),
        ({'rate': 50}, "unknown key 'rate'. Did you mean 'rate_hz'?"),
        ({'joints': []}, 'joints must be a list of names'),
        ({'joints': ['left_knee', 'left_knee']}, 'a list of names, each once'),
        (
            {'default_rad': {'left_nee': 0.2}},
            "names an unknown 'left_nee'. Did you mean 'left_knee'?",
        ),
        ({'default_rad': {'left_knee': 0.2}}, 'default_rad must be a number, or 2 of them'),
        ({'default_rad': [0.1]}, 'default_rad must be a number, or 2 of them'),
        ({'kp_nm_rad': -1.0}, 'kp_nm_rad must be zero or more, but is -1.0.'),
        ({'action': 0.5}, 'action must be a mapping of names to values, but is 0.5.'),
        ({'action': {**ACTION, 'clip': [1.0, -1.0]}}, 'two bounds, the lower one first'),
        ({'action': {**ACTION, 'clip': 1.0}}, 'action.clip must be a list of two bounds'),
        ({'observation': {'terms': []}}, 'Give at least one term.'),
        (
            {'observation': {'terms': [{'name': 'joint_pos'}]}},
            'observation.terms[0].name must be one of base_ang_vel',
        ),
        (
            {'observation': {'terms': [{'name': 'base_ang_vel', 'scale': [1.0, 2.0]}]}},
            'observation.terms[0].scale must be a number, or 3 of them',
        ),
        (
            {'observation': {**OBSERVATION, 'history_order': 'by_turn'}},
            "Did you mean 'by_term'?",
        ),
        (
            {'observation': {**OBSERVATION, 'history_length': 0}},
            'a whole number from 1 to 100, but is 0.',
        ),
        (
            {'observation': {**OBSERVATION, 'history_length': 1.5}},
            'a whole number from 1 to 100, but is 1.5.',
        ),
        ({'action': {'scale_rad': float('inf')}}, 'action.scale_rad must be finite'),
    ],
)
def test_mistakes(tmp_path: Path, changes: dict[str, Any], sentence: str) -> None:
    """Each is said with the file, the key and what it must be."""
    path = write(tmp_path, **changes)
    with pytest.raises(TableError) as caught:
        read_policy_file(path)
    assert str(caught.value).startswith(f'{path}, line ')
    assert sentence in str(caught.value)


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    """None there, no text, no YAML, and no table."""
    path = tmp_path / 'none.yaml'
    with pytest.raises(TableError, match='cannot be read: No such file'):
        read_policy_file(path)
    path.write_bytes(b'\xff\xfe')
    with pytest.raises(TableError, match='is not a valid YAML file'):
        read_policy_file(path)
    path.write_text('joints: [a')
    with pytest.raises(TableError, match='is not a valid YAML file'):
        read_policy_file(path)
    path.write_text('- a\n')
    with pytest.raises(TableError, match='must be a mapping of names to values'):
        read_policy_file(path)


def test_numbers_that_are_too_large(tmp_path: Path) -> None:
    """No array can have them."""
    path = write(tmp_path)
    path.write_text(path.read_text() + f'torque_limit_nm: 1{"0" * 400}\n')
    with pytest.raises(TableError, match=r'torque_limit_nm must be a number.*is 1000.*\.\.\.'):
        read_policy_file(path)
