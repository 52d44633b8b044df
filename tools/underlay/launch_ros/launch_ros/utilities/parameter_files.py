# SPDX-License-Identifier: Apache-2.0
"""Check existing parameter files and write temporary ones."""

from __future__ import annotations

from collections.abc import Mapping
import os
from typing import Any

from launch._temporary_files import is_temporary_file, write_temporary_file
from launch.logging import get_logger
from launch_ros.utilities.yaml_text import parameter_file_text


def is_parameter_file(path: str) -> bool:
    """
    Whether a parameter file exists; if not, warnings with advice are logged.

    Parameters
    ----------
    path
        The file.

    """
    if os.path.isfile(path):
        return True
    from launch._missing_file import explain_missing_file

    logger = get_logger('launch_ros.actions.node')
    logger.warning('Parameter file path is not a file: %s', path)
    advice = explain_missing_file('file', path)
    logger.warning('The node gets no parameters from it, because %s', advice)
    return False


def write_parameter_file(node_name: str, parameters: Mapping[str, Any]) -> str:
    """
    Write parameters to a temporary parameter file and return its path.

    Parameters
    ----------
    node_name
        The fully qualified name of the target nodes, or `/**` for all nodes.
    parameters : Mapping[str, Any]
        Plain values by parameter name.

    """
    return write_text(parameter_file_text(node_name, parameters))


def write_text(text: str) -> str:
    """
    Write a temporary file and return its path; it is removed when the launch ends.

    Parameters
    ----------
    text
        The content.

    """
    return write_temporary_file('launch_params_', text)


def is_written_here(path: str) -> bool:
    """
    Whether a file is a temporary file of the launch.

    Parameters
    ----------
    path
        The path, exactly as returned when the file was written.

    """
    return is_temporary_file(path)
