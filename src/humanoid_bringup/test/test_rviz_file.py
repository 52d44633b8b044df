# SPDX-License-Identifier: Apache-2.0
"""Check that displays of perception are added to those of the robot."""

from __future__ import annotations

from pathlib import Path

from humanoid_bringup.rviz_file import RvizFile
from launch import LaunchContext
from launch.substitutions import SubstitutionFailure, TextSubstitution
import pytest
import yaml

CONFIG = Path(__file__).parents[1] / 'config'


def performed(base: Path, added: Path, condition: str) -> Path:
    """Return the path that the substitution stands for."""
    texts = (TextSubstitution(text=str(each)) for each in (base, added, condition))
    return Path(RvizFile(*texts).perform(LaunchContext()))


@pytest.mark.parametrize('name', ['console', 'navigation'])
def test_displays_come_after_those_that_there_are(name: str) -> None:
    """Nothing else of the file changes."""
    base = CONFIG / f'{name}.rviz'
    joined = yaml.safe_load(
        performed(base, CONFIG / 'perception_displays.rviz', 'true').read_text()
    )
    before = yaml.safe_load(base.read_text())
    displays = joined['Visualization Manager'].pop('Displays')
    old = before['Visualization Manager'].pop('Displays')
    assert displays[:-2] == old
    assert [each['Name'] for each in displays[-2:]] == ['Objects', 'Detections']
    assert joined == before


def test_without_perception_the_file_is_taken_as_it_is() -> None:
    """It is not even copied."""
    base = CONFIG / 'console.rviz'
    assert performed(base, CONFIG / 'none.rviz', 'false') == base


def test_a_file_that_is_no_rviz_file_is_refused(tmp_path: Path) -> None:
    """The error names it."""
    bad = tmp_path / 'bad.rviz'
    for text in ('- a\n', 'Visualization Manager: {}\n', '{'):
        bad.write_text(text)
        with pytest.raises(SubstitutionFailure, match=r'bad\.rviz'):
            performed(CONFIG / 'console.rviz', bad, 'true')
