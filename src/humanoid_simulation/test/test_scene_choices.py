# SPDX-License-Identifier: Apache-2.0
"""Check which values the launch argument `scene` may have."""

from __future__ import annotations

from pathlib import Path

from humanoid_common.testing.launching import (
    argument_choices,
    load_launch_file,
    running_launch_file,
)
from humanoid_common.testing.ros import ros_sandbox
from humanoid_simulation.files import installed_scenes, SceneChoices
import pytest

LAUNCH_FILE = Path(__file__).parents[1] / 'launch' / 'simulation.launch.py'


def test_names_are_the_choices() -> None:
    """Completion offers what is installed."""
    assert list(SceneChoices()) == list(installed_scenes())
    assert argument_choices(load_launch_file(LAUNCH_FILE))['scene'] == list(installed_scenes())


def test_files_are_allowed(tmp_path: Path) -> None:
    """A scene of one's own is a file that is there."""
    own = tmp_path / 'own.yaml'
    assert str(own) not in SceneChoices()
    own.touch()
    assert str(own) in SceneChoices()
    assert str(tmp_path) not in SceneChoices()


@pytest.mark.parametrize('value', ['rom', 'rooms.yaml', ''])
def test_what_is_no_scene_starts_nothing(value: str) -> None:
    """The launch ends with status 1 before it has started a process, and says what there is."""
    with ros_sandbox(), running_launch_file(LAUNCH_FILE, f'scene:={value}') as program:
        report = program.wait_for_exit(60.0)
    assert report.status == 1
    assert f'"scene" provided value "{value}" is not valid' in report.output
    assert "'room', 'uneven', or the path of a file (.yaml)" in report.output
    assert 'process started' not in report.output
