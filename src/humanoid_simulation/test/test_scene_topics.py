# SPDX-License-Identifier: Apache-2.0
"""What viewers get of a scene."""

from __future__ import annotations

from collections.abc import Iterator
import math
from pathlib import Path
from typing import Any

from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_simulation.examples.conversions import refusal
from humanoid_simulation.files import share
from humanoid_simulation.scene import load_scene, Thing
from humanoid_simulation.scene.display import parts_below, triangles_in_world
from humanoid_simulation.scene.meshes import PROFILES, stl_of, triangles_of
from humanoid_simulation.scene.parts import Part
from humanoid_simulation.scene.scene import COMPOSED
from humanoid_simulation.simulator import Simulator
from humanoid_simulation.topics.scene import layer_markers, layers_of, thing_markers
import numpy as np
import pytest
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from simulation_interfaces.srv import SetEntityState
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

EACH = QoSProfile(depth=50, durability=DurabilityPolicy.TRANSIENT_LOCAL)
QUIET = {'camera_rate_hz': 0.0, 'start_paused': True}


@pytest.fixture
def ros() -> Iterator[RosSandbox]:
    """Give a domain of one's own."""
    with ros_sandbox() as sandbox:
        yield sandbox


class Viewer:
    """Hears the scene of a simulator."""

    def __init__(self, ros: RosSandbox) -> None:
        """Subscribe both topics."""
        self.ros, self.node = ros, ros.observer()
        self.scenes: list[MarkerArray] = []
        self.things: list[MarkerArray] = []
        self.node.create_subscription(MarkerArray, 'ground_truth/scene', self.scenes.append, EACH)
        self.node.create_subscription(MarkerArray, 'ground_truth/things', self.things.append, EACH)

    def wait(self, condition: Any, what: str) -> None:
        """Spin until a condition holds."""
        self.ros.wait_until(condition, 30.0, what)

    def put(self, name: str, x: float, y: float, z: float) -> None:
        """Move a thing, in the world of the simulator."""
        client = self.node.create_client(SetEntityState, 'simulator/set_entity_state')
        request = SetEntityState.Request(entity=name)
        position = request.state.pose.position
        position.x, position.y, position.z = x, y, z
        self.wait(client.service_is_ready, 'the service')
        future = client.call_async(request)
        self.wait(future.done, 'the answer')
        assert not refusal(future.result())


def names(message: MarkerArray) -> set[str]:
    """Return the namespaces of the markers of a message."""
    return {marker.ns for marker in message.markers if marker.action == Marker.ADD}


def test_what_is_fixed_is_latched_and_what_moves_follows(ros: RosSandbox) -> None:
    """Who joins late gets all; then only what has moved comes, also in a pause; then nothing."""
    simulator = ros.start(Simulator, {**QUIET, 'scene': 'apartment'})
    viewer = Viewer(ros)
    viewer.wait(lambda: viewer.scenes and viewer.things, 'the scene')
    assert names(viewer.scenes[-1]) == {'floors', 'walls', 'furniture', 'people'}
    objects = {thing.name for thing in load_scene('apartment').objects}
    assert names(viewer.things[0]) == objects
    assert {m.header.frame_id for m in viewer.scenes[-1].markers[1:]} == {'world'}
    # Everything comes once more when the simulator notices the viewer.
    topic = simulator._world._scene._things
    viewer.wait(lambda: topic._subscribers == 1, 'the simulator to notice')

    def moved() -> list[set[str]]:
        return [names(message) for message in viewer.things if names(message) != objects]

    viewer.put('red_mug', 0.5, 0.25, 0.05)
    viewer.wait(lambda: moved() == [{'red_mug'}], 'the mug')
    place = viewer.things[-1].markers[0].pose.position
    assert (place.x, place.y) == pytest.approx((0.5, 0.25), abs=1e-6)
    # That nothing came in between shows when the next thing moves.
    viewer.put('blue_mug', 0.5, -0.25, 0.05)
    viewer.wait(lambda: len(moved()) > 1, 'the other mug')
    assert moved() == [{'red_mug'}, {'blue_mug'}]
    late = Viewer(ros)
    late.wait(lambda: late.things and names(late.things[-1]) == objects, 'all things')
    late_mug = next(m for m in late.things[-1].markers if m.ns == 'red_mug')
    assert late_mug.pose.position.x == pytest.approx(0.5, abs=1e-6)


