# SPDX-License-Identifier: Apache-2.0
"""The inflation layer, which keeps the robot away from obstacles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from nav2_costmap_2d.footprint import Footprint
from nav2_costmap_2d.grid import Costmap2D
from nav2_costmap_2d.inflation import Inflation
from nav2_costmap_2d.layers import Layer
from nav2_costmap_2d.regions import Region
from nav2_util.parameters import parameter

if TYPE_CHECKING:
    from nav2_costmap_2d.costmap_node import Costmap2DROS

__all__ = ['InflationLayer', 'InflationParameters']


@dataclass(frozen=True)
class InflationParameters:
    """The parameters of `nav2_costmap_2d::InflationLayer`."""

    enabled: bool = parameter(True, 'Whether the layer takes part.')
    inflation_radius: float = parameter(
        0.55, 'Up to which distance from obstacles costs are raised, in m.', low=0.0
    )
    cost_scaling_factor: float = parameter(
        10.0, 'How fast costs decay with the distance, in 1/m.', low=0.0
    )
    inflate_unknown: bool = parameter(False, 'Whether costs are raised in unknown cells, too.')
    inflate_around_unknown: bool = parameter(
        False, 'Whether costs are raised around unknown cells as around obstacles.'
    )


class InflationLayer(Layer):
    """
    Layer that inflates obstacles, so that paths keep away from them.

    Parameters
    ----------
    node
        The costmap's node.
    name
        The name of the layer.

    """

    def __init__(self, node: Costmap2DROS, name: str) -> None:
        super().__init__(name)
        self._node = node
        self._settings = node.parameters.declare(InflationParameters, name)
        self._settings.on_change = lambda _: node.touch()
        self._inscribed_radius_m = node.shape.inscribed_radius_m

    @property
    def is_enabled(self) -> bool:
        """Whether the layer is enabled."""
        return self._settings.current.enabled

    @property
    def cost_scaling_factor(self) -> float:
        """The decay rate of the costs with the distance, in 1/m."""
        return self._settings.current.cost_scaling_factor

    @property
    def inflation_radius(self) -> float:
        """The distance from obstacles up to which costs are raised, in m."""
        return self._settings.current.inflation_radius

    def set_footprint(self, footprint: Footprint) -> None:
        """
        Set the inscribed radius, up to which the robot collides.

        Parameters
        ----------
        footprint
            The new shape of the robot.

        """
        self._inscribed_radius_m = footprint.inscribed_radius_m

    def affected(self, region: Region) -> Region:
        """
        Extend a changed region by the inflation radius.

        Parameters
        ----------
        region
            The cells that the layers below have changed.

        Returns
        -------
        Region
            The cells whose inflation depends on the region, possibly beyond the grid.

        """
        return region.grown(self._inflation().reach(self._node.grid.resolution))

    def apply(self, grid: Costmap2D, region: Region) -> None:
        """
        Raise the costs around obstacles, in place.

        Parameters
        ----------
        grid, region
            As for `Layer.apply`.

        """
        self._inflation().apply(grid, region)

    def _inflation(self) -> Inflation:
        values = self._settings.current
        return Inflation(
            values.inflation_radius,
            self._inscribed_radius_m,
            values.cost_scaling_factor,
            values.inflate_unknown,
            values.inflate_around_unknown,
        )
