# SPDX-License-Identifier: Apache-2.0
"""Cut walls at a height, for a view into the rooms."""

from __future__ import annotations

from dataclasses import replace
import math

from humanoid_simulation.scene.furniture import HANGING
from humanoid_simulation.scene.parts import Part
from humanoid_simulation.scene.scene import Thing, WALL
from humanoid_simulation.scene.walls import CEILING


def parts_below(thing: Thing, height_m: float) -> tuple[Part, ...]:
    """
    Select the visible parts of an object for a view in which walls are cut at a height.

    Walls are cut. Ceilings, and objects that hang on walls or from ceilings, are left out if they
    are above that height; all other objects are unchanged.

    Parameters
    ----------
    thing
        The object.
    height_m
        Height of the cut above the ground.

    Returns
    -------
    tuple of Part
        The visible parts, in the frame of the object.

    """
    shown = tuple(part for part in thing.parts if part.is_shown)
    if thing.kind == WALL:
        cut = (_cut(part, height_m - thing.position_m[2]) for part in shown)
        return tuple(part for part in cut if part is not None)
    if thing.kind in (CEILING, *HANGING):
        top_m = thing.position_m[2] + max(part.position_m[2] for part in shown)
        return shown if top_m <= height_m else ()
    return shown


def _cut(part: Part, height_m: float) -> Part | None:
    """Return the piece of an upright box below a height; None if there is none."""
    # Wallpaper is a board that stands on its edge: see `walls`.
    upright = 1 if math.isclose(part.orientation_rpy_rad[0], math.pi / 2.0) else 2
    size, (x_m, y_m, z_m) = list(part.size_m), part.position_m
    if part.shape != 'box':
        return part if z_m <= height_m else None
    low_m = z_m - size[upright] / 2.0
    top_m = min(z_m + size[upright] / 2.0, height_m)
    if top_m - low_m < 1e-3:
        return None
    size[upright] = top_m - low_m
    return replace(part, size_m=tuple(size), position_m=(x_m, y_m, (low_m + top_m) / 2.0))
