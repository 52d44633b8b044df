# SPDX-License-Identifier: Apache-2.0
"""Track and remember detected objects: the node `object_memory`."""

from __future__ import annotations

from collections import deque
import math
import sys
import time
from typing import Any

from humanoid_common.errors import UserError
from humanoid_common.node_parameters import NodeParameters
from humanoid_common.qos import LATCHED, STATE
from humanoid_common.running import run_node
from humanoid_interfaces.srv import FindObjects
from humanoid_perception.camera_views import CameraViews
from humanoid_perception.finding import find, ObjectQuery, QuestionError
from humanoid_perception.markers import markers_of
from humanoid_perception.memory import MemorySettings, ObjectMemory
from humanoid_perception.memory_conversions import (
    detections_of,
    planar_of,
    pose_of,
    remembered_object,
    sighting_of,
    time_of,
)
from humanoid_perception.memory_parameters import MemoryParameters
from humanoid_perception.places import Places
from humanoid_perception.places_file import load_places, places_path
from humanoid_perception.planar_poses import placed, Pose2
from humanoid_perception.remembered import RememberedThing
from humanoid_perception.visibility import View
import numpy as np
import numpy.typing as npt
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.time import Time
from std_msgs.msg import Header
from std_srvs.srv import Trigger
from tf2_ros import Buffer, TransformException, TransformListener
from vision_msgs.msg import Detection3D, Detection3DArray
from visualization_msgs.msg import MarkerArray

__all__ = ['ObjectMemoryNode', 'main']

Array = npt.NDArray[np.float64]
_WAIT_S = 1.0
"""Longest wait for the transform of detections, in wall-clock time."""
_BACK_S = 0.5
"""Stamps that go back further mean that the simulation was reset."""
_QUIET_S = 10.0


