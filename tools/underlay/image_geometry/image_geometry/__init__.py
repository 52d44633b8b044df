# SPDX-License-Identifier: Apache-2.0
"""The geometry of cameras: pixels, rays and points."""

from image_geometry.cameramodels import PinholeCameraModel, StereoCameraModel

__all__ = ['PinholeCameraModel', 'StereoCameraModel']
