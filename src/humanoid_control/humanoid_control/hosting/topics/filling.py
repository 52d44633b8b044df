# SPDX-License-Identifier: Apache-2.0
"""
Fill messages again and again, cheaply.

Messages are made once. Arrays are written to in place: assigning a list would check each element.
"""

from __future__ import annotations

from typing import Any

from builtin_interfaces.msg import Time
from humanoid_control.backends import Array
import numpy as np


def fill_stamp(stamp: Time, time_s: float) -> None:
    """Write a time in seconds."""
    nanoseconds = round(time_s * 1e9)
    stamp.sec, stamp.nanosec = divmod(nanoseconds, 1_000_000_000)


def fill_vector(vector: Any, values: Array) -> None:
    """Write x, y and z."""
    vector.x, vector.y, vector.z = values.tolist()


def fill_quaternion(quaternion: Any, values: Array) -> None:
    """Write a quaternion that is given as w, x, y, z."""
    quaternion.w, quaternion.x, quaternion.y, quaternion.z = values.tolist()


def view(values: Any) -> Array:
    """Return the array of a message's field, to write to."""
    return np.frombuffer(values, dtype=np.float64)


def topic(robot: str, name: str) -> str:
    """Return the relative name of a robot's topic."""
    return f'{robot}/{name}' if robot else name
