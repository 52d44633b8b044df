# SPDX-License-Identifier: Apache-2.0
"""Photograph homes as the camera in the head of the robot does, and label what it sees."""

from __future__ import annotations

import copy
from dataclasses import dataclass
import math
from typing import cast

from arranging import Arranger
from home_colours import band, thing_colour
from homes import Home
from humanoid_simulation.camera import CameraView
from humanoid_simulation.camera.gl_painter import GlPainter
from humanoid_simulation.camera.pinhole import pinhole_of
from humanoid_simulation.camera.ray_painter import RayPainter
from humanoid_simulation.model import build_world, in_world, Physics, Placement, RobotDescription
from labels import labels_of, Seen
import mujoco
import numpy as np
from numpy.typing import NDArray
from pictures import CLASSES, GL, Labels

WIDTH_PX, HEIGHT_PX = 320, 240
VIEW = CameraView(in_world('', 'head_camera'), WIDTH_PX, HEIGHT_PX)
_ARM_RANGES = {
    'shoulder': (-1.7, 0.4), 'shoulder_roll': (-0.2, 0.8), 'shoulder_yaw': (-0.8, 0.8),
    'elbow': (-2.0, 0.0),
}  # fmt: skip
_MOST_TRIES = 60
_FACING_PERSON = 0.15
"""The share of pictures that is taken because of a person, if the home has one."""

Color = NDArray[np.uint8]
Array = NDArray[np.float64]


@dataclass(frozen=True)
class Photograph:
    """A picture, and what it shows."""

    color: Color
    labels: Labels
    renderer: int
    """`GL` or `RAYS`."""


class LabelPainter(GlPainter):
    """Draws colours, and which geom each pixel shows."""

    def geoms(self, data: mujoco.MjData, camera: int) -> NDArray[np.int32]:
        """
        Render the geom that each pixel shows.

        Parameters
        ----------
        data
            The state, with bodies and cameras placed (`mj_kinematics`, `mj_camlight`).
        camera
            The id of the camera in the model.

        Returns
        -------
        NDArray
            Ids of geoms (height, width), -1 where there is none.

        """
        self._camera.fixedcamid = camera
        everything = mujoco.mjtCatBit.mjCAT_ALL.value
        mujoco.mjv_updateScene(
            self._model, data, self._option, None, self._camera, everything, self._scene
        )
        pixels = np.empty((HEIGHT_PX, WIDTH_PX, 3), dtype=np.uint8)
        flags = (mujoco.mjtRndFlag.mjRND_SEGMENT, mujoco.mjtRndFlag.mjRND_IDCOLOR)
        for flag in flags:
            self._scene.flags[flag] = 1
        self._render(pixels, None)
        for flag in flags:
            self._scene.flags[flag] = 0
        shown = pixels.astype(np.int32) @ np.array([1, 1 << 8, 1 << 16], dtype=np.int32)
        numbers = np.full(self._scene.ngeom + 1, -1, dtype=np.int32)
        for each in self._scene.geoms[: self._scene.ngeom]:
            if each.objtype == mujoco.mjtObj.mjOBJ_GEOM:
                numbers[each.segid + 1] = each.objid
        return cast('NDArray[np.int32]', numbers[shown])


