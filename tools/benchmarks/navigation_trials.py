# SPDX-License-Identifier: Apache-2.0
"""Send the walking humanoid to random places in the apartment, and count how it arrives.

`tools/in_environment python3 tools/benchmarks/navigation_trials.py --goals 10`. It walks in the
simulator with physics, in real time; ground truth says how far from the goal it ends, and what it
touched. With `--minutes 5` it goes on for so long instead, and the last lines say how far its
belief of where it is was from the truth.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
import math
from pathlib import Path

from action_msgs.msg import GoalStatus
from ament_index_python.packages import get_package_share_directory
from arguments import in_range
from humanoid_common.testing.launching import running_launch_file
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_navigation.testing import Arrival, NavigatingRobot, random_goals
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import Buffer, TransformListener

ACTIVE = 'lifecycle_manager_navigation]: Managed nodes are active'
REACHED_M = 0.3


def main() -> int:
    """Walk, and print a line for each goal; return 1 if more than one in ten was not reached."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--goals', type=in_range(int, 1), default=10, help='how many places')
    parser.add_argument('--minutes', type=in_range(float, 0.1), help='walk for so long instead')
    parser.add_argument('--seed', type=in_range(int, 0), default=1)
    parser.add_argument('--launch', nargs='*', default=[], help='further arguments of the launch')
    options = parser.parse_args()
    with ros_sandbox() as ros, robot_at_home(*options.launch):
        return walk(ros, options)


@contextmanager
def robot_at_home(*arguments: str) -> Iterator[None]:
    """
    Run the robot in the apartment during a `with` block, which starts when Nav2 is active.

    Parameters
    ----------
    *arguments
        Further arguments of bringup.launch.py, as `name:=value`.

    """
    bringup = Path(get_package_share_directory('humanoid_bringup')) / 'launch/bringup.launch.py'
    given = ('scene:=apartment', 'navigation:=true', 'gui:=false', *arguments)
    with running_launch_file(bringup, *given) as program:
        program.wait_for_output(ACTIVE, 120.0)
        yield


def walk(ros: RosSandbox, options: argparse.Namespace) -> int:
    """
    Navigate from place to place, and print a row for each goal.

    Parameters
    ----------
    ros
        The domain of the robot.
    options
        The command line: `goals` or `minutes`, and `seed`.

    Returns
    -------
    int
        The exit status: 1 if more than one in ten goals was not reached cleanly.

    """
    folder = Path(get_package_share_directory('humanoid_navigation')) / 'maps'
    robot, belief = NavigatingRobot(ros), Belief(ros)
    arrivals: list[Arrival] = []
    errors: list[tuple[float, float]] = []
    print(f'{"":>4} {"goal":>20} {"s":>6} {"m off":>6} {"deg off":>7} {"recov.":>6}')
    for goal in random_goals(folder / 'apartment.yaml', 0.4, options.seed):
        if options.minutes is None and len(arrivals) == options.goals:
            break
        if options.minutes is not None and robot.robot.topics.time_s > 60.0 * options.minutes:
            break
        arrival = robot.go(*goal)
        arrivals.append(arrival)
        errors.append(belief.error(robot))
        report(len(arrivals), goal, arrival)
    bad = [a for a in arrivals if not a.is_reached or a.distance_m > REACHED_M or a.touched]
    print(f'{len(arrivals) - len(bad)} of {len(arrivals)} reached without touching anything')
    worst_m, worst_deg = max(e[0] for e in errors), max(e[1] for e in errors)
    last_m, last_deg = errors[-1]
    print(f'estimated pose off by at most {worst_m:.3f} m and {worst_deg:.1f} degrees,')
    print(f'after {robot.robot.topics.time_s:.0f} s by {last_m:.3f} m and {last_deg:.1f} degrees')
    return int(10 * len(bad) > len(arrivals))


def report(number: int, goal: tuple[float, float, float], arrival: Arrival) -> None:
    """
    Print the row of a goal.

    Parameters
    ----------
    number
        The number of the goal.
    goal
        x (m), y (m) and yaw (rad) in the map.
    arrival
        How it ended.

    """
    place = f'({goal[0]:.2f}, {goal[1]:.2f}, {math.degrees(goal[2]):.0f})'
    turn_deg = math.degrees(arrival.turn_rad)
    print(
        f'{number:>4} {place:>20} {arrival.took_s:6.1f} {arrival.distance_m:6.3f} '
        f'{turn_deg:7.1f} {arrival.recoveries:6d}  '
        + ('' if arrival.is_reached else reason(arrival))
        + (f'touched {", ".join(sorted(arrival.touched))}' if arrival.touched else ''),
        flush=True,
    )


def reason(arrival: Arrival) -> str:
    """
    Explain why a goal was not reached.

    Parameters
    ----------
    arrival
        How it ended.

    """
    if arrival.status == GoalStatus.STATUS_CANCELED:
        return f'canceled after {arrival.took_s:.0f} s '
    return f'{arrival.error_code}: {arrival.error_msg} '


class Belief:
    """
    The pose of the robot according to its transforms, to be compared with the truth.

    Parameters
    ----------
    ros
        The domain of the robot.

    """

    def __init__(self, ros: RosSandbox) -> None:
        node = ros.start(lambda **options: Node('believer', **options))
        self._buffer = Buffer(node=node)
        self._listener = TransformListener(self._buffer, node)

    def error(self, robot: NavigatingRobot) -> tuple[float, float]:
        """
        Wait a second and compare the estimated pose with the true one, while the robot stands.

        Parameters
        ----------
        robot
            The robot, which has ground truth.

        Returns
        -------
        float, float
            The distance in m, and the absolute heading error in degrees.

        """
        robot.robot.wait(1.0)
        moved = self._buffer.lookup_transform('map', 'base_footprint', Time()).transform
        yaw_rad = 2.0 * math.atan2(moved.rotation.z, moved.rotation.w)
        true = robot.robot.pose
        turn_rad = math.remainder(true.yaw_rad - yaw_rad, math.tau)
        place_m = complex(moved.translation.x, moved.translation.y)
        return abs(true.position_m - place_m), abs(math.degrees(turn_rad))


if __name__ == '__main__':
    raise SystemExit(main())