def heights(message: MarkerArray) -> dict[str, float]:
    """Return how high the triangles of each namespace reach."""
    return {
        marker.ns: max(point.z for point in marker.points)
        for marker in message.markers
        if marker.points
    }


def test_walls_are_cut_where_a_parameter_says(ros: RosSandbox) -> None:
    """The whole scene comes again, walls lower, what hangs above gone, furniture as it was."""
    simulator = ros.start(Simulator, {**QUIET, 'scene': 'apartment', 'walls_shown_up_to_m': 3.0})
    viewer = Viewer(ros)
    viewer.wait(lambda: viewer.scenes, 'the scene')
    before = heights(viewer.scenes[-1])
    assert before['walls'] == pytest.approx(2.3, abs=0.01)
    simulator.set_parameters([Parameter('walls_shown_up_to_m', value=0.3)])
    viewer.wait(lambda: len(viewer.scenes) > 1, 'the scene again')
    after = heights(viewer.scenes[-1])
    assert viewer.scenes[-1].markers[0].action == Marker.DELETEALL
    assert after['walls'] == pytest.approx(0.3, abs=1e-6)
    assert after['furniture'] == pytest.approx(2.0, abs=0.01)
    assert after['people'] == before['people']


def test_other_scenes_are_shown_as_well(ros: RosSandbox) -> None:
    """The walls of `room` are cut; its things are there."""
    ros.start(Simulator, {**QUIET, 'scene': 'room', 'walls_shown_up_to_m': 0.5})
    viewer = Viewer(ros)
    viewer.wait(lambda: viewer.scenes and viewer.things, 'the scene')
    assert heights(viewer.scenes[-1])['walls'] == pytest.approx(0.5)
    assert heights(viewer.scenes[-1])['furniture'] == pytest.approx(1.2)
    assert names(viewer.things[-1]) == {'red_box', 'green_ball', 'blue_cylinder', 'yellow_box'}


def test_the_world_is_where_the_truth_is(ros: RosSandbox) -> None:
    """From `world`, by `odom`, to the base: it is where the base truly is."""
    simulator = ros.start(
        Simulator, {**QUIET, 'start_paused': False, 'start_x_m': 1.5, 'start_yaw_rad': 0.7}
    )
    node = ros.observer()
    found: dict[str, Any] = {}

    def hear(message: TFMessage) -> None:
        for transform in message.transforms:
            found[transform.child_frame_id] = transform

    node.create_subscription(TFMessage, 'tf', hear, 10)
    ros.wait_until(lambda: {'world', 'base_link'} <= set(found), 30.0, 'both transforms')
    world, base = found['world'], found['base_link'].transform.translation
    assert world.header.frame_id == 'odom'
    yaw_rad = 2.0 * math.atan2(world.transform.rotation.z, world.transform.rotation.w)
    shift = world.transform.translation
    dx, dy = base.x - shift.x, base.y - shift.y
    x_m = math.cos(yaw_rad) * dx + math.sin(yaw_rad) * dy
    y_m = -math.sin(yaw_rad) * dx + math.cos(yaw_rad) * dy
    truth_m = simulator._backend.ground_truth().position_m
    assert (x_m, y_m) == pytest.approx(truth_m[:2], abs=0.01)


def test_a_bare_floor_is_said_to_be_one(ros: RosSandbox) -> None:
    """Messages without markers come, so that a viewer need not ask itself what it misses."""
    ros.start(Simulator, {**QUIET, 'scene': 'flat'})
    viewer = Viewer(ros)
    viewer.wait(lambda: viewer.scenes and viewer.things, 'both messages')
    assert names(viewer.scenes[-1]) == names(viewer.things[-1]) == set()


