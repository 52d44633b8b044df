# SPDX-License-Identifier: Apache-2.0
"""Record a walk of the robot, plot and tabulate it: `ros2 run humanoid_simulation record_gait`."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
import csv
from functools import partial
from pathlib import Path
import signal
import sys

from humanoid_control.walking import VelocityCommand, WalkingError
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.examples.gait_recording import GaitPlan, GaitRecording, record_walk
from humanoid_simulation.scene import load_scene
import numpy as np

_FEET = ('left', 'right')


def main(argv: Sequence[str] | None = None) -> int:
    """
    Record a walk and plot it, as the command `record_gait`.

    Parameters
    ----------
    argv
        Arguments of the command line, without the program; None for those of the process.

    Returns
    -------
    int
        Exit code: 0, 1 if the walk cannot be recorded or written, or 130 after Ctrl-C.

    """
    arguments = _parser().parse_args(argv)
    try:
        recording = record_walk(_plan(arguments), load_scene(arguments.scene))
        _write(recording, arguments)
    except (SimulationError, WalkingError) as error:
        print(error, file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 128 + signal.SIGINT
    return 0


def _parser() -> argparse.ArgumentParser:
    """Build the argument parser."""
    parser = argparse.ArgumentParser(
        prog='record_gait',
        description='Simulate the robot standing, walking and stopping, without ROS and as fast '
        'as possible, and plot its centre of mass, zero-moment point, feet and '
        'torques.',
    )
    for name, default, unit in (
        ('--forward', 0.25, 'm/s'),
        ('--left', 0.0, 'm/s'),
        ('--turn', 0.0, 'rad/s'),
        ('--duration', 6.0, 's of walking'),
    ):
        parser.add_argument(
            name,
            type=float,
            metavar='NUMBER',
            default=default,
            help=f'{unit} (default: {default:g})',
        )
    parser.add_argument('--scene', default='flat', help='its name or YAML file (default: flat)')
    parser.add_argument(
        '--output', type=Path, default=Path('gait.png'), help='the plot (default: gait.png)'
    )
    parser.add_argument('--csv', type=Path, help='a CSV file for a table of all values')
    return parser


def _plan(arguments: argparse.Namespace) -> GaitPlan:
    """Return the walk that the arguments describe."""
    velocity = VelocityCommand(arguments.forward, arguments.left, arguments.turn)
    return GaitPlan(velocity, arguments.duration)


def _write(recording: GaitRecording, arguments: argparse.Namespace) -> None:
    """Write the files, and print a summary."""
    from humanoid_simulation.examples.gait_plots import draw_gait  # takes a while to import

    _write_file(arguments.output, partial(draw_gait, recording))
    if arguments.csv is not None:
        _write_file(arguments.csv, partial(write_table, recording))
    way_m = recording.com_m[-1] - recording.com_m[0]
    print(
        f'{arguments.output}: {recording.times_s[-1]:.2f} s, {way_m[0]:.2f} m along x, '
        f'{way_m[1]:.2f} m along y'
    )


def _write_file(path: Path, write: Callable[[Path], None]) -> None:
    """Write a file, or raise SimulationError with its path, which errors of full disks lack."""
    try:
        write(path)
    except OSError as error:
        raise SimulationError(f'{path} cannot be written: {error.strerror}.') from error


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


if __name__ == '__main__':
    sys.exit(main())
