# SPDX-License-Identifier: Apache-2.0
"""
Fill preallocated messages cheaply.

Messages are created once. Arrays are written to in place: assigning a list would check each
element.
"""

from __future__ import annotations

from typing import Any

from builtin_interfaces.msg import Time
from humanoid_control.backends import Array
import numpy as np


def fill_stamp(stamp: Time, time_s: float) -> None:
    """
    Write a time into a message stamp, rounded to nanoseconds.

    Parameters
    ----------
    stamp
        The stamp to write to.
    time_s
        The time.

    """
    nanoseconds = round(time_s * 1e9)
    stamp.sec, stamp.nanosec = divmod(nanoseconds, 1_000_000_000)


def fill_vector(vector: Any, values: Array) -> None:
    """
    Write an array into a Vector3 or Point.

    Parameters
    ----------
    vector
        The message to write to.
    values
        x, y and z (3,).

    """
    vector.x, vector.y, vector.z = values.tolist()


def fill_quaternion(quaternion: Any, values: Array) -> None:
    """
    Write an array into a Quaternion.

    Parameters
    ----------
    quaternion
        The message to write to.
    values
        w, x, y and z (4,): the scalar comes first.

    """
    quaternion.w, quaternion.x, quaternion.y, quaternion.z = values.tolist()


def view(values: Any) -> Array:
    """
    Make a NumPy view of a message's array field; writing to it changes the message.

    Parameters
    ----------
    values
        A field of type float64[], whose length must not change afterwards.

    Returns
    -------
    Array
        View (n,) of the memory of the field.

    """
    return np.frombuffer(values, dtype=np.float64)


def topic(robot: str, name: str) -> str:
    """
    Build the name of a robot's topic, relative to the namespace of the node.

    Parameters
    ----------
    robot
        Namespace of the robot; empty if it is alone.
    name
        Name of the topic in it.

    """
    return f'{robot}/{name}' if robot else name
