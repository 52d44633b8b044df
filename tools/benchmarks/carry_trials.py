# SPDX-License-Identifier: Apache-2.0
"""
Let the humanoid carry half a kilogram through doors, and count how often it keeps it.

`tools/in_environment python3 tools/benchmarks/carry_trials.py --ways 20`. It picks up a bottle of
0.5 kg from the kitchen counter, and walks to and fro between kitchen and living room, some six
metres and two doors per walk. Ground truth shows whether it still holds the bottle. It walks in
the simulator with physics and noise.
"""

from __future__ import annotations

import argparse
import math
from pathlib import Path
import sys
import tempfile

from action_msgs.msg import GoalStatus
from ament_index_python.packages import get_package_share_directory
from arguments import in_range
from humanoid_common.testing.actions import ActionCaller
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_interfaces.action import Pick, ScanRoom
from humanoid_navigation.testing import NavigatingRobot
from humanoid_simulation.testing.clients import EntityClient
from navigation_trials import robot_at_home

BOTTLE = 'green_bottle'
LIGHT, HEAVY = 'name: green_bottle, ', 'name: green_bottle, size: [0.075, 0.075, 0.262], '
KITCHEN, LIVING_ROOM = (0.9, 2.6, math.pi / 2.0), (2.7, -1.8, -math.pi / 2.0)
LEAST_WAY_M = 4.0
HIGH_M, NEAR_M = 0.6, 0.55
"""An object that is lower, or farther from the robot, is no longer in its hand."""
PICK_S = 400.0


def main() -> int:
    """Walk, print a line for each walk, and return 1 if the bottle was dropped on any of them."""
    parser = argparse.ArgumentParser(description=__doc__.strip().split('\n')[0])
    parser.add_argument('--ways', type=in_range(int, 1), default=20, help='how often it walks')
    parser.add_argument('--factor', type=in_range(float, 0.1, 2.0), default=0.7)
    options = parser.parse_args()
    share = Path(get_package_share_directory('humanoid_simulation'))
    home = (share / 'scenes' / 'apartment.yaml').read_text(encoding='utf-8')
    assert LIGHT in home
    with tempfile.TemporaryDirectory() as folder, ros_sandbox() as ros:
        scene = Path(folder) / 'home.yaml'
        scene.write_text(home.replace(LIGHT, HEAVY), encoding='utf-8')
        arguments = (
            f'scene:={scene}',
            'map:=apartment',
            'places_file:=apartment',
            'perception:=true',
            'manipulation:=true',
            'hands:=true',
            'use_controller:=false',
            f'real_time_factor:={options.factor}',
        )
        with robot_at_home(*arguments):
            return walk(ros, options.ways)


def walk(ros: RosSandbox, ways: int) -> int:
    """
    Pick up the bottle, carry it to and fro, and print a row for each walk.

    Parameters
    ----------
    ros
        The domain of the robot.
    ways
        The number of walks to the other room.

    Returns
    -------
    int
        The exit status: 0 if the bottle was kept on all walks, else 1.

    Raises
    ------
    AssertionError
        The robot does not reach the kitchen initially, or falls.

    """
    traveller, entities = NavigatingRobot(ros), EntityClient(ros)
    robot = traveller.robot
    arrival = traveller.go(*KITCHEN)
    assert arrival.is_reached, arrival
    scan, pick = ActionCaller(ros, ScanRoom, 'scan_room'), ActionCaller(ros, Pick, 'pick')
    scan.end_of(scan.send(), PICK_S)
    end = pick.end_of(pick.send(object='green bottle'), PICK_S)
    if end.status != GoalStatus.STATUS_SUCCEEDED:
        print(f'It has not taken the bottle: {end.result.error_msg}')
        return 1
    kept = 0
    print('| way | to | m | s | off | kept |\n|---|---|---|---|---|---|')
    for number in range(1, ways + 1):
        name, goal = ('kitchen', KITCHEN) if number % 2 == 0 else ('living room', LIVING_ROOM)
        before = robot.pose.position_m
        arrival = traveller.go(*goal)
        way_m = abs(robot.pose.position_m - before)
        x, y, z = entities.position_m(BOTTLE)
        is_kept = z > HIGH_M and abs(complex(x, y) - robot.pose.position_m) < NEAR_M
        kept += is_kept and arrival.is_reached and way_m > LEAST_WAY_M
        print(
            f'| {number} | {name} | {way_m:.1f} | {arrival.took_s:.0f} | {arrival.distance_m:.2f} '
            f'm | {"yes" if is_kept else "no"} |',
            flush=True,
        )
        if not is_kept:
            break
    print(f'\n{kept} of {ways} ways done with the bottle in the hand')
    return int(kept < ways)


if __name__ == '__main__':
    sys.exit(main())
