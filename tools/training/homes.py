# SPDX-License-Identifier: Apache-2.0
"""Random homes, in the format of the scene files of humanoid_simulation."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
import math
from typing import Any

from home_colours import band, surface_colour, thing_colour, TRAINING
from humanoid_common.tables import SourceLocation, Table
from humanoid_simulation.scene import Scene, scene_of
from humanoid_simulation.scene.furniture import KINDS
from humanoid_simulation.scene.objects import CLASSES as GRASPABLE
import numpy as np
from pictures import CLASSES

_LOW = ('table', 'counter', 'cabinet', 'shelf', 'bed', 'bin')
"""Kinds that carry things where a camera of a humanoid's head sees them."""
_AT_WALLS = (
    'counter', 'counter', 'cabinet', 'cabinet', 'shelf', 'shelf', 'table', 'bed', 'sofa',
    'bookcase', 'wardrobe', 'fridge', 'bin', 'lamp', 'plant',
)  # fmt: skip
_AMID = ('table', 'table', 'chair', 'chair', 'sofa', 'plant', 'lamp', 'bin', 'person', 'person')
_WITH_PERSON = 0.6
_PATTERNS = ('plain', 'tiles', 'planks', 'stripes', 'carpet')

Yaml = dict[str, Any]


@dataclass(frozen=True)
class Footprint:
    """The rectangle of ground that a piece of furniture takes, and how high it is."""

    x_m: float
    y_m: float
    half_x_m: float
    half_y_m: float
    height_m: float

    def is_near(self, x_m: float, y_m: float, margin_m: float) -> bool:
        """
        Whether a point of the ground is in the rectangle or within a margin of it.

        Parameters
        ----------
        x_m, y_m
            The point.
        margin_m
            By how much the rectangle is extended on each side.

        """
        return (
            abs(x_m - self.x_m) < self.half_x_m + margin_m
            and abs(y_m - self.y_m) < self.half_y_m + margin_m
        )


@dataclass(frozen=True)
class Home:
    """A scene, and what a photographer must know of it."""

    scene: Scene
    footprints: tuple[Footprint, ...]

    def bounds_m(self, x_m: float, y_m: float) -> tuple[float, float, float, float]:
        """
        Compute the bounding box of the room at a point; outside of all, that of the first room.

        Parameters
        ----------
        x_m, y_m
            The point.

        Returns
        -------
        float, float, float, float
            Least and greatest x, least and greatest y, in m.

        """
        room = self.scene.room_at(x_m, y_m) or self.scene.rooms[0]
        xs, ys = zip(*room.outline_m)
        return min(xs), max(xs), min(ys), max(ys)


def random_home(generator: np.random.Generator, split: str = TRAINING, things: int = 20) -> Home:
    """
    Make a room with furniture, things and perhaps people.

    Parameters
    ----------
    generator
        All randomness.
    split
        `training` or `held_out`.
    things
        How many graspable things the home has.

    """
    return _Builder(generator, split).home(things)


def home_of(scene: Scene) -> Home:
    """
    Make a home of a scene as it is; its footprints are those of the furniture.

    Parameters
    ----------
    scene
        The scene.

    """
    footprints = []
    for thing in scene.things:
        if thing.kind not in KINDS:
            continue
        half_x_m, half_y_m = _half_extent(thing.size_m, thing.orientation_rpy_rad[2])
        x_m, y_m, _ = thing.position_m
        footprints.append(Footprint(x_m, y_m, half_x_m, half_y_m, thing.size_m[2]))
    return Home(scene, tuple(footprints))


def _half_extent(size_m: Sequence[float], yaw_rad: float) -> tuple[float, float]:
    """Return how far a turned rectangle reaches along x and along y."""
    across, along = abs(math.cos(yaw_rad)), abs(math.sin(yaw_rad))
    return (
        (size_m[0] * across + size_m[1] * along) / 2,
        (size_m[0] * along + size_m[1] * across) / 2,
    )


