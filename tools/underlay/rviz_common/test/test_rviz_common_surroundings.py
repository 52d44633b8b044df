# SPDX-License-Identifier: Apache-2.0
"""The background, the ground and the sky."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from rviz_common.page import Page
from rviz_common.visualizer import Visualizer
from rviz_common.visualizer.surroundings import (
    CONTACTS,
    DARK,
    EVEN_LIGHT,
    GROUND,
    LIGHT,
    Palette,
    SHADOWS,
    SKY,
    surface_of,
    Surroundings,
)

WHITE = np.full((3, 4), 255, np.uint8)


class SceneOfOne:
    """The scene of one browser, as far as it is used."""

    def __init__(self) -> None:
        self.nodes: dict[str, Any] = {}
        self.has_shadows = False
        self.places: list[str | None] = []

    def add_glb(self, name: str, data: bytes, **look: Any) -> None:
        self.nodes[name] = look

    def add_light_hemisphere(self, name: str, **look: Any) -> None:
        self.nodes[name] = look

    def get_handle_by_name(self, name: str) -> Any:
        return self.nodes.get(name)

    def remove_by_name(self, name: str) -> None:
        del self.nodes[name]

    def configure_default_lights(self, cast_shadow: bool) -> None:
        self.has_shadows = cast_shadow

    def configure_environment_map(self, place: str | None) -> None:
        self.places.append(place)


def surroundings(page: Page, has_ground: bool) -> Surroundings:
    """Return what is around, drawn already."""
    around = Surroundings(page.viser.scene)
    around.choose((1, 2, 3), has_ground)
    assert around.update() and not around.update()
    return around


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


@pytest.mark.parametrize(
    ('palette', 'has_shadows', 'own'),
    [
        (DARK, False, []),
        (LIGHT, False, [GROUND, SKY]),
        (DARK, True, [SHADOWS]),
        (LIGHT, True, [GROUND, SKY, SHADOWS]),
    ],
)
def test_one_browser_has_other_colors_and_shadows(
    page: Page, palette: Palette, has_shadows: bool, own: list[str]
) -> None:
    """It has nodes of its own only if they differ from those of all."""
    around, scene = surroundings(page, has_ground=True), SceneOfOne()
    for _ in range(2):
        around.adapt(scene, palette, has_shadows, has_reflections=True)
    around.remove()
    assert list(scene.nodes) == own
    assert scene.has_shadows is has_shadows
    assert scene.places == []


def test_without_a_ground_there_are_no_shadows(page: Page) -> None:
    """They cost time, and there would be nothing to see them on."""
    around, scene = surroundings(page, has_ground=False), SceneOfOne()
    around.adapt(scene, LIGHT, has_shadows=True, has_reflections=True)
    assert scene.nodes == {} and not scene.has_shadows


def test_one_browser_has_a_light_that_takes_less_time(page: Page) -> None:
    """It is not sent again as long as it stays, and goes when it is not wanted any more."""
    around, scene = surroundings(page, has_ground=False), SceneOfOne()
    for _ in range(2):
        around.adapt(scene, DARK, has_shadows=False, has_reflections=False)
    assert scene.places == [None] and list(scene.nodes) == [EVEN_LIGHT]
    for _ in range(2):
        around.adapt(scene, DARK, has_shadows=False, has_reflections=True)
    assert scene.places == [None, 'city'] and scene.nodes == {}
