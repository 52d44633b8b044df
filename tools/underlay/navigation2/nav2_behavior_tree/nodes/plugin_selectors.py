# SPDX-License-Identifier: Apache-2.0
"""Nodes that select a plugin, such as a planner, by a topic or a default."""

from __future__ import annotations

from typing import ClassVar

from nav2_behavior_tree.node import NodeConfig, TreeNode
from nav2_behavior_tree.ports import in_port, out_port, Port
from nav2_behavior_tree.registry import register
from nav2_behavior_tree.ros_interface import LATCHED
from nav2_behavior_tree.status import NodeStatus
from std_msgs.msg import String

__all__ = ['Selector']


class Selector(TreeNode):
    """
    Writes the most recently published name, or the default; fails if there is neither.

    Parameters
    ----------
    config
        As for `TreeNode`; its context has a `RosInterface`.

    """

    subject: ClassVar[str]

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._latest = config.context.ros.latest(String, self.input('topic_name'), LATCHED)

    def on_tick(self) -> NodeStatus:
        """Write the name."""
        name = self._latest.message.data if self._latest.message is not None else ''
        name = name or self.input(f'default_{self.subject}')
        if not name:
            self.fail(
                f"'{self.name}' has no default, and nothing was published on "
                f"'{self.input('topic_name')}'."
            )
            return NodeStatus.FAILURE
        self.output(f'selected_{self.subject}', name)
        return NodeStatus.SUCCESS


def _make_selector(type_name: str, subject: str) -> None:
    what = subject.replace('_', ' ')
    ports: dict[str, Port] = {
        'topic_name': in_port('text', f'{subject}_selector', 'The topic, a std_msgs/String.'),
        f'default_{subject}': in_port('text', '', f'The {what} if nothing was published.'),
        f'selected_{subject}': out_port('text', f'The {what}.', f'{{selected_{subject}}}'),
    }
    body = {'__doc__': Selector.__doc__, 'subject': subject, 'ports': ports}
    register()(type(type_name, (Selector,), body))


_make_selector('PlannerSelector', 'planner')
_make_selector('ControllerSelector', 'controller')
_make_selector('SmootherSelector', 'smoother')
_make_selector('GoalCheckerSelector', 'goal_checker')
_make_selector('ProgressCheckerSelector', 'progress_checker')
