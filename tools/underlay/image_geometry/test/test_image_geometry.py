# SPDX-License-Identifier: Apache-2.0
"""The geometry of cameras with one lens and with two."""

from __future__ import annotations

import math
import subprocess
import sys

import cv2
from image_geometry import PinholeCameraModel, StereoCameraModel
import numpy as np
import pytest
from sensor_msgs.msg import CameraInfo

WITHOUT_OPENCV = """\
import sys
sys.modules['cv2'] = None
from image_geometry import PinholeCameraModel
from sensor_msgs.msg import CameraInfo
camera = PinholeCameraModel()
camera.from_camera_info(CameraInfo(p=[2.0, 0, 1, 0, 0, 2, 1, 0, 0, 0, 1, 0]))
print(camera.project_3d_to_pixel((1.0, 2.0, 4.0)))
try:
    camera.rectify_point((1.0, 1.0))
except ImportError as error:
    print(error)
"""


def described(baseline_m: float = 0.0) -> CameraInfo:
    """Return the description of a distorted camera, at a distance right of the left one."""
    info = CameraInfo(width=640, height=480, distortion_model='plumb_bob')
    info.header.frame_id = 'camera_optical'
    info.k = [500.0, 0.0, 320.0, 0.0, 510.0, 240.0, 0.0, 0.0, 1.0]
    info.d = [-0.3, 0.1, 0.001, -0.002, 0.0]
    info.r = np.eye(3).ravel().tolist()
    info.p = [400.0, 0.0, 310.0, -400.0 * baseline_m, 0.0, 420.0, 230.0, 0.0, 0.0, 0.0, 1.0, 0.0]
    return info


@pytest.fixture
def camera() -> PinholeCameraModel:
    """Return the model of that camera."""
    model = PinholeCameraModel()
    model.from_camera_info(described())
    return model


def test_points_and_rays(camera: PinholeCameraModel) -> None:
    """The ray of the pixel of a point leads to the point."""
    u, v = camera.project_3d_to_pixel((0.5, -0.25, 2.0))
    assert (u, v) == pytest.approx((410.0, 177.5))
    ray = camera.project_pixel_to_3d_ray((u, v))
    assert np.linalg.norm(ray) == pytest.approx(1.0)
    assert np.array(ray) * 2.0 / ray[2] == pytest.approx([0.5, -0.25, 2.0])
    assert math.isnan(camera.project_3d_to_pixel((1.0, 1.0, 0.0))[0])


def test_distances_in_the_image_and_in_space(camera: PinholeCameraModel) -> None:
    """Differences in m and in pixels belong together at each depth."""
    assert camera.get_delta_u(0.5, 2.0) == pytest.approx(100.0)
    assert camera.get_delta_x(100.0, 2.0) == pytest.approx(0.5)
    assert camera.get_delta_v(0.5, 2.0) == pytest.approx(105.0)
    assert camera.get_delta_y(105.0, 2.0) == pytest.approx(0.5)
    assert camera.get_delta_u(0.5, 0.0) == math.inf


def test_parameters(camera: PinholeCameraModel) -> None:
    """What describes the rectified image comes from the projection."""
    assert (camera.fx(), camera.fy(), camera.cx(), camera.cy()) == (400.0, 420.0, 310.0, 230.0)
    assert camera.fov_x() == pytest.approx(2.0 * math.atan(0.8))
    assert camera.fov_y() == pytest.approx(2.0 * math.atan(240.0 / 420.0))
    assert camera.intrinsic_matrix()[0, 0] == 500.0
    assert camera.distortion_coeffs().shape == (5, 1)
    assert camera.full_resolution() == (640, 480)
    assert camera.tf_frame == camera.get_tf_frame() == 'camera_optical'


def test_points_are_rectified(camera: PinholeCameraModel) -> None:
    """The distorted pixel of a point becomes that of the projection."""
    point = np.array([0.4, -0.3, 1.5])
    distorted, _ = cv2.projectPoints(
        point[None], np.zeros(3), np.zeros(3), camera.K, camera.distortion_coeffs()
    )
    found = camera.rectify_point(distorted[0, 0])
    assert found == pytest.approx(camera.project_3d_to_pixel(point), abs=0.05)


