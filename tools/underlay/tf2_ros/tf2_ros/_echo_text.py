# SPDX-License-Identifier: Apache-2.0
"""Format transforms for tf2_echo."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any


def echo_text(message: Any, precision: int) -> str:
    """
    Format a transform as tf2_echo prints it: translation, quaternion, RPY and matrix.

    Parameters
    ----------
    message
        The `geometry_msgs/TransformStamped`.
    precision
        Digits after the decimal point.

    Returns
    -------
    str
        Several lines: translation in m, rotation also as roll, pitch and yaw in rad and in
        degrees.

    """
    from scipy.spatial.transform import Rotation

    place, turn = message.transform.translation, message.transform.rotation
    translation = [place.x, place.y, place.z]
    quaternion = [turn.x, turn.y, turn.z, turn.w]
    rotation = Rotation.from_quat(quaternion)
    rows = [[*row, x] for row, x in zip(rotation.as_matrix().tolist(), translation)]
    return '\n'.join(
        [
            f'At time {_time(message.header.stamp)}',
            f'- Translation: {_vector(translation, precision)}',
            f'- Rotation: in Quaternion (xyzw) {_vector(quaternion, precision)}',
            f'- Rotation: in RPY (radian) {_vector(_euler(rotation), precision)}',
            f'- Rotation: in RPY (degree) {_vector(_euler(rotation, True), precision)}',
            '- Matrix:',
            *(_row(row, precision) for row in [*rows, [0.0, 0.0, 0.0, 1.0]]),
        ]
    )


def _euler(rotation: Any, degrees: bool = False) -> list[float]:
    """Return roll, pitch and yaw; in gimbal lock (pitch 90 degrees) they are not unique."""
    import warnings

    with warnings.catch_warnings():
        warnings.simplefilter('ignore', UserWarning)
        return rotation.as_euler('xyz', degrees=degrees).tolist()  # type: ignore[no-any-return]


def _time(stamp: Any) -> str:
    """Format a time with nanoseconds; that of static transforms is 0.0."""
    if not stamp.sec and not stamp.nanosec:
        return '0.0'
    return f'{stamp.sec}.{stamp.nanosec:09d}'


def _vector(numbers: Iterable[float], precision: int) -> str:
    return '[' + ', '.join(f'{number:.{precision}f}' for number in numbers) + ']'


def _row(numbers: Iterable[float], precision: int) -> str:
    return ''.join(f' {number:{precision + 3}.{precision}f}' for number in numbers)
