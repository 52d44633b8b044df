# SPDX-License-Identifier: Apache-2.0
"""Plot a recorded walk."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from humanoid_simulation.examples.gait_recording import GaitRecording
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

_FEET = (('left', 'tab:green'), ('right', 'tab:red'))
_LEG_JOINTS = ('hip_roll', 'hip_pitch', 'knee', 'ankle_pitch', 'ankle_roll')
_CLOSE = {'handlelength': 1.0, 'columnspacing': 1.0}
_COM, _ZMP = 'tab:blue', 'tab:orange'


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
    for side, _ in _FEET:
        _torques(rows[side], recording, side)
    figure.savefig(path, format='png', dpi=100)


def _legend(axes: Any) -> None:
    """Add a legend above the lines."""
    axes.margins(y=0.15)
    axes.legend(loc='upper center', ncols=5, fontsize='small', **_CLOSE)


def _above(axes: Any, recording: GaitRecording) -> None:
    """Plot the paths of the CoM and the ZMP on the ground, and the footholds."""
    for foot, (side, color) in enumerate(_FEET):
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
    for foot, (side, color) in enumerate(_FEET):
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
