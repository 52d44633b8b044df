# SPDX-License-Identifier: Apache-2.0
"""Cameras of the simulated robots, rendered in a separate process."""

from humanoid_simulation.camera.pinhole import CameraView, Wanted
from humanoid_simulation.camera.renderer import Renderer

__all__ = ['CameraView', 'Renderer', 'Wanted']
