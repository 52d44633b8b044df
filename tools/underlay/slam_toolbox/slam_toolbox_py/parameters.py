# SPDX-License-Identifier: Apache-2.0
"""The parameters of the nodes, with the names and defaults of slam_toolbox."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

from nav2_util import parameter
from slam_toolbox_py.settings import MapperSettings

__all__ = ['UNSUPPORTED', 'SlamParameters', 'settings_of']

UNSUPPORTED = {
    'ceres_linear_solver': 'the graph is optimized with sparse normal equations of SciPy',
    'ceres_preconditioner': 'the graph is optimized with sparse normal equations of SciPy',
    'ceres_trust_strategy': 'the graph is optimized with Levenberg-Marquardt',
    'ceres_dogleg_type': 'the graph is optimized with Levenberg-Marquardt',
    'ceres_loss_function': 'loop closures have a Cauchy loss, and other edges none',
    'stack_size_to_use': 'maps of any size are saved without a large stack',
    'tf_buffer_duration': 'all nodes of a process share one buffer of 10 s',
    'fine_search_angle_offset': 'matches are refined by least squares instead of small steps',
    'link_scan_maximum_distance': 'keyframes are linked to the previous one and by loop closures',
    'use_response_expansion': 'a scan that matches badly is placed by odometry',
    'scan_queue_size': 'a node queues one scan until its transforms arrive, the sync node all',
}
"""Parameters that are accepted without effect, and the behaviour instead."""


@dataclass(frozen=True)
class SlamParameters:
    """The parameters of the nodes; see `ros2 param describe` for each."""

    solver_plugin: str = parameter(
        'solver_plugins::CeresSolver', 'Solver of the pose graph; the same one for every name.'
    )
    mode: str = parameter(
        'mapping',
        'Purpose for which the solver is tuned; the executable decides if it builds a map.',
        choices=('mapping', 'localization'),
    )
    odom_frame: str = parameter('odom', 'Frame of odometry.')
    map_frame: str = parameter('map', 'Frame of the map.')
    base_frame: str = parameter('base_footprint', 'Frame of the robot.')
    scan_topic: str = parameter('/scan', 'Topic of the laser scans.')
    map_name: str = parameter('/map', 'Topic of the map; its metadata has the suffix _metadata.')
    use_map_saver: bool = parameter(True, 'Whether to offer the service save_map.')
    map_file_name: str = parameter('', 'Serialized pose graph to start with, without extension.')
    map_start_pose: list[float] = parameter(
        [], 'Initial pose of the robot in that map: x and y in m, yaw in rad.'
    )
    map_start_at_dock: bool = parameter(False, 'Whether it is at the first node of that map.')
    debug_logging: bool = parameter(False, 'Whether to log how each scan matches.')
    throttle_scans: int = parameter(1, 'Process one of this many scans.', low=1)
    transform_publish_period: float = parameter(
        0.05, 'Period of the transforms from map to odometry, in s; 0 for none.', low=0.0
    )
    map_update_interval: float = parameter(10.0, 'Period of map updates, in s.', low=0.05)
    enable_interactive_mode: bool = parameter(False, 'Whether nodes may be moved by hand.')
    position_covariance_scale: float = parameter(
        1.0, 'Scale factor of the covariance of published positions.', low=0.0
    )
    yaw_covariance_scale: float = parameter(
        1.0, 'Scale factor of the covariance of published headings.', low=0.0
    )
    resolution: float = parameter(0.05, 'Cell size of the map, in m.', low=0.005)
    min_laser_range: float = parameter(0.0, 'Closer measurements are ignored, in m.', low=0.0)
    max_laser_range: float = parameter(
        20.0, 'Measurements beyond this range only clear cells up to it, in m.', low=0.1
    )
    minimum_time_interval: float = parameter(0.5, 'Minimum time between keyframes, in s.', low=0.0)
    transform_timeout: float = parameter(
        0.2, 'Timeout of transforms, and validity of published ones, in s.', low=0.0
    )
    restamp_tf: bool = parameter(
        False, 'Whether to stamp transforms with the current time instead of that of the scan.'
    )
    use_lifecycle_manager: bool = parameter(
        False, 'Whether a lifecycle manager configures this node, instead of its launch file.'
    )
    check_min_dist_and_heading_precisely: bool = parameter(
        False, 'Whether the minimum travel is exact; otherwise 10 % less makes a keyframe, too.'
    )
    min_pass_through: int = parameter(
        2, 'Scans that must have seen a cell before the map classifies it.', low=1
    )
    occupancy_threshold: float = parameter(
        0.1, 'Share of scans that must have hit an occupied cell.', low=0.0, high=1.0
    )
    use_scan_matching: bool = parameter(True, 'Whether to correct odometry by matching scans.')
    use_scan_barycenter: bool = parameter(
        True, 'Whether to measure distances between scan barycenters instead of positions.'
    )
    minimum_travel_distance: float = parameter(0.5, 'Travel between keyframes, in m.', low=0.0)
    minimum_travel_heading: float = parameter(0.5, 'Or the turn between them, in rad.', low=0.0)
    scan_buffer_size: int = parameter(10, 'Recent keyframes that a scan is matched with.', low=1)
    scan_buffer_maximum_scan_distance: float = parameter(
        10.0, 'Those that are farther away are ignored, in m.', low=0.0
    )
    link_match_minimum_response_fine: float = parameter(
        0.1, 'Scans that match worse are placed by odometry.', low=0.0, high=1.0
    )
    loop_search_maximum_distance: float = parameter(
        3.0, 'Keyframes within this distance may close a loop, in m.', low=0.0
    )
    do_loop_closing: bool = parameter(True, 'Whether to close loops.')
    loop_match_minimum_chain_size: int = parameter(
        10, 'Minimum number of consecutive keyframes for a loop closure.', low=1
    )
    loop_match_maximum_variance_coarse: float = parameter(
        3.0, 'Largest position variance for a loop closure, in m2.', low=0.0
    )
    loop_match_minimum_response_coarse: float = parameter(
        0.35, 'Minimum response of the coarse match of a loop closure.', low=0.0, high=1.0
    )
    loop_match_minimum_response_fine: float = parameter(
        0.45, 'Minimum response of the fine match of a loop closure.', low=0.0, high=1.0
    )
    correlation_search_space_dimension: float = parameter(
        0.5, 'Width of the search area of scan matching, in m.', low=0.05
    )
    correlation_search_space_resolution: float = parameter(
        0.01,
        'Resolution of that search, in m; at least 0.05 is used, and refined.',
        low=0.001,
    )
    correlation_search_space_smear_deviation: float = parameter(
        0.1, 'Standard deviation of points in that search, in m.', low=0.005
    )
    loop_search_space_dimension: float = parameter(
        8.0, 'Width of the largest search area of a loop closure, in m.', low=0.05
    )
    loop_search_space_resolution: float = parameter(0.05, 'Cells of that search in m.', low=0.01)
    loop_search_space_smear_deviation: float = parameter(
        0.03, 'Standard deviation of points in that search, in m; at least a cell.', low=0.005
    )
    distance_variance_penalty: float = parameter(
        0.5, 'Variance of the penalty on the distance from the guess, in m2.', low=0.001
    )
    angle_variance_penalty: float = parameter(
        1.0, 'Variance of the penalty on the turn from the guess, in rad2.', low=0.001
    )
    coarse_search_angle_offset: float = parameter(
        0.349, 'Largest turn from the guess in a search, in rad.', low=0.0
    )
    coarse_angle_resolution: float = parameter(0.0349, 'Angular step, in rad.', low=0.001)
    minimum_angle_penalty: float = parameter(
        0.9, 'Smallest penalty factor for turned matches.', low=0.0, high=1.0
    )
    minimum_distance_penalty: float = parameter(
        0.5, 'Smallest penalty factor for distant matches.', low=0.0, high=1.0
    )


def settings_of(parameters: SlamParameters) -> MapperSettings:
    """
    Select the parameters that are settings of the mapper.

    Parameters
    ----------
    parameters : SlamParameters
        All parameters of the node.

    """
    names = [each.name for each in fields(MapperSettings)]
    told: dict[str, Any] = {name: getattr(parameters, name) for name in names}
    return MapperSettings(**told)
