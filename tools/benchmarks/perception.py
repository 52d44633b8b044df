# SPDX-License-Identifier: Apache-2.0
"""
Measure what seeing costs.

The first table is of single pictures without ROS: CPU time of one thread. `--robot` starts the
robot in its apartment as users do, and reads what share of a core each node of the perception
takes, and how old its results are. `--camera` sends large pictures with depth at 30 Hz to a
detector that is slower than that, and reads how old results get and what memory it takes.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from functools import partial
import os
from statistics import median
import time
from typing import Any

from arguments import in_range
from domain_coordinator import domain_id
from humanoid_common.qos import STATE
from humanoid_perception.detection_conversions import image_of
from humanoid_perception.detector_choice import DetectorParameters, make_detector
from humanoid_perception.images import data_of
from humanoid_perception.lifting import camera_of, lift, surface_of
from humanoid_simulation.camera import CameraView
from humanoid_simulation.camera.pinhole import pinhole_of
from humanoid_simulation.camera.ray_painter import RayPainter
from humanoid_simulation.model import build_world, humanoid, in_world, Physics, Placement
from humanoid_simulation.scene import load_scene
from measuring import child_of, cpu_s, median_of, memory_mb, running
import mujoco
import numpy as np
import rclpy
from rclpy.node import Node
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import CameraInfo, Image
from std_msgs.msg import Header
from vision_msgs.msg import Detection2DArray

ROBOT = (
    'ros2 launch humanoid_bringup bringup.launch.py scene:=apartment perception:=true gui:=false'
)
DETECTOR = (
    'ros2 run humanoid_perception object_detector --ros-args -p backend:=colour '
    '-p max_rate_hz:=1000.0'
)
LIMITS = {'object_detector': 0.20, 'object_memory': 0.03, 'gaze': None}
CAMERA_HZ, CAMERA_PX = 30.0, (1280, 720)
SETTLE_S = 5.0


def main() -> None:
    """Run the requested measurements and print the results."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--runs', type=in_range(int, 1), default=50, help='runs of each row')
    parser.add_argument('--robot', action='store_true', help='measure the nodes, launched')
    parser.add_argument('--camera', action='store_true', help='measure a camera of 30 Hz')
    parser.add_argument(
        '--seconds', type=in_range(float, 1.0), default=30.0, help='how long nodes are measured'
    )
    given = parser.parse_args()
    with domain_id() as domain:
        os.environ['ROS_DOMAIN_ID'] = str(domain)
        rclpy.init()
        if given.robot:
            measure_robot(given.seconds)
        elif given.camera:
            measure_camera(given.seconds)
        else:
            print(f'{"CPU ms":>7}  what, median of {given.runs} runs')
            for what, action in rows():
                print(f'{median_of(partial(cost_ms, action), given.runs):7.2f}  {what}')
        rclpy.shutdown()


def rows() -> Iterator[tuple[str, Any]]:
    """Yield the operations on an image of the apartment, for several sizes."""
    for width, height in ((320, 240), (640, 480), CAMERA_PX):
        color, depth_m, camera = rendered_view(width, height)
        for backend in ('onnx', 'colour'):
            detector = make_detector(DetectorParameters(backend=backend))
            detect = partial(detector.detect, color, depth_m, camera.fx_px, 0.4, 0.5)
            yield f'{backend}, picture of {width}x{height}', detect
        found = make_detector(DetectorParameters(backend='colour')).detect(
            color, depth_m, camera.fx_px, 0.4, 0.5
        )
        yield (
            f'3-D boxes of {len(found)} objects, {width}x{height}',
            partial(_lift_all, found, depth_m, camera),
        )


def _lift_all(found: Any, depth_m: Any, camera: Any) -> None:
    for each in found:
        surface = surface_of(each.box_px, depth_m, camera)
        if surface is not None:
            lift(each.class_id, surface, camera)


def rendered_view(width_px: int, height_px: int) -> tuple[Any, Any, Any]:
    """
    Render the robot's view at its start in the apartment.

    Parameters
    ----------
    width_px, height_px
        The size of the images.

    Returns
    -------
    tuple
        Red, green and blue (height, width, 3), depth in m (height, width), and the camera model.

    """
    view = CameraView(in_world('', 'head_camera'), width_px, height_px)
    model = build_world(humanoid(), load_scene('apartment'), (Placement(),), Physics())
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    color = np.empty((height_px, width_px, 3), np.uint8)
    depth_m = np.empty((height_px, width_px), np.float32)
    RayPainter(model, [view]).draw(data, model.camera(view.camera).id, color, depth_m)
    matrix = pinhole_of(model, view).matrix
    return color, depth_m, camera_of(matrix, width_px, height_px, (height_px, width_px))


def cost_ms(action: Any) -> float:
    """
    Measure the CPU time of this thread in ms for one call.

    Parameters
    ----------
    action
        Called without arguments.

    """
    begin_s = time.thread_time()
    action()
    return 1e3 * (time.thread_time() - begin_s)