class Photographer:
    """
    Takes pictures of a home, from somewhere else each time.

    Call `close` before another one is made.

    Parameters
    ----------
    description
        The robot whose camera is used.
    home
        The home.
    split
        `training` or `held_out`: the directions of the light differ.
    generator
        All randomness.
    method
        How OpenGL runs without a window: `egl` or `osmesa`.
    rearranges
        Whether things, their colours and the light are others in each picture, too.

    Raises
    ------
    SimulationError
        OpenGL cannot be used.

    """

    def __init__(
        self,
        description: RobotDescription,
        home: Home,
        split: str,
        generator: np.random.Generator,
        method: str = 'egl',
        rearranges: bool = True,
    ) -> None:
        self._rearranges = rearranges
        self._home, self._split, self._generator = home, split, generator
        self._model = build_world(description, home.scene, (Placement(),), Physics())
        self._data = mujoco.MjData(self._model)
        self._arranger = Arranger(self._model, self._data, home, generator)
        self._painter = LabelPainter(method, self._model, WIDTH_PX, HEIGHT_PX)
        self._camera = self._model.camera(VIEW.camera).id
        self._pinhole = pinhole_of(self._model, VIEW)
        self._owners = np.full(self._model.ngeom + 1, -1, dtype=np.int32)
        for number, thing in enumerate(home.scene.things):
            body = self._model.body(thing.name)
            self._owners[body.geomadr[0] : body.geomadr[0] + body.geomnum[0]] = number
        self._lights = (
            self._model.light_diffuse.copy(),
            self._model.light_dir.copy(),
            self._model.vis.headlight.ambient.copy(),
            self._model.vis.headlight.diffuse.copy(),
        )

    def close(self) -> None:
        """End OpenGL, so that the next home can be photographed."""
        self._painter.close()

    def take(self, renderer: int) -> Photograph:
        """
        Take a picture.

        Parameters
        ----------
        renderer
            What draws its colours: `GL` or `RAYS`.

        """
        if self._rearranges:
            focus_m = self._face(self._arranger.arrange())
            self._colour()
            self._light()
        else:
            objects = self._home.scene.objects
            focus_m = np.array(objects[int(self._generator.integers(len(objects)))].position_m)
        self._stand(focus_m)
        mujoco.mj_kinematics(self._model, self._data)
        mujoco.mj_comPos(self._model, self._data)
        mujoco.mj_camlight(self._model, self._data)
        color = np.empty((HEIGHT_PX, WIDTH_PX, 3), dtype=np.uint8)
        owners = self._owners[self._painter.geoms(self._data, self._camera)]
        if renderer == GL:
            self._painter.draw(self._data, self._camera, color, None)
        else:
            rays = RayPainter(copy.copy(self._model), [VIEW])
            rays.draw(self._data, self._camera, color, None)
        return Photograph(color, labels_of(owners, self._seen(), self._pinhole), renderer)

    def _seen(self) -> dict[int, Seen]:
        """Return the things of the classes of the detector, in the optical frame."""
        flip = np.array([1.0, -1.0, -1.0])  # MuJoCo's cameras look along -z, y up
        turn = self._data.cam_xmat[self._camera].reshape(3, 3) * flip
        seen = {}
        for number, thing in enumerate(self._home.scene.things):
            if thing.kind not in CLASSES:
                continue
            body = self._model.body(thing.name).id
            offset_m = self._data.xpos[body] - self._data.cam_xpos[self._camera]
            rotation = turn.T @ self._data.xmat[body].reshape(3, 3)
            middle_m = turn.T @ offset_m
            seen[number] = Seen(thing, CLASSES.index(thing.kind), middle_m, rotation)
        return seen

    def _face(self, focus_m: Array) -> Array:
        """Return a point on a person in some of the pictures, else the one that is given."""
        persons = [thing for thing in self._home.scene.things if thing.kind == 'person']
        if not persons or self._generator.random() > _FACING_PERSON:
            return focus_m
        person = persons[int(self._generator.integers(len(persons)))]
        return np.array([*person.position_m[:2], self._generator.uniform(0.6, 1.6)])

    def _colour(self) -> None:
        """Paint the things anew."""
        for thing in self._home.scene.objects:
            rgb = thing_colour(thing.kind, self._generator)[1]
            body = self._model.body(thing.name)
            for geom, part in enumerate(thing.parts, body.geomadr[0]):
                if part.colour_rgba == thing.colour_rgba:
                    self._model.geom_rgba[geom, :3] = rgb

    def _light(self) -> None:
        """Set the sun and the headlight; in every third picture as scenes usually have them."""
        generator, head = self._generator, self._model.vis.headlight
        diffuse, direction, ambient, head_diffuse = self._lights
        self._model.light_diffuse[:], self._model.light_dir[:] = diffuse, direction
        head.ambient[:], head.diffuse[:] = ambient, head_diffuse
        if generator.random() < 0.33:
            return
        tint = 1.0 + generator.uniform(-0.12, 0.12) * np.array([1.0, 0.0, -1.0])
        azimuth, elevation = (
            2 * math.pi * band(generator, self._split),
            generator.uniform(0.4, 1.4),
        )
        self._model.light_dir[:] = (
            math.cos(elevation) * math.cos(azimuth),
            math.cos(elevation) * math.sin(azimuth),
            -math.sin(elevation),
        )
        self._model.light_diffuse[:] = tint * generator.uniform(0.1, 0.7)
        head.ambient[:] = tint * generator.uniform(0.25, 0.6)
        head.diffuse[:] = tint * generator.uniform(0.1, 0.45)

    def _stand(self, focus_m: Array) -> None:
        """Pose the robot so that its camera looks about at a point, or somewhere at random."""
        generator, data = self._generator, self._data
        camera_m = self._camera_point(focus_m)
        away_m = focus_m - camera_m
        yaw = math.atan2(away_m[1], away_m[0])
        pitch = math.atan2(-away_m[2], math.hypot(away_m[0], away_m[1]))
        if generator.random() < 0.12:
            yaw, pitch = generator.uniform(-math.pi, math.pi), generator.uniform(-0.3, 0.8)
        else:
            yaw += generator.uniform(-0.5, 0.5)
            pitch += generator.uniform(-0.4, 0.4)
        pitch = float(np.clip(pitch, -0.5, 1.2))
        lean_roll, lean_pitch = generator.normal(0.0, 0.03, 2)
        head_pitch = float(np.clip(pitch - lean_pitch, -0.6, 0.9))
        self._set_joints(head_pitch)
        quaternion = np.empty(4)
        mujoco.mju_euler2Quat(quaternion, np.array([yaw, pitch - head_pitch, lean_roll]), 'zyx')
        first = self._model.joint(in_world('', 'floating_base')).qposadr[0]
        data.qpos[first : first + 7] = [0.0, 0.0, 0.0, *quaternion]
        mujoco.mj_kinematics(self._model, data)
        mujoco.mj_camlight(self._model, data)
        data.qpos[first : first + 3] = camera_m - data.cam_xpos[self._camera]

    def _set_joints(self, head_pitch: float) -> None:
        """Pitch the head; leave the arms down in half of the pictures, else move them."""
        generator = self._generator
        is_reaching = generator.random() < 0.5
        for joint in range(self._model.njnt):
            name = self._model.joint(joint).name
            first = self._model.jnt_qposadr[joint]
            if not name.startswith(in_world('', '')):
                continue
            short = name[len(in_world('', '')) :]
            if short == 'head_pitch':
                self._data.qpos[first] = head_pitch
            for side, sign in (('left_', 1.0), ('right_', -1.0)):
                limits = _ARM_RANGES.get(short[len(side) :]) if short.startswith(side) else None
                if limits is not None:
                    mirrored = sign if short.endswith(('roll', 'yaw')) else 1.0
                    value = generator.uniform(*limits) if is_reaching else 0.0
                    self._data.qpos[first] = mirrored * value

    def _camera_point(self, focus_m: Array) -> Array:
        """Return a point for the camera from which one can look at another point."""
        generator = self._generator
        x1, x2, y1, y2 = self._home.bounds_m(focus_m[0], focus_m[1])
        height_m = generator.uniform(1.0, 1.45)
        point = np.array([0.0, 0.0, height_m])
        for attempt in range(_MOST_TRIES):
            distance_m = 0.25 + 3.2 * generator.beta(1.3, 1.6)
            angle = generator.uniform(-math.pi, math.pi)
            point[0] = focus_m[0] + distance_m * math.cos(angle)
            point[1] = focus_m[1] + distance_m * math.sin(angle)
            if attempt >= _MOST_TRIES // 2:
                point[0], point[1] = generator.uniform(x1, x2), generator.uniform(y1, y2)
            is_inside = x1 + 0.2 < point[0] < x2 - 0.2 and y1 + 0.2 < point[1] < y2 - 0.2
            in_way = any(
                each.is_near(point[0], point[1], 0.08) and each.height_m > 0.3
                for each in self._home.footprints
            )
            if is_inside and not in_way:
                break
        return point
