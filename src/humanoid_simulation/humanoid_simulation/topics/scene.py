# SPDX-License-Identifier: Apache-2.0
"""Show viewers the scene: what is fixed, and where the rest is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from humanoid_common.qos import LATCHED
from humanoid_control.backends import Array
from humanoid_simulation.backend import MujocoBackend
from humanoid_simulation.scene import Thing
from humanoid_simulation.simulator_parameters import SimulatorParameters
from humanoid_simulation.topics.scene_markers import (
    layer_markers,
    layers_of,
    place,
    thing_markers,
    WALLS,
)
import numpy as np
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from visualization_msgs.msg import Marker, MarkerArray

_PERIOD_S = 0.1
"""No thing is shown more often than that."""
_LEAST_M, _LEAST_TURN = 1e-3, 1e-5
"""What has moved less stays where it was shown; a turn of 0.5 degrees is 1 - cos(0.25 deg)."""


class SceneTopics:
    """
    The topics `ground_truth/scene` and `ground_truth/things`, both latched.

    The first one has all that is fixed, and is published again when walls are cut elsewhere. The
    second one has what is not: all of it at the start and when somebody joins, and then only what
    has moved, also while the simulation is paused. At rest nothing is published.

    Parameters
    ----------
    node
        The node that publishes them.
    backend
        The world.
    parameters : SimulatorParameters
        The parameters of the simulator, of which `walls_shown_up_to_m` counts.

    """

    def __init__(
        self, node: Node, backend: MujocoBackend, parameters: SimulatorParameters
    ) -> None:
        self._backend = backend
        self._walls_up_to_m = parameters.walls_shown_up_to_m
        self._scene = node.create_publisher(MarkerArray, 'ground_truth/scene', LATCHED)
        self._things = _MovingThings(node, backend)
        self.change_scene()
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = node.create_timer(_PERIOD_S, self._things.look, clock=steady)

    def change(self, parameters: SimulatorParameters) -> None:
        """
        Apply changed parameters: the height at which walls are cut.

        Parameters
        ----------
        parameters : SimulatorParameters
            The parameters of the simulator, of which `walls_shown_up_to_m` counts.

        """
        if parameters.walls_shown_up_to_m != self._walls_up_to_m:
            self._walls_up_to_m = parameters.walls_shown_up_to_m
            self._show(WALLS)

    def change_scene(self) -> None:
        """Show another scene, which the backend has now."""
        self._layers = layers_of(self._backend.scene)
        self._shown: dict[str, list[Marker]] = {}
        self._show(*self._layers)
        self._things.change_scene()

    def _show(self, *names: str) -> None:
        """Make the markers of some layers anew, and publish all."""
        for name in names:
            things = self._layers.get(name, [])
            self._shown[name] = layer_markers(name, things, self._walls_up_to_m)
        markers = [marker for layer in self._shown.values() for marker in layer]
        # What was cut away is to go, too; and a bare floor is said to be one.
        self._scene.publish(MarkerArray(markers=[Marker(action=Marker.DELETEALL), *markers]))


@dataclass(eq=False)
class _Shown:
    """A thing, its markers, and where it was shown last."""

    thing: Thing
    markers: list[Any]
    position_m: Array
    orientation: Array

    def follow(self, position_m: Array, orientation: Array, anyway: bool) -> bool:
        """Tell whether the thing is to be shown, as it has moved; place its markers then."""
        moved_m = float(np.abs(position_m - self.position_m).max())
        turned = 1.0 - abs(float(orientation @ self.orientation))
        if not anyway and moved_m < _LEAST_M and turned < _LEAST_TURN:
            return False
        self.position_m, self.orientation = position_m, orientation
        for part, marker in self.markers:
            place(marker, part, position_m, orientation)
        return True


class _MovingThings:
    """Publishes the things that can move, when they have moved."""

    def __init__(self, node: Node, backend: MujocoBackend) -> None:
        """Announce the topic."""
        self._backend = backend
        self._publisher = node.create_publisher(MarkerArray, 'ground_truth/things', LATCHED)
        self._subscribers = 0

    def change_scene(self) -> None:
        """Publish all things of another scene, which the backend has now."""
        self._shown = [
            _Shown(thing, thing_markers(thing), np.zeros(3), np.array([1.0, 0.0, 0.0, 0.0]))
            for thing in self._backend.scene.objects
        ]
        self._publish([Marker(action=Marker.DELETEALL)], everything=True)

    def look(self) -> None:
        """Publish what has moved, to those who listen; to a new one everything."""
        subscribers = self._publisher.get_subscription_count()
        is_new, self._subscribers = subscribers > self._subscribers, subscribers
        if subscribers:
            self._publish([], everything=is_new)

    def _publish(self, markers: list[Marker], everything: bool) -> None:
        """Publish some markers, and then what has moved since it was shown, or everything."""
        for shown in self._shown:
            state = self._backend.entity_state(shown.thing.name)
            if shown.follow(state.position_m, state.orientation, everything):
                markers.extend(marker for _, marker in shown.markers)
        if markers or everything:
            self._publisher.publish(MarkerArray(markers=markers))