class Listener(Node):
    """
    A node that records the age of detections on arrival.

    Parameters
    ----------
    simulated
        Whether stamps are in simulated time, from `/clock`, instead of system time.

    Attributes
    ----------
    ages_s, times_s
        The age of each result, and its arrival time on the monotonic clock.

    """

    def __init__(self, simulated: bool) -> None:
        super().__init__('listener')
        self.ages_s: list[float] = []
        self.times_s: list[float] = []
        self._simulated, self._now_s = simulated, 0.0
        if simulated:
            self.create_subscription(Clock, '/clock', self._tick, 1)
        self.create_subscription(Detection2DArray, 'detections', self._take, STATE)

    def _tick(self, message: Clock) -> None:
        self._now_s = message.clock.sec + message.clock.nanosec * 1e-9

    def _take(self, message: Detection2DArray) -> None:
        now_s = self._now_s if self._simulated else time.time()
        stamp = message.header.stamp
        self.ages_s.append(now_s - stamp.sec - stamp.nanosec * 1e-9)
        self.times_s.append(time.monotonic())

    def spin(self, seconds: float) -> None:
        """
        Process messages for some time.

        Parameters
        ----------
        seconds
            The duration, in real time.

        """
        end_s = time.monotonic() + seconds
        while time.monotonic() < end_s:
            rclpy.spin_once(self, timeout_sec=0.05)

    def report(self) -> None:
        """Print the rate and the age of the results."""
        period_s = median(np.diff(self.times_s)) if len(self.times_s) > 2 else float('nan')
        worst_s = max(self.ages_s, default=float('nan'))
        late = sum(age_s > 2.0 * period_s for age_s in self.ages_s)
        print(
            f'{len(self.ages_s)} results, one in {1e3 * period_s:.0f} ms; age: median '
            f'{1e3 * median(self.ages_s or [float("nan")]):.0f} ms, at most {1e3 * worst_s:.0f} '
            f'ms; {late} older than two periods'
        )


def measure_robot(seconds: float) -> None:
    """
    Start the robot, and print the cost of its perception.

    Parameters
    ----------
    seconds
        For how long to measure, in real time.

    """
    with running(ROBOT.split()) as launch:
        listener = Listener(simulated=True)
        while not listener.ages_s:
            listener.spin(1.0)
        listener.spin(SETTLE_S)
        listener.ages_s.clear()
        listener.times_s.clear()
        processes = {name: child_of(launch.pid, name) for name in LIMITS}
        begin_s, begin = time.monotonic(), {name: cpu_s(pid) for name, pid in processes.items()}
        listener.spin(seconds)
        elapsed_s = time.monotonic() - begin_s
        print(f'{"CPU %":>7} {"limit":>7}  node')
        for name, limit in LIMITS.items():
            share = (cpu_s(processes[name]) - begin[name]) / elapsed_s
            print(f'{share:7.1%} {"" if limit is None else f"{limit:.0%}":>7}  {name}')
        listener.report()


def measure_camera(seconds: float) -> None:
    """
    Send large images to a detector faster than it can process them, and print the results.

    Parameters
    ----------
    seconds
        For how long to measure, in real time.

    """
    width, height = CAMERA_PX
    color, depth_m, camera = rendered_view(width, height)
    listener = Listener(simulated=False)
    make = listener.create_publisher
    publishers = (
        make(CameraInfo, 'camera/camera_info', STATE),
        make(Image, 'camera/image_raw', STATE),
        make(Image, 'camera/depth/image_raw', STATE),
    )
    header = Header(frame_id='camera')
    picture = image_of(header, color)
    depth = Image(header=header, width=width, height=height, encoding='32FC1', step=4 * width)
    depth.data = data_of(depth_m)
    info = CameraInfo(header=header, width=width, height=height)
    info.k = [camera.fx_px, 0.0, camera.cx_px, 0.0, camera.fy_px, camera.cy_px, 0.0, 0.0, 1.0]
    messages = (info, picture, depth)

    def send() -> None:
        stamp = listener.get_clock().now().to_msg()
        for publisher, message in zip(publishers, messages):
            message.header.stamp = stamp
            publisher.publish(message)

    listener.create_timer(1.0 / CAMERA_HZ, send)
    with running(DETECTOR.split()) as launch:
        while not listener.ages_s:
            listener.spin(1.0)
        listener.spin(SETTLE_S)
        listener.ages_s.clear()
        listener.times_s.clear()
        process = child_of(launch.pid, 'object_detector')
        part_s = seconds / 10.0
        for part in range(10):
            print(f'after {part * part_s:5.0f} s: {memory_mb(process):6.1f} MB', flush=True)
            listener.spin(part_s)
        print(f'after {seconds:5.0f} s: {memory_mb(process):6.1f} MB')
        listener.report()


if __name__ == '__main__':
    main()
