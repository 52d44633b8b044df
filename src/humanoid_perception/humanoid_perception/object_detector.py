# SPDX-License-Identifier: Apache-2.0
"""Detect objects in camera images: the node `object_detector`."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, replace
import math
import sys
import time
from typing import Any

from humanoid_common.errors import UserError
from humanoid_common.node_parameters import NodeParameters
from humanoid_common.qos import SENSOR, STATE
from humanoid_common.running import ending, run_node
from humanoid_perception.camera_views import LatestCameraInfo
from humanoid_perception.colours import colour_name
from humanoid_perception.detection import Color, Depth, Detection
from humanoid_perception.detection_conversions import (
    annotated,
    detections_2d,
    detections_3d,
    header_of,
)
from humanoid_perception.detector_choice import (
    BEST_EFFORT,
    DetectorParameters,
    make_detector,
    RELIABLE,
)
from humanoid_perception.frames import FramePairs, RgbdFrame, stamp_in
from humanoid_perception.images import color_of, depth_of, ImageError
from humanoid_perception.lifting import (
    camera_of,
    lift,
    PinholeCamera,
    surface_of,
    UPRIGHT,
    VisibleSurface,
)
from humanoid_perception.markers import markers_of
from humanoid_perception.memory_conversions import pose_of
from humanoid_perception.yolo import AUTO
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.serialization import deserialize_message
from rclpy.subscription import Subscription
from rclpy.time import Time
from sensor_msgs.msg import CameraInfo, Image
from std_msgs.msg import Header
from std_srvs.srv import SetBool
from tf2_ros import Buffer, TransformException, TransformListener
from vision_msgs.msg import Detection2DArray, Detection3DArray
from visualization_msgs.msg import MarkerArray

__all__ = ['ObjectDetector', 'main']

_LOOK_S = 0.05
_TRANSFORM_WAIT_S = 0.5
_QUIET_S = 10.0
_SILENCE_S = 5.0
"""Time without any image after which a warning is logged."""


@dataclass(frozen=True, eq=False)
class _Seen:
    """Detections that wait for their transform to the target frame."""

    received_s: float
    header: Header
    camera: PinholeCamera
    found: list[tuple[Detection, VisibleSurface]]


class ObjectDetector(Node):
    """
    Node that turns colour and depth images into `detections`, `detections_3d` and marked images.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    Raises
    ------
    DetectorError
        The detector that the parameters select cannot be used.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('object_detector', **options)
        self._told = NodeParameters(self, DetectorParameters, self._change)
        told = self._told.current
        self._detector = make_detector(told)
        self._pairs = FramePairs(1.0 / told.max_rate_hz, told.max_depth_offset_s)
        self._seen: deque[_Seen] = deque(maxlen=5)
        self._camera = LatestCameraInfo()
        self._said: dict[str, float] = {}
        self._reliability = BEST_EFFORT if told.image_reliability == BEST_EFFORT else RELIABLE
        self._buffer = Buffer()
        self._listener = TransformListener(self._buffer, self)
        self._2d = self.create_publisher(Detection2DArray, 'detections', STATE)
        self._3d = self.create_publisher(Detection3DArray, 'detections_3d', STATE)
        self._markers = self.create_publisher(MarkerArray, 'detections/markers', STATE)
        self._image = self.create_publisher(Image, 'detections/image', STATE)
        self._subscriptions_in: list[Subscription] = []
        self._since_s = self._watched_s = time.monotonic()
        self._has_pictures = self._has_said_flat = False
        self._subscribe()
        self.create_service(SetBool, '~/enable', self._enable)
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self.create_timer(_LOOK_S, ending(self, self._look), clock=steady)
        self.get_logger().info(f'Detecting objects with {self._detector.title}.')

    def _change(self, told: DetectorParameters) -> None:
        self._pairs.period_s = 1.0 / told.max_rate_hz
        self._pairs.max_offset_s = told.max_depth_offset_s

    # Input

    def _subscribe(self) -> None:
        """Subscribe to the camera topics."""
        quality = QoSProfile(
            depth=1,
            reliability=ReliabilityPolicy.RELIABLE
            if self._reliability == RELIABLE
            else ReliabilityPolicy.BEST_EFFORT,
        )
        take_color, take_depth = ending(self, self._take_color), ending(self, self._take_depth)
        self._subscriptions_in = [
            self.create_subscription(
                CameraInfo, 'camera/camera_info', self._camera.take, SENSOR, raw=True
            ),
            self.create_subscription(Image, 'camera/image_raw', take_color, quality, raw=True),
            self.create_subscription(
                Image, 'camera/depth/image_raw', take_depth, quality, raw=True
            ),
        ]
        self._since_s = time.monotonic()

    def _unsubscribe(self) -> None:
        for subscription in self._subscriptions_in:
            self.destroy_subscription(subscription)
        self._subscriptions_in = []
        self._pairs.clear()
        self._seen.clear()

    def _enable(self, request: Any, response: Any) -> Any:
        """Enable or disable detection; while disabled, there is no camera subscription."""
        if request.data and not self._subscriptions_in:
            self._subscribe()
        elif not request.data:
            self._unsubscribe()
        response.success = True
        response.message = 'Detection started.' if request.data else 'Detection stopped.'
        return response

    def _take_color(self, data: bytes) -> None:
        self._has_pictures = True
        self._pairs.add_color(stamp_in(data), data, time.monotonic())
        self._look()

    def _take_depth(self, data: bytes) -> None:
        self._pairs.add_depth(stamp_in(data), data, time.monotonic())
        self._look()

    # Processing

    def _look(self) -> None:
        """Process the next image, if any, and publish pending 3-D detections."""
        if not self._subscriptions_in:
            return
        if not self._has_pictures:
            self._watch()
        frame = self._pairs.take(time.monotonic())
        if frame is not None:
            self._detect(frame)
        self._place()

    def _watch(self) -> None:
        """Find the reason why no images arrive: incompatible QoS, or no publisher."""
        now_s = time.monotonic()
        if now_s - self._watched_s < 1.0:
            return
        self._watched_s = now_s
        topic = self.resolve_topic_name('camera/image_raw')
        offered = [
            each.qos_profile.reliability for each in self.get_publishers_info_by_topic(topic)
        ]
        if self._reliability == RELIABLE and ReliabilityPolicy.BEST_EFFORT in offered:
            if self._told.current.image_reliability == AUTO:
                self._reliability = BEST_EFFORT
                self._unsubscribe()
                self._subscribe()
            else:
                self._warn(
                    f"Images on '{topic}' are published as best effort, so none of them arrive. "
                    "Set the parameter 'image_reliability' to 'auto' or 'best_effort'."
                )
        elif now_s - self._since_s > _SILENCE_S and not offered:
            self._since_s = math.inf
            self.get_logger().warning(
                f"No publisher of images on '{topic}'. Start the camera, or remap "
                "'camera/image_raw' to its topic."
            )

    def _detect(self, frame: RgbdFrame) -> None:
        """Detect the objects in an image, and publish them."""
        image = deserialize_message(frame.color, Image)
        try:
            color = color_of(image)
        except ImageError as error:
            self._warn(str(error))
            return
        depth_m, camera = self._depth_of(frame, color)
        told = self._told.current
        focal_px = camera.fx_px if camera else 0.0
        found = self._detector.detect(color, depth_m, focal_px, told.confidence, told.iou)
        surfaces = [
            surface_of(each.box_px, depth_m, camera) if camera and depth_m is not None else None
            for each in found
        ]
        found = [_coloured(each, color, surface) for each, surface in zip(found, surfaces)]
        self._2d.publish(detections_2d(image.header, found))
        if self._image.get_subscription_count() > 0:
            self._image.publish(annotated(image.header, color, found))
        if camera and depth_m is not None:
            placed = [(each, surface) for each, surface in zip(found, surfaces) if surface]
            self._seen.append(_Seen(time.monotonic(), image.header, camera, placed))

    def _depth_of(
        self, frame: RgbdFrame, color: Color
    ) -> tuple[Depth | None, PinholeCamera | None]:
        """Return the depth and the camera of an image, if both are available and valid."""
        if frame.depth is None:
            self._say_flat()
            return None, None
        self._has_said_flat = False
        info = self._camera.message
        if info is None:  # the first message may still be on its way
            if time.monotonic() > self._since_s + _SILENCE_S:
                self._warn("Detections are 2-D only: nothing received on 'camera/camera_info'.")
            return None, None
        try:
            depth_m = depth_of(deserialize_message(frame.depth, Image))
            camera = camera_of(info.k, info.width, info.height, (color.shape[0], color.shape[1]))
        except UserError as error:
            self._warn(f'Detections are 2-D only. {error}')
            return None, None
        if depth_m.shape != color.shape[:2]:
            self._warn(
                f'Detections are 2-D only. The depth image has {depth_m.shape[1]} x '
                f'{depth_m.shape[0]} pixels, but the colour image {color.shape[1]} x '
                f'{color.shape[0]}. Configure the camera to register depth to colour.'
            )
            return None, None
        return depth_m, camera

    def _say_flat(self) -> None:
        """Log once that there is no depth."""
        if not self._has_said_flat:
            self._has_said_flat = True
            topic = self.resolve_topic_name('camera/depth/image_raw')
            self.get_logger().info(
                f"Detections are 2-D only: no depth received on '{topic}' with the stamps of "
                'the images.'
            )

    def _place(self) -> None:
        """Publish pending 3-D detections as soon as their transforms are available."""
        while self._seen:
            seen = self._seen[0]
            try:
                self._publish_3d(seen)
            except TransformException as error:
                if time.monotonic() - seen.received_s < _TRANSFORM_WAIT_S:
                    return
                self._warn(
                    f"Detections are 2-D only: no transform of '"
                    f"{seen.header.frame_id}' in '{self._told.current.target_frame}': {error}"
                )
            self._seen.popleft()

    def _publish_3d(self, seen: _Seen) -> None:
        """Publish 3-D boxes in the target frame; raise TransformException without a transform."""
        target = self._told.current.target_frame
        rotation, translation_m, back = UPRIGHT, None, UPRIGHT.T
        if target:
            transform = self._buffer.lookup_transform(
                target, seen.header.frame_id, Time.from_msg(seen.header.stamp)
            )
            translation_m, rotation = pose_of(transform.transform)
            back = None
        boxes = [
            (each, lift(each.class_id, surface, seen.camera, rotation, translation_m))
            for each, surface in seen.found
        ]
        header = header_of(seen.header, target or seen.header.frame_id)
        message = detections_3d(header, boxes, back)
        self._3d.publish(message)
        if self._markers.get_subscription_count() > 0:
            self._markers.publish(markers_of(message))

    def _warn(self, text: str) -> None:
        """Log a warning, at most every 10 s for the same text."""
        kind, now_s = text[:60], time.monotonic()
        if now_s - self._said.get(kind, -math.inf) > _QUIET_S:
            self._said[kind] = now_s
            self.get_logger().warning(text)


def _coloured(detection: Detection, color: Color, surface: VisibleSurface | None) -> Detection:
    """Add the name of its colour to a detection."""
    if detection.colour:
        return detection
    name, share = colour_name(color, detection.box_px, surface.mask if surface else None)
    return replace(detection, colour=name, colour_share=share)


def main(args: list[str] | None = None) -> int:
    """
    Run the node `object_detector`.

    Parameters
    ----------
    args : list[str] | None
        The command line with its ROS arguments; None for that of the process.

    Returns
    -------
    int
        The exit status: 1 if the node cannot start, else 0.

    """
    return run_node(ObjectDetector, args)


if __name__ == '__main__':
    sys.exit(main())
