# SPDX-License-Identifier: Apache-2.0
"""The node of a costmap, standalone or owned by a planner or controller server."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from nav2_costmap_2d.costmap_parameters import (
    CostmapParameters,
    footprint_of,
    grid_of,
    UNSUPPORTED,
)
from nav2_costmap_2d.costmap_publisher import CostmapPublisher
from nav2_costmap_2d.costmap_services import CostmapServices
from nav2_costmap_2d.costs import FREE_SPACE, NO_INFORMATION
from nav2_costmap_2d.footprint import Footprint, FootprintCollisionChecker
from nav2_costmap_2d.grid import Costmap2D, FloatArray
from nav2_costmap_2d.layers import Layer, LayeredCostmap
from nav2_costmap_2d.plugins import explain_unused, make_plugin
from nav2_costmap_2d.regions import Region
from nav2_costmap_2d.robot import Robot
from nav2_util.errors import ConfigurationError
from nav2_util.geometry import Pose2D
from nav2_util.lifecycle_node import LifecycleNode
from nav2_util.main import main as run_main
from nav2_util.parameters import ParameterSet
from nav2_util.timing import clock_of, now_s
import numpy as np
from rclpy.parameter import Parameter
from rclpy.timer import Timer

__all__ = ['Costmap2DROS', 'main', 'make_costmap']


class Costmap2DROS(LifecycleNode):
    """
    Costmap node: updates a costmap from a map and sensors, and publishes it.

    Parameters
    ----------
    node_name
        Its name, which is also part of the service names.
    options
        Further keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, node_name: str = 'costmap', **options: Any) -> None:
        super().__init__(node_name, **options)
        self.is_current = False
        """Whether all layers have current data, and the robot's pose is available."""
        self._settings = ParameterSet(CostmapParameters())
        self._robot = Robot(self, self._settings, self._take_shape)
        self._costmap = LayeredCostmap(Costmap2D(0, 0, 0.1, 0.0, 0.0), FREE_SPACE, False)
        self._sized_by: Layer | None = None
        self._publisher: CostmapPublisher | None = None
        self._published_s = 0.0
        self._timer: Timer | None = None

    @property
    def settings(self) -> CostmapParameters:
        """Return the current parameters."""
        return self._settings.current

    @property
    def grid(self) -> Costmap2D:
        """Return the newest costmap: replaced as a whole, never modified."""
        return self._costmap.grid

    @property
    def layers(self) -> Sequence[Layer]:
        """Return the layers and the filters, in order."""
        return self._costmap.everything

    @property
    def global_frame(self) -> str:
        """Return the frame of the costmap."""
        return self.settings.global_frame

    @property
    def base_frame(self) -> str:
        """Return the frame of the robot."""
        return self.settings.robot_base_frame

    @property
    def tracks_unknown(self) -> bool:
        """Whether unobserved cells are unknown; otherwise they are free."""
        return self.settings.track_unknown_space

    @property
    def shape(self) -> Footprint:
        """Return the shape of the robot."""
        return self._robot.shape

    @property
    def footprint(self) -> FloatArray:
        """Return the (N, 2) padded footprint of the robot in its frame, in m."""
        return self.shape.points

    @property
    def radius(self) -> float:
        """Return the circumscribed radius of the robot in m."""
        return self.shape.circumscribed_radius_m

    @property
    def is_circular(self) -> bool:
        """Whether the robot is circular, so that the cost at its centre suffices."""
        return self.shape.is_circular

    @property
    def collision_footprint(self) -> FloatArray | None:
        """Return the corners for a FootprintCollisionChecker; None for a circular robot."""
        return None if self.is_circular else self.footprint

    def robot_pose(self) -> Pose2D:
        """
        Look up the pose of the robot in `global_frame`.

        Raises
        ------
        TransformError
            It is not available, or older than `transform_tolerance`.

        """
        return self._robot.pose()

    def checker(self) -> FootprintCollisionChecker:
        """Make a collision checker for the newest costmap."""
        return FootprintCollisionChecker(self.grid)

    def resolve_beside(self, topic: str) -> str:
        """
        Resolve a topic name in the parent of the costmap's namespace.

        Parameters
        ----------
        topic
            Its name; one that starts with `/` or `~` is unchanged.

        """
        if topic.startswith(('/', '~')):
            return topic
        return f'{self.get_namespace().rpartition("/")[0]}/{topic}'

    def update(self) -> None:
        """Update the costmap now."""
        robot = self._robot.find()
        region = self._costmap.update(robot)
        self.is_current = robot is not None and all(
            layer.is_current for layer in self.layers if layer.is_enabled
        )
        if self._publisher is not None:
            self._publisher.add(region)
            if robot is not None:
                self._publisher.publish_footprint(robot, self.footprint)

    def touch(self) -> None:
        """Mark the whole costmap for the next update."""
        self._costmap.touch()

    def clear(
        self, region_of: Callable[[Costmap2D], Region] | None, *, is_inverted: bool = False
    ) -> None:
        """
        Clear the data of sensors.

        Parameters
        ----------
        region_of
            Function that returns the region of a costmap; None for everything.
        is_inverted
            Whether to clear everything except for the region.

        """
        self._costmap.clear(region_of, is_inverted)
        self.update()

    def take_map_size(self, layer: Layer, grid: Costmap2D) -> None:
        """
        Resize the costmap to a map, unless it is rolling or sized by another map.

        Parameters
        ----------
        layer
            The layer that has received the map; only the first caller may resize.
        grid
            The map, whose size, resolution and origin the costmap gets.

        """
        if self.settings.rolling_window or self._sized_by not in (None, layer):
            return
        self._sized_by = layer
        default = self._costmap.default_cost
        self._resize(grid.with_cells(np.full_like(grid.cells, default)))

    def configure(self) -> None:
        """Read the parameters, and create the layers."""
        self._settings = self.parameters.declare(CostmapParameters)
        self._settings.on_change = self._change
        self.parameters.declare_unsupported(UNSUPPORTED)
        explain_unused(self, {*self.settings.plugins, *self.settings.filters})
        self._robot = Robot(self, self._settings, self._take_shape)
        self._robot.set_shape(footprint_of(self.settings))
        default = NO_INFORMATION if self.tracks_unknown else FREE_SPACE
        grid = grid_of(self.settings, default)
        self._costmap = LayeredCostmap(grid, default, self.settings.rolling_window)
        self._costmap.layers += [make_plugin(self, name) for name in self.settings.plugins if name]
        self._costmap.filters += [
            make_plugin(self, name) for name in self.settings.filters if name
        ]
        self._publisher = CostmapPublisher(self, self._settings, self._costmap.layers, self.grid)
        CostmapServices(self)
        self._robot.listen()

    def activate(self) -> None:
        """Start updating the costmap."""
        self._robot.await_pose()
        if self.settings.update_frequency > 0.0:
            period_s = 1.0 / self.settings.update_frequency
            self._timer = self.create_timer(period_s, self._tick, clock=clock_of(self))
        self._update_and_publish()

    def deactivate(self) -> None:
        """Stop updating the costmap."""
        self.is_current = False
        if self._timer is not None:
            self.destroy_timer(self._timer)
            self._timer = None

    def cleanup(self) -> None:
        """Release the layers."""
        self._costmap = LayeredCostmap(Costmap2D(0, 0, 0.1, 0.0, 0.0), FREE_SPACE, False)
        self._publisher = self._sized_by = None
        self.is_current = False

    def _tick(self) -> None:
        if self._timer is not None:  # a tick may be in the executor's queue when its timer ends
            self._update_and_publish()

    def _update_and_publish(self) -> None:
        self.update()
        now, frequency = now_s(self), self.settings.publish_frequency
        since_s = now - self._published_s
        # Timers are not exact, and simulated time may jump back.
        is_due = frequency > 0.0 and (since_s < 0.0 or since_s >= 0.99 / frequency)
        if self._publisher is not None and is_due:
            self._published_s = now
            self._publisher.publish(self.grid)

    def _resize(self, grid: Costmap2D) -> None:
        """Resize the costmap, and update it immediately: it must not be taken for free space."""
        self._costmap.resize(grid)
        self.is_current = False
        if self.is_active:
            self.update()

    def _take_shape(self, shape: Footprint) -> None:
        for layer in self.layers:
            layer.set_footprint(shape)
        self.touch()

    def _change(self, new: CostmapParameters) -> None:
        """Apply parameters set at run time; raise ValueError to reject them."""
        old = self.settings
        try:
            footprint = footprint_of(new)
        except ConfigurationError as error:
            raise ValueError(str(error)) from error
        names = ('footprint', 'robot_radius', 'footprint_padding')
        if any(getattr(new, name) != getattr(old, name) for name in names):
            self._robot.set_shape(footprint)
        sizes = ('width', 'height', 'resolution', 'origin_x', 'origin_y')
        if self._sized_by is None and any(getattr(new, n) != getattr(old, n) for n in sizes):
            self._resize(grid_of(new, self._costmap.default_cost))
        if new.update_frequency != old.update_frequency and self._timer is not None:
            self._timer.cancel()
            if new.update_frequency > 0.0:
                self._timer.timer_period_ns = round(1e9 / new.update_frequency)
                self._timer.reset()


