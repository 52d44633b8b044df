# SPDX-License-Identifier: Apache-2.0
"""The parameters of the loopback simulator."""

from __future__ import annotations

from dataclasses import dataclass
import math

from nav2_loopback_sim.simulated_laser import LaserShape
from nav2_util.parameters import parameter

__all__ = ['LoopbackParameters']


@dataclass(frozen=True)
class LoopbackParameters:
    """The parameters of `loopback_simulator`."""

    update_duration: float = parameter(
        0.01, 'How far the robot moves on at once (simulated s).', low=0.001, high=1.0
    )
    base_frame_id: str = parameter('base_footprint', 'The frame of the robot.')
    odom_frame_id: str = parameter('odom', 'The frame of odometry.')
    map_frame_id: str = parameter('map', 'The frame of the map.')
    scan_frame_id: str = parameter('base_scan', 'The frame of the laser scanner.')
    enable_stamped_cmd_vel: bool = parameter(False, 'Take TwistStamped on cmd_vel and not Twist.')
    scan_publish_dur: float = parameter(0.1, 'Time between scans (s).', low=0.001)
    publish_scan: bool = parameter(True, 'Publish scans.')
    publish_map_odom_tf: bool = parameter(
        True, 'Publish the transform from the map to odometry; not beside a localisation.'
    )
    publish_clock: bool = parameter(True, 'Publish simulated time on /clock.')
    scan_range_min: float = parameter(0.05, 'The shortest range (m).', low=0.0)
    scan_range_max: float = parameter(30.0, 'The longest range (m).', low=0.1)
    scan_angle_min: float = parameter(-math.pi, 'The angle of the first beam (rad).')
    scan_angle_max: float = parameter(math.pi, 'The angle of the last beam (rad).')
    scan_angle_increment: float = parameter(
        0.0261, 'The angle between beams (rad).', low=1e-4, high=math.pi
    )
    scan_use_inf: bool = parameter(
        True, 'Where nothing is seen, use inf, and not 0.1 m below the longest range.'
    )
    speed: float = parameter(
        1.0,
        'How many simulated seconds pass in a real one, if publish_clock is on. At another value '
        'than 1, nodes need use_sim_time, and time slows down on a computer that is too slow.',
        low=0.01,
        high=1000.0,
    )

    def laser_shape(self) -> LaserShape:
        """Compute the beam angles and range limits of the scanner."""
        return LaserShape(
            self.scan_angle_min,
            self.scan_angle_max,
            self.scan_angle_increment,
            self.scan_range_min,
            self.scan_range_max,
            self.scan_use_inf,
        )
