# SPDX-License-Identifier: Apache-2.0
"""
Let the humanoid take things in the apartment, and count what it holds.

In each trial an object stands on a surface, with a random heading, within half a metre of a place
that the robot can walk to, and the robot somewhere in that room, roughly facing it. It looks
around, and picks the object by what its camera sees; ground truth shows whether it still holds it
five seconds later, whether a failure was reported as one, what was knocked over, and whether the
robot fell. It walks in the simulator with physics and noise.
"""

from __future__ import annotations

import argparse
from collections import Counter
from dataclasses import dataclass
import math
from pathlib import Path
import sys
from typing import Any

from action_msgs.msg import GoalStatus
from ament_index_python.packages import get_package_share_directory
from arguments import in_range
from geometry_msgs.msg import PoseWithCovarianceStamped
from humanoid_common.testing.launching import running_launch_file
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_control.walking.planar import PlanarPose
from humanoid_interfaces.action import Drop, Pick, ScanRoom
from humanoid_perception.places import Surface
from humanoid_perception.places_file import load_places, places_path
from humanoid_simulation.scene import load_scene, Scene
from humanoid_simulation.scene.occupancy import FREE, Layer, occupancy_of, OccupancyMap
from humanoid_simulation.testing.clients import EntityClient
from humanoid_simulation.testing.simulators import FellError, RobotClient
import numpy as np
from rclpy.action import ActionClient
from std_srvs.srv import Trigger

KINDS = ('mug', 'bottle', 'can', 'apple', 'orange', 'cube')
HELD_M = 0.35
"""An object that is nearer to a gripper than this, and off its surface, is held."""
_STANDS_M = 0.5
_SPOT_M, _SPOT_HIGH_M, _CELL_M = 0.06, 0.3, 0.02
"""The space where an object is placed that is free of furniture, such as a TV stand."""
TIPPED_M = 0.05
"""An object that has moved farther than this was knocked over or pushed."""
LEAST = 0.8
CODES = {
    getattr(Pick.Result, name): name
    for name in (
        *('NONE', 'NOT_SEEN', 'NOT_REACHABLE', 'OCCUPIED_HAND', 'SLIPPED', 'BLOCKED'),
        *('WALK_FAILED', 'ARM_FAILED', 'NO_TRANSFORM', 'INHIBITED', 'PREEMPTED', 'UNKNOWN'),
    )
}


@dataclass(frozen=True)
class Trial:
    """The object, its pose, and the initial pose of the robot."""

    thing: str
    surface: Surface
    at_m: tuple[float, float, float]
    turn_rad: float
    robot: tuple[float, float, float]


def main() -> int:
    """Run, print a table, and return the exit status: 1 if the results are insufficient."""
    parser = argparse.ArgumentParser(description=__doc__.strip().split('\n')[0])
    parser.add_argument('--trials', type=in_range(int, 1), default=40)
    parser.add_argument(
        '--first', type=in_range(int, 1), default=1, help='the trial with which to begin'
    )
    parser.add_argument('--seed', type=in_range(int, 0), default=1)
    parser.add_argument('--factor', type=in_range(float, 0.1, 2.0), default=0.8)
    options = parser.parse_args()
    if options.first > options.trials:
        parser.error(f'There are {options.trials} trials: give --first a number up to that.')
    bringup = Path(get_package_share_directory('humanoid_bringup')) / 'launch/bringup.launch.py'
    parts = ('navigation', 'perception', 'manipulation', 'hands')
    given = [f'{part}:=true' for part in parts]
    given += ['scene:=apartment', 'gui:=false', 'use_controller:=false']
    with (
        ros_sandbox() as ros,
        running_launch_file(bringup, *given, f'real_time_factor:={options.factor}'),
    ):
        return run(Kitchen(ros), options)


