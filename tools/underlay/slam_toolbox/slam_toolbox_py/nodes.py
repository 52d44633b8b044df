# SPDX-License-Identifier: Apache-2.0
"""The nodes of slam_toolbox, and the main functions of their executables."""

from __future__ import annotations

from geometry_msgs.msg import PoseWithCovarianceStamped
from nav2_util.geometry import yaw_of
from nav2_util.main import main
import numpy as np
from slam_toolbox_py.slam_node import SlamToolbox

__all__ = ['AsynchronousSlamToolbox', 'LocalizationSlamToolbox', 'SynchronousSlamToolbox']


class AsynchronousSlamToolbox(SlamToolbox):
    """Node that processes the newest scan, and drops those that arrived while it was busy."""


class SynchronousSlamToolbox(SlamToolbox):
    """Node that processes every scan in order, however long that takes: for recorded data."""

    keeps_all_scans = True

    def configure(self) -> None:
        """Also offer the service that clears the scan queue."""
        super().configure()
        self.offered.offer_clear_queue()


class LocalizationSlamToolbox(SlamToolbox):
    """Node that localizes in a map from `map_file_name` or the service `deserialize_map`."""

    only_localizes = True

    def configure(self) -> None:
        """Also subscribe to initial pose estimates."""
        super().configure()
        self.offered.offer_clear_localization_buffer()
        self.create_subscription(
            PoseWithCovarianceStamped, 'initialpose', self._on_initial_pose, 10
        )

    def activate(self) -> None:
        """Warn if there is no map yet."""
        super().activate()
        if self.session.localizer is None:
            self.get_logger().warning(
                "There is no map to localize in. Set the parameter 'map_file_name', or call "
                "'slam_toolbox/deserialize_map'."
            )

    def _on_initial_pose(self, message: PoseWithCovarianceStamped) -> None:
        frame, pose = message.header.frame_id, message.pose.pose
        if frame != self.told.current.map_frame:
            self.get_logger().error(
                f"The initial pose is in '{frame}'. Give it in '{self.told.current.map_frame}'."
            )
        elif self.session.localizer is None:
            self.get_logger().error('There is no map yet, so the initial pose is of no use.')
        else:
            position = pose.position
            self.session.localizer.start_at(
                np.array([position.x, position.y, yaw_of(pose.orientation)])
            )


def run_asynchronous() -> int:
    """Run async_slam_toolbox_node; return the exit status."""
    return main(AsynchronousSlamToolbox)


def run_synchronous() -> int:
    """Run sync_slam_toolbox_node; return the exit status."""
    return main(SynchronousSlamToolbox)


def run_localization() -> int:
    """Run localization_slam_toolbox_node; return the exit status."""
    return main(LocalizationSlamToolbox)