@dataclass
class _Builder:
    """A home that is being furnished."""

    generator: np.random.Generator
    split: str
    footprints: list[Footprint] = field(default_factory=list)
    furniture: list[Yaml] = field(default_factory=list)
    surfaces: list[tuple[str, float, float]] = field(default_factory=list)
    """Names and inner lengths and widths of what things can stand on."""

    def home(self, things: int) -> Home:
        """Return the home."""
        length_m, width_m = (float(edge) for edge in self.generator.uniform(2.6, 6.0, 2))
        ceiling_m = float(self.generator.uniform(2.3, 2.8))
        walls = self._walls(length_m, width_m, ceiling_m)
        for _ in range(3):
            self._furnish_wall(str(self.generator.choice(_LOW)), length_m, width_m)
        for _ in range(int(self.generator.integers(1, 7))):
            self._furnish_wall(str(self.generator.choice(_AT_WALLS)), length_m, width_m)
        if self.generator.random() < _WITH_PERSON:
            self._furnish_middle('person', length_m, width_m)
        for _ in range(int(self.generator.integers(0, 6))):
            self._furnish_middle(str(self.generator.choice(_AMID)), length_m, width_m)
        self._decorate(length_m, width_m, ceiling_m)
        content = {
            'rooms': list(self._rooms(length_m, width_m, ceiling_m)),
            'walls': walls,
            'furniture': self.furniture,
            'objects': [self._thing(number) for number in range(things)],
        }
        scene = scene_of(Table(content, SourceLocation('a random home')), 'home')
        return Home(scene, tuple(self.footprints))

    def _rooms(self, length_m: float, width_m: float, ceiling_m: float) -> Iterator[Yaml]:
        """Yield the room, and the one behind its door in the east."""
        x_m, y_m = length_m / 2, width_m / 2
        ceiling = {'ceiling': ceiling_m} if self.generator.random() < 0.85 else {}
        yield {
            'name': 'room',
            'outline': [[-x_m, -y_m], [x_m, -y_m], [x_m, y_m], [-x_m, y_m]],
            'floor': self._finish(),
            'walls': self._finish(),
            **ceiling,
        }
        yield {
            'name': 'next_room',
            'outline': [[x_m, -y_m], [x_m + 3, -y_m], [x_m + 3, y_m], [x_m, y_m]],
            'floor': self._finish(),
            'walls': self._finish(),
            **ceiling,
        }

    def _finish(self) -> Yaml:
        """Return what a floor or a wall looks like."""
        first = surface_colour(self.generator, self.split)
        contrast = self.generator.uniform(0.6, 1.3)
        second = [min(1.0, part * contrast) for part in first]
        if self.generator.random() < 0.2:
            second = list(surface_colour(self.generator, self.split))
        return {
            'pattern': str(self.generator.choice(_PATTERNS)),
            'first': list(first),
            'second': second,
            'tile': 0.1 + 1.2 * band(self.generator, self.split),
        }

    def _walls(self, length_m: float, width_m: float, ceiling_m: float) -> list[Yaml]:
        """Return the walls of both rooms, with a door between them."""
        x_m, y_m = length_m / 2, width_m / 2
        corners = {
            'west': ([-x_m, -y_m], [-x_m, y_m]),
            'north': ([-x_m, y_m], [x_m + 3, y_m]),
            'south': ([-x_m, -y_m], [x_m + 3, -y_m]),
            'east': ([x_m, -y_m], [x_m, y_m]),
            'far_east': ([x_m + 3, -y_m], [x_m + 3, y_m]),
        }
        walls = [
            {'name': f'wall_{name}', 'from': start, 'to': end, 'height': ceiling_m}
            for name, (start, end) in corners.items()
        ]
        if self.generator.random() < 0.7:
            at_m = float(self.generator.uniform(0.7, width_m - 0.7))
            walls[3]['doors'] = [{'at': at_m, 'width': 1.0}]
        return walls

    def _furnish_wall(self, kind: str, length_m: float, width_m: float) -> None:
        """Put a piece with its back to a wall, if there is room."""
        depth_m, across_m, height_m = self._size(kind)
        side = int(self.generator.integers(4))
        yaw_deg = (0, 90, 180, 270)[side]
        run_m, away_m = (width_m, length_m) if side % 2 == 0 else (length_m, width_m)
        if across_m > run_m - 0.2 or depth_m > away_m - 1.2:
            return
        along_m = float(self.generator.uniform(-1, 1) * (run_m - across_m) / 2)
        back_m = away_m / 2 - 0.06 - depth_m / 2
        x_m, y_m = ((-back_m, along_m), (along_m, -back_m), (back_m, along_m), (along_m, back_m))[
            side
        ]
        self._place(kind, (x_m, y_m), yaw_deg, (depth_m, across_m, height_m))

    def _furnish_middle(self, kind: str, length_m: float, width_m: float) -> None:
        """Put a piece anywhere, in any direction, if there is room."""
        at_m = self.generator.uniform(-0.5, 0.5, 2) * (length_m - 0.8, width_m - 0.8)
        yaw_deg = float(self.generator.uniform(0, 360))
        self._place(kind, (float(at_m[0]), float(at_m[1])), yaw_deg, self._size(kind))

    def _size(self, kind: str) -> tuple[float, float, float]:
        """Return the size of a piece of a kind, up to 25 % from the usual one."""
        length, width, height = KINDS[kind].size_m
        spread = self.generator.uniform(0.8, 1.25, 3)
        if kind == 'person':
            spread = self.generator.uniform(0.92, 1.08, 3)
        elif kind == 'lamp' and self.generator.random() < 0.3:
            return 0.2, 0.2, 0.4
        elif kind == 'table':
            height = float(self.generator.choice([height, 0.45]))
        return length * spread[0], width * spread[1], height * spread[2]

    def _place(
        self,
        kind: str,
        at_m: tuple[float, float],
        yaw_deg: float,
        size_m: tuple[float, float, float],
    ) -> None:
        """Add a piece unless another one is in its way."""
        half_x_m, half_y_m = _half_extent(size_m, math.radians(yaw_deg))
        for other in self.footprints:
            if (
                abs(at_m[0] - other.x_m) < half_x_m + other.half_x_m
                and abs(at_m[1] - other.y_m) < half_y_m + other.half_y_m
            ):
                return
        name = f'{kind}_{len(self.furniture)}'
        piece: Yaml = {
            'name': name,
            'kind': kind,
            'at': list(at_m),
            'facing_deg': yaw_deg,
            'size': list(size_m),
        }
        if kind not in ('lamp', 'fridge') or self.generator.random() < 0.5:
            vivid = 0.7 if kind in ('person', 'sofa') else 0.25
            piece['colour'] = list(surface_colour(self.generator, self.split, vivid))
        self.furniture.append(piece)
        self.footprints.append(Footprint(*at_m, half_x_m, half_y_m, size_m[2]))
        margin_m = KINDS[kind].margin_m + 0.02
        inner = size_m[0] - 2 * margin_m, size_m[1] - 2 * margin_m
        if kind in _LOW and min(inner) > 0.05:
            self.surfaces.append((name, *inner))
            if kind == 'shelf':
                self.surfaces.append((f'{name}/1', *inner))
            self._stand_on(name, kind, inner)

    def _stand_on(self, name: str, kind: str, inner: tuple[float, float]) -> None:
        """Perhaps put a television, a lamp, a sink or a hob on a piece."""
        what = {'cabinet': ('television', 'lamp'), 'counter': ('sink', 'hob')}.get(kind, ())
        if not what or self.generator.random() < 0.5:
            return
        chosen = str(self.generator.choice(what))
        size_m = [0.2, 0.2, 0.4] if chosen == 'lamp' else list(KINDS[chosen].size_m)
        size_m[1] = min(size_m[1], inner[1])
        size_m[0] = min(size_m[0], inner[0])
        last = self.furniture[-1]
        self.furniture.append(
            {
                'name': f'{chosen}_{len(self.furniture)}',
                'kind': chosen,
                'at': last['at'],
                'facing_deg': last['facing_deg'],
                'size': size_m,
                'stands_on': name,
            }
        )

    def _decorate(self, length_m: float, width_m: float, ceiling_m: float) -> None:
        """Hang pictures, windows and lamps, and lay a rug."""
        for number in range(int(self.generator.integers(0, 5))):
            kind = str(self.generator.choice(['picture', 'picture', 'window']))
            side = int(self.generator.integers(4))
            run_m, away_m = (width_m, length_m) if side % 2 == 0 else (length_m, width_m)
            back_m = away_m / 2 - 0.07
            along_m = float(self.generator.uniform(-0.5, 0.5) * (run_m - 0.8))
            at = ([-back_m, along_m], [along_m, -back_m], [back_m, along_m], [along_m, back_m])
            self.furniture.append(
                {
                    'name': f'hung_{number}',
                    'kind': kind,
                    'at': at[side],
                    'facing_deg': 90 * side,
                    'height': float(self.generator.uniform(1.1, 1.7)),
                    'colour': list(surface_colour(self.generator, self.split, 0.6)),
                    'size': [0.03, *(float(edge) for edge in self.generator.uniform(0.3, 1, 2))],
                }
            )
        if self.generator.random() < 0.5:
            self.furniture.append(
                {'name': 'light', 'kind': 'ceiling_lamp', 'at': [0.0, 0.0], 'height': ceiling_m}
            )
        if self.generator.random() < 0.4:
            size_m = [*(0.6 * edge for edge in (length_m, width_m)), 0.004]
            colour = list(surface_colour(self.generator, self.split, 0.5))
            self.furniture.append(
                {'name': 'rug', 'kind': 'rug', 'at': [0.0, 0.0], 'size': size_m, 'colour': colour}
            )

    def _thing(self, number: int) -> Yaml:
        """Return a graspable thing; a photographer puts it where it is seen."""
        kind = CLASSES[number % len(GRASPABLE)]
        spread = self.generator.uniform(0.85, 1.2) * self.generator.uniform(0.93, 1.07, 3)
        if kind in ('ball', 'apple', 'orange', 'cube'):
            spread[:] = spread[0]
        elif kind in ('mug', 'bottle', 'can', 'bowl'):
            spread[1] = spread[0]
        elif kind == 'box':
            spread = self.generator.uniform(0.7, 1.6, 3)
        size_m = [float(a * b) for a, b in zip(GRASPABLE[kind].size_m, spread)]
        return {
            'name': f'{kind}_thing_{number}',
            'class': kind,
            'colour': list(thing_colour(kind, self.generator)[1]),
            'at': [0.0, 0.0],
            'size': size_m,
        }
