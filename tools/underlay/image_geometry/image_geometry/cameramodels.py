# SPDX-License-Identifier: Apache-2.0
"""Cameras with one lens and with two, as `sensor_msgs/CameraInfo` describes them."""

from __future__ import annotations

from collections.abc import Sequence
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray
from sensor_msgs.msg import CameraInfo, RegionOfInterest

__all__ = ['PinholeCameraModel', 'StereoCameraModel']

Matrix = NDArray[np.float64]
Pixel = tuple[float, float]
Point = tuple[float, float, float]


class PinholeCameraModel:
    """
    A camera with one lens, described by a `CameraInfo`.

    Points are in the optical frame of the camera (x right, y down, z forward), in m; pixels are
    (u, v), from the centre of the upper left one. K, R and P are the camera matrix (3, 3), the
    rectification (3, 3) and the projection (3, 4) for the images that the camera sends, so with
    its binning and region of interest; D are the coefficients of distortion, of shape (n, 1).
    """

    def __init__(self) -> None:
        self.K: Matrix = np.zeros((3, 3))
        self.D: Matrix = np.zeros((0, 1))
        self.R: Matrix = np.eye(3)
        self.P: Matrix = np.zeros((3, 4))
        self.full_K: Matrix = np.zeros((3, 3))
        self.full_P: Matrix = np.zeros((3, 4))
        self.width = self.height = 0
        self.binning_x = self.binning_y = 1
        self.raw_roi = RegionOfInterest()
        self.distortion_model = ''
        self.tf_frame = ''
        self.stamp: Any = None

    def from_camera_info(self, msg: CameraInfo) -> None:
        """
        Set the parameters of the camera.

        Parameters
        ----------
        msg
            The message that describes it.

        """
        self.full_K = np.array(msg.k, float).reshape(3, 3)
        self.full_P = np.array(msg.p, float).reshape(3, 4)
        self.R = np.array(msg.r, float).reshape(3, 3)
        self.D = np.array(msg.d, float).reshape(-1, 1)
        self.width, self.height = msg.width, msg.height
        self.binning_x, self.binning_y = max(1, msg.binning_x), max(1, msg.binning_y)
        self.raw_roi = msg.roi
        self.distortion_model = msg.distortion_model
        self.tf_frame, self.stamp = msg.header.frame_id, msg.header.stamp
        self.K, self.P = self._as_sent(self.full_K), self._as_sent(self.full_P)

    def _as_sent(self, full: Matrix) -> Matrix:
        """Adapt a matrix for all pixels of the sensor to binning and the region of interest."""
        matrix: Matrix = full.copy()
        matrix[0, 2] -= self.raw_roi.x_offset
        matrix[1, 2] -= self.raw_roi.y_offset
        matrix[0] /= self.binning_x
        matrix[1] /= self.binning_y
        return matrix

    def rectify_image(self, raw: NDArray[Any], rectified: NDArray[Any]) -> None:
        """
        Rectify an image: remove its distortion.

        Parameters
        ----------
        raw
            The image of the camera.
        rectified
            An array of the same shape and type, which becomes the result.

        Raises
        ------
        ImportError
            OpenCV is not installed.
        ValueError
            The shapes or types of the images differ.

        """
        if raw.shape != rectified.shape or raw.dtype != rectified.dtype:
            raise ValueError(
                f'The rectified image has the shape {rectified.shape} and the type '
                f'{rectified.dtype}, but must be as the raw one: create it with np.empty_like(raw)'
            )
        cv2 = _opencv()
        size = (raw.shape[1], raw.shape[0])
        lens = cv2.fisheye if self._is_fisheye() else cv2
        x_map, y_map = lens.initUndistortRectifyMap(
            self.K, self._coefficients(), self.R, self.P[:, :3], size, cv2.CV_32FC1
        )
        rectified[...] = cv2.remap(raw, x_map, y_map, cv2.INTER_CUBIC).reshape(raw.shape)

    def rectify_point(self, uv_raw: Sequence[float]) -> NDArray[np.float64]:
        """
        Compute where a pixel of the raw image is in the rectified one.

        Parameters
        ----------
        uv_raw
            The pixel (u, v).

        Returns
        -------
        numpy.ndarray
            The rectified pixel (u, v).

        Raises
        ------
        ImportError
            OpenCV is not installed.

        """
        cv2 = _opencv()
        lens = cv2.fisheye if self._is_fisheye() else cv2
        points = np.array([[[uv_raw[0], uv_raw[1]]]], np.float64)
        found: NDArray[np.float64] = lens.undistortPoints(
            points, self.K, self._coefficients(), R=self.R, P=self.P[:, :3]
        ).reshape(2)
        return found

    def _is_fisheye(self) -> bool:
        return self.distortion_model in ('equidistant', 'fisheye')

    def _coefficients(self) -> Matrix:
        return self.D if self.D.size else np.zeros((4, 1))

    def project_3d_to_pixel(self, point: Sequence[float]) -> Pixel:
        """
        Project a point to the rectified image.

        Parameters
        ----------
        point
            The point (x, y, z), in m.

        Returns
        -------
        tuple
            The rectified pixel (u, v); NaN for a point in the plane of the lens.

        """
        u, v, w = self.P @ (point[0], point[1], point[2], 1.0)
        if not w:
            return math.nan, math.nan
        return float(u / w), float(v / w)

    def project_pixel_to_3d_ray(self, uv: Sequence[float]) -> Point:
        """
        Compute the ray from the centre of the camera through a pixel of the rectified image.

        Parameters
        ----------
        uv
            The rectified pixel (u, v).

        Returns
        -------
        tuple
            The direction (x, y, z), of length 1.

        """
        x = (uv[0] - self.cx()) / self.fx()
        y = (uv[1] - self.cy()) / self.fy()
        length = math.sqrt(x * x + y * y + 1.0)
        return x / length, y / length, 1.0 / length

    def get_delta_u(self, delta_x: float, z: float) -> float:
        """
        Compute how far apart points are in the image.

        Parameters
        ----------
        delta_x
            Their distance along x, in m.
        z
            Their depth, in m.

        Returns
        -------
        float
            The distance along u, in pixels; infinite for a depth of 0.

        """
        return self.fx() * delta_x / z if z else math.inf

    def get_delta_v(self, delta_y: float, z: float) -> float:
        """
        Compute how far apart points are in the image.

        Parameters
        ----------
        delta_y
            Their distance along y, in m.
        z
            Their depth, in m.

        Returns
        -------
        float
            The distance along v, in pixels; infinite for a depth of 0.

        """
        return self.fy() * delta_y / z if z else math.inf

    def get_delta_x(self, delta_u: float, z: float) -> float:
        """
        Compute how far apart the points of two pixels are.

        Parameters
        ----------
        delta_u
            The distance of the pixels along u.
        z
            The depth of the points, in m.

        Returns
        -------
        float
            Their distance along x, in m.

        """
        return z * delta_u / self.fx()

    def get_delta_y(self, delta_v: float, z: float) -> float:
        """
        Compute how far apart the points of two pixels are.

        Parameters
        ----------
        delta_v
            The distance of the pixels along v.
        z
            The depth of the points, in m.

        Returns
        -------
        float
            Their distance along y, in m.

        """
        return z * delta_v / self.fy()

    def distortion_coeffs(self) -> Matrix:
        """The coefficients of distortion, of shape (n, 1)."""
        return self.D

    def intrinsic_matrix(self) -> Matrix:
        """The camera matrix K of the images that the camera sends."""
        return self.K

    def projection_matrix(self) -> Matrix:
        """The projection P of the images that the camera sends, after rectification."""
        return self.P

    def full_intrinsic_matrix(self) -> Matrix:
        """The camera matrix K for all pixels of the sensor."""
        return self.full_K

    def full_projection_matrix(self) -> Matrix:
        """The projection P for all pixels of the sensor."""
        return self.full_P

    def rotation_matrix(self) -> Matrix:
        """The rectification R."""
        return self.R

    def full_resolution(self) -> tuple[int, int]:
        """The number of pixels of the sensor, (width, height)."""
        return self.width, self.height

    def cx(self) -> float:
        """The centre of the rectified image along u, in pixels."""
        return float(self.P[0, 2])

    def cy(self) -> float:
        """The centre of the rectified image along v, in pixels."""
        return float(self.P[1, 2])

    def fx(self) -> float:
        """The focal length of the rectified image along u, in pixels."""
        return float(self.P[0, 0])

    def fy(self) -> float:
        """The focal length of the rectified image along v, in pixels."""
        return float(self.P[1, 1])

    def tx(self) -> float:
        """The displacement P[0, 3]: of the right of two cameras, -focal length * distance."""
        return float(self.P[0, 3])

    def ty(self) -> float:
        """The displacement P[1, 3]: of the lower of two cameras, -focal length * distance."""
        return float(self.P[1, 3])

    def fov_x(self) -> float:
        """The horizontal field of view of the rectified image, in rad."""
        width = (self.raw_roi.width or self.width) / self.binning_x
        return 2.0 * math.atan(width / (2.0 * self.fx()))

    def fov_y(self) -> float:
        """The vertical field of view of the rectified image, in rad."""
        height = (self.raw_roi.height or self.height) / self.binning_y
        return 2.0 * math.atan(height / (2.0 * self.fy()))

    def get_tf_frame(self) -> str:
        """The name of the optical frame."""
        return self.tf_frame

    fromCameraInfo = from_camera_info  # noqa: N815
    rectifyImage = rectify_image  # noqa: N815
    rectifyPoint = rectify_point  # noqa: N815
    project3dToPixel = project_3d_to_pixel  # noqa: N815
    projectPixelTo3dRay = project_pixel_to_3d_ray  # noqa: N815
    getDeltaU = get_delta_u  # noqa: N815
    getDeltaV = get_delta_v  # noqa: N815
    getDeltaX = get_delta_x  # noqa: N815
    getDeltaY = get_delta_y  # noqa: N815
    distortionCoeffs = distortion_coeffs  # noqa: N815
    intrinsicMatrix = intrinsic_matrix  # noqa: N815
    projectionMatrix = projection_matrix  # noqa: N815
    fullIntrinsicMatrix = full_intrinsic_matrix  # noqa: N815
    fullProjectionMatrix = full_projection_matrix  # noqa: N815
    rotationMatrix = rotation_matrix  # noqa: N815
    fullResolution = full_resolution  # noqa: N815
    fovX = fov_x  # noqa: N815
    fovY = fov_y  # noqa: N815
    tfFrame = get_tf_frame  # noqa: N815
    Tx = tx
    Ty = ty


