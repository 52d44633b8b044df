# SPDX-License-Identifier: Apache-2.0
"""The leaf nodes of BehaviorTree.CPP v4: constants, scripts, and blackboard entries."""

from __future__ import annotations

from typing import ClassVar

from nav2_behavior_tree.node import NodeConfig, TreeNode
from nav2_behavior_tree.ports import in_port, out_port, Port, REQUIRED
from nav2_behavior_tree.registry import register
from nav2_behavior_tree.scripting import Script as _Script
from nav2_behavior_tree.status import NodeStatus

__all__ = ['AlwaysFailure', 'AlwaysSuccess', 'Script', 'ScriptCondition', 'SetBlackboard', 'Sleep']

RUNNING, SUCCESS, FAILURE = NodeStatus.RUNNING, NodeStatus.SUCCESS, NodeStatus.FAILURE


@register()
class AlwaysSuccess(TreeNode):
    """Always succeeds."""

    def on_tick(self) -> NodeStatus:
        """Succeed."""
        return SUCCESS


@register()
class AlwaysFailure(TreeNode):
    """Always fails."""

    def on_tick(self) -> NodeStatus:
        """Fail."""
        return FAILURE


@register()
class Script(TreeNode):
    """
    Runs a script, and succeeds.

    Parameters
    ----------
    config
        As for `TreeNode`.

    Raises
    ------
    TreeError
        The script cannot be parsed.

    """

    ports: ClassVar[dict[str, Port]] = {'code': in_port('text', REQUIRED, 'The script.')}

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._script = _Script(self.input('code'), config.file, config.line)

    def on_tick(self) -> NodeStatus:
        """Run the script."""
        self._script(self.blackboard)
        return SUCCESS


@register()
class ScriptCondition(Script):
    """Succeeds if a script is true."""

    def on_tick(self) -> NodeStatus:
        """Evaluate the script."""
        return SUCCESS if self._script(self.blackboard) else FAILURE


@register()
class SetBlackboard(TreeNode):
    """Sets an entry to a text or to the value of another entry."""

    ports: ClassVar[dict[str, Port]] = {
        'value': in_port('any', REQUIRED, 'The value.'),
        'output_key': in_port('text', REQUIRED, 'The entry: its name, or {key}.'),
    }

    def on_tick(self) -> NodeStatus:
        """Set the entry."""
        binding = self.config.bindings['output_key']
        self.blackboard.set(binding.key or str(binding.value), self.required('value'))
        return SUCCESS


@register()
class UnsetBlackboard(TreeNode):
    """Removes an entry."""

    ports: ClassVar[dict[str, Port]] = {'key': in_port('text', REQUIRED, 'The entry.')}

    def on_tick(self) -> NodeStatus:
        """Remove the entry."""
        binding = self.config.bindings['key']
        self.blackboard.unset(binding.key or str(binding.value))
        return SUCCESS


@register()
class WasEntryUpdated(TreeNode):
    """
    Succeeds if an entry was set since this node was last ticked.

    Parameters
    ----------
    config
        As for `TreeNode`.

    """

    ports: ClassVar[dict[str, Port]] = {'entry': out_port('any', 'The entry: {key}.', REQUIRED)}

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._seen = 0

    def on_tick(self) -> NodeStatus:
        """Compare the version of the entry with the previous one."""
        version = self.blackboard.version(self.config.bindings['entry'].key or '')
        is_new, self._seen = version != self._seen, version
        return SUCCESS if is_new else FAILURE


@register()
class Sleep(TreeNode):
    """
    Succeeds after a duration.

    Parameters
    ----------
    config
        As for `TreeNode`.

    """

    ports: ClassVar[dict[str, Port]] = {
        'msec': in_port('milliseconds', REQUIRED, 'The time in ms.')
    }

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._end_s = 0.0

    def on_tick(self) -> NodeStatus:
        """Wait for the duration."""
        now_s = self.context.now_s()
        if self.state is not RUNNING:
            self._end_s = now_s + 1e-3 * self.required('msec')
        return RUNNING if now_s < self._end_s else SUCCESS
