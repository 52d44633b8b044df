# SPDX-License-Identifier: Apache-2.0
"""Lead the robot through the apartment, and compare what it remembers with what is there.

`tools/in_environment python3 tools/benchmarks/perception_tour.py --teleport --detector node`. Of
all things that were within 2.5 m and at least 60 % visible for a second, by the depth camera and
the scene, at least 90 % have to be in `objects` at the end, with their class and within 0.10 m;
and at most one thing a minute may appear that is not there. The status is 1 otherwise.

The robot walks by velocities along a way through all rooms, or is put from place to place
(`--teleport`), and looks around at each stop. The script tells it where it is in the map, without
error: the localisation is tested elsewhere. `--detector truth` draws detections from the scene,
with the noise of a detector, to test the memory alone; `node` starts object_detector with
`--backend`.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, ExitStack
from dataclasses import dataclass, field
import math
import os
from pathlib import Path
import sys
import time
from typing import Any

from arguments import in_range

sys.path.insert(0, str(Path(__file__).parents[1] / 'training'))
from geometry_msgs.msg import TransformStamped, Twist  # noqa: E402
from humanoid_common.qos import COMMAND, LATCHED, SENSOR, STATE  # noqa: E402
from humanoid_common.testing.processes import module_command, running_program  # noqa: E402
from humanoid_common.testing.ros import ros_sandbox, RosSandbox  # noqa: E402
from humanoid_interfaces.action import ScanRoom  # noqa: E402
from humanoid_perception.images import depth_of  # noqa: E402
from humanoid_perception.memory_conversions import pose_of  # noqa: E402
from humanoid_perception.sighting import sighting_noise  # noqa: E402
from humanoid_simulation.camera.pinhole import Pinhole  # noqa: E402
from humanoid_simulation.scene import load_scene  # noqa: E402
from humanoid_simulation.scene.scene import Thing  # noqa: E402
from labels import Seen, silhouette_area_px  # noqa: E402
import numpy as np  # noqa: E402
import numpy.typing as npt  # noqa: E402
from rclpy.action import ActionClient  # noqa: E402
from rclpy.node import Node  # noqa: E402
from rclpy.time import Time  # noqa: E402
from sensor_msgs.msg import CameraInfo, Image  # noqa: E402
from simulation_interfaces.msg import EntityState  # noqa: E402
from simulation_interfaces.srv import GetEntityState, SetEntityState  # noqa: E402
from tf2_ros import (  # noqa: E402
    Buffer,
    TransformBroadcaster,
    TransformException,
    TransformListener,
)
from vision_msgs.msg import (  # noqa: E402
    Detection3D,
    Detection3DArray,
    ObjectHypothesis,
    ObjectHypothesisWithPose,
)

Array = npt.NDArray[np.float64]
WORLD, ODOM, CAMERA = 'world', 'odom', 'camera_optical_frame'
NEAR_M, VISIBLE, FOR_S = 2.5, 0.6, 1.0
"""When an object has to be remembered: its distance, visible fraction and view time."""
RIGHT_M, PRESENT_M = 0.10, 0.25
"""The required accuracy; and the distance to a true object beyond which one is false."""
RECALL, FALSE_PER_MINUTE = 0.9, 1.0
PLACES = (
    *('corridor', 'kitchen', 'kitchen_counter', 'kitchen_table', 'bedroom', 'desk', 'bed'),
    *('nightstand', 'living_room', 'sideboard', 'coffee_table', 'tv_cabinet'),
    *('hall', 'shoe_cabinet', 'hall_shelf'),
)
WAY = (
    *((1.3, 0.0), (1.3, 1.9), (0.75, 2.6), (1.3, 1.9), (1.3, 0.0), (4.4, 0.0), (4.4, 1.5)),
    *((4.4, 0.0), (2.7, 0.0), (2.7, -1.7), (0.9, -1.7), (2.9, -2.3), (4.7, -2.3), (2.7, -1.7)),
    *((2.7, 0.0), (0.0, 0.0), (-1.7, 0.0), (-2.5, 0.5), (-2.0, 1.1)),
)
PATIENCE_S = 120.0


@dataclass
class Tally:
    """The ground truth of one object, over time."""

    thing: Thing
    in_view_since_s: float = math.inf
    longest_view_s: float = 0.0

    @property
    def is_wanted(self) -> bool:
        """Whether it was in view long enough to be remembered."""
        return self.longest_view_s >= FOR_S

    def judge(self, time_s: float, is_in_view: bool) -> None:
        """
        Update the tally with a new image.

        Parameters
        ----------
        time_s
            The time of the image, in simulated time.
        is_in_view
            Whether the object is near and visible enough in it.

        """
        if not is_in_view:
            self.in_view_since_s = math.inf
            return
        self.in_view_since_s = min(self.in_view_since_s, time_s)
        self.longest_view_s = max(self.longest_view_s, time_s - self.in_view_since_s)


@dataclass
class Look:
    """A depth image with its camera."""

    time_s: float
    stamp: Any
    depth_m: npt.NDArray[np.float32]
    position: Array
    rotation: Array


@dataclass
class Row:
    """An object that had to be remembered.

    Attributes
    ----------
    name, kind
        The object in the scene.
    seen_s
        The longest time for which it was continuously in view.
    error_m
        The distance to the nearest remembered object of its class; infinite if there is none.

    """

    name: str
    kind: str
    seen_s: float
    error_m: float

    @property
    def is_found(self) -> bool:
        """Whether it was remembered at approximately its position."""
        return self.error_m <= RIGHT_M


@dataclass
class Report:
    """The results of the tour."""

    rows: list[Row] = field(default_factory=list)
    ghosts: dict[str, str] = field(default_factory=dict)
    simulated_s: float = 0.0

    @property
    def errors_m(self) -> list[float]:
        """The errors of the objects that were remembered."""
        return [row.error_m for row in self.rows if row.is_found]

    @property
    def recall(self) -> float:
        """The recall: the fraction of wanted objects remembered; NaN if none was wanted."""
        return len(self.errors_m) / len(self.rows) if self.rows else math.nan

    @property
    def ghosts_per_minute(self) -> float:
        """The rate of false objects."""
        return 60.0 * len(self.ghosts) / max(self.simulated_s, 1.0)

    @property
    def is_enough(self) -> bool:
        """Whether recall and false objects are within the limits."""
        return self.recall >= RECALL and self.ghosts_per_minute <= FALSE_PER_MINUTE

    def table(self) -> str:
        """Format the results, with a line for each object and each false one."""
        lines = [f'{"thing":24} {"class":8} {"seen s":>7} {"found":5} {"error m":>8}']
        for row in sorted(self.rows, key=lambda each: (each.is_found, each.name)):
            found = 'yes' if row.is_found else 'no'
            error = f'{row.error_m:8.3f}' if math.isfinite(row.error_m) else f'{"-":>8}'
            lines.append(f'{row.name:24} {row.kind:8} {row.seen_s:7.1f} {found:5} {error}')
        lines += [f'false: {name} at {where}' for name, where in self.ghosts.items()]
        right = self.errors_m or [math.nan]
        lines.append(
            f'remembered {len(self.errors_m)} of {len(self.rows)} ({self.recall:.0%}), '
            f'mean error {np.mean(right):.3f} m, greatest {max(right):.3f} m; '
            f'{self.ghosts_per_minute:.2f} false things a minute'
        )
        return '\n'.join(lines)


class Judge(Node):
    """
    Source of ground truth: publishes the robot's pose, and judges its object memory.

    Parameters
    ----------
    detector
        `truth` to publish detections drawn from the scene; otherwise another node detects.
    seed
        The seed of the noise of these detections.
    **options
        Further arguments of `Node`.

    Attributes
    ----------
    tallies
        The ground truth of each object in the apartment.
    objects
        The newest message of remembered objects.
    report
        The false objects so far; `finish` completes it.
    time_s, began_s
        The simulated time of the newest depth image, and of the first that was judged; NaN before.
    velocities, put, ask, scan
        The publisher of `cmd_vel`, and clients of the simulator and of `scan_room`.

    """

    def __init__(self, detector: str, seed: int, **options: Any) -> None:
        super().__init__('judge', **options)
        self._random = np.random.default_rng(seed)
        self._detects = detector == 'truth'
        self.tallies = [Tally(thing) for thing in load_scene('apartment').objects]
        self.objects = Detection3DArray()
        self.report = Report()
        self.time_s = self.began_s = math.nan
        self._pinhole: Pinhole | None = None
        self._fov: Any = None
        self._buffer = Buffer()
        self._listener = TransformListener(self._buffer, self)
        self._broadcaster = TransformBroadcaster(self)
        self._detections = self.create_publisher(Detection3DArray, 'detections_3d', STATE)
        self.create_subscription(Image, 'camera/depth/image_raw', self._take_depth, SENSOR)
        self.create_subscription(CameraInfo, 'camera/camera_info', self._take_info, SENSOR)
        self.create_subscription(Detection3DArray, 'objects', self._take_objects, LATCHED)
        self.create_timer(0.05, self._localise)
        self.velocities = self.create_publisher(Twist, 'cmd_vel', COMMAND)
        self.put = self.create_client(SetEntityState, 'simulator/set_entity_state')
        self.ask = self.create_client(GetEntityState, 'simulator/get_entity_state')
        self.scan = ActionClient(self, ScanRoom, 'scan_room')
        self._count = 0

    def pose(self, frame: str, child: str, time: Time = Time()) -> tuple[Array, Array]:
        """
        Look up the pose of a frame in another frame.

        Parameters
        ----------
        frame, child
            The frame in which the pose is expressed, and the one whose pose it is.
        time
            The time; by default the latest one available.

        Returns
        -------
        Array, Array
            The position (3,) in m, and the rotation (3, 3).

        Raises
        ------
        TransformException
            The transform is not available.

        """
        return pose_of(self._buffer.lookup_transform(frame, child, time).transform)

    def _localise(self) -> None:
        """Publish the true transform from the map, which is the world, to odometry."""
        try:
            found = self._buffer.lookup_transform(WORLD, ODOM, Time())
        except TransformException:
            return
        message = TransformStamped(header=found.header, child_frame_id=ODOM)
        message.header.frame_id = 'map'
        message.transform = found.transform
        self._broadcaster.sendTransform(message)

    def _take_info(self, message: CameraInfo) -> None:
        self._pinhole = Pinhole(
            message.width, message.height, 2.0 * math.atan(message.height / 2.0 / message.k[4])
        )

    def _take_objects(self, message: Detection3DArray) -> None:
        self.objects = message
        if message.header.frame_id != 'map':
            return
        for each in message.detections:
            if not self._is_there(each):
                at = each.bbox.center.position
                self.report.ghosts.setdefault(each.id, f'({at.x:.2f}, {at.y:.2f}, {at.z:.2f})')

    def _is_there(self, detection: Detection3D) -> bool:
        """Whether a true object of this class is near the detection; people are furniture."""
        at = detection.bbox.center.position
        kind = detection.results[0].hypothesis.class_id
        where = np.array([at.x, at.y, at.z])
        return kind == 'person' or any(
            tally.thing.kind == kind
            and np.linalg.norm(where - tally.thing.position_m) <= PRESENT_M
            for tally in self.tallies
        )

    def _take_depth(self, message: Image) -> None:
        """Update the tallies with the objects visible in a depth image."""
        depth, pinhole = depth_of(message), self._pinhole
        self.time_s = message.header.stamp.sec + message.header.stamp.nanosec * 1e-9
        if depth is None or pinhole is None:
            return
        try:
            position, rotation = self.pose(WORLD, CAMERA, Time.from_msg(message.header.stamp))
        except TransformException:
            return
        if math.isnan(self.began_s):
            self.began_s = self.time_s
        look = Look(self.time_s, message.header.stamp, depth, position, rotation)
        shares = {}
        for tally in self.tallies:
            share = self._visible(look, tally.thing, pinhole)
            shares[tally.thing.name] = share
            away_m = float(np.linalg.norm(tally.thing.position_m - position))
            tally.judge(self.time_s, share >= VISIBLE and away_m <= NEAR_M)
        self._count += 1
        if self._detects and self._count % 2 == 0:
            self._detect(look, shares)

    def _visible(self, look: Look, thing: Thing, pinhole: Pinhole) -> float:
        """Compute the fraction of an object that is in an image and not occluded."""
        turn = _rotation(thing.orientation_rpy_rad[2])
        offset = look.rotation.T @ (np.array(thing.position_m) - look.position)
        reach = 0.5 * float(np.linalg.norm(thing.box_m))
        if offset[2] < 0.2 or np.linalg.norm(offset) > 5.0:
            return 0.0
        middle = offset[:2] / offset[2] * pinhole.focal_px + pinhole.centre_px
        span = reach / (offset[2] - reach) * pinhole.focal_px + 2.0
        low = np.maximum(np.floor(middle - span), 0).astype(int)
        high = np.minimum(np.ceil(middle + span) + 1, (pinhole.width_px, pinhole.height_px))
        high = high.astype(int)
        if (high <= low).any():
            return 0.0
        depth = look.depth_m[low[1] : high[1], low[0] : high[0]].astype(float)
        u, v = np.meshgrid(np.arange(low[0], high[0]), np.arange(low[1], high[1]))
        flat = np.stack([u, v], axis=2) - np.array(pinhole.centre_px)
        rays = np.concatenate([flat / pinhole.focal_px, np.ones((*u.shape, 1))], axis=2)
        depth = np.where(np.isfinite(depth), depth, 0.0)
        points = (rays * depth[..., None] - offset) @ look.rotation.T @ turn
        half = 0.5 * np.array(thing.box_m)
        inside = (np.abs(points) <= half + 0.012).all(axis=2) & (points[..., 2] > 0.004 - half[2])
        seen = Seen(thing, 0, offset, look.rotation.T @ turn)
        return min(float(inside.sum()) / silhouette_area_px(seen, pinhole), 1.0)

    def _detect(self, look: Look, shares: dict[str, float]) -> None:
        """Publish simulated detections, with noise, misses and occasional false positives."""
        message = Detection3DArray()
        message.header.stamp, message.header.frame_id = look.stamp, ODOM
        try:
            origin, turn = self.pose(ODOM, WORLD, Time.from_msg(look.stamp))
        except TransformException:
            return
        for tally in self.tallies:
            thing, share = tally.thing, shares[tally.thing.name]
            at = np.array(thing.position_m)
            is_far = np.linalg.norm(at - look.position) > 3.5
            if share < 0.3 or is_far or self._random.random() > 0.85:
                continue
            noise = sighting_noise(at, look.position)
            seen_at = self._random.multivariate_normal(at, noise)
            message.detections.append(
                _detection(origin + turn @ seen_at, thing.kind, thing.colour, thing.box_m)
            )
        if self._random.random() < 0.05:
            ahead = look.position + look.rotation @ np.array([0.0, 0.2, 1.5])
            ghost = ahead + self._random.normal(0.0, 0.4, 3)
            message.detections.append(_detection(origin + turn @ ghost, 'can', 'red', (0.07,) * 3))
        self._detections.publish(message)

    def finish(self) -> Report:
        """Compare the remembered objects with ground truth."""
        report = self.report
        report.simulated_s = self.time_s - self.began_s
        for tally in self.tallies:
            if not tally.is_wanted:
                continue
            thing = tally.thing
            away_m = [
                float(np.linalg.norm(_place(each) - thing.position_m))
                for each in self.objects.detections
                if each.results[0].hypothesis.class_id == thing.kind
            ]
            error_m = min(away_m, default=math.inf)
            report.rows.append(Row(thing.name, thing.kind, tally.longest_view_s, error_m))
        return report


def _place(detection: Detection3D) -> Array:
    at = detection.bbox.center.position
    return np.array([at.x, at.y, at.z])


def _rotation(yaw_rad: float) -> Array:
    c, s = math.cos(yaw_rad), math.sin(yaw_rad)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def _detection(at: Array, kind: str, colour: str, size: Sequence[float]) -> Detection3D:
    message = Detection3D()
    for name in (kind, f'{colour} {kind}'):
        hypothesis = ObjectHypothesis(class_id=name, score=0.8)
        message.results.append(ObjectHypothesisWithPose(hypothesis=hypothesis))
    position, extent = message.bbox.center.position, message.bbox.size
    position.x, position.y, position.z = (float(each) for each in at)
    extent.x, extent.y, extent.z = (float(each) for each in size)
    return message


class Tour:
    """
    Guide of the robot through the apartment.

    Parameters
    ----------
    ros
        The domain of the robot.
    judge
        The judge, whose node observes and drives the robot; the tour waits for its servers.

    """

    def __init__(self, ros: RosSandbox, judge: Judge) -> None:
        self._ros, self._judge = ros, judge
        for client in (judge.put, judge.ask):
            ros.wait_until(client.service_is_ready, PATIENCE_S, 'the simulator')
        ros.wait_until(judge.scan.server_is_ready, PATIENCE_S, 'scan_room')
        ros.wait_until(lambda: not math.isnan(judge.began_s), PATIENCE_S, 'pictures')

    def teleport(self, x_m: float, y_m: float) -> None:
        """
        Place the robot somewhere without turning it: its gyroscope would miss a turn.

        Parameters
        ----------
        x_m, y_m
            The position of its base in the world.

        Raises
        ------
        RuntimeError
            The simulator cannot place it there.

        """
        state: EntityState = self._answer(
            self._judge.ask, GetEntityState.Request(entity='robot')
        ).state
        state.pose.position.x, state.pose.position.y = x_m, y_m
        answer = self._answer(self._judge.put, SetEntityState.Request(entity='robot', state=state))
        if answer.result.result != 1:
            raise RuntimeError(f'The robot cannot be put there: {answer.result.error_message}')
        self.wait(1.5)

    def turn_to(self, yaw_rad: float) -> None:
        """
        Turn in place, for at most 30 s of simulated time.

        Parameters
        ----------
        yaw_rad
            The heading in the world.

        """
        judge, begin_s = self._judge, self._judge.time_s
        while judge.time_s - begin_s < 30.0:
            _, rotation = judge.pose(WORLD, 'base_link')
            turn = math.remainder(yaw_rad - math.atan2(rotation[1, 0], rotation[0, 0]), math.tau)
            if abs(turn) < 0.15:
                break
            velocity = Twist()
            velocity.angular.z = math.copysign(max(0.2, min(0.6, 1.5 * abs(turn))), turn)
            judge.velocities.publish(velocity)
            self.wait(0.1)
        judge.velocities.publish(Twist())
        self.wait(1.0)

    def walk(self, x_m: float, y_m: float) -> None:
        """
        Walk straight to a point and stop, after at most 90 s of simulated time.

        Parameters
        ----------
        x_m, y_m
            The point in the world.

        """
        judge, begin_s = self._judge, self._judge.time_s
        while judge.time_s - begin_s < 90.0:
            position, rotation = judge.pose(WORLD, 'base_link')
            yaw = math.atan2(rotation[1, 0], rotation[0, 0])
            dx, dy = x_m - position[0], y_m - position[1]
            if math.hypot(dx, dy) < 0.15:
                break
            turn = math.remainder(math.atan2(dy, dx) - yaw, math.tau)
            velocity = Twist()
            velocity.angular.z = max(-0.6, min(0.6, 1.5 * turn))
            velocity.linear.x = 0.25 if abs(turn) < 0.4 else 0.0
            judge.velocities.publish(velocity)
            self.wait(0.1)
        judge.velocities.publish(Twist())
        self.wait(0.5)

    def look_around(self) -> None:
        """Scan the surroundings with the head."""
        judge = self._judge
        sent = judge.scan.send_goal_async(ScanRoom.Goal())
        self._ros.wait_until(sent.done, PATIENCE_S, 'an answer of scan_room')
        end = sent.result().get_result_async()
        self._ros.wait_until(end.done, PATIENCE_S, 'the end of scan_room')
        result = end.result().result
        if result.error_code:
            raise RuntimeError(f'The look around failed: {result.error_msg}')

    def wait(self, duration_s: float) -> None:
        """
        Wait for some simulated time, measured by the stamps of depth images.

        Parameters
        ----------
        duration_s
            The duration.

        """
        end_s = self._judge.time_s + duration_s
        self._ros.wait_until(lambda: self._judge.time_s >= end_s, PATIENCE_S, 'pictures')

    def _answer(self, client: Any, request: Any) -> Any:
        future = client.call_async(request)
        self._ros.wait_until(future.done, PATIENCE_S, client.srv_name)
        return future.result()


@contextmanager
def programs(options: argparse.Namespace) -> Iterator[dict[str, int]]:
    """
    Run the simulator and the nodes of perception during a `with` block.

    Parameters
    ----------
    options
        The command line: `renderer`, `speed`, `teleport`, `detector`, `backend` and `log`.

    Yields
    ------
    dict of str to int
        The process ids by name.

    """
    timed = ('--ros-args', '-p', 'use_sim_time:=true')
    told = {
        'scene': 'apartment',
        'camera_renderer': options.renderer,
        'real_time_factor': options.speed,
    }
    settings = [text for name, value in told.items() for text in ('-p', f'{name}:={value}')]
    follows = f'follows_jumps:={str(not options.teleport).lower()}'
    launch = 'ros2 launch humanoid_description description.launch.py use_sim_time:=true'
    commands = {
        'simulator': module_command('humanoid_simulation.starting', '--ros-args', *settings),
        'robot_state_publisher': launch.split(),
        'object_memory': module_command(
            'humanoid_perception.object_memory',
            *timed,
            '-p',
            'places_file:=apartment',
            '-p',
            follows,
        ),
        'gaze': module_command('humanoid_perception.gaze', *timed),
    }
    if options.detector == 'node':
        chosen = ('-p', f'backend:={options.backend}', '-p', f'target_frame:={ODOM}')
        commands['object_detector'] = module_command(
            'humanoid_perception.object_detector', *timed, *chosen
        )
    with ExitStack() as stack:
        running = {
            name: stack.enter_context(running_program(command))
            for name, command in commands.items()
        }
        running['simulator'].wait_for_output('Simulator started', PATIENCE_S)
        try:
            yield {name: program._process.pid for name, program in running.items()}
        finally:
            if options.log:
                options.log.write_text(
                    '\n'.join(f'== {name}\n{each.output}' for name, each in running.items())
                )


def cpu_s(pid: int) -> float:
    """
    Read the CPU time in s that a process has used so far, excluding its children.

    Parameters
    ----------
    pid
        The process id.

    """
    fields = Path(f'/proc/{pid}/stat').read_text().rpartition(')')[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf('SC_CLK_TCK')


def main() -> int:
    """Run, print the results, and return the exit status: 1 if they are insufficient."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--teleport', action='store_true', help='put the robot, do not walk')
    parser.add_argument('--detector', choices=('node', 'truth'), default='node')
    parser.add_argument('--backend', default='onnx', help='of object_detector')
    parser.add_argument('--renderer', default='auto', help='of the camera: egl, osmesa, rays')
    parser.add_argument('--speed', type=in_range(float, 0.05), default=1.0)
    parser.add_argument('--stops', type=in_range(int, 1), default=99, help='how many at most')
    parser.add_argument('--seed', type=in_range(int, 0), default=1)
    parser.add_argument('--log', type=Path, help='where to write what the programs say')
    options = parser.parse_args()
    with ros_sandbox() as ros, programs(options) as pids:
        judge = ros.start(lambda **given: Judge(options.detector, options.seed, **given))
        tour = Tour(ros, judge)
        begin_s, wall_s = judge.time_s, time.monotonic()
        before = {name: cpu_s(pid) for name, pid in pids.items()}
        scene = load_scene('apartment')
        if options.teleport:
            for name in PLACES[: options.stops]:
                place = scene.place(name)
                tour.teleport(place.x_m, place.y_m)
                tour.turn_to(place.yaw_rad)
                tour.look_around()
                print(f'{name}: {len(judge.objects.detections)} things', flush=True)
        else:
            for x_m, y_m in WAY[: options.stops]:
                tour.walk(x_m, y_m)
                tour.look_around()
                print(f'({x_m}, {y_m}): {len(judge.objects.detections)} things', flush=True)
        tour.wait(1.0)
        passed_s = judge.time_s - begin_s
        for name, pid in pids.items():
            share = (cpu_s(pid) - before[name]) / passed_s
            print(f'{name}: {share:.1%} of a core for a simulated second')
        print(f'{passed_s:.0f} s simulated in {time.monotonic() - wall_s:.0f} s')
        report = judge.finish()
        judge.scan.destroy()
    print(report.table())
    return int(not report.is_enough)


if __name__ == '__main__':
    sys.exit(main())