@pytest.mark.parametrize('channels', [1, 3])
def test_images_are_rectified(camera: PinholeCameraModel, channels: int) -> None:
    """A mark in the image is found where the point of its pixel is rectified to."""
    raw = np.zeros((480, 640, channels), np.uint8)
    raw[118:123, 198:203] = 255
    rectified = np.empty_like(raw)
    camera.rectify_image(raw, rectified)
    rows, columns = np.nonzero(rectified[:, :, 0] > 128)
    assert (columns.mean(), rows.mean()) == pytest.approx(camera.rectify_point((200, 120)), abs=1)
    with pytest.raises(ValueError, match=r'np\.empty_like\(raw\)'):
        camera.rectify_image(raw, np.empty((480, 640), np.float32))


def test_fisheye_lenses() -> None:
    """A lens with angles proportional to distances becomes a pinhole."""
    info = described()
    info.distortion_model, info.d = 'equidistant', [0.0, 0.0, 0.0, 0.0]
    camera = PinholeCameraModel()
    camera.from_camera_info(info)
    angle = 0.8
    found = camera.rectify_point((320.0 + 500.0 * angle, 240.0))
    assert found == pytest.approx((310.0 + 400.0 * math.tan(angle), 230.0), abs=0.01)
    raw = np.full((480, 640), 9, np.uint8)
    rectified = np.zeros_like(raw)
    camera.rectify_image(raw, rectified)
    assert rectified[230, 310] == 9


def test_binning_and_region_of_interest() -> None:
    """Pixels of smaller images belong to the same rays."""
    info = described()
    info.roi.x_offset, info.roi.y_offset, info.roi.width, info.roi.height = 100, 40, 200, 160
    info.binning_x = info.binning_y = 2
    camera = PinholeCameraModel()
    camera.from_camera_info(info)
    assert camera.project_3d_to_pixel((0.0, 0.0, 1.0)) == ((310 - 100) / 2, (230 - 40) / 2)
    assert camera.fx() == 200.0
    assert camera.full_projection_matrix()[0, 0] == 400.0
    assert camera.fov_x() == pytest.approx(2.0 * math.atan(100.0 / 400.0))


def test_two_cameras() -> None:
    """Disparities and depths belong together, and pixels with disparities are points."""
    stereo = StereoCameraModel()
    stereo.from_camera_info(described(), described(baseline_m=0.1))
    point = (0.3, -0.2, 2.0)
    left, right = stereo.project_3d_to_pixel(point)
    disparity = left[0] - right[0]
    assert disparity == pytest.approx(20.0)
    assert left[1] == pytest.approx(right[1])
    assert stereo.get_disparity(2.0) == pytest.approx(disparity)
    assert stereo.get_z(disparity) == pytest.approx(2.0)
    assert stereo.project_pixel_to_3d(left, disparity) == pytest.approx(point)
    assert stereo.project_pixel_to_3d(left, 0.0) == (0.0, 0.0, 0.0)
    assert stereo.get_z(0.0) == stereo.get_disparity(0.0) == math.inf
    assert stereo.tf_frame == 'camera_optical'


def test_older_names(camera: PinholeCameraModel) -> None:
    """The names of ROS 1 are those of the same methods."""
    assert camera.project3dToPixel((0.0, 0.0, 1.0)) == camera.project_3d_to_pixel((0.0, 0.0, 1.0))
    assert camera.projectPixelTo3dRay((310.0, 230.0)) == (0.0, 0.0, 1.0)
    assert camera.intrinsicMatrix() is camera.K
    assert camera.tfFrame() == 'camera_optical'
    assert StereoCameraModel.fromCameraInfo is StereoCameraModel.from_camera_info


def test_without_opencv() -> None:
    """Projections work without OpenCV; rectification says how to install it."""
    run = [sys.executable, '-c', WITHOUT_OPENCV]
    printed = subprocess.run(run, capture_output=True, text=True, check=True).stdout
    assert printed.startswith('(1.5, 2.0)\n')
    assert 'OpenCV rectifies images and pixels, and it is not installed: run `make' in printed
