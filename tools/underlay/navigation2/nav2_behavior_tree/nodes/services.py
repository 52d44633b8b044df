# SPDX-License-Identifier: Apache-2.0
"""Nodes that call services: clear costmaps, global localization, goals in collision."""

from __future__ import annotations

from typing import Any, ClassVar

from nav2_behavior_tree.action_node import count_recovery, ServiceNode
from nav2_behavior_tree.ports import in_port, out_port, Port, REQUIRED
from nav2_behavior_tree.registry import register
from nav2_behavior_tree.status import NodeStatus
from nav2_msgs.srv import (
    ClearCostmapAroundPose as ClearAroundPose,
)
from nav2_msgs.srv import (
    ClearCostmapAroundRobot as ClearAroundRobot,
)
from nav2_msgs.srv import (
    ClearCostmapExceptRegion as ClearExceptRegion,
)
from nav2_msgs.srv import (
    ClearEntireCostmap as ClearEntire,
)
from nav2_msgs.srv import (
    GetCost,
)
from std_srvs.srv import Empty

__all__ = [
    'ClearCostmapAroundPose',
    'ClearCostmapAroundRobot',
    'ClearCostmapExceptRegion',
    'ClearEntireCostmap',
    'ReinitializeGlobalLocalization',
    'RemoveInCollisionGoals',
]

_SERVICE: dict[str, Port] = {
    'service_name': in_port('text', REQUIRED, 'The name of the service.'),
    'server_timeout': in_port('milliseconds', None, "Time to answer; the navigator's."),
}
_OPTIONAL: dict[str, Port] = {
    **_SERVICE,
    'service_name': in_port('text', '', 'The name of the service; empty: the usual one.'),
}
_UNKNOWN_COST = 255.0


class _Clearing(ServiceNode):
    """Base class of nodes that clear a costmap, which counts as a recovery."""

    distance: ClassVar[bool] = True
    ports: ClassVar[dict[str, Port]] = {
        **_SERVICE,
        'reset_distance': in_port('number', '1.0', 'The distance in m.'),
    }

    def make_request(self) -> Any:
        """Make the request with its distance."""
        count_recovery(self)
        request = self.service.Request()
        if self.distance:
            request.reset_distance = float(self.input('reset_distance'))
        return request


@register()
class ClearEntireCostmap(_Clearing):
    """Clears all obstacles of a costmap."""

    service, distance = ClearEntire, False
    ports: ClassVar[dict[str, Port]] = _SERVICE


@register()
class ClearCostmapExceptRegion(_Clearing):
    """Clears the obstacles that are far from the robot."""

    service = ClearExceptRegion


@register()
class ClearCostmapAroundRobot(_Clearing):
    """Clears the obstacles near the robot."""

    service = ClearAroundRobot


@register()
class ClearCostmapAroundPose(_Clearing):
    """Clears the obstacles near a pose."""

    service = ClearAroundPose
    ports: ClassVar[dict[str, Port]] = {
        **_Clearing.ports,
        'pose': in_port('pose', '{goal}', 'The pose.'),
    }

    def make_request(self) -> Any:
        """Make the request with its pose."""
        pose = self.required('pose')
        request = super().make_request()
        request.pose = pose
        return request


@register()
class ReinitializeGlobalLocalization(ServiceNode):
    """Triggers global localization."""

    service, default_service = Empty, 'reinitialize_global_localization'
    ports: ClassVar[dict[str, Port]] = _OPTIONAL

    def make_request(self) -> Any:
        """Make the request; it counts as a recovery."""
        count_recovery(self)
        return Empty.Request()


@register()
class RemoveInCollisionGoals(ServiceNode):
    """Removes the goals that are in collision in a costmap."""

    service, default_service = GetCost, '/global_costmap/get_cost_global_costmap'
    ports: ClassVar[dict[str, Port]] = {
        **_OPTIONAL,
        'input_goals': in_port('poses', '{goals}', 'The goals.'),
        'use_footprint': in_port('boolean', 'true', 'Whether the whole footprint counts.'),
        'cost_threshold': in_port('number', '254.0', 'From this cost on a goal is left out.'),
        'consider_unknown_as_obstacle': in_port(
            'boolean', 'false', 'Whether unknown is occupied.'
        ),
        'input_waypoint_statuses': in_port('any', None, 'No effect: not in Jazzy.'),
        'output_goals': out_port('poses', 'The goals that are left.', '{goals}'),
        'output_waypoint_statuses': out_port('any', 'No effect: not in Jazzy.'),
    }

    def make_request(self) -> Any:
        """Start with the first goal."""
        self._goals = list(self.input('input_goals') or [])
        self._kept: list[Any] = []
        self._at = 0
        return self._ask() if self._goals else None

    def _ask(self) -> Any:
        pose = self.ros.pose_in(self._goals[self._at])
        use_footprint = bool(self.input('use_footprint'))
        return GetCost.Request(
            x=float(pose.x), y=float(pose.y), theta=float(pose.yaw), use_footprint=use_footprint
        )

    def on_answer(self, response: Any) -> NodeStatus:
        """
        Keep or remove the goal whose cost was requested, and continue with the next one.

        Parameters
        ----------
        response
            The response of `nav2_msgs/GetCost`; a negative cost means outside of the costmap.

        Returns
        -------
        NodeStatus
            RUNNING while goals are left to check, then SUCCESS, or FAILURE if all are occupied.

        """
        cost = response.cost
        if cost == _UNKNOWN_COST and not self.input('consider_unknown_as_obstacle'):
            cost = 0.0
        if 0.0 <= cost < self.input('cost_threshold'):
            self._kept.append(self._goals[self._at])
        self._at += 1
        if self._at < len(self._goals):
            self._request = self._ask()
            return NodeStatus.RUNNING
        if not self._kept:
            self.fail('All goals are occupied. Choose others, or wait until they are free.')
            return NodeStatus.FAILURE
        if len(self._kept) < len(self._goals):
            self.output('output_goals', self._kept)
        return NodeStatus.SUCCESS
