# SPDX-License-Identifier: Apache-2.0
"""Lifecycle nodes, queried through their services."""

from __future__ import annotations

from typing import Any

from lifecycle_msgs.msg import State, Transition, TransitionDescription
from lifecycle_msgs.srv import ChangeState, GetAvailableTransitions, GetState
from ros2cli.graph import DEFAULT_SPIN_TIME_S
from ros2cli.graph.graph import Graph
from ros2cli.waiting import call
from ros2node.api import find_node, nodes_with_service

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
    """
    List the lifecycle nodes: those with a `get_state` service.

    Parameters
    ----------
    graph
        The graph to search.
    include_hidden_nodes
        Whether to include nodes with a part of the full name that starts with an underscore.

    Returns
    -------
    list of str
        Their full names, sorted.

    """
    return nodes_with_service(
        graph, STATE_SERVICE, STATE_TYPE, include_hidden_nodes=include_hidden_nodes
    )


def find_lifecycle_node(node: Any, name: str) -> str:
    """
    Find a lifecycle node by name, hidden or not, also if it has just been started.

    Parameters
    ----------
    node
        The `DirectNode` whose graph is searched.
    name
        The name of the node; the leading slash may be missing.

    Returns
    -------
    str
        Its full name.

    Raises
    ------
    RuntimeError
        There is no such node, or it is not a lifecycle node.

    """
    full_name = find_node(node.watch, name)

    def is_lifecycle_node(graph: Graph) -> bool:
        return full_name in get_lifecycle_nodes(graph, include_hidden_nodes=True)

    # A node is in the graph before its services are.
    if not node.watch.wait_for(is_lifecycle_node, None, DEFAULT_SPIN_TIME_S):
        raise RuntimeError(f"Node not found\nThe node '{full_name}' is not a lifecycle node")
    return full_name


def get_state(node: Any, name: str, timeout_s: float = float('inf')) -> State:
    """
    Get the current state of a lifecycle node.

    Parameters
    ----------
    node
        The `DirectNode` that calls the service.
    name
        The full name of the lifecycle node.
    timeout_s
        The timeout for the response, once the service is connected, in s.

    Raises
    ------
    RuntimeError
        The service does not connect, does not respond in time, or disappears.

    """
    service = f'{name}{STATE_SERVICE}'
    return call(node, GetState, service, GetState.Request(), timeout_s).current_state


def get_transitions(node: Any, name: str, *, all_states: bool) -> list[TransitionDescription]:
    """
    List the transitions of a lifecycle node.

    Parameters
    ----------
    node, name
        As for `get_state`.
    all_states
        Whether the transitions from all states are listed, not only those from the current one.

    Returns
    -------
    list of TransitionDescription
        Each with its start state and its goal state.

    Raises
    ------
    RuntimeError
        The service does not connect, or disappears before it responds.

    """
    kind = 'get_transition_graph' if all_states else 'get_available_transitions'
    request = GetAvailableTransitions.Request()
    response = call(node, GetAvailableTransitions, f'{name}/{kind}', request)
    return list(response.available_transitions)


def change_state(node: Any, name: str, transition: Transition) -> bool:
    """
    Trigger a transition of a lifecycle node, and wait until it is complete.

    Parameters
    ----------
    node, name
        As for `get_state`.
    transition
        The transition, as in the descriptions that `get_transitions` returns.

    Returns
    -------
    bool
        Whether it has succeeded.

    Raises
    ------
    RuntimeError
        The service does not connect, or disappears before it responds.

    """
    request = ChangeState.Request(transition=transition)
    return bool(call(node, ChangeState, f'{name}/change_state', request).success)


def state_text(state: State) -> str:
    """
    Format a lifecycle state, as `unconfigured [1]`.

    Parameters
    ----------
    state
        The state, whose label and ID are shown.

    """
    return f'{state.label} [{state.id}]'
