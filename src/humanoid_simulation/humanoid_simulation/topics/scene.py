# SPDX-License-Identifier: Apache-2.0
"""Publishers of the scene as markers: fixed objects, and those that can move."""

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
"""Minimum period at which an object is published."""
_LEAST_M, _LEAST_TURN = 1e-3, 1e-5
"""Smaller motions are not published; a rotation of 0.5 degrees is 1 - cos(0.25 deg)."""


class SceneTopics:
    """
    Publishers of `ground_truth/scene` and `ground_truth/things`, both latched.

    The first one has all fixed objects, and is published again when the height at which walls are
    cut changes. The second one has the others: all of them at the start and for a new subscriber,
    and then only those that have moved, also in a pause. At rest nothing is published.

    Parameters
    ----------
    node
        The node that publishes them.
    backend
        The world.
    parameters : SimulatorParameters
        The parameters of the simulator, of which `walls_shown_up_to_m` is used.

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
            The parameters of the simulator, of which `walls_shown_up_to_m` is used.

        """
        if parameters.walls_shown_up_to_m != self._walls_up_to_m:
            self._walls_up_to_m = parameters.walls_shown_up_to_m
            self._show(WALLS)

    def change_scene(self) -> None:
        """Publish the new scene of the backend."""
        self._layers = layers_of(self._backend.scene)
        self._shown: dict[str, list[Marker]] = {}
        self._show(*self._layers)
        self._things.change_scene()

    def _show(self, *names: str) -> None:
        """Rebuild the markers of some layers, and publish those of all layers."""
        for name in names:
            things = self._layers.get(name, [])
            self._shown[name] = layer_markers(name, things, self._walls_up_to_m)
        markers = [marker for layer in self._shown.values() for marker in layer]
        # Markers that were cut away must be deleted; a scene without any is published, too.
        self._scene.publish(MarkerArray(markers=[Marker(action=Marker.DELETEALL), *markers]))


@dataclass(eq=False)
class _Shown:
    """An object, its markers, and the pose at which it was published last."""

    thing: Thing
    markers: list[Any]
    position_m: Array
    orientation: Array

    def follow(self, position_m: Array, orientation: Array, anyway: bool) -> bool:
        """Update the markers if the object has moved or `anyway` is set; return whether it did."""
        moved_m = float(np.abs(position_m - self.position_m).max())
        turned = 1.0 - abs(float(orientation @ self.orientation))
        if not anyway and moved_m < _LEAST_M and turned < _LEAST_TURN:
            return False
        self.position_m, self.orientation = position_m, orientation
        for part, marker in self.markers:
            place(marker, part, position_m, orientation)
        return True


class _MovingThings:
    """Publisher of the objects that can move, when they have moved."""

    def __init__(self, node: Node, backend: MujocoBackend) -> None:
        self._backend = backend
        self._publisher = node.create_publisher(MarkerArray, 'ground_truth/things', LATCHED)
        self._subscribers = 0

    def change_scene(self) -> None:
        """Publish all objects that can move in the new scene of the backend."""
        self._shown = [
            _Shown(thing, thing_markers(thing), np.zeros(3), np.array([1.0, 0.0, 0.0, 0.0]))
            for thing in self._backend.scene.objects
        ]
        self._publish([Marker(action=Marker.DELETEALL)], everything=True)

    def look(self) -> None:
        """Publish objects that have moved, if there are subscribers; all for a new subscriber."""
        subscribers = self._publisher.get_subscription_count()
        is_new, self._subscribers = subscribers > self._subscribers, subscribers
        if subscribers:
            self._publish([], everything=is_new)

    def _publish(self, markers: list[Marker], everything: bool) -> None:
        """Publish some markers, and then those of objects that have moved, or of all objects."""
        for shown in self._shown:
            state = self._backend.entity_state(shown.thing.name)
            if shown.follow(state.position_m, state.orientation, everything):
                markers.extend(marker for _, marker in shown.markers)
        if markers or everything:
            self._publisher.publish(MarkerArray(markers=markers))
