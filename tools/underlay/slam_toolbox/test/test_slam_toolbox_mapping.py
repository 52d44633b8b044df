# SPDX-License-Identifier: Apache-2.0
"""Maps of known worlds: by a robot with odometry that drifts."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from slam_toolbox_py import loop_closure
from slam_toolbox_py.localizer import Localizer
from slam_toolbox_py.loop_closure import close_loops, find_chains
from slam_toolbox_py.mapper import Keyframe, Mapper
from slam_toolbox_py.occupancy import FREE, MapDrawing, OCCUPIED
from slam_toolbox_py.pose_graph import Edge
from slam_toolbox_py.poses import compose, wrap
from slam_toolbox_py.session import Session, SessionSettings
from slam_toolbox_py.settings import MapperSettings
from slam_toolbox_py.storage import load_pose_graph, PoseGraphFileError, save_pose_graph
from slam_world import Robot, room, walk, walls

TOUR = [(1.2, 2.0), (5.5, 1.5), (5.7, 3.8), (3.5, 3.9), (1.2, 3.5), (1.2, 2.0)] * 2
SETTINGS = MapperSettings(minimum_travel_distance=0.3, minimum_travel_heading=0.3)


def drive(world, way, mapper, robot, range_max_m=12.0, loops=True):
    """Drive along a way; return the true poses of the keyframes."""
    true = []
    for pose in walk(way):
        robot.step(pose, 0.1)
        if mapper.is_due(robot.odometry):
            scan = world.scan(robot.pose, robot.rng, range_max_m=range_max_m)
            mapper.add(scan, robot.odometry)
            true.append(robot.pose)
            if loops:
                for _ in close_loops(mapper, len(mapper.keyframes) - 1):
                    pass
    return np.array(true)


@pytest.fixture(scope='module')
def mapped():
    world = room()
    robot = Robot(next(walk(TOUR)), np.random.default_rng(3))
    mapper = Mapper(SETTINGS)
    return world, mapper, drive(world, TOUR, mapper, robot), robot


def occupied_distances(world, mapper, resolution_m=0.05):
    """Return the distances in m of occupied cells to walls, and the grid."""
    drawing = MapDrawing(resolution_m)
    drawing.update(mapper)
    grid = drawing.grid(2, 0.1)
    rows, columns = np.nonzero(grid.cells == OCCUPIED)
    middles = (np.stack([columns, rows], axis=1) + 0.5) * resolution_m + grid.origin
    return world.distance_at(middles), grid


def test_map_of_a_room_is_true(mapped):
    """Walls are where they are, the way is free, and the robot knows its pose at the end."""
    world, mapper, true, robot = mapped
    distances, grid = occupied_distances(world, mapper)
    assert (distances < 0.1).mean() > 0.98
    cells = np.floor((true[:, :2] - grid.origin) / 0.05).astype(int)
    assert (grid.cells[cells[:, 1], cells[:, 0]] == FREE).all()
    assert np.hypot(*(mapper.graph.poses[-1] - true[-1])[:2]) < 0.03
    assert abs(wrap(mapper.graph.poses[-1, 2] - true[-1, 2])) < np.deg2rad(0.5)
    assert np.hypot(*(robot.odometry - true[-1])[:2]) > 0.1


def test_walls_are_complete(mapped):
    """Nearly all of the walls that the robot could see are in the map."""
    world, mapper, _, _ = mapped
    _, grid = occupied_distances(world, mapper)
    occupied = (grid.cells == OCCUPIED).astype(np.uint8)
    near = cv2.distanceTransform(1 - occupied, cv2.DIST_L2, 5) * 0.05
    inner_wall = [(x, 0.5) for x in np.arange(0.7, 1.9, 0.1)] + [
        (0.5, y) for y in np.arange(0.7, 4.4, 0.1)
    ]
    cells = np.floor((np.array(inner_wall) - grid.origin) / 0.05).astype(int)
    assert (near[cells[:, 1], cells[:, 0]] < 0.08).mean() > 0.9


def test_large_drift_is_corrected_when_a_loop_closes():
    """Around a ring of corridors the end meets the beginning, and the map follows."""
    world = walls(
        (26.0, 26.0),
        0.02,
        [
            (0.0, 0.0, 26.0, 0.2),
            (0.0, 25.8, 26.0, 26.0),
            (0.0, 0.0, 0.2, 26.0),
            (25.8, 0.0, 26.0, 26.0),
            (2.2, 2.2, 23.8, 23.8),
            (9.0, 1.9, 10.0, 2.2),
            (0.2, 12.0, 0.5, 12.6),
            (1.9, 16.0, 2.2, 16.5),
        ],
    )
    ring = [(1.2, 1.2), (24.8, 1.2), (24.8, 24.8), (1.2, 24.8), (1.2, 1.2), (12.0, 1.2)]
    robot = Robot(next(walk(ring)), np.random.default_rng(8), scale=1.02)
    mapper = Mapper(MapperSettings())
    true = drive(world, ring, mapper, robot, range_max_m=8.0)
    assert any(each.is_loop for each in mapper.graph.edges)
    assert np.hypot(*(robot.odometry - true[-1])[:2]) > 1.0
    assert np.hypot(*(mapper.graph.poses[-1] - true[-1])[:2]) < 0.15


def test_long_corridor_closes_no_false_loop():
    """Nothing is alike along a corridor for the mapper, although all scans are."""
    world = walls((44.0, 3.0), 0.02, [(0.0, 0.5, 44.0, 0.6), (0.0, 2.0, 44.0, 2.1)])
    way = [(4.0, 1.3), (40.0, 1.3)]
    robot = Robot(next(walk(way)), np.random.default_rng(9), scale=1.01, turn_rad_s=0.0)
    mapper = Mapper(MapperSettings(loop_match_minimum_chain_size=3, scan_buffer_size=4))
    true = drive(world, way, mapper, robot, range_max_m=6.0)
    assert not any(each.is_loop for each in mapper.graph.edges)
    assert np.abs(mapper.graph.poses[:, 1] - true[:, 1]).max() < 0.1
    # Back again: loops are closed, and do not shrink the corridor.
    drive(world, [(40.0, 1.3), (4.0, 1.3)], mapper, robot, range_max_m=6.0)
    length = mapper.graph.poses[len(true) - 1, 0] - mapper.graph.poses[0, 0]
    assert length == pytest.approx(36.0, abs=1.0)


def test_rejected_loop_leaves_no_trace(monkeypatch):
    """Even if a keyframe comes during the optimization, all poses are those of before."""
    mapper, ahead = Mapper(), np.array([1.0, 0.0, 0.0])
    scan = room().scan(np.array([3.6, 2.0, 0.0]))

    def add():
        node = len(mapper.keyframes)
        pose = ahead * node
        mapper.add_known(Keyframe(scan, pose, float(node)), pose, float(node))
        if node:
            mapper.graph.add_edge(Edge(node - 1, node, ahead, np.diag([100.0, 100.0, 100.0])))

    for _ in range(10):
        add()
    wrong = Edge(0, 9, np.array([0.0, 30.0, 0.0]), np.diag([100.0] * 3), is_loop=True)
    monkeypatch.setattr(loop_closure, 'find_chains', lambda *_: [[0]])
    monkeypatch.setattr(loop_closure, '_match', lambda *_: wrong)
    closing = close_loops(mapper, 9)
    said = [next(closing), next(closing)]
    add()
    said += closing
    assert len(said) > 2 and not any(said)
    assert wrong not in mapper.graph.edges
    assert mapper.last_loop == Mapper().last_loop
    assert mapper.graph.poses == pytest.approx(np.arange(11)[:, None] * ahead, abs=1e-12)
    assert mapper.map_to_odom == pytest.approx(np.zeros(3), abs=1e-12)


def test_chains_are_old_and_near(mapped):
    """What is near and long ago is a candidate, and not the last keyframes."""
    _, mapper, _, _ = mapped
    node = len(mapper.keyframes) - 1
    chains = find_chains(mapper, node)
    assert chains
    assert max(max(each) for each in chains) <= node - 20
    assert all(len(each) >= 10 for each in chains)
    assert not find_chains(mapper, 15)


def test_serialized_map_is_the_same(mapped, tmp_path):
    """A map goes through a file with all of its keyframes and edges, and goes on."""
    world, mapper, _, _ = mapped
    path = save_pose_graph(mapper, str(tmp_path / 'home'))
    assert path == tmp_path / 'home.posegraph'
    assert (tmp_path / 'home.data').exists()
    assert sorted(each.name for each in tmp_path.iterdir()) == ['home.data', 'home.posegraph']
    again = load_pose_graph(str(tmp_path / 'home'), SETTINGS)
    assert np.array_equal(again.graph.poses, mapper.graph.poses)
    assert len(again.graph.edges) == len(mapper.graph.edges)
    assert np.allclose(again.keyframes[3].scan.points, mapper.keyframes[3].scan.points, atol=1e-5)
    assert (occupied_distances(world, again)[0] < 0.1).mean() > 0.98
    place = np.array([3.6, 2.0, 1.0])
    again.start_at(place + [0.2, -0.2, 0.1])
    found = again.add(world.scan(place, np.random.default_rng(2)), np.zeros(3))
    assert np.hypot(*(found.pose - place)[:2]) < 0.03
    assert compose(again.map_to_odom, np.zeros(3)) == pytest.approx(found.pose)


@pytest.mark.parametrize('fault', ['cut', 'text', 'empty', 'other arrays', 'edge'])
def test_broken_file_is_refused_with_a_sentence(mapped, tmp_path, fault):
    """A file that is damaged, or something else, is named with what is wrong."""
    path = save_pose_graph(mapped[1], str(tmp_path / 'home'))
    content = path.read_bytes()
    if fault == 'other arrays':
        np.savez(tmp_path / 'other.npz', poses=np.zeros((2, 3)))
        content = (tmp_path / 'other.npz').read_bytes()
    elif fault == 'edge':
        with np.load(path) as file:
            arrays = dict(file)
        arrays['edge_nodes'] = arrays['edge_nodes'] + 1000
        np.savez(tmp_path / 'other.npz', **arrays)
        content = (tmp_path / 'other.npz').read_bytes()
    path.write_bytes(
        {'cut': content[: len(content) // 2], 'text': b'serialization::archive', 'empty': b''}.get(
            fault, content
        )
    )
    with pytest.raises(PoseGraphFileError, match=r'home\.posegraph.*(broken|cannot be read)'):
        load_pose_graph(str(tmp_path / 'home'), SETTINGS)


def test_missing_file_is_named(tmp_path):
    """A name without a file is told with its whole path."""
    with pytest.raises(PoseGraphFileError, match='nowhere.posegraph.* not found'):
        load_pose_graph(str(tmp_path / 'nowhere'), SETTINGS)


def test_localizer_follows_a_robot(mapped):
    """In a finished map the robot is found near a start, and followed with bad odometry."""
    world, mapper, _, _ = mapped
    way = [(1.5, 2.2), (4.2, 2.4), (5.6, 1.4)]
    robot = Robot(next(walk(way)), np.random.default_rng(4), scale=1.05, turn_rad_s=0.005)
    robot.odometry = np.zeros(3)
    count = len(mapper.keyframes)
    localizer = Localizer(mapper, robot.pose + [0.2, -0.1, 0.15])
    for pose in walk(way):
        robot.step(pose, 0.1)
        if localizer.is_due(robot.odometry):
            localizer.add(world.scan(robot.pose, robot.rng), robot.odometry)
            found = compose(localizer.map_to_odom, robot.odometry)
            assert np.hypot(*(found - robot.pose)[:2]) < 0.05
    assert len(mapper.keyframes) == count


def make_session(**options):
    told = []
    session = Session(
        SessionSettings(SETTINGS, minimum_time_interval_s=0.1, **options), told.append
    )
    return session, told


def test_session_survives_time_that_jumps_back():
    """After a reset of the simulation the robot is found at its beginning, in the same map."""
    world, rng = room(), np.random.default_rng(11)
    session, told = make_session()
    robot, way = Robot(next(walk(TOUR)), rng), TOUR[:4]
    for i, pose in enumerate(walk(way)):
        robot.step(pose, 0.1)
        session.process(robot.odometry, 100.0 + 0.1 * i, lambda: world.scan(robot.pose, rng))
        session.work(1.0)
    count, begin = len(session.mapper.keyframes), next(walk(TOUR))
    placed = session.process(begin, 1.0, lambda: world.scan(begin, rng))
    assert np.hypot(*(placed.pose - begin)[:2]) < 0.05
    assert len(session.mapper.keyframes) == count + 1
    assert 'jumped back by' in told[-1]


def test_session_notices_odometry_that_begins_anew():
    """Odometry that starts again at zero does not move the robot in the map."""
    world, rng = room(), np.random.default_rng(12)
    session, told = make_session()
    place = np.array([3.6, 2.0, 1.0])
    session.process(place, 1.0, lambda: world.scan(place, rng))
    placed = session.process(np.zeros(3), 1.2, lambda: world.scan(place, rng))
    assert np.hypot(*(placed.pose - place)[:2]) < 0.05
    assert 'Odometry jumped' in told[-1]


def test_map_is_drawn_anew_in_short_steps(mapped):
    """After keyframes have moved the map follows, in many steps."""
    import time

    world, mapper, _, _ = mapped
    drawing = MapDrawing(0.05)
    drawing.update(mapper)
    poses = mapper.graph.poses
    mapper.graph.poses = compose(np.array([0.5, 0.0, 0.0]), poses)
    assert drawing.backlog(mapper) == len(mapper.keyframes)
    steps = []
    begin = time.process_time()
    for _ in drawing.drawing(mapper):
        steps.append(time.process_time() - begin)
        begin = time.process_time()
    mapper.graph.poses = poses
    assert len(steps) >= 2
    assert np.mean(steps) < 0.05
    rows, columns = np.nonzero(drawing.grid(2, 0.1).cells == OCCUPIED)
    middles = (np.stack([columns, rows], axis=1) + 0.5) * 0.05 + drawing.grid(2, 0.1).origin
    assert (world.distance_at(middles - [0.5, 0.0]) < 0.1).mean() > 0.95
