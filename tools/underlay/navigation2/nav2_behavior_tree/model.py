# SPDX-License-Identifier: Apache-2.0
"""Describe all node types for behavior tree editors: a TreeNodesModel."""

from __future__ import annotations

from xml.sax.saxutils import escape, quoteattr

from nav2_behavior_tree.control_node import Control, Decorator
from nav2_behavior_tree.node import TreeNode
from nav2_behavior_tree.ports import Port
from nav2_behavior_tree.registry import registered_types

__all__ = ['main', 'tree_nodes_model']


def tree_nodes_model() -> str:
    """Generate the XML text of the model, for editors such as Groot2."""
    lines = ['<?xml version="1.0"?>', '<root BTCPP_format="4">', '  <TreeNodesModel>']
    for name, kind in sorted(registered_types().items()):
        tag = _tag(kind)
        lines.append(f'    <{tag} ID="{name}">')
        lines += [f'      {_port(each, port)}' for each, port in kind.ports.items()]
        lines.append(f'    </{tag}>')
    return '\n'.join([*lines, '  </TreeNodesModel>', '</root>', ''])


def _tag(kind: type[TreeNode]) -> str:
    if issubclass(kind, Decorator):
        return 'Decorator'
    if issubclass(kind, Control):
        return 'Control'
    return 'Condition' if 'conditions' in kind.__module__ else 'Action'


def _port(name: str, port: Port) -> str:
    tag = 'output_port' if port.is_output else 'input_port'
    default = f' default={quoteattr(port.default)}' if isinstance(port.default, str) else ''
    return f'<{tag} name="{name}"{default}>{escape(port.description)}</{tag}>'


def main() -> int:
    """Print the model: `python3 -m nav2_behavior_tree.model > nav2_tree_nodes.xml`."""
    print(tree_nodes_model(), end='')
    return 0


if __name__ == '__main__':
    raise SystemExit(main())
