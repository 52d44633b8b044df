# SPDX-License-Identifier: Apache-2.0
"""Put the things of a home where a picture is to show them: on furniture and on the floor."""

from __future__ import annotations

from collections.abc import Sequence
import math

from homes import Home
from humanoid_simulation.scene import Thing
from humanoid_simulation.scene.scene import Surface
import mujoco
import numpy as np
from numpy.typing import NDArray

_AWAY_M = -20.0
"""The height of things that are not in the home now."""
_GAP_M = 0.001
_LYING = ('bottle', 'can', 'mug')
_UPRIGHT = (1.0, 0.0, 0.0, 0.0)
_ON_ITS_SIDE = (math.sqrt(0.5), math.sqrt(0.5), 0.0, 0.0)
_CARRIERS = ('box', 'book')

Array = NDArray[np.float64]


class Arranger:
    """
    Arranges the things of a home anew for each picture.

    Parameters
    ----------
    model, data
        The home in MuJoCo; joint positions of the things are set in the data.
    home
        The home.
    generator
        All randomness.

    """

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        home: Home,
        generator: np.random.Generator,
    ) -> None:
        self._model, self._data = model, data
        self._home, self._generator = home, generator

    def arrange(self) -> Array:
        """Put some things on surfaces and on the floor; return the point to look at."""
        generator, surfaces = self._generator, self._home.scene.surfaces
        things = list(self._home.scene.objects)
        generator.shuffle(things)
        is_on_floor = not surfaces or generator.random() < 0.22
        stage = None if is_on_floor else surfaces[int(generator.integers(len(surfaces)))]
        spot = self._point_on(stage)
        count = int(generator.integers(0, 9))
        taken: list[tuple[float, float, float]] = []
        last: tuple[Thing, Array] | None = None
        for number, thing in enumerate(things):
            place: Surface | None = stage
            near: Array | None = spot
            if number >= count:
                near = None
                is_away = generator.random() < 0.35
                others = [*surfaces, None] if surfaces else [None]
                place = others[int(generator.integers(len(others)))]
                if is_away:
                    self._put(thing, np.array([0.0, 0.0, _AWAY_M]), _UPRIGHT)
                    continue
            if last is not None and generator.random() < 0.1:
                below, at_m = last
                top_m = at_m + (0.0, 0.0, below.size_m[2] / 2 + thing.size_m[2] / 2)
                self._put(thing, top_m, _UPRIGHT)
                last = None
                continue
            point_m = self._free_point(thing, place, near, taken)
            if point_m is None:
                self._put(thing, np.array([0.0, 0.0, _AWAY_M]), _UPRIGHT)
                continue
            at_m = point_m
            taken.append((float(at_m[0]), float(at_m[1]), self._radius_m(thing)))
            is_lying = thing.kind in _LYING and generator.random() < 0.07
            height_m = thing.size_m[1] if is_lying else thing.size_m[2]
            centre_m = at_m + (0.0, 0.0, height_m / 2 + _GAP_M)
            self._put(thing, centre_m, _ON_ITS_SIDE if is_lying else _UPRIGHT)
            last = (thing, centre_m) if thing.kind in _CARRIERS else None
        return spot

    def _point_on(self, surface: Surface | None) -> Array:
        """Return a random point on a surface, or on the floor."""
        if surface is None:
            x1, x2, y1, y2 = self._home.bounds_m(0.0, 0.0)
            across = self._generator.uniform(0.05, 0.95, 2)
            return np.array([x1 + across[0] * (x2 - x1), y1 + across[1] * (y2 - y1), 0.003])
        a, b, _, d = (np.array(corner) for corner in surface.outline_m)
        across = self._generator.uniform(0.05, 0.95, 2)
        return np.array([*(a + across[0] * (b - a) + across[1] * (d - a)), surface.height_m])

    def _free_point(
        self,
        thing: Thing,
        surface: Surface | None,
        near: Array | None,
        taken: Sequence[tuple[float, float, float]],
    ) -> Array | None:
        """Return a point for a thing, touching no other one; None if none was found."""
        radius_m = self._radius_m(thing)
        for _ in range(8):
            at_m = self._point_on(surface)
            if near is not None:
                at_m[:2] = near[:2] + self._generator.normal(0, 0.22, 2)
                if surface is not None and not surface.contains(at_m[0], at_m[1]):
                    continue
            in_way = surface is None and any(
                each.is_near(at_m[0], at_m[1], radius_m) for each in self._home.footprints
            )
            is_free = all(
                math.dist(at_m[:2], (x, y)) > radius_m + other_m for x, y, other_m in taken
            )
            if is_free and not in_way:
                return at_m
        return None

    def _radius_m(self, thing: Thing) -> float:
        """Return how far from its middle a thing reaches, about, seen from above."""
        return 0.45 * math.hypot(*thing.size_m[:2])

    def _put(self, thing: Thing, at_m: Array, turn: tuple[float, ...]) -> None:
        """Put the middle of a thing to a point, turned about the vertical at random."""
        yaw = self._generator.uniform(-math.pi, math.pi)
        quaternion = np.empty(4)
        about_z = np.array([math.cos(yaw / 2), 0.0, 0.0, math.sin(yaw / 2)])
        mujoco.mju_mulQuat(quaternion, about_z, np.array(turn))
        first = self._model.joint(thing.name).qposadr[0]
        self._data.qpos[first : first + 7] = [*at_m, *quaternion]