class StereoCameraModel:
    """
    Two cameras side by side, after rectification.

    `left` and `right` are their models. Q (4, 4) maps (u, v, disparity, 1) to homogeneous points.
    """

    def __init__(self) -> None:
        self.left = PinholeCameraModel()
        self.right = PinholeCameraModel()
        self.Q: Matrix = np.zeros((4, 4))

    def from_camera_info(self, left_msg: CameraInfo, right_msg: CameraInfo) -> None:
        """
        Set the parameters of both cameras.

        Parameters
        ----------
        left_msg, right_msg
            The messages that describe them. The projection of the right one has the baseline.

        """
        self.left.from_camera_info(left_msg)
        self.right.from_camera_info(right_msg)
        fx, fy, baseline = self.right.fx(), self.right.fy(), self._baseline()
        cx, cy = self.left.cx(), self.left.cy()
        self.Q = np.zeros((4, 4))
        self.Q[0, 0], self.Q[0, 3] = fy * baseline, -fy * cx * baseline
        self.Q[1, 1], self.Q[1, 3] = fx * baseline, -fx * cy * baseline
        self.Q[2, 3] = fx * fy * baseline
        self.Q[3, 2], self.Q[3, 3] = fy, -fy * (cx - self.right.cx())

    def _baseline(self) -> float:
        """Return the distance of the cameras, in m."""
        return -self.right.tx() / self.right.fx() if self.right.fx() else 0.0

    @property
    def tf_frame(self) -> str:
        """The optical frame of the left camera, in which points are."""
        return self.left.tf_frame

    def get_tf_frame(self) -> str:
        """The name of the optical frame of the left camera, in which points are."""
        return self.left.tf_frame

    def project_3d_to_pixel(self, point: Sequence[float]) -> tuple[Pixel, Pixel]:
        """
        Project a point to both rectified images.

        Parameters
        ----------
        point
            The point (x, y, z), in m.

        Returns
        -------
        tuple
            The pixels (u, v) in the left and in the right image.

        """
        return self.left.project_3d_to_pixel(point), self.right.project_3d_to_pixel(point)

    def project_pixel_to_3d(self, left_uv: Sequence[float], disparity: float) -> Point:
        """
        Compute the point of a pixel.

        Parameters
        ----------
        left_uv
            The pixel (u, v) in the rectified left image.
        disparity
            How much farther left it is in the right image, in pixels.

        Returns
        -------
        tuple
            The point (x, y, z), in m; (0, 0, 0) if it is infinitely far away.

        """
        x, y, z, w = (float(each) for each in self.Q @ (left_uv[0], left_uv[1], disparity, 1.0))
        return (x / w, y / w, z / w) if w else (0.0, 0.0, 0.0)

    def get_z(self, disparity: float) -> float:
        """
        Compute the depth of a disparity.

        Parameters
        ----------
        disparity
            In pixels.

        Returns
        -------
        float
            The depth, in m; infinite for a disparity of 0.

        """
        return -self.right.tx() / disparity if disparity else math.inf

    def get_disparity(self, z: float) -> float:
        """
        Compute the disparity of a depth.

        Parameters
        ----------
        z
            The depth, in m.

        Returns
        -------
        float
            The disparity, in pixels; infinite for a depth of 0.

        """
        return -self.right.tx() / z if z else math.inf

    fromCameraInfo = from_camera_info  # noqa: N815
    project3dToPixel = project_3d_to_pixel  # noqa: N815
    projectPixelTo3d = project_pixel_to_3d  # noqa: N815
    getZ = get_z  # noqa: N815
    getDisparity = get_disparity  # noqa: N815
    tfFrame = get_tf_frame  # noqa: N815


def _opencv() -> Any:
    try:
        import cv2
    except ImportError as error:
        raise ImportError(
            'OpenCV rectifies images and pixels, and it is not installed: run `make setup` in the '
            f'workspace ({error})',
            name='cv2',
        ) from None
    return cv2
