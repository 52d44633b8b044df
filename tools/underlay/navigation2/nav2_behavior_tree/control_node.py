# SPDX-License-Identifier: Apache-2.0
"""Base classes of tree nodes with children, which they tick and halt."""

from __future__ import annotations

from nav2_behavior_tree.node import TreeNode
from nav2_behavior_tree.status import NodeStatus

__all__ = ['Control', 'Decorator']


class Control(TreeNode):
    """Base class of nodes with children."""

    least_children = 1
    most_children = 10_000
    children: list[TreeNode]

    def halt_child(self, child: TreeNode) -> None:
        """
        Halt a child if it is running, and reset it to IDLE.

        Parameters
        ----------
        child
            One of the children.

        """
        if child.state is NodeStatus.RUNNING:
            child.halt_node()
        child.set_state(NodeStatus.IDLE)

    def halt_children(self) -> None:
        """Halt all children, and reset them to IDLE."""
        for child in self.children:
            self.halt_child(child)

    def on_halt(self) -> None:
        """Halt all children."""
        self.halt_children()

    def finish(self, status: NodeStatus) -> NodeStatus:
        """
        Halt all children, reset them to IDLE, and return a status.

        Parameters
        ----------
        status
            The final status of the node, which is returned unchanged.

        """
        self.halt_children()
        return status


class Decorator(Control):
    """Base class of nodes with one child."""

    most_children = 1

    @property
    def child(self) -> TreeNode:
        """Return the child."""
        return self.children[0]
