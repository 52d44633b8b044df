# SPDX-License-Identifier: Apache-2.0
"""Publish the scene as markers: fixed objects, and those that can move."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import repeat
from typing import Any

from geometry_msgs.msg import Point
from humanoid_common.qos import LATCHED
from humanoid_control.backends import Array
from humanoid_control.hosting.topics.filling import fill_quaternion, fill_vector
from humanoid_description.rotations import quaternion_from_rpy
from humanoid_simulation.backend.mujoco_world import MujocoWorld
from humanoid_simulation.quaternions import product, rotated
from humanoid_simulation.scene.display import parts_below, triangles_in_world
from humanoid_simulation.scene.furniture import HANGING
from humanoid_simulation.scene.meshes import Triangles
from humanoid_simulation.scene.parts import MESH, Part
from humanoid_simulation.scene.scene import Scene, Thing, WALL, WORLD
from humanoid_simulation.scene.walls import CEILING, FLOORING
from humanoid_simulation.simulator_parameters import SimulatorParameters
import numpy as np
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

MESHES = 'package://humanoid_simulation/meshes'
WALLS, FURNITURE = 'walls', 'furniture'
_LAYERS = {
    **dict.fromkeys((WALL, CEILING, *HANGING), WALLS),
    FLOORING: 'floors',
    'person': 'people',
}
_KINDS = {
    'box': Marker.CUBE,
    'sphere': Marker.SPHERE,
    'cylinder': Marker.CYLINDER,
    MESH: Marker.MESH_RESOURCE,
}
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

    def __init__(self, node: Node, backend: MujocoWorld, parameters: SimulatorParameters) -> None:
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

    def __init__(self, node: Node, backend: MujocoWorld) -> None:
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


def layers_of(scene: Scene) -> dict[str, list[Thing]]:
    """
    Group the fixed objects of a scene by layers that a viewer can hide.

    Parameters
    ----------
    scene
        The scene.

    Returns
    -------
    dict[str, list[Thing]]
        By the namespace of their markers: `walls`, `floors`, `furniture`, `people`.

    """
    layers: dict[str, list[Thing]] = {}
    for thing in scene.things:
        if thing.is_fixed:
            layers.setdefault(_LAYERS.get(thing.kind, FURNITURE), []).append(thing)
    return layers


def layer_markers(name: str, things: Iterable[Thing], walls_up_to_m: float) -> list[Marker]:
    """
    Make the markers of a layer: one triangle list for all shapes, and one for each mesh.

    One marker costs a viewer far less than one for each of hundreds of shapes.

    Parameters
    ----------
    name
        Namespace of the markers.
    things
        The fixed objects of the layer.
    walls_up_to_m
        Height in the world at which walls are cut; objects that hang higher are left out.

    Returns
    -------
    list of Marker
        In the world frame; the triangle list, if there are triangles, comes first.

    """
    markers = [_marker(name, 0, Marker.TRIANGLE_LIST)]
    triangles: list[Triangles] = [np.zeros((0, 3, 3), np.float32)]
    colours: list[ColorRGBA] = []
    for thing in things:
        for part in parts_below(thing, walls_up_to_m):
            if part.shape == MESH:
                marker = _part_marker(name, len(markers), part)
                turn = quaternion_from_rpy(*thing.orientation_rpy_rad)
                place(marker, part, np.array(thing.position_m), turn)
                markers.append(marker)
            else:
                triangles.append(triangles_in_world(thing, part))
                colours.extend(repeat(_colour(part), 3 * len(triangles[-1])))
    corners = np.concatenate(triangles).reshape(-1, 3).tolist()
    markers[0].points = [Point(x=x, y=y, z=z) for x, y, z in corners]
    markers[0].colors = colours
    fill_vector(markers[0].scale, np.ones(3))
    return markers if corners else markers[1:]


def thing_markers(thing: Thing) -> list[tuple[Part, Marker]]:
    """
    Make a marker for each visible part of an object; `place` sets its pose.

    Parameters
    ----------
    thing
        An object that can be moved.

    Returns
    -------
    list of tuple[Part, Marker]
        The parts with their markers, whose namespace is the name of the object.

    """
    shown = [part for part in thing.parts if part.is_shown]
    return [(part, _part_marker(thing.name, number, part)) for number, part in enumerate(shown)]


def place(marker: Marker, part: Part, position_m: Array, orientation: Array) -> None:
    """
    Set the pose of the marker of a part.

    Parameters
    ----------
    marker
        The marker that is changed, in the world frame.
    part
        The part, placed in the axes of its object.
    position_m, orientation
        Position (3,) and quaternion w, x, y, z (4,) of the object, in the world frame.

    """
    offset = rotated(np.array(part.position_m, dtype=np.float64), orientation)
    fill_vector(marker.pose.position, position_m + offset)
    turn = product(orientation, quaternion_from_rpy(*part.orientation_rpy_rad))
    fill_quaternion(marker.pose.orientation, turn)


def _part_marker(namespace: str, number: int, part: Part) -> Marker:
    """Create the marker of a part, without its pose."""
    marker = _marker(namespace, number, _KINDS[part.shape])
    fill_vector(marker.scale, np.array(part.box_m, dtype=np.float64))
    marker.color = _colour(part)
    if part.mesh:
        marker.mesh_resource = f'{MESHES}/{part.mesh}.stl'
    return marker


def _marker(namespace: str, number: int, kind: int) -> Marker:
    """Create an empty marker that stays in the world frame if the viewer's frame moves."""
    marker = Marker(ns=namespace, id=number, type=kind, action=Marker.ADD, frame_locked=True)
    marker.header.frame_id = WORLD
    marker.pose.orientation.w = 1.0
    marker.color.a = 1.0
    return marker


def _colour(part: Part) -> ColorRGBA:
    """Return the mean colour of a part, as seen from far away."""
    rgb: Sequence[float] = part.finish.mean_rgb if part.finish else part.colour_rgba[:3]
    red, green, blue = (float(value) for value in rgb)
    return ColorRGBA(r=red, g=green, b=blue, a=1.0)
