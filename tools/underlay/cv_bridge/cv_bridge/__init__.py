# SPDX-License-Identifier: Apache-2.0
"""Images of ROS as arrays of OpenCV, and the other way round."""

from cv_bridge.core import CvBridge, CvBridgeError

__all__ = ['CvBridge', 'CvBridgeError']
