# SPDX-License-Identifier: Apache-2.0
"""The parameters of the lifecycle manager."""

from __future__ import annotations

from dataclasses import dataclass

from nav2_util.parameters import parameter

__all__ = ['LifecycleManagerParameters']


@dataclass(frozen=True)
class LifecycleManagerParameters:
    """Parameters of the lifecycle manager."""

    node_names: list[str] = parameter(
        ['controller_server', 'planner_server', 'behavior_server', 'bt_navigator'],
        'The nodes, in the order in which they are brought up.',
        read_only=True,
    )
    autostart: bool = parameter(
        False, 'Whether the nodes are brought up without being asked for.', read_only=True
    )
    bond_timeout: float = parameter(
        4.0,
        'How long a node may not answer until it counts as gone, s; 0 watches none.',
        low=0.0,
        read_only=True,
    )
    attempt_respawn_reconnection: bool = parameter(
        True, 'Whether nodes that come back are brought up again.', read_only=True
    )
    bond_respawn_max_duration: float = parameter(
        10.0, 'How long it is waited for nodes to come back, s.', low=0.0, read_only=True
    )
    service_timeout: float = parameter(
        10.0, 'How long a node may take for a transition, s.', low=0.1, read_only=True
    )
