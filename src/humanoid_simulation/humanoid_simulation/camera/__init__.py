# SPDX-License-Identifier: Apache-2.0
"""The cameras of the simulated robots, drawn by a process of their own."""

from humanoid_simulation.camera.renderer import Renderer
from humanoid_simulation.camera.view import CameraView, Wanted

__all__ = ['CameraView', 'Renderer', 'Wanted']
