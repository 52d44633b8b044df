# SPDX-License-Identifier: Apache-2.0
"""Predicates that match actions of nodes."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from launch_ros.actions.node import Node


def matches_node_name(node_name: str) -> Callable[[Node], bool]:
    """
    Return a predicate that matches nodes by fully qualified name.

    Parameters
    ----------
    node_name
        The fully qualified name; the leading slash is optional.

    Returns
    -------
    Callable
        Whether an executed action runs such a node.

    """
    full_name = node_name if node_name.startswith('/') else f'/{node_name}'
    return lambda action: bool(action.node_name == full_name)