class ObjectMemoryNode(Node):
    """
    Node that turns `detections_3d` into objects with ids: `objects`, `find_objects` and markers.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('object_memory', **options)
        self._parameters = NodeParameters(self, MemoryParameters, self._change)
        told = self._parameters.current
        self._memory = ObjectMemory(_settings(told))
        self._places = _load_places(told.places_file)
        self._frame = ''
        self._anchor: Pose2 = (0.0, 0.0, 0.0)
        self._stamp_s = -math.inf
        self._pending: deque[tuple[float, Any]] = deque(maxlen=10)
        self._said: dict[str, float] = {}
        self._published: dict[str, tuple[Any, ...]] | None = None
        self._buffer = Buffer()
        self._listener = TransformListener(self._buffer, self)
        self._views = CameraViews(self, self._pose, self._warn)
        self._held: list[Detection3D] = []
        self._objects = self.create_publisher(Detection3DArray, 'objects', LATCHED)
        self._markers = self.create_publisher(MarkerArray, 'objects/markers', LATCHED)
        self.create_subscription(Detection3DArray, 'detections_3d', self._take, STATE)
        self.create_subscription(Detection3DArray, 'held_objects', self._take_held, LATCHED)
        self.create_service(FindObjects, 'find_objects', self._find)
        self.create_service(Trigger, '~/forget', self._forget)
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self.create_timer(1.0 / told.publish_rate_hz, self._publish, clock=steady)

    def _change(self, told: MemoryParameters) -> None:
        self._memory.settings = _settings(told)

    def _take(self, message: Detection3DArray) -> None:
        stamp_s = _seconds(message.header.stamp)
        if stamp_s < self._stamp_s - _BACK_S:
            self.get_logger().info('Time jumped backwards: all remembered objects are cleared.')
            self._clear()
        if stamp_s > self._stamp_s:
            self._stamp_s = stamp_s
            self._pending.append((time.monotonic(), message))
        self._work()

    def _take_held(self, message: Detection3DArray) -> None:
        self._held = message.detections

    def _clear(self) -> None:
        self._memory.clear()
        self._pending.clear()
        self._views.clear()
        self._stamp_s = -math.inf

    def _work(self) -> None:
        """Process the pending detections whose transforms are available."""
        while self._pending:
            received_s, message = self._pending[0]
            try:
                self._look(message)
            except TransformException as error:
                if time.monotonic() - received_s < _WAIT_S:
                    return
                self._warn(
                    f"Detections in the frame '{message.header.frame_id}' are ignored: no "
                    f'transform to it is known: {error}'
                )
            self._pending.popleft()

    def _look(self, message: Detection3DArray) -> None:
        """Update the memory with the detections of one image."""
        told, stamp = self._parameters.current, Time.from_msg(message.header.stamp)
        position, rotation = self._pose(told.odom_frame, message.header.frame_id, stamp)
        view = self._views.at(told.odom_frame, stamp)
        if view is None:
            self._warn(
                'Detections are ignored: no camera/camera_info received, which tells what should '
                'be visible.'
            )
            return
        self._choose_frame(told)
        sightings = [
            sighting_of(each, *placed(self._anchor, position, rotation))
            for each in message.detections
        ]
        self._memory.look(
            _seen_from(self._anchor, view),
            [each for each in sightings if each],
            self._anchor,
            *self._own_m(told, stamp),
        )

    def _own_m(self, told: MemoryParameters, stamp: Time) -> tuple[dict[str, Array], list[Array]]:
        """
        Compute the positions of held objects, by id, and of the hands, in the memory frame.

        They are those at the time of the image: a moving robot has left them when its detections
        arrive.
        """
        held = {each.id: (each.header.frame_id, each.bbox.center.position) for each in self._held}
        found = {
            name: self._placed_point(told.odom_frame, frame, stamp, (at.x, at.y, at.z))
            for name, (frame, at) in held.items()
        }
        hands = [
            self._placed_point(told.odom_frame, frame, stamp, (0.0, 0.0, 0.0))
            for frame in told.hand_frames
        ]
        known = {name: at for name, at in found.items() if at is not None}
        return known, [at for at in hands if at is not None]

    def _placed_point(
        self, odom: str, frame: str, stamp: Time, point_m: tuple[float, float, float]
    ) -> Array | None:
        """Transform a point into the memory frame; None if its frame is not available."""
        try:
            position, rotation = self._pose(odom, frame, stamp)
        except TransformException:
            return None
        return placed(self._anchor, position + rotation @ np.array(point_m), rotation)[0]

    def _choose_frame(self, told: MemoryParameters) -> None:
        """Use the map frame if it exists; transform the memory into it when it appears."""
        try:
            found = self._buffer.lookup_transform(told.map_frame, told.odom_frame, Time())
        except TransformException:
            self._frame = self._frame or told.odom_frame
            return
        self._anchor = planar_of(found.transform)
        if self._frame == told.odom_frame and self._frame != told.map_frame:
            self._memory.move_all(self._anchor)
        self._frame = told.map_frame

    def _pose(self, frame: str, child: str, stamp: Time) -> tuple[Array, Array]:
        if frame == child:
            return np.zeros(3), np.eye(3)
        return pose_of(self._buffer.lookup_transform(frame, child, stamp).transform)

    def _publish(self) -> None:
        """Publish the remembered objects, if they have changed."""
        self._work()
        if not self._frame:
            return
        things = self._memory.things
        now = {thing.object_id: _looks(thing) for thing in things}
        if self._published is not None and not _has_changed(self._published, now):
            return
        self._published = now
        header = self._header()
        message = detections_of(header, things)
        self._objects.publish(message)
        self._markers.publish(markers_of(message))

    def _header(self) -> Header:
        header = Header(frame_id=self._frame or self._parameters.current.odom_frame)
        header.stamp = time_of(self._stamp_s if math.isfinite(self._stamp_s) else 0.0)
        return header

    def _find(self, request: Any, response: Any) -> Any:
        question = ObjectQuery(request.class_id, request.colour, request.place, request.id)
        response.header = self._header()
        classes = self._parameters.current.classes
        try:
            found = find(question, self._memory.things, self._places, classes)
        except QuestionError as error:
            response.success, response.message = False, str(error)
            return response
        response.objects = [remembered_object(thing, self._places) for thing in found]
        response.success = True
        response.message = '' if found else 'No such object is remembered.'
        return response

    def _forget(self, _: Any, response: Any) -> Any:
        count = len(self._memory.things)
        self._memory.clear()
        response.success, response.message = True, f'Forgot all objects: {count}.'
        return response

    def _warn(self, text: str) -> None:
        """Log a warning, at most every 10 s for the same text."""
        kind, now_s = text[:40], time.monotonic()
        if now_s - self._said.get(kind, -math.inf) > _QUIET_S:
            self._said[kind] = now_s
            self.get_logger().warning(text)


def _load_places(given: str) -> Places:
    try:
        path = places_path(given)
        return load_places(path) if path else Places()
    except UserError as error:
        raise UserError(f'object_memory cannot start. {error}') from error


def _settings(told: MemoryParameters) -> MemorySettings:
    return MemorySettings(
        birth_sightings=told.birth_sightings,
        max_range_m=told.max_range_m,
        min_size_px=told.min_size_px,
        max_things=told.max_things,
        follows_jumps=told.follows_jumps,
    )


def _seconds(stamp: Any) -> float:
    return float(stamp.sec) + float(stamp.nanosec) * 1e-9


def _seen_from(anchor: Pose2, view: View) -> View:
    position, rotation = placed(anchor, view.position_m, view.rotation)
    return View(**{**view.__dict__, 'position_m': position, 'rotation': rotation})


def _looks(thing: RememberedThing) -> tuple[Any, ...]:
    """Return the published state of an object, for change detection."""
    return thing.class_id, thing.colour, thing.position_m.copy(), thing.size_m.copy()


def _has_changed(old: dict[str, tuple[Any, ...]], new: dict[str, tuple[Any, ...]]) -> bool:
    """Whether an object is new, gone or renamed, or has changed by more than noise."""
    if old.keys() != new.keys():
        return True
    return any(
        old[name][:2] != looks[:2]
        or np.abs(old[name][2] - looks[2]).max() > 0.015
        or np.abs(old[name][3] - looks[3]).max() > 0.02
        for name, looks in new.items()
    )


def main(args: list[str] | None = None) -> int:
    """
    Run the node `object_memory`.

    Parameters
    ----------
    args : list[str] | None
        The command line with its ROS arguments; None for that of the process.

    Returns
    -------
    int
        The exit status: 1 if the node cannot start, else 0.

    """
    return run_node(ObjectMemoryNode, args)


if __name__ == '__main__':
    sys.exit(main())
