# SPDX-License-Identifier: Apache-2.0
"""Pose graphs: against closed forms, with loops, and with wrong ones."""

from __future__ import annotations

import numpy as np
import pytest
from slam_toolbox_py.pose_graph import Edge, PoseGraph
from slam_toolbox_py.poses import compose, inverse, relative

I3 = np.eye(3)


def chain(steps):
    """Return a graph of poses that follow each other by the same step."""
    graph = PoseGraph()
    pose = np.zeros(3)
    graph.add_node(pose)
    for step in steps:
        pose = compose(pose, np.asarray(step, dtype=float))
        graph.add_node(pose)
    return graph


def test_disagreement_is_shared_as_least_squares_tells():
    """On a line the poses are the weighted mean of the measurements, as in closed form."""
    graph = chain([(1.0, 0.0, 0.0)] * 2)
    for i in range(2):
        graph.add_edge(Edge(i, i + 1, np.array([1.0, 0.0, 0.0]), 100.0 * I3))
    graph.add_edge(Edge(0, 2, np.array([2.3, 0.0, 0.0]), 50.0 * I3))
    graph.optimize()
    # Springs 100, 100 in a row are 50; against 50 they meet in the middle of 2.0 and 2.3.
    assert graph.poses[2] == pytest.approx([2.15, 0.0, 0.0], abs=1e-6)
    assert graph.poses[1] == pytest.approx([1.075, 0.0, 0.0], abs=1e-6)


def test_square_is_closed():
    """A way around a square whose turns were measured wrong ends where it began."""
    true_step, told_step = np.array([1.0, 0.0, np.pi / 2]), np.array([1.03, 0.0, np.pi / 2 + 0.05])
    graph = chain([told_step] * 4)
    for i in range(4):
        graph.add_edge(Edge(i, i + 1, told_step, np.diag([400.0, 400.0, 400.0])))
    graph.add_edge(Edge(0, 4, np.zeros(3), 1e4 * I3, is_loop=True))
    graph.optimize()
    assert graph.poses[4] == pytest.approx([0.0, 0.0, 0.0], abs=0.01)
    corner = compose(true_step, true_step)
    assert np.hypot(*(graph.poses[2] - corner)[:2]) < 0.05


def test_wrong_loop_hardly_moves_a_graph_that_agrees():
    """Cauchy weights keep one false loop from bending what many edges tell."""
    step = np.array([0.5, 0.0, 0.0])
    graph = chain([step] * 40)
    for i in range(40):
        graph.add_edge(Edge(i, i + 1, step, np.diag([1e4, 1e4, 1e4])))
    for i in range(0, 30, 5):
        graph.add_edge(Edge(i, i + 10, 10 * step, np.diag([1e4, 1e4, 1e4]), is_loop=True))
    before = graph.optimize()
    graph.add_edge(Edge(0, 40, np.array([3.0, 2.0, 1.0]), np.diag([100.0, 100.0, 100.0]), True))
    graph.optimize()
    assert np.abs(graph.poses - before)[:, :2].max() < 0.3


def test_jacobians_are_those_of_the_errors():
    """The derivatives match differences of the errors."""
    from slam_toolbox_py.pose_graph import _Problem

    rng = np.random.default_rng(1)
    poses = rng.normal(size=(2, 3))
    problem = _Problem([Edge(0, 1, rng.normal(size=3), I3)], 2)
    exact = problem._jacobians(poses)
    for node in range(2):
        for axis in range(3):
            low, high = poses.copy(), poses.copy()
            low[node, axis] -= 1e-6
            high[node, axis] += 1e-6
            slope = (problem._whitened(high) - problem._whitened(low))[0] / 2e-6
            assert exact[node][0, :, axis] == pytest.approx(slope, abs=1e-5)


def test_nodes_that_come_while_it_is_optimized_keep_their_place():
    """What was added meanwhile moves with the last node that was optimized."""
    graph = chain([(1.0, 0.0, 0.0)] * 3)
    for i in range(3):
        graph.add_edge(Edge(i, i + 1, np.array([1.0, 0.0, 0.3]), I3))
    steps = graph.optimizing()
    next(steps)
    graph.add_node(np.array([4.0, 0.0, 0.0]))
    for _ in steps:
        pass
    assert len(graph.poses) == 5
    assert relative(graph.poses[3], graph.poses[4]) == pytest.approx([1.0, 0.0, 0.0])


def test_edges_lead_to_nodes():
    """An edge to a node that is not there is refused."""
    with pytest.raises(ValueError, match='does not exist'):
        PoseGraph().add_edge(Edge(0, 1, np.zeros(3), I3))


def test_inverse_undoes_a_pose():
    """A pose and its inverse make none."""
    pose = np.array([1.0, -2.0, 2.5])
    assert compose(pose, inverse(pose)) == pytest.approx([0.0, 0.0, 0.0])