def run(kitchen: Kitchen, options: argparse.Namespace) -> int:
    """
    Run the trials, and print a row for each.

    Parameters
    ----------
    kitchen
        The apartment.
    options
        The command line: `trials`, `first` and `seed`.

    Returns
    -------
    int
        The exit status: 1 if too few objects were held, the robot fell, or a success was false.

    """
    random = np.random.default_rng(options.seed)
    ends: Counter[str] = Counter()
    knocked = 0
    print('| trial | thing | on | result | s |\n|---|---|---|---|---|')
    for number in range(1, options.trials + 1):
        trial = kitchen.drawn(random)
        if number < options.first:
            continue
        end, took_s, tipped = kitchen.tell(trial)
        ends[end.partition(':')[0]] += 1
        knocked += len(tipped)
        told = end + (f'; moved {", ".join(tipped)}' if tipped else '')
        print(
            f'| {number} | {trial.thing} | {trial.surface.name} | {told} | {took_s:.0f} |',
            flush=True,
        )
    count = ends.total()
    print(f'\n{ends["held"]} of {count} held; {knocked} things moved; {dict(ends)}')
    is_enough = ends['held'] >= LEAST * count and not ends['fell']
    return int(not is_enough or ends['told wrongly'] > 0)


class Kitchen:
    """
    The apartment, its robot, and a client that moves objects in it.

    Parameters
    ----------
    ros
        The domain of the robot; the constructor waits for its servers.

    Attributes
    ----------
    robot
        The simulated robot.

    """

    def __init__(self, ros: RosSandbox) -> None:
        self._ros, self.robot = ros, RobotClient(ros)
        self._node = ros.observer()
        self._clients = {
            name: ActionClient(self._node, kind, name)
            for name, kind in (('pick', Pick), ('drop', Drop), ('scan_room', ScanRoom))
        }
        for name, client in self._clients.items():
            ros.wait_until(client.server_is_ready, 120.0, name)
        self._entities = EntityClient(ros)
        self._forget = self._node.create_client(Trigger, 'object_memory/forget')
        ros.wait_until(self._forget.service_is_ready, 60.0, 'a memory')
        self._believe = self._node.create_publisher(PoseWithCovarianceStamped, 'initialpose', 1)
        path = places_path('apartment')
        assert path is not None
        self._places, self._scene = load_places(path), load_scene('apartment')
        self._map = occupancy_of(self._scene)
        self._tops = {each.name: _top_of(self._scene, each) for each in self._places.surfaces}
        self._things = {each.name: each for each in self._scene.objects}
        self._homes = {name: self._entities.position_m(name) for name in self._things}

    def drawn(self, random: np.random.Generator) -> Trial:
        """
        Draw a trial: an object that a robot can stand near, and a robot in that room.

        Parameters
        ----------
        random
            The source of random numbers.

        """
        while True:
            name = str(random.choice([n for n, t in self._things.items() if t.kind in KINDS]))
            surfaces = self._places.surfaces
            surface = surfaces[int(random.integers(len(surfaces)))]
            if '/' in surface.name or surface.name.endswith('bin'):
                continue
            xs, ys = zip(*surface.outline_m)
            x, y = random.uniform(min(xs), max(xs)), random.uniform(min(ys), max(ys))
            inset = min(x - min(xs), max(xs) - x, y - min(ys), max(ys) - y)
            others = [at for n, at in self._homes.items() if n != name]
            if inset < 0.07 or any(math.dist((x, y), o[:2]) < 0.18 for o in others):
                continue
            if not self._is_clear(x, y, _SPOT_M, self._tops[surface.name]):
                continue
            if not self._is_near_room(x, y, self._places.room_at(x, y)):
                continue
            robot = self._start(random, (x, y))
            if robot is not None:
                height_m = surface.height_m + 0.5 * self._things[name].box_m[2] + 0.002
                turn = float(random.uniform(-math.pi, math.pi))
                return Trial(name, surface, (float(x), float(y), height_m), turn, robot)

    def _start(
        self, random: np.random.Generator, at_m: tuple[float, float]
    ) -> tuple[float, float, float] | None:
        """Draw the start pose of the robot: 1 to 1.6 m away, in the room, clear of furniture."""
        room = self._places.room_at(*at_m)
        for _ in range(50):
            away, angle = random.uniform(1.0, 1.6), random.uniform(-math.pi, math.pi)
            x, y = at_m[0] + away * math.cos(angle), at_m[1] + away * math.sin(angle)
            if self._is_clear(x, y) and self._places.room_at(x, y) == room:
                facing = math.atan2(at_m[1] - y, at_m[0] - x) + random.uniform(-0.5, 0.5)
                return float(x), float(y), float(facing)
        return None

    def _is_near_room(self, x: float, y: float, room: str) -> bool:
        """Check whether a robot can walk to a place half a metre from an object."""
        for number in range(16):
            c, s = math.cos(math.tau * number / 16), math.sin(math.tau * number / 16)
            stands = (x + _STANDS_M * c, y + _STANDS_M * s)
            before = (x + (_STANDS_M + 0.4) * c, y + (_STANDS_M + 0.4) * s)
            is_there = self._places.room_at(*stands) == room
            if is_there and self._is_clear(*stands, 0.2) and self._is_clear(*before, 0.45):
                return True
        return False

    def _is_clear(
        self, x: float, y: float, radius_m: float = 0.45, where: OccupancyMap | None = None
    ) -> bool:
        """Check whether an area is free of fixed objects, in the map or in another one."""
        where = where or self._map
        around = [math.tau * number / 24 for number in range(24)]
        return all(
            where.at(x + away * math.cos(angle), y + away * math.sin(angle)) == FREE
            for away in np.linspace(0.0, radius_m, 4).tolist()
            for angle in around
        )

    def tell(self, trial: Trial) -> tuple[str, float, list[str]]:
        """
        Run a trial: set it up, look around, pick the object, and drop it again.

        Parameters
        ----------
        trial
            The object, its pose, and the initial pose of the robot.

        Returns
        -------
        str
            `held`, `told wrongly` for a false report of success, `fell`, or one of `CODES` with
            the message of the action.
        float
            The duration, in s of simulated time.
        list of str
            The other objects that were moved.

        """
        self._prepare(trial)
        before = {name: self._entities.position_m(name) for name in self._things}
        begin_s = self.robot.topics.time_s
        try:
            self._act('scan_room', ScanRoom.Goal())
            end = self._act('pick', Pick.Goal(object=trial.thing.replace('_', ' ')))
            self.robot.wait(5.0)
            held = self._is_held(trial)
            if end.status == GoalStatus.STATUS_SUCCEEDED:
                told = 'held' if held else 'told wrongly'
            else:
                told = f'{CODES[end.result.error_code]}: {end.result.error_msg}'
        except FellError:
            return 'fell', self.robot.topics.time_s - begin_s, []
        took_s = self.robot.topics.time_s - begin_s
        tipped = [
            name
            for name, at in before.items()
            if name != trial.thing and math.dist(at, self._entities.position_m(name)) > TIPPED_M
        ]
        self._act('drop', Drop.Goal())
        return told, took_s, tipped

    def _prepare(self, trial: Trial) -> None:
        """Place all objects and the robot for the trial."""
        self.robot.reset()
        self._entities.put(trial.thing, trial.at_m, trial.turn_rad)
        x, y, yaw = trial.robot
        self.robot.put(PlanarPose(complex(x, y), yaw))
        self.robot.let_go()
        message = PoseWithCovarianceStamped()
        message.header.frame_id = 'map'
        pose = message.pose.pose
        pose.position.x, pose.position.y = x, y
        pose.orientation.w, pose.orientation.z = math.cos(yaw / 2.0), math.sin(yaw / 2.0)
        message.pose.covariance[0] = message.pose.covariance[7] = 0.01
        message.pose.covariance[35] = 0.01
        self._believe.publish(message)
        self.robot.wait(2.0)
        forgotten = self._forget.call_async(Trigger.Request())
        self._ros.wait_until(forgotten.done, 60.0, 'a memory that forgets')

    def _is_held(self, trial: Trial) -> bool:
        """Check whether the object is off its surface, and near a gripper."""
        at, robot = self._entities.position_m(trial.thing), self.robot.pose.position_m
        away_m = math.hypot(at[0] - robot.real, at[1] - robot.imag)
        return away_m < HELD_M + 0.2 and at[2] > 0.6 and math.dist(at, trial.at_m) > 0.05

    def _act(self, name: str, goal: Any) -> Any:
        sent = self._clients[name].send_goal_async(goal)
        self._ros.wait_until(sent.done, 60.0, f'an answer of {name}')
        end = sent.result().get_result_async()
        self.robot.wait_until(end.done, 400.0)
        return end.result()


def _top_of(scene: Scene, surface: Surface) -> OccupancyMap:
    """Compute the occupancy map of fixed objects on a surface."""
    low_m = surface.height_m + 0.01
    return occupancy_of(scene, Layer(low_m, low_m + _SPOT_HIGH_M), _CELL_M)


if __name__ == '__main__':
    sys.exit(main())