def test_the_meshes_of_viewers_are_those_of_the_scene() -> None:
    """The installed files are what the program writes; each is closed, and fills its box."""
    for name in PROFILES:
        file = share() / 'meshes' / f'{name}.stl'
        triangles = triangles_of(name)
        assert file.read_bytes() == stl_of(triangles), f'run {Path("scene/meshes.py")} again'
        corners = triangles.reshape(-1, 3)
        assert np.abs(corners).max() <= 0.5 + 1e-6
        edges: dict[tuple[bytes, bytes], int] = {}
        for triangle in np.round(triangles, 5) + 0.0:
            for number in range(3):
                a, b = triangle[number].tobytes(), triangle[(number + 1) % 3].tobytes()
                edges[a, b] = edges.get((a, b), 0) + 1
        assert all(edges.get((b, a)) == count == 1 for (a, b), count in edges.items()), name


def test_each_mesh_that_a_scene_uses_is_installed() -> None:
    """No marker names a file that is not there."""
    scene = load_scene('apartment')
    markers = [
        m for name, those in layers_of(scene).items() for m in layer_markers(name, those, 9)
    ]
    markers += [marker for thing in scene.objects for _, marker in thing_markers(thing)]
    meshes = {marker.mesh_resource for marker in markers if marker.mesh_resource}
    assert meshes
    for mesh in meshes:
        assert (share() / mesh.removeprefix('package://humanoid_simulation/')).is_file()


@pytest.mark.parametrize('shape', ['box', 'sphere', 'cylinder'])
def test_triangles_are_where_the_part_is(shape: str) -> None:
    """They reach as far as the shape does, turned and moved with its thing, and face outwards."""
    size = {'box': (0.4, 0.2, 0.6), 'sphere': (0.3,), 'cylinder': (0.1, 0.8)}[shape]
    part = Part(shape, size, (0.0, 0.5, 0.0))
    thing = Thing('t', 'box', (1.0, 1.0, 1.0), (1.0, 2.0, 3.0), (0.0, 0.0, math.pi / 2))
    triangles = triangles_in_world(thing, part)
    corners = triangles.reshape(-1, 3)
    middle = np.array([0.5, 2.0, 3.0])
    length, width, height = part.box_m
    reach = np.array([width, length, height]) / 2
    assert corners.min(axis=0) == pytest.approx(middle - reach, abs=0.01)
    assert corners.max(axis=0) == pytest.approx(middle + reach, abs=0.01)
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    outward = triangles.mean(axis=1) - middle
    assert (np.sum(normals * outward, axis=1) > 0.0).all()


def test_what_is_cut_ends_at_the_height() -> None:
    """A wall that begins above is gone; one below is whole."""
    wall = Thing('w', 'box', (2.0, 0.1, 1.0), (0.0, 0.0, 1.5), kind='wall')
    assert parts_below(wall, 0.9) == ()
    (part,) = parts_below(wall, 1.2)
    assert wall.position_m[2] + part.position_m[2] + part.size_m[2] / 2 == pytest.approx(1.2)
    assert wall.position_m[2] + part.position_m[2] - part.size_m[2] / 2 == pytest.approx(1.0)
    assert parts_below(wall, 5.0)[0].size_m == wall.size_m


def test_what_hangs_is_shown_if_all_of_it_is_below_the_cut() -> None:
    """Its top counts, not its middle, even if a part is turned."""
    picture = Thing('p', 'box', (0.05, 0.8, 0.6), (0.0, 0.0, 1.5), kind='picture')
    assert parts_below(picture, 1.79) == ()
    assert parts_below(picture, 1.81) == picture.parts
    turned = Part('box', (0.05, 0.8, 0.6), orientation_rpy_rad=(math.pi / 2, 0.0, 0.0))
    picture = Thing(
        'p', COMPOSED, (0.05, 0.6, 0.8), (0.0, 0.0, 1.5), kind='picture', details=(turned,)
    )
    assert parts_below(picture, 1.89) == ()
    assert parts_below(picture, 1.91) == (turned,)
