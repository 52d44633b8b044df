# SPDX-License-Identifier: Apache-2.0
"""Convert the objects of a scene to markers."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import repeat

from geometry_msgs.msg import Point
from humanoid_control.backends import Array
from humanoid_control.hosting.topics.filling import fill_quaternion, fill_vector
from humanoid_simulation.rotations import from_rpy, product, rotated
from humanoid_simulation.scene.cutting import parts_below
from humanoid_simulation.scene.furniture import HANGING
from humanoid_simulation.scene.meshes import Triangles
from humanoid_simulation.scene.parts import MESH, Part
from humanoid_simulation.scene.scene import Scene, Thing, WALL
from humanoid_simulation.scene.triangles import triangles_in_world
from humanoid_simulation.scene.walls import CEILING, FLOORING
from humanoid_simulation.topics.ground_truth import WORLD
import numpy as np
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker

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
                turn = from_rpy(*thing.orientation_rpy_rad)
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
    turn = product(orientation, from_rpy(*part.orientation_rpy_rad))
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
