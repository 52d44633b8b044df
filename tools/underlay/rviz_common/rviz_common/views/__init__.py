# SPDX-License-Identifier: Apache-2.0
"""How the page looks at the scene, and how files say it."""

from rviz_common.views.camera_pose import CameraPose
from rviz_common.views.view import KINDS, View

__all__ = ['KINDS', 'CameraPose', 'View']
