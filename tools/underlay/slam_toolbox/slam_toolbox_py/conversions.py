# SPDX-License-Identifier: Apache-2.0
"""Conversion of maps, poses and graphs to messages."""

from __future__ import annotations

from array import array
from typing import Any

from geometry_msgs.msg import Point, PoseWithCovarianceStamped, TransformStamped
from nav2_util.geometry import make_pose, make_quaternion, Pose2D
from nav_msgs.msg import OccupancyGrid
import numpy as np
from slam_toolbox_py.mapper import Placement
from slam_toolbox_py.occupancy import Grid
from slam_toolbox_py.pose_graph import PoseGraph
from slam_toolbox_py.poses import FloatArray, rotation
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

__all__ = ['make_graph_markers', 'make_map', 'make_placement', 'make_transform']

_NODE_M, _EDGE_M = 0.1, 0.03
_NODES = ColorRGBA(r=1.0, a=1.0)
_EDGES = ColorRGBA(r=0.0, g=0.0, b=1.0, a=1.0)
_LOOPS = ColorRGBA(g=0.8, a=1.0)


def make_map(grid: Grid, frame: str, stamp: Any) -> OccupancyGrid:
    """
    Build the `nav_msgs/OccupancyGrid` of a map.

    Parameters
    ----------
    grid
        The cells, with their origin and resolution.
    frame
        The frame of the map.
    stamp
        The time of the message, also as the load time of the map.

    """
    message = OccupancyGrid()
    message.header.frame_id, message.header.stamp = frame, stamp
    message.info.map_load_time = stamp
    message.info.resolution = float(grid.resolution_m)
    message.info.height, message.info.width = (int(each) for each in grid.cells.shape)
    message.info.origin = make_pose(Pose2D(float(grid.origin[0]), float(grid.origin[1]), 0.0))
    message.data = array('b', grid.cells.tobytes())
    return message


def make_placement(
    placement: Placement, frame: str, stamp: Any, position_scale: float, yaw_scale: float
) -> PoseWithCovarianceStamped:
    """
    Build the `geometry_msgs/PoseWithCovarianceStamped` of the base at the time of a scan.

    Parameters
    ----------
    placement
        Pose of the base in the map, with its covariance in the axes of the base; the message
        expresses it in those of the map.
    frame
        The frame of the map.
    stamp
        The time of the scan.
    position_scale, yaw_scale
        Factors of the covariance of the position and of the heading.

    """
    message = PoseWithCovarianceStamped()
    message.header.frame_id, message.header.stamp = frame, stamp
    x, y, yaw = (float(each) for each in placement.pose)
    message.pose.pose = make_pose(Pose2D(x, y, yaw))
    turn = np.eye(3)
    turn[:2, :2] = rotation(yaw)
    scale = np.sqrt([position_scale, position_scale, yaw_scale])
    covariance = np.zeros((6, 6))
    axes = np.ix_([0, 1, 5], [0, 1, 5])
    covariance[axes] = turn @ placement.covariance @ turn.T * scale[:, None] * scale
    message.pose.covariance = covariance.ravel()
    return message


def make_transform(pose: FloatArray, frame: str, child: str, stamp: Any) -> TransformStamped:
    """
    Build the `geometry_msgs/TransformStamped` of a planar pose.

    Parameters
    ----------
    pose
        Pose (3,) of the child frame in its parent: x and y in m, yaw in rad.
    frame, child
        The parent frame and the child frame.
    stamp
        The time of the transform.

    """
    message = TransformStamped(child_frame_id=child)
    message.header.frame_id, message.header.stamp = frame, stamp
    message.transform.translation.x = float(pose[0])
    message.transform.translation.y = float(pose[1])
    message.transform.rotation = make_quaternion(float(pose[2]))
    return message


def make_graph_markers(graph: PoseGraph, frame: str, stamp: Any) -> MarkerArray:
    """
    Build the markers of a pose graph: keyframes red, edges blue, closed loops green.

    Parameters
    ----------
    graph
        The poses and edges.
    frame
        The frame of the map.
    stamp
        The time of the markers.

    """
    points = [Point(x=float(x), y=float(y)) for x, y in graph.poses[:, :2]]
    nodes = _marker(Marker.SPHERE_LIST, 'slam_toolbox', frame, stamp, _NODE_M, _NODES)
    nodes.points = points
    edges = _marker(Marker.LINE_LIST, 'slam_toolbox_edges', frame, stamp, _EDGE_M, _EDGES)
    loops = _marker(Marker.LINE_LIST, 'slam_toolbox_loops', frame, stamp, _EDGE_M, _LOOPS)
    for edge in graph.edges:
        of = loops if edge.is_loop else edges
        of.points.append(points[edge.first])
        of.points.append(points[edge.second])
    shown = [each for each in (nodes, edges, loops) if each.points]
    return MarkerArray(markers=[Marker(action=Marker.DELETEALL), *shown])


def _marker(
    kind: int, namespace: str, frame: str, stamp: Any, width_m: float, colour: ColorRGBA
) -> Marker:
    marker = Marker(type=kind, ns=namespace, action=Marker.ADD, color=colour)
    marker.header.frame_id, marker.header.stamp = frame, stamp
    marker.scale.x = marker.scale.y = marker.scale.z = width_m
    marker.pose.orientation.w = 1.0
    return marker
