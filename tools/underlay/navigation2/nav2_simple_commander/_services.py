# SPDX-License-Identifier: Apache-2.0
"""Synchronous requests: paths, costmaps and maps."""

# ruff: noqa: N802
from __future__ import annotations

from typing import Any

from geometry_msgs.msg import PoseStamped
from nav2_msgs import action, srv
from nav2_simple_commander._tasks import Tasks
from rclpy.duration import Duration

__all__ = ['Services']


class Services(Tasks):
    """
    Node that plans and smooths paths, gets and clears costmaps, and changes the map.

    Parameters
    ----------
    node_name, namespace
        The name of the node.
    **options
        Further keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, node_name: str, namespace: str, **options: Any) -> None:
        super().__init__(node_name, namespace, **options)
        self.compute_path_to_pose_client = self._action(
            action.ComputePathToPose, 'compute_path_to_pose'
        )
        self.compute_path_through_poses_client = self._action(
            action.ComputePathThroughPoses, 'compute_path_through_poses'
        )
        self.smoother_client = self._action(action.SmoothPath, 'smooth_path')
        self.change_maps_srv = self.create_client(srv.LoadMap, 'map_server/load_map')
        self.clear_costmap_global_srv = self._clearing(
            'global', 'entirely', srv.ClearEntireCostmap
        )
        self.clear_costmap_local_srv = self._clearing('local', 'entirely', srv.ClearEntireCostmap)
        self.clear_costmap_except_region_srv = self._clearing(
            'local', 'except', srv.ClearCostmapExceptRegion
        )
        self.clear_costmap_around_robot_srv = self._clearing(
            'local', 'around', srv.ClearCostmapAroundRobot
        )
        self.get_costmap_global_srv = self.create_client(
            srv.GetCostmap, 'global_costmap/get_costmap'
        )
        self.get_costmap_local_srv = self.create_client(
            srv.GetCostmap, 'local_costmap/get_costmap'
        )

    def _clearing(self, costmap: str, how: str, kind: Any) -> Any:
        name = f'clear_{how}_{costmap}_costmap'
        return self.create_client(kind, f'{costmap}_costmap/{name}')

    def getPath(
        self, start: PoseStamped, goal: PoseStamped, planner_id: str = '', use_start: bool = False
    ) -> Any:
        """
        Plan a path.

        Parameters
        ----------
        start
            The start pose, if `use_start` is true; otherwise the path starts at the robot.
        goal
            The goal pose.
        planner_id
            The planner; empty if there is only one.
        use_start
            Whether to use the start pose.

        Returns
        -------
        nav_msgs.msg.Path or None
            The path; None if planning fails: see `getTaskError`.

        """
        found = self._getPathImpl(start, goal, planner_id, use_start)
        return None if found is None else found.path

    def _getPathImpl(
        self, start: PoseStamped, goal: PoseStamped, planner_id: str = '', use_start: bool = False
    ) -> Any:
        self.info('Getting path...')
        wanted = action.ComputePathToPose.Goal(
            start=start, goal=goal, planner_id=planner_id, use_start=use_start
        )
        return self._ask_action(self.compute_path_to_pose_client, 'ComputePathToPose', wanted)

    def getPathThroughPoses(
        self,
        start: PoseStamped,
        goals: list[PoseStamped],
        planner_id: str = '',
        use_start: bool = False,
    ) -> Any:
        """
        Plan a path that passes through poses.

        Parameters
        ----------
        start
            The start pose, if `use_start` is true; otherwise the path starts at the robot.
        goals
            The poses to pass, the last of which is the goal.
        planner_id
            The planner; empty if there is only one.
        use_start
            Whether to use the start pose.

        Returns
        -------
        nav_msgs.msg.Path or None
            The path; None if planning fails: see `getTaskError`.

        """
        found = self._getPathThroughPosesImpl(start, goals, planner_id, use_start)
        return None if found is None else found.path

    def _getPathThroughPosesImpl(
        self,
        start: PoseStamped,
        goals: list[PoseStamped],
        planner_id: str = '',
        use_start: bool = False,
    ) -> Any:
        self.info('Getting path...')
        wanted = action.ComputePathThroughPoses.Goal(
            start=start, goals=goals, planner_id=planner_id, use_start=use_start
        )
        return self._ask_action(
            self.compute_path_through_poses_client, 'ComputePathThroughPoses', wanted
        )

    def smoothPath(
        self,
        path: Any,
        smoother_id: str = '',
        max_duration: float = 2.0,
        check_for_collision: bool = False,
    ) -> Any:
        """
        Smooth a path.

        Parameters
        ----------
        path
            The `nav_msgs/Path`.
        smoother_id
            The smoother; empty if there is only one.
        max_duration
            The maximum duration of smoothing in s.
        check_for_collision
            Whether a collision on the smoothed path is a failure.

        Returns
        -------
        nav_msgs.msg.Path or None
            The smoothed path; None if smoothing fails: see `getTaskError`.

        """
        found = self._smoothPathImpl(path, smoother_id, max_duration, check_for_collision)
        return None if found is None else found.path

    def _smoothPathImpl(
        self,
        path: Any,
        smoother_id: str = '',
        max_duration: float = 2.0,
        check_for_collision: bool = False,
    ) -> Any:
        self.info('Smoothing path...')
        wanted = action.SmoothPath.Goal(
            path=path,
            smoother_id=smoother_id,
            max_smoothing_duration=Duration(seconds=float(max_duration)).to_msg(),
            check_for_collisions=check_for_collision,
        )
        return self._ask_action(self.smoother_client, 'SmoothPath', wanted)

    def changeMap(self, map_filepath: str) -> bool:
        """
        Load another map into the map server.

        Parameters
        ----------
        map_filepath
            The YAML file of the map: a path, `file:///path` or `package://<package>/path`.

        Returns
        -------
        bool
            Whether the server could load it; if not, see `getTaskError`.

        """
        request = srv.LoadMap.Request(map_url=map_filepath)
        result = self._ask_service(self.change_maps_srv, request).result
        if result == srv.LoadMap.Response.RESULT_SUCCESS:
            self.info('Change map request was successful!')
            return True
        reasons = {
            srv.LoadMap.Response.RESULT_MAP_DOES_NOT_EXIST: 'the file does not exist',
            srv.LoadMap.Response.RESULT_INVALID_MAP_DATA: 'its image cannot be read',
            srv.LoadMap.Response.RESULT_INVALID_MAP_METADATA: 'its YAML file is invalid',
        }
        reason = reasons.get(result, 'the map server failed')
        self.setTaskError(result, f"The map '{map_filepath}' could not be loaded: {reason}.")
        self.error(self.last_action_error_msg)
        return False

    def clearAllCostmaps(self) -> None:
        """Clear the global and the local costmap."""
        self.clearLocalCostmap()
        self.clearGlobalCostmap()

    def clearLocalCostmap(self) -> None:
        """Clear the local costmap."""
        self._ask_service(self.clear_costmap_local_srv, srv.ClearEntireCostmap.Request())

    def clearGlobalCostmap(self) -> None:
        """Clear the global costmap."""
        self._ask_service(self.clear_costmap_global_srv, srv.ClearEntireCostmap.Request())

    def clearCostmapExceptRegion(self, reset_distance: float) -> None:
        """
        Clear the local costmap outside of a square around the robot.

        Parameters
        ----------
        reset_distance
            The side of the square in m.

        """
        request = srv.ClearCostmapExceptRegion.Request(reset_distance=float(reset_distance))
        self._ask_service(self.clear_costmap_except_region_srv, request)

    def clearCostmapAroundRobot(self, reset_distance: float) -> None:
        """
        Clear the local costmap inside a square around the robot.

        Parameters
        ----------
        reset_distance
            The side of the square in m.

        """
        request = srv.ClearCostmapAroundRobot.Request(reset_distance=float(reset_distance))
        self._ask_service(self.clear_costmap_around_robot_srv, request)

    def getGlobalCostmap(self) -> Any:
        """Get the global costmap, a `nav2_msgs/Costmap`."""
        return self._ask_service(self.get_costmap_global_srv, srv.GetCostmap.Request()).map

    def getLocalCostmap(self) -> Any:
        """Get the local costmap, a `nav2_msgs/Costmap`."""
        return self._ask_service(self.get_costmap_local_srv, srv.GetCostmap.Request()).map
