# SPDX-License-Identifier: Apache-2.0
"""Behavior trees that can be ticked and halted."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from nav2_behavior_tree.blackboard import Blackboard
from nav2_behavior_tree.builder import build
from nav2_behavior_tree.node import TreeContext, TreeNode
from nav2_behavior_tree.status import Failure, NodeStatus, StatusChange
from nav2_behavior_tree.tree_xml import Document, read_tree_file, read_tree_text

__all__ = ['BehaviorTree']

_MOST_ROUNDS = 100


class BehaviorTree:
    """
    The main tree of a document, and its blackboard.

    Parameters
    ----------
    document
        The document, as returned by `read_tree_file` or `read_tree_text`.
    now_s
        The clock of the tree, in s.
    ros
        A `RosInterface` for nodes that use ROS.
    blackboard
        The blackboard with its initial values.

    Raises
    ------
    TreeError
        The document does not define a valid tree; the error states where and why.

    """

    def __init__(
        self,
        document: Document,
        now_s: Callable[[], float],
        ros: Any = None,
        blackboard: Blackboard | None = None,
    ) -> None:
        self.blackboard = blackboard or Blackboard()
        self.context = TreeContext(now_s, ros)
        self.root: TreeNode = build(document, self.context, self.blackboard)

    @classmethod
    def from_file(cls, path: str, now_s: Callable[[], float], ros: Any = None) -> BehaviorTree:
        """
        Make the tree of an XML file.

        Parameters
        ----------
        path
            The file.
        now_s, ros
            As for the class.

        Raises
        ------
        TreeError
            The file cannot be read, or does not define a valid tree.

        """
        return cls(read_tree_file(path), now_s, ros)

    @classmethod
    def from_text(cls, text: str, now_s: Callable[[], float], ros: Any = None) -> BehaviorTree:
        """
        Make the tree of an XML text.

        Parameters
        ----------
        text
            The contents of an XML file.
        now_s, ros
            As for the class.

        Raises
        ------
        TreeError
            The text does not define a valid tree.

        """
        return cls(read_tree_text(text), now_s, ros)

    @property
    def failure(self) -> Failure | None:
        """The most recent failure that a node has reported."""
        return self.context.failure

    def tick(self) -> NodeStatus:
        """
        Tick the root, and again while a node requests it, like `tickOnce` of BehaviorTree.CPP.

        Returns
        -------
        NodeStatus
            The status of the tree: RUNNING, or its final status; all nodes are IDLE then.

        Raises
        ------
        TreeError
            A script or a value of the blackboard is invalid.

        """
        context, root = self.context, self.root
        for _ in range(_MOST_ROUNDS):
            context.tick += 1
            context.is_woken = False
            status = root.execute_tick()
            if status is not NodeStatus.RUNNING or not context.is_woken:
                break
        if status is not NodeStatus.RUNNING:
            self.halt()
        return status

    def halt(self) -> None:
        """Halt all running nodes immediately; all nodes are IDLE afterwards."""
        if self.root.state is NodeStatus.RUNNING:
            self.root.halt_node()
        for node in self.nodes():
            node.set_state(NodeStatus.IDLE)

    def renew(self) -> None:
        """Reset the nodes that count or measure time, for a newer goal on the blackboard."""
        for node in self.nodes():
            node.on_new_goal()

    def nodes(self) -> Iterator[TreeNode]:
        """Iterate over all nodes, children before parents."""
        return iter(self.root.iterate())

    def take_changes(self) -> list[StatusChange]:
        """Return the status changes since the last call."""
        changes, self.context.changes = self.context.changes, []
        return changes
