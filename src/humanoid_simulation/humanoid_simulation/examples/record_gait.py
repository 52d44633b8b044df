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
from typing import Any

from humanoid_common.errors import UserError
from humanoid_control.walking import VelocityCommand
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.examples.gait_recording import GaitPlan, GaitRecording, record_walk
from humanoid_simulation.scene import load_scene
import numpy as np

_FEET = {'left': 'tab:green', 'right': 'tab:red'}
"""The colours of the feet in plots."""
_LEG_JOINTS = ('hip_roll', 'hip_pitch', 'knee', 'ankle_pitch', 'ankle_roll')
_CLOSE = {'handlelength': 1.0, 'columnspacing': 1.0}
_COM, _ZMP = 'tab:blue', 'tab:orange'


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
    except UserError as error:
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


def draw_gait(recording: GaitRecording, path: Path) -> None:
    """
    Plot a recorded walk: CoM and ZMP, soles, loads of the feet and torques of the legs.

    Parameters
    ----------
    recording
        The walk.
    path
        The image file, a PNG whatever its suffix.

    Raises
    ------
    OSError
        The file cannot be written.

    """
    # They take a while to import.
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(12, 15), layout='constrained')
    FigureCanvasAgg(figure)
    rows = figure.subplot_mosaic(
        [['above'] * 2, ['x', 'y'], ['height', 'load'], ['left', 'right']]
    )
    _above(rows['above'], recording)
    for number, axis in enumerate('xy'):
        _balance(rows[axis], recording, number, axis)
    _feet(rows['height'], recording.times_s, recording.soles_m[:, :, 2], 'height of the sole (m)')
    _feet(rows['load'], recording.times_s, recording.loads_n, 'load (N)')
    for side in _FEET:
        _torques(rows[side], recording, side)
    figure.savefig(path, format='png', dpi=100)


def _legend(axes: Any) -> None:
    """Add a legend above the lines."""
    axes.margins(y=0.15)
    axes.legend(loc='upper center', ncols=5, fontsize='small', **_CLOSE)


def _above(axes: Any, recording: GaitRecording) -> None:
    """Plot the paths of the CoM and the ZMP on the ground, and the footholds."""
    for foot, (side, color) in enumerate(_FEET.items()):
        stands = recording.loads_n[:, foot] > 0.0
        x, y, _ = recording.soles_m[stands, foot].T
        axes.plot(x, y, 's', color=color, markersize=4, label=f'{side} sole on the ground')
    axes.plot(*recording.zmp_m.T, color=_ZMP, linewidth=0.8, label='zero-moment point')
    axes.plot(*recording.com_m[:, :2].T, color=_COM, label='centre of mass')
    axes.set(xlabel='x (m)', ylabel='y (m)', title='from above')
    axes.axis('equal')
    _legend(axes)


def _balance(axes: Any, recording: GaitRecording, number: int, axis: str) -> None:
    """Plot one coordinate of the CoM and the ZMP over time."""
    times_s = recording.times_s
    axes.plot(times_s, recording.zmp_m[:, number], color=_ZMP, linewidth=0.8, label='ZMP')
    axes.plot(times_s, recording.com_m[:, number], color=_COM, label='CoM')
    axes.set(xlabel='time (s)', ylabel=f'{axis} (m)')
    _legend(axes)


def _feet(axes: Any, times_s: Any, values: Any, label: str) -> None:
    """Plot a quantity (n, 2) of both feet over time."""
    for foot, (side, color) in enumerate(_FEET.items()):
        axes.plot(times_s, values[:, foot], color=color, label=side)
    axes.set(xlabel='time (s)', ylabel=label)
    _legend(axes)


def _torques(axes: Any, recording: GaitRecording, side: str) -> None:
    """Plot the joint torques of a leg over time."""
    for joint in _LEG_JOINTS:
        number = recording.joints.index(f'{side}_{joint}')
        axes.plot(recording.times_s, recording.efforts_nm[:, number], linewidth=0.8, label=joint)
    axes.set(xlabel='time (s)', ylabel='torque (Nm)', title=f'{side} leg')
    _legend(axes)


if __name__ == '__main__':
    sys.exit(main())
