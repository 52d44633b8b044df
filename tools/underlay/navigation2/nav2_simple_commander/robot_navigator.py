# SPDX-License-Identifier: Apache-2.0
"""
Navigation library for Python programs.

A program makes a `BasicNavigator`, starts a task, and polls `isTaskComplete` until it has ended::

    rclpy.init()
    navigator = BasicNavigator()
    navigator.waitUntilNav2Active()
    navigator.goToPose(pose)
    while not navigator.isTaskComplete():
        print(navigator.getFeedback().distance_remaining)
    if navigator.getResult() is not TaskResult.SUCCEEDED:
        print(navigator.getTaskError())
"""

# ruff: noqa: N802
from __future__ import annotations

import time
from typing import Any

from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped
from lifecycle_msgs.srv import GetState
from nav2_msgs.srv import ManageLifecycleNodes
from nav2_simple_commander._base import TaskResult
from nav2_simple_commander._services import Services
from nav2_util.qos import LATCHED
import rclpy

__all__ = ['BasicNavigator', 'TaskResult']

_MANAGE = 'nav2_msgs/srv/ManageLifecycleNodes'


class BasicNavigator(Services):
    """
    Node with the navigation API for programs.

    Parameters
    ----------
    node_name, namespace
        The name of the node.
    options
        Further keyword arguments of `rclpy.node.Node`.

    """

    def __init__(
        self, node_name: str = 'basic_navigator', namespace: str = '', **options: Any
    ) -> None:
        super().__init__(node_name, namespace, **options)
        self.initial_pose = PoseStamped()
        self.initial_pose.header.frame_id = 'map'
        self.initial_pose_received = False
        self.localization_pose_sub = self.create_subscription(
            PoseWithCovarianceStamped, 'amcl_pose', self._amclPoseCallback, LATCHED
        )
        self.initial_pose_pub = self.create_publisher(PoseWithCovarianceStamped, 'initialpose', 10)

    def setInitialPose(self, initial_pose: PoseStamped) -> None:
        """
        Publish the initial pose of the robot for the localization.

        Parameters
        ----------
        initial_pose
            The pose of the robot, in the frame of its header, such as map.

        """
        self.initial_pose_received = False
        self.initial_pose = initial_pose
        self._setInitialPose()

    def waitUntilNav2Active(
        self, navigator: str = 'bt_navigator', localizer: str = 'amcl'
    ) -> None:
        """
        Wait until navigation is active.

        Parameters
        ----------
        navigator
            The name of the navigator node.
        localizer
            The name of the localization node. For amcl, the initial pose is published until it is
            received; robot_localization has no lifecycle to wait for.

        """
        if localizer != 'robot_localization':
            self._waitForNodeToActivate(localizer)
        if localizer == 'amcl':
            self._waitForInitialPose()
        self._waitForNodeToActivate(navigator)
        self.info('Nav2 is ready for use!')

    def lifecycleStartup(self) -> None:
        """Start up all nodes of all lifecycle managers."""
        self.info('Starting up lifecycle nodes based on lifecycle_manager.')
        self._manage(ManageLifecycleNodes.Request.STARTUP)
        self.info('Nav2 is ready for use!')

    def lifecycleShutdown(self) -> None:
        """Shut down all nodes of all lifecycle managers."""
        self.info('Shutting down lifecycle nodes based on lifecycle_manager.')
        self._manage(ManageLifecycleNodes.Request.SHUTDOWN)

    def _manage(self, command: int) -> None:
        for name, kinds in self.get_service_names_and_types():
            if kinds[0] == _MANAGE:
                client = self.create_client(ManageLifecycleNodes, name)
                response = self._ask_service(client, ManageLifecycleNodes.Request(command=command))
                if not response.success:
                    self.error(f"'{name}' could not do that; its log says why.")
                self.destroy_client(client)

    def _waitForNodeToActivate(self, node_name: str) -> None:
        self.debug(f'Waiting for {node_name} to become active..')
        client = self.create_client(GetState, f'{node_name}/get_state')
        state = 'unknown'
        while state != 'active':
            state = self._ask_service(client, GetState.Request()).current_state.label
            self.debug(f'The state of {node_name} is {state}')
            if state != 'active':
                time.sleep(0.5)
        self.destroy_client(client)

    def _waitForInitialPose(self) -> None:
        self._hear_pose(0.5)
        while not self.initial_pose_received:
            self.info('Setting initial pose')
            self._setInitialPose()
            self.info('Waiting for amcl_pose to be received')
            self._hear_pose(1.0)

    def _hear_pose(self, timeout_s: float) -> None:
        end_s = time.monotonic() + timeout_s
        while not self.initial_pose_received and (left_s := end_s - time.monotonic()) > 0.0:
            rclpy.spin_once(self, executor=self._spinner, timeout_sec=left_s)

    def _amclPoseCallback(self, msg: PoseWithCovarianceStamped) -> None:
        self.debug('Received amcl pose')
        self.initial_pose_received = True

    def _setInitialPose(self) -> None:
        told = PoseWithCovarianceStamped(header=self.initial_pose.header)
        told.pose.pose = self.initial_pose.pose
        self.info('Publishing Initial Pose')
        self.initial_pose_pub.publish(told)
