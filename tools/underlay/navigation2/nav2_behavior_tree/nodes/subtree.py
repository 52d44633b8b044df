# SPDX-License-Identifier: Apache-2.0
"""The node that runs another tree of the file."""

from __future__ import annotations

from nav2_behavior_tree.node import Decorator
from nav2_behavior_tree.status import NodeStatus

__all__ = ['SubTree']


class SubTree(Decorator):
    """Runs another tree; its ports are entries that both trees share."""

    def on_tick(self) -> NodeStatus:
        """Tick the root of the subtree."""
        if self.state is NodeStatus.IDLE:
            self.set_state(NodeStatus.RUNNING)
        status = self.child.execute_tick()
        return status if status is NodeStatus.RUNNING else self.finish(status)
