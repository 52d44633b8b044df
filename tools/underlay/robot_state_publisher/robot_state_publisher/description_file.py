# SPDX-License-Identifier: Apache-2.0
"""Loading of a robot description from a file given on the command line."""

from __future__ import annotations

from rclpy.parameter import Parameter
from urdf import read_urdf_file

__all__ = ['file_argument', 'parameters_from_file']


def file_argument(program: str, words: list[str]) -> str | None:
    """
    Parse a command line that may name a URDF file.

    Parameters
    ----------
    program
        The name of the program, for the error message.
    words
        The non-ROS arguments.

    Returns
    -------
    str or None
        The file; None if there are no arguments.

    Raises
    ------
    ValueError
        There is more than one argument, or an option.

    """
    if len(words) > 1 or any(word.startswith('-') for word in words):
        raise ValueError(
            f'{program} takes one URDF file at most and no options, but not {" ".join(words)}. '
            'Parameters are given after --ros-args -p.'
        )
    return words[0] if words else None


def parameters_from_file(file: str | None) -> list[Parameter]:
    """
    Read a URDF file into the parameter robot_description.

    Parameters
    ----------
    file
        The path of the file; None for no parameter.

    Returns
    -------
    list of Parameter
        One parameter, or none without a file.

    Raises
    ------
    UrdfError
        The file cannot be read.

    """
    if file is None:
        return []
    return [Parameter('robot_description', Parameter.Type.STRING, read_urdf_file(file))]
