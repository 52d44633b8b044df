# SPDX-License-Identifier: Apache-2.0
"""What a node is given: a robot description as a file, and parameters that it does not declare."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from typing import Any, TYPE_CHECKING

from rclpy.parameter import Parameter
from ros_environment.suggestions import did_you_mean
from urdf import read_urdf_file

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = [
    'file_argument',
    'given_parameters',
    'parameters_from_file',
    'unknown_overrides',
    'unknown_parameters',
]

OF_ROS = ('use_sim_time', 'start_type_description_service', 'qos_overrides.')


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
            f'{program} takes at most one URDF file and no options, not {" ".join(words)}. '
            'Pass parameters after --ros-args -p.'
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


def unknown_parameters(
    given: Iterable[str], known: Collection[str], prefixes: tuple[str, ...] = ()
) -> list[str]:
    """
    Format a warning for each parameter that the node does not declare.

    Parameters
    ----------
    given
        The names of the parameters that were given to the node.
    known
        The names that the node declares.
    prefixes
        Allowed prefixes of names, in addition to those of ROS.

    """
    return [
        f"There is no parameter '{name}'. {did_you_mean(name, known, 0.75)}".rstrip()
        for name in given
        if name not in known and not name.startswith((*OF_ROS, *prefixes))
    ]


def given_parameters(node: Node) -> dict[str, Any]:
    """
    Return the values of the parameter overrides of a node, declared or not, by name.

    Parameters
    ----------
    node
        The node.

    """
    overrides = getattr(node, '_parameter_overrides', {})  # rclpy has no public API for them
    return {name: override.value for name, override in overrides.items()}


def unknown_overrides(node: Node) -> list[str]:
    """
    Format a warning for each parameter override that a node has not declared.

    Parameters
    ----------
    node
        The node, once it has declared all its parameters.

    """
    return unknown_parameters(given_parameters(node), node.get_parameters_by_prefix('').keys())
