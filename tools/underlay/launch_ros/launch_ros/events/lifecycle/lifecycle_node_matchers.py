# SPDX-License-Identifier: Apache-2.0
"""Deprecated location of the node matchers."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING
import warnings

from launch_ros.events import matchers

if TYPE_CHECKING:
    from launch_ros.actions.node import Node


def matches_node_name(node_name: str) -> Callable[[Node], bool]:
    """
    Return a predicate that matches nodes by fully qualified name (deprecated here).

    Parameters
    ----------
    node_name
        As for `launch_ros.events.matches_node_name`.

    """
    warnings.warn(
        'launch_ros.events.lifecycle.matches_node_name is deprecated; import matches_node_name '
        'from launch_ros.events instead',
        UserWarning,
        stacklevel=2,
    )
    return matchers.matches_node_name(node_name)
