# SPDX-License-Identifier: Apache-2.0
"""The rotation shim, a controller plugin."""

from nav2_rotation_shim_controller.controller import RotationShimController

__all__ = ['RotationShimController']
