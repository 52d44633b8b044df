# SPDX-License-Identifier: Apache-2.0
"""The node that slows the robot down or stops it near obstacles that sensors detect."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from nav2_collision_monitor.actions import act_in_zone, Action, ActionType, most_careful
from nav2_collision_monitor.markers import PointMarkers
from nav2_collision_monitor.parameters import CollisionMonitorParameters
from nav2_collision_monitor.polygons import make_zones, MonitoredZone
from nav2_collision_monitor.shapes import FloatArray
from nav2_collision_monitor.sources import Sources
from nav2_msgs.msg import CollisionMonitorState
from nav2_msgs.srv import Toggle
from nav2_util import LifecycleNode, ParameterSet
from nav2_util.parameters import Unsupported
from nav2_util.timing import now_s
from nav2_util.twist import subscribe_twist, TwistPublisher, Velocity
import numpy as np
from std_msgs.msg import Header

__all__ = ['CollisionMonitor']

INVALID_SOURCE = 'invalid source'
_DONE = {
    ActionType.STOP: 'The robot stops',
    ActionType.SLOWDOWN: 'The robot slows down',
    ActionType.LIMIT: 'The speed is limited',
    ActionType.APPROACH: 'The robot approaches slowly',
}


class CollisionMonitor(LifecycleNode):
    """
    Node that forwards velocities, and reduces them while obstacles are in a zone.

    Each command is processed immediately, in its callback. A sensor without fresh data stops the
    robot.

    Parameters
    ----------
    node_name, options
        As for `LifecycleNode`.

    """

    def __init__(self, node_name: str = 'collision_monitor', **options: Any) -> None:
        super().__init__(node_name, **options)
        self._told: ParameterSet[CollisionMonitorParameters]
        self._sources: Sources
        self._zones: list[MonitoredZone] = []
        self._publisher: TwistPublisher
        self._markers: PointMarkers
        self._states: Any = None
        self._is_enabled = True
        self._reported: tuple[ActionType, str] | None = None
        self._stopped_since_s: float | None = None
        self._is_moving = False

    def configure(self) -> None:
        """Read the parameters; create zones, sensors, publishers and the service."""
        self.parameters.declare_unsupported(
            {
                'use_realtime_priority': Unsupported(
                    'Python has no threads of real-time priority', (False,)
                )
            }
        )
        self._told = self.parameters.declare(CollisionMonitorParameters)
        current = self._told.current
        self._is_enabled = True
        allowed = ('stop', 'slowdown', 'limit', 'approach', 'none')
        self._zones = make_zones(self, current, allowed)
        self._sources = Sources(self, current)
        self._markers = PointMarkers(self, current.base_frame_id)
        is_stamped = current.enable_stamped_cmd_vel
        self._publisher = TwistPublisher(
            self, current.cmd_vel_out_topic, is_stamped, current.base_frame_id
        )
        if current.state_topic:
            self._states = self.create_publisher(CollisionMonitorState, current.state_topic, 1)
        subscribe_twist(self, current.cmd_vel_in_topic, is_stamped, self._on_command)
        self.create_service(Toggle, '~/toggle', self._toggle)
        _ = self.transforms  # subscribes from now on

    def activate(self) -> None:
        """Publish the zones, and start processing commands."""
        self._reported, self._stopped_since_s, self._is_moving = None, None, False
        for zone in self._zones:
            zone.publish()

    def deactivate(self) -> None:
        """Stop the robot, and stop forwarding commands."""
        if self._is_moving:
            self._publisher.publish(Velocity())
            self._is_moving = False

    def cleanup(self) -> None:
        """Release the zones."""
        for zone in self._zones:
            zone.close()
        self._zones, self._states = [], None

    def _on_command(self, command: Velocity, header: Header | None) -> None:
        if not self.is_active:
            return
        action = Action(ActionType.DO_NOTHING, command)
        if self._is_enabled:
            points, invalid = self._sources.points()
            action = self._decide(command, points, invalid)
            self._publish(action.velocity, header)
            self._report(action, invalid)
            self._show(points)
        else:
            self._publish(command, header)

    def _decide(
        self, command: Velocity, points: Mapping[str, FloatArray], invalid: Mapping[str, str]
    ) -> Action:
        """Choose the action on a command."""
        actions = []
        for each in self._zones:
            zone = each.zone(command) if each.is_enabled else None
            if zone is not None:
                found = [points[name] for name in each.sources if name in points]
                seen = np.concatenate(found) if found else np.empty((0, 2))
                actions.append(act_in_zone(zone, seen, command))
        action = most_careful(actions, command)
        if invalid and action.kind is not ActionType.STOP:
            return Action(ActionType.STOP, Velocity(), INVALID_SOURCE)
        return action

    def _publish(self, velocity: Velocity, header: Header | None) -> None:
        """Publish a velocity; zero velocities for at most `stop_pub_timeout`."""
        self._is_moving = not velocity.is_zero
        if self._is_moving:
            self._stopped_since_s = None
        else:
            now = now_s(self)
            if self._stopped_since_s is None or now < self._stopped_since_s:
                self._stopped_since_s = now
            if now - self._stopped_since_s > self._told.current.stop_pub_timeout:
                return
        self._publisher.publish(velocity, header)

    def _report(self, action: Action, invalid: Mapping[str, str]) -> None:
        """Log the action and its cause when it changes."""
        if (action.kind, action.zone) == self._reported:
            return
        is_first, self._reported = self._reported is None, (action.kind, action.zone)
        if self._states is not None:
            state = CollisionMonitorState(action_type=int(action.kind), polygon_name=action.zone)
            self._states.publish(state)
        log = self.get_logger()
        if action.kind is not ActionType.DO_NOTHING:
            reason = f"because of the zone '{action.zone}'."
            if action.zone == INVALID_SOURCE:
                reason = 'because of its sensors. ' + ' '.join(invalid.values())
            log.warning(f'{_DONE[action.kind]} {reason}')
        elif not is_first:
            log.info('The robot moves as commanded again.')

    def _show(self, points: Mapping[str, FloatArray]) -> None:
        self._markers.publish(points)
        for zone in self._zones:
            if zone.is_enabled:
                zone.publish()

    def _toggle(self, request: Toggle.Request, response: Toggle.Response) -> Toggle.Response:
        self._is_enabled = request.enable
        self._reported = None
        response.success = True
        response.message = (
            f'The collision monitor is {"enabled" if request.enable else "disabled"}.'
        )
        self.get_logger().warning(response.message)
        return response
