# SPDX-License-Identifier: Apache-2.0
"""Test places, sizes and colours of the objects of the apartment, as its cameras are drawn."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
import math

from humanoid_perception.colours import colour_name
from humanoid_perception.detection import Box, is_cut
from humanoid_perception.detector_choice import DetectorParameters, make_detector
from humanoid_perception.lifting import camera_of, lift, surface_of
from humanoid_simulation.camera import CameraView
from humanoid_simulation.camera.gl_painter import GlPainter
from humanoid_simulation.camera.images import see_all, SEEN_GROUPS
from humanoid_simulation.camera.pinhole import pinhole_of
from humanoid_simulation.camera.ray_painter import RayPainter
from humanoid_simulation.model import build_world, humanoid, in_world, Physics, Placement
from humanoid_simulation.scene import load_scene
import mujoco
import numpy as np
import pytest

VIEW = CameraView(in_world('', 'head_camera'), 320, 240)
FLIP = np.diag([1.0, -1.0, -1.0])
"""From MuJoCo's cameras, which look along -z with y up, to optical frames."""
VISIBLE = 0.6


@dataclass(frozen=True)
class Shown:
    """An object that a picture shows, and what the perception says of it."""

    name: str
    kind: str
    colour: str
    distance_m: float
    error_m: float
    named: str
    is_detected: bool
    """Whether the default model has found it, at an intersection over union of 0.5."""


class Apartment:
    """The apartment, and a robot whose camera is put anywhere."""

    def __init__(self) -> None:
        self.scene = load_scene('apartment')
        self.model = build_world(humanoid(), self.scene, (Placement(),), Physics())
        self.data = mujoco.MjData(self.model)
        self.camera = self.model.camera(VIEW.camera).id
        self.pinhole = pinhole_of(self.model, VIEW)
        self.detector = make_detector(DetectorParameters())
        self.rays = self.pinhole.rays().reshape(-1, 3)
        self._bodies: dict[bytes, np.ndarray] = {}
        see_all(self.model)
        mujoco.mj_forward(self.model, self.data)

    def look(self, eye_m: np.ndarray, at_m: np.ndarray) -> None:
        """Put the camera at a point, looking at another one."""
        away = at_m - eye_m
        yaw = math.atan2(away[1], away[0])
        pitch = math.atan2(-away[2], math.hypot(away[0], away[1]))
        quaternion = np.empty(4)
        mujoco.mju_euler2Quat(quaternion, np.array([yaw, pitch, 0.02]), 'zyx')
        first = self.model.joint(in_world('', 'floating_base')).qposadr[0]
        self.data.qpos[slice(first, first + 7)] = [0.0, 0.0, 0.0, *quaternion]
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_comPos(self.model, self.data)
        mujoco.mj_camlight(self.model, self.data)
        self.data.qpos[slice(first, first + 3)] = eye_m - self.data.cam_xpos[self.camera]
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_comPos(self.model, self.data)
        mujoco.mj_camlight(self.model, self.data)

    @property
    def pose(self) -> tuple[np.ndarray, np.ndarray]:
        """Return the rotation (3, 3) and position (3,) of the optical frame in the world."""
        turn = self.data.cam_xmat[self.camera].reshape(3, 3) @ FLIP
        return turn, self.data.cam_xpos[self.camera].copy()

    def bodies(self) -> np.ndarray:
        """Return the body that each pixel shows, (height, width); each view is cast once."""
        turn, eye = self.pose
        view = turn.tobytes() + eye.tobytes()
        if view not in self._bodies:
            self._bodies[view] = self._cast(turn, eye)
        return self._bodies[view]

    def _cast(self, turn: np.ndarray, eye: np.ndarray) -> np.ndarray:
        rays = self.rays @ turn.T
        count = len(rays)
        geoms, distances = np.full(count, -1, np.int32), np.zeros(count)
        mujoco.mj_multiRay(
            self.model, self.data, eye, rays.ravel(), SEEN_GROUPS, 1, -1, geoms, distances,
            None, count, 100.0,
        )  # fmt: skip
        bodies = np.where(geoms >= 0, self.model.geom_bodyid[geoms], -1)
        return bodies.reshape(VIEW.height_px, VIEW.width_px)

    def outline_px(self, thing) -> tuple[float, float, float, float]:
        """Return the box of an object as if nothing hid it, by the corners of its geoms."""
        turn, eye = self.pose
        body = self.model.body(thing.name)
        half = np.array(thing.size_m) / 2.0
        corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * half
        points = self.data.xpos[body.id] + corners @ self.data.xmat[body.id].reshape(3, 3).T
        seen = (points - eye) @ turn
        u = seen[:, :2] / seen[:, 2:] * self.pinhole.focal_px + self.pinhole.centre_px
        return (*u.min(axis=0), *u.max(axis=0))

    def shown(self, color: np.ndarray, depth: np.ndarray) -> Iterator[Shown]:
        """Compare what is lifted and named with what is there."""
        bodies, (turn, eye) = self.bodies(), self.pose
        camera = camera_of(self.pinhole.matrix, 320, 240, (240, 320))
        found = self.detector.detect(color, depth, camera.fx_px, 0.4, 0.5)
        for thing in self.scene.objects:
            body = self.model.body(thing.name).id
            at_m = self.data.xpos[body].copy()
            distance_m = float(np.linalg.norm(at_m - eye))
            v, u = np.nonzero(bodies == body)
            if len(v) < 30 or distance_m > 2.5:
                continue
            box = (float(u.min()), float(v.min()), float(u.max() + 1), float(v.max() + 1))
            outline = self.outline_px(thing)
            seen = (box[2] - box[0]) * (box[3] - box[1])
            whole = (outline[2] - outline[0]) * (outline[3] - outline[1])
            if is_cut(box, 320, 240) or seen < VISIBLE * 0.8 * whole:
                continue
            surface = surface_of(box, depth, camera)
            assert surface is not None, thing.name
            lifted = lift(thing.kind, surface, camera, turn, eye)
            error_m = float(np.linalg.norm(lifted.centre_m - at_m))
            named, _ = colour_name(color, box, surface.mask)
            is_detected = any(
                each.class_id == thing.kind and overlap(each.box_px, box) > 0.5 for each in found
            )
            yield Shown(
                thing.name, thing.kind, thing.colour, distance_m, error_m, named, is_detected
            )


