# SPDX-License-Identifier: Apache-2.0
"""Behavior trees: built from their XML file and validated, ticked and halted."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from nav2_behavior_tree.blackboard import Blackboard
from nav2_behavior_tree.control_node import Decorator
from nav2_behavior_tree.node import (
    NodeConfig,
    POSTCONDITIONS,
    PRECONDITIONS,
    TreeContext,
    TreeNode,
)
from nav2_behavior_tree.ports import bind, Binding, in_port
from nav2_behavior_tree.registry import node_type, unknown_type
from nav2_behavior_tree.scripting import Script
from nav2_behavior_tree.status import Failure, NodeStatus, StatusChange
from nav2_behavior_tree.tree_xml import Document, Element, read_tree_text
from nav2_util.plugins import did_you_mean

__all__ = ['BehaviorTree', 'SubTree']

_MOST_ROUNDS = 100
_GENERIC = {'Action', 'Condition', 'Control', 'Decorator'}
_CONDITIONS = (*PRECONDITIONS, *POSTCONDITIONS)
_FOR_EDITORS = {'_description', '_fullpath', '_uid', '_collapsed'}
_ANY = in_port('any', None, 'A value of a subtree.')


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
        self.root: TreeNode = _Builder(document, self.context).tree(
            document.main, self.blackboard, ()
        )

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


class SubTree(Decorator):
    """Runs another tree; its ports are entries that both trees share."""

    def on_tick(self) -> NodeStatus:
        """Tick the root of the subtree."""
        if self.state is NodeStatus.IDLE:
            self.set_state(NodeStatus.RUNNING)
        status = self.child.execute_tick()
        return status if status is NodeStatus.RUNNING else self.finish(status)


class _Builder:
    """Makes the nodes of a document's trees; an error in the document states where it is."""

    def __init__(self, document: Document, context: TreeContext) -> None:
        self._document, self._context = document, context
        self._uid = 0

    def tree(self, key: str, blackboard: Blackboard, within: tuple[str, ...]) -> TreeNode:
        return self._node(self._document.trees[key].children[0], blackboard, (*within, key))

    def _node(self, element: Element, board: Blackboard, within: tuple[str, ...]) -> TreeNode:
        attributes = dict(element.attributes)
        type_name = element.tag
        if type_name in _GENERIC or (type_name == 'SubTree'):
            type_name = attributes.pop('ID', '')
            if not type_name:
                raise element.error(f'<{element.tag}> needs the attribute ID.')
        name = attributes.pop('name', '') or type_name
        scripts = {
            key: Script(attributes.pop(key), element.file, element.line)
            for key in _CONDITIONS
            if key in attributes
        }
        for key in _FOR_EDITORS & set(attributes):
            del attributes[key]
        self._uid += 1
        uid = self._uid
        if element.tag == 'SubTree' or (
            node_type(type_name) is None and type_name in self._document.trees
        ):
            board, bindings, kind = self._subtree(element, type_name, attributes, board, within)
        else:
            kind = self._type(element, type_name)
            bindings = _bindings(element, type_name, kind, attributes)
        config = NodeConfig(
            type_name,
            name,
            uid,
            self._context,
            board,
            bindings,
            scripts,
            element.file,
            element.line,
        )
        node = kind(config)
        if kind is SubTree:
            children = [self.tree(type_name, board, within)]
        else:
            children = [self._node(child, board, within) for child in element.children]
            _check_children(element, type_name, kind)
        for child in children:
            child.parent = node
        node.children = children
        return node

    def _type(self, element: Element, type_name: str) -> type[TreeNode]:
        kind = node_type(type_name)
        if kind is None:
            raise element.error(unknown_type(type_name, list(self._document.trees)))
        return kind

    def _subtree(
        self,
        element: Element,
        key: str,
        attributes: dict[str, str],
        parent: Blackboard,
        within: tuple[str, ...],
    ) -> tuple[Blackboard, dict[str, Binding], type[TreeNode]]:
        """Make the blackboard of a subtree, with the remappings and values of its ports."""
        trees = self._document.trees
        if key not in trees:
            meant = did_you_mean(key, trees, 0.6)
            raise element.error(f"There is no tree with the ID '{key}'.{meant}")
        if key in within:
            raise element.error(f"The tree '{key}' contains itself: {' > '.join(within)} > {key}.")
        if element.children:
            raise element.error('<SubTree> must not have children; its ID names its tree.')
        share = attributes.pop('_autoremap', 'false').lower()
        if share not in ('true', 'false', '1', '0'):
            raise element.error(f"_autoremap must be 'true' or 'false', but is '{share}'.")
        remapping, values = {}, {}
        for name, text in attributes.items():
            match = bind(name, _ANY, text)
            if match.key is not None:
                remapping[name] = match.key
            else:
                values[name] = text
        board = Blackboard(parent, remapping, share in ('true', '1'))
        for name, text in values.items():
            board.keep(name, text)
        return board, {}, SubTree


def _check_children(element: Element, type_name: str, kind: type[TreeNode]) -> None:
    count, least, most = len(element.children), kind.least_children, kind.most_children
    if least <= count <= most:
        return
    if least == most:
        wanted = 'no children' if not least else f'exactly {least} child{"ren" * (least > 1)}'
    elif count < least:
        wanted = f'at least {least} child{"ren" * (least > 1)}'
    else:
        wanted = f'at most {most} children'
    raise element.error(f"'{type_name}' must have {wanted}, but has {count}.")


def _bindings(
    element: Element, type_name: str, kind: type[TreeNode], attributes: dict[str, str]
) -> dict[str, Binding]:
    for name in attributes:
        if name not in kind.ports:
            known = ', '.join(f"'{each}'" for each in kind.ports) or 'none'
            meant = did_you_mean(name, [*kind.ports, 'name', *_CONDITIONS], 0.6)
            meant = meant or f' It has {known}.'
            raise element.error(f"'{type_name}' has no port '{name}'.{meant}")
    found: dict[str, Binding] = {}
    for name, port in kind.ports.items():
        try:
            found[name] = bind(name, port, attributes.get(name))
        except ValueError as error:
            raise element.error(f"The port '{name}' of '{type_name}' {error}.") from error
    return found
