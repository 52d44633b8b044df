# SPDX-License-Identifier: Apache-2.0
"""
Loop closure: detect that the robot has returned to a known place, and correct the map.

A loop closure has to pass four tests: the coarse match, the fine match, a deviation from the graph
within the possible drift of odometry, and agreement of the graph with it after optimization.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from slam_toolbox_py.mapper import Mapper
from slam_toolbox_py.matching import correlate, refine
from slam_toolbox_py.pose_graph import carried, Edge
from slam_toolbox_py.poses import FloatArray, relative

__all__ = ['close_loops', 'find_chains']

_CHAINS = 2
_REFERENCES = 10
_WEAK = np.diag([1.0, 1.0, 10.0])
_GATE2 = 16.0
_DISAGREEMENT2 = 30.0
_ALREADY_AGREES2 = 1.0
_REST = 3
_NOTABLE_M = 0.03


def find_chains(mapper: Mapper, node: int) -> list[list[int]]:
    """
    Find keyframes that were taken near another one, but long before it.

    Parameters
    ----------
    mapper
        The keyframes.
    node
        The newer one.

    Returns
    -------
    Chains of consecutive keyframes, the chain with the nearest one first.

    """
    settings = mapper.settings
    gap = max(2 * settings.scan_buffer_size, settings.loop_match_minimum_chain_size)
    count = node - gap + 1
    if count < settings.loop_match_minimum_chain_size:
        return []
    positions = mapper.positions()
    away = np.hypot(*(positions[:count] - positions[node]).T)
    near = np.flatnonzero(away < settings.loop_search_maximum_distance)
    chains = np.split(near, np.flatnonzero(np.diff(near) > 1) + 1) if len(near) else []
    long = [each for each in chains if len(each) >= settings.loop_match_minimum_chain_size]
    long.sort(key=lambda chain: float(away[chain].min()))
    return [[int(i) for i in each] for each in long]


def close_loops(mapper: Mapper, node: int) -> Iterator[str]:
    """
    Search for loops that a keyframe closes, in steps, and correct the graph.

    Parameters
    ----------
    mapper
        The keyframes and the graph, which is changed.
    node
        The keyframe, usually the newest one.

    Yields
    ------
    str
        The message for the log, which is empty after most steps. Each step takes some ten
        milliseconds, and other work may be done in between. The two keyframes after a loop
        closure are not tested.

    """
    if node - mapper.last_loop < _REST:
        return
    for chain in find_chains(mapper, node)[:_CHAINS]:
        edge = _match(mapper, node, chain)
        yield ''
        if edge is None:
            continue
        disagreement = mapper.graph.error_of(edge)
        mapper.graph.add_edge(edge)
        if disagreement < _ALREADY_AGREES2:
            mapper.last_loop = node
            continue
        yield from _corrected(mapper, edge)


def _corrected(mapper: Mapper, edge: Edge) -> Iterator[str]:
    """Optimize the graph with a new edge; undo both if the graph disagrees with the edge."""
    before = mapper.graph.poses.copy()
    for _ in mapper.graph.optimizing():
        yield ''
    if mapper.graph.error_of(edge) > _DISAGREEMENT2:
        mapper.graph.edges.remove(edge)
        mapper.graph.poses = carried(mapper.graph.poses, before)
        mapper.follow_graph()
        return
    mapper.last_loop = edge.second
    shift = mapper.graph.poses[: len(before), :2] - before[:, :2]
    mapper.follow_graph()
    most = float(np.hypot(*shift.T).max())
    yield f'Loop closed; the map moved by up to {most:.2f} m.' if most > _NOTABLE_M else ''


def _match(mapper: Mapper, node: int, chain: list[int]) -> Edge | None:
    """Match a keyframe to a chain; return the edge between them if it is reliable."""
    settings, graph = mapper.settings, mapper.graph
    scan, guess = mapper.keyframes[node].scan, graph.poses[node]
    away = np.hypot(*(graph.poses[chain, :2] - guess[:2]).T)
    nearest = [chain[i] for i in np.argsort(away, kind='stable')[:_REFERENCES]]
    seen = mapper.surfaces(nearest)
    drift = _drift(mapper, node, nearest[0])
    search = settings.loop_search(0.15 + 3.0 * drift[0])
    coarse = correlate(seen.points, scan.points, guess, search)
    if (
        coarse.response < settings.loop_match_minimum_response_coarse
        or coarse.variance_m2 > settings.loop_match_maximum_variance_coarse
    ):
        return None
    fine = refine(seen, scan, coarse.pose, coarse.pose, _WEAK)
    if fine.response < settings.loop_match_minimum_response_fine:
        return None
    change = relative(guess, fine.pose)
    covariance = np.linalg.inv(fine.information) + np.diag(drift**2)
    if change @ np.linalg.solve(covariance, change) > _GATE2:
        return None
    between = relative(graph.poses[nearest[0]], fine.pose)
    return Edge(nearest[0], node, between, fine.information, is_loop=True)


def _drift(mapper: Mapper, node: int, other: int) -> FloatArray:
    """Return the maximum drift between two keyframes: x and y in m, yaw in rad."""
    way = mapper.travelled_m[node] - mapper.travelled_m[other]
    since = mapper.travelled_m[max(mapper.last_loop, 0)]
    loose = min(way, mapper.travelled_m[node] - since + 0.2 * way)
    return np.array([0.05 + 0.02 * loose, 0.05 + 0.02 * loose, 0.03 + 0.006 * loose])
