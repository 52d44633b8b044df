# SPDX-License-Identifier: Apache-2.0
"""Check what the benchmark of the journeys through the code counts."""

from __future__ import annotations

from pathlib import Path
import sys

import pytest
from ros_environment.suggestions import did_you_mean

sys.path.append(str(Path(__file__).resolve().parents[1] / 'benchmarks'))

from journeys import own_file, Recorder, ROOT


@pytest.mark.parametrize(
    ('executed', 'own'),
    [
        (f'{ROOT}/src/a/a/b.py', 'src/a/a/b.py'),
        ('/x/site-packages/launch/action.py', 'tools/underlay/launch/launch/action.py'),
        ('/x/site-packages/numpy/linalg/linalg.py', ''),
        ('/usr/lib/python3/json/decoder.py', ''),
        (f'{ROOT}/tools/benchmarks/journeys.py', ''),
        ('<string>', ''),
    ],
)
def test_only_files_of_this_project_count(executed: str, own: str) -> None:
    """An installed copy counts as its source."""
    assert own_file(executed) == own


def test_a_function_counts_once() -> None:
    """However often it is called; nothing counts before and after."""
    recorder = Recorder()
    did_you_mean('before', ['be'])
    with recorder.recording():
        did_you_mean('lunch', ['launch'])
        did_you_mean('run', ['launch'])
    functions = recorder.functions()
    assert [each.name for each in functions].count('did_you_mean') == 1
    assert {each.file for each in functions} == {
        'tools/underlay/ros_environment/ros_environment/suggestions.py'
    }
