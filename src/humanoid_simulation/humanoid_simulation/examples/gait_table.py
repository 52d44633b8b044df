# SPDX-License-Identifier: Apache-2.0
"""Write a recorded walk as a CSV table."""

from __future__ import annotations

import csv
from pathlib import Path

from humanoid_simulation.examples.gait_recording import GaitRecording
import numpy as np

_FEET = ('left', 'right')


def write_table(recording: GaitRecording, path: Path) -> None:
    """
    Write a recorded walk as comma-separated values, with a header line.

    Parameters
    ----------
    recording
        The walk.
    path
        The file to write, with one row per control period.

    Raises
    ------
    OSError
        The file cannot be written.

    """
    columns = _columns(recording)
    with path.open('w', newline='', encoding='utf-8') as stream:
        writer = csv.writer(stream)
        writer.writerow(columns)
        for row in np.column_stack(list(columns.values())):
            writer.writerow([f'{value:.6g}' for value in row])


def _columns(recording: GaitRecording) -> dict[str, np.ndarray]:
    """Return the columns by their names, which end with the unit."""
    columns = {'time_s': recording.times_s}
    for number, axis in enumerate('xyz'):
        columns[f'com_{axis}_m'] = recording.com_m[:, number]
    for number, axis in enumerate('xy'):
        columns[f'zmp_{axis}_m'] = recording.zmp_m[:, number]
    for foot, side in enumerate(_FEET):
        for number, axis in enumerate('xyz'):
            columns[f'{side}_sole_{axis}_m'] = recording.soles_m[:, foot, number]
        columns[f'{side}_load_n'] = recording.loads_n[:, foot]
    for number, joint in enumerate(recording.joints):
        columns[f'{joint}_nm'] = recording.efforts_nm[:, number]
    return columns