def overlap(a: Box, b: Box) -> float:
    """Return the intersection over union of two boxes."""
    width = max(0.0, min(a[2], b[2]) - max(a[0], b[0]))
    height = max(0.0, min(a[3], b[3]) - max(a[1], b[1]))
    areas = [(each[2] - each[0]) * (each[3] - each[1]) for each in (a, b)]
    return width * height / (sum(areas) - width * height)


def views(apartment: Apartment) -> Iterator[None]:
    """Look at each surface with objects from somewhere, from as high as the head is."""
    generator = np.random.default_rng(7)
    for thing in apartment.scene.objects:
        at_m = np.array(thing.position_m)
        angle, distance = generator.uniform(-math.pi, math.pi), generator.uniform(0.6, 2.2)
        eye = at_m + [distance * math.cos(angle), distance * math.sin(angle), 0.0]
        eye[2] = generator.uniform(1.15, 1.35)
        apartment.look(eye, at_m + generator.normal(0.0, 0.08, 3))
        yield


def seen_by(painter, apartment: Apartment) -> list[Shown]:
    """Draw all views, and collect what they show."""
    found: list[Shown] = []
    color = np.empty((240, 320, 3), np.uint8)
    depth = np.empty((240, 320), np.float32)
    for _ in views(apartment):
        painter.draw(apartment.data, apartment.camera, color, depth)
        found.extend(apartment.shown(color, depth))
    return found


@pytest.fixture(scope='module')
def apartment() -> Apartment:
    return Apartment()


@pytest.fixture(scope='module', params=[pytest.param('rays', marks=pytest.mark.story), 'egl'])
def seen(request, apartment: Apartment) -> list[Shown]:
    """Draw all views in one of the ways."""
    if request.param == 'rays':
        return seen_by(RayPainter(apartment.model, [VIEW]), apartment)
    try:
        painter = GlPainter('egl', apartment.model, 320, 240)
    except Exception as error:
        pytest.skip(f'no OpenGL: {error}')
    found = seen_by(painter, apartment)
    painter.close()
    return found


def test_places_are_close_to_the_truth(seen: list[Shown]):
    errors_m = np.array([each.error_m for each in seen])
    assert len(errors_m) > 25
    assert np.median(errors_m) < 0.02
    assert np.mean(errors_m < 0.06) > 0.9, sorted(
        (round(each.error_m, 3), each.name) for each in seen
    )[-8:]


def test_colours_are_named_as_in_the_scene(seen: list[Shown]):
    coloured = [each for each in seen if each.colour]
    right = [each for each in coloured if each.named == each.colour]
    wrong = {(each.name, each.colour, each.named) for each in coloured if each not in right}
    assert len(right) > 0.9 * len(coloured), wrong


def test_the_default_model_finds_most_of_them(seen: list[Shown]):
    missed = sorted(each.name for each in seen if not each.is_detected)
    assert len(missed) < 0.25 * len(seen), missed
