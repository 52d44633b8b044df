# SPDX-License-Identifier: Apache-2.0
"""
Validate node names and namespaces.

Valid names are recognised here; rclpy, which is slow to import, only explains invalid ones.
"""

from __future__ import annotations

from collections.abc import Callable
import re
from typing import Any

_NODE_NAME = re.compile(r'(?=.{1,255}\Z)[A-Za-z_][A-Za-z0-9_]*')
_NAMESPACE = re.compile(r'/|(?=.{1,245}\Z)(/[A-Za-z_][A-Za-z0-9_]*)+')


class InvalidNameError(ValueError):
    """A name is not allowed in ROS; the message states why, and where."""


def validate_node_name(name: str) -> None:
    """
    Validate a node name.

    Parameters
    ----------
    name
        The name, without a namespace.

    Raises
    ------
    InvalidNameError
        The name is not allowed in ROS; the message states why, and where.

    """
    if not _NODE_NAME.fullmatch(name):
        from rclpy.validate_node_name import validate_node_name as judge

        _let_judge(judge, name)


def validate_namespace(namespace: str) -> None:
    """
    Validate an absolute namespace.

    Parameters
    ----------
    namespace
        The namespace, with its leading slash.

    Raises
    ------
    InvalidNameError
        The name is not allowed in ROS; the message states why, and where.

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
