# SPDX-License-Identifier: Apache-2.0
"""The behaviour server as its behaviours see it: parameters, velocities and collision checkers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from nav2_behaviors.collision_checker import CollisionChecker
from nav2_util import LifecycleNode, parameter, ParameterSet
from nav2_util.parameters import Unsupported
from nav2_util.twist import TwistPublisher

__all__ = ['DEFAULT_TYPES', 'BehaviorNode', 'BehaviorServerParameters']

DEFAULT_TYPES = {
    'spin': 'nav2_behaviors::Spin',
    'backup': 'nav2_behaviors::BackUp',
    'drive_on_heading': 'nav2_behaviors::DriveOnHeading',
    'assisted_teleop': 'nav2_behaviors::AssistedTeleop',
    'wait': 'nav2_behaviors::Wait',
}
"""The types of the default behaviours."""


@dataclass(frozen=True)
class BehaviorServerParameters:
    """The parameters of the behaviour server."""

    behavior_plugins: list[str] = parameter(
        list(DEFAULT_TYPES), 'The names of the behaviours, and of their actions.'
    )
    cycle_frequency: float = parameter(10.0, 'Cycles of a behaviour a second.', low=0.1, high=1000)
    local_costmap_topic: str = parameter(
        'local_costmap/costmap_raw', 'Where the costmap around the robot comes from.'
    )
    global_costmap_topic: str = parameter(
        'global_costmap/costmap_raw', 'Where the costmap of the whole map comes from.'
    )
    local_footprint_topic: str = parameter(
        'local_costmap/published_footprint',
        'Where the footprint for the local costmap comes from.',
    )
    global_footprint_topic: str = parameter(
        'global_costmap/published_footprint', 'Where that for the global costmap comes from.'
    )
    local_frame: str = parameter('odom', 'The frame in which the robot moves smoothly.')
    global_frame: str = parameter('map', 'The frame of the map.')
    robot_base_frame: str = parameter('base_link', 'The frame of the robot.')
    transform_tolerance: float = parameter(
        0.1, "How much older than 1 s the robot's pose may be (s).", low=0.0
    )
    enable_stamped_cmd_vel: bool = parameter(
        False, 'Whether velocities are TwistStamped instead of Twist.', read_only=True
    )


class BehaviorNode(LifecycleNode):
    """
    Base class of the behaviour server: has what its behaviours share.

    Parameters
    ----------
    node_name, options
        As for `LifecycleNode`.

    """

    def __init__(self, node_name: str, **options: Any) -> None:
        super().__init__(node_name, **options)
        self.told: ParameterSet[BehaviorServerParameters]
        """The parameters of the server."""
        self.velocities: TwistPublisher
        """Publisher for `cmd_vel`."""
        self.local_checker: CollisionChecker
        """Checks the footprint in the local costmap."""
        self._global_checker: CollisionChecker | None = None

    def configure(self) -> None:
        """Read the parameters; create what behaviours share."""
        self.told = self.parameters.declare(BehaviorServerParameters)
        self.parameters.declare_unsupported(
            {'transform_timeout': Unsupported('the newest transform is used')}
        )
        told = self.told.current
        self.velocities = TwistPublisher(
            self, 'cmd_vel', told.enable_stamped_cmd_vel, told.robot_base_frame
        )
        self.local_checker = CollisionChecker(
            self, told.local_costmap_topic, told.local_footprint_topic, told.robot_base_frame
        )
        _ = self.transforms  # subscribes from now on

    def cleanup(self) -> None:
        """Release the global costmap's checker."""
        self._global_checker = None

    @property
    def global_checker(self) -> CollisionChecker:
        """Get the global costmap's checker, which subscribes when a behaviour first needs it."""
        if self._global_checker is None:
            told = self.told.current
            self._global_checker = CollisionChecker(
                self, told.global_costmap_topic, told.global_footprint_topic, told.robot_base_frame
            )
        return self._global_checker
