# SPDX-License-Identifier: Apache-2.0
"""Nodes with a life cycle, asked through their services."""

from __future__ import annotations

from typing import Any

from lifecycle_msgs.msg import State, Transition, TransitionDescription
from lifecycle_msgs.srv import ChangeState, GetAvailableTransitions, GetState
from ros2cli.graph.graph import Graph
from ros2cli.node.calls import call
from ros2cli.node.lookup import find_node, nodes_with_service

__all__ = [
    'change_state',
    'find_lifecycle_node',
    'get_lifecycle_nodes',
    'get_state',
    'get_transitions',
    'state_text',
]

STATE_SERVICE = '/get_state'
STATE_TYPE = 'lifecycle_msgs/srv/GetState'


def get_lifecycle_nodes(graph: Graph, *, include_hidden_nodes: bool) -> list[str]:
    """Return the full names of the nodes with a life cycle, sorted."""
    return nodes_with_service(
        graph, STATE_SERVICE, STATE_TYPE, include_hidden_nodes=include_hidden_nodes
    )


def find_lifecycle_node(node: Any, name: str) -> str:
    """Return the full name of a node with a life cycle, or RuntimeError."""
    full_name = find_node(node.watch, name)
    if full_name not in get_lifecycle_nodes(node.graph, include_hidden_nodes=True):
        raise RuntimeError(f"Node not found\nThe node '{full_name}' has no life cycle")
    return full_name


def get_state(node: Any, name: str, timeout_s: float = float('inf')) -> State:
    """Return the present state of a node."""
    service = f'{name}{STATE_SERVICE}'
    return call(node, GetState, service, GetState.Request(), timeout_s).current_state


def get_transitions(node: Any, name: str, *, all_states: bool) -> list[TransitionDescription]:
    """Return the transitions that a node can make now, or ever."""
    kind = 'get_transition_graph' if all_states else 'get_available_transitions'
    request = GetAvailableTransitions.Request()
    response = call(node, GetAvailableTransitions, f'{name}/{kind}', request)
    return list(response.available_transitions)


def change_state(node: Any, name: str, transition: Transition) -> bool:
    """Make a transition; return whether it has succeeded."""
    request = ChangeState.Request(transition=transition)
    return bool(call(node, ChangeState, f'{name}/change_state', request).success)


def state_text(state: State) -> str:
    """Return a state as `unconfigured [1]`."""
    return f'{state.label} [{state.id}]'
