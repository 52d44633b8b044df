# SPDX-License-Identifier: Apache-2.0
"""Views of the scene, and their form in files."""

from rviz_common.views.camera_pose import CameraPose
from rviz_common.views.view import KINDS, View

__all__ = ['KINDS', 'CameraPose', 'View']
