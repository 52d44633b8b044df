# SPDX-License-Identifier: Apache-2.0
"""What the benchmarks say about arguments that they cannot use."""

from __future__ import annotations

from pathlib import Path
import subprocess
import sys

import pytest

ROOT = Path(__file__).resolve().parents[2]
BENCHMARKS = ROOT / 'tools' / 'benchmarks'
SCALING = ROOT / 'docs' / 'explanation' / 'scaling.md'


@pytest.mark.parametrize('name', ['bringup_cost', 'command_times', 'launch_times'])
@pytest.mark.parametrize(
    ('folder', 'sentence'),
    [
        ('/nowhere', "'/nowhere' is not a built workspace"),
        ('', 'an empty text names no folder.'),
    ],
)
def test_no_workspace_to_compare_with(name: str, folder: str, sentence: str) -> None:
    """It is a mistake in the arguments, said in a sentence before anything is measured."""
    command = [sys.executable, str(BENCHMARKS / f'{name}.py'), '--against', folder]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 2
    assert sentence in done.stderr and 'Traceback' not in done.stderr
    assert done.stdout == ''


@pytest.mark.parametrize(
    ('words', 'sentence'),
    [
        (['first_run', '--against', '/nowhere'], "'/nowhere' is not a clone of this workspace"),
        (['first_run', '--against', ''], 'an empty text names no folder.'),
        (['first_run', '--runs', '0'], "'0' is not a whole number of at least 1."),
        (['get_up_trials', '--trials', '0'], "'0' is not a whole number of at least 1."),
        (['get_up_trials', '--at-least', '2'], "'2' is not a number from 0 to 1."),
        (['gym_steps', '--runs', '0'], "'0' is not a whole number of at least 1."),
        (['walking_pushes', '--impulses', 'nan'], "'nan' is not a number of at least 0."),
        (['walking_pushes', '--impulses', ''], "'' is not a number of at least 0."),
        (['walking_pushes', '--speed', '0'], "'0' is not a number from 0.05 to 1."),
        (['walking_pushes', '--phases', '0'], "'0' is not a whole number of at least 1."),
        (['standing_pushes', '--impulses', '-1'], "'-1' is not a number of at least 0."),
        (['obstacle_trials', '--first', '-1'], "'-1' is not a whole number of at least 0."),
        (['obstacle_trials', '--trials', '0'], "'0' is not a whole number of at least 1."),
        (['speech', '--snr', '200'], "'200' is not a number from -20 to 100."),
        (['network_cut', '--loss', '2'], "'2' is not a number from 0 to 1."),
        (['odometry_errors', '--noise', 'inf'], "'inf' is not a number of at least 0."),
        (['sweep_ray', '--runs', '9'], "'9' is not a whole number of at least 10."),
        (['journeys', '--only', 'flight'], "invalid choice: 'flight'"),
        (['scaling', 'nonsense'], 'unrecognized arguments: nonsense'),
        (['fleet', '--robots', '0'], "'0' is not a whole number from 1 to 200."),
        (['fleet', '--ways', 'shouting'], "invalid choice: 'shouting'"),
        (['discovery_time', '--nodes', '1'], "'1' is not a whole number from 2 to 100."),
        (['sweep_cost', '--walks', '0'], "'0' is not a whole number of at least 1."),
        (['hand_drift', '--dampings', '0'], "'0' is not a number from 0.1 to 2.5."),
        (['hand_drift', '--seconds', '1'], "'1' is not a number of at least 4."),
        (['carry_trials', '--ways', '0'], "'0' is not a whole number of at least 1."),
        (['pick_trials', '--first', '5', '--trials', '3'], 'There are 3 trials'),
    ],
)
def test_no_number_to_begin_with(words: list[str], sentence: str) -> None:
    """A number that means nothing is refused before the robot walks."""
    command = [sys.executable, str(BENCHMARKS / f'{words[0]}.py'), *words[1:]]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 2
    assert sentence in done.stderr and 'Traceback' not in done.stderr
    assert done.stdout == ''


def test_the_page_of_scaling_has_what_is_computed() -> None:
    """Its tables follow from the measured figures; copy them anew after a measurement."""
    command = [sys.executable, str(BENCHMARKS / 'scaling.py')]
    printed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    page = SCALING.read_text()
    tables = printed.strip().split('\n\n')
    assert len(tables) == 5
    for table in tables:
        assert f'\n\n{table}\n\n' in page, 'Copy what `tools/benchmarks/scaling.py` prints.'
