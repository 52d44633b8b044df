# SPDX-License-Identifier: Apache-2.0
"""Registry of layer and filter plugins."""

from __future__ import annotations

from collections.abc import Collection

from nav2_costmap_2d.layers import Layer
from nav2_util.lifecycle_node import LifecycleNode
from nav2_util.plugins import find_plugin, plugin_type

__all__ = ['PLUGINS', 'explain_unused', 'make_plugin']

PLUGINS: dict[str, str] = {
    'nav2_costmap_2d::StaticLayer': 'nav2_costmap_2d.static_layer:StaticLayer',
    'nav2_costmap_2d::ObstacleLayer': 'nav2_costmap_2d.obstacle_layer:ObstacleLayer',
    'nav2_costmap_2d::VoxelLayer': 'nav2_costmap_2d.obstacle_layer:VoxelLayer',
    'nav2_costmap_2d::RangeSensorLayer': 'nav2_costmap_2d.range_sensor_layer:RangeSensorLayer',
    'nav2_costmap_2d::DenoiseLayer': 'nav2_costmap_2d.denoise_layer:DenoiseLayer',
    'nav2_costmap_2d::InflationLayer': 'nav2_costmap_2d.inflation_layer:InflationLayer',
    'nav2_costmap_2d::KeepoutFilter': 'nav2_costmap_2d.keepout_filter:KeepoutFilter',
    'nav2_costmap_2d::SpeedFilter': 'nav2_costmap_2d.costmap_filters:SpeedFilter',
    'nav2_costmap_2d::BinaryFilter': 'nav2_costmap_2d.costmap_filters:BinaryFilter',
}
"""The import paths of layers and filters by their types; packages may add their own."""

_DEFAULT_TYPES = {
    'static_layer': 'nav2_costmap_2d::StaticLayer',
    'obstacle_layer': 'nav2_costmap_2d::ObstacleLayer',
    'inflation_layer': 'nav2_costmap_2d::InflationLayer',
}


def make_plugin(node: LifecycleNode, name: str) -> Layer:
    """
    Make a layer or a filter.

    Parameters
    ----------
    node
        The costmap's node.
    name
        The name of the layer; the parameter `<name>.plugin` is its type.

    Raises
    ------
    ConfigurationError
        There is no such type, or the parameters of the layer are invalid.

    """
    default = _DEFAULT_TYPES.get(name, '')
    kind = plugin_type(node.parameters, name, 'layer', default, PLUGINS)
    layer: Layer = find_plugin(PLUGINS, kind, 'costmap layer or filter')(node, name)
    return layer


def explain_unused(node: LifecycleNode, used: Collection[str]) -> None:
    """
    Warn about parameters of unused layers, and state why they have no effect.

    Parameters
    ----------
    node
        The costmap's node.
    used
        The names of its layers and filters.

    """
    given = node.parameters.given
    for name in given:
        layer = name.partition('.')[0]
        if layer not in used and f'{layer}.plugin' in given:
            reason = f"'{layer}' is in neither 'plugins' nor 'filters'"
            node.parameters.declare_unsupported({name: reason})
