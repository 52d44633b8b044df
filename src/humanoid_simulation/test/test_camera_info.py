# SPDX-License-Identifier: Apache-2.0
"""Check that known things appear where camera information and the model say."""

from __future__ import annotations

from collections.abc import Iterator
import math
import time

from humanoid_common.parameters import build
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_control.dynamics import BodyModel
from humanoid_description.loading import load_robot
from humanoid_description.rotations import from_quaternion
from humanoid_simulation.backend import MujocoBackend
from humanoid_simulation.camera.topics import CameraTopics
from humanoid_simulation.model import humanoid, Placement
from humanoid_simulation.scene import Scene, Thing
from humanoid_simulation.simulator_parameters import CameraParameters
import numpy as np
import pytest
from rcl_interfaces.msg import Log
from sensor_msgs.msg import CameraInfo, Image

BALLS = {
    0: (2.4, 0.9, 1.2),
    1: (2.0, -0.7, 1.5),
    2: (1.8, 0.2, 0.9),
}
"""Where a red, a green and a blue ball are, in the world."""
PLACE = Placement('', 0.3, -0.1, yaw_rad=0.1)


@pytest.fixture(name='ros')
def _ros() -> Iterator[RosSandbox]:
    """Give a domain of its own."""
    with ros_sandbox() as sandbox:
        yield sandbox


def balls() -> Scene:
    """Return a scene with the balls, in bright colours of their own."""
    things = []
    for channel, position_m in BALLS.items():
        red, green, blue = (float(channel == each) for each in range(3))
        colour = (red, green, blue, 1.0)
        things.append(Thing(f'ball{channel}', 'sphere', (0.06,), position_m, colour_rgba=colour))
    return Scene('balls', things=tuple(things))


def optical_frame(backend: MujocoBackend) -> tuple[np.ndarray, np.ndarray]:
    """Compute the pose of the camera in the world by URDF and joints, as tf does."""
    description = humanoid()
    joints = tuple(description.drives)
    robot = load_robot(description.urdf, 'the humanoid')
    armature = np.array([drive.armature for drive in description.drives.values()])
    base, observed = backend.ground_truth(), backend.observe()['']
    state = BodyModel.of(robot, joints, armature).state(
        from_quaternion(base.orientation),
        np.zeros(3),
        observed.positions_rad,
        np.zeros(len(joints)),
    )
    position_m = base.position_m + state.position_m('camera_optical_frame')
    return position_m, state.rotation('camera_optical_frame')


def centre_px(image: Image, channel: int) -> np.ndarray:
    """Return the middle x, y of what has a colour."""
    pixels = np.frombuffer(image.data, np.uint8).reshape(image.height, image.width, 3).astype(int)
    others = np.delete(pixels, channel, axis=2).max(axis=2)
    y_px, x_px = np.nonzero(pixels[..., channel] - others > 60)
    assert len(x_px) > 10, f'ball {channel} is not seen'
    return np.array([x_px.mean(), y_px.mean()])


@pytest.mark.parametrize('renderer', ['egl', 'osmesa', 'rays'])
def test_known_things_are_where_they_are_projected(ros: RosSandbox, renderer: str) -> None:
    """Balls at known places appear within 1.5 pixels of where K and the pose put them."""
    backend = MujocoBackend(scene=balls(), placements=[PLACE])
    node, said = ros.observer(), []
    node.create_subscription(Log, '/rosout', lambda log: said.append(log.msg), 10)
    images: list[Image] = []
    infos: list[CameraInfo] = []
    node.create_subscription(Image, 'camera/image_raw', images.append, 10)
    node.create_subscription(CameraInfo, 'camera/camera_info', infos.append, 10)
    parameters = build(CameraParameters, {'camera_renderer': renderer})
    topics = CameraTopics(node, {'': backend.camera('')}, backend.model, parameters)

    def is_seen() -> bool:
        topics.tick(time.monotonic(), 10_000_000, backend.data)
        is_off = any('The cameras are off' in line for line in said)
        return is_off or (bool(images) and bool(infos))

    try:
        ros.wait_until(is_seen, 100.0, 'a picture and its description')
    finally:
        topics.close()
    if not images:
        pytest.skip(said[0])
    position_m, rotation = optical_frame(backend)
    matrix = np.array(infos[0].k).reshape(3, 3)
    for channel, ball_m in BALLS.items():
        seen = matrix @ (rotation.T @ (np.array(ball_m) - position_m))
        error_px = centre_px(images[0], channel) - seen[:2] / seen[2]
        assert math.hypot(*error_px.tolist()) < 1.5, (channel, error_px)
