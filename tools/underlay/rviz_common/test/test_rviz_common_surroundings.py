# SPDX-License-Identifier: Apache-2.0
"""The background, the ground and the sky."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from rviz_common.visualizer import Visualizer
from rviz_common.visualizer.surroundings import CONTACTS, GROUND, SKY, surface_of

WHITE = np.full((3, 4), 255, np.uint8)


def normals(profile: list[tuple[float, float]]) -> tuple[Any, Any]:
    """Return the centers of the triangles of a surface, and where they are seen from."""
    vertices, _ = surface_of(profile, WHITE[: len(profile)])
    corners = vertices.reshape(-1, 3, 3)
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    is_real = np.linalg.norm(across, axis=1) > 1e-6
    return corners[is_real].mean(axis=1), across[is_real]


def test_a_plain_is_seen_from_above() -> None:
    """All of it, and it is as wide as its last ring."""
    centers, across = normals([(0.0, 0.0), (1.0, 0.0), (3.0, 0.0)])
    assert (across[:, 2] > 0.0).all()
    assert 2.0 < np.linalg.norm(centers, axis=1).max() < 3.0


def test_a_dome_is_seen_from_inside() -> None:
    """All of it: the one below as well as the one above."""
    centers, across = normals([(0.0, -2.0), (2.0, 0.0), (0.0, 2.0)])
    assert ((centers * across).sum(axis=1) < 0.0).all()


def test_each_ring_has_its_color() -> None:
    """Those of vertices are those of their rings."""
    colors = np.array([[1, 2, 3, 255], [4, 5, 6, 255]], np.uint8)
    vertices, paints = surface_of([(1.0, 0.0), (2.0, 0.0)], colors)
    is_inner = np.linalg.norm(vertices, axis=1) < 1.5
    assert (paints == np.where(is_inner[:, None], colors[0], colors[1])).all()


def test_the_ground_comes_and_goes(show: Callable[..., Visualizer]) -> None:
    """There is none unless the file wants it; shadows are seen only on it."""
    shown = show('Visualization Manager: {Global Options: {Ground and Sky: true}}')
    node_at = shown.context.scene.get_handle_by_name
    shown.frame()
    ground = node_at(GROUND)
    assert ground is not None and node_at(SKY) is not None
    assert node_at(CONTACTS).visible
    shown.frame()
    assert node_at(GROUND) is ground
    shown.set_option('Ground and Sky', False)
    shown.frame()
    assert node_at(GROUND) is None and node_at(SKY) is None
    assert not node_at(CONTACTS).visible


def test_another_file_starts_anew(show: Callable[..., Visualizer]) -> None:
    """What it does not want is removed, though the background is the same."""
    shown = show('Visualization Manager: {Global Options: {Ground and Sky: true}}')
    shown.frame()
    shown.load(type(shown.configuration).default())
    shown.frame()
    assert shown.context.scene.get_handle_by_name(SKY) is None
