# SPDX-License-Identifier: Apache-2.0
"""Substitutions that change parameter files, and poses of robots from the command line."""

from __future__ import annotations

from pathlib import Path
import sys
from typing import Any

from launch import LaunchContext, LaunchDescription, LaunchService
from launch.actions import OpaqueFunction
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration, SubstitutionFailure, TextSubstitution
from nav2_common.launch import HasNodeParams, ParseMultiRobotPose, ReplaceString, RewrittenYaml
import pytest
import yaml

TEXT = """\
amcl:
  ros__parameters:
    use_sim_time: false
    base: <robot>/base
    laser: {max: 3.5, names: [a, b]}
map_server:
  ros__parameters:
    use_sim_time: false
    yaml_filename: ""
"""


@pytest.fixture
def path(tmp_path: Path) -> str:
    """Write a parameter file."""
    file = tmp_path / 'p.yaml'
    file.write_text(TEXT)
    return str(file)


@pytest.fixture
def context() -> LaunchContext:
    """Return a context with a namespace."""
    made = LaunchContext()
    made.launch_configurations.update(ns='left', yes='true', no='false')
    return made


def _rewritten(context: LaunchContext, path: Any, rewrites: Any, **options: Any) -> Any:
    made = RewrittenYaml(path, rewrites, **options).perform(context)
    return yaml.safe_load(Path(made).read_text())


def test_names_and_paths(context, path):
    """A name counts everywhere, a path in one place; the file itself stays as it was."""
    data = _rewritten(
        context,
        [TextSubstitution(text=path)],
        {'use_sim_time': 'true', 'amcl.ros__parameters.laser.max': '7'},
        convert_types=True,
    )
    assert data['amcl']['ros__parameters']['use_sim_time'] is True
    assert data['map_server']['ros__parameters']['use_sim_time'] is True
    assert data['amcl']['ros__parameters']['laser'] == {'max': 7, 'names': ['a', 'b']}
    assert Path(path).read_text() == TEXT


def test_paths_that_are_added(context, path):
    """A path that is not there is added; a name that is not there is not."""
    rewrites = {
        'amcl.ros__parameters.new.deep': '1.5',
        'nowhere': '1',
        'other.ros__parameters.a': 'x',
    }
    data = _rewritten(context, path, rewrites, convert_types=True)
    assert data['amcl']['ros__parameters']['new'] == {'deep': 1.5}
    assert data['other'] == {'ros__parameters': {'a': 'x'}}
    assert 'nowhere' not in str(data)


def test_root_key(context, path):
    """All is put below the namespace, unless that is empty."""
    data = _rewritten(context, path, {}, root_key=LaunchConfiguration('ns'))
    assert data == {'left': yaml.safe_load(TEXT)}
    assert _rewritten(context, path, {}, root_key='') == yaml.safe_load(TEXT)


def test_new_keys_and_values(context, path):
    """Keys and values are replaced wherever they are."""
    data = _rewritten(
        context,
        path,
        {},
        key_rewrites={'amcl': LaunchConfiguration('ns'), 'max': 'most'},
        value_rewrites={'b': 'c', '<robot>/base': '7'},
        convert_types=True,
    )
    assert data['left']['ros__parameters']['laser'] == {'most': 3.5, 'names': ['a', 'c']}
    assert data['left']['ros__parameters']['base'] == 7


@pytest.mark.parametrize(
    ('text', 'value'),
    [('True', True), ('false', False), ('3', 3), ('-0.5', -0.5), ('1e-3', 0.001), ('a1', 'a1')],
)
def test_types(context, path, text, value):
    """Texts become what they read as, if that is asked for."""
    rewrites = {'yaml_filename': text}
    changed = _rewritten(context, path, rewrites, convert_types=True)['map_server']
    assert changed['ros__parameters']['yaml_filename'] == value
    assert type(changed['ros__parameters']['yaml_filename']) is type(value)
    same = _rewritten(context, path, rewrites)['map_server']
    assert same['ros__parameters']['yaml_filename'] == text


def test_files_that_cannot_be_read(context, tmp_path):
    """The error names the file."""
    with pytest.raises(
        SubstitutionFailure, match=r"The file '/no.yaml' cannot be read: .*No such"
    ):
        RewrittenYaml('/no.yaml', {}).perform(context)
    (tmp_path / 'bad.yaml').write_text('a: [')
    with pytest.raises(SubstitutionFailure, match=r"bad.yaml' is not valid YAML: "):
        RewrittenYaml(str(tmp_path / 'bad.yaml'), {}).perform(context)
    (tmp_path / 'list.yaml').write_text('- a\n- b\n')
    with pytest.raises(SubstitutionFailure, match=r"list.yaml' must map the names of nodes"):
        RewrittenYaml(str(tmp_path / 'list.yaml'), {'a.b': '1'}).perform(context)
    (tmp_path / 'empty.yaml').write_text('')
    assert _rewritten(context, str(tmp_path / 'empty.yaml'), {'a.b': '1'}) == {'a': {'b': '1'}}


def test_copies_go_with_the_launch(path):
    """No file is left when the launch has ended."""
    made: list[str] = []

    def note(context: LaunchContext) -> None:
        made.append(RewrittenYaml(path, {}).perform(context))
        made.append(ReplaceString(path, {'a': 'b'}).perform(context))
        assert all(Path(each).exists() for each in made)

    service = LaunchService(noninteractive=True)
    service.include_launch_description(LaunchDescription([OpaqueFunction(function=note)]))
    assert service.run() == 0
    assert len(made) == 2 and not any(Path(each).exists() for each in made)


def test_replaced_texts(context, path):
    """Texts are replaced in a copy; with a condition that is false the file itself is meant."""
    made = ReplaceString(path, {'<robot>': ('/', LaunchConfiguration('ns'))})
    assert 'base: /left/base' in Path(made.perform(context)).read_text()
    for name, is_same in (('yes', False), ('no', True)):
        condition = IfCondition(LaunchConfiguration(name))
        made = ReplaceString(path, {'<robot>': ''}, condition=condition)
        assert (made.perform(context) == path) is is_same


def test_has_node_params(context, path):
    """It tells whether the file has something for a node."""
    assert HasNodeParams(path, 'amcl').perform(context) == 'True'
    assert HasNodeParams(path, LaunchConfiguration('ns')).perform(context) == 'False'
    assert HasNodeParams(path, 'ros__parameters').perform(context) == 'False'


def test_poses_of_robots(monkeypatch):
    """Each robot has all six numbers, 0 where nothing is said."""
    word = 'robots:=r1={x: 1.0, yaw: 1.5}; r2={};'
    monkeypatch.setattr(sys, 'argv', ['ros2', 'launch', 'robots:=old={}', word])
    rest = {'y': 0.0, 'z': 0.0, 'roll': 0.0, 'pitch': 0.0}
    assert ParseMultiRobotPose('robots').value() == {
        'r1': {'x': 1.0, 'yaw': 1.5, **rest},
        'r2': {'x': 0.0, 'yaw': 0.0, **rest},
    }
    assert ParseMultiRobotPose('others').value() == {}


@pytest.mark.parametrize(
    'word', ['r1', 'r1={x: }', '={x: 1}', 'r1={a: 1}', 'r1={x: [', 'r1={x: b}']
)
def test_poses_that_cannot_be_read(monkeypatch, word):
    """The error shows how it is written."""
    monkeypatch.setattr(sys, 'argv', ['ros2', f'robots:={word}'])
    with pytest.raises(ValueError, match=r'Write it as name=\{x: 1\.0'):
        ParseMultiRobotPose('robots').value()
