# SPDX-License-Identifier: Apache-2.0
"""The parameters of the costmap node."""

from __future__ import annotations

from dataclasses import dataclass

from nav2_costmap_2d.footprint import Footprint, parse_footprint
from nav2_costmap_2d.grid import Costmap2D
from nav2_util.errors import ConfigurationError
from nav2_util.parameters import parameter, Unsupported

__all__ = ['UNSUPPORTED', 'CostmapParameters', 'footprint_of', 'grid_of']

UNSUPPORTED = {
    'clearable_layers': Unsupported(
        'services clear all layers that remember what sensors saw',
        (['obstacle_layer'], ['obstacle_layer', 'voxel_layer', 'range_layer']),
    ),
    'observation_sources': Unsupported(
        'each layer has its own parameter observation_sources', ('',)
    ),
}
"""The parameters of Nav2 that have no effect, and what happens instead."""


@dataclass(frozen=True)
class CostmapParameters:
    """The parameters of `nav2_costmap_2d::Costmap2DROS`."""

    always_send_full_costmap: bool = parameter(
        False, 'Whether each publication is the whole costmap, and not what has changed.'
    )
    footprint_padding: float = parameter(
        0.01, 'How much each corner of the footprint is moved outwards, in m.'
    )
    footprint: str = parameter(
        '[]', 'The corners of the footprint, such as [[0.1, 0.1], [0.1, -0.1], [-0.1, 0.0]], in m.'
    )
    global_frame: str = parameter('map', 'The frame of the costmap.')
    robot_base_frame: str = parameter('base_link', 'The frame of the robot.')
    height: int = parameter(5, 'The extent along y in m.', low=0)
    width: int = parameter(5, 'The extent along x in m.', low=0)
    resolution: float = parameter(0.1, 'The side of a cell in m.', low=0.001)
    origin_x: float = parameter(0.0, 'The x of the outer corner of the first cell, in m.')
    origin_y: float = parameter(0.0, 'The y of the outer corner of the first cell, in m.')
    lethal_cost_threshold: int = parameter(
        100, 'The occupancy of a map from which a cell is an obstacle.', low=0, high=100
    )
    map_topic: str = parameter('map', 'The topic of the map for static layers.')
    subscribe_to_stamped_footprint: bool = parameter(
        False, "Whether the topic 'footprint' is of type PolygonStamped, and not Polygon."
    )
    map_vis_z: float = parameter(0.0, 'The height of the published costmap in m.')
    publish_frequency: float = parameter(
        1.0, 'How often the costmap is published, in Hz; never at 0.', low=0.0
    )
    update_frequency: float = parameter(
        5.0, 'How often the costmap is updated, in Hz; never at 0.', low=0.0
    )
    robot_radius: float = parameter(
        0.1, 'The radius of a circular robot in m, if there is no footprint.', low=0.0
    )
    rolling_window: bool = parameter(False, 'Whether the robot is always in the middle.')
    track_unknown_space: bool = parameter(
        False, 'Whether what nobody has seen is unknown; otherwise it is free.'
    )
    transform_tolerance: float = parameter(
        0.3, 'How old the pose of the robot may be, in s.', low=0.0
    )
    initial_transform_timeout: float = parameter(
        60.0, 'After how many s without the pose of the robot an error is logged.', low=0.0
    )
    trinary_costmap: bool = parameter(
        True, 'Whether cells of a map are free, occupied or unknown, and nothing between.'
    )
    unknown_cost_value: int = parameter(
        255, 'The occupancy of a map, as an unsigned byte, that means unknown.', low=0, high=255
    )
    use_maximum: bool = parameter(
        False, 'Whether static layers raise costs of layers below them, and do not replace them.'
    )
    plugins: list[str] = parameter(
        ['static_layer', 'obstacle_layer', 'inflation_layer'], 'The names of the layers, in order.'
    )
    filters: list[str] = parameter([], 'The names of the costmap filters, in order.')


def footprint_of(values: CostmapParameters) -> Footprint:
    """
    Make the footprint of the robot from parameters.

    Parameters
    ----------
    values
        The parameters; the radius is used if there are no corners.

    Raises
    ------
    ConfigurationError
        The parameter `footprint` is not a list of corners.

    """
    try:
        points = parse_footprint(values.footprint)
    except ValueError as error:
        raise ConfigurationError(f"The parameter 'footprint' {error}.") from error
    if len(points):
        return Footprint.of_points(points, values.footprint_padding)
    return Footprint.of_radius(values.robot_radius, values.footprint_padding)


def grid_of(values: CostmapParameters, default_cost: int) -> Costmap2D:
    """
    Make the grid from parameters.

    Parameters
    ----------
    values
        The parameters: size, resolution and origin.
    default_cost
        The cost of all cells.

    """
    return Costmap2D(
        round(values.width / values.resolution),
        round(values.height / values.resolution),
        values.resolution,
        values.origin_x,
        values.origin_y,
        default_cost,
    )
