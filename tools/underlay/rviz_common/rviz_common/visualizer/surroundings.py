# SPDX-License-Identifier: Apache-2.0
"""What is around the displays: the background color, or the ground below a sky."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Final, TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from rviz_common.frames import WORLD
from rviz_common.glb import glb_of

if TYPE_CHECKING:
    from viser import SceneApi

__all__ = ['CONTACTS', 'DARK', 'LIGHT', 'Palette', 'Surroundings', 'surface_of']

SKY = '/sky'
GROUND = f'{WORLD}/plain'
CONTACTS = f'{WORLD}/contacts'
"""The node below which displays draw the shadows of robots on the ground."""

Rgb = tuple[int, int, int]

SKY_M, PLAIN_M = 150.0, 140.0
BELOW_M = -0.05
"""The height of the ground, below maps, which are slightly below z = 0 themselves."""
SHADOWS = f'{WORLD}/shadows'
SHADOWS_M, SHADOWED_M = -0.003, 30.0
"""The height and the radius of the shadows that are cast: above maps, and below all else."""
EVEN_LIGHT = '/even_light'
FROM_BELOW, BRIGHTNESS = (150, 150, 150), 1.6
OF_VISER: Final = 'city'
"""The place whose light viser shows first."""
SHADOW = 0.35
"""The opacity of shadows that are cast."""
SEGMENTS = 32
ELEVATIONS_DEG = (-90.0, -2.0, 0.0, 4.0, 10.0, 20.0, 40.0, 90.0)
BLUENESS = (0.0, 0.0, 0.0, 0.25, 0.5, 0.75, 0.95, 1.0)
RADII_M = (0.0, 8.0, 20.0, 40.0, 80.0, PLAIN_M)
HAZE = (0.0, 0.0, 0.25, 0.6, 0.9, 1.0)


@dataclass(frozen=True)
class Palette:
    """The colors of the ground, of the sky at the zenith, and of the haze between them."""

    ground: Rgb
    haze: Rgb
    zenith: Rgb


DARK = Palette(ground=(78, 82, 86), haze=(56, 64, 76), zenith=(14, 20, 32))
LIGHT = Palette(ground=(205, 203, 196), haze=(222, 231, 238), zenith=(104, 160, 214))


class Surroundings:
    """
    The background color; and, if wanted, a plain at z = 0 of the fixed frame, and a sky above it.

    The background is an image, for which viser loads a library of 15 MB: all of this waits until
    a page is open.

    Parameters
    ----------
    scene
        The scene of the server of the page.

    """

    def __init__(self, scene: SceneApi) -> None:
        self._scene = scene
        self._wanted: tuple[Rgb, bool] | None = None
        self._drawn: tuple[Rgb, bool] | None = None

    @property
    def has_ground(self) -> bool:
        """Whether the ground and the sky are drawn."""
        return self._drawn is not None and self._drawn[1]

    def choose(self, color: Rgb, has_ground: bool) -> None:
        """
        Set what the next `update` draws.

        Parameters
        ----------
        color
            The color of the background: red, green and blue, each from 0 to 255.
        has_ground
            Whether to draw the ground and the sky, which hide the background.

        """
        self._wanted = color, has_ground

    def update(self) -> bool:
        """Draw what is chosen, in dark colors; return False if it is already drawn."""
        if self._wanted is None or self._wanted == self._drawn:
            return False
        color, has_ground = self._wanted
        before = self._drawn
        self._drawn = self._wanted
        if before is None or before[0] != color:
            picture = np.full((1, 1, 3), color, np.uint8)
            self._scene.set_background_image(picture, format='png')
        _remove_ground(self._scene)
        self._scene.add_frame(CONTACTS, show_axes=False, visible=has_ground)
        if has_ground:
            _draw_ground(self._scene, DARK)
        return True

    def remove(self) -> None:
        """Remove the ground and the sky; the next `update` draws everything again."""
        _remove_ground(self._scene)
        self._drawn = None

    def adapt(
        self, scene: SceneApi, palette: Palette, has_shadows: bool, has_reflections: bool
    ) -> None:
        """
        Draw the ground, the sky and the light differently for one browser.

        Parameters
        ----------
        scene
            The scene of the browser.
        palette
            The colors; `DARK` are those of all browsers without others.
        has_shadows
            Whether all that is above the ground casts a shadow on it, if the ground is drawn.
        has_reflections
            Whether the light comes from a picture of a place, instead of evenly from above and
            below, which takes less time.

        """
        has_shadows = has_shadows and self.has_ground
        scene.configure_default_lights(cast_shadow=has_shadows)
        _remove_ground(scene)
        _reflect(scene, has_reflections)
        if self.has_ground and palette != DARK:
            _draw_ground(scene, palette)
        if has_shadows:
            at = (0.0, 0.0, SHADOWS_M)
            scene.add_glb(
                SHADOWS, _unseen(), position=at, cast_shadow=False, receive_shadow=SHADOW
            )


def _remove_ground(scene: SceneApi) -> None:
    for name in (GROUND, SHADOWS, SKY):
        if scene.get_handle_by_name(name) is not None:
            scene.remove_by_name(name)


def _reflect(scene: SceneApi, has_reflections: bool) -> None:
    """Choose the light from all around, unless the scene has it already."""
    if has_reflections is (scene.get_handle_by_name(EVEN_LIGHT) is None):
        return
    if has_reflections:
        scene.remove_by_name(EVEN_LIGHT)
        scene.configure_environment_map(OF_VISER)
    else:
        scene.add_light_hemisphere(EVEN_LIGHT, ground_color=FROM_BELOW, intensity=BRIGHTNESS)
        scene.configure_environment_map(None)


def _draw_ground(scene: SceneApi, palette: Palette) -> None:
    """Draw the ground and the sky."""
    ground, sky = _files(palette)
    place = (0.0, 0.0, BELOW_M)
    scene.add_glb(GROUND, ground, position=place, cast_shadow=False, receive_shadow=False)
    scene.add_glb(SKY, sky, cast_shadow=False, receive_shadow=False)


@lru_cache(maxsize=4)
def _files(palette: Palette) -> tuple[bytes, bytes]:
    """Return the ground and the sky as GLB files."""
    plain = [(radius, 0.0) for radius in RADII_M]
    angles = np.radians(ELEVATIONS_DEG)
    dome = list(zip(SKY_M * np.cos(angles), SKY_M * np.sin(angles)))
    ground = _mixed(palette.ground, palette.haze, HAZE)
    sky = _mixed(palette.haze, palette.zenith, BLUENESS)
    return (
        glb_of(*surface_of(plain, ground), is_lit=False),
        glb_of(*surface_of(dome, sky), is_lit=False),
    )


@lru_cache(maxsize=1)
def _unseen() -> bytes:
    """Return a disc of which only the shadows are seen that fall on it, as a GLB file."""
    nothing = np.zeros((2, 4), np.uint8)
    return glb_of(*surface_of([(0.0, 0.0), (SHADOWED_M, 0.0)], nothing), is_lit=False)


def _mixed(first: Rgb, second: Rgb, shares: Sequence[float]) -> NDArray[np.uint8]:
    """Blend two colors by some shares of the second; opaque."""
    share = np.array(shares)[:, None]
    mixed = (1.0 - share) * np.array([*first, 255]) + share * np.array([*second, 255])
    return np.asarray(mixed.round(), dtype=np.uint8)


def surface_of(
    profile: Sequence[tuple[float, float]], colors: NDArray[np.uint8], segments: int = SEGMENTS
) -> tuple[NDArray[np.float32], NDArray[np.uint8]]:
    """
    Compute a surface of revolution about the z axis, with a color for each ring.

    Parameters
    ----------
    profile
        The radius and the height of each of N rings. Triangles are seen from the left of the way
        from the first ring to the last one: from above if radii increase, from inside if heights
        do.
    colors
        Red, green, blue and alpha of each ring (N, 4).
    segments
        The number of segments of a ring.

    Returns
    -------
    tuple[NDArray[np.float32], NDArray[np.uint8]]
        The vertices (M, 3), in m, each three of which form a triangle, and their colors (M, 4).

    """
    radii, heights = np.array(profile, np.float32).T
    angles = np.linspace(0.0, 2.0 * np.pi, segments + 1)
    points = np.empty((len(profile), segments + 1, 3), np.float32)
    points[..., 0] = radii[:, None] * np.cos(angles)
    points[..., 1] = radii[:, None] * np.sin(angles)
    points[..., 2] = heights[:, None]
    paints = np.broadcast_to(colors[:, None], (len(profile), segments + 1, 4))
    return _triangles(points), _triangles(paints)


def _triangles(corners: NDArray[Any]) -> NDArray[Any]:
    """Return the values at the corners of the triangles between neighboring rings."""
    a, b = corners[:-1, :-1], corners[1:, :-1]
    c, d = corners[1:, 1:], corners[:-1, 1:]
    return np.stack([a, b, c, a, c, d], axis=2).reshape(-1, corners.shape[-1])
