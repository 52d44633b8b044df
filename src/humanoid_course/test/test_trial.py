# SPDX-License-Identifier: Apache-2.0
"""Check what a trial is kept apart from, and the types of readings that it knows."""

from __future__ import annotations

from pathlib import Path

from humanoid_course.observer import number_field_of
from humanoid_course.trial import without_prefixes
import pytest

INDEX = Path('share', 'ament_index', 'resource_index', 'packages')


def test_an_earlier_build_is_left_out(tmp_path: Path) -> None:
    """Modules that only an earlier build has are not found; a folder of many packages stays."""
    alone, shared = tmp_path / 'install' / 'temperature_monitor', tmp_path / 'jazzy'
    for prefix, names in ((alone, ('a',)), (shared, ('a', 'b'))):
        (prefix / INDEX).mkdir(parents=True)
        for name in names:
            (prefix / INDEX / name).touch()
    variables = {'PYTHONPATH': f'{alone}/lib/python:{shared}/lib/python:', 'LANG': 'C'}
    left = without_prefixes(variables, [str(alone), str(shared)])
    assert left == {'PYTHONPATH': f'{shared}/lib/python:', 'LANG': 'C'}


@pytest.mark.parametrize(
    ('kind', 'name'),
    [
        ('std_msgs/msg/Float32', 'data'),
        ('sensor_msgs/msg/Temperature', 'temperature'),
        ('std_msgs/msg/String', ''),
        ('no_such_msgs/msg/Float32', ''),
        ('', ''),
    ],
)
def test_number_of_a_type(kind: str, name: str) -> None:
    """The number is found in the usual types; others, and those that are not there, have none."""
    assert number_field_of(kind) == name
