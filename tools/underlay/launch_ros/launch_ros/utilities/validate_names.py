# SPDX-License-Identifier: Apache-2.0
"""
Check the names of nodes and namespaces.

What is valid is recognised here; why something is not, rclpy says, which takes long to import.
"""

from __future__ import annotations

from collections.abc import Callable
import re
from typing import Any

_NODE_NAME = re.compile(r'(?=.{1,255}\Z)[A-Za-z_][A-Za-z0-9_]*')
_NAMESPACE = re.compile(r'/|(?=.{1,245}\Z)(/[A-Za-z_][A-Za-z0-9_]*)+')


class InvalidNameError(ValueError):
    """A name is not allowed in ROS; the text says why, and where."""


def validate_node_name(name: str) -> None:
    """
    Check that a text is a valid node name.

    Parameters
    ----------
    name
        The name, without a namespace.

    Raises
    ------
    InvalidNameError
        It is not allowed in ROS; the text says why, and where.

    """
    if not _NODE_NAME.fullmatch(name):
        from rclpy.validate_node_name import validate_node_name as judge

        _let_judge(judge, name)


def validate_namespace(namespace: str) -> None:
    """
    Check that a text is a valid absolute namespace.

    Parameters
    ----------
    namespace
        The namespace, with its leading slash.

    Raises
    ------
    InvalidNameError
        It is not allowed in ROS; the text says why, and where.

    """
    if not _NAMESPACE.fullmatch(namespace):
        from rclpy.validate_namespace import validate_namespace as judge

        _let_judge(judge, namespace)


def _let_judge(judge: Callable[[str], Any], name: str) -> None:
    from rclpy.exceptions import NameValidationException

    try:
        judge(name)
    except NameValidationException as error:
        raise InvalidNameError(str(error)) from error
