# SPDX-License-Identifier: Apache-2.0
"""The docking server: brings the robot to a dock, and away from it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from nav2_behaviors.collision_checker import CollisionChecker
from nav2_msgs.action import DockRobot, UndockRobot
from nav2_msgs.srv import ReloadDockDatabase
from nav2_util import ActionAborted, ConfigurationError, LifecycleNode, parameter, ParameterSet
from nav2_util.plugins import did_you_mean, find_plugin
from nav2_util.twist import TwistPublisher, Velocity

from opennav_docking.approach import ApproachParameters
from opennav_docking.dock_database import Dock, find_dock, make_dock, read_docks
from opennav_docking.dock_types import DOCK_TYPES, SimpleNonChargingDock
from opennav_docking.docking import Docking
from opennav_docking.staging import StagingNavigator

__all__ = ['DockingParameters', 'DockingServer']

_CODES = DockRobot.Result


@dataclass(frozen=True)
class DockingParameters:
    """The parameters of the docking server."""

    controller_frequency: float = parameter(
        50.0, 'How often in Hz a velocity is computed.', low=0.1, high=1000.0
    )
    initial_perception_timeout: float = parameter(
        5.0, 'How long in s the dock is looked for.', low=0.0
    )
    wait_charge_timeout: float = parameter(
        5.0, 'How long in s to wait until it charges, or no longer does.', low=0.0
    )
    dock_approach_timeout: float = parameter(
        30.0, 'How long in s the way to the dock may take.', low=0.0
    )
    undock_linear_tolerance: float = parameter(
        0.05, 'The distance in m from the staging pose where undocking ends.', low=0.0
    )
    undock_angular_tolerance: float = parameter(
        0.05, 'The angle in rad from the staging pose where undocking ends.', low=0.0
    )
    max_retries: int = parameter(3, 'How often to try again.', low=0)
    base_frame: str = parameter('base_link', 'The frame of the robot.', read_only=True)
    fixed_frame: str = parameter(
        'odom', 'The frame in which the robot moves smoothly.', read_only=True
    )
    dock_backwards: bool = parameter(False, 'Whether the robot drives backward to docks.')
    dock_prestaging_tolerance: float = parameter(
        0.5, 'The distance in m and rad from the staging pose that needs no navigation.', low=0.0
    )
    dock_plugins: list[str] = parameter(
        [], 'The names of dock types; each has a parameter plugin.', read_only=True
    )
    docks: list[str] = parameter(
        [], 'The names of docks; each has the parameters type, frame, pose and id.', read_only=True
    )
    dock_database: str = parameter(
        '', 'A YAML file of docks, used if the parameter docks is empty.', read_only=True
    )
    navigator_bt_xml: str = parameter(
        '', 'The behavior tree for the way to the staging pose; empty: the default one.'
    )
    enable_stamped_cmd_vel: bool = parameter(
        False, "Whether TwistStamped is published on 'cmd_vel', and not Twist.", read_only=True
    )


class DockingServer(LifecycleNode):
    """
    Docking server, with the actions `dock_robot` and `undock_robot`.

    Parameters
    ----------
    node_name
        The node name, unless remapped.
    options
        Further keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, node_name: str = 'docking_server', **options: Any) -> None:
        super().__init__(node_name, **options)
        self.told: ParameterSet[DockingParameters]
        self.approach: ParameterSet[ApproachParameters]
        self.velocities: TwistPublisher
        self.checker: CollisionChecker | None = None
        self._docks: list[Dock] = []
        self._kinds: dict[str, SimpleNonChargingDock] = {}
        self._docked_at: SimpleNonChargingDock | None = None
        self._navigator: StagingNavigator | None = None

    def configure(self) -> None:
        """Read the parameters and the docks; create the interfaces."""
        self.told = self.parameters.declare(DockingParameters)
        self.approach = self.parameters.declare(ApproachParameters, 'controller')
        told, approach = self.told.current, self.approach.current
        _ = self.transforms  # subscribes from now on
        self._kinds = {name: self._make_kind(name) for name in told.dock_plugins}
        self._docks = self._known_docks(told)
        for dock in self._docks:
            self._check(dock)
        if not self._kinds:
            self.get_logger().warning(
                'There are no types of docks, so that the robot cannot dock. List them in '
                'dock_plugins.'
            )
        self.velocities = TwistPublisher(
            self, 'cmd_vel', told.enable_stamped_cmd_vel, told.base_frame
        )
        if approach.use_collision_detection:
            self.checker = CollisionChecker(
                self, approach.costmap_topic, approach.footprint_topic, told.base_frame
            )
        self._navigator = StagingNavigator(self)
        self._dock_server = self.offer_action(
            DockRobot, 'dock_robot', self._dock, check_goal=self._check_dock_goal
        )
        self._undock_server = self.offer_action(
            UndockRobot, 'undock_robot', self._undock, check_goal=self._check_undock_goal
        )
        self.create_service(ReloadDockDatabase, '~/reload_database', self._reload)

    def deactivate(self) -> None:
        """Stop the robot if it docks."""
        if self._dock_server.is_running or self._undock_server.is_running:
            self.velocities.publish(Velocity())

    def cleanup(self) -> None:
        """Release the docks, and the client of the navigator."""
        self._docks, self._kinds, self.checker = [], {}, None
        if self._navigator is not None:
            self._navigator.close()
            self._navigator = None

    def _make_kind(self, name: str) -> SimpleNonChargingDock:
        full = f'{name}.plugin'
        kind = self.parameters.declare_value(full, '', 'The type of the docks.')
        if not kind:
            raise ConfigurationError(
                f"The dock type '{name}' of dock_plugins has no plugin. Set the parameter "
                f"'{full}', for example to 'opennav_docking::SimpleChargingDock'."
            )
        made: SimpleNonChargingDock = find_plugin(DOCK_TYPES, kind, 'dock')(
            self, name, self.told.current.fixed_frame
        )
        return made

    def _known_docks(self, told: DockingParameters) -> list[Dock]:
        if not told.docks:
            return read_docks(told.dock_database) if told.dock_database else []
        declare = self.parameters.declare_value
        return [
            make_dock(
                name,
                {
                    'type': declare(f'{name}.type', '', 'The type, one of dock_plugins.'),
                    'frame': declare(f'{name}.frame', 'map', 'The frame of the pose.'),
                    'pose': declare(f'{name}.pose', [0.0] * 3, 'x and y in m, yaw in rad.'),
                    'id': declare(f'{name}.id', '', 'A second name.'),
                },
            )
            for name in told.docks
        ]

    def _check(self, dock: Dock) -> None:
        if dock.kind not in self._kinds:
            raise ConfigurationError(
                f"The dock '{dock.name}' is of type '{dock.kind}', which is not in dock_plugins."
                f'{did_you_mean(dock.kind, self._kinds)}'
            )

    def _reload(
        self, request: ReloadDockDatabase.Request, response: ReloadDockDatabase.Response
    ) -> ReloadDockDatabase.Response:
        response.success = False
        if self._dock_server.is_running:
            self.get_logger().error('The docks were not read anew, as the robot is docking.')
            return response
        try:
            docks = read_docks(request.filepath)
            for dock in docks:
                self._check(dock)
        except ConfigurationError as error:
            self.get_logger().error(f'The docks were not read anew. {error}')
            return response
        self._docks, response.success = docks, True
        return response

    def _check_dock_goal(self, goal: Any) -> str | None:
        return 'undock_robot is running' if self._undock_server.is_running else None

    def _check_undock_goal(self, goal: Any) -> str | None:
        return 'dock_robot is running' if self._dock_server.is_running else None

    async def _dock(self, goal: Any) -> None:
        server, navigator = self._dock_server, self._navigator
        assert navigator is not None
        server.result.success = False
        dock = self._wanted(goal)
        kind = self._kinds[dock.kind]
        docking = Docking(self, server, kind)
        try:
            await docking.dock(dock, goal, navigator)
        finally:
            self.velocities.publish(Velocity())
        self._docked_at = kind
        server.result.success = True

    async def _undock(self, goal: Any) -> None:
        server = self._undock_server
        server.result.success = False
        kind = self._kinds.get(goal.dock_type) if goal.dock_type else self._docked_at
        if kind is None and not goal.dock_type and len(self._kinds) == 1:
            kind = next(iter(self._kinds.values()))
        if kind is None:
            raise ActionAborted(
                _CODES.DOCK_NOT_VALID,
                f"There is no dock type '{goal.dock_type}'."
                f'{did_you_mean(goal.dock_type, self._kinds)}'
                if goal.dock_type
                else 'The robot was not docked by this server; give the dock_type.',
            )
        docking = Docking(self, server, kind)
        try:
            await docking.undock(goal.max_undocking_time)
        finally:
            self.velocities.publish(Velocity())
        self._docked_at = None
        server.result.success = True

    def _wanted(self, goal: Any) -> Dock:
        """Return the dock of a goal."""
        if goal.use_dock_id:
            dock = find_dock(self._docks, goal.dock_id)
            if dock is None:
                names = [each.name for each in self._docks]
                raise ActionAborted(
                    _CODES.DOCK_NOT_IN_DB,
                    f"There is no dock '{goal.dock_id}'.{did_you_mean(goal.dock_id, names)} "
                    f'These are known: {", ".join(names) or "none"}.',
                )
            return dock
        name = goal.dock_type
        if not name and len(self._kinds) == 1:
            name = next(iter(self._kinds))
        if name not in self._kinds:
            raise ActionAborted(
                _CODES.DOCK_NOT_VALID,
                f"There is no dock type '{name}'.{did_you_mean(name, self._kinds)} "
                f'dock_plugins lists these: {", ".join(self._kinds) or "none"}.',
            )
        return Dock.of_pose(name, goal.dock_pose)