def make_costmap(owner: LifecycleNode, name: str) -> Costmap2DROS:
    """
    Make the costmap of a server: the node `<namespace of the server>/<name>/<name>`.

    Its parameters come from the files with which the process or the server was started, below
    `<name>/<name>`, and from parameters `<name>.<name>.<parameter>` of the server. It is spun
    together with the server, which configures, activates, deactivates and cleans it up with
    `trigger_configure` and so on.

    Parameters
    ----------
    owner
        The server.
    name
        Such as `global_costmap`.

    """
    namespace = f'{owner.get_namespace().rstrip("/")}/{name}'
    options = owner.node_options
    words = ['-r', f'__node:={name}', '-r', f'__ns:={namespace}']
    words += _shared_words(list(options.get('cli_args') or []))
    costmap = Costmap2DROS(
        name,
        namespace=namespace,
        context=owner.context,
        cli_args=['--ros-args', *words],
        parameter_overrides=[
            Parameter('use_sim_time', value=owner.get_parameter('use_sim_time').value),
            *_taken_overrides(owner, name),
        ],
    )
    costmap.owner = owner
    owner.add_companion(costmap)
    return costmap


def _shared_words(words: list[str]) -> list[str]:
    """Select the arguments of a server for its costmap: parameter files, topic remappings."""
    shared: list[str] = []
    for flag, value in zip(words, words[1:]):
        is_file = flag == '--params-file'
        is_rule = flag in ('-r', '--remap') and '__node:=' not in value and '__ns:=' not in value
        if is_file or (is_rule and '__name:=' not in value):
            shared += [flag, value]
    return shared


def _taken_overrides(owner: LifecycleNode, name: str) -> list[Parameter]:
    """Move the parameter overrides that are meant for the costmap out of those of its server."""
    taken = owner.parameters.take_given(f'{name}.{name}.')
    return [
        Parameter(each.removeprefix('ros__parameters.'), value=given.value)
        for each, given in taken.items()
    ]


def main() -> int:
    """Spin a standalone costmap, /costmap/costmap, until a signal; return the exit status."""
    return run_main(lambda: Costmap2DROS('costmap', namespace='costmap'))
